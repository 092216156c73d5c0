//! What reading does beyond taking values over: the up axis, shared meshes, the hash.

use steradian::geometry::{Point, Transform, Vector};
use steradian::quantity::Angle;
use steradian::scene::description::{
    Fisheye, FluxOf, FluxSurface, GeometryDescription, LaneValues, LightKind, MaterialModel,
    Projection, Receivers, Response, SensorKind, Side, SpectrumMode, SpotBeam,
};

use crate::{TRIANGLE, describe, files, load};
use steradian_io::scene_file::read_scene_str;

/// A file with y up, of things that are all at (1, 2, 3) or point along (0, 1, 0).
const Y_UP: &str = r#"
[scene]
up = "y"

[[shapes]]
kind = "disc"
center = [1, 2, 3]
normal = [0, 1, 0]
radius = 1
repeat = { count = 2, step = [0, 1, 0] }

[[shapes]]
kind = "ground"
height = 2
transform = [{ translate = [0, 1, 0] }]

[[shapes]]
kind = "box"
min = [0, 0, 0]
max = [1, 2, 3]
faces = { floor = "a", walls = "b" }
openings = [{ face = "ceiling", rect = [0, 0, 1, 1] }]

[[lights]]
kind = "spot"
position = [1, 2, 3]
direction = [0, 1, 0]
cutoff = "9 deg"
flux = "1 W"
repeat = { count = 2, step = [0, 1, 0] }

[[sensors]]
name = "point"
kind = "irradiance"
points = [[1, 2, 3, 0, 1, 0]]

[[sensors]]
name = "grid"
kind = "irradiance"
grid = { origin = [1, 2, 3], edges = [[0, 0, 1], [1, 0, 0]], count = [1, 1], normal = [0, 1, 0] }

[[sensors]]
name = "camera"
kind = "camera"
position = [1, 2, 3]
look_at = [0, 0, 0]
fov = "9 deg"
resolution = [1, 1]
"#;

const UP: Vector = Vector::new(0.0, 0.0, 1.0);

/// (1, 2, 3) of a file with y up.
fn turned() -> Point {
    Point::new(1.0, -3.0, 2.0)
}

#[test]
fn shapes_of_a_file_with_y_up_are_turned() {
    let shapes = describe(Y_UP).shapes;
    let GeometryDescription::Disc { center, normal, .. } = shapes[0].geometry else {
        panic!("{:?}", shapes[0])
    };
    assert_eq!(shapes[0].transform.point(center), turned());
    assert_eq!(shapes[0].transform.vector(normal), UP);
    assert_eq!(shapes[0].repeat.as_ref().unwrap().step, [UP]);
    let GeometryDescription::Ground { height } = shapes[1].geometry else {
        panic!("{:?}", shapes[1])
    };
    assert_eq!(
        shapes[1].transform.point(Point::new(5.0, 6.0, height)),
        Point::new(5.0, 6.0, 3.0)
    );
}

#[test]
fn faces_of_a_file_with_y_up_are_renamed() {
    let room = describe(Y_UP).shapes.remove(2);
    let GeometryDescription::Box {
        faces, openings, ..
    } = &room.geometry
    else {
        panic!("{room:?}")
    };
    let named: Vec<(&str, &str)> = faces
        .iter()
        .map(|(face, material)| (face.as_str(), material.as_str()))
        .collect();
    assert_eq!(
        named,
        [
            ("y-", "a"),
            ("x-", "b"),
            ("x+", "b"),
            ("z-", "b"),
            ("z+", "b")
        ]
    );
    assert_eq!(openings[0].face, "y+");
}

