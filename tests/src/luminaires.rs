//! Luminaires of the repository's files in scenes.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use steradian::geometry::{Point, Vector};
use steradian::light::{FarField, Opening};
use steradian::quantity::{Amount, LuminousIntensity};
use steradian::scene::description::{
    LightDescription, LightKind, LuminaireDescription, SceneDescription,
};
use steradian_io::files::DiskFiles;
use steradian_io::scene_file::read_scene_str;

use crate::scenes::{DOWN, light, v};

/// Where the files are.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data/photometry")
}

/// A scene of lux whose files are luminaires of the repository.
///
/// # Panics
/// If it has problems.
pub fn scene_of(text: &str) -> SceneDescription {
    let name = folder().join("scene.toml").display().to_string();
    let text = format!("[scene]\nspectrum = {{ bands = [\"visible\"] }}\n{text}");
    match read_scene_str(&name, &text, &DiskFiles::default()) {
        Ok(loaded) => loaded.description,
        Err(problems) => panic!("{problems:?}"),
    }
}

/// A sensor of irradiance, or illuminance, at points of the floor.
pub fn on_the_floor(kind: &str, points: &[[f64; 2]]) -> String {
    let mut listed = String::new();
    for [x, y] in points {
        let _ = write!(listed, "[{x}, {y}, 0, 0, 0, 1], ");
    }
    format!("[[sensors]]\nname = \"floor\"\nkind = \"{kind}\"\npoints = [{listed}]\n")
}

/// Of a table in cd, hanging straight down.
pub fn hanging(position: Point, far_field: &Arc<FarField>, opening: Opening) -> LightDescription {
    turned(position, far_field, opening, [DOWN, v(1.0, 0.0, 0.0)])
}

/// The same with an aim and a direction of C0.
pub fn turned(
    position: Point,
    far_field: &Arc<FarField>,
    opening: Opening,
    [aim, c0]: [Vector; 2],
) -> LightDescription {
    light(LightKind::Luminaire(Box::new(LuminaireDescription {
        position,
        aim,
        c0,
        far_field: Arc::clone(far_field),
        unit: Amount::Photometric(LuminousIntensity::from_candelas(1.0)),
        opening,
        flux: None,
        dimming: 1.0,
        maintenance_factor: 1.0,
    })))
}
