//! `measure --duration` and `--at`: schedules of lights.

use serde_json::Value;
use steradian_tests::cases::{Case, time_table};
use steradian_tests::command::{Folder, steradian};

const DAY: &str = "scenes/working-day.toml";

fn measured(arguments: &[&str]) -> Value {
    let arguments = [&["measure"], arguments, &["--format", "json"]].concat();
    serde_json::from_str(&steradian(&arguments).fine()).unwrap()
}

fn number(value: &Value, path: &str) -> f64 {
    let found = value.pointer(path).and_then(Value::as_f64);
    found.unwrap_or_else(|| panic!("no {path} in {value}"))
}

fn off_by(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}

/// The lamp of a dose case, on for the first part of each hour, over a point whose normal leans away from it.
fn dose_scene(case: &Case) -> String {
    let (intensity, distance) = (case.number("intensity"), case.number("distance"));
    let angle = case.number("incidence_deg").to_radians();
    let normal = [libm::sin(angle), 0.0, libm::cos(angle)];
    let off = 60.0 * case.number("duty");
    format!(
        "[[lights]]\nkind = \"point\"\nposition = [0, 0, {distance:?}]\nintensity = \"{intensity:?} W/sr\"\n\
         schedule = {{ held = [[\"0 h\", 1], [\"{off:?} min\", 0]], period = \"1 h\" }}\n\
         [[sensors]]\nname = \"dose\"\nkind = \"irradiance\"\npoints = [[0, 0, 0, {:?}, {:?}, {:?}]]\n",
        normal[0], normal[1], normal[2]
    )
}

#[test]
fn doses_agree_with_the_table() {
    let folder = Folder::new();
    let mut worst = 0.0_f64;
    let cases = time_table().into_iter();
    let doses: Vec<Case> = cases
        .filter(|case| case.kind() == "sensor_dose_duty_cycle")
        .collect();
    assert_eq!(doses.len(), 2);
    for case in &doses {
        let scene = folder.write("dose.toml", &dose_scene(case));
        let hours = format!("{:?}h", case.number("hours"));
        let reading = measured(&[&scene, "--duration", &hours])["readings"][0].take();
        for (name, path) in [
            ("irradiance_on", "/value"),
            ("dose_J_m2", "/exposure/value"),
            ("dose_Wh_m2", "/exposure/in_hours/value"),
        ] {
            worst = worst.max(off_by(number(&reading, path), case.expected(name)));
        }
        assert_eq!(reading["exposure"]["unit"], "J/m2");
        assert_eq!(reading["exposure"]["std_error"], 0.0);
    }
    println!("the worst dose is off by {worst:.1e}");
    // The reference is good to 1e-12.
    assert!(worst <= 1e-12, "{worst:e}");
}

#[test]
fn a_working_day_adds_up_as_its_header_says() {
    let day = measured(&[DAY, "--start", "7h", "--duration", "12h"]);
    let reading = &day["readings"][0];
    assert!(off_by(number(reading, "/value"), 250.0) < 1e-12);
    assert!(off_by(number(reading, "/exposure/value"), 5.76e6) < 1e-12);
    assert!(off_by(number(reading, "/exposure/in_hours/value"), 1600.0) < 1e-12);
    assert_eq!(reading["exposure"]["quantity"], "luminous exposure");
    assert_eq!(
        (&reading["exposure"]["unit"], &day["at"]),
        (&"lx s".into(), &Value::Null)
    );
    assert_eq!(number(&day, "/over/from/value"), 7.0 * 3600.0);
    // Both lamps are in one group, whose share is all of it.
    assert!(off_by(number(reading, "/groups/default/value"), 250.0) < 1e-12);
}

#[test]
fn readings_are_taken_at_a_time() {
    for (time, lux) in [("12h", 100.0), ("10.5h", 125.0), ("8h", 250.0)] {
        let result = measured(&[DAY, "--at", time]);
        assert!(
            off_by(number(&result, "/readings/0/value"), lux) < 1e-12,
            "{time}"
        );
        assert!(result["readings"][0].get("exposure").is_none());
    }
    let both = measured(&[DAY, "--at", "12h", "--start", "8h", "--duration", "1h"]);
    assert!(off_by(number(&both, "/readings/0/value"), 100.0) < 1e-12);
    // An hour of the lamp and ten minutes of the other.
    let exposure = number(&both, "/readings/0/exposure/in_hours/value");
    assert!(off_by(exposure, 200.0 + 50.0 / 6.0) < 1e-12);
}