#[test]
fn lights_and_sensors_of_a_file_with_y_up_are_turned() {
    let scene = describe(Y_UP);
    let LightKind::Spot {
        position,
        direction,
        ..
    } = scene.lights[0].kind
    else {
        panic!("{:?}", scene.lights[0])
    };
    assert_eq!((position, direction), (turned(), UP));
    assert_eq!(scene.lights[0].repeat.as_ref().unwrap().step, [UP]);
    let SensorKind::Irradiance(Receivers::Points(points)) = &scene.sensors[0].kind else {
        panic!("no points")
    };
    assert_eq!(points[0], (turned(), UP));
    let SensorKind::Irradiance(Receivers::Grid {
        origin,
        edges,
        normal,
        ..
    }) = &scene.sensors[1].kind
    else {
        panic!("no grid")
    };
    assert_eq!((*origin, *normal), (turned(), Some(UP)));
    assert_eq!(edges[0].cross(edges[1]), UP);
    let SensorKind::Camera(camera) = &scene.sensors[2].kind else {
        panic!("no camera")
    };
    assert_eq!((camera.position, camera.up), (turned(), UP));
}

fn mesh_scene(scene_up: &str, mesh_keys: &str) -> String {
    format!(
        "[scene]\nup = \"{scene_up}\"\n[[shapes]]\nkind = \"mesh\"\nfile = \"parts/triangle.obj\"\n{mesh_keys}"
    )
}

#[test]
fn a_mesh_has_the_up_axis_of_the_scene_or_its_own() {
    // The third vertex, 1 000 units along y of the file, in the description.
    let cases = [
        ("z", "", [0.0, 1000.0, 0.0]),
        ("z", "up = \"y\"", [0.0, 0.0, 1000.0]),
        ("y", "", [0.0, 0.0, 1000.0]),
        ("y", "up = \"z\"", [0.0, 1000.0, 0.0]),
    ];
    for (scene_up, keys, expected) in cases {
        let shape = describe(&mesh_scene(scene_up, keys)).shapes.remove(0);
        let GeometryDescription::Mesh(mesh) = &shape.geometry else {
            panic!("{shape:?}")
        };
        assert_eq!(
            shape.transform.point(mesh.vertices[2]),
            expected.into(),
            "{scene_up} {keys}"
        );
    }
}

#[test]
fn shapes_share_the_triangles_of_a_file() {
    let shape = "[[shapes]]\nkind = \"mesh\"\nfile = \"parts/triangle.obj\"\n";
    let shapes = describe(&format!("{shape}{shape}{shape}unit = \"mm\"\n")).shapes;
    let mesh = |index: usize| match &shapes[index].geometry {
        GeometryDescription::Mesh(mesh) => mesh.clone(),
        other => panic!("{other:?}"),
    };
    assert!(std::sync::Arc::ptr_eq(&mesh(0), &mesh(1)));
    assert_eq!(
        (mesh(0).vertices[1].x, mesh(2).vertices[1].x),
        (1000.0, 1.0)
    );
}

#[test]
fn the_hash_covers_the_scene_and_its_files() {
    let text = mesh_scene("z", "");
    let hash = |text: &str, obj: &str| {
        let files = files().with("parts/triangle.obj", obj);
        read_scene_str("scene.toml", text, &files).unwrap().hash
    };
    let usual = hash(&text, TRIANGLE);
    assert_eq!((usual.len(), &usual), (64, &load(&text).hash));
    assert_ne!(usual, hash(&format!("{text}\n"), TRIANGLE));
    assert_ne!(usual, hash(&text, &TRIANGLE.replace("1000", "1001")));
}

#[test]
fn files_are_relative_to_the_scene() {
    let files = files().with("deep/part.obj", TRIANGLE);
    let text = "[[shapes]]\nkind = \"mesh\"\nfile = \"part.obj\"\n";
    assert!(read_scene_str("deep/scene.toml", text, &files).is_ok());
    assert!(read_scene_str("scene.toml", text, &files).is_err());
}

/// Only what is required.
const SHORT: &str = r#"
[materials.silver]
model = "mirror"

[[shapes]]
kind = "disc"
center = [0, 0, 0]
normal = [0, 0, 1]
radius = 1
emission = { flux = "1 lm" }

[[shapes]]
kind = "sphere"
center = [0, 0, 0]
radius = 1

[[shapes]]
kind = "ground"

