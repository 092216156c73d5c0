//! The files that are generated from the table of keys are up to date.

use std::path::Path;

use steradian_io::scene_file::{key_help, schema};

/// Compares with the committed file, or replaces it if `STERADIAN_BLESS` is set.
fn assert_committed(name: &str, found: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../scenes")
        .join(name);
    let fail = |error: std::io::Error| panic!("{}: {error}", path.display());
    if std::env::var_os("STERADIAN_BLESS").is_some() {
        std::fs::write(&path, found).unwrap_or_else(fail);
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{error}"));
    assert!(committed == found, "run `cargo xtask schema`");
}

#[test]
fn the_schema_is_up_to_date() {
    assert_committed("steradian.schema.json", &format!("{:#}\n", schema()));
}

#[test]
fn the_list_of_keys_is_up_to_date() {
    assert_committed("KEYS.txt", &key_help());
}

#[test]
fn the_help_names_units_and_defaults() {
    let help = key_help();
    for part in [
        "[scene]",
        "[materials.NAME]",
        "[[lights]]",
        "kind = \"illuminance\"",
        "cd, mcd, kcd",
        "Default: \"broadband\".",
        "One of intensity, flux.",
        "Required beside `rotate`.",
        "Required with projection = thin-lens.",
        "The keys of an emission.",
    ] {
        assert!(help.contains(part), "{part}");
    }
    assert!(help.ends_with('\n') && !help.ends_with("\n\n"));
}
