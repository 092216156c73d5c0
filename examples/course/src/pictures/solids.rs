//! Pictures of things in space.

use steradian::geometry::{Direction, Vector};

use crate::view::{BLUE, FAINT, INK, RED, View, meridian, parallel, patch, spherical};

const UP: Vector = Vector::new(0.0, 0.0, 1.0);

fn axes(view: &mut View, length: f64) {
    let names = [("x", [-10.0, 12.0]), ("y", [12.0, 6.0]), ("z", [0.0, -8.0])];
    let axes = [Direction::X, Direction::Y, Direction::Z].map(Direction::to_vector);
    for (axis, (name, shift)) in axes.into_iter().zip(names) {
        view.arrow(Vector::ZERO, axis * length, INK);
        view.label(axis * length, shift, name, INK);
    }
}

fn graticule(view: &mut View, theta: [f64; 2]) {
    for phi in (0..360).step_by(15) {
        view.on_sphere(&meridian(f64::from(phi), theta));
    }
    let mut angle = theta[0];
    while angle <= theta[1] {
        view.on_sphere(&parallel(angle, [0.0, 360.0]));
        angle += 15.0;
    }
}

/// A sphere cut into elements.
pub fn area() -> String {
    let mut view = View::new(35.0, 22.0, [280.0, 222.0], 185.0);
    graticule(&mut view, [0.0, 180.0]);
    view.face(&patch([45.0, 60.0], [30.0, 45.0]), BLUE, 0.55);
    view.label(spherical(52.0, 30.0), [-34.0, 4.0], "R dθ", INK);
    view.label(spherical(60.0, 37.5), [2.0, 22.0], "R sinθ dφ", INK);
    view.label(spherical(45.0, 37.5), [4.0, -8.0], "dA", BLUE);
    view.dashes(&[Vector::ZERO, spherical(115.0, 80.0)], INK);
    view.dot(Vector::ZERO, INK);
    view.label(spherical(115.0, 80.0) * 0.5, [8.0, -6.0], "R", INK);
    view.finish()
}

/// A direction and its angles.
pub fn direction() -> String {
    let (theta, phi) = (40.0, 55.0);
    let mut view = View::new(25.0, 20.0, [215.0, 285.0], 230.0);
    axes(&mut view, 1.1);
    let end = spherical(theta, phi);
    let foot = Vector::new(end.x, end.y, 0.0);
    view.dashes(&[end, foot, Vector::ZERO], INK);
    view.path(&meridian(phi, [0.0, theta]), RED, 2.0);
    let around: Vec<Vector> = parallel(90.0, [0.0, phi])
        .into_iter()
        .map(|point| point * 0.45)
        .collect();
    view.path(&around, RED, 2.0);
    view.arrow(Vector::ZERO, end, BLUE);
    view.label(end, [14.0, -4.0], "d", BLUE);
    view.label(spherical(theta / 2.0, phi), [6.0, -8.0], "θ", RED);
    view.label(spherical(90.0, phi / 2.0) * 0.45, [2.0, 20.0], "φ", RED);
    view.label(foot, [52.0, 14.0], "sinθ (cosφ, sinφ)", INK);
    view.finish()
}

/// A square before the observer, and its projection on the sphere.
pub fn solid_angle() -> String {
    let mut view = View::new(-62.0, 20.0, [165.0, 270.0], 125.0);
    let (distance, half) = (2.0, 0.7);
    let corner = |[y, z]: [f64; 2]| Vector::new(distance, y * half, 0.6 + z * half);
    let ring = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let square: Vec<Vector> = outline(&ring).into_iter().map(corner).collect();
    let image: Vec<Vector> = square.iter().map(|point| *point / point.length()).collect();
    graticule(&mut view, [0.0, 180.0]);
    for vertex in ring.map(corner) {
        view.dashes(&[Vector::ZERO, vertex], INK);
    }
    view.face(&image, RED, 0.55);
    view.face(&square, BLUE, 0.25);
    view.dot(Vector::ZERO, INK);
    view.label(Vector::ZERO, [-6.0, 20.0], "observer", INK);
    view.label(corner([0.0, 1.0]), [-24.0, -4.0], "surface", BLUE);
    view.label(image[40], [0.0, -12.0], "ω", RED);
    view.finish()
}

