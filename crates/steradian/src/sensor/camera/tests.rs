use std::f64::consts::{FRAC_PI_2, PI, TAU};

use proptest::prelude::*;

use super::*;
use crate::geometry::solid_angle;
use crate::quantity::{Angle, Length};

const SIZE: [u32; 2] = [400, 200];

fn degrees(value: f64) -> Angle {
    Angle::from_degrees(value)
}

fn metres(value: f64) -> Length {
    Length::from_metres(value)
}

fn fisheye(mapping: Fisheye, fov: f64) -> Projection {
    let fov = degrees(fov);
    Projection::Fisheye { mapping, fov }
}

/// From (1, 1, 1) along y.
fn camera(projection: Projection, resolution: [u32; 2]) -> Camera {
    let (eye, target) = (Point::new(1.0, 1.0, 1.0), Point::new(1.0, 5.0, 1.0));
    let up = Vector::new(0.0, 0.3, 2.0);
    Camera::new(eye, target, up, projection, resolution).unwrap()
}

fn perspective(fov: f64) -> Projection {
    Projection::Perspective { fov: degrees(fov) }
}

const THIN_LENS: Projection = Projection::ThinLens {
    fov: Angle::from_degrees(60.0),
    aperture_radius: Length::from_metres(0.05),
    focus_distance: Length::from_metres(2.0),
};

fn all() -> Vec<Projection> {
    vec![
        perspective(90.0),
        THIN_LENS,
        Projection::Orthographic { width: metres(3.0) },
        Projection::Panorama,
        fisheye(Fisheye::Equidistant, 180.0),
        fisheye(Fisheye::Equidistant, 360.0),
        fisheye(Fisheye::Equisolid, 220.0),
        fisheye(Fisheye::Hemispherical, 180.0),
        fisheye(Fisheye::Hemispherical, 100.0),
    ]
}

/// Film positions and where they look; x is to the right of a camera that looks along y.
fn assert_looks(projection: Projection, expected: &[([f64; 2], [f64; 3])]) {
    for (film, direction) in expected {
        let (_, found) = camera(projection, SIZE).ray(*film, [0.0; 2]).unwrap();
        let expected = Direction::new(Vector::from(*direction)).unwrap();
        let difference = found.to_vector() - expected.to_vector();
        assert!(
            difference.length() < 1e-15,
            "{projection:?} {film:?}: {found:?}"
        );
    }
}

#[test]
fn a_perspective_looks_along_its_field_of_view_at_the_edges() {
    let expected = [
        ([200.0, 100.0], [0.0, 1.0, 0.0]),
        ([400.0, 100.0], [1.0, 1.0, 0.0]),
        ([0.0, 100.0], [-1.0, 1.0, 0.0]),
        ([200.0, 0.0], [0.0, 1.0, 0.5]),
        ([200.0, 200.0], [0.0, 1.0, -0.5]),
    ];
    assert_looks(perspective(90.0), &expected);
}

#[test]
fn a_panorama_looks_all_around() {
    let expected = [
        ([200.0, 100.0], [0.0, 1.0, 0.0]),
        ([300.0, 100.0], [1.0, 0.0, 0.0]),
        ([100.0, 100.0], [-1.0, 0.0, 0.0]),
        ([400.0, 100.0], [0.0, -1.0, 0.0]),
        ([123.0, 0.0], [0.0, 0.0, 1.0]),
        ([123.0, 200.0], [0.0, 0.0, -1.0]),
        ([200.0, 50.0], [0.0, 1.0, 1.0]),
    ];
    assert_looks(Projection::Panorama, &expected);
}

/// At half the radius of a circle of 180°: 45°, 2 asin(½ sin 45°) and 30° from the axis.
#[test]
fn fisheyes_look_at_the_angle_of_their_radius() {
    let at = |theta: f64| {
        [
            ([250.0, 100.0], [libm::sin(theta), libm::cos(theta), 0.0]),
            ([200.0, 50.0], [0.0, libm::cos(theta), libm::sin(theta)]),
        ]
    };
    assert_looks(fisheye(Fisheye::Equidistant, 180.0), &at(PI / 4.0));
    let theta = 2.0 * libm::asin(0.5 * 0.5_f64.sqrt());
    assert_looks(fisheye(Fisheye::Equisolid, 180.0), &at(theta));
    assert_looks(fisheye(Fisheye::Hemispherical, 180.0), &at(PI / 6.0));
}

