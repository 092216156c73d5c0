use super::*;
use crate::quantity::{Exitance, Flux, Length, LuminousExitance};
use crate::sensor::FluxOf;

/// The one mistake is in the geometry of shape 1.
#[track_caller]
fn refused(geometry: GeometryDescription, key: &'static str, says: &str) {
    let mut description = valid();
    description.shapes.push(shape(geometry, None));
    one_problem(&description, Part::Shape(1), Some(key), says);
}

#[test]
fn a_polygon_that_is_not_flat_or_crosses_itself() {
    let [a, b, c, d] = [
        [0.0, 0.0, 2.0],
        [1.0, 0.0, 2.0],
        [1.0, 1.0, 2.1],
        [0.0, 1.0, 2.0],
    ];
    refused(polygon(&[a, b, c, d]), "vertices", "off the plane");
    let c = [1.0, 1.0, 2.0];
    refused(polygon(&[a, c, b, [0.2, 0.8, 2.0]]), "vertices", "cross");
    refused(polygon(&[a, b]), "vertices", "at least 3");
    refused(
        polygon(&[a, b, [f64::NAN, 1.0, 2.0]]),
        "vertices",
        "not finite",
    );
    let hole = GeometryDescription::Polygon {
        vertices: [a, b, c].map(Point::from).to_vec(),
        holes: vec![[a, b].map(Point::from).to_vec()],
    };
    refused(hole, "holes", "hole 1 has 2 vertices");
}

#[test]
fn a_rectangle_without_area_or_place() {
    let edge = Vector::new(0.1, 0.3, 0.7);
    let with = |origin, edges| GeometryDescription::Rectangle { origin, edges };
    refused(
        with(Point::ORIGIN, [edge, edge * 3.0]),
        "edges",
        "neither zero nor parallel",
    );
    let lost = Point::new(0.0, f64::INFINITY, 0.0);
    refused(
        with(lost, [edge, Vector::new(1.0, 0.0, 0.0)]),
        "origin",
        "finite",
    );
}

#[test]
fn a_mesh_without_area_or_with_wrong_numbers() {
    let line = [[0.1, 0.1, 0.1], [0.2, 0.2, 0.2], [0.7, 0.7, 0.7]];
    refused(mesh(&line, &[[0, 1, 2]]), "triangles", "no area");
    refused(mesh(&line, &[]), "triangles", "no area");
    refused(
        mesh(&line, &[[0, 1, 3]]),
        "triangles",
        "triangle 0 of the mesh names a vertex beyond its 3",
    );
    refused(
        mesh(
            &[[0.0; 3], [1.0, 0.0, f64::NAN], [0.0, 1.0, 0.0]],
            &[[0, 1, 2]],
        ),
        "vertices",
        "vertex 1",
    );
}

#[test]
fn discs_and_spheres_of_no_size() {
    let disc = |radius, inner_radius, normal| GeometryDescription::Disc {
        center: Point::ORIGIN,
        normal,
        radius,
        inner_radius,
    };
    let up = Vector::new(0.0, 0.0, 1.0);
    for (radius, inner) in [
        (0.0, 0.0),
        (-1.0, 0.0),
        (1.0, 1.0),
        (1.0, -0.1),
        (f64::NAN, 0.0),
    ] {
        refused(disc(radius, inner, up), "radius", "inner_radius");
    }
    refused(disc(1.0, 0.0, Vector::ZERO), "normal", "not zero");
    for radius in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        refused(sphere([5.0; 3], radius), "radius", "positive");
    }
    refused(sphere([f64::NAN, 0.0, 0.0], 1.0), "center", "finite");
}

#[test]
fn ports_that_overlap_or_are_too_wide() {
    let ports = |half_angles: [f64; 2]| {
        let port = |(half_angle, direction): (f64, Vector)| Port {
            direction,
            half_angle: Angle::from_degrees(half_angle),
        };
        let axes = [Vector::new(2.0, 0.0, 0.0), Vector::new(0.0, 3.0, 0.0)];
        GeometryDescription::Sphere {
            center: Point::new(5.0, 5.0, 5.0),
            radius: 1.0,
            inside: true,
            ports: half_angles.into_iter().zip(axes).map(port).collect(),
        }
    };
    refused(ports([45.0, 46.0]), "ports", "overlap");
    refused(ports([180.0, 10.0]), "ports", "180 deg");
    refused(ports([10.0, 0.0]), "ports", "0 deg");
}