/// A closed outline with points along its edges, which become arcs on a sphere.
fn outline(ring: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let ends = ring.iter().zip(ring.iter().cycle().skip(1));
    ends.flat_map(|(from, to)| {
        (0..16).map(move |step| {
            let s = f64::from(step) / 16.0;
            [0, 1].map(|k| from[k] + s * (to[k] - from[k]))
        })
    })
    .collect()
}

/// The element of solid angle between two parallels and two meridians.
pub fn differential() -> String {
    let mut view = View::new(35.0, 25.0, [270.0, 350.0], 270.0);
    graticule(&mut view, [0.0, 90.0]);
    let (theta, phi) = ([40.0, 52.0], [68.0, 82.0]);
    for (theta, phi) in [(40.0, 68.0), (40.0, 82.0), (52.0, 68.0), (52.0, 82.0)] {
        view.dashes(&[Vector::ZERO, spherical(theta, phi)], FAINT);
    }
    let height = UP * spherical(theta[0], 0.0).z;
    view.dashes(&[height, spherical(theta[0], phi[0])], INK);
    view.dashes(&[height, spherical(theta[0], phi[1])], INK);
    view.arrow(Vector::ZERO, UP * 1.15, INK);
    view.face(&patch(theta, phi), RED, 0.6);
    view.label(UP * 1.15, [14.0, 6.0], "n", INK);
    view.label(spherical(46.0, 68.0), [-22.0, 12.0], "dθ", INK);
    view.label(spherical(52.0, 75.0), [10.0, 24.0], "sinθ dφ", INK);
    view.label(spherical(40.0, 82.0), [26.0, 0.0], "dω", RED);
    view.label(
        spherical(40.0, 68.0) * 0.5 + height * 0.5,
        [-2.0, -8.0],
        "sinθ",
        INK,
    );
    view.finish()
}

/// The hemisphere over a surface.
pub fn reflection() -> String {
    let mut view = View::new(20.0, 20.0, [280.0, 330.0], 215.0);
    let ground = [[-1.1, -1.1], [1.1, -1.1], [1.1, 1.1], [-1.1, 1.1]];
    view.face(&ground.map(|[x, y]| Vector::new(x, y, 0.0)), FAINT, 0.35);
    graticule(&mut view, [0.0, 90.0]);
    let (incoming, outgoing) = (spherical(40.0, -60.0), spherical(50.0, 95.0));
    view.face(&patch([34.0, 46.0], [-68.0, -52.0]), RED, 0.6);
    view.arrow(Vector::ZERO, UP * 1.15, INK);
    view.arrow(incoming * 1.35, incoming * 0.08, RED);
    view.arrow(Vector::ZERO, outgoing * 1.25, BLUE);
    let angle: Vec<Vector> = meridian(-60.0, [0.0, 40.0])
        .into_iter()
        .map(|point| point * 0.3)
        .collect();
    view.path(&angle, INK, 1.5);
    view.dot(Vector::ZERO, INK);
    view.label(Vector::ZERO, [0.0, 22.0], "p", INK);
    view.label(UP * 1.15, [14.0, 6.0], "n", INK);
    view.label(spherical(20.0, -60.0) * 0.3, [-8.0, -8.0], "θᵢ", INK);
    view.label(incoming * 1.35, [-14.0, -8.0], "L(p, −dᵢ)", RED);
    view.label(spherical(34.0, -52.0), [18.0, -10.0], "dωᵢ", RED);
    view.label(outgoing * 1.25, [16.0, -8.0], "L(dₑ)", BLUE);
    view.finish()
}
