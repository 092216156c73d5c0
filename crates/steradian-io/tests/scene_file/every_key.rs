//! Every key is read, and arrives in the description.

use std::collections::BTreeSet;

use serde_json::Value as Json;
use steradian::geometry::{Point, Vector};
use steradian::quantity::{
    Amount, Angle, Flux, Illuminance, Irradiance, Length, LuminousFlux, LuminousIntensity, Time,
};
use steradian::scene::description::*;
use steradian_io::scene_file::schema;

use crate::describe;

const EVERY_KEY: &str = include_str!("every-key.toml");
const SECTIONS: [(&str, &str); 4] = [
    ("materials", "model"),
    ("shapes", "kind"),
    ("lights", "kind"),
    ("sensors", "kind"),
];

fn everything() -> SceneDescription {
    describe(EVERY_KEY)
}

/// `kind.key` for all that the schema allows in a section.
fn allowed(schema: &Json, section: &str, tag: &str) -> BTreeSet<String> {
    let section = &schema["properties"][section];
    let entry = if section["items"].is_object() {
        &section["items"]
    } else {
        &section["additionalProperties"]
    };
    let mut keys = BTreeSet::new();
    for alternative in entry["oneOf"].as_array().into_iter().flatten() {
        let properties = alternative["properties"].as_object().into_iter().flatten();
        for kind in alternative["properties"][tag]["enum"]
            .as_array()
            .into_iter()
            .flatten()
        {
            keys.extend(
                properties
                    .clone()
                    .map(|(key, _)| format!("{}.{key}", kind.as_str().unwrap_or_default())),
            );
        }
    }
    keys
}

/// `kind.key` for all that the file holds in a section.
fn used(file: &toml::Table, section: &str, tag: &str) -> BTreeSet<String> {
    let entries: Vec<&toml::Value> = match &file[section] {
        toml::Value::Table(entries) => entries.values().collect(),
        entries => entries.as_array().into_iter().flatten().collect(),
    };
    let tables = entries.into_iter().filter_map(toml::Value::as_table);
    let keys = tables.flat_map(|table| {
        let kind = table
            .get(tag)
            .and_then(toml::Value::as_str)
            .unwrap_or("two-sided");
        table.keys().map(move |key| format!("{kind}.{key}"))
    });
    keys.collect()
}

#[test]
fn the_file_holds_every_key() {
    let (schema, file) = (schema(), EVERY_KEY.parse::<toml::Table>().unwrap());
    for (section, tag) in SECTIONS {
        let allowed = allowed(&schema, section, tag);
        assert!(allowed.len() > 5, "{allowed:?}");
        // Keys of all materials are in `relief`: their two exclude each other.
        let is_shared = |key: &&String| key.ends_with("_map");
        let [allowed, used] = [allowed, used(&file, section, tag)].map(|keys| {
            keys.iter()
                .filter(|key| !is_shared(key))
                .cloned()
                .collect::<BTreeSet<_>>()
        });
        // The inline mesh and the meshes from files exclude each other's keys, so not every kind has all in one entry.
        assert_eq!(allowed, used, "{section}");
    }
    let inner = schema["$defs"]
        .as_object()
        .unwrap()
        .values()
        .filter_map(|record| record["properties"].as_object());
    for key in inner.flat_map(|properties| properties.keys()) {
        let quoted = format!("\"{key}\" = ");
        assert!(
            EVERY_KEY.contains(&format!("{key} = ")) || EVERY_KEY.contains(&quoted),
            "{key}"
        );
    }
}

#[test]
fn the_scene_and_its_materials() {
    let scene = everything();
    assert_eq!(scene.name, "Everything");
    assert_eq!(
        scene.spectrum,
        SpectrumMode::Broadband {
            bands: vec!["visible".into(), "nir".into()]
        }
    );
    assert_eq!(scene.response, Response::Radiant);
    assert_eq!(scene.luminous_efficacy, Some(110.0));
    let names: Vec<&str> = scene
        .materials
        .iter()
        .map(|material| material.name.as_str())
        .collect();
    let first = [
        "plain", "shiny", "both", "untagged", "pictured", "checked", "coloured",
    ];
    assert_eq!(names[..7], first);
    let bands = LaneValues::Bands(vec![("nir".into(), 0.25), ("visible".into(), 0.5)]);
    assert_eq!(
        scene.materials[0].model,
        MaterialModel::Lambertian {
            reflectance: bands.into()
        }
    );
    assert_eq!(
        scene.materials[1].model,
        MaterialModel::Mirror {
            reflectance: LaneValues::Uniform(0.9)
        }
    );
    let sides = MaterialModel::TwoSided {
        front: "shiny".into(),
        back: "plain".into(),
    };
    assert_eq!(scene.materials[3].model, sides);
}

