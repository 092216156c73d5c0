//! The fuzz targets on their seeds, and on every input that once made one of them fail.

use std::fs;
use std::path::Path;

#[path = "../../../fuzz/src/lib.rs"]
mod targets;

#[test]
fn readers_keep_their_promises() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz");
    for folder in ["corpus-seeds", "regressions"] {
        for (name, target) in targets::TARGETS {
            let inputs = fs::read_dir(root.join(folder).join(name));
            let inputs: Vec<_> = inputs.into_iter().flatten().flatten().collect();
            assert!(
                folder == "regressions" || !inputs.is_empty(),
                "{name} has no seed"
            );
            for input in inputs {
                let bytes = fs::read(input.path()).unwrap_or_default();
                assert!(!bytes.is_empty(), "{}", input.path().display());
                target(&bytes);
            }
        }
    }
}