#[test]
fn an_orthographic_camera_sends_parallel_rays_from_its_plane() {
    let camera = camera(Projection::Orthographic { width: metres(4.0) }, SIZE);
    for (film, start) in [
        ([0.0, 100.0], [-1.0, 1.0, 1.0]),
        ([300.0, 0.0], [2.0, 1.0, 2.0]),
    ] {
        let (point, direction) = camera.ray(film, [0.0; 2]).unwrap();
        assert!((point - Point::from(start)).length() < 1e-15);
        assert!((direction.to_vector() - Vector::new(0.0, 1.0, 0.0)).length() < 1e-15);
    }
}

proptest! {
    /// Condition: at the rim of 180° hemispherical pictures dr/dθ = cosθ vanishes, so the inverse is taken short of it.
    #[test]
    fn film_positions_come_back(a in -1.0..1.0_f64, b in -1.0..1.0_f64, distance in 0.1..10.0_f64, u in -0.7..0.7_f64, v in -0.7..0.7_f64) {
        for projection in all() {
            let camera = camera(projection, SIZE);
            let film = [200.0 + 199.0 * a, 100.0 + 99.0 * b];
            let Some((start, direction)) = camera.ray(film, [u, v]) else {
                let is_fisheye = matches!(projection, Projection::Fisheye { .. });
                prop_assert!(is_fisheye);
                prop_assert!(libm::hypot(film[0] - 200.0, film[1] - 100.0) > 100.0);
                continue;
            };
            let point = start + direction.to_vector() * distance;
            let Some(found) = camera.film_of(point, [u, v]) else {
                prop_assert!(libm::hypot(film[0] - 200.0, film[1] - 100.0) > 99.999);
                continue;
            };
            for axis in 0..2 {
                prop_assert!((found[axis] - film[axis]).abs() < 1e-8, "{projection:?}: {film:?} {found:?}");
            }
        }
    }
}

#[test]
fn what_is_behind_or_outside_the_circle_is_not_on_the_film() {
    let behind = Point::new(1.0, 0.5, 1.0);
    for projection in [
        perspective(90.0),
        THIN_LENS,
        Projection::Orthographic { width: metres(1.0) },
    ] {
        assert_eq!(camera(projection, SIZE).film_of(behind, [0.0; 2]), None);
    }
    let narrow = camera(fisheye(Fisheye::Equisolid, 90.0), SIZE);
    assert!(
        narrow
            .film_of(Point::new(1.99, 2.0, 1.0), [0.0; 2])
            .is_some()
    );
    assert!(
        narrow
            .film_of(Point::new(2.01, 2.0, 1.0), [0.0; 2])
            .is_none()
    );
    for projection in [Projection::Panorama, fisheye(Fisheye::Equisolid, 360.0)] {
        let camera = camera(projection, SIZE);
        assert!(camera.film_of(behind, [0.0; 2]).is_some());
        assert_eq!(
            camera.film_of(camera.position, [0.0; 2]),
            None,
            "the eye itself"
        );
    }
}

/// ∫ over the unit disc of the density, r = sin ψ to be smooth at a rim where cosθ vanishes; the midpoint rule's error is
/// below (π/2n)² = 2.5e-7 times second derivatives of order 1 to 10.
fn over_circle(camera: &Camera, f: impl Fn(f64) -> f64) -> f64 {
    let steps = 3000;
    let middle = camera.resolution.map(|pixels| 0.5 * f64::from(pixels));
    let radius = middle[0].min(middle[1]);
    let step = FRAC_PI_2 / f64::from(steps);
    let term = |i: i32| {
        let psi = step * (f64::from(i) + 0.5);
        let r = radius * libm::sin(psi);
        f(r / radius)
            * camera
                .solid_angle([middle[0] + r, middle[1]])
                .to_steradians()
            * r
            * radius
            * libm::cos(psi)
    };
    TAU * step * (0..steps).map(term).sum::<f64>()
}

#[test]
fn the_circle_of_a_fisheye_is_its_cap() {
    for mapping in [
        Fisheye::Equidistant,
        Fisheye::Equisolid,
        Fisheye::Hemispherical,
    ] {
        for fov in [5.0, 90.0, 180.0, 270.0, 360.0] {
            if mapping == Fisheye::Hemispherical && fov > 180.0 {
                continue;
            }
            let camera = camera(fisheye(mapping, fov), [301, 500]);
            let exact = solid_angle::of_cap(degrees(fov / 2.0)).to_steradians();
            let found = over_circle(&camera, |_| 1.0);
            assert!(
                (found / exact - 1.0).abs() < 2e-6,
                "{mapping:?} {fov}: {found} {exact}"
            );
        }
    }
}

