//! Form factors of pairs of unit squares: `cargo bench -p steradian-benches --bench form_factor`.

use divan::{Bencher, black_box};
use steradian::geometry::{Direction, Point, Polygon, Transform, Vector, form_factor};
use steradian::quantity::Angle;

fn main() {
    divan::main();
}

fn polygon(corners: [[f64; 3]; 4]) -> Polygon {
    let outline = corners.map(Point::from).to_vec();
    Polygon::new(outline, vec![]).expect("four corners of a square")
}

fn floor() -> Polygon {
    polygon([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]])
}

fn wall() -> Polygon {
    polygon([[0., 0., 0.], [0., 1., 0.], [0., 1., 1.], [0., 0., 1.]])
}

/// The wall turned so that no edges are parallel or perpendicular, and moved away.
fn skew(distance: f64) -> Polygon {
    let axis = Direction::new(Vector::new(1., 2., 3.)).expect("an axis");
    let turn = Transform::rotate(axis, Angle::from_degrees(20.0), Point::ORIGIN);
    let placed = turn.then(Transform::translate(Vector::new(-distance, 0.3, 0.1)));
    wall().transformed(&placed).expect("a turned square")
}

fn measure(bencher: Bencher<'_, '_>, to: &Polygon) {
    let from = floor();
    bencher.bench_local(|| form_factor::between_polygons(black_box(&from), black_box(to)));
}

#[divan::bench]
fn parallel(bencher: Bencher<'_, '_>) {
    let ceiling = polygon([[0., 0., 1.], [0., 1., 1.], [1., 1., 1.], [1., 0., 1.]]);
    measure(bencher, &ceiling);
}

#[divan::bench]
fn perpendicular(bencher: Bencher<'_, '_>) {
    measure(bencher, &wall());
}

#[divan::bench(args = [0.1, 1.0, 4.0, 100.0])]
fn skew_at(bencher: Bencher<'_, '_>, distance: f64) {
    measure(bencher, &skew(distance));
}
