//! Reports that are written block by block have the bytes of those of the whole.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use std::ops::ControlFlow;

use steradian::estimation::{Progress, Silent, Stopping};
use steradian::scene::Scene;
use steradian::scene::description::SceneDescription;
use steradian::transport::{Ended, MeasureOptions, SimulationError, measure, measure_in_blocks};
use steradian_io::report::{Run, Stream, StreamFacts, StreamFormat, Verdict, csv, json, parquet};
use steradian_tests::command::Folder;
use steradian_tests::measuring::validated;
use steradian_tests::scenes::*;

const FORMATS: [StreamFormat; 3] = [StreamFormat::Csv, StreamFormat::Json, StreamFormat::Parquet];

/// A lamp that only some of seven points on a floor see, light from a panel, and a surface.
fn description() -> SceneDescription {
    let mut lamp = point_light(p(0.5, 0.5, 2.0), intensity(20.0));
    lamp.group = Some("lamp".into());
    let shapes = [
        square(6.0, 0.0).named("floor").made_of("paper"),
        square_facing_down(0.2, 1.0).emitting(radiance(30.0)),
    ];
    let mut scene = scene([lambertian("paper", 0.7)], shapes, [lamp]);
    let place = |i: u8| (p(f64::from(i) * 0.3 - 0.9, 0.3, 0.0), UP);
    // The last one looks away from all light but a little.
    let mut row: Vec<_> = (0..6).map(place).collect();
    row.push((p(0.0, 0.0, 0.001), v(0.0, 0.0, -1.0)));
    scene.sensors = vec![
        sensor("row", irradiance_at(row)),
        sensor("beside", irradiance_at([place(3)])),
        sensor("E0", scalar_irradiance_at(p(0.3, 0.3, 0.5))),
    ];
    scene
}

fn options(points_of_a_block: usize) -> MeasureOptions {
    let mut options = MeasureOptions {
        points_of_a_block,
        ..MeasureOptions::default()
    };
    options.plan.stop = Stopping::at_samples(64);
    options
}

fn facts(folder: &Folder) -> StreamFacts {
    StreamFacts {
        scene_hash: "0123".into(),
        version: "1.2.3".into(),
        scratch: folder.path("blocks").into(),
    }
}

fn streamed(
    scene: &Scene,
    format: StreamFormat,
    points: usize,
    observer: &mut dyn steradian::estimation::Observer,
) -> (Vec<u8>, Verdict, Ended) {
    let folder = Folder::new();
    let mut stream = Stream::new(format, facts(&folder), Vec::new()).unwrap();
    let mut take = |block| {
        stream.block(block).unwrap();
        Ok::<_, SimulationError>(())
    };
    let ended = measure_in_blocks(scene, &options(points), observer, &mut take).unwrap();
    let (bytes, verdict) = stream.finish(&ended.missing).unwrap();
    assert!(folder.names().is_empty(), "{:?}", folder.names());
    (bytes, verdict, ended)
}

#[test]
fn blocks_are_written_as_the_whole_is() {
    let scene = validated(&description());
    let found = measure(&scene, &options(100), &mut Silent).unwrap();
    let run = Run {
        measurements: &found,
        scene_hash: "0123",
        version: "1.2.3",
    };
    let mut table = Vec::new();
    parquet::encode(&run, &mut table).unwrap();
    let whole = [
        csv::encode(&run).unwrap().into_bytes(),
        json::encode(&run).unwrap().into_bytes(),
        table,
    ];
    for (format, whole) in FORMATS.into_iter().zip(&whole) {
        for points in [1, 3, 7, 8, 100] {
            let (bytes, verdict, ended) = streamed(&scene, format, points, &mut Silent);
            assert!(bytes == *whole, "{format:?} in blocks of {points}");
            assert_eq!(verdict.missed, found.missed());
            assert_eq!(ended, Ended::default());
        }
    }
}

/// Stopped after the first of blocks of three, the run says what it has not come to, and nothing that is there is another number.
#[test]
fn a_stopped_run_keeps_what_is_finished_and_says_what_is_missing() {
    let scene = validated(&description());
    let mut stop = |_: &Progress| ControlFlow::Break(());
    let (bytes, verdict, ended) = streamed(&scene, StreamFormat::Json, 3, &mut stop);
    assert!(!verdict.complete && ended.fault.is_none());
    let missing: Vec<_> = ended.missing.iter().map(ToString::to_string).collect();
    assert_eq!(
        missing,
        [
            "the last 5 of 7 points of sensor `row`: the run ended before them",
            "the last 1 of 1 points of sensor `beside`: the run ended before them",
            "the last 1 of 1 points of sensor `E0`: the run ended before them",
        ]
    );
    let result: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
    assert_eq!(result["complete"], false);
    let unsampled = result["unsampled"].as_array().unwrap();
    assert!(
        missing
            .iter()
            .all(|text| unsampled.contains(&text.as_str().into()))
    );
    let readings = result["readings"].as_array().unwrap();
    let found = measure(&scene, &options(100), &mut Silent).unwrap();
    assert_eq!(readings.len(), 2);
    for (reading, whole) in readings.iter().zip(found.readings()) {
        assert_eq!(reading["value"].as_f64(), Some(whole.estimate.value));
    }
}
