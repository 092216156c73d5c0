//! Wavefront OBJ: polygons by material, with texture coordinates, normals and colours of vertices.
//!
//! | statement | what is read |
//! |---|---|
//! | `v x y z` | a vertex; `v x y z r g b` with its colour, in sRGB |
//! | `vt u v` | texture coordinates, v up |
//! | `vn x y z` | a normal of any length |
//! | `f a b c …` | a polygon, each corner `7`, `7/1`, `7//2`, `7/1/2` or negative: from the last one back |
//! | `usemtl NAME`, `mtllib FILE` | materials: see [`mtl`] |
//!
//! Faces of the same material are one mesh, whatever their objects (`o`) and groups (`g`). Normals count where all
//! corners of a mesh have one; elsewhere they are those of the triangles. Polygons are cut into triangles, concave ones by ear clipping. Free-form curves and surfaces
//! are refused.
//!
//! ```
//! use std::path::Path;
//! use steradian_io::files::MemoryFiles;
//! use steradian_io::import::obj::read;
//!
//! let text = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
//! let file = read(text, Path::new(""), &MemoryFiles::default())?;
//! let mesh = &file.parts[0].mesh;
//! assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (4, 2));
//! # Ok::<(), steradian_io::import::obj::ObjError>(())
//! ```

mod assembly;
mod entry;
mod lines;
mod maps;
pub mod mtl;

use std::collections::HashMap;
use std::path::Path;

use steradian::geometry::Point;
use thiserror::Error;

use super::mesh_file::MeshFile;
use super::normals;
use super::polygon::{Cutter, PolygonTooLarge};
use crate::files::Files;
use lines::{logical_lines, numbers, statement};

/// What is wrong with an OBJ file or one of its material libraries, and in which line.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{}line {line}: {fault}", .library.as_deref().map(|name| format!("{name}, ")).unwrap_or_default())]
pub struct ObjError {
    /// The material library it is in; `None` for the OBJ file itself.
    pub library: Option<String>,
    /// The line, from 1.
    pub line: usize,
    /// What is wrong with it.
    pub fault: ObjFault,
}

/// What can be wrong with a line of an OBJ or MTL file.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ObjFault {
    /// A vertex without three finite coordinates.
    #[error("expected a vertex of three finite numbers, found \"{0}\"")]
    Vertex(String),
    /// Texture coordinates that are not finite.
    #[error("expected texture coordinates of finite numbers, found \"{0}\"")]
    Coordinates(String),
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
    /// A face with a number of texture coordinates that none before it has.
    #[error("there are no texture coordinates {number}: {coordinates} precede this line")]
    NoSuchCoordinates {
        /// The number in the file.
        number: i64,
        /// Texture coordinates so far.
        coordinates: usize,
    },
    /// A face with a number of a normal that none before it has.
    #[error("there is no normal {number}: {normals} precede this line")]
    NoSuchNormal {
        /// The number in the file.
        number: i64,
        /// Normals so far.
        normals: usize,
    },
    /// A face of fewer than three corners.
    #[error("a face needs three corners or more, found {0}")]
    TooFewCorners(usize),
    /// A polygon that is not cut.
    #[error(transparent)]
    Polygon(#[from] PolygonTooLarge),
    /// A statement of free-form geometry.
    #[error("free-form geometry (`{0}`) is not supported")]
    FreeForm(String),
    /// More vertices than can be numbered.
    #[error("more than {} vertices", u32::MAX)]
    TooManyVertices,
    /// No face in the whole file.
    #[error("no face in the whole file")]
    NoFace,
    /// A statement of a material library with other values than it needs.
    #[error("expected {expected}, found \"{found}\"")]
    Material {
        /// What would be right.
        expected: &'static str,
        /// The line's text, or how it begins.
        found: String,
    },
    /// A statement of a material library before its first material.
    #[error("expected `newmtl` before `{0}`")]
    NoMaterial(String),
}

/// Reads an OBJ file. The files that it names are relative to `directory`; a material library that cannot be read is told
/// in the warnings.
///
/// # Errors
/// The first line that cannot be read.
pub fn read(bytes: &[u8], directory: &Path, files: &dyn Files) -> Result<MeshFile, ObjError> {
    let mut reader = Reader::default();
    let mut last = 1;
    for (line, text) in logical_lines(bytes) {
        reader.line(&text).map_err(|fault| ObjError {
            library: None,
            line,
            fault,
        })?;
        last = line;
    }
    if reader.runs.iter().all(|run| run.triangles.is_empty()) {
        return Err(ObjError {
            library: None,
            line: last,
            fault: ObjFault::NoFace,
        });
    }
    let library = mtl::read_all(&reader.libraries, directory, files)?;
    assembly::assemble(reader, library)
}

/// A corner of a face.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
struct Corner {
    vertex: u32,
    coordinates: Option<u32>,
    normal: Option<u32>,
}

/// The triangles of one material.
#[derive(Default)]
struct Run {
    /// `None` before the first `usemtl`.
    material: Option<String>,
    triangles: Vec<[Corner; 3]>,
}

impl Run {
    fn corners(&self) -> impl Iterator<Item = &Corner> {
        self.triangles.iter().flatten()
    }
}

#[derive(Default)]
struct Reader {
    vertices: Vec<Point>,
    /// sRGB of each vertex so far; dropped when one has none.
    colors: Vec<[f64; 3]>,
    coordinates: Vec<[f32; 2]>,
    /// `None` for one without a direction.
    normals: Vec<Option<[f32; 3]>>,
    runs: Vec<Run>,
    run_of: HashMap<String, usize>,
    run: usize,
    libraries: Vec<String>,
    cutter: Cutter,
}

