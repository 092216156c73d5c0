//! The exchange area by adaptive quadrature of Lambert's configuration factor: another road to the same number.

use super::shapes::Numbers;
use crate::geometry::form_factor::exchange_area_of_polygons;
use crate::geometry::{Point, Polygon, configuration_factor, gauss};

/// Over a triangle, by 8 × 8 nodes.
fn once(f: &dyn Fn(Point) -> f64, [a, b, c]: [Point; 3]) -> f64 {
    let row = |x: f64| gauss::integrate(8, [0.0, 1.0], |y| f(a + ((b - a) + (c - b) * y) * x));
    (b - a).cross(c - a).length() * gauss::integrate(8, [0.0, 1.0], |x| x * row(x))
}

/// By quarters, until these agree with the whole.
fn adaptive(
    f: &dyn Fn(Point) -> f64,
    corners: [Point; 3],
    whole: f64,
    tolerance: f64,
    depth: u32,
) -> f64 {
    let [a, b, c] = corners;
    let [ab, bc, ca] = [a.lerp(b, 0.5), b.lerp(c, 0.5), c.lerp(a, 0.5)];
    let quarters = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]];
    let parts = quarters.map(|quarter| once(f, quarter));
    let sum: f64 = parts.iter().sum();
    if depth == 0 || (sum - whole).abs() < tolerance {
        return sum;
    }
    let deeper = |(quarter, part)| adaptive(f, quarter, part, 0.5 * tolerance, depth - 1);
    quarters.into_iter().zip(parts).map(deeper).sum()
}

fn front_of(outline: &[Point], plane: impl Fn(Point) -> f64) -> Vec<Point> {
    let mut front = Vec::new();
    for (&p, &q) in outline.iter().zip(outline.iter().cycle().skip(1)) {
        let (from, to) = (plane(p), plane(q));
        if from >= 0.0 {
            front.push(p);
        }
        if from * to < 0.0 {
            front.push(p.lerp(q, from / (from - to)));
        }
    }
    front
}

fn exchange_area(a: &Polygon, b: &Polygon, depth: u32) -> f64 {
    let front = front_of(a.outline(), |point| b.normal().dot(point - b.outline()[0]));
    let factor = |x: Point| configuration_factor::of_polygon(x, a.normal(), b.outline());
    let triangle = |edge: &[Point]| {
        let corners = [front[0], edge[0], edge[1]];
        adaptive(&factor, corners, once(&factor, corners), 1e-12, depth)
    };
    front
        .get(1..)
        .map_or(0.0, |rest| rest.windows(2).map(triangle).sum())
}

/// How much the worst of these pairs is off, as a share of the exchange area or of 10⁻³ where that is less.
fn worst(pairs: impl Iterator<Item = u32>, depth: u32) -> f64 {
    let mut numbers = Numbers(0);
    let error = |index| {
        let [a, b] = numbers.pair(index);
        let found = exchange_area_of_polygons(&a, &b).to_square_metres();
        let error = (found - exchange_area(&a, &b, depth)).abs() / found.max(1e-3);
        if error < 1e-9 {
            error
        } else {
            error.min((found - exchange_area(&b, &a, depth)).abs() / found.max(1e-3))
        }
    };
    pairs.map(error).fold(0.0, f64::max)
}

#[test]
fn two_hundred_pairs_apart_crossing_and_touching() {
    // Where polygons touch, the last triangles of side 2⁻⁹ leave the quadrature an error of some 10⁻⁹.
    let worst = worst(0..200, 9);
    assert!(worst < 1e-8, "{worst:e}");
}
