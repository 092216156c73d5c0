//! `measure --balance`.

use serde_json::Value;
use steradian_tests::command::{Folder, steradian};

const CORNELL: [&str; 5] = [
    "measure",
    "scenes/cornell-box.toml",
    "--balance",
    "--samples",
    "4096",
];

#[test]
fn a_balance_is_read_and_read_again() {
    let folder = Folder::new();
    let file = folder.path("balance.json");
    steradian(&[&CORNELL[..], &["-o", &file]].concat()).fine();
    let object: Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
    let balance = &object["balance"][0];
    assert_eq!(
        (&balance["unit"], &balance["holds"]),
        (&"W".into(), &true.into())
    );
    let value = |key: &str| balance[key]["value"].as_f64().unwrap();
    let sum = value("absorbed") + value("escaped") + value("missing");
    assert!((sum - value("emitted")).abs() < 1e-9);
    assert_eq!(balance["emitted"]["method"], "closed-form");
    let text = steradian(&["measure", &file]).fine();
    for part in [
        "absorbed: red wall, front",
        "accounts are dark",
        "Balanced:",
    ] {
        assert!(text.contains(part), "{text}");
    }
}

/// Half of the light is gone: status 1.
#[test]
fn what_is_lost_is_told() {
    let cut = [&CORNELL[..], &["--max-depth", "1"]].concat();
    let ran = steradian(&cut);
    assert_eq!(ran.status(), 1, "{}", ran.stderr());
    assert!(ran.stdout().contains("NOT balanced"));
}

#[test]
fn a_balance_stands_alone() {
    let error = steradian(&[&CORNELL[..], &["--sensor", "floor"]].concat()).error();
    assert!(error.contains("--balance"), "{error}");
    let error = steradian(&["measure", "scenes/open-sky.toml", "--balance"]).error();
    assert!(error.contains("absorbs without end"), "{error}");
}
