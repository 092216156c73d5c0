//! Boxes: six faces with their own materials, and rectangular openings in them.

use super::description::Opening;
use crate::geometry::{Bounds, Point, Polygon, Transform};
use crate::shape::Parallelogram;

/// What [`faces_of`] knows.
pub(super) const FACE_NAMES: &str = "x-, x+, y-, y+, z- (floor), z+ (ceiling) and walls";

/// The faces that a name of the `faces` table stands for.
pub(super) fn faces_of(name: &str) -> Option<&'static [usize]> {
    Some(match name {
        "x-" => &[0],
        "x+" => &[1],
        "y-" => &[2],
        "y+" => &[3],
        "z-" | "floor" => &[4],
        "z+" | "ceiling" => &[5],
        "walls" => &[0, 1, 2, 3],
        _ => return None,
    })
}

/// Corners of each face, counter-clockwise from outside, as [`Bounds::corners`] counts them.
const QUADS: [[u32; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// Triangles of a box: vertices, triangles, and the face (or 6 + opening) of each triangle.
#[derive(Default)]
pub(super) struct BoxMesh {
    pub vertices: Vec<Point>,
    pub triangles: Vec<[u32; 3]>,
    pub faces: Vec<usize>,
}

/// The box between two corners; faces without openings share the corners, so that a whole box is a closed mesh.
pub(super) fn box_mesh(
    min: Point,
    max: Point,
    inside: bool,
    openings: &[Opening],
) -> Result<BoxMesh, String> {
    if let Some(unknown) = openings
        .iter()
        .find(|opening| opening.face_index().is_none())
    {
        let face = &unknown.face;
        return Err(format!(
            "an opening's face is x-, x+, y-, y+, z- (floor) or z+ (ceiling), not `{face}`"
        ));
    }
    let mut mesh = BoxMesh {
        vertices: Bounds::around([min, max]).corners().to_vec(),
        ..BoxMesh::default()
    };
    for (face, quad) in QUADS.into_iter().enumerate() {
        let holes: Vec<_> = openings
            .iter()
            .enumerate()
            .filter(|(_, opening)| opening.face_index() == Some(face))
            .collect();
        if holes.is_empty() {
            let [a, b, c, d] = quad;
            mesh.push(face, &[[a, b, c], [a, c, d]], inside);
        } else {
            pierced_face(&mut mesh, face, quad, (min, max), &holes, inside)?;
        }
    }
    Ok(mesh)
}

/// The openings of a box that may be seen through, as parallelograms whose front is inside.
pub(super) fn portals(
    (min, max): (Point, Point),
    openings: &[Opening],
    transform: &Transform,
) -> Vec<Parallelogram> {
    let middle = transform.point(min + (max - min) * 0.5);
    let portal = |opening: &Opening| {
        let corners = opening_corners(opening.face_index()?, opening, (min, max)).ok()?;
        let [a, b, d] = [0, 1, 3].map(|k| transform.point(corners[k]));
        let portal = Parallelogram::new(a, [b - a, d - a])?;
        if portal.normal.dot(middle - a) > 0.0 {
            return Some(portal);
        }
        Parallelogram::new(a, [d - a, b - a])
    };
    openings.iter().filter_map(portal).collect()
}

fn pierced_face(
    mesh: &mut BoxMesh,
    face: usize,
    quad: [u32; 4],
    extent: (Point, Point),
    holes: &[(usize, &Opening)],
    inside: bool,
) -> Result<(), String> {
    let boundary = quad.map(|index| mesh.vertices[index as usize]).to_vec();
    let corners: Vec<Vec<Point>> = holes
        .iter()
        .map(|(_, hole)| opening_corners(face, hole, extent))
        .collect::<Result<_, _>>()?;
    let polygon = Polygon::new(boundary, corners.clone())
        .map_err(|_| format!("openings of face {} overlap or touch", holes[0].1.face))?;
    mesh.append(
        face,
        polygon.vertices().to_vec(),
        polygon.triangles(),
        inside,
    );
    for ((index, hole), mut rectangle) in holes.iter().zip(corners) {
        if hole.material.is_some() {
            if matches!(face, 0 | 3 | 4) {
                rectangle.reverse();
            }
            mesh.append(6 + index, rectangle, &[[0, 1, 2], [0, 2, 3]], inside);
        }
    }
    Ok(())
}

/// Corners in the order +u, +v, which is counter-clockwise from outside for the faces x+, y- and z+.
fn opening_corners(
    face: usize,
    opening: &Opening,
    (min, max): (Point, Point),
) -> Result<Vec<Point>, String> {
    let (low, high) = (min.to_array(), max.to_array());
    let axis = face / 2;
    let [u_axis, v_axis] = [[1, 2], [0, 2], [0, 1]][axis];
    let [u, v, width, height] = opening.rect;
    let fits = |start: f64, length: f64, along: usize| {
        start > 0.0 && length > 0.0 && start + length < high[along] - low[along]
    };
    if !fits(u, width, u_axis) || !fits(v, height, v_axis) {
        let (a, b) = (high[u_axis] - low[u_axis], high[v_axis] - low[v_axis]);
        return Err(format!(
            "opening {:?} of face {} does not lie within the face of {a} m × {b} m, clear of its edges",
            opening.rect, opening.face
        ));
    }
    let corner = |du: f64, dv: f64| {
        let mut p = if face.is_multiple_of(2) { low } else { high };
        p[u_axis] = low[u_axis] + u + du;
        p[v_axis] = low[v_axis] + v + dv;
        Point::new(p[0], p[1], p[2])
    };
    Ok(vec![
        corner(0.0, 0.0),
        corner(width, 0.0),
        corner(width, height),
        corner(0.0, height),
    ])
}

impl Opening {
    pub(super) fn face_index(&self) -> Option<usize> {
        match faces_of(&self.face)? {
            [face] => Some(*face),
            _ => None,
        }
    }
}

impl BoxMesh {
    fn push(&mut self, face: usize, triangles: &[[u32; 3]], inside: bool) {
        for &[a, b, c] in triangles {
            self.triangles
                .push(if inside { [a, c, b] } else { [a, b, c] });
            self.faces.push(face);
        }
    }

    fn append(&mut self, face: usize, vertices: Vec<Point>, triangles: &[[u32; 3]], inside: bool) {
        let base = self.vertices.len() as u32;
        self.vertices.extend(vertices);
        let shifted: Vec<_> = triangles
            .iter()
            .map(|triangle| triangle.map(|index| base + index))
            .collect();
        self.push(face, &shifted, inside);
    }
}