#[test]
fn a_sphere_cannot_be_stretched() {
    let mut description = valid();
    description.shapes.push(ShapeDescription {
        transform: Transform::scale_axes([1.0, 1.0, 2.0]),
        ..shape(sphere([5.0; 3], 1.0), None)
    });
    one_problem(
        &description,
        Part::Shape(1),
        Some("transform"),
        "same factor",
    );
}

fn with_opening(face: &str, rect: [f64; 4]) -> Opening {
    Opening {
        face: face.into(),
        rect,
        material: None,
    }
}

#[test]
fn boxes_inside_out_and_openings_outside_their_face() {
    let room = |openings| GeometryDescription::Box {
        min: Point::new(5.0, 5.0, 5.0),
        max: Point::new(6.0, 7.0, 8.0),
        inside: true,
        faces: vec![],
        openings,
    };
    // Face x- is 2 m × 3 m.
    refused(
        room(vec![with_opening("x-", [0.5, 0.5, 1.6, 1.0])]),
        "openings",
        "face x- does not lie within the face of 2 m × 3 m",
    );
    refused(
        room(vec![with_opening("x-", [0.5, f64::NAN, 1.0, 1.0])]),
        "openings",
        "does not lie",
    );
    refused(
        room(vec![with_opening("walls", [0.5, 0.5, 0.5, 0.5])]),
        "openings",
        "not `walls`",
    );
    let overlapping = [[0.2, 0.5, 0.5, 0.5], [0.4, 0.75, 0.5, 0.5]];
    refused(
        room(overlapping.map(|rect| with_opening("y+", rect)).to_vec()),
        "openings",
        "overlap",
    );
    let inside_out = GeometryDescription::Box {
        min: Point::ORIGIN,
        max: Point::new(1.0, 1.0, 0.0),
        inside: true,
        faces: vec![],
        openings: vec![],
    };
    refused(inside_out, "max", "greater");
}

#[test]
fn an_unknown_face_or_material_of_a_face_is_told_once() {
    let with_face = |face: &str, material: &str| {
        let mut geometry = block(true);
        if let GeometryDescription::Box { faces, .. } = &mut geometry {
            faces.push((face.into(), material.into()));
        }
        let mut description = valid();
        description.shapes.push(shape(geometry, None));
        description
    };
    one_problem(
        &with_face("flor", "grey"),
        Part::Shape(1),
        Some("faces"),
        "not `flor`",
    );
    one_problem(
        &with_face("walls", "gray"),
        Part::Shape(1),
        Some("faces"),
        "there is no material `gray`; the scene defines `grey`",
    );
}

#[test]
fn reflectances_and_names_of_materials() {
    let mut description = valid();
    description.materials[0] = lambertian("grey", 1.2);
    one_problem(
        &description,
        Part::Material(0),
        Some("reflectance"),
        "between 0 and 1, not 1.2",
    );
    let mut description = valid();
    description.materials.push(lambertian("grey", 0.1));
    one_problem(
        &description,
        Part::Material(1),
        None,
        "`grey` is defined twice",
    );
    let mut description = valid();
    description.shapes[0].material = Some("gold".into());
    one_problem(
        &description,
        Part::Shape(0),
        Some("material"),
        "`gold`; the scene defines `grey`",
    );
    description.materials.clear();
    one_problem(
        &description,
        Part::Shape(0),
        Some("material"),
        "defines no materials",
    );
}

fn two_sided(name: &str, front: &str, back: &str) -> MaterialDescription {
    MaterialDescription::new(
        name,
        MaterialModel::TwoSided {
            front: front.into(),
            back: back.into(),
        },
    )
}

#[test]
fn sides_are_materials_with_a_model() {
    let mut description = valid();
    description
        .materials
        .push(two_sided("sheet", "grey", "gray"));
    one_problem(
        &description,
        Part::Material(1),
        Some("back"),
        "no material `gray`",
    );
    description.materials[1] = two_sided("sheet", "grey", "grey");
    description.materials.push(lambertian("white", 0.9));
    description
        .materials
        .push(two_sided("door", "grey", "white"));
    description
        .materials
        .push(two_sided("nested", "door", "grey"));
    one_problem(
        &description,
        Part::Material(4),
        Some("front"),
        "`door` has two sides itself",
    );
    description.materials[4] = two_sided("door", "white", "grey");
    one_problem(
        &description,
        Part::Material(4),
        None,
        "`door` is defined twice",
    );
}

