//! Scene files: every key, every kind of mistake, the shipped scenes, and files that are no scenes at all.

mod environments;
mod every_key;
mod luminaires;
mod generated;
mod models;
mod mutations;
mod problems;
mod reading;
mod relief;
mod scenes;
mod textures;
mod spectra;
mod validation;

use steradian::scene::description::SceneDescription;
use steradian_io::diagnostic::{Diagnostic, render};
use steradian_io::files::MemoryFiles;
use steradian_io::scene_file::{LoadedScene, read_scene_str};

/// A triangle of sides along x and y, of 1 000 units.
const TRIANGLE: &str = "v 0 0 0\nv 1000 0 0\nv 0 1000 0\nf 1 2 3\n";

/// A picture of one texel, (128 + ½)/256 in all channels.
const HALF: &[u8] = b"#?RADIANCE\n\n-Y 1 +X 1\n\x80\x80\x80\x80";

/// A measured surface.
const MEASURED: &str = include_str!("../data/bsdf/radiance_testBSDF.xml");

/// A luminaire of 10 cd towards below, whose opening is 1.2 m along C0 and 0.6 m across.
const DOWNLIGHT: &str =
    "IESNA:LM-63-1995\nTILT=NONE\n1 1000 1 2 1 1 2 0.6 1.2 0\n1 1 25\n0 90\n0\n10 10\n";

/// The spectrum of a lamp.
const LAMP: &str = "nm,new,old\n400,0.1,0\n700,0.9,0.8\n";

fn files() -> MemoryFiles {
    MemoryFiles::default()
        .with("parts/triangle.obj", TRIANGLE)
        .with("parts/half.hdr", HALF)
        .with("parts/blind.xml", MEASURED)
        .with("parts/lamp.csv", LAMP)
        .with("parts/downlight.ies", DOWNLIGHT)
        .with("parts/point.ies", DOWNLIGHT.replace("0.6 1.2 0", "0 0 0"))
        .with("broken.ies", DOWNLIGHT.replace("0 90", "90 0"))
        .with("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1\nf 1 2 3\n")
}

fn load(text: &str) -> LoadedScene {
    read_scene_str("scene.toml", text, &files())
        .unwrap_or_else(|problems| panic!("{}", render(&problems, false)))
}

fn describe(text: &str) -> SceneDescription {
    load(text).description
}

fn problems(text: &str) -> Vec<Diagnostic> {
    match read_scene_str("scene.toml", text, &files()) {
        Ok(_) => Vec::new(),
        Err(problems) => problems,
    }
}
