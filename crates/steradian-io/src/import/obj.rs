//! Wavefront OBJ: vertices and polygons.
//!
//! Reads `v` and `f` (indices from 1, or negative: from the last vertex back). Texture coordinates, normals, groups
//! and materials are passed over: a normal is that of the triangle. Polygons are cut into triangles, concave ones by
//! ear clipping. Free-form curves and surfaces are refused.
//!
//! ```
//! let mesh = steradian_io::import::obj::read(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")?;
//! assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (4, 2));
//! # Ok::<(), steradian_io::import::obj::ObjError>(())
//! ```

use earcut::utils3d::project3d_to_2d;
use earcut::{Earcut, deviation};
use steradian::geometry::Point;
use steradian::scene::description::MeshData;
use thiserror::Error;

/// What is wrong with an OBJ file, and in which line.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("line {line}: {fault}")]
pub struct ObjError {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong with it.
    pub fault: ObjFault,
}

/// What can be wrong with a line of an OBJ file.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ObjFault {
    /// A vertex without three finite coordinates.
    #[error("expected a vertex of three finite numbers, found \"{0}\"")]
    Vertex(String),
    /// A face with a corner that is no vertex number.
    #[error("expected a vertex number, found \"{0}\"")]
    Corner(String),
    /// A face with a vertex number that no vertex before it has.
    #[error("there is no vertex {number}: {vertices} precede this line")]
    NoSuchVertex {
        /// The number in the file.
        number: i64,
        /// Vertices so far.
        vertices: usize,
    },
    /// A face of fewer than three corners.
    #[error("a face needs three corners or more, found {0}")]
    TooFewCorners(usize),
    /// A polygon without area.
    #[error("this polygon of {0} corners has no area")]
    Polygon(usize),
    /// A statement of free-form geometry.
    #[error("free-form geometry (`{0}`) is not supported")]
    FreeForm(String),
    /// More vertices than can be numbered.
    #[error("more than {} vertices", u32::MAX)]
    TooManyVertices,
    /// No face in the whole file.
    #[error("no face in the whole file")]
    NoFace,
}

/// Reads the vertices and triangles of an OBJ file.
///
/// # Errors
/// The first line that cannot be read.
pub fn read(bytes: &[u8]) -> Result<MeshData, ObjError> {
    let mut reader = Reader::default();
    let mut last = 1;
    for (line, text) in logical_lines(bytes) {
        reader
            .line(&text)
            .map_err(|fault| ObjError { line, fault })?;
        last = line;
    }
    if reader.mesh.triangles.is_empty() {
        return Err(ObjError {
            line: last,
            fault: ObjFault::NoFace,
        });
    }
    Ok(reader.mesh)
}

/// Lines with their numbers, comments cut off; a line that ends in a backslash goes on in the next.
fn logical_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, String)> {
    let mut lines = bytes.split(|byte| *byte == b'\n').enumerate();
    std::iter::from_fn(move || {
        let (index, first) = lines.next()?;
        let mut text = without_comment(first);
        while text.ends_with('\\') {
            text.pop();
            let Some((_, next)) = lines.next() else { break };
            text.push(' ');
            text.push_str(&without_comment(next));
        }
        Some((index + 1, text))
    })
}

fn without_comment(line: &[u8]) -> String {
    let text = line.split(|byte| *byte == b'#').next().unwrap_or_default();
    String::from_utf8_lossy(text).trim().to_owned()
}

#[derive(Default)]
struct Reader {
    mesh: MeshData,
    earcut: Earcut<f64>,
}

impl Reader {
    fn line(&mut self, text: &str) -> Result<(), ObjFault> {
        let mut words = text.split_whitespace();
        match words.next() {
            Some("v") => self.vertex(words, text),
            Some("f") => self.face(words),
            Some(word @ ("cstype" | "curv" | "curv2" | "surf")) => {
                Err(ObjFault::FreeForm(word.to_owned()))
            }
            _ => Ok(()),
        }
    }