#[test]
fn a_shape_and_its_emission() {
    let desk = &everything().shapes[0];
    assert_eq!(
        (desk.name.as_deref(), desk.material.as_deref()),
        (Some("desk"), Some("plain"))
    );
    let GeometryDescription::Rectangle { origin, edges } = desk.geometry else {
        panic!("{desk:?}")
    };
    assert_eq!(origin, Point::new(0.0, 0.0, 0.75));
    assert_eq!(
        edges,
        [Vector::new(2.0, 0.0, 0.0), Vector::new(0.0, 1.0, 0.0)]
    );
    // Moved to (1, 0, 1), turned to (0, 1, 1), doubled to (0, 2, 2), flattened to (0, 2, 1).
    let image = desk.transform.point(Point::new(0.0, 0.0, 1.0));
    assert!(
        image.distance(Point::new(0.0, 2.0, 1.0)).to_metres() < 1e-15,
        "{image:?}"
    );
    let step = vec![Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 0.5, 0.0)];
    assert_eq!(
        desk.repeat,
        Some(Repeat {
            count: vec![2, 3],
            step
        })
    );
    let emission = desk.emission.as_ref().unwrap();
    let Ok(luminance) = "10 cd/m2".parse() else {
        panic!("a luminance")
    };
    assert_eq!(emission.amount, EmissionAmount::Radiance(luminance));
    assert_eq!(
        emission.spectrum,
        Some(LaneValues::Bands(vec![
            ("visible".into(), 1.0),
            ("nir".into(), 0.0)
        ]))
    );
    assert!(emission.two_sided);
    assert_eq!(emission.group.as_deref(), Some("desk"));
    let schedule = emission.schedule.as_ref().unwrap();
    assert_eq!(schedule.at(Time::from_hours(4.0)), Ok(0.75));
}

#[test]
fn the_other_shapes() {
    let shapes = everything().shapes;
    let GeometryDescription::Polygon { vertices, holes } = &shapes[1].geometry else {
        panic!("{:?}", shapes[1])
    };
    assert_eq!(
        (vertices.len(), holes.len(), holes[0][2]),
        (4, 1, Point::new(2.0, 2.0, 0.0))
    );
    assert_eq!(
        shapes[1].repeat,
        Some(Repeat {
            count: vec![2],
            step: vec![Vector::new(0.0, 0.0, 3.0)]
        })
    );
    let GeometryDescription::Disc {
        normal,
        radius,
        inner_radius,
        ..
    } = shapes[2].geometry
    else {
        panic!()
    };
    assert_eq!(
        (normal, radius, inner_radius),
        (Vector::new(0.0, 0.0, 2.0), 0.5, 0.01)
    );
    let GeometryDescription::Sphere {
        center,
        radius,
        inside,
        ports,
    } = &shapes[3].geometry
    else {
        panic!()
    };
    assert_eq!(
        (*center, *radius, *inside),
        (Point::new(1.0, 2.0, 3.0), 0.0254, true)
    );
    let port = Port {
        direction: Vector::new(1.0, 0.0, 0.0),
        half_angle: Angle::from_degrees(5.0),
    };
    assert_eq!(*ports, [port]);
    let GeometryDescription::Ground { height } = shapes[7].geometry else {
        panic!("{:?}", shapes[7])
    };
    assert_eq!(height, -1.0);
}

#[test]
fn a_box_and_its_faces() {
    let room = &everything().shapes[4];
    let GeometryDescription::Box {
        min,
        max,
        inside,
        faces,
        openings,
    } = &room.geometry
    else {
        panic!("{room:?}")
    };
    assert_eq!(
        (*min, *max, *inside),
        (Point::ORIGIN, Point::new(4.0, 3.0, 2.5), true)
    );
    let first: Vec<(&str, &str)> = faces
        .iter()
        .take(4)
        .map(|(face, name)| (face.as_str(), name.as_str()))
        .collect();
    assert_eq!(
        first,
        [
            ("walls", "plain"),
            ("floor", "shiny"),
            ("ceiling", "plain"),
            ("x-", "both")
        ]
    );
    let window = Opening {
        face: "y-".into(),
        rect: [1.0, 1.0, 2.0, 1.2],
        material: Some("both".into()),
    };
    let skylight = Opening {
        face: "z+".into(),
        rect: [0.0, 0.0, 1.0, 1.0],
        material: None,
    };
    assert_eq!(*openings, [window, skylight]);
}

