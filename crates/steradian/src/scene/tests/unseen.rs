use super::*;
use crate::quantity::{Irradiance, Radiance};
use crate::shape::Side;

fn sun() -> LightDescription {
    let irradiance = Irradiance::from_watts_per_square_metre(800.0);
    light(LightKind::Directional {
        direction: Vector::new(0.0, 0.1, -1.0),
        irradiance: Amount::Radiant(irradiance),
    })
}

fn lamp() -> LightDescription {
    light(point(Amount::Radiant(Intensity::from_watts_per_steradian(
        1.0,
    ))))
}

/// A square of this side that emits, at a place.
fn panel(side: f64, at: [f64; 3]) -> ShapeDescription {
    let radiance = Radiance::from_watts_per_square_metre_steradian(1.0);
    ShapeDescription {
        transform: Transform::translate(Vector::from(at)),
        emission: Some(EmissionDescription {
            amount: EmissionAmount::Radiance(Amount::Radiant(radiance)),
            spectrum: None,
            textures: vec![],
            two_sided: false,
            group: None,
            schedule: None,
        }),
        ..shape(square(side), None)
    }
}

/// A room from the origin to (1, 2, 3) with a meter in it.
fn room() -> SceneDescription {
    SceneDescription {
        shapes: vec![shape(block(true), Some("grey"))],
        sensors: vec![irradiance("desk", [0.5, 0.5, 0.8])],
        ..valid()
    }
}

/// Names and sides of the lights that are found to be unseen.
fn unseen(description: &SceneDescription) -> Vec<(String, Side)> {
    let scene = Scene::new(description).unwrap();
    let name = |light: usize| scene.lights()[light].name.clone();
    let found = scene.unseen_lights().into_iter();
    found.map(|one| (name(one.light), one.side)).collect()
}

#[test]
fn a_sun_outside_a_closed_room_is_unseen() {
    let mut scene = room();
    scene.lights = vec![lamp(), sun()];
    assert_eq!(unseen(&scene), [("light 1".to_owned(), Side::Outside)]);
    scene.sensors[0] = irradiance("floor", [0.5, 0.5, 0.0]);
    assert_eq!(unseen(&scene).len(), 1, "a meter on the wall of the room");
}

#[test]
fn nothing_is_said_where_light_may_pass() {
    let mut open = room();
    open.lights = vec![sun()];
    let mut pane = open.clone();
    let mut both = open.clone();
    if let GeometryDescription::Box { openings, .. } = &mut open.shapes[0].geometry {
        openings.push(Opening {
            face: "x+".into(),
            rect: [0.5, 0.5, 0.1, 0.1],
            material: None,
        });
    }
    assert_eq!(unseen(&open), []);
    pane.materials[0].opacity = Some(Opacity {
        factor: 0.5,
        textures: vec![],
        cutoff: None,
    });
    assert_eq!(unseen(&pane), []);
    both.sensors.push(irradiance("roof", [0.5, 0.5, 3.2]));
    assert_eq!(unseen(&both), []);
}

#[test]
fn a_lamp_within_a_box_is_unseen_unless_it_sticks_out() {
    let mut scene = valid();
    scene.lights.clear();
    scene.shapes.push(shape(block(false), Some("grey")));
    scene.shapes.push(panel(0.5, [0.2, 0.2, 1.0]));
    scene.sensors = vec![irradiance("desk", [-1.0, 0.5, 1.0])];
    assert_eq!(unseen(&scene), [("rectangle 2".to_owned(), Side::Inside)]);
    scene.shapes[2] = panel(0.9, [0.2, 0.2, 1.0]);
    assert_eq!(unseen(&scene), []);
}

#[test]
fn a_box_that_shines_is_seen() {
    let mut scene = valid();
    scene.lights.clear();
    scene.shapes.push(ShapeDescription {
        geometry: block(false),
        transform: Transform::translate(Vector::new(3.0, 0.0, 0.0)),
        ..panel(1.0, [0.0; 3])
    });
    assert_eq!(unseen(&scene), []);
    assert_eq!(unseen(&valid()), []);
}

/// The plane of an orthographic camera, or a lens, may reach out of the room whose middle it is in.
#[test]
fn cameras_start_all_over_their_lens() {
    let camera = |projection| {
        let camera = CameraDescription {
            position: Point::new(0.5, 1.0, 1.5),
            look_at: Point::new(0.5, 1.0, 0.0),
            up: Vector::new(0.0, 1.0, 0.0),
            projection,
            resolution: [8, 8],
        };
        let mut scene = room();
        scene.lights = vec![sun()];
        scene.sensors = vec![sensor("eye", SensorKind::Camera(camera))];
        unseen(&scene).len()
    };
    let width = crate::quantity::Length::from_metres;
    let lens = |radius| Projection::ThinLens {
        fov: Angle::from_degrees(40.0),
        aperture_radius: width(radius),
        focus_distance: width(1.0),
    };
    assert_eq!(camera(Projection::Panorama), 1);
    assert_eq!(camera(Projection::Orthographic { width: width(0.5) }), 1);
    assert_eq!(camera(Projection::Orthographic { width: width(3.0) }), 0);
    assert_eq!((camera(lens(0.1)), camera(lens(0.6))), (1, 0));
}