impl Reader {
    fn line(&mut self, text: &str) -> Result<(), ObjFault> {
        let (word, rest) = statement(text);
        match word {
            "v" => self
                .vertex(rest)
                .ok_or_else(|| ObjFault::Vertex(text.to_owned()))?,
            "vt" => {
                let coordinates =
                    coordinates(rest).ok_or_else(|| ObjFault::Coordinates(text.to_owned()))?;
                self.coordinates.push(coordinates);
            }
            "vn" => self.normals.push(normal(rest)),
            "f" => self.face(rest)?,
            "usemtl" => self.use_material(rest),
            "mtllib" => self.libraries.push(rest.to_owned()),
            "cstype" | "curv" | "curv2" | "surf" => {
                return Err(ObjFault::FreeForm(word.to_owned()));
            }
            _ => (),
        }
        Ok(())
    }

    fn vertex(&mut self, text: &str) -> Option<()> {
        let numbers = numbers(text)?;
        let [x, y, z, ref more @ ..] = numbers[..] else {
            return None;
        };
        if let &[red, green, blue] = more
            && self.colors.len() == self.vertices.len()
            && red.min(green).min(blue) >= 0.0
        {
            self.colors.push([red, green, blue]);
        }
        self.vertices.push(Point::new(x, y, z));
        Some(())
    }

    fn use_material(&mut self, name: &str) {
        let next = self.runs.len();
        self.run = *self.run_of.entry(name.to_owned()).or_insert(next);
        if self.run == next {
            self.runs.push(Run {
                material: Some(name.to_owned()),
                triangles: vec![],
            });
        }
    }

    fn face(&mut self, text: &str) -> Result<(), ObjFault> {
        let corners = text.split_whitespace().map(|word| self.corner(word));
        let corners = corners.collect::<Result<Vec<Corner>, _>>()?;
        if self.runs.is_empty() {
            self.runs.push(Run::default());
        }
        let triangles = &mut self.runs[self.run].triangles;
        match corners[..] {
            [] | [_] | [_, _] => return Err(ObjFault::TooFewCorners(corners.len())),
            [a, b, c] => triangles.push([a, b, c]),
            _ => {
                let places = corners
                    .iter()
                    .map(|corner| self.vertices[corner.vertex as usize]);
                let numbers: Vec<u32> = (0..corners.len() as u32).collect();
                let mut cut = Vec::new();
                self.cutter
                    .cut(&places.collect::<Vec<_>>(), &numbers, &mut cut)?;
                triangles.extend(cut.iter().map(|triple| triple.map(|i| corners[i as usize])));
            }
        }
        Ok(())
    }

    /// What `7`, `7/1`, `7//2`, `7/1/2` or `-1` means.
    fn corner(&self, word: &str) -> Result<Corner, ObjFault> {
        let mut numbers = word.split('/').map(|number| match number {
            "" => Ok(None),
            number => number
                .parse::<i64>()
                .map(Some)
                .map_err(|_| ObjFault::Corner(word.to_owned())),
        });
        let number = numbers.next().transpose()?.flatten();
        let number = number.ok_or_else(|| ObjFault::Corner(word.to_owned()))?;
        let coordinates = numbers.next().transpose()?.flatten();
        let normal = numbers.next().transpose()?.flatten();
        Ok(Corner {
            vertex: self.numbered_vertex(number)?,
            coordinates: coordinates
                .map(|number| self.numbered_coordinates(number))
                .transpose()?,
            normal: normal
                .map(|number| self.numbered_normal(number))
                .transpose()?,
        })
    }

    fn numbered_vertex(&self, number: i64) -> Result<u32, ObjFault> {
        let vertices = self.vertices.len();
        counted(number, vertices).ok_or(ObjFault::NoSuchVertex { number, vertices })
    }

    fn numbered_coordinates(&self, number: i64) -> Result<u32, ObjFault> {
        let coordinates = self.coordinates.len();
        let missing = ObjFault::NoSuchCoordinates {
            number,
            coordinates,
        };
        counted(number, coordinates).ok_or(missing)
    }

    fn numbered_normal(&self, number: i64) -> Result<u32, ObjFault> {
        let normals = self.normals.len();
        counted(number, normals).ok_or(ObjFault::NoSuchNormal { number, normals })
    }

    /// The normal of a corner, if it has one with a direction.
    fn normal(&self, corner: &Corner) -> Option<[f32; 3]> {
        self.normals[corner.normal? as usize]
    }
}

/// The index that a number from 1, or a negative one from the end, means.
fn counted(number: i64, count: usize) -> Option<u32> {
    let index = if number < 0 {
        number.checked_add(i64::try_from(count).ok()?)
    } else {
        number.checked_sub(1)
    };
    let index = u32::try_from(index?).ok()?;
    ((index as usize) < count).then_some(index)
}

fn coordinates(text: &str) -> Option<[f32; 2]> {
    let numbers = numbers(text)?;
    let u = *numbers.first()? as f32;
    let v = numbers.get(1).map_or(0.0, |v| *v as f32);
    (u.is_finite() && v.is_finite()).then_some([u, v])
}

fn normal(text: &str) -> Option<[f32; 3]> {
    let &[x, y, z] = &numbers(text)?[..] else {
        return None;
    };
    normals::unit([x, y, z])
}

#[cfg(test)]
mod tests;