/// N pixels have their centre in the circle of radius R: |N − πR²| is below the area of the ring of half-diagonals, 2πR/√2 + π/2.
#[test]
fn pixels_of_an_equal_area_fisheye_have_equal_solid_angle() {
    let camera = camera(fisheye(Fisheye::Equisolid, 180.0), [400, 400]);
    let centres = (0..160_000).map(|i| [f64::from(i % 400) + 0.5, f64::from(i / 400) + 0.5]);
    let seen = centres.map(|film| camera.solid_angle(film).to_steradians());
    let seen: Vec<f64> = seen.filter(|&omega| omega > 0.0).collect();
    assert!(seen.iter().all(|omega| (omega - 5e-5).abs() < 1e-18));
    let bound = (TAU * 200.0 * 0.5_f64.sqrt() + FRAC_PI_2) / (PI * 200.0 * 200.0);
    assert!((seen.iter().sum::<f64>() / TAU - 1.0).abs() < bound);
}

/// For 180° it is π sr over the circle, so the mean of a picture times π is the irradiance.
#[test]
fn pixels_of_a_hemispherical_fisheye_have_equal_projected_solid_angle() {
    for (fov, sine) in [(180.0, 1.0), (60.0, 0.5)] {
        let camera = camera(fisheye(Fisheye::Hemispherical, fov), [400, 400]);
        let exact = sine * sine / 40_000.0;
        for film in [[200.0, 200.0], [100.0, 180.0], [201.0, 399.0]] {
            let (_, direction) = camera.ray(film, [0.0; 2]).unwrap();
            let cos_theta = camera.frame().normal().dot(direction.to_vector());
            let projected = camera
                .solid_angle(film)
                .foreshortened(cos_theta)
                .to_steradians();
            assert!((projected / exact - 1.0).abs() < 1e-12, "{fov} {film:?}");
        }
        let total = over_circle(&camera, |r| (1.0 - r * r * sine * sine).sqrt());
        assert!((total / (PI * sine * sine) - 1.0).abs() < 2e-6);
    }
}

/// The midpoint rule over cosβ has the closed form (x/sin x) ∫ cosβ dβ, x = π/2H.
#[test]
fn a_panorama_is_the_sphere() {
    let camera = camera(Projection::Panorama, SIZE);
    let centres = (0..80_000).map(|i| [f64::from(i % 400) + 0.5, f64::from(i / 400) + 0.5]);
    let sum: f64 = centres
        .map(|film| camera.solid_angle(film).to_steradians())
        .sum();
    let x = FRAC_PI_2 / 200.0;
    assert!((sum / (2.0 * TAU) - x / libm::sin(x)).abs() < 1e-12);
}

/// The density has second derivatives below 10 per unit² here, so the midpoint rule is off by less than 10 (2/400)²/12.
#[test]
fn a_perspective_is_its_rectangle() {
    for projection in [perspective(90.0), THIN_LENS] {
        let camera = camera(projection, SIZE);
        let centres = (0..80_000).map(|i| [f64::from(i % 400) + 0.5, f64::from(i / 400) + 0.5]);
        let sum: f64 = centres
            .map(|film| camera.solid_angle(film).to_steradians())
            .sum();
        let corners = [[0.0, 0.0], [0.0, 200.0], [400.0, 200.0], [400.0, 0.0]].map(|film| {
            let (_, direction) = camera.ray(film, [0.0; 2]).unwrap();
            camera.position + direction.to_vector()
        });
        let exact = solid_angle::of_polygon(camera.position, &corners)
            .to_steradians()
            .abs();
        assert!((sum / exact - 1.0).abs() < 2.1e-5, "{sum} {exact}");
    }
    let parallel = camera(Projection::Orthographic { width: metres(3.0) }, SIZE);
    assert_eq!(parallel.solid_angle([1.0, 2.0]), SolidAngle::ZERO);
}

const RIM: [[f64; 2]; 4] = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.6, -0.8]];

#[test]
fn a_lens_is_sharp_where_it_is_focused() {
    let camera = camera(THIN_LENS, SIZE);
    let point = Point::new(1.4, 3.0, 0.9);
    let sharp = camera.film_of(point, [0.0; 2]).unwrap();
    for lens in RIM {
        let found = camera.film_of(point, lens).unwrap();
        assert!((0..2).all(|axis| (found[axis] - sharp[axis]).abs() < 1e-11));
    }
}

