use std::f64::consts::{FRAC_PI_3, PI, SQRT_2, TAU};

use super::*;
use crate::geometry::{Frame, Vector, configuration_factor, solid_angle};
use crate::quantity::{Area, Intensity, Length};
use crate::sampling::testing::{assert_mean, independent};
use crate::shape::{Disc, Parallelogram, ShapeId, Sphere, SpherePort, TriangleMesh};

/// Radiance of every test light in its first lane.
const RADIANCE: f64 = 3.0;

fn light(kind: Kind) -> Light {
    Light {
        name: "lamp".into(),
        group: 2,
        spectrum: None,
        kind,
    }
}

fn no_form(_: ShapeId) -> &'static Form {
    unreachable!("a light without extent has no form")
}

fn lanes<Q>(value: impl Fn(f64) -> Q) -> [Q; MAX_LANES] {
    [1.0, 2.0, 0.0, 0.0].map(value)
}

fn direction(x: f64, y: f64, z: f64) -> Direction {
    Direction::new(Vector::new(x, y, z)).unwrap()
}

fn point_light() -> Light {
    light(Kind::Point(PointLight {
        position: Point::new(0.0, 0.0, 1.0),
        intensity: lanes(|lane| Intensity::from_watts_per_steradian(100.0 * lane)),
    }))
}

fn first(quantities: [Irradiance; MAX_LANES]) -> f64 {
    quantities[0].to_watts_per_square_metre()
}

#[test]
fn the_irradiance_of_a_point_light_falls_with_the_square_and_the_cosine() {
    let at =
        |x: f64| point_light().sample(Point::new(x, 0.0, 0.0), Direction::Z, [0.0; 2], no_form);
    let below = at(0.0).unwrap();
    assert_eq!(
        (first(below.irradiance), below.distance, below.group),
        (100.0, 1.0, 2)
    );
    assert_eq!(
        (below.direction, below.density),
        (Direction::Z, Density::Delta)
    );
    let beside = at(1.0).unwrap();
    assert!((first(beside.normal_irradiance) - 50.0).abs() < 1e-13);
    assert!((first(beside.irradiance) - 25.0 * SQRT_2).abs() < 1e-13);
    assert_eq!(
        beside.irradiance[1].to_watts_per_square_metre(),
        2.0 * first(beside.irradiance)
    );
}

#[test]
fn a_receiver_that_looks_away_gets_nothing() {
    let sample = point_light()
        .sample(Point::ORIGIN, -Direction::Z, [0.0; 2], no_form)
        .unwrap();
    assert_eq!(
        (first(sample.irradiance), first(sample.normal_irradiance)),
        (0.0, 100.0)
    );
    let inside = Point::new(0.0, 0.0, 1.0);
    assert_eq!(
        point_light().sample(inside, Direction::Z, [0.0; 2], no_form),
        None
    );
}

/// ∫ E_n r² dω over the sphere of receivers, which face the light: midpoint rule in cosθ and φ about the light's axis.
fn flux_by_quadrature(light: &Light, position: Point, axis: Direction, cells: u32) -> f64 {
    let (radius, frame) = (3.0, Frame::from_normal(axis));
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(cells);
    let intensity = |i: u32, j: u32| {
        let (cos, phi) = (2.0 * at(i) - 1.0, TAU * at(j));
        let sin = (1.0 - cos * cos).sqrt();
        let outwards = frame.to_world(direction(sin * libm::cos(phi), sin * libm::sin(phi), cos));
        let receiver = position + outwards.to_vector() * radius;
        let sample = light.sample(receiver, -outwards, [0.0; 2], no_form);
        sample.map_or(0.0, |sample| first(sample.irradiance) * radius * radius)
    };
    let rows = (0..cells).flat_map(|i| (0..4).map(move |j| (i, j * cells / 4)));
    let sum: f64 = rows.map(|(i, j)| intensity(i, j)).sum();
    2.0 * TAU * sum / f64::from(4 * cells)
}