#[test]
fn no_light_and_no_sensor() {
    let mut description = valid();
    description.lights.clear();
    one_problem(&description, Part::Scene, None, "no light");
    let mut description = valid();
    description.sensors.clear();
    one_problem(&description, Part::Scene, None, "no sensor");
    assert!(problems(&description)[0].hint.is_some());
    description.lights.clear();
    assert_eq!(problems(&description).len(), 2);
    assert!(Scene::of_surfaces(&description).is_ok());
}

#[test]
fn lights_without_a_place_a_direction_or_a_possible_power() {
    let watts = |value| Amount::Radiant(Intensity::from_watts_per_steradian(value));
    let refused = |kind, key: &'static str, says: &str| {
        let mut description = valid();
        description.lights.push(light(kind));
        one_problem(&description, Part::Light(1), Some(key), says);
    };
    for value in [-1.0, f64::NAN, f64::INFINITY] {
        refused(point(watts(value)), "intensity", "not negative");
    }
    let lost = LightKind::Point {
        position: Point::new(0.0, f64::NAN, 0.0),
        power: PointPower::Intensity(watts(1.0)),
    };
    refused(lost, "position", "finite");
    let spot = |direction, beam| LightKind::Spot {
        position: Point::new(0.0, 0.0, 1.0),
        direction,
        beam,
        power: PointPower::Intensity(watts(1.0)),
    };
    let (down, degrees) = (Vector::new(0.0, 0.0, -1.0), Angle::from_degrees);
    refused(
        spot(
            Vector::ZERO,
            SpotBeam::Uniform {
                cutoff: degrees(30.0),
            },
        ),
        "direction",
        "not zero",
    );
    for cutoff in [0.0, 1e-9, 181.0, f64::NAN] {
        refused(
            spot(
                down,
                SpotBeam::Uniform {
                    cutoff: degrees(cutoff),
                },
            ),
            "cutoff",
            "180 deg",
        );
    }
    let power = |exponent, cutoff| SpotBeam::CosinePower {
        exponent,
        cutoff: degrees(cutoff),
    };
    refused(spot(down, power(2.0, 91.0)), "falloff", "90 deg");
    refused(
        spot(down, power(-2.0, 45.0)),
        "falloff",
        "positive exponent",
    );
    let cutoff = degrees(30.0);
    refused(
        spot(
            down,
            SpotBeam::Smooth {
                inner: cutoff,
                cutoff,
            },
        ),
        "falloff",
        "inner",
    );
}

#[test]
fn repeats_that_cannot_be() {
    let refused = |count: Vec<u32>, step: Vec<Vector>| {
        let mut description = valid();
        description.shapes[0].repeat = Some(Repeat { count, step });
        one_problem(&description, Part::Shape(0), Some("repeat"), "repeat needs");
    };
    let step = Vector::new(1.0, 0.0, 0.0);
    refused(vec![2, 2], vec![step]);
    refused(vec![0], vec![step]);
    refused(vec![u32::MAX; 3], vec![step; 3]);
    refused(vec![2], vec![step * f64::NAN]);
    let mut description = valid();
    description.lights.push(LightDescription {
        repeat: Some(Repeat {
            count: vec![2],
            step: vec![step],
        }),
        ..light(LightKind::Environment {
            radiance: Amount::Radiant(
                crate::quantity::Radiance::from_watts_per_square_metre_steradian(1.0),
            ),
        })
    });
    one_problem(
        &description,
        Part::Light(1),
        Some("repeat"),
        "infinitely far",
    );
}

#[test]
fn a_plane_has_no_total_flux() {
    let ground = GeometryDescription::Ground { height: -1.0 };
    let mut description = valid();
    description.shapes.push(ShapeDescription {
        emission: Some(EmissionDescription {
            amount: EmissionAmount::Flux(Amount::Radiant(Flux::from_watts(1.0))),
            spectrum: None,
            textures: vec![],
            two_sided: false,
            group: None,
            schedule: None,
        }),
        name: Some("ground".into()),
        ..shape(ground, None)
    });
    one_problem(
        &description,
        Part::Shape(1),
        Some("emission"),
        "radiance or exitance",
    );
    description.shapes[1].emission = None;
    description
        .sensors
        .push(flux_of("ground", FluxOf::Incident));
    one_problem(&description, Part::Sensor(1), Some("shape"), "infinite");
}

