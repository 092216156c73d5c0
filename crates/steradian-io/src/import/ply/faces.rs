//! The elements `face` and `tristrips`.

use steradian::scene::description::MeshData;

use super::header::Element;
use super::{Body, PlyError};
use crate::import::polygon::Cutter;

/// Names of the list of a face's corners.
const INDICES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// The reader of faces.
#[derive(Default)]
pub(super) struct Faces {
    cutter: Cutter,
    /// Faces of one or two corners.
    too_few: usize,
}

impl Faces {
    /// Reads all faces.
    pub fn read(
        &mut self,
        element: &Element,
        body: &mut Body<'_>,
        mesh: &mut MeshData,
    ) -> Result<(), PlyError> {
        let mut corners = Vec::new();
        for index in 0..element.items() {
            read_indices(element, index, body, &mut corners)?;
            let corners = corners
                .iter()
                .map(|number| vertex(*number, mesh, element, index));
            let corners = corners.collect::<Result<Vec<u32>, _>>()?;
            if corners.len() < 3 {
                self.too_few += 1;
                continue;
            }
            self.cutter
                .cut(&mesh.vertices, &corners, &mut mesh.triangles)
                .map_err(|fault| PlyError::Polygon {
                    number: index + 1,
                    fault,
                })?;
        }
        Ok(())
    }

    /// What was passed over.
    pub fn warning(&self) -> Option<String> {
        let count = self.too_few;
        (count > 0)
            .then(|| format!("{count} faces have fewer than three corners and are passed over"))
    }
}

/// Reads strips of triangles; every other one is turned, so that all show the same side.
pub(super) fn read_strips(
    element: &Element,
    body: &mut Body<'_>,
    mesh: &mut MeshData,
) -> Result<(), PlyError> {
    let mut numbers = Vec::new();
    for index in 0..element.items() {
        read_indices(element, index, body, &mut numbers)?;
        for strip in numbers.split(|number| *number == -1.0) {
            let strip = strip
                .iter()
                .map(|number| vertex(*number, mesh, element, index));
            let strip = strip.collect::<Result<Vec<u32>, _>>()?;
            let triangles = strip
                .windows(3)
                .enumerate()
                .map(|(turn, corners)| match turn % 2 {
                    0 => [corners[0], corners[1], corners[2]],
                    _ => [corners[1], corners[0], corners[2]],
                });
            mesh.triangles.extend(triangles);
        }
    }
    Ok(())
}

/// Reads one element, and leaves its list of vertex numbers in `indices`.
fn read_indices(
    element: &Element,
    index: usize,
    body: &mut Body<'_>,
    indices: &mut Vec<f64>,
) -> Result<(), PlyError> {
    indices.clear();
    for property in &element.properties {
        let read = if INDICES.contains(&property.name.as_str()) {
            body.list(property.form, |number| indices.push(number))
        } else {
            body.skip_property(property.form)
        };
        read.map_err(|missing| missing.of(element, index))?;
    }
    Ok(())
}

fn vertex(number: f64, mesh: &MeshData, element: &Element, index: usize) -> Result<u32, PlyError> {
    let vertices = mesh.vertices.len();
    if vertices == 0 {
        return Err(PlyError::NoVertices);
    }
    if number.fract() == 0.0 && number >= 0.0 && number < vertices as f64 {
        return Ok(number as u32);
    }
    Err(PlyError::NoSuchVertex {
        element: element.name.clone(),
        number: index + 1,
        found: number.to_string(),
        vertices,
    })
}