#[test]
fn the_flux_of_a_point_light_is_the_integral_of_its_intensity() {
    let Kind::Point(inner) = &point_light().kind else {
        unreachable!()
    };
    let position = inner.position;
    let flux = inner.flux()[0].to_watts();
    assert!((flux - 400.0 * PI).abs() < 1e-10);
    let integral = flux_by_quadrature(&point_light(), position, Direction::X, 64);
    assert!((integral / flux - 1.0).abs() < 1e-13);
}

/// The midpoint rule is off by at most (2/n)·variation/∫f in cosθ: 2e-3/.15 for the narrowest beam.
#[test]
fn the_flux_of_a_spot_is_the_integral_of_its_intensity() {
    let cos = libm::cos;
    let beams = [
        Beam::Uniform {
            cos_cutoff: cos(FRAC_PI_3),
        },
        Beam::Uniform { cos_cutoff: -1.0 },
        Beam::CosinePower {
            exponent: 2.0,
            cos_cutoff: 0.0,
        },
        Beam::Smooth {
            cos_inner: cos(0.4),
            cos_cutoff: cos(0.6),
        },
    ];
    for beam in beams {
        let spot = SpotLight {
            position: Point::new(1.0, -2.0, 4.0),
            axis: direction(1.0, 2.0, -2.0),
            beam,
            peak_intensity: lanes(|lane| Intensity::from_watts_per_steradian(5.0 * lane)),
        };
        let (position, axis) = (spot.position, spot.axis);
        let flux = spot.flux()[0].to_watts();
        let integral = flux_by_quadrature(&light(Kind::Spot(spot)), position, axis, 1000);
        assert!(
            (integral / flux - 1.0).abs() < 1e-2,
            "{beam:?}: {integral} {flux}"
        );
    }
}

#[test]
fn a_spot_of_180_degrees_is_a_point_light() {
    let axis = direction(0.36, 0.48, 0.8);
    let spot = light(Kind::Spot(SpotLight {
        position: Point::ORIGIN,
        axis,
        beam: Beam::Uniform { cos_cutoff: -1.0 },
        peak_intensity: lanes(Intensity::from_watts_per_steradian),
    }));
    for k in 1..1000 {
        let behind = Point::ORIGIN - axis * f64::from(k);
        assert!(spot.sample(behind, axis, [0.0; 2], no_form).is_some());
    }
}

#[test]
fn outside_its_beam_a_spot_gives_nothing() {
    let spot = light(Kind::Spot(SpotLight {
        position: Point::new(0.0, 0.0, 1.0),
        axis: -Direction::Z,
        beam: Beam::Uniform { cos_cutoff: 0.8 },
        peak_intensity: lanes(Intensity::from_watts_per_steradian),
    }));
    let at = |x: f64| spot.sample(Point::new(x, 0.0, 0.0), Direction::Z, [0.0; 2], no_form);
    // tan of the cutoff is ¾.
    assert!(at(0.74).is_some() && at(0.76).is_none());
}

#[test]
fn a_directional_light_is_foreshortened_and_does_not_fall_off() {
    let sun = light(Kind::Directional {
        direction: direction(0.0, 0.6, -0.8),
        irradiance: lanes(|lane| Irradiance::from_watts_per_square_metre(100.0 * lane)),
    });
    for z in [0.0, -1e6] {
        let sample = sun
            .sample(Point::new(0.0, 0.0, z), Direction::Z, [0.0; 2], no_form)
            .unwrap();
        assert_eq!(sample.direction, direction(0.0, -0.6, 0.8));
        assert_eq!(
            (sample.distance, sample.density),
            (f64::INFINITY, Density::Delta)
        );
        assert_eq!(first(sample.normal_irradiance), 100.0);
        assert!((first(sample.irradiance) - 80.0).abs() < 1e-13);
    }
}

#[test]
fn lights_without_extent_are_known() {
    let dark = light(Kind::Environment {
        radiance: lanes(Radiance::from_watts_per_square_metre_steradian),
    });
    assert!(point_light().is_delta() && !dark.is_delta() && !area_light(false).is_delta());
    assert_eq!(
        dark.sample(Point::ORIGIN, Direction::Z, [0.5; 2], no_form),
        None
    );
}

