//! STL: triangles alone, in text or binary.
//!
//! A file of exactly 84 + 50 n bytes, n being the number at byte 80, is binary whatever it begins with; else one that
//! begins with `solid` and has a `facet` is text. Corners with equal coordinates become one vertex. Normals are passed over,
//! for that of a triangle follows from its corners, and so are the colours that some programs put into the attribute.
//!
//! ```
//! let text = b"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
//! let file = steradian_io::import::stl::read(text)?;
//! assert_eq!(file.parts[0].mesh.triangles, [[0, 1, 2]]);
//! # Ok::<(), steradian_io::import::stl::StlError>(())
//! ```

use std::collections::HashMap;

use steradian::geometry::Point;
use steradian::scene::description::MeshData;
use thiserror::Error;

use super::mesh_file::MeshFile;

/// What is wrong with an STL file.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum StlError {
    /// Neither text nor long enough for a binary header.
    #[error("neither a text STL file (\"solid …\") nor a binary one, which has 84 bytes or more")]
    NoStl,
    /// A binary file that is shorter than its header says.
    #[error(
        "the header says {triangles} triangles, which need {needed} bytes, but the file has {found}"
    )]
    Truncated {
        /// Triangles of the header.
        triangles: u32,
        /// Bytes that they need.
        needed: u64,
        /// Bytes of the file.
        found: usize,
    },
    /// A line of a text file that does not belong there.
    #[error("line {line}: expected {expected}, found \"{found}\"")]
    Line {
        /// The line, from 1.
        line: usize,
        /// What would be right.
        expected: &'static str,
        /// The line's text, or how it begins.
        found: String,
    },
    /// A corner of a binary file that is not finite.
    #[error("vertex {vertex} of triangle {triangle} (both from 1) is not finite")]
    Vertex {
        /// The triangle, from 1.
        triangle: usize,
        /// Its corner, 1 to 3.
        vertex: usize,
    },
    /// A text file that ends within a facet.
    #[error("the file ends within a facet")]
    Unfinished,
    /// Nothing in it.
    #[error("no triangle in the whole file")]
    NoTriangle,
    /// More vertices than can be numbered.
    #[error("more than {} vertices", u32::MAX)]
    TooManyVertices,
}

/// Bytes before the first triangle of a binary file.
const HEADER: usize = 84;
/// Bytes of a triangle: a normal, three corners, an attribute.
const TRIANGLE: usize = 50;

/// Reads the triangles of an STL file.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn read(bytes: &[u8]) -> Result<MeshFile, StlError> {
    let mut welder = Welder::default();
    let mut warnings = Vec::new();
    match binary_count(bytes) {
        Some(count) if exact_size(count) == bytes.len() as u64 => binary(bytes, &mut welder)?,
        _ if is_text(bytes) => text(bytes, &mut welder)?,
        Some(count) if exact_size(count) < bytes.len() as u64 => {
            let more = bytes.len() as u64 - exact_size(count);
            warnings.push(format!(
                "{more} bytes after the last triangle are passed over"
            ));
            binary(&bytes[..exact_size(count) as usize], &mut welder)?;
        }
        Some(triangles) => {
            return Err(StlError::Truncated {
                triangles,
                needed: exact_size(triangles),
                found: bytes.len(),
            });
        }
        None => return Err(StlError::NoStl),
    }
    if welder.mesh.triangles.is_empty() {
        return Err(StlError::NoTriangle);
    }
    Ok(MeshFile::single(welder.mesh, warnings))
}

fn binary_count(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u32::from_le_bytes(count.try_into().ok()?))
}

fn exact_size(count: u32) -> u64 {
    HEADER as u64 + TRIANGLE as u64 * u64::from(count)
}

fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    let begins = start
        .get(..5)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    let mut lines = start.split(|byte| *byte == b'\n');
    begins
        && lines.any(|line| {
            line.trim_ascii_start()
                .get(..5)
                .is_some_and(|word| word.eq_ignore_ascii_case(b"facet"))
        })
}

fn binary(bytes: &[u8], welder: &mut Welder) -> Result<(), StlError> {
    for (index, triangle) in bytes[HEADER..].chunks_exact(TRIANGLE).enumerate() {
        let (corners, _) = triangle[12..48].as_chunks::<12>();
        for (corner, bytes) in corners.iter().enumerate() {
            let (numbers, _) = bytes.as_chunks::<4>();
            let [x, y, z] = [0, 1, 2].map(|i| f64::from(f32::from_le_bytes(numbers[i])));
            let point = Point::new(x, y, z);
            if !point.is_finite() {
                return Err(StlError::Vertex {
                    triangle: index + 1,
                    vertex: corner + 1,
                });
            }
            welder.corner(point)?;
        }
    }
    Ok(())
}

fn text(bytes: &[u8], welder: &mut Welder) -> Result<(), StlError> {
    for (index, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        let line = String::from_utf8_lossy(line);
        let mut words = line.split_whitespace();
        let first = words.next().unwrap_or_default().to_ascii_lowercase();
        let wrong = |expected| StlError::Line {
            line: index + 1,
            expected,
            found: line.trim().chars().take(40).collect(),
        };
        match first.as_str() {
            "vertex" => welder
                .corner(vertex(words).ok_or_else(|| wrong("a vertex of three finite numbers"))?)?,
            "endfacet" | "facet" | "outer" | "endloop" if welder.is_within_triangle() => {
                return Err(wrong("a facet of three vertices"));
            }
            "" | "facet" | "outer" | "endloop" | "endfacet" | "solid" | "endsolid" => (),
            _ => {
                return Err(wrong(
                    "facet, outer loop, vertex, endloop, endfacet or endsolid",
                ));
            }
        }
    }
    if welder.is_within_triangle() {
        return Err(StlError::Unfinished);
    }
    Ok(())
}

