use std::collections::BTreeMap;

use bytes::Bytes;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use serde_json::{Value, json};
use steradian::measurement::Measurements;

use super::super::json::encode as encode_json;
use super::super::run::tests::{measurements, run};
use super::*;

type ReadRow = BTreeMap<String, Field>;

fn encoded(measurements: &Measurements, cells: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    encode_in_groups(&run(measurements), cells, &mut bytes).unwrap();
    bytes
}

fn reader(measurements: &Measurements, cells: usize) -> SerializedFileReader<Bytes> {
    SerializedFileReader::new(Bytes::from(encoded(measurements, cells))).unwrap()
}

fn read(measurements: &Measurements, cells: usize) -> Vec<ReadRow> {
    let reader = reader(measurements, cells);
    let rows = reader.get_row_iter(None).unwrap();
    rows.map(|row| row.unwrap().get_column_iter().map(owned).collect())
        .collect()
}

fn owned((name, field): (&String, &Field)) -> (String, Field) {
    (name.clone(), field.clone())
}

/// A number or null of JSON as a field.
fn field_of(number: &Value) -> Field {
    number.as_f64().map_or(Field::Null, Field::Double)
}

/// With four lanes and two groups the readings have each kind of cell, null among them.
#[test]
fn rows_are_the_readings_of_the_json_bit_for_bit() {
    let measurements = measurements();
    let object: Value = serde_json::from_str(&encode_json(&run(&measurements)).unwrap()).unwrap();
    let rows = read(&measurements, CELLS_IN_MEMORY);
    let readings = object["readings"].as_array().unwrap();
    assert_eq!(rows.len(), readings.len());
    for (row, reading) in rows.iter().zip(readings) {
        for name in ["sensor", "quantity", "unit"] {
            let text = reading[name].as_str().unwrap();
            assert_eq!(row[name], Field::Str(text.to_owned()));
        }
        assert_eq!(
            row["index"],
            Field::Long(reading["index"].as_i64().unwrap())
        );
        assert_eq!(
            row["converged"],
            Field::Bool(reading["converged"].as_bool().unwrap())
        );
        let mut numbers = vec![
            ("value".to_owned(), &reading["value"]),
            ("std_error".to_owned(), &reading["std_error"]),
            ("lo".to_owned(), &reading["confidence_interval"][0]),
            ("hi".to_owned(), &reading["confidence_interval"][1]),
        ];
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            numbers.push((name.to_owned(), &reading["position"][axis]));
            numbers.push((format!("n{name}"), &reading["normal"][axis]));
        }
        for (kind, key) in [("channel", "channels"), ("group", "groups")] {
            for (name, part) in reading[key].as_object().unwrap() {
                numbers.push((format!("{kind}:{name}"), &part["value"]));
                numbers.push((format!("{kind}:{name}:std_error"), &part["std_error"]));
            }
        }
        assert_eq!(numbers.len() + 5, row.len());
        for (name, number) in numbers {
            assert_eq!(row[&name], field_of(number), "{name}");
        }
    }
    assert_eq!(rows[1]["group:window:std_error"], Field::Null);
}

#[test]
fn a_small_memory_makes_many_row_groups_of_the_same_rows() {
    let measurements = measurements();
    let (one, many) = (
        reader(&measurements, CELLS_IN_MEMORY),
        reader(&measurements, 1),
    );
    assert_eq!((one.num_row_groups(), many.num_row_groups()), (1, 2));
    assert_eq!(read(&measurements, CELLS_IN_MEMORY), read(&measurements, 1));
}

#[test]
fn the_same_result_gives_the_same_bytes() {
    let measurements = measurements();
    assert_eq!(encoded(&measurements, 1), encoded(&measurements, 1));
}

#[test]
fn no_readings_are_a_table_without_rows() {
    let mut measurements = measurements();
    measurements.sensors.clear();
    assert_eq!(read(&measurements, 1), Vec::<ReadRow>::new());
}

#[test]
fn metadata_hold_the_facts_of_the_run() {
    let measurements = measurements();
    let reader = reader(&measurements, CELLS_IN_MEMORY);
    let file = reader.metadata().file_metadata();
    assert_eq!(file.created_by(), Some("steradian version 1.2.3"));
    let pairs = file.key_value_metadata().unwrap().iter();
    let found: BTreeMap<&str, &str> = pairs
        .map(|pair| (pair.key.as_str(), pair.value.as_deref().unwrap()))
        .collect();
    for (key, expected) in [
        ("schema", "steradian.result/1"),
        ("version", "1.2.3"),
        ("scene", "A, \"desk\""),
        ("scene_hash", "0123456789abcdef0123"),
        ("seed", "3"),
        ("luminous_efficacy", "179.0"),
        ("complete", "false"),
        ("unsampled", "[\"point lights seen in mirrors\"]"),
        ("warnings", "[\"a warning\"]"),
    ] {
        assert_eq!(found[key], expected);
    }
    assert!(!found.contains_key("max_depth"));
}

/// A row of an exposure has its own quantity and unit, and no parts.
#[test]
fn what_a_reading_adds_up_to_is_a_row_without_parts() {
    use steradian::measurement::Dimming;
    use steradian::quantity::Time;
    use steradian::time::Interval;
    let mut measurements = measurements();
    let two_seconds = Interval::lasting(Time::from_seconds(2.0), Time::from_seconds(0.0)).unwrap();
    let dimming = Dimming::new(vec![None, None]);
    measurements.dimming = dimming.over(two_seconds, &measurements.groups).unwrap();
    let rows = read(&measurements, CELLS_IN_MEMORY);
    assert_eq!(rows.len(), 4);
    assert_eq!(rows[1]["quantity"], Field::Str("radiant exposure".into()));
    assert_eq!(rows[1]["value"], Field::Double(200.0));
    assert_eq!(rows[1]["x"], rows[0]["x"]);
    assert_eq!(rows[1]["group:lamp"], Field::Null);
    assert_eq!(rows[1]["channel:nir"], Field::Null);
}

#[test]
fn a_channel_without_part_and_a_place_without_normal_are_null() {
    let mut stored = serde_json::to_value(measurements()).unwrap();
    stored["sensors"][0]["quantities"][0]["weights"] = json!([1.0, 0.0]);
    stored["sensors"][0]["points"][0]["normal"] = Value::Null;
    let measurements: Measurements = serde_json::from_value(stored).unwrap();
    let row = &read(&measurements, CELLS_IN_MEMORY)[0];
    for name in ["channel:nir", "channel:nir:std_error", "nx", "ny", "nz"] {
        assert_eq!(row[name], Field::Null);
    }
    assert_eq!(row["channel:visible"], Field::Double(80.0));
}

#[test]
fn names_that_would_make_equal_columns_are_refused() {
    let mut measurements = measurements();
    measurements.groups = vec!["lamp".into(), "lamp:std_error".into()];
    let error = encode(&run(&measurements), Vec::new()).unwrap_err();
    assert!(error.to_string().contains("`group:lamp:std_error`"));
}

#[test]
fn a_sink_that_refuses_is_told() {
    let measurements = measurements();
    let mut full = [0_u8; 64];
    let error = encode(&run(&measurements), &mut full[..]).unwrap_err();
    assert!(error.to_string().starts_with("cannot write: "), "{error}");
}