fn area_light(two_sided: bool) -> Light {
    light(Kind::Area(AreaLight {
        shape: ShapeId(0),
        radiance: lanes(|lane| Radiance::from_watts_per_square_metre_steradian(RADIANCE * lane)),
        textures: vec![],
        two_sided,
    }))
}

/// E of each of 16384 independent samples at the origin.
fn irradiances(form: &Form, two_sided: bool, point: Point, normal: Direction) -> Vec<f64> {
    let light = area_light(two_sided);
    let irradiance = |u| {
        let sample = light.sample(point, normal, u, |_| form);
        sample.map_or(0.0, |sample| first(sample.irradiance))
    };
    independent(1, 16_384).map(irradiance).collect()
}

fn rectangle() -> Parallelogram {
    let edges = [Vector::new(0.0, 2.0, 0.0), Vector::new(1.0, 0.0, 0.5)];
    Parallelogram::new(Point::new(0.2, -1.0, 1.0), edges).unwrap()
}

#[test]
fn a_rectangle_gives_the_closed_form_on_its_front_only() {
    let outline = rectangle().corners();
    let form = Form::Parallelogram(rectangle());
    let normal = direction(0.3, 0.1, 1.0);
    let exact = PI * RADIANCE * configuration_factor::of_polygon(Point::ORIGIN, normal, &outline);
    assert_mean(
        &irradiances(&form, false, Point::ORIGIN, normal),
        exact,
        0.0,
    );
    assert_mean(&irradiances(&form, true, Point::ORIGIN, normal), exact, 0.0);
    let (above, down) = (Point::new(0.7, 0.0, 3.0), -Direction::Z);
    let exact = PI * RADIANCE * configuration_factor::of_polygon(above, down, &outline);
    assert_mean(&irradiances(&form, true, above, down), exact, 0.0);
    assert_eq!(irradiances(&form, false, above, down), vec![0.0; 16_384]);
}

#[test]
fn a_mesh_gives_what_its_outline_gives() {
    let outline = rectangle().corners();
    let mesh = TriangleMesh::new(outline.to_vec(), vec![[0, 1, 2], [0, 2, 3]]);
    let exact =
        PI * RADIANCE * configuration_factor::of_polygon(Point::ORIGIN, Direction::Z, &outline);
    assert_mean(
        &irradiances(&Form::Mesh(mesh), false, Point::ORIGIN, Direction::Z),
        exact,
        0.0,
    );
}

/// Coaxial: F = R²/(R² + h²), here less that of the hole.
#[test]
fn an_annulus_gives_the_difference_of_two_discs() {
    let annulus = Form::Disc(Disc {
        center: Point::new(0.0, 0.0, 1.0),
        normal: -Direction::Z,
        radius: 2.0,
        inner_radius: 0.5,
    });
    let exact = PI * RADIANCE * (4.0 / 5.0 - 0.25 / 1.25);
    assert_mean(
        &irradiances(&annulus, false, Point::ORIGIN, Direction::Z),
        exact,
        0.0,
    );
}

fn sphere(inside: bool, ports: Vec<SpherePort>) -> Form {
    Form::Sphere(Sphere {
        center: Point::new(0.0, 1.0, 2.0),
        radius: 1.5,
        inside,
        ports,
    })
}

#[test]
fn a_sphere_gives_the_closed_form_also_where_the_horizon_cuts_it() {
    let center = Point::new(0.0, 1.0, 2.0);
    for normal in [
        direction(0.0, 1.0, 2.0),
        Direction::Y,
        direction(1.0, 0.2, 0.1),
    ] {
        let factor = configuration_factor::of_sphere(
            Point::ORIGIN,
            normal,
            center,
            Length::from_metres(1.5),
        );
        let found = irradiances(&sphere(false, vec![]), false, Point::ORIGIN, normal);
        assert_mean(&found, PI * RADIANCE * factor, 1e-12);
    }
    assert_eq!(
        irradiances(&sphere(true, vec![]), false, Point::ORIGIN, Direction::Z),
        vec![0.0; 16_384]
    );
}

