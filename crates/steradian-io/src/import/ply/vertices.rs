//! The element `vertex`: positions, texture coordinates, colours and normals.

use steradian::geometry::Point;
use steradian::material::linear_from_srgb;
use steradian::scene::description::MeshData;

use super::header::{Element, Form, Scalar};
use super::{Body, PlyError};
use crate::import::normals;

/// The names of each number that is kept of a vertex, with the alternatives.
const NAMES: [&[&str]; COUNT] = [
    &["x"],
    &["y"],
    &["z"],
    &["s", "u", "texture_u", "texture_s"],
    &["t", "v", "texture_v", "texture_t"],
    &["red", "diffuse_red"],
    &["green", "diffuse_green"],
    &["blue", "diffuse_blue"],
    &["alpha", "diffuse_alpha"],
    &["nx"],
    &["ny"],
    &["nz"],
];
const COUNT: usize = 12;
const COORDINATES: std::ops::Range<usize> = 3..5;
const COLOUR: std::ops::Range<usize> = 5..8;
const ALPHA: usize = 8;
const NORMAL: std::ops::Range<usize> = 9..12;

/// Which property holds each number.
struct Layout<'a> {
    element: &'a Element,
    /// For each property, which of [`NAMES`] it is.
    roles: Vec<Option<usize>>,
}

/// Reads all vertices.
pub(super) fn read(element: &Element, body: &mut Body<'_>) -> Result<MeshData, PlyError> {
    let layout = Layout::new(element);
    if !layout.has(0..3) {
        return Err(PlyError::NoPosition);
    }
    if u32::try_from(element.count).is_err() {
        return Err(PlyError::TooManyVertices);
    }
    let mut mesh = MeshData {
        vertices: Vec::with_capacity(element.count),
        ..MeshData::default()
    };
    let (has_coordinates, encoding) = (layout.has(COORDINATES), layout.colour_encoding(body));
    let has_normals = layout.has(NORMAL);
    for index in 0..element.count {
        let numbers = layout.read(body, index)?;
        let [x, y, z, u, v, .., nx, ny, nz] = numbers;
        mesh.vertices.push(Point::new(x, y, z));
        if has_coordinates {
            mesh.texture_coordinates.push([u as f32, v as f32]);
        }
        if has_normals {
            mesh.normals.extend(normals::unit([nx, ny, nz]));
        }
        mesh.colors
            .extend(encoding.map(|encoding| encoding.linear(&numbers)));
        if !is_sound(&mesh) {
            return Err(PlyError::Vertex(index + 1));
        }
    }
    if has_normals && mesh.normals.len() < mesh.vertices.len() {
        body.warnings.push(normals::LEFT_OUT.into());
        mesh.normals.clear();
    }
    Ok(mesh)
}

/// Whether the last vertex has finite coordinates and a colour of finite, positive numbers.
fn is_sound(mesh: &MeshData) -> bool {
    let is_colour = |colour: &[f32; 4]| colour.iter().all(|x| x.is_finite() && *x >= 0.0);
    mesh.vertices.last().is_none_or(|point| point.is_finite())
        && mesh
            .texture_coordinates
            .last()
            .is_none_or(|pair| pair.iter().all(|x| x.is_finite()))
        && mesh.colors.last().is_none_or(is_colour)
}

impl<'a> Layout<'a> {
    fn new(element: &'a Element) -> Self {
        let role = |name: &str| NAMES.iter().position(|names| names.contains(&name));
        let roles = element
            .properties
            .iter()
            .map(|property| match property.form {
                Form::One(_) => role(&property.name),
                Form::List { .. } => None,
            });
        Self {
            element,
            roles: roles.collect(),
        }
    }

    fn has(&self, mut roles: std::ops::Range<usize>) -> bool {
        roles.all(|role| self.roles.contains(&Some(role)))
    }

    fn read(&self, body: &mut Body<'_>, index: usize) -> Result<[f64; COUNT], PlyError> {
        let mut numbers = [0.0; COUNT];
        for (property, role) in self.element.properties.iter().zip(&self.roles) {
            let missing = match (property.form, role) {
                (Form::One(scalar), Some(role)) => body
                    .values
                    .next(scalar)
                    .map(|number| numbers[*role] = number),
                (form, _) => body.skip_property(form),
            };
            missing.map_err(|missing| missing.of(self.element, index))?;
        }
        Ok(numbers)
    }

    /// How colours are written, if there are any that can be told.
    fn colour_encoding(&self, body: &mut Body<'_>) -> Option<ColourEncoding> {
        if !self.has(COLOUR) {
            return None;
        }
        let scalar_of = |role| {
            let index = self.roles.iter().position(|found| *found == Some(role))?;
            match self.element.properties[index].form {
                Form::One(scalar) => Some(scalar),
                Form::List { .. } => None,
            }
        };
        let colour = ColourEncoding {
            greatest: greatest(scalar_of(COLOUR.start)?),
            alpha: scalar_of(ALPHA).map(greatest),
        };
        let encoding = match colour.greatest {
            None => "floats are read as linear Rec.709",
            Some(_) => "integers are read as sRGB",
        };
        body.warnings.push(format!("vertex colours of {encoding}"));
        Some(colour)
    }
}

/// What stands for 1; `None` for 1 itself.
fn greatest(scalar: Scalar) -> Option<f64> {
    match scalar {
        Scalar::F32 | Scalar::F64 => None,
        Scalar::U16 | Scalar::I16 => Some(65_535.0),
        // Integers of four bytes hold what would fit into one.
        Scalar::U8 | Scalar::I8 | Scalar::U32 | Scalar::I32 => Some(255.0),
    }
}

#[derive(Copy, Clone)]
struct ColourEncoding {
    /// Of red, green and blue; integers are sRGB.
    greatest: Option<f64>,
    /// Of alpha, if there is one.
    alpha: Option<Option<f64>>,
}

impl ColourEncoding {
    /// Linear Rec.709 and alpha.
    fn linear(self, numbers: &[f64; COUNT]) -> [f32; 4] {
        let [.., red, green, blue, alpha, _, _, _] = *numbers;
        let [red, green, blue] = [red, green, blue].map(|number| match self.greatest {
            None => number,
            Some(greatest) => linear_from_srgb(number / greatest),
        });
        let alpha = self
            .alpha
            .map_or(1.0, |greatest| alpha / greatest.unwrap_or(1.0));
        [red, green, blue, alpha].map(|number| number as f32)
    }
}