fn flux_of(shape: &str, of: FluxOf) -> SensorDescription {
    let surface = FluxSurface::Shape {
        name: shape.into(),
        side: Side::Front,
    };
    sensor("flux", SensorKind::Flux { surface, of })
}

#[test]
fn sensors_on_shapes_that_are_not_there() {
    let mut description = valid();
    description.sensors.push(flux_of("desk", FluxOf::Net));
    one_problem(
        &description,
        Part::Sensor(1),
        Some("shape"),
        "no shape `desk`; no shape has a name",
    );
    description.shapes[0].name = Some("table".into());
    one_problem(
        &description,
        Part::Sensor(1),
        Some("shape"),
        "no shape `desk`; named shapes: `table`",
    );
    description.sensors[1] = sensor(
        "flux",
        SensorKind::Flux {
            surface: FluxSurface::Virtual {
                geometry: square(1.0),
                transform: Transform::IDENTITY,
            },
            of: FluxOf::Absorbed,
        },
    );
    one_problem(
        &description,
        Part::Sensor(1),
        Some("of"),
        "neither absorbs nor emits",
    );
}

#[test]
fn sensors_without_points_or_directions() {
    let refused = |kind, key: &'static str, says: &str| {
        let mut description = valid();
        description.sensors.push(sensor("bad", kind));
        one_problem(&description, Part::Sensor(1), Some(key), says);
    };
    let points = |points| SensorKind::Irradiance(Receivers::Points(points));
    let up = Vector::new(0.0, 0.0, 1.0);
    let lost = Point::new(f64::NAN, 0.0, 0.0);
    refused(points(vec![]), "points", "at least one");
    refused(points(vec![(lost, up)]), "points", "finite");
    refused(
        points(vec![(Point::ORIGIN, Vector::ZERO)]),
        "points",
        "not zero",
    );
    refused(
        SensorKind::ScalarIrradiance { points: vec![lost] },
        "points",
        "finite",
    );
    refused(
        SensorKind::Radiance {
            rays: vec![(lost, up)],
        },
        "rays",
        "finite",
    );
    refused(
        SensorKind::Radiance { rays: vec![] },
        "rays",
        "at least one",
    );
    let grid = |count, normal| {
        SensorKind::Irradiance(Receivers::Grid {
            origin: Point::ORIGIN,
            edges: [Vector::new(1.0, 0.0, 0.0), Vector::new(2.0, 0.0, 0.0)],
            count: GridCount::Given(count),
            border: 0.0,
            normal,
        })
    };
    refused(grid([2, 2], None), "grid", "not zero");
    refused(grid([0, 2], Some(up)), "count", "not 0");
    refused(grid([u32::MAX; 2], Some(up)), "count", "10000000");
}

fn perspective(fov: f64) -> Projection {
    let fov = Angle::from_degrees(fov);
    Projection::Perspective { fov }
}

#[test]
fn projections_without_a_meaning() {
    let refused = |projection, key: &'static str, says: &str| {
        let mut description = valid();
        let camera = CameraDescription {
            position: Point::ORIGIN,
            look_at: Point::new(1.0, 0.0, 0.0),
            up: Vector::new(0.0, 0.0, 1.0),
            projection,
            resolution: [4, 3],
        };
        description
            .sensors
            .push(sensor("eye", SensorKind::Camera(camera)));
        one_problem(&description, Part::Sensor(1), Some(key), says);
    };
    let thin_lens = |aperture_radius, focus_distance| Projection::ThinLens {
        fov: Angle::from_degrees(40.0),
        aperture_radius: Length::from_metres(aperture_radius),
        focus_distance: Length::from_metres(focus_distance),
    };
    let fisheye = |mapping, fov| Projection::Fisheye {
        mapping,
        fov: Angle::from_degrees(fov),
    };
    refused(
        thin_lens(-0.1, 1.0),
        "aperture_radius",
        "above 0, not -0.1 m",
    );
    refused(thin_lens(f64::NAN, 1.0), "aperture_radius", "above 0");
    refused(thin_lens(0.1, 0.0), "focus_distance", "above 0, not 0 m");
    let width = Length::from_metres(f64::INFINITY);
    refused(Projection::Orthographic { width }, "width", "above 0");
    refused(
        fisheye(Fisheye::Equidistant, 361.0),
        "fov",
        "at most 360 deg",
    );
    refused(fisheye(Fisheye::Equisolid, 0.0), "fov", "at most 360 deg");
    refused(
        fisheye(Fisheye::Hemispherical, 181.0),
        "fov",
        "at most 180 deg",
    );
}

