//! Energy balances: what lights emit is absorbed or escapes, whatever they shine on.
//!
//! A balance that holds is refused with a probability of 1e-3; the seed is fixed.

use std::f64::consts::PI;

use steradian::measurement::Balance;
use steradian::scene::energy_balance;
use steradian::sensor::Term;
use steradian::transport::MeasureOptions;
use steradian_tests::luminaires::scene_of;
use steradian_tests::measuring::{measured, samples};
use steradian_tests::{assert_agrees, assert_close};

fn balance(text: &str, options: &MeasureOptions) -> Balance {
    let mut scene = scene_of(text);
    scene.sensors = energy_balance();
    let mut found = measured(&scene, options).balances();
    assert_eq!(found.len(), 1);
    found.remove(0)
}

fn emitted(balance: &Balance) -> f64 {
    assert_eq!(balance.totals[0].0, Term::Emitted);
    balance.totals[0].1.value
}

/// It holds, and the error is small enough for that to say something.
fn assert_holds(what: &str, balance: &Balance) {
    let Balance {
        missing, chance, ..
    } = balance;
    assert!(
        missing.std_error < 0.05 * emitted(balance),
        "{what}: {missing:?}"
    );
    assert!(balance.holds(), "{what}: {missing:?}, chance {chance}");
}

/// A ball and a standing plate of material `it` on a floor before a wall.
const STUDIO: &str = r#"
[materials.wall]
model = "lambertian"
reflectance = 0.6

[[shapes]]
kind = "rectangle"
origin = [-1, -1, -1]
edges = [[2, 0, 0], [0, 2, 0]]
material = "wall"

[[shapes]]
kind = "rectangle"
origin = [-1, 1, -1]
edges = [[2, 0, 0], [0, 0, 2]]
material = "wall"

[[shapes]]
name = "ball"
kind = "sphere"
center = [0.4, 0.1, -0.5]
radius = 0.4
material = "it"

[[shapes]]
name = "plate"
kind = "rectangle"
origin = [-0.8, -0.6, -0.9]
edges = [[0.5, 0.5, 0], [0, 0, 0.9]]
material = "it"
"#;

/// A square lamp of 10 lm.
const LAMP: &str = r#"
[[shapes]]
name = "lamp"
kind = "rectangle"
origin = [-0.25, 0.25, 1]
edges = [[0.5, 0, 0], [0, -0.5, 0]]
emission = { flux = "10 lm" }
"#;

const MATERIALS: [&str; 10] = [
    r#"model = "lambertian", reflectance = 0.8"#,
    r#"model = "mirror", reflectance = 0.9"#,
    r#"model = "oren-nayar", reflectance = 0.7, sigma = "30 deg""#,
    r#"model = "diffuse-transmission", reflectance = 0.3, transmittance = 0.5"#,
    r#"model = "rough-conductor", eta = 0.2, k = 3, alpha = 0.2"#,
    r#"model = "rough-dielectric", ior = 1.5, alpha = 0.2"#,
    r#"model = "pane", ior = 1.5, transmittance = 0.7"#,
    r#"model = "rough-plastic", diffuse = 0.5, alpha = 0.2"#,
    r#"model = "principled", base_color = 0.7, roughness = 0.4, metallic = 0.5"#,
    r#"model = "lambertian", reflectance = 0.8, opacity = 0.4"#,
];

#[test]
fn light_is_kept_whatever_it_falls_on() {
    for material in MATERIALS {
        let text = format!("{STUDIO}{LAMP}\n[materials]\nit = {{ {material} }}\n");
        let found = balance(&text, &samples(1 << 14));
        assert_close("emitted", emitted(&found), 10.0, 1e-9);
        assert_holds(material, &found);
    }
}

const POLISHED: [&str; 9] = [
    r#"model = "pane", ior = 1, transmittance = 0.7"#,
    r#"model = "mirror", reflectance = 0.9"#,
    r#"model = "conductor", eta = 0.2, k = 3"#,
    r#"model = "dielectric", ior = 1.5"#,
    r#"model = "dielectric", ior = 1.5, opacity = 0.5"#,
    r#"model = "plastic", diffuse = 0.5"#,
    r#"model = "pane", ior = 1.5, transmittance = 0.7"#,
    r#"model = "pane", ior = 1.5, transmittance = 0.7, opacity = 0.5"#,
    r#"model = "mirror", reflectance = 0.9, opacity = 0.4"#,
];

