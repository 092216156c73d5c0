//! The reference cases of `tests/data/cases/brdf-*.json`.

use serde_json::Value;

const TABLES: [&str; 2] = [
    include_str!("../../../../../tests/data/cases/brdf-fresnel.json"),
    include_str!("../../../../../tests/data/cases/brdf-models.json"),
];

/// One case.
pub(crate) struct Case(Value);

impl Case {
    pub(crate) fn number(&self, name: &str) -> f64 {
        self.0["params"][name].as_f64().unwrap()
    }

    pub(crate) fn expected(&self, name: &str) -> f64 {
        self.0["expect"][name].as_f64().unwrap()
    }
}

/// All cases of one kind, of which there must be `count`.
pub(crate) fn cases_of(kind: &str, count: usize) -> Vec<Case> {
    let table = |text| serde_json::from_str::<Value>(text).unwrap()["cases"].take();
    let cases = TABLES
        .into_iter()
        .flat_map(|text| table(text).as_array().cloned().unwrap());
    let cases: Vec<_> = cases
        .filter(|case| case["kind"] == kind)
        .map(Case)
        .collect();
    assert_eq!(cases.len(), count, "{kind}");
    cases
}

/// Refuses a number that is further off than the error of the reference and `tolerance`, relative to 1 or to the number.
#[track_caller]
pub(crate) fn assert_case(case: &Case, name: &str, found: f64, tolerance: f64) {
    let expected = case.expected(name);
    let reference = case.0["reference_rel_error"].as_f64().unwrap();
    let allowed = reference * expected.abs() + tolerance * expected.abs().max(1.0);
    assert!(
        (found - expected).abs() <= allowed,
        "{} {name}: {found}, expected {expected}",
        case.0["id"]
    );
}
