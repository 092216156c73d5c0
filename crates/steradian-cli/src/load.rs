//! From a file's name to a validated scene.

use std::path::Path;

use steradian::scene::description::SceneDescription;
use steradian::scene::{Problem, Scene};
use steradian_io::files::DiskFiles;
use steradian_io::scene_file::{LoadedScene, read_scene};

use crate::status::Failure;

/// A scene and the hash of what it was made from.
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// Hash of the scene file and of all that it names.
    pub hash: String,
}

/// Reads and validates a scene file, or tells everything that is wrong with it.
pub fn scene(path: &Path) -> Result<Loaded, Failure> {
    scene_with(path, |_| Ok(()))
}

/// The same with a change made between reading and validating.
pub fn scene_with(
    path: &Path,
    change: impl FnOnce(&mut SceneDescription) -> Result<(), Failure>,
) -> Result<Loaded, Failure> {
    let mut file = read_scene(path, &DiskFiles::default()).map_err(Failure::Input)?;
    change(&mut file.description)?;
    validated(file)
}

/// Reads the shapes and materials of a scene, whether or not it has lights and sensors.
pub fn surfaces(path: &Path) -> Result<Loaded, Failure> {
    let mut file = read_scene(path, &DiskFiles::default()).map_err(Failure::Input)?;
    file.description.lights.clear();
    file.description.sensors.clear();
    checked(Scene::of_surfaces(&file.description), file)
}

/// Validates a scene that was read.
pub fn validated(file: LoadedScene) -> Result<Loaded, Failure> {
    checked(Scene::new(&file.description), file)
}

fn checked(scene: Result<Scene, Vec<Problem>>, file: LoadedScene) -> Result<Loaded, Failure> {
    match scene {
        Ok(scene) => Ok(Loaded {
            scene,
            hash: file.hash,
        }),
        Err(problems) => Err(Failure::Input(
            problems
                .iter()
                .map(|problem| file.diagnostic(problem))
                .collect(),
        )),
    }
}
