//! PLY, the Stanford polygon format: text, or binary in either byte order.
//!
//! | element | what is read |
//! |---|---|
//! | `vertex` | `x y z`; texture coordinates `s t`, `u v` or `texture_u texture_v`; `red green blue alpha`; normals `nx ny nz` |
//! | `face` | the list `vertex_indices` or `vertex_index`, cut into triangles |
//! | `tristrips` | the same list: strips of triangles, each ended by −1 |
//!
//! All else is passed over. Colours of integers are sRGB, those of floats are linear; alpha is linear.
//!
//! The format is that of Greg Turk's *The PLY Polygon File Format* (1994). Counts of the header are held against the size
//! of the file before any memory is set aside.
//!
//! ```
//! let text = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
//! element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1 0 0 0 1 0 3 0 1 2\n";
//! let file = steradian_io::import::ply::read(text)?;
//! assert_eq!(file.parts[0].mesh.triangles, [[0, 1, 2]]);
//! # Ok::<(), steradian_io::import::ply::PlyError>(())
//! ```

mod faces;
mod header;
mod values;
mod vertices;

use steradian::scene::description::MeshData;
use thiserror::Error;

use super::mesh_file::MeshFile;
use super::polygon::PolygonTooLarge;
use faces::Faces;
use header::{Element, Form, Header};
use values::{Missing, Values};

/// What is wrong with a PLY file. Elements are counted from 1.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlyError {
    /// No PLY file at all.
    #[error("not a PLY file: its first line is not \"ply\"")]
    Magic,
    /// A header that does not end.
    #[error("the header has no line end_header")]
    Unending,
    /// A line of the header that does not belong there.
    #[error("line {line}: expected {expected}, found \"{found}\"")]
    Header {
        /// The line, from 1.
        line: usize,
        /// What would be right.
        expected: &'static str,
        /// The line's text, or how it begins.
        found: String,
    },
    /// More elements than the file has room for.
    #[error(
        "the header says {count} of element {element}, which need {needed} bytes or more, but the file has {left} left"
    )]
    Count {
        /// The element.
        element: String,
        /// How many the header says.
        count: usize,
        /// Bytes that they need at least.
        needed: u64,
        /// Bytes that are left for them.
        left: u64,
    },
    /// A vertex without three coordinates.
    #[error("the vertices have no properties x, y and z")]
    NoPosition,
    /// No vertices before the faces.
    #[error("no element vertex before the faces")]
    NoVertices,
    /// The file ends too early.
    #[error("the file ends within {element} {number}")]
    Truncated {
        /// The element.
        element: String,
        /// Which of them.
        number: usize,
    },
    /// A word that is no number.
    #[error("{element} {number}: expected a number, found \"{found}\"")]
    NoNumber {
        /// The element.
        element: String,
        /// Which of them.
        number: usize,
        /// The word, or how it begins.
        found: String,
    },
    /// A coordinate that is not finite, or a colour that is negative or not finite.
    #[error("vertex {0} is not finite, or of a negative colour")]
    Vertex(usize),
    /// A number of a vertex that does not exist.
    #[error("{element} {number}: there is no vertex {found}; they are numbered from 0 to {}", .vertices.saturating_sub(1))]
    NoSuchVertex {
        /// `face` or `tristrips`.
        element: String,
        /// Which of them.
        number: usize,
        /// What stands there.
        found: String,
        /// Vertices of the file.
        vertices: usize,
    },
    /// A polygon that is not cut.
    #[error("face {number}: {fault}")]
    Polygon {
        /// The face.
        number: usize,
        /// What is wrong with it.
        fault: PolygonTooLarge,
    },
    /// Nothing in it.
    #[error("no face in the whole file")]
    NoFace,
    /// More vertices than can be numbered.
    #[error("more than {} vertices", u32::MAX)]
    TooManyVertices,
}

/// Reads the vertices and triangles of a PLY file.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn read(bytes: &[u8]) -> Result<MeshFile, PlyError> {
    let header = Header::read(bytes)?;
    let mut body = Body {
        values: Values::new(&header, bytes),
        warnings: vec![],
    };
    let mut mesh = MeshData::default();
    let mut faces = Faces::default();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" if mesh.vertices.is_empty() => mesh = vertices::read(element, &mut body)?,
            "face" => faces.read(element, &mut body, &mut mesh)?,
            "tristrips" => faces::read_strips(element, &mut body, &mut mesh)?,
            _ => body.skip(element)?,
        }
    }
    if mesh.triangles.is_empty() {
        return Err(PlyError::NoFace);
    }
    body.warnings.extend(faces.warning());
    Ok(MeshFile::single(mesh, body.warnings))
}

/// What is left of the file, and what was passed over so far.
struct Body<'a> {
    values: Values<'a>,
    warnings: Vec<String>,
}

impl Body<'_> {
    fn skip(&mut self, element: &Element) -> Result<(), PlyError> {
        for index in 0..element.items() {
            for property in &element.properties {
                self.skip_property(property.form)
                    .map_err(|missing| missing.of(element, index))?;
            }
        }
        Ok(())
    }

    fn skip_property(&mut self, form: Form) -> Result<(), Missing> {
        match form {
            Form::One(scalar) => self.values.next(scalar).map(|_| ()),
            Form::List { .. } => self.list(form, |_| ()),
        }
    }

    /// Gives the numbers of a list, or the one that is there, to `each`.
    fn list(&mut self, form: Form, mut each: impl FnMut(f64)) -> Result<(), Missing> {
        let (count, item) = match form {
            Form::One(scalar) => (1, scalar),
            // Negative lengths become 0; a length that exceeds the file ends with it.
            Form::List { count, item } => (self.values.next(count)? as u64, item),
        };
        for _ in 0..count {
            each(self.values.next(item)?);
        }
        Ok(())
    }
}

impl Missing {
    fn of(self, element: &Element, index: usize) -> PlyError {
        let (element, number) = (element.name.clone(), index + 1);
        match self {
            Self::End => PlyError::Truncated { element, number },
            Self::NoNumber(found) => PlyError::NoNumber {
                element,
                number,
                found,
            },
        }
    }
}

#[cfg(test)]
mod tests;