/// Within a sphere of radiance L the irradiance is πL everywhere.
#[test]
fn a_sphere_that_shines_inwards_is_a_furnace() {
    let within = Point::new(0.3, 0.8, 2.5);
    for normal in [Direction::X, direction(1.0, 2.0, -3.0)] {
        assert_mean(
            &irradiances(&sphere(true, vec![]), false, within, normal),
            PI * RADIANCE,
            0.0,
        );
    }
    assert_eq!(
        irradiances(&sphere(false, vec![]), false, within, Direction::X),
        vec![0.0; 16_384]
    );
}

/// The middle of the sphere sees the port of half angle a as the projected solid angle π sin²a.
#[test]
fn a_port_takes_its_projected_solid_angle_away() {
    let port = SpherePort {
        direction: Direction::Z,
        cos_half_angle: 0.8,
    };
    let middle = Point::new(0.0, 1.0, 2.0);
    let found = irradiances(&sphere(true, vec![port]), false, middle, Direction::Z);
    assert_mean(&found, PI * RADIANCE * (1.0 - 0.36), 0.0);
}

#[test]
fn the_cone_of_a_sphere_is_sampled_evenly_and_ends_on_its_near_side() {
    let center = Point::new(0.0, 1.0, 2.0);
    let expected = solid_angle::of_sphere(Point::ORIGIN, center, Length::from_metres(1.5));
    let (light, form) = (area_light(false), sphere(false, vec![]));
    let mut mean = Vector::ZERO;
    for u in independent(3, 4096) {
        let sample = light
            .sample(Point::ORIGIN, Direction::Z, u, |_| &form)
            .unwrap();
        let Density::SolidAngle(density) = sample.density else {
            panic!("{sample:?}")
        };
        assert!((density * expected.to_steradians() - 1.0).abs() < 1e-13);
        let outwards = Point::ORIGIN + sample.direction * sample.distance - center;
        assert!((outwards.length() - 1.5).abs() < 1e-7);
        assert!(sample.direction.dot(outwards) < 1e-7);
        mean += sample.direction.to_vector() / 4096.0;
    }
    // The mean direction of a cone is its axis, (1 + cosθ)/2 long; off axis σ < sinθ/(2√4096) = .0053.
    let cos_max = (1.0 - 2.25 / 5.0_f64).sqrt();
    let axis = direction(0.0, 1.0, 2.0).to_vector() * (0.5 * (1.0 + cos_max));
    assert!((mean - axis).length() < 6.0 * 0.0053 * SQRT_2);
}

/// E[1/p] is the solid angle that is seen.
#[test]
fn densities_are_in_solid_angle() {
    let form = Form::Parallelogram(rectangle());
    let light = area_light(false);
    let inverse = |u| match light
        .sample(Point::ORIGIN, Direction::Z, u, |_| &form)?
        .density
    {
        Density::SolidAngle(density) => Some(1.0 / density),
        Density::Delta => None,
    };
    let samples: Vec<f64> = independent(4, 16_384).filter_map(inverse).collect();
    assert_eq!(samples.len(), 16_384);
    let exact = solid_angle::of_polygon(Point::ORIGIN, &rectangle().corners());
    assert_mean(&samples, exact.to_steradians(), 0.0);
}

#[test]
fn both_sides_of_a_light_add_to_its_flux() {
    let flux = |two_sided| {
        let Kind::Area(light) = area_light(two_sided).kind else {
            unreachable!()
        };
        light
            .flux(Area::from_square_metres(2.0))
            .map(|lane| lane.to_watts())
    };
    assert!((flux(false)[0] - 2.0 * PI * RADIANCE).abs() < 1e-13);
    assert_eq!(flux(true), flux(false).map(|lane| 2.0 * lane));
}
