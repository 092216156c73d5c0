//! Solved factors of light groups and what they achieve, as a table or as one JSON object, `"schema": "steradian.solution/1"`.

use serde_json::{Map, Value, json};
use steradian::measurement::Measurements;
use steradian::measurement::solve::{Achieved, Relation, Solution, SolvedFactor, Target, TargetOf};

use super::columns::Columns;
use super::numbers::{estimate, exact};
use super::run::{Run, SAMPLING_ERROR_ONLY};
use super::{json, table};

/// Name and version of the format.
pub const SCHEMA: &str = "steradian.solution/1";

/// The tables of factors and of targets, with notes.
pub fn table(run: &Run<'_>, solution: &Solution) -> String {
    let percent = exact(100.0 * run.measurements.confidence);
    let mut factors = Columns::new(["light group", &format!("factor ({percent} %)"), ""]);
    for found in &solution.factors {
        let held = found
            .held_at
            .map(|bound| format!("held at {}", exact(bound)));
        let held = held.unwrap_or_default();
        factors.row([found.group.clone(), estimate(&found.factor), held]);
    }
    let mut targets = Columns::new(["target", &format!("reading ({percent} %)"), ""]);
    for achieved in &solution.targets {
        let verdict = if achieved.met { "met" } else { "not met" };
        targets.row([
            words(&achieved.target, &achieved.unit),
            table::with_unit(&achieved.reading, &achieved.unit),
            verdict.to_owned(),
        ]);
    }
    let notes = notes(run, solution).join("\n");
    format!("{factors}\n{targets}\n{notes}\n")
}

fn notes(run: &Run<'_>, solution: &Solution) -> Vec<String> {
    let mut notes = vec![format!(
        "Readings with these lights: --relight '{}'",
        relight(solution)
    )];
    if solution.targets.iter().any(|achieved| !achieved.met) {
        let what = "Not every target can be met within the bounds; this comes nearest.";
        notes.push(what.to_owned());
    }
    notes.push(SAMPLING_ERROR_ONLY.to_owned());
    notes.push(table::identity(run));
    notes.extend(table::relit(run.measurements));
    notes
}

/// What `--relight` takes: the factors to the last bit.
fn relight(solution: &Solution) -> String {
    let levels = solution.factors.iter();
    let levels = levels.map(|found| format!("{}={}", found.group, found.factor.value));
    levels.collect::<Vec<_>>().join(",")
}

/// `desk: mean = 500 lx`.
fn words(target: &Target, unit: &str) -> String {
    let of = match target.of {
        TargetOf::Mean => ": mean".to_owned(),
        TargetOf::Min => ": min".to_owned(),
        TargetOf::Max => ": max".to_owned(),
        TargetOf::Point(index) => format!("[{index}]"),
    };
    let (sensor, sign, value) = (&target.sensor, sign(target.relation), exact(target.value));
    format!("{sensor}{of} {sign} {value} {unit}")
}

fn sign(relation: Relation) -> &'static str {
    match relation {
        Relation::Equal => "=",
        Relation::AtLeast => ">=",
        Relation::AtMost => "<=",
    }
}

/// The JSON object, on indented lines.
pub fn json(run: &Run<'_>, solution: &Solution) -> String {
    let measurements: &Measurements = run.measurements;
    let object = json!({
        "schema": SCHEMA,
        "version": run.version,
        "scene": measurements.scene_name,
        "scene_hash": run.scene_hash,
        "seed": measurements.seed,
        "confidence": measurements.confidence,
        "complete": measurements.complete(),
        "warnings": measurements.warnings,
        "relit": json::relit(measurements),
        "note": SAMPLING_ERROR_ONLY,
        "factors": solution.factors.iter().map(factor).collect::<Vec<_>>(),
        "targets": solution.targets.iter().map(target).collect::<Vec<_>>(),
        "relight": relight(solution),
    });
    format!("{object:#}\n")
}

fn factor(found: &SolvedFactor) -> Value {
    let mut object = Map::new();
    object.insert("group".to_owned(), json!(found.group));
    object.insert("unit".to_owned(), json!("1"));
    object.extend(json::estimate(&found.factor));
    object.insert("held_at".to_owned(), json!(found.held_at));
    Value::Object(object)
}

fn target(achieved: &Achieved) -> Value {
    let Achieved { target, unit, .. } = achieved;
    let mut object = Map::new();
    object.insert("target".to_owned(), json!(words(target, unit)));
    object.insert("sensor".to_owned(), json!(target.sensor));
    object.insert("wanted".to_owned(), json!(target.value));
    object.insert("unit".to_owned(), json!(unit));
    object.extend(json::estimate(&achieved.reading));
    object.insert("met".to_owned(), json!(achieved.met));
    Value::Object(object)
}

#[cfg(test)]
mod tests {
    use super::super::run::tests::{measurements, run};
    use super::*;
    use steradian::measurement::solve::Vary;

    fn solved() -> (Measurements, Solution) {
        let measurements = measurements();
        let target = Target {
            sensor: "a, b".into(),
            quantity: 0,
            of: TargetOf::Point(0),
            relation: Relation::Equal,
            value: 25.0,
        };
        let vary = Vary {
            group: "lamp".into(),
            bounds: [0.0, 1.0],
        };
        let solution = measurements.solve(&[target], &[vary]).unwrap();
        (measurements, solution)
    }

    /// The point has 100 W/m2 by a closed form: a quarter of the lamp gives 25.
    #[test]
    fn factors_and_targets_stand_in_tables() {
        let (measurements, solution) = solved();
        let text = table(&run(&measurements), &solution);
        for part in [
            "lamp         0.25 (exact)",
            "a, b[0] = 25 W/m2  25 W/m2 (exact)  met",
            "--relight 'lamp=0.25'",
            "Seed 3.",
        ] {
            assert!(text.contains(part), "{part} is not in\n{text}");
        }
    }

    #[test]
    fn the_object_has_values_with_units_and_errors() {
        let (measurements, solution) = solved();
        let object: Value = serde_json::from_str(&json(&run(&measurements), &solution)).unwrap();
        let factor = &object["factors"][0];
        assert_eq!(
            (&factor["value"], &factor["unit"]),
            (&json!(0.25), &json!("1"))
        );
        assert_eq!(factor["method"], "closed-form");
        let target = &object["targets"][0];
        assert_eq!(
            (&target["value"], &target["met"]),
            (&json!(25.0), &json!(true))
        );
        assert_eq!(target["target"], "a, b[0] = 25 W/m2");
    }
}