#[test]
fn the_table_and_the_csv_show_what_readings_add_up_to() {
    let arguments = ["measure", DAY, "--start", "7h", "--duration", "12h"];
    let text = steradian(&arguments).fine();
    for part in [
        "7 h to 19 h",
        "luminous exposure",
        "5760000 lx s (exact)",
        "1600 lx h (exact)",
        "factor 1",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    let csv = steradian(&[&arguments[..], &["--format", "csv"]].concat()).fine();
    let rows: Vec<&str> = csv.lines().collect();
    assert!(rows[1].contains(",illuminance,lx,250"), "{csv}");
    assert!(rows[2].contains(",luminous exposure,lx s,5760000"), "{csv}");
    assert_eq!(rows.len(), 3);
    assert!(
        steradian(&["measure", DAY, "--at", "12h"])
            .fine()
            .contains("Values at 12 h.")
    );
}

/// Two skies over a square in a room with openings are found by the same rays, so their errors are one error. Each has a schedule
/// of its own, of two hours at full light in eight.
const TWO_SKIES: &str = r#"
[materials.grey]
model = "lambertian"
reflectance = 0.5

[[shapes]]
kind = "box"
min = [0, 0, 0]
max = [4, 4, 3]
inside = true
material = "grey"
openings = [{ face = "ceiling", rect = [1, 1, 2, 2] }]

[[lights]]
kind = "environment"
radiance = "10 W/(m2 sr)"
schedule = [["0 h", 0], ["4 h", 0.5], ["8 h", 0]]

[[lights]]
kind = "environment"
radiance = "20 W/(m2 sr)"
schedule = { held = [["0 h", 0], ["2 h", 1], ["4 h", 0], ["8 h", 0]] }

[[sensors]]
name = "floor"
kind = "flux"
surface = { kind = "rectangle", origin = [1, 1, 0.5], edges = [[2, 0, 0], [0, 2, 0]] }
"#;

/// Both schedules are two hours of full light, so what the flux adds up to is two hours of it, error and all. An error put together
/// from two independent ones would be √5/3 of that.
#[test]
fn errors_that_lights_share_stay_shared() {
    let folder = Folder::new();
    let scene = folder.write("skies.toml", TWO_SKIES);
    let result = measured(&[&scene, "--duration", "8h", "--samples", "4096"]);
    let reading = result["readings"].as_array().unwrap();
    let flux = reading
        .iter()
        .find(|reading| reading["quantity"] == "flux")
        .unwrap();
    assert!(number(flux, "/std_error") > 0.0);
    for part in [
        "value",
        "std_error",
        "confidence_interval/0",
        "confidence_interval/1",
    ] {
        let (at_full, added_up) = (
            number(flux, &format!("/{part}")),
            number(flux, &format!("/exposure/{part}")),
        );
        // The roundings of the weights, which the spread of sixteen means enlarges by value/error, some 1e3.
        assert!(
            off_by(added_up, 7200.0 * at_full) < 1e-11,
            "{part}: {added_up} {at_full}"
        );
    }
    assert_eq!(
        (&flux["exposure"]["quantity"], &flux["exposure"]["unit"]),
        (&"energy".into(), &"J".into())
    );
    assert_eq!(flux["exposure"]["in_hours"]["unit"], "Wh");
    let (again, no_time) = (
        measured(&[&scene, "--at", "3h", "--samples", "4096"]),
        measured(&[&scene, "--at", "6h", "--samples", "4096"]),
    );
    // At three hours the skies give .375 · 10 + 20, at six .25 · 10, of 30.
    // The skies are looked for by samples of their own, so that the parts are those of all but for the errors of both.
    let of = |result: &Value, what: &str| number(result, &format!("/readings/0/{what}"));
    for (part, share) in [(&again, 23.75 / 30.0), (&no_time, 2.5 / 30.0)] {
        let off = of(part, "value") - of(&result, "value") * share;
        let errors = of(part, "std_error") + of(&result, "std_error") * share;
        assert!(off.abs() < 5.0 * errors, "{off} {errors}");
    }
}

#[test]
fn shards_know_their_schedules() {
    let folder = Folder::new();
    let scene = folder.write("skies.toml", TWO_SKIES);
    let whole = [
        "measure",
        &scene,
        "--duration",
        "8h",
        "--samples",
        "256",
        "--format",
        "json",
    ];
    let parts = [folder.path("1"), folder.path("2")];
    for (shard, part) in ["1/2", "2/2"].iter().zip(&parts) {
        let arguments = [&whole[..6], &["--shard", shard, "-o", part]].concat();
        assert_eq!(steradian(&arguments).status(), 0);
    }
    let merged = folder.path("merged.json");
    assert_eq!(
        steradian(&["merge", &parts[0], &parts[1], "-o", &merged]).status(),
        0
    );
    assert_eq!(
        std::fs::read_to_string(merged).unwrap(),
        steradian(&whole).fine()
    );
}

#[test]
fn times_that_no_schedule_covers_are_refused() {
    for (arguments, expected) in [
        (
            vec!["--duration", "8h"],
            "the record goes from 25200 s to 68400 s",
        ),
        (
            vec!["--at", "20h"],
            "the schedule of a light in group `default`",
        ),
        (vec!["--duration", "8"], "no unit"),
        (vec!["--duration", "0h"], "ends after it begins"),
    ] {
        let text = steradian(&[&["measure", DAY][..], &arguments].concat()).error();
        assert!(text.contains(expected), "{expected} is not in\n{text}");
    }
}
