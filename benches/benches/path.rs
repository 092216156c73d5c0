//! Nanoseconds of each stage of a camera path: `cargo bench -p steradian-benches --bench path [-- SCENE [DEPTH [BATCHES]]]`.
//!
//! One thread, the scene's first camera, batches of 1024 paths (2048 of them unless told); the fastest of five rounds. Rough metal is in
//! `benchmarks/scenes/veach_mis.toml`, glass in `glass_ball.toml`. The film's splatting is
//! not included (`steradian render --threads 1` measures everything together).

use std::path::PathBuf;

use steradian::scene::Scene;
use steradian::sensor::Kind;
use steradian::transport::{RenderOptions, Stage, StageTimes, profile};
use steradian_io::files::DiskFiles;
use steradian_io::scene_file::read_scene;

#[expect(clippy::print_stdout, reason = "a benchmark prints its figures")]
fn main() {
    let mut arguments = std::env::args()
        .skip(1)
        .filter(|argument| argument != "--bench");
    let default = PathBuf::from(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../scenes/cornell-box.toml"
    ));
    let path = arguments.next().map_or(default, PathBuf::from);
    let mut number = |default: u32| {
        let number = arguments.next().and_then(|number| number.parse().ok());
        number.unwrap_or(default)
    };
    let (depth, batches) = (number(8), number(2048));
    let loaded =
        read_scene(&path, &DiskFiles::default()).unwrap_or_else(|problems| panic!("{problems:?}"));
    let scene = Scene::new(&loaded.description).unwrap_or_else(|problems| panic!("{problems:?}"));
    let is_camera = |sensor: &steradian::sensor::Sensor| matches!(sensor.kind, Kind::Camera(_));
    let camera = scene
        .sensors()
        .iter()
        .position(is_camera)
        .expect("the scene has a camera");
    let options = RenderOptions {
        max_depth: Some(depth),
        ..RenderOptions::default()
    };
    let round = |_| profile(&scene, camera, &options, batches).expect("the camera renders");
    let total = |times: &StageTimes| {
        Stage::ALL
            .iter()
            .map(|stage| times.nanoseconds(*stage))
            .sum::<f64>()
    };
    let best = (0..5)
        .map(round)
        .min_by(|a, b| total(a).total_cmp(&total(b)))
        .expect("five rounds");
    println!(
        "{} paths to depth {}, {:.2} rays a path",
        best.paths,
        depth,
        best.rays as f64 / best.paths as f64
    );
    for stage in Stage::ALL {
        println!(
            "{:>8} {:7.1} ns a path",
            format!("{stage:?}").to_lowercase(),
            best.nanoseconds(stage)
        );
    }
    println!(
        "{:>8} {:7.1} ns a path = {:.2} Mpaths/s",
        "all",
        total(&best),
        1e3 / total(&best)
    );
}
