//! The files that are generated from the table of keys are up to date.

use std::path::Path;

use steradian_io::scene_file::{key_help, schema};

fn committed(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../scenes")
        .join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn the_schema_is_up_to_date() {
    assert!(
        committed("steradian.schema.json") == format!("{:#}\n", schema()),
        "run `cargo xtask schema`"
    );
}

#[test]
fn the_list_of_keys_is_up_to_date() {
    assert!(
        committed("KEYS.txt") == key_help(),
        "run `cargo xtask schema`"
    );
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