    fn vertex<'a>(
        &mut self,
        words: impl Iterator<Item = &'a str>,
        text: &str,
    ) -> Result<(), ObjFault> {
        let numbers = words
            .take(3)
            .map(|word| word.parse().ok().filter(|number: &f64| number.is_finite()));
        let [Some(x), Some(y), Some(z)] = numbers.collect::<Vec<_>>()[..] else {
            return Err(ObjFault::Vertex(text.to_owned()));
        };
        if self.mesh.vertices.len() >= u32::MAX as usize {
            return Err(ObjFault::TooManyVertices);
        }
        self.mesh.vertices.push(Point::new(x, y, z));
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), ObjFault> {
        let corners = words
            .map(|word| self.corner(word))
            .collect::<Result<Vec<u32>, _>>()?;
        match corners[..] {
            [] | [_] | [_, _] => Err(ObjFault::TooFewCorners(corners.len())),
            [a, b, c] => {
                self.mesh.triangles.push([a, b, c]);
                Ok(())
            }
            _ => self.polygon(&corners),
        }
    }

    /// The vertex that `7`, `7/1`, `7//2` or `-1` means.
    fn corner(&self, word: &str) -> Result<u32, ObjFault> {
        let number = word.split('/').next().unwrap_or_default();
        let number: i64 = number
            .parse()
            .map_err(|_| ObjFault::Corner(word.to_owned()))?;
        let vertices = self.mesh.vertices.len();
        let index = if number < 0 {
            number.checked_add(vertices as i64)
        } else {
            number.checked_sub(1)
        };
        index
            .and_then(|index| u32::try_from(index).ok())
            .filter(|index| (*index as usize) < vertices)
            .ok_or(ObjFault::NoSuchVertex { number, vertices })
    }

    fn polygon(&mut self, corners: &[u32]) -> Result<(), ObjFault> {
        let points: Vec<[f64; 3]> = corners
            .iter()
            .map(|&corner| self.mesh.vertices[corner as usize].to_array())
            .collect();
        let mut flat = Vec::new();
        if !project3d_to_2d(&points, points.len(), &mut flat) {
            return Err(ObjFault::Polygon(corners.len()));
        }
        let cut = self.cut(&flat);
        let named = cut
            .chunks_exact(3)
            .map(|triple| [0, 1, 2].map(|i| corners[triple[i] as usize]));
        self.mesh.triangles.extend(named);
        Ok(())
    }

    /// Corner numbers of the triangles of a polygon that is counter-clockwise in its plane.
    ///
    /// A fan from the first corner keeps every edge, so that neighbours leave no crack. Where it would fold back it is
    /// right only if the polygon crosses itself, by being far from plane; otherwise ears are cut.
    fn cut(&mut self, polygon: &[[f64; 2]]) -> Vec<u32> {
        let fan: Vec<u32> = (1..polygon.len() as u32 - 1)
            .flat_map(|corner| [0, corner, corner + 1])
            .collect();
        if !folds_back(polygon, &fan) {
            return fan;
        }
        let mut ears: Vec<u32> = Vec::new();
        self.earcut.earcut(polygon.iter().copied(), &[], &mut ears);
        let no_holes: &[u32] = &[];
        let is_cut = deviation(polygon.iter().copied(), no_holes, &ears) < MOST_DEVIATION;
        if is_cut { ears } else { fan }
    }
}

/// The part of a polygon's area that may be rounding.
const MOST_DEVIATION: f64 = 1e-9;

