mod edges;
mod quadrature;
mod shapes;

use super::*;
use crate::geometry::testing::close;
use crate::geometry::{Point, Transform, Vector, configuration_factor};
use shapes::{Numbers, ceiling, floor, outlined, polygon, wall};

/// Whether two numbers agree to this fraction of the second.
fn agree(found: f64, expected: f64, tolerance: f64) -> bool {
    close(found / expected, 1.0, tolerance)
}

#[test]
fn unit_squares_face_to_face_and_at_right_angles() {
    assert!(close(
        between_polygons(&floor(), &ceiling(1.0)),
        0.199_824_895_698_387_38,
        1e-15
    ));
    assert!(close(
        between_polygons(&floor(), &wall(0.0, 1.0)),
        0.200_043_776_075_403_16,
        1e-15
    ));
}

#[test]
fn what_cannot_be_seen_is_nought() {
    let aside = floor()
        .transformed(&Transform::translate(Vector::new(1.0, 0.0, 0.0)))
        .unwrap();
    let back = polygon(&[
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [1.0, 1.0, 1.0],
        [0.0, 1.0, 1.0],
    ]);
    for other in [
        floor(),
        aside,
        back,
        ceiling(0.0),
        ceiling(-1.0),
        wall(1.0, 1.0),
        wall(0.0, -1.0),
    ] {
        assert_eq!(between_polygons(&floor(), &other), 0.0, "{other:?}");
        assert_eq!(between_polygons(&other, &floor()), 0.0, "{other:?}");
    }
}

/// The outward faces of the convex hull of points of which no four lie in a plane.
fn hull(points: &[Point]) -> Vec<Polygon> {
    let mut faces = Vec::new();
    let count = points.len();
    for (i, j, k) in
        (0..count).flat_map(|i| (0..count).flat_map(move |j| (0..count).map(move |k| (i, j, k))))
    {
        let [a, b, c] = [i, j, k].map(|index| points[index]);
        let is_outside = |&point: &Point| (b - a).cross(c - a).dot(point - a) > 1e-9;
        if i < j && i < k && j != k && !points.iter().any(is_outside) {
            faces.push(outlined(vec![a, c, b]));
        }
    }
    faces
}

fn assert_closed(faces: &[Polygon], tolerance: f64) {
    for face in faces {
        let sum: f64 = faces
            .iter()
            .map(|other| between_polygons(face, other))
            .sum();
        assert!(close(sum, 1.0, tolerance), "{sum} of {}", faces.len());
    }
}

/// A box around the origin seen from inside, each face in n × n parts.
fn room(half: [f64; 3], parts: usize) -> Vec<Polygon> {
    let mut faces = Vec::new();
    for (axis, side) in (0..6).map(|face| (face / 2, if face % 2 == 0 { -1.0 } else { 1.0 })) {
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        for (i, j) in (0..parts).flat_map(|i| (0..parts).map(move |j| (i, j))) {
            let corner = |x: usize, y: usize| {
                let mut point = [0.0; 3];
                point[axis] = side * half[axis];
                point[u] = half[u] * (2.0 * (i + x) as f64 / parts as f64 - 1.0);
                point[v] = -side * half[v] * (2.0 * (j + y) as f64 / parts as f64 - 1.0);
                Point::from(point)
            };
            faces.push(outlined(vec![
                corner(0, 0),
                corner(1, 0),
                corner(1, 1),
                corner(0, 1),
            ]));
        }
    }
    faces
}

#[test]
fn closed_polyhedra_see_themselves_all_around() {
    assert_closed(&room([0.5; 3], 1), 1e-14);
    assert_closed(&room([2.0, 1.5, 0.1], 2), 1e-13);
    let mut numbers = Numbers(7);
    for count in [4, 5, 8, 12] {
        let points: Vec<Point> = (0..count)
            .map(|_| Point::ORIGIN + numbers.direction() * numbers.between(0.9, 1.1))
            .collect();
        assert_closed(&hull(&points), 1e-12);
    }
}

#[test]
fn a_turned_room_with_edges_that_meet_to_within_rounding() {
    let motion = Numbers(3).motion();
    let faces: Vec<Polygon> = room([2.0, 1.0, 0.7], 3)
        .iter()
        .map(|face| face.transformed(&motion).unwrap())
        .collect();
    assert_closed(&faces, 1e-12);
}

#[test]
fn a_prism_whose_floor_is_concave_seen_from_its_parts() {
    // An L-shaped ceiling is the sum of its two rectangles, and so is an L-shaped floor.
    let l = [
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];
    let at = |corners: &[[f64; 2]], z: f64| {
        let mut ring: Vec<[f64; 3]> = corners.iter().map(|&[x, y]| [x, y, z]).collect();
        if z > 0.0 {
            ring.reverse();
        }
        polygon(&ring)
    };
    let parts = [
        [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]],
        [[0.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]],
    ];
    let whole = exchange_area_of_polygons(&at(&l, 0.0), &at(&l, 0.5));
    let sum: Area = parts
        .iter()
        .flat_map(|a| {
            parts
                .iter()
                .map(|b| exchange_area_of_polygons(&at(a, 0.0), &at(b, 0.5)))
        })
        .sum();
    assert!(agree(whole / sum, 1.0, 1e-13));
}