fn vertex<'a>(words: impl Iterator<Item = &'a str>) -> Option<Point> {
    let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
    let [x, y, z] = numbers?[..] else { return None };
    Some(Point::new(x, y, z)).filter(|point| point.is_finite())
}

/// Collects corners three by three, equal ones as one vertex.
#[derive(Default)]
struct Welder {
    mesh: MeshData,
    known: HashMap<[u64; 3], u32>,
    corners: Vec<u32>,
}

impl Welder {
    fn corner(&mut self, point: Point) -> Result<(), StlError> {
        let next =
            u32::try_from(self.mesh.vertices.len()).map_err(|_| StlError::TooManyVertices)?;
        // Adding 0 turns −0 into 0, so that both are one vertex.
        let key = point.to_array().map(|number| (number + 0.0).to_bits());
        let index = *self.known.entry(key).or_insert(next);
        if index == next {
            self.mesh.vertices.push(point);
        }
        self.corners.push(index);
        if let [a, b, c] = self.corners[..] {
            self.mesh.triangles.push([a, b, c]);
            self.corners.clear();
        }
        Ok(())
    }

    fn is_within_triangle(&self) -> bool {
        !self.corners.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SQUARE: [[[f32; 3]; 3]; 2] = [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
        [[-0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
    ];

    fn binary_file(start: &[u8], count: u32, triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
        let mut bytes = start.to_vec();
        bytes.resize(80, b' ');
        bytes.extend(count.to_le_bytes());
        for triangle in triangles {
            bytes.extend([0; 12]);
            bytes.extend(
                triangle
                    .iter()
                    .flatten()
                    .flat_map(|number| number.to_le_bytes()),
            );
            bytes.extend([0xff, 0x83]);
        }
        bytes
    }

    fn text_file(triangles: &[[[f32; 3]; 3]]) -> String {
        let facet = |corners: &[[f32; 3]; 3]| {
            let vertices = corners
                .map(|[x, y, z]| format!("  vertex {x} {y:e} {z}\r\n"))
                .concat();
            format!(" facet normal 0 0 0\n outer loop\n{vertices} endloop\n endfacet\n")
        };
        format!(
            "solid a b\n{}endsolid a b\n",
            triangles.iter().map(facet).collect::<String>()
        )
    }

    #[test]
    fn text_and_binary_are_told_apart_by_content() {
        let text = read(text_file(&SQUARE).as_bytes()).unwrap();
        for start in ["", "solid facet\nfacet"] {
            let binary = read(&binary_file(start.as_bytes(), 2, &SQUARE)).unwrap();
            assert_eq!(binary.parts[0].mesh, text.parts[0].mesh);
        }
        let mesh = &text.parts[0].mesh;
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(mesh.vertices.len(), 4);
    }

    #[test]
    fn what_follows_the_triangles_is_told() {
        let mut bytes = binary_file(b"", 2, &SQUARE);
        bytes.extend(b"more");
        assert_eq!(
            read(&bytes).unwrap().warnings,
            ["4 bytes after the last triangle are passed over"]
        );
    }

    #[test]
    fn a_count_is_held_against_the_size() {
        let error = read(&binary_file(b"solid", u32::MAX, &SQUARE)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the header says 4294967295 triangles, which need 214748364834 bytes, but the file has 184"
        );
        assert_eq!(
            read(&binary_file(b"", 0, &[])).unwrap_err(),
            StlError::NoTriangle
        );
        assert_eq!(read(b"solid").unwrap_err(), StlError::NoStl);
    }

    #[test]
    fn numbers_are_finite() {
        let mut triangles = SQUARE;
        triangles[1][2][0] = f32::NAN;
        let error = read(&binary_file(b"", 2, &triangles)).unwrap_err();
        assert_eq!(
            error,
            StlError::Vertex {
                triangle: 2,
                vertex: 3
            }
        );
        let error = read(text_file(&triangles).as_bytes()).unwrap_err();
        assert_eq!(
            error.to_string(),
            "line 13: expected a vertex of three finite numbers, found \"vertex NaN 1e0 0\""
        );
    }

    #[test]
    fn facets_have_three_corners() {
        let text = text_file(&SQUARE);
        for (from, to, fault) in [
            (
                "  vertex 1 1e0 0\r\n endloop",
                " endloop",
                "line 6: expected a facet of three vertices",
            ),
            (
                "endsolid a b",
                "vertex 0 0 0",
                "the file ends within a facet",
            ),
            ("outer", "inner", "line 3: expected facet, outer loop"),
        ] {
            let error = read(text.replacen(from, to, 1).as_bytes())
                .unwrap_err()
                .to_string();
            assert!(error.starts_with(fault), "{error}");
        }
    }

    proptest! {
        #[test]
        fn any_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
            let _ = read(&bytes);
        }

        #[test]
        fn any_part_of_a_file_is_read_or_refused(keep in 0_usize..400, text: bool) {
            let bytes = if text { text_file(&SQUARE).into_bytes() } else { binary_file(b"solid", 2, &SQUARE) };
            let keep = keep.min(bytes.len());
            if let Ok(file) = read(&bytes[..keep]) {
                prop_assert!(text || keep == bytes.len());
                prop_assert!(file.triangles() <= 2);
            }
        }
    }
}