/// Whether a triangle turns against the others, by more than rounding.
fn folds_back(polygon: &[[f64; 2]], triangles: &[u32]) -> bool {
    let areas = triangles.chunks_exact(3).map(|triple| {
        let [a, b, c] = [0, 1, 2].map(|i| polygon[triple[i] as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    });
    let all: f64 = areas.clone().map(f64::abs).sum();
    areas.into_iter().any(|area| area < -MOST_DEVIATION * all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn fault(text: &str) -> (usize, ObjFault) {
        let error = read(text.as_bytes()).unwrap_err();
        (error.line, error.fault)
    }

    /// Twice the area of a triangle in the plane z = 0, positive if counter-clockwise as seen from above.
    fn signed_area(mesh: &MeshData, triangle: [u32; 3]) -> f64 {
        let [a, b, c] = triangle.map(|index| mesh.vertices[index as usize]);
        (b - a).cross(c - a).z
    }

    #[test]
    fn corners_are_counted_from_either_end() {
        let text = "o part\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl red\nf 1/1/1 2//1 3/1\nf -3 -2 -1\n";
        let mesh = read(text.as_bytes()).unwrap();
        assert_eq!(mesh.vertices[1], Point::new(1.0, 0.0, 0.0));
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 1, 2]]);
    }

    #[test]
    fn lines_are_continued_and_comments_cut() {
        let mesh =
            read(b"v 0 0 0 # \xff origin\r\nv 1 0 0\r\nv 0 \\\r\n1 0\r\nf 1 2 \\\n 3").unwrap();
        assert_eq!(mesh.vertices[2], Point::new(0.0, 1.0, 0.0));
        assert_eq!(mesh.triangles, [[0, 1, 2]]);
    }

    #[test]
    fn concave_polygons_keep_their_area_and_side() {
        // An arrowhead of area 2 − 1 = 1, once seen from either side; a fan from its first corner would cover 3.
        let vertices = "v 1 0 0\nv 2 -1 0\nv 1 1 0\nv 0 -1 0\n";
        for (face, area) in [("f 1 2 3 4", 1.0), ("f 4 3 2 1", -1.0), ("f 2 3 4 1", 1.0)] {
            let mesh = read(format!("{vertices}{face}\n").as_bytes()).unwrap();
            assert_eq!(mesh.triangles.len(), 2);
            let areas = mesh
                .triangles
                .iter()
                .map(|triangle| signed_area(&mesh, *triangle) / 2.0);
            assert!(areas.clone().all(|part| part * area > 0.0), "{face}");
            assert!((areas.sum::<f64>() - area).abs() < 1e-15, "{face}");
        }
    }

    #[test]
    fn every_corner_and_edge_of_a_polygon_is_kept() {
        // A unit square with a corner in the middle of a side, and one that is folded along its diagonal.
        let square = "v 0 0 0\nv 0.5 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4 5\n";
        let mesh = read(square.as_bytes()).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
        let folded = "v 0 0 0\nv 1 0 4\nv 0 0 0.1\nv 0 1 4\nf 1 2 3 4\n";
        assert_eq!(read(folded.as_bytes()).unwrap().triangles.len(), 2);
    }

    #[test]
    fn errors_name_their_line() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        for (text, line, expected) in [
            ("v 0 0\n", 1, ObjFault::Vertex("v 0 0".into())),
            ("v 0 0 nan\n", 1, ObjFault::Vertex("v 0 0 nan".into())),
            ("v 0 x 0\n", 1, ObjFault::Vertex("v 0 x 0".into())),
            (
                "f 1 2\n",
                4,
                ObjFault::NoSuchVertex {
                    number: 1,
                    vertices: 0,
                },
            ),
            ("curv 0 1 1 2\n", 1, ObjFault::FreeForm("curv".into())),
            ("# nothing\n\n", 3, ObjFault::NoFace),
        ] {
            let text = if line == 4 {
                format!("\n\n\n{text}")
            } else {
                text.to_owned()
            };
            assert_eq!(fault(&text), (line, expected), "{text}");
        }
        for (face, expected) in [
            ("f 1 2", ObjFault::TooFewCorners(2)),
            (
                "f 1 2 4",
                ObjFault::NoSuchVertex {
                    number: 4,
                    vertices: 3,
                },
            ),
            (
                "f 0 1 2",
                ObjFault::NoSuchVertex {
                    number: 0,
                    vertices: 3,
                },
            ),
            (
                "f -4 1 2",
                ObjFault::NoSuchVertex {
                    number: -4,
                    vertices: 3,
                },
            ),
            ("f 1 2 /3", ObjFault::Corner("/3".into())),
            ("f 1 2 1 2", ObjFault::Polygon(4)),
        ] {
            assert_eq!(
                fault(&format!("{vertices}{face}\n")),
                (4, expected),
                "{face}"
            );
        }
    }

    proptest! {
        #[test]
        fn any_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            let _ = read(&bytes);
        }

        #[test]
        fn any_statements_give_indices_in_range(
            lines in prop::collection::vec("(v|f|vn|curv)( (-?[0-9]{1,2}|1e999|x|/|1/2/3)){0,6}", 0..20),
        ) {
            if let Ok(mesh) = read(lines.join("\n").as_bytes()) {
                prop_assert!(mesh.triangles.iter().flatten().all(|index| (*index as usize) < mesh.vertices.len()));
                prop_assert!(mesh.vertices.iter().all(|vertex| vertex.is_finite()));
            }
        }
    }
}
