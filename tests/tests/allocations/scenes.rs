//! A room with everything that paths may meet, under lights of every kind.

use std::fmt::Write;

use steradian::scene::description::SceneDescription;
use steradian_io::files::DiskFiles;
use steradian_io::scene_file::read_scene_str;
use steradian_tests::luminaires::folder;

const HEAD: &str = r#"
[materials.paper]
model = "lambertian"
reflectance = [0.8, 0.6, 0.5]

[[shapes]]
name = "room"
kind = "box"
min = [-2, -2, 0]
max = [2, 2, 3]
inside = true
openings = [{ face = "y+", rect = [1.5, 1, 1, 1] }]
material = "paper"

[[shapes]]
name = "ball"
kind = "sphere"
center = [0.3, 0.2, 0.6]
radius = 0.5
material = "thing"

[[shapes]]
name = "sheet"
kind = "rectangle"
origin = [-1.8, -1, 0.3]
edges = [[0, 2, 0], [0.3, 0, 2]]
material = "thing"

[[sensors]]
name = "eye"
kind = "camera"
position = [1.5, -1.8, 1.5]
look_at = [-0.5, 0.3, 0.8]
fov = "80 deg"
resolution = [32, 32]

[[sensors]]
name = "points"
kind = "irradiance"
points = [[0.9, -0.9, 1.0, 1, 0.5, 0.3]]

[[sensors]]
name = "scalar"
kind = "scalar-irradiance"
points = [[0.1, 0.1, 1.5]]

[[sensors]]
name = "cylinder"
kind = "cylindrical-irradiance"
points = [[-0.6, 0.1, 1.5]]

[[sensors]]
name = "rays"
kind = "radiance"
rays = [[1.5, -1.8, 1.5, -1.2, 2.0, -0.9]]

[[sensors]]
name = "through"
kind = "flux"
surface = { kind = "disc", center = [0, 0, 1.5], normal = [0, 0, 1], radius = 0.4 }
"#;

/// What is counted at a side of the sheet.
const COUNTED: [&str; 4] = ["incident", "leaving", "absorbed", "net"];

const THINGS: [(&str, &str); 10] = [
    (
        "paint",
        "model = \"lambertian\"\nreflectance = { checkerboard = [0.2, [0.8, 0.1, 0.4]], scale = [9, 9] }",
    ),
    (
        "half open",
        "model = \"lambertian\"\nreflectance = 0.5\nopacity = 0.5",
    ),
    ("mirror", "model = \"mirror\""),
    (
        "pane",
        "model = \"pane\"\nior = 1.5\ntransmittance = { checkerboard = [0.9, 0.5], scale = [9, 9] }",
    ),
    (
        "rough metal",
        "model = \"rough-conductor\"\nmetal = \"gold\"\nalpha = 0.2",
    ),
    (
        "glass",
        "model = \"dielectric\"\nior = 1.5\nabsorption = [1, 2, 3]",
    ),
    (
        "ground glass",
        "model = \"rough-dielectric\"\nior = 1.5\nalpha = 0.1",
    ),
    (
        "coat",
        "model = \"rough-plastic\"\nior = 1.5\nalpha = 0.1\ndiffuse = { checkerboard = [0.2, 0.5], scale = [9, 9] }",
    ),
    (
        "veil",
        "model = \"diffuse-transmission\"\nreflectance = 0.4\ntransmittance = { checkerboard = [0.4, 1], factor = 0.5, scale = [9, 9] }",
    ),
    (
        "gltf",
        "model = \"principled\"\nroughness = 0.3\nclearcoat = 0.5\nbase_color = [0.2, 0.5, 0.3]",
    ),
];

const LAMP: &str = r#"
[[shapes]]
kind = "rectangle"
origin = [-0.5, -0.5, 2.9]
edges = [[0, 1, 0], [1, 0, 0]]
emission = { radiance = "10 W/(m2 sr)" }

[[shapes]]
kind = "sphere"
center = [1.5, 1.5, 2.5]
radius = 0.2
emission = { radiance = "10 W/(m2 sr)" }
"#;

const POINT: &str = r#"
[[lights]]
kind = "point"
position = [0.5, 0.5, 2.5]
intensity = "10 W/sr"
"#;

const SKY: &str = r#"
[[lights]]
kind = "environment"
radiance = "10 W/(m2 sr)"
"#;

const MANY: &str = r#"
[[shapes]]
kind = "rectangle"
origin = [-1.5, -1.5, 2.9]
edges = [[0, 0.1, 0], [0.1, 0, 0]]
emission = { radiance = "10 W/(m2 sr)" }
repeat = { count = [4, 4], step = [[0.8, 0, 0], [0, 0.8, 0]] }
"#;

const LUMINAIRES: &str = r#"
[[lights]]
kind = "luminaire"
file = "lambert_1000cd_1deg.ies"
position = [0.5, 0.5, 2.5]

[[lights]]
kind = "luminaire"
file = "asymmetric_full360.ies"
position = [-0.5, 0.5, 2.5]
emit = "point"
"#;

const LIGHTS: [(&str, &str); 5] = [
    ("lamps", LAMP),
    ("a point", POINT),
    ("the sky", SKY),
    ("many panels", MANY),
    ("luminaires", LUMINAIRES),
];

/// Each thing under the lamps, then each light and kind of spectrum in a room with a metal.
pub fn all() -> Vec<(String, SceneDescription)> {
    let things =
        THINGS.map(|(name, thing)| (format!("{name} by lamps"), scene(thing, LAMP, "rgb")));
    let metal = THINGS[4].1;
    let lights = LIGHTS[1..]
        .iter()
        .map(|(name, lights)| (format!("by {name}"), scene(metal, lights, "rgb")));
    let colours = THINGS.iter().step_by(4).map(|(name, thing)| {
        (
            format!("{name} in wavelengths"),
            scene(thing, LAMP, "spectral"),
        )
    });
    let polished = [2, 3, 5].map(|k| {
        (
            format!("{} by a point", THINGS[k].0),
            scene(THINGS[k].1, POINT, "rgb"),
        )
    });
    things
        .into_iter()
        .chain(lights)
        .chain(colours)
        .chain(polished)
        .collect()
}

fn scene(thing: &str, lights: &str, spectrum: &str) -> SceneDescription {
    let mut text =
        format!("[scene]\nspectrum = \"{spectrum}\"\n{HEAD}\n[materials.thing]\n{thing}\n{lights}");
    for of in COUNTED {
        let _ = write!(
            text,
            "[[sensors]]\nname = \"{of}\"\nkind = \"flux\"\nshape = \"sheet\"\nof = \"{of}\"\n"
        );
    }
    let name = folder().join("scene.toml").display().to_string();
    match read_scene_str(&name, &text, &DiskFiles::default()) {
        Ok(loaded) => loaded.description,
        Err(problems) => panic!("{problems:?}"),
    }
}