#[test]
fn meshes_come_from_files_and_from_lists() {
    let shapes = everything().shapes;
    let mesh = |index: usize| match &shapes[index].geometry {
        GeometryDescription::Mesh(mesh) => mesh.clone(),
        other => panic!("{other:?}"),
    };
    // Millimetres, y up: (0, 1000, 0) is 1 m up.
    assert_eq!(mesh(5).vertices[2], Point::new(0.0, 0.0, 1.0));
    assert_eq!(mesh(5).triangles, [[0, 1, 2]]);
    assert_eq!(mesh(6).vertices[2], Point::new(0.0, 1.0, 0.0));
}

#[test]
fn lights() {
    let lights = everything().lights;
    let bulb = &lights[0];
    let at = |light: usize, minutes: f64| {
        let schedule = lights[light].schedule.as_ref().unwrap();
        schedule.at(Time::from_seconds(60.0 * minutes))
    };
    // Steps that repeat, lines in a table and lines in a list.
    assert_eq!((at(0, 69.0), at(0, 71.0)), (Ok(1.0), Ok(0.0)));
    assert_eq!((at(2, 12.0 * 60.0), at(6, 9.0 * 60.0)), (Ok(0.5), Ok(0.5)));
    assert!(lights[1].schedule.is_none() && at(6, 0.0).is_err());
    assert_eq!(
        (bulb.name.as_deref(), bulb.group.as_deref()),
        (Some("bulb"), Some("lamps"))
    );
    assert!(
        bulb.spectrum.is_some()
            && bulb
                .repeat
                .as_ref()
                .is_some_and(|repeat| repeat.count == [4])
    );
    let LightKind::Point {
        position,
        power: PointPower::Intensity(Amount::Radiant(intensity)),
    } = bulb.kind
    else {
        panic!("{bulb:?}")
    };
    assert_eq!(
        (position, intensity.to_watts_per_steradian()),
        (Point::new(0.0, 0.0, 2.0), 75.0)
    );
    let LightKind::Point { power, .. } = lights[1].kind else {
        panic!("{:?}", lights[1])
    };
    assert_eq!(
        power,
        PointPower::Flux(Amount::Photometric(LuminousFlux::from_lumens(800.0)))
    );
    let LightKind::Directional {
        direction,
        irradiance,
    } = lights[6].kind
    else {
        panic!("{:?}", lights[6])
    };
    assert_eq!(direction, Vector::new(0.0, 1.0, -1.0));
    assert_eq!(
        irradiance,
        Amount::<Irradiance, _>::Photometric(Illuminance::from_lux(100_000.0))
    );
    let LightKind::Environment {
        radiance: Amount::Radiant(radiance),
    } = lights[7].kind
    else {
        panic!()
    };
    assert_eq!(radiance.to_watts_per_square_metre_steradian(), 0.3);
}

#[test]
fn beams_of_spots() {
    let lights = everything().lights;
    let beam = |index: usize| match lights[index].kind {
        LightKind::Spot { beam, power, .. } => (beam, power),
        ref other => panic!("{other:?}"),
    };
    let (SpotBeam::CosinePower { exponent, cutoff }, power) = beam(2) else {
        panic!("{:?}", beam(2))
    };
    assert_eq!(cutoff, Angle::QUARTER_TURN);
    // Half the peak at half the beam angle: cosⁿ 30° = ½.
    assert!(
        (libm::pow(libm::cos(30.0_f64.to_radians()), exponent) - 0.5).abs() < 1e-15,
        "{exponent}"
    );
    assert_eq!(
        power,
        PointPower::Intensity(Amount::Photometric(LuminousIntensity::from_candelas(
            1000.0
        )))
    );
    let ten_watts = PointPower::Flux(Amount::Radiant(Flux::from_watts(10.0)));
    assert_eq!(
        beam(3),
        (
            SpotBeam::Uniform {
                cutoff: Angle::from_degrees(30.0)
            },
            ten_watts
        )
    );
    let cutoff = Angle::from_degrees(40.0);
    assert_eq!(
        beam(4).0,
        SpotBeam::CosinePower {
            exponent: 3.0,
            cutoff
        }
    );
    assert_eq!(
        beam(5).0,
        SpotBeam::Smooth {
            inner: Angle::from_degrees(20.0),
            cutoff
        }
    );
}

