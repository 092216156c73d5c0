//! Glare of three pictures, as Radiance's evalglare 3.06 finds it; `benchmarks/radiance/evalglare_dgp.py` makes the same ones.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use std::path::Path;

use steradian::geometry::{Direction, Point, Vector};
use steradian::glare::{Assessment, Detection, FieldOfView};
use steradian::sensor::Camera;
use steradian_io::files::MemoryFiles;
use steradian_io::import::luminance_map;

const SIZE: u32 = 160;
const DIM: f64 = 160.5 / 256.0;
const GREY: f64 = 200.5 / 128.0;
const BRIGHT: f64 = 224.5 / 8.0;
const SUN: f64 = 150.5 * 8.0;

/// Ahead is x, left is y, up is z; angles in degrees.
fn towards(azimuth: f64, elevation: f64) -> Vector {
    let [(sin, cos), (up, along)] =
        [azimuth, elevation].map(|angle| libm::sincos(angle.to_radians()));
    Vector::new(along * cos, along * sin, up)
}

fn degrees_between(a: Vector, b: Vector) -> f64 {
    libm::acos(a.dot(b).clamp(-1.0, 1.0)).to_degrees()
}

fn window(d: Vector) -> f64 {
    let azimuth = libm::atan2(d.y, d.x).to_degrees();
    let elevation = libm::asin(d.z).to_degrees();
    if azimuth > 5.0 && azimuth < 40.0 && elevation > -5.0 && elevation < 30.0 {
        return BRIGHT;
    }
    if d.z > 0.0 { GREY } else { DIM }
}

fn sun(d: Vector) -> f64 {
    if degrees_between(d, towards(20.0, 15.0)) < 3.0 {
        SUN
    } else {
        window(d)
    }
}

fn lamps(d: Vector) -> f64 {
    let places = [
        (-35.0, 30.0),
        (-12.0, 25.0),
        (12.0, 25.0),
        (35.0, 30.0),
        (10.0, -35.0),
    ];
    let lit =
        |(azimuth, elevation): &(f64, f64)| degrees_between(d, towards(*azimuth, *elevation)) < 4.0;
    if places.iter().any(lit) { BRIGHT } else { DIM }
}

/// A pixel of the format whose value is exact.
fn rgbe(value: f64) -> [u8; 4] {
    let (mantissa, exponent) = libm::frexp(value);
    let m = (mantissa * 256.0) as u8;
    [m, m, m, (exponent + 128) as u8]
}

/// The file, with a view of 180° of Radiance's kind.
fn file(kind: char, value: fn(Vector) -> f64) -> Vec<u8> {
    let header = format!(
        "#?RADIANCE\nVIEW= -vt{kind} -vh 180 -vv 180\nFORMAT=32-bit_rle_rgbe\n\n-Y {SIZE} +X {SIZE}\n"
    );
    let mut bytes = header.into_bytes();
    for pixel in 0..SIZE * SIZE {
        let side = |place: u32| f64::from(2 * place + 1) / f64::from(SIZE) - 1.0;
        let [right, down] = [side(pixel % SIZE), side(pixel / SIZE)];
        let r = libm::hypot(right, down);
        let theta = match kind {
            'a' => r * std::f64::consts::FRAC_PI_2,
            _ => libm::asin(r.min(1.0)),
        };
        let across = libm::sin(theta) / r;
        let direction = Vector::new(libm::cos(theta), -right * across, -down * across);
        bytes.extend(if r > 1.0 {
            [0; 4]
        } else {
            rgbe(value(direction))
        });
    }
    bytes
}

fn assess(kind: char, value: fn(Vector) -> f64) -> Assessment {
    let files = MemoryFiles::default().with("a.hdr", file(kind, value));
    let map = luminance_map::read(Path::new("a.hdr"), &files).unwrap();
    let up = Vector::new(0.0, 0.0, 1.0);
    let ahead = Point::new(1.0, 0.0, 0.0);
    let camera = Camera::new(Point::ORIGIN, ahead, up, map.projection.unwrap(), map.size).unwrap();
    let view = FieldOfView::new(&camera, &map.luminances, None).unwrap();
    view.assess(&Detection::default())
}

/// A name, the kind of view, the picture, what evalglare finds, and how many sources.
type Case = (&'static str, char, fn(Vector) -> f64, [f64; 4], usize);

/// E_v, DGP, UGR, DGI and the number of sources. evalglare takes directions half a pixel aside of the middles of pixels, .6° here, which is up to 2 % of a
/// position index and .2 of UGR; it leaves out pixels on the rim, a part in 80 of a hemispherical picture.
#[test]
fn evalglare_finds_the_same() {
    let cases: [Case; 3] = [
        (
            "window",
            'a',
            window,
            [2139.65, 0.325938, 29.2210, 22.8564],
            1,
        ),
        ("sun", 'a', sun, [3708.11, 0.504844, 41.7267, 30.1191], 2),
        (
            "lamps",
            'h',
            lamps,
            [645.017, 0.233525, 22.3517, 19.6968],
            5,
        ),
    ];
    for (name, kind, value, [eye, probability, rating, index], count) in cases {
        let found = assess(kind, value);
        assert_eq!(found.sources.len(), count, "{name}");
        let near = |found: f64, expected: f64, tolerance: f64| {
            assert!(
                (found - expected).abs() < tolerance,
                "{name}: {found}, {expected}"
            );
        };
        near(found.illuminance.value / eye, 1.0, 0.01);
        near(found.daylight_glare_probability.value, probability, 0.005);
        near(found.unified_glare_rating.unwrap().value, rating, 0.2);
        near(found.daylight_glare_index.unwrap(), index, 0.2);
    }
}

/// A source's direction is told in the picture's own frame.
#[test]
fn sources_stand_where_they_were_drawn() {
    let found = assess('a', sun);
    let expected = Direction::new(towards(20.0, 15.0)).unwrap();
    let brightest = found.sources.iter().max_by(|a, b| {
        a.greatest
            .to_candelas_per_square_metre()
            .total_cmp(&b.greatest.to_candelas_per_square_metre())
    });
    assert!(brightest.unwrap().direction.dot(expected) > libm::cos(0.005));
}
