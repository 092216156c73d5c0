use super::*;
use crate::geometry::Bounds;

fn points<const N: usize>(points: [[f64; 3]; N]) -> Vec<Point> {
    points.map(Point::from).to_vec()
}

fn bitwise(vertices: &[Point], triangles: &[[u32; 3]]) -> Health {
    examine(vertices, triangles, Length::ZERO)
}

fn corners() -> Vec<Point> {
    let box_ = Bounds::around([Point::ORIGIN, Point::new(1.0, 1.0, 1.0)]);
    box_.corners().to_vec()
}

/// The unit cube facing outwards, the last two triangles being its face z = 1.
fn cube() -> Vec<[u32; 3]> {
    let faces = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    faces
        .into_iter()
        .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect()
}

fn ends(edges: &[Edge]) -> Vec<[u32; 2]> {
    edges.iter().map(|edge| edge.ends).collect()
}

#[test]
fn a_cube_is_sound() {
    let health = bitwise(&corners(), &cube());
    let nothing = Health {
        pieces: 1,
        ..Health::default()
    };
    assert_eq!(health, nothing);
    assert!(health.is_sound());
}

#[test]
fn without_a_face_a_cube_has_four_boundary_edges() {
    let health = bitwise(&corners(), &cube()[..10]);
    assert_eq!(ends(&health.boundary), [[4, 5], [4, 6], [5, 7], [6, 7]]);
    assert!(
        health
            .boundary
            .iter()
            .all(|edge| !edge.flat && edge.uses == 1)
    );
    assert!(!health.is_sound());
}

/// Each triangle with vertices of its own is the same surface, wherever zero has a sign.
#[test]
fn vertices_at_the_same_place_are_one() {
    let (corners, cube) = (corners(), cube());
    let apart: Vec<Point> = cube
        .iter()
        .flatten()
        .map(|&index| corners[index as usize])
        .map(|point| {
            if point.x == 0.0 {
                Point::new(-0.0, point.y, point.z)
            } else {
                point
            }
        })
        .collect();
    let triangles: Vec<[u32; 3]> = (0..12).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    assert!(bitwise(&apart, &triangles).is_sound());
}

/// The same a hair apart: all 36 edges are boundary without welding, none with it.
#[test]
fn welding_closes_gaps_up_to_its_tolerance() {
    let (corners, cube) = (corners(), cube());
    let moved = |(place, &index): (usize, &u32)| {
        let hair = 1e-5 * (place as f64 / 35.0 - 0.5);
        corners[index as usize] + Vector::new(hair, -hair, hair)
    };
    let apart: Vec<Point> = cube.iter().flatten().enumerate().map(moved).collect();
    let triangles: Vec<[u32; 3]> = (0..12).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    assert_eq!(bitwise(&apart, &triangles).boundary.len(), 36);
    let welded = |distance| examine(&apart, &triangles, Length::from_metres(distance));
    assert!(welded(2e-5).is_sound());
    assert_eq!(welded(1e-9).boundary.len(), 36);
}

#[test]
fn a_face_that_is_there_twice_is_told_once() {
    let mut triangles = cube();
    triangles.push(triangles[3]);
    let [a, b, c] = triangles[5];
    triangles.push([c, b, a]);
    let health = bitwise(&corners(), &triangles);
    let expected = [
        Doubled {
            triangle: 12,
            original: 3,
            turned: false,
        },
        Doubled {
            triangle: 13,
            original: 5,
            turned: true,
        },
    ];
    assert_eq!(health.doubled, expected);
    let rest = Health {
        doubled: vec![],
        ..health
    };
    assert!(rest.is_sound());
}

#[test]
fn a_face_that_shows_its_back_turns_its_edges() {
    let mut triangles = cube();
    triangles[0].swap(1, 2);
    let health = bitwise(&corners(), &triangles);
    assert_eq!(ends(&health.turned), [[0, 4], [0, 6], [4, 6]]);
    assert!(health.boundary.is_empty() && health.non_manifold.is_empty());
}

/// Two cubes side by side that share an edge: four faces meet there.
#[test]
fn an_edge_of_four_faces_is_not_manifold() {
    let (mut vertices, mut triangles) = (corners(), cube());
    let step = Vector::new(1.0, 1.0, 0.0);
    vertices.extend(corners().into_iter().map(|point| point + step));
    triangles.extend(cube().into_iter().map(|face| face.map(|index| index + 8)));
    let health = bitwise(&vertices, &triangles);
    let [edge] = health.non_manifold[..] else {
        panic!("{health:?}")
    };
    assert_eq!(edge.uses, 4);
    let ends = edge.ends.map(|index| vertices[index as usize].to_array());
    assert_eq!(ends, [[1.0, 1.0, 0.0], [1.0, 1.0, 1.0]]);
    assert!(health.boundary.is_empty() && health.turned.is_empty());
}

/// Two triangles that touch in a point are two pieces, each of them a sheet.
#[test]
fn a_bow_tie_is_two_sheets() {
    let vertices = points([
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [-1.0, 0.0, 1.0],
        [-1.0, 1.0, 0.0],
    ]);
    let health = bitwise(&vertices, &[[0, 1, 2], [0, 3, 4]]);
    assert_eq!((health.pieces, health.boundary.len()), (2, 6));
    assert!(health.boundary.iter().all(|edge| edge.flat));
    assert!(health.non_manifold.is_empty() && health.is_sound());
}

/// Above the edge from 0 to 1 one triangle, below it two that meet in its middle, 4: three edges along one line.
#[test]
fn a_t_junction_is_boundary_on_both_sides() {
    let vertices = points([
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [1.0, -1.0, 0.5],
        [1.0, 0.0, 0.0],
    ]);
    let health = bitwise(&vertices, &[[0, 1, 2], [4, 0, 3], [1, 4, 3]]);
    let found = ends(&health.boundary);
    for edge in [[0, 1], [0, 4], [1, 4]] {
        assert!(found.contains(&edge), "{edge:?}");
    }
}

#[test]
fn faces_without_area() {
    let vertices = points([
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [2.0, 0.0, 0.0],
        [1.0, 0.0, -0.0],
    ]);
    let health = bitwise(&vertices, &[[0, 1, 2], [0, 1, 3], [1, 1, 2], [1, 2, 4]]);
    assert_eq!(health.degenerate, [1, 2, 3]);
}

#[test]
fn nothing_is_sound() {
    assert!(bitwise(&[], &[]).is_sound());
}

/// A bumpy square of n × n cells has 4n boundary edges and nothing else; and it is one piece, not flat.
#[test]
fn a_terrain_has_its_border() {
    let n = 60_u32;
    let height = |x: u32, y: u32| f64::from((x * 7 + y * 13) % 5) * 0.1;
    let vertices: Vec<Point> = (0..=n)
        .flat_map(|y| (0..=n).map(move |x| Point::new(f64::from(x), f64::from(y), height(x, y))))
        .collect();
    let at = |x: u32, y: u32| y * (n + 1) + x;
    let triangles: Vec<[u32; 3]> = (0..n * n)
        .map(|cell| (cell % n, cell / n))
        .flat_map(|(x, y)| {
            let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let health = bitwise(&vertices, &triangles);
    assert_eq!((health.boundary.len(), health.pieces), (4 * n as usize, 1));
    assert!(health.boundary.iter().all(|edge| !edge.flat));
    assert!(
        health.turned.is_empty() && health.non_manifold.is_empty() && health.doubled.is_empty()
    );
}