/// W A |z − d| / (z d tan(fov/2)) pixels across, anywhere in the picture.
#[test]
fn a_lens_draws_points_out_of_focus_as_discs() {
    let camera = camera(THIN_LENS, SIZE);
    for depth in [0.5, 1.0, 3.0, 20.0_f64] {
        let point = Point::new(1.2, 1.0 + depth, 1.1);
        let middle = camera.film_of(point, [0.0; 2]).unwrap();
        let diameter = 400.0 * 0.05 * (depth - 2.0).abs() / (depth * 2.0 * degrees(30.0).tan());
        for lens in RIM {
            let found = camera.film_of(point, lens).unwrap();
            let radius = libm::hypot(found[0] - middle[0], found[1] - middle[1]);
            assert!(
                (2.0 * radius - diameter).abs() < 1e-11 * diameter,
                "{depth}"
            );
        }
    }
}

#[test]
fn another_resolution_shows_the_same_view() {
    for projection in all() {
        let large = camera(projection, SIZE);
        let small = large.with_resolution([40, 20]);
        let difference = small.ray([17.0, 8.0], [0.1, 0.2]).unwrap().1.to_vector()
            - large.ray([170.0, 80.0], [0.1, 0.2]).unwrap().1.to_vector();
        assert!(difference.length() < 1e-15, "{projection:?}");
    }
}

#[test]
fn a_camera_needs_a_direction_and_an_up() {
    let new = |target, up| Camera::new(Point::ORIGIN, target, up, perspective(60.0), [2, 2]);
    let (x, z) = (Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 0.0, 1.0));
    assert!(new(Point::ORIGIN, z).is_none());
    assert!(new(Point::ORIGIN + x, x * -2.0).is_none());
    assert!(new(Point::ORIGIN + x * f64::NAN, z).is_none());
}

/// Pixels per area are those of a small square that faces the ray, seen through the same place of the lens: to second order in its
/// size, 1e-3 of the distance, which moves the lines of a picture by less than 1e-5 of it.
#[test]
fn a_point_is_seen_as_large_as_a_small_square_around_it() {
    for projection in all() {
        let camera = camera(projection, SIZE);
        for film in [[200.0, 100.0], [170.0, 60.0], [230.0, 130.0]] {
            let lens = [0.3, -0.6];
            let Some((start, direction)) = camera.ray(film, lens) else {
                continue;
            };
            let point = start + direction * 2.5;
            let sight = camera.sight(point, lens).unwrap();
            assert!((sight.from - start).length() < 1e-12, "{projection:?}");
            let frame = Frame::from_normal(direction);
            let at = |offset: Vector| camera.film_of(point + offset, lens).unwrap();
            let edge = |axis: Direction| {
                let (ahead, behind) = (at(axis * 1e-3), at(axis * -1e-3));
                [0, 1].map(|i: usize| (ahead[i] - behind[i]) / 2e-3)
            };
            let [a, b] = [edge(frame.tangent()), edge(frame.bitangent())];
            let exact = (a[0] * b[1] - a[1] * b[0]).abs();
            let off = (sight.pixels_per_area - exact).abs() / exact;
            assert!(off < 1e-5, "{projection:?} {film:?}: {off}");
        }
    }
}

#[test]
fn boxes_beside_and_behind_are_not_seen() {
    let camera = camera(perspective(90.0), SIZE);
    let around = |x: f64, y: f64, z: f64| {
        let (middle, half) = (Point::new(x, y, z), Vector::new(0.2, 0.2, 0.2));
        Bounds::around([middle - half, middle + half])
    };
    for (seen, bounds) in [
        (true, around(1.0, 5.0, 1.0)),
        (true, around(1.0, 1.0, 1.0)),
        (true, around(4.9, 5.0, 1.0)),
        (false, around(5.6, 5.0, 1.0)),
        (false, around(-3.6, 5.0, 1.0)),
        (false, around(1.0, 0.5, 1.0)),
        (false, around(1.0, 5.0, 5.0)),
    ] {
        assert_eq!(camera.may_see(&bounds), seen, "{bounds:?}");
    }
}

/// Beyond its borders a panorama shows the other side, and beyond the poles what is behind them.
#[test]
fn what_a_panorama_repeats_looks_the_same_way() {
    let camera = camera(Projection::Panorama, SIZE);
    let film = [3.0, 1.5];
    let (_, direction) = camera.ray(film, [0.0; 2]).unwrap();
    let repeats: Vec<_> = camera.repeats(film).collect();
    assert_eq!(repeats.len(), 7);
    for place in repeats {
        let (_, other) = camera.ray(place, [0.0; 2]).unwrap();
        let off = (other.to_vector() - direction.to_vector()).length();
        assert!(off < 1e-12, "{place:?}: {off}");
    }
    let flat = super::tests::camera(perspective(90.0), SIZE);
    assert_eq!(flat.repeats(film).collect::<Vec<_>>(), [film]);
}