#[test]
fn cameras_that_cannot_look() {
    let camera = || CameraDescription {
        position: Point::ORIGIN,
        look_at: Point::new(1.0, 0.0, 0.0),
        up: Vector::new(0.0, 0.0, 1.0),
        projection: perspective(60.0),
        resolution: [4, 3],
    };
    let refused = |camera, key: &'static str| {
        let mut description = valid();
        description
            .sensors
            .push(sensor("eye", SensorKind::Camera(camera)));
        one_problem(&description, Part::Sensor(1), Some(key), "");
    };
    refused(
        CameraDescription {
            projection: perspective(180.0),
            ..camera()
        },
        "fov",
    );
    refused(
        CameraDescription {
            resolution: [0, 3],
            ..camera()
        },
        "resolution",
    );
    refused(
        CameraDescription {
            look_at: Point::ORIGIN,
            ..camera()
        },
        "look_at",
    );
    refused(
        CameraDescription {
            up: Vector::new(-2.0, 0.0, 0.0),
            ..camera()
        },
        "look_at",
    );
}

#[test]
fn two_sensors_of_one_name() {
    let mut description = valid();
    description
        .sensors
        .push(irradiance("desk", [0.1, 0.1, 0.0]));
    one_problem(
        &description,
        Part::Sensor(1),
        Some("name"),
        "`desk` is defined twice",
    );
}