/// Fluxes have what polished surfaces throw from lights without extent, and lack nothing.
#[test]
fn light_without_extent_is_kept_by_polished_things() {
    let lights = [
        r#"kind = "point"; flux = "10 lm"; position = [0, 0, 1]"#,
        r#"kind = "spot"; direction = [0.3, 0, -1]; cutoff = "40 deg"; flux = "10 lm"; position = [0, 0, 1]"#,
        r#"kind = "directional"; direction = [0.3, 0.2, -1]; irradiance = "4 lx""#,
    ];
    for (light, material) in lights.iter().flat_map(|l| POLISHED.map(|m| (*l, m))) {
        let keys = light.replace("; ", "\n");
        let text = format!("{STUDIO}\n[[lights]]\n{keys}\n[materials]\nit = {{ {material} }}\n");
        let found = balance(&text, &samples(1 << 12));
        assert_holds(&format!("{light} on {material}"), &found);
    }
}

/// The studio with diffuse things in it and one light, whose keys are parted by semicolons.
fn lit(light: &str) -> String {
    let keys = light.replace("; ", "\n");
    let diffuse = "[materials.it]\nmodel = \"lambertian\"\nreflectance = 0.8\n";
    format!("{STUDIO}\n{diffuse}\n[[lights]]\n{keys}\n")
}

#[test]
fn every_light_is_emitted_in_full() {
    let lights = [
        (r#"kind = "point"; flux = "10 lm""#, 10.0),
        (
            r#"kind = "spot"; direction = [0, 0, -1]; cutoff = "40 deg"; flux = "10 lm""#,
            10.0,
        ),
        (
            r#"kind = "luminaire"; file = "lum_sample_01.ldt"; emit = "point"; flux = "10 lm""#,
            10.0,
        ),
        (
            r#"kind = "luminaire"; file = "lum_sample_01.ldt"; flux = "5 lm"; repeat = { count = [2], step = [[0, 0.1, 0]] }"#,
            10.0,
        ),
    ];
    for (light, flux) in lights {
        let text = lit(&format!("{light}; position = [0, 0, 1]"));
        let found = balance(&text, &samples(1 << 14));
        assert_close(light, emitted(&found), flux, 1e-9 * flux);
        assert_holds(light, &found);
    }
}

#[test]
fn light_from_outside_is_absorbed_or_goes_on() {
    for light in [
        r#"kind = "directional"; direction = [0.3, 0.2, -1]; irradiance = "100 lx""#,
        r#"kind = "environment"; radiance = "10 cd/m2""#,
    ] {
        assert_holds(light, &balance(&lit(light), &samples(1 << 14)));
    }
}

/// Φ = 2 π L A of both sides: squares of 0 and of 20 cd/m² in turn are 10 in the mean.
#[test]
fn a_pattern_that_emits_is_sampled() {
    let one_sided = r#"emission = { flux = "10 lm" }"#;
    let pattern = r#"emission = { radiance = "20 cd/m2", two_sided = true, texture = { checkerboard = [0, 1], scale = [2, 2] } }"#;
    let lamp = LAMP.replace(one_sided, pattern);
    assert_ne!(lamp, LAMP);
    let diffuse = "[materials.it]\nmodel = \"lambertian\"\nreflectance = 0.8\n";
    let found = balance(&format!("{STUDIO}{lamp}\n{diffuse}"), &samples(1 << 14));
    let total = found.totals[0].1;
    assert_agrees("emitted", &total, 2.0 * PI * 10.0 * 0.25, 0.0);
    assert!(total.std_error < 0.01 * total.value, "{total:?}");
    assert_holds("pattern", &found);
}

/// What is left out is missing: of paths that end at their second surface, most of the light.
#[test]
fn light_that_is_lost_is_missed() {
    let text =
        format!("{STUDIO}{LAMP}\n[materials.it]\nmodel = \"lambertian\"\nreflectance = 0.8\n");
    let cut = MeasureOptions {
        max_depth: Some(1),
        ..samples(1 << 14)
    };
    let found = balance(&text, &cut);
    assert!(
        !found.holds() && found.missing.value > 0.0,
        "{:?}",
        found.missing
    );
    assert!(found.chance < 1e-9);
}