#[test]
fn receivers_of_irradiance() {
    let sensors = everything().sensors;
    let receivers = |name: &str| {
        let sensor = sensors.iter().find(|sensor| sensor.name == name).unwrap();
        let SensorKind::Irradiance(receivers) = &sensor.kind else {
            panic!("{sensor:?}")
        };
        (sensor.response.clone(), receivers)
    };
    let (response, Receivers::Points(points)) = receivers("points") else {
        panic!()
    };
    assert_eq!(response, Some(Response::Photopic));
    assert_eq!(
        *points,
        [(Point::new(0.0, 0.0, 0.75), Vector::new(0.0, 0.0, 1.0))]
    );
    let (
        None,
        Receivers::Grid {
            edges,
            count,
            normal,
            ..
        },
    ) = receivers("grid")
    else {
        panic!()
    };
    assert_eq!(
        (edges[1], *count),
        (Vector::new(0.0, 1.0, 0.0), GridCount::Given([4, 5]))
    );
    assert_eq!(*normal, Some(Vector::new(0.0, 0.0, -1.0)));
    let (Some(Response::Photopic), Receivers::Grid { normal: None, .. }) = receivers("lux grid")
    else {
        panic!()
    };
    let (
        _,
        Receivers::Shape {
            shape,
            side,
            count,
            offset,
        },
    ) = receivers("on a shape")
    else {
        panic!()
    };
    assert_eq!(
        (shape.as_str(), *side, *count, *offset),
        ("desk", Side::Back, 9, 0.001)
    );
}

#[test]
fn the_other_sensors() {
    let sensors = everything().sensors;
    let kind = |name: &str| {
        &sensors
            .iter()
            .find(|sensor| sensor.name == name)
            .unwrap()
            .kind
    };
    let SensorKind::Flux {
        surface: FluxSurface::Shape { name, side },
        of,
    } = kind("through the desk")
    else {
        panic!()
    };
    assert_eq!(
        (name.as_str(), *side, *of),
        ("desk", Side::Back, FluxOf::Net)
    );
    let SensorKind::Flux {
        surface: FluxSurface::Virtual {
            geometry,
            transform,
        },
        of,
    } = kind("through a disc")
    else {
        panic!()
    };
    assert!(matches!(
        geometry,
        GeometryDescription::Disc {
            inner_radius: 0.5,
            ..
        }
    ));
    assert_eq!(
        (transform.point(Point::ORIGIN), *of),
        (Point::new(0.0, 0.0, 1.0), FluxOf::Leaving)
    );
    let SensorKind::Radiance { rays } = kind("nits") else {
        panic!()
    };
    assert_eq!(
        *rays,
        [(Point::new(0.0, 0.0, 1.0), Vector::new(0.0, 0.0, -1.0))]
    );
    let SensorKind::ScalarIrradiance { points } = kind("fluence") else {
        panic!()
    };
    assert_eq!(*points, [Point::new(0.0, 0.0, 1.0)]);
    for (name, faces) in [
        ("upright", None),
        ("upright lux", None),
        ("half", Some(Vector::new(1.0, 0.0, 0.0))),
        ("half lux", Some(Vector::new(0.0, 1.0, 0.0))),
    ] {
        let SensorKind::Cylindrical { receivers, facing } = kind(name) else {
            panic!()
        };
        assert_eq!(*facing, faces, "{name}");
        let axis = match receivers {
            Receivers::Points(points) => points[0].1,
            Receivers::Grid {
                count: GridCount::En12464,
                border: 0.5,
                normal: Some(axis),
                ..
            } => *axis,
            _ => panic!("{name}"),
        };
        let tilted = name == "half";
        assert_eq!(
            axis,
            Vector::new(0.0, f64::from(u8::from(tilted)), 1.0),
            "{name}"
        );
    }
    let SensorKind::Camera(camera) = kind("camera") else {
        panic!()
    };
    assert_eq!(
        (camera.position, camera.look_at),
        (Point::new(5.0, 0.0, 1.0), Point::new(0.0, 0.0, 1.0))
    );
    assert_eq!(
        (camera.up, camera.resolution),
        (Vector::new(0.0, 1.0, 1.0), [320, 200])
    );
    let fov = Angle::from_degrees(40.0);
    assert_eq!(camera.projection, Projection::Perspective { fov });
}

#[test]
fn the_projections_of_cameras() {
    let sensors = everything().sensors;
    let projection = |name: &str| {
        let mut named = sensors.iter().filter(|sensor| sensor.name == name);
        match &named.next().unwrap().kind {
            SensorKind::Camera(camera) => camera.projection,
            other => panic!("{other:?}"),
        }
    };
    let thin_lens = Projection::ThinLens {
        fov: Angle::from_degrees(40.0),
        aperture_radius: Length::from_millimetres(5.0),
        focus_distance: Length::from_metres(2.5),
    };
    assert_eq!(projection("thin lens"), thin_lens);
    let width = Length::from_metres(3.0);
    assert_eq!(projection("plan"), Projection::Orthographic { width });
}

#[test]
fn photometric_kinds_report_photometric_values() {
    let sensors = everything().sensors;
    for name in [
        "lux points",
        "lux grid",
        "lux on a shape",
        "lumens",
        "lumens through a sphere",
        "nits",
    ] {
        let sensor = sensors.iter().find(|sensor| sensor.name == name).unwrap();
        assert_eq!(sensor.response, Some(Response::Photopic), "{name}");
    }
}
