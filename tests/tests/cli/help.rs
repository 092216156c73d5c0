//! Help that teaches.

use steradian_tests::command::{root, steradian};

const SUBCOMMANDS: [&str; 9] = [
    "render",
    "measure",
    "inspect",
    "verify",
    "merge",
    "area",
    "direction",
    "energy",
    "brdf",
];

#[test]
fn every_subcommand_is_listed_and_explained_with_examples() {
    let overview = steradian(&["--help"]).fine();
    for name in SUBCOMMANDS {
        assert!(overview.contains(name), "{name}");
        let help = steradian(&[name, "--help"]).fine();
        assert!(
            help.contains("Usage:") && help.contains("Examples:"),
            "{help}"
        );
        assert_eq!(steradian(&["help", name]).fine(), help);
    }
}

/// The files that an example names exist, unless the example makes them.
#[test]
fn examples_name_real_scenes() {
    for name in SUBCOMMANDS {
        let help = steradian(&[name, "--help"]).fine();
        let words = help
            .split_whitespace()
            .filter(|word| word.starts_with("scenes/"));
        for scene in words {
            assert!(root().join(scene).exists(), "{name}: {scene}");
        }
    }
}

#[test]
fn the_keys_of_a_scene_are_explained() {
    let keys = steradian(&["help", "scene"]).fine();
    for key in ["reflectance", "intensity", "look_at", "W/sr"] {
        assert!(keys.contains(key), "{key}");
    }
    let schema: serde_json::Value =
        serde_json::from_str(&steradian(&["help", "scene", "--schema"]).fine()).unwrap();
    assert!(schema.get("properties").is_some());
}

#[test]
fn an_unknown_topic_is_told_with_those_there_are() {
    let message = steradian(&["help", "lamps"]).error();
    assert!(
        message.contains("lamps") && message.contains("scene"),
        "{message}"
    );
}

#[test]
fn the_version_is_told() {
    assert!(steradian(&["--version"]).fine().starts_with("steradian "));
}
