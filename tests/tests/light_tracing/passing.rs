//! What lets a part of the light pass before a mirror: closed forms.

use std::f64::consts::PI;

use steradian::brdf::Pane;
use steradian::scene::description::{MaterialDescription, Opacity};
use steradian_tests::assert_agrees;
use steradian_tests::scenes::*;

use super::*;

const WATTS: f64 = 700.0;
const PAPER: f64 = 1e-3;
const TRANSMITTANCE: f64 = 0.9;

fn covering(material: MaterialDescription, factor: f64) -> MaterialDescription {
    MaterialDescription {
        opacity: Some(Opacity {
            factor,
            textures: vec![],
            cutoff: None,
        }),
        ..material
    }
}

/// Parallel light that falls at 45° on a floor and an upright mirror, with a sheet of this material before the mirror.
fn covered_mirror(sheet: MaterialDescription) -> SceneDescription {
    let lamp = directional(v(-1.0, 0.0, -1.0), WATTS);
    let mut scene = beside_a_mirror(lamp, above_the_floor());
    scene.materials[0] = lambertian("paper", PAPER);
    let sheet_plane = rectangle(p(-0.9, -2.0, 0.0), [v(0.0, 4.0, 0.0), v(0.0, 0.0, 2.5)]);
    scene.shapes.push(sheet_plane.made_of(&sheet.name));
    scene.materials.push(sheet);
    scene
}

/// Light that is sent back by the sheet, or passes it and comes back from the mirror, adds R + T² m/(1 − R m) to the light of the lamp, where
/// R = αR₀ and T = 1 − α + αT₀ with the opacity α and the shares R₀, T₀ of the material. What the paper sends back to the mirror adds less
/// than its reflectance, 1e-3.
#[test]
fn sheets_before_a_mirror_take_their_part() {
    let cosine = 0.5_f64.sqrt();
    let glass = Pane::new(1.5, [TRANSMITTANCE; 4]).expect("glass");
    let of_glass = glass.shares(cosine)[0];
    let black = || lambertian("sheet", 0.0);
    let clear = || modelled("sheet", pane(TRANSMITTANCE));
    for (what, material, opacity, (reflected, passed)) in [
        ("half open", black(), 0.5, (0.0, 0.0)),
        ("pane", clear(), 1.0, of_glass),
        ("half a pane", clear(), 0.5, of_glass),
    ] {
        let sheet = match opacity {
            1.0 => material,
            _ => covering(material, opacity),
        };
        let (reflected, passed) = (opacity * reflected, 1.0 - opacity + opacity * passed);
        let back = reflected + passed * passed * MIRROR / (1.0 - reflected * MIRROR);
        let expected = PAPER / PI * WATTS * cosine * (1.0 + back);
        let seen = mean(&picture(&covered_mirror(sheet), &options(128, None)));
        assert_agrees(what, &seen, expected, 1e-3 * expected);
        assert!(seen.std_error < 0.01 * expected, "{what}: {seen:?}");
    }
}
