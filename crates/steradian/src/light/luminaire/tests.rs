use std::f64::consts::PI;

use super::*;
use crate::geometry::Vector;
use crate::light::Planes;

fn direction(x: f64, y: f64, z: f64) -> Direction {
    Direction::new(Vector::new(x, y, z)).unwrap()
}

/// I = 100·(1 + C/180°) in C0 … C180 falls back to 100 at C360; the same at all γ below the horizontal.
fn table() -> Arc<FarField> {
    let values = [100.0, 100.0, 200.0, 200.0, 100.0, 100.0];
    let table = FarField::new(Planes::C, &[0.0, 180.0, 360.0], &[0.0, 90.0], &values);
    Arc::new(table.unwrap())
}

fn lamp(outlet: Outlet, aim: Direction, c0: Direction) -> LuminaireLight {
    LuminaireLight {
        position: Point::new(0.0, 0.0, 2.0),
        frame: Frame::from_normal_and_tangent(-aim, c0.to_vector()).unwrap(),
        far_field: table(),
        unit: [0.5; MAX_LANES].map(Intensity::from_watts_per_steradian),
        opening: Opening::Point,
        outlet,
    }
}

fn point() -> Outlet {
    Outlet::Point {
        end: Point::new(0.0, 0.0, 2.0),
    }
}

fn first(lanes: [Intensity; MAX_LANES]) -> f64 {
    lanes[0].to_watts_per_steradian()
}

/// Mean of I over all C is 150, so Φ = k · 150 · 2π.
#[test]
fn flux_is_that_of_the_table() {
    let lamp = lamp(point(), -Direction::Z, Direction::X);
    assert!((lamp.flux()[0].to_watts() / (0.5 * 150.0 * 2.0 * PI) - 1.0).abs() < 1e-14);
}

/// Aimed along +x with C0 up, C90 is where (−aim) × C0 = (−x) × z = +y: I there is 150, half as many W/sr.
#[test]
fn a_turned_luminaire_shines_where_its_axes_say() {
    let turned = lamp(point(), Direction::X, Direction::Z);
    assert_eq!(turned.aim(), Direction::X);
    for (away, expected) in [
        (direction(1.0, 0.0, 1.0), 50.0),
        (direction(1.0, 1.0, 0.0), 75.0),
        (direction(1.0, 0.0, -1.0), 100.0),
        (direction(1.0, -1.0, 0.0), 75.0),
        (direction(-1.0, 0.1, 0.0), 0.0),
    ] {
        let found = first(turned.intensity(away));
        assert!((found - expected).abs() < 1e-12, "{away:?}: {found}");
    }
}

/// E_n = k I/r²: towards C0 at γ = 45° from a height of 2 m, r² = 8.
#[test]
fn a_point_obeys_the_inverse_square_law() {
    let lamp = lamp(point(), -Direction::Z, Direction::X);
    let no_form = |_| -> &Form { unreachable!() };
    let sample = lamp.incident(Point::new(2.0, 0.0, 0.0), [0.0; 2], no_form);
    let sample = sample.unwrap();
    let expected = 0.5 * 100.0 / 8.0;
    assert!((sample.normal_irradiance[0].to_watts_per_square_metre() - expected).abs() < 1e-13);
    assert_eq!(sample.density, Density::Delta);
    assert!(
        lamp.incident(Point::new(0.0, 1.0, 3.0), [0.0; 2], no_form)
            .is_none()
    );
}

/// From far away every sample of an opening has I cosθ/r² to the square of its size over the distance.
#[test]
fn from_afar_an_opening_is_a_point() {
    for opening in [
        Opening::Box {
            width: 0.1,
            length: 0.2,
            height: 0.0,
        },
        Opening::Ellipsoid {
            diameters: [0.1; 3],
        },
    ] {
        let frame = Frame::WORLD;
        let body = Body::new(&opening, Point::new(0.0, 0.0, 2.0), &frame).unwrap();
        let surface = Outlet::Surface {
            shape: ShapeId(0),
            two_sided: body.two_sided,
            extent: body.extent,
        };
        let lamp = lamp(surface, -Direction::Z, Direction::X);
        let far = Point::new(300.0, 400.0, -500.0);
        let count = 4096;
        let mut sum = 0.0;
        for i in 0..count {
            let u = (f64::from(i) + 0.5) / f64::from(count);
            let v = libm::fmod(f64::from(i) * 0.618_033_988_749_895, 1.0);
            let sample = lamp.incident(far, [u, v], |_| &body.form);
            sum += sample.map_or(0.0, |sample| {
                sample.normal_irradiance[0].to_watts_per_square_metre()
            });
        }
        let position = Point::new(0.0, 0.0, 2.0);
        let intensity = first(lamp.intensity(Direction::new(far - position).unwrap()));
        let expected = intensity / (far - position).dot(far - position);
        let found = sum / f64::from(count);
        // Stratified samples of a sphere's hidden half: the rest is its noise.
        assert!(
            (found / expected - 1.0).abs() < 2e-3,
            "{opening:?} {found} {expected}"
        );
    }
}