#[test]
fn a_hole_is_what_it_leaves_out() {
    let ring = |half: f64| {
        [[-half, -half], [half, -half], [half, half], [-half, half]]
            .map(|[x, y]| Point::new(x, y, 0.0))
            .to_vec()
    };
    let wall = polygon(&[
        [0.2, -1.0, -1.0],
        [0.2, 1.0, -1.0],
        [0.7, 1.0, 1.0],
        [0.7, -1.0, 1.0],
    ]);
    for hole in [ring(0.5), ring(0.5).into_iter().rev().collect()] {
        let frame = Polygon::new(ring(1.0), vec![hole]).unwrap();
        let [whole, inner, seen] = [&outlined(ring(1.0)), &outlined(ring(0.5)), &frame]
            .map(|floor| exchange_area_of_polygons(floor, &wall).to_square_metres());
        assert!(agree(seen, whole - inner, 1e-13), "{seen}");
        assert!(agree(
            exchange_area_of_polygons(&wall, &frame).to_square_metres(),
            seen,
            1e-13
        ));
    }
}

#[test]
fn squares_that_nearly_touch() {
    // With the four sides of the gap they are closed, however narrow it is.
    for h in [1e-3, 1e-6, 1e-9, 1e-12] {
        let sides = 4.0 * between_polygons(&floor(), &wall(0.0, h));
        let sum = between_polygons(&floor(), &ceiling(h)) + sides;
        assert!(close(sum, 1.0, 4e-15), "{h}: {sum}");
    }
}

#[test]
fn far_and_tiny_polygons_keep_their_digits() {
    let scaled = |polygon: &Polygon, size: f64, step: [f64; 3]| {
        polygon
            .transformed(&Transform::scale(size).then(Transform::translate(step.into())))
            .unwrap()
    };
    // The same pair in other units has the same factor.
    let reference = between_polygons(&floor(), &ceiling(1.0));
    for size in [1e-60, 1e-9, 1e9, 1e60] {
        let found = between_polygons(
            &scaled(&floor(), size, [0.0; 3]),
            &scaled(&ceiling(1.0), size, [0.0; 3]),
        );
        assert!(agree(found, reference, 1e-14), "{size}");
    }
    // Face to face at a great distance: F = A/(π d²) but for terms in d⁻⁴.
    for distance in [1e4, 1e6, 1e8] {
        let found = between_polygons(&floor(), &ceiling(distance))
            * std::f64::consts::PI
            * distance
            * distance;
        assert!(
            close(found, 1.0, 2.0 / (distance * distance) + 1e-14),
            "{distance} {found}"
        );
    }
    // A tiny polygon sees what an element in its place sees.
    for size in [1e-4, 1e-6, 1e-8] {
        let tiny = scaled(&floor(), size, [0.3, 0.4, 0.0]);
        let element = configuration_factor::of_polygon(
            Point::new(0.3, 0.4, 0.0),
            tiny.normal(),
            ceiling(0.1).outline(),
        );
        let found = between_polygons(&tiny, &ceiling(0.1));
        assert!(
            agree(found, element, 3.0 * size),
            "{size} {found} {element}"
        );
        assert!(agree(
            exchange_area_of_polygons(&ceiling(0.1), &tiny) / tiny.area(),
            found,
            1e-13
        ));
    }
}

#[test]
fn the_three_ways_meet_where_one_takes_over_from_another() {
    let mut numbers = Numbers(11);
    for index in 0..40 {
        let motion = numbers.motion();
        let a = floor().transformed(&motion).unwrap();
        let place = |polygon: Polygon, size: f64, distance: f64| {
            let move_away =
                Transform::scale(size).then(Transform::translate(Vector::new(0.2, 0.1, distance)));
            polygon.transformed(&move_away.then(motion)).unwrap()
        };
        let tilted = polygon(&[[0.0, 0.0, 0.0], [0.3, 1.0, 0.4], [1.0, 0.6, 0.1]]);
        let far = place(tilted.clone(), 1.0, 30.0 + f64::from(index));
        let small = place(tilted, 0.02, 0.1 + 0.01 * f64::from(index));
        for b in [far, small] {
            let scale = Scale::of(&a, &b);
            let outline = |polygon, other| Outline::in_front_of(other, polygon, &scale).unwrap();
            let (a, b) = (outline(&a, &b), outline(&b, &a));
            let contour = contour_integral(&a, &b);
            let areas = if index % 2 == 0 {
                areas::small_and_large(&b, &a)
            } else {
                areas::both(&a, &b)
            };
            if let Some(areas) = areas {
                assert!(
                    agree(contour, areas, 1e-10),
                    "{index} {contour:e} {areas:e}"
                );
            }
        }
    }
}

#[test]
fn reciprocity_and_additivity_of_random_pairs() {
    let mut numbers = Numbers(100);
    for index in 0..200 {
        let [a, b] = numbers.pair(index);
        let whole = exchange_area_of_polygons(&a, &b).to_square_metres();
        let back = exchange_area_of_polygons(&b, &a).to_square_metres();
        assert!(close(whole, back, 3e-15), "{whole} {back}");
        let corners = |polygon: &Polygon| polygon.outline().to_vec();
        let (t, outline) = (numbers.between(0.01, 0.99), corners(&a));
        let last = outline.len() - 1;
        let cut = outline[last - 1].lerp(outline[last], t);
        let one = [&[outline[0]], &outline[1..last], &[cut]].concat();
        let parts = [one, vec![outline[0], cut, outline[last]]].map(outlined);
        let sum: f64 = parts
            .iter()
            .map(|part| exchange_area_of_polygons(part, &b).to_square_metres())
            .sum();
        assert!(close(whole, sum, 3e-14), "{index}: {whole} {sum}");
    }
}