#[test]
fn a_sensor_inside_a_solid() {
    let tetrahedron = mesh(
        &[
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [0.0, 4.0, 0.0],
            [0.0, 0.0, 4.0],
        ],
        &[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    );
    let enclosing = [
        (sphere([0.5, 0.5, 0.4], 0.5), "sphere 1"),
        (block(false), "box 1"),
        (tetrahedron, "mesh 1"),
    ];
    for (geometry, name) in enclosing {
        let mut description = valid();
        description.shapes.push(shape(geometry, None));
        description.sensors = vec![irradiance("desk", [0.5, 0.5, 0.5])];
        one_problem(
            &description,
            Part::Sensor(0),
            Some("points"),
            &format!("sensor `desk` at [0.5, 0.5, 0.5] lies inside the solid `{name}`"),
        );
        assert!(
            problems(&description)[0]
                .hint
                .as_ref()
                .is_some_and(|hint| hint.contains("inside = true"))
        );
    }
}

#[test]
fn a_sensor_in_a_room_or_on_a_solid_is_fine() {
    let mut description = valid();
    description.shapes.push(shape(block(true), None));
    description.sensors = vec![irradiance("desk", [0.5, 0.5, 0.5])];
    scene(&description);
    // A desk whose top is 0.1 + 0.2 high, a little above the sensor at 0.3.
    description.shapes[1] = ShapeDescription {
        transform: Transform::translate(Vector::new(0.0, 0.0, 0.1)),
        ..shape(
            GeometryDescription::Box {
                min: Point::ORIGIN,
                max: Point::new(1.0, 1.0, 0.2),
                inside: false,
                faces: vec![],
                openings: vec![],
            },
            None,
        )
    };
    description.sensors = vec![irradiance("desk", [0.5, 0.5, 0.3])];
    scene(&description);
}

#[test]
fn watts_and_lumens_need_a_stated_link_in_band_total() {
    let lumens = Amount::Photometric(LuminousIntensity::from_candelas(100.0));
    let mut description = valid();
    description.lights.push(light(point(lumens)));
    one_problem(
        &description,
        Part::Sensor(0),
        Some("response"),
        "luminous_efficacy",
    );
    description.luminous_efficacy = Some(100.0);
    assert!(scene(&description).links_watts_and_lumens());
    for invalid in [0.0, -1.0, 684.0, f64::NAN] {
        description.luminous_efficacy = Some(invalid);
        one_problem(
            &description,
            Part::Scene,
            Some("luminous_efficacy"),
            "683 lm/W",
        );
    }
}

#[test]
fn light_needs_a_band_that_carries_it() {
    let mut description = valid();
    description.spectrum = SpectrumMode::Broadband {
        bands: vec!["nir".into()],
    };
    description.response = Response::Photopic;
    one_problem(
        &description,
        Part::Sensor(0),
        Some("response"),
        "no band of this scene carries light",
    );
    description.response = Response::Auto;
    scene(&description);
    description.shapes[0].emission = Some(EmissionDescription {
        amount: EmissionAmount::Exitance(Amount::Photometric(
            LuminousExitance::from_lumens_per_square_metre(1.0),
        )),
        spectrum: None,
        textures: vec![],
        two_sided: false,
        group: None,
        schedule: None,
    });
    let found = problems(&description);
    assert_eq!(
        found[0].place,
        Place {
            part: Part::Shape(0),
            key: Some("emission")
        }
    );
    assert!(
        found[0]
            .message
            .contains("no band of this scene carries light")
    );
}

#[test]
fn wrong_bands_are_told_alone() {
    for bands in [vec![], vec!["a".to_string(), "a".to_string()]] {
        let mut description = valid();
        description.spectrum = SpectrumMode::Broadband { bands };
        one_problem(&description, Part::Scene, Some("spectrum"), "band");
    }
}

#[test]
fn a_radiant_light_needs_its_share_of_each_band() {
    let mut description = valid();
    description.spectrum = SpectrumMode::Broadband {
        bands: vec!["visible".into(), "nir".into()],
    };
    one_problem(
        &description,
        Part::Light(0),
        Some("intensity"),
        "share of its power",
    );
    description.shapes[0].emission = Some(EmissionDescription {
        amount: EmissionAmount::Exitance(Amount::Radiant(Exitance::from_watts_per_square_metre(
            1.0,
        ))),
        spectrum: Some(LaneValues::Bands(vec![("visible".into(), 1.0)])),
        textures: vec![],
        two_sided: false,
        group: None,
        schedule: None,
    });
    let found = problems(&description);
    assert!(
        found[0].message.contains("no value for band `nir`"),
        "{found:?}"
    );
}

#[test]
fn everything_is_told_at_once_and_nothing_twice() {
    let mut description = valid();
    description.materials[0] = lambertian("grey", 1.2);
    description.shapes.push(ShapeDescription {
        name: Some("roof".into()),
        ..shape(sphere([0.0; 3], -1.0), Some("gold"))
    });
    description.shapes.push(shape(block(false), None));
    description.lights = vec![light(point(Amount::Radiant(
        Intensity::from_watts_per_steradian(-1.0),
    )))];
    description.sensors = vec![
        irradiance("desk", [0.5, 0.5, 0.5]),
        irradiance("desk", [0.5, 0.5, 5.0]),
        flux_of("roof", FluxOf::Incident),
    ];
    let found: Vec<Place> = problems(&description)
        .iter()
        .map(|problem| problem.place)
        .collect();
    let expected = [
        (Part::Material(0), "reflectance"),
        (Part::Shape(1), "material"),
        (Part::Shape(1), "radius"),
        (Part::Light(0), "intensity"),
        (Part::Sensor(1), "name"),
        (Part::Sensor(0), "points"),
    ];
    assert_eq!(
        found,
        expected.map(|(part, key)| Place {
            part,
            key: Some(key)
        })
    );
}

/// Three sensors without a place of their own; what has no account is told.
#[test]
fn what_has_no_energy_balance_says_so() {
    let mut description = valid();
    description.sensors = energy_balance();
    assert!(Scene::new(&description).is_ok());
    let glass = &mut description.materials[0];
    glass.media.inside = Some(LaneValues::Uniform(1.0));
    one_problem(
        &description,
        Part::Sensor(1),
        Some("kind"),
        "leave its absorption out",
    );
    description.materials[0].media.inside = None;
    let ground = GeometryDescription::Ground { height: -1.0 };
    description.shapes.push(shape(ground, None));
    one_problem(
        &description,
        Part::Sensor(1),
        Some("kind"),
        "absorbs without end",
    );
}
