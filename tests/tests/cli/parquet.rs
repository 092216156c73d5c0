//! Results as Parquet files: what other programs read from them is what JSON says.

use std::collections::BTreeMap;
use std::fs::File;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use serde_json::Value;
use steradian_tests::command::{Folder, steradian};

const SCENE: [&str; 4] = ["measure", "scenes/working-day.toml", "--samples", "4096"];

fn json(path: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn read(path: &str) -> SerializedFileReader<File> {
    SerializedFileReader::new(File::open(path).unwrap()).unwrap()
}

fn rows(path: &str) -> Vec<BTreeMap<String, Field>> {
    let reader = read(path);
    let rows = reader.get_row_iter(None).unwrap();
    let cells = |(name, cell): (&String, &Field)| (name.clone(), cell.clone());
    rows.map(|row| row.unwrap().get_column_iter().map(cells).collect())
        .collect()
}

#[test]
fn a_parquet_file_has_the_numbers_of_the_json_of_the_same_run() {
    let folder = Folder::new();
    let [result, table] = ["day.json", "day.parquet"].map(|name| folder.path(name));
    for path in [&result, &table] {
        steradian(&[&SCENE[..], &["-o", path]].concat()).fine();
    }
    let (result, rows) = (json(&result), rows(&table));
    let readings = result["readings"].as_array().unwrap();
    assert!(!rows.is_empty() && rows.len() == readings.len());
    for (row, reading) in rows.iter().zip(readings) {
        let groups = reading["groups"].as_object().unwrap();
        let of_groups = groups
            .iter()
            .map(|(name, part)| (format!("group:{name}"), &part["value"]));
        let own = ["value", "std_error"].map(|name| (name.to_owned(), &reading[name]));
        for (name, number) in own.into_iter().chain(of_groups) {
            let number = number.as_f64().map_or(Field::Null, Field::Double);
            assert_eq!(row[&name], number, "{name}");
        }
    }
    let reader = read(&table);
    let metadata = reader.metadata().file_metadata().key_value_metadata();
    let hash = metadata
        .unwrap()
        .iter()
        .find(|pair| pair.key == "scene_hash");
    assert_eq!(
        hash.unwrap().value.as_deref(),
        result["scene_hash"].as_str()
    );
}

#[test]
fn a_result_and_merged_parts_become_the_same_file() {
    let folder = Folder::new();
    let path = |name: &str| folder.path(name);
    let files = ["whole.parquet", "again.parquet", "merged.parquet"].map(path);
    let result = path("result.json");
    steradian(&[&SCENE[..], &["-o", &files[0]]].concat()).fine();
    steradian(&[&SCENE[..], &["-o", &result]].concat()).fine();
    steradian(&["measure", &result, "-o", &files[1]]).fine();
    let parts = ["1", "2"].map(path);
    for part in ["1", "2"] {
        let shard = ["--shard", &format!("{part}/2"), "-o", &path(part)];
        steradian(&[&SCENE[..], &shard].concat()).fine();
    }
    steradian(&["merge", &parts[0], &parts[1], "-o", &files[2]]).fine();
    let bytes = files.map(|file| std::fs::read(file).unwrap());
    assert!(bytes[0] == bytes[1] && bytes[0] == bytes[2]);
}

/// Refused before light is traced: the scene is not even read.
#[test]
fn answers_and_other_commands_refuse_parquet() {
    let arguments = [
        "measure",
        "no.toml",
        "--solve",
        "a: mean = 1 lx",
        "--vary",
        "b",
    ];
    let message = steradian(&[&arguments[..], &["-o", "x.parquet"]].concat()).error();
    assert!(message.contains("not as CSV or Parquet"), "{message}");
    let arguments = ["solid-angle", "--from", "0,0,0", "--cap", "1deg"];
    let message = steradian(&[&arguments[..], &["--format", "parquet"]].concat()).error();
    assert!(message.contains("invalid value 'parquet'"), "{message}");
}

/// Standard output that is no terminal takes the bytes of the file.
#[test]
fn parquet_goes_through_a_pipe() {
    let folder = Folder::new();
    let path = folder.path("day.parquet");
    steradian(&[&SCENE[..], &["-o", &path]].concat()).fine();
    let piped = steradian(&[&SCENE[..], &["--format", "parquet"]].concat());
    assert_eq!(piped.status(), 0);
    assert!(piped.0.stdout == std::fs::read(path).unwrap());
}
