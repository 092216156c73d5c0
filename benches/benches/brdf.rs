//! Nanoseconds of each reflection model: `cargo bench -p steradian-benches --bench brdf`.
//!
//! Views are spread over the hemisphere, so that every model is timed at grazing angles too; directions of incidence are
//! those that the model draws, where it has any.

use divan::{Bencher, black_box, counter::ItemsCount};
use steradian::brdf::{Brdf, Scatter};
use steradian::geometry::{Direction, Spherical};
use steradian::quantity::Angle;
use steradian::sampling::block;
use steradian::spectrum::Lanes;
use steradian_io::files::MemoryFiles;
use steradian_io::scene_file::material_from_settings;

const PAIRS: u32 = 1024;

/// Models with their settings.
const MODELS: &[&str] = &[
    "lambertian reflectance=0.5",
    "oren-nayar reflectance=0.5 sigma=20deg",
    "eon reflectance=0.5 roughness=0.5",
    "phong diffuse=0.3 glossy=0.5 exponent=40",
    "diffuse-transmission reflectance=0.4 transmittance=0.3",
    "mirror reflectance=0.9",
    "conductor metal=gold",
    "rough-conductor metal=gold alpha=0.3",
    "rough-conductor metal=gold alpha=0.3 multiple_scattering=false",
    "rough-conductor metal=gold alpha=0.3 distribution=beckmann",
    "rough-conductor metal=gold alpha_x=0.1 alpha_y=0.4",
    "dielectric ior=1.5",
    "rough-dielectric ior=1.5 alpha=0.3",
    "rough-dielectric ior=1.5 alpha=0.3 multiple_scattering=false",
    "pane ior=1.52 transmittance=0.9",
    "plastic ior=1.5 diffuse=0.5",
    "rough-plastic ior=1.5 diffuse=0.5 alpha=0.3",
    "ward diffuse=0.4 specular=0.1 alpha_x=0.1 alpha_y=0.3",
    "principled base_color=0.5 metallic=0 roughness=0.4",
];

fn main() {
    divan::main();
}

fn model(words: &str) -> Brdf {
    let mut words = words.split(' ');
    let name = words.next().expect("a name");
    let settings: Vec<(&str, &str)> = words
        .map(|word| word.split_once('=').expect("a setting"))
        .collect();
    let material = material_from_settings(name, &settings, &Lanes::rgb(), &MemoryFiles::default());
    let Ok(material) = material else {
        panic!("{name} cannot be read");
    };
    material.brdf([0.0; 4]).expect("a model").into_owned()
}

fn numbers(index: u32, block: u32) -> [f64; 2] {
    let [u, v, ..] = block::sample(7, index, block).map(f64::from);
    [u, v]
}

/// A direction above the surface.
fn above(index: u32) -> Direction {
    let [u, v] = numbers(index, 0);
    let theta = Angle::from_degrees(89.0 * u);
    Spherical::new(theta, Angle::from_radians(std::f64::consts::TAU * v)).to_direction()
}

/// Views, each with a direction of incidence.
fn pairs(model: &Brdf) -> Vec<(Direction, Direction)> {
    let pair = |index| {
        let wo = above(index);
        let drawn = model.sample(wo, numbers(index, 1));
        let wi = match drawn {
            Some(Scatter::Finite { wi, .. } | Scatter::Specular { wi, .. }) => wi,
            None => above(index + PAIRS),
        };
        (wo, wi)
    };
    (0..PAIRS).map(pair).collect()
}

fn each(
    bencher: Bencher<'_, '_>,
    words: &str,
    mut time: impl FnMut(&Brdf, Direction, Direction, [f64; 2]),
) {
    let model = model(words);
    let pairs = pairs(&model);
    bencher.counter(ItemsCount::new(PAIRS)).bench_local(|| {
        for (index, &(wo, wi)) in (0..).zip(&pairs) {
            time(black_box(&model), wo, wi, numbers(index, 2));
        }
    });
}

#[divan::bench(args = MODELS)]
fn evaluate(bencher: Bencher<'_, '_>, words: &str) {
    each(bencher, words, |model, wo, wi, _| {
        black_box(model.evaluate(wo, wi));
    });
}

#[divan::bench(args = MODELS)]
fn sample(bencher: Bencher<'_, '_>, words: &str) {
    each(bencher, words, |model, wo, _, u| {
        black_box(model.sample(wo, u));
    });
}

#[divan::bench(args = MODELS)]
fn pdf(bencher: Bencher<'_, '_>, words: &str) {
    each(bencher, words, |model, wo, wi, _| {
        black_box(model.pdf(wo, wi));
    });
}
