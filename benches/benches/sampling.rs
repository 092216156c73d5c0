//! Nanoseconds a sample of the samplers by solid angle: `cargo bench -p steradian-benches --bench sampling`.
//!
//! *one* prepares the shape for a receiver and draws one sample, as on a surface of receivers; *many* draws 1024 samples for one
//! receiver, whose time is divided by their number, as at a point.

use divan::Bencher;
use divan::counter::ItemsCount;
use steradian::geometry::Vector;
use steradian::sampling::block;
use steradian::sampling::projected_cap::ProjectedCap;
use steradian::sampling::projected_polygon::ProjectedPolygon;
use steradian::sampling::spherical_rectangle::SphericalRectangle;
use steradian::sampling::spherical_triangle::SphericalTriangle;

const MANY: u32 = 1024;

fn main() {
    divan::main();
}

/// Beside the receiver's normal, and beyond its horizon if `cut`.
fn corners(cut: bool) -> [Vector; 4] {
    let low = if cut { -0.5 } else { 0.2 };
    [
        [1.0, -0.5, low],
        [1.0, 0.7, low],
        [1.0, 0.7, 1.0],
        [1.0, -0.5, 1.0],
    ]
    .map(Vector::from)
}

fn numbers() -> Vec<[f64; 2]> {
    let number = |i| {
        let [u, v, ..] = block::sample(1, i, 0).map(f64::from);
        [u, v]
    };
    (0..MANY).map(number).collect()
}

/// Draws `MANY` samples of what `prepare` makes, once for all of them or for each.
fn draw<S, T>(
    bencher: Bencher<'_, '_>,
    once: bool,
    prepare: impl Fn() -> Option<S> + Sync,
    sample: impl Fn(&S, [f64; 2]) -> T + Sync,
) {
    let numbers = numbers();
    bencher.counter(ItemsCount::new(MANY)).bench(|| {
        let prepare = || prepare().expect("the shape is seen");
        let first = divan::black_box(prepare());
        for u in &numbers {
            if once {
                divan::black_box(sample(&first, *u));
            } else {
                divan::black_box(sample(&divan::black_box(prepare()), *u));
            }
        }
    });
}

#[divan::bench(args = ["one", "many"])]
fn spherical_rectangle(bencher: Bencher<'_, '_>, receivers: &str) {
    let [a, b, _, d] = corners(false);
    let prepare = || SphericalRectangle::new(divan::black_box(a), [b - a, d - a]);
    draw(
        bencher,
        receivers == "many",
        prepare,
        SphericalRectangle::sample,
    );
}

#[divan::bench(args = ["one", "many"])]
fn spherical_triangle(bencher: Bencher<'_, '_>, receivers: &str) {
    let [a, b, c, _] = corners(false);
    let prepare = || SphericalTriangle::new(divan::black_box([a, b, c]));
    draw(
        bencher,
        receivers == "many",
        prepare,
        SphericalTriangle::sample,
    );
}

#[divan::bench(args = ["one", "many"])]
fn projected_polygon(bencher: Bencher<'_, '_>, receivers: &str) {
    let prepare = || ProjectedPolygon::new(&divan::black_box(corners(false)));
    draw(
        bencher,
        receivers == "many",
        prepare,
        ProjectedPolygon::sample,
    );
}

#[divan::bench(args = ["one", "many"])]
fn projected_polygon_cut_by_the_horizon(bencher: Bencher<'_, '_>, receivers: &str) {
    let prepare = || ProjectedPolygon::new(&divan::black_box(corners(true)));
    draw(
        bencher,
        receivers == "many",
        prepare,
        ProjectedPolygon::sample,
    );
}

#[divan::bench(args = ["one", "many"])]
fn projected_cap(bencher: Bencher<'_, '_>, receivers: &str) {
    let prepare = || ProjectedCap::new(divan::black_box(Vector::new(1.0, 0.0, 1.5)), 1.0);
    draw(bencher, receivers == "many", prepare, ProjectedCap::sample);
}

#[divan::bench(args = ["one", "many"])]
fn projected_cap_cut_by_the_horizon(bencher: Bencher<'_, '_>, receivers: &str) {
    let prepare = || ProjectedCap::new(divan::black_box(Vector::new(1.5, 0.0, 0.3)), 1.0);
    draw(bencher, receivers == "many", prepare, ProjectedCap::sample);
}