[[lights]]
kind = "spot"
position = [0, 0, 1]
direction = [0, 0, -1]
cutoff = "30 deg"
flux = "1 lm"

[[sensors]]
name = "desk"
kind = "irradiance"
shape = "desk"

[[sensors]]
name = "flux"
kind = "flux"
shape = "desk"
"#;

#[test]
fn absent_keys_have_the_defaults_of_the_help() {
    let scene = describe(SHORT);
    assert_eq!(
        (scene.name.as_str(), scene.response, scene.luminous_efficacy),
        ("", Response::Auto, None)
    );
    assert_eq!(
        scene.spectrum,
        SpectrumMode::Broadband {
            bands: vec!["total".into()]
        }
    );
    assert_eq!(
        scene.materials[0].model,
        MaterialModel::Mirror {
            reflectance: LaneValues::Uniform(1.0)
        }
    );
    let disc = &scene.shapes[0];
    assert!(matches!(
        disc.geometry,
        GeometryDescription::Disc {
            inner_radius: 0.0,
            ..
        }
    ));
    assert_eq!(
        (disc.transform, &disc.repeat, &disc.material),
        (Transform::IDENTITY, &None, &None)
    );
    let emission = disc.emission.as_ref().unwrap();
    assert_eq!(
        (emission.two_sided, &emission.spectrum, &emission.group),
        (false, &None, &None)
    );
    let GeometryDescription::Sphere {
        inside: false,
        ports,
        ..
    } = &scene.shapes[1].geometry
    else {
        panic!("outside")
    };
    assert!(ports.is_empty());
    assert!(matches!(
        scene.shapes[2].geometry,
        GeometryDescription::Ground { height: 0.0 }
    ));
    let LightKind::Spot { beam, .. } = scene.lights[0].kind else {
        panic!("{:?}", scene.lights[0])
    };
    assert_eq!(
        beam,
        SpotBeam::Uniform {
            cutoff: Angle::from_degrees(30.0)
        }
    );
}

#[test]
fn sensors_have_the_defaults_of_the_help() {
    let sensors = describe(SHORT).sensors;
    let SensorKind::Irradiance(Receivers::Shape {
        side,
        count,
        offset,
        ..
    }) = sensors[0].kind
    else {
        panic!()
    };
    assert_eq!((side, count, offset), (Side::Front, 16, 0.0));
    let SensorKind::Flux {
        surface: FluxSurface::Shape { side, .. },
        of,
    } = sensors[1].kind
    else {
        panic!()
    };
    assert_eq!(
        (side, of, sensors[1].response.clone()),
        (Side::Front, FluxOf::Incident, None)
    );
}

fn camera_scene(keys: &str) -> String {
    format!(
        "[[sensors]]\nkind = \"camera\"\nname = \"eye\"\nposition = [0, 0, 1]\nlook_at = [1, 0, 1]\nresolution = [8, 8]\n{keys}"
    )
}

#[test]
fn every_projection_has_its_name() {
    let fov = Angle::from_degrees(150.0);
    let fisheye = |mapping| Projection::Fisheye { mapping, fov };
    for (name, expected) in [
        ("perspective", Projection::Perspective { fov }),
        ("fisheye-equidistant", fisheye(Fisheye::Equidistant)),
        ("fisheye-equisolid", fisheye(Fisheye::Equisolid)),
        ("fisheye-hemispherical", fisheye(Fisheye::Hemispherical)),
    ] {
        let keys = format!("fov = \"150 deg\"\nprojection = {name:?}");
        let scene = describe(&camera_scene(&keys));
        let SensorKind::Camera(camera) = &scene.sensors[0].kind else {
            panic!("no camera")
        };
        assert_eq!(camera.projection, expected);
        assert_eq!(camera.projection.name(), name);
    }
    let scene = describe(&camera_scene("projection = \"panorama\""));
    assert!(
        matches!(&scene.sensors[0].kind, SensorKind::Camera(camera) if camera.projection == Projection::Panorama)
    );
}
