//! Primitives: positions, normals, colours and texture coordinates of vertices, and the triangles they form.
//!
//! Triangles, strips and fans are read; points and lines have no area. Only the vertices that triangles use are kept.
//! Tangents are passed over: they follow from the texture coordinates.

use steradian::geometry::Point;
use steradian::scene::description::MeshData;

use super::accessors::Elements;
use super::document::Document;
use super::error::GltfError;
use super::schema::Primitive;
use crate::import::normals::unit;

/// Reads the triangles of a primitive, with the texture coordinates of one set; `None` if it has none.
pub(super) fn read(
    document: &Document<'_>,
    primitive: &Primitive,
    coordinates: Option<usize>,
    place: &str,
) -> Result<Option<MeshData>, GltfError> {
    let attribute = |name: &str, types: &[&str]| {
        let index = primitive.attributes.get(name);
        index
            .map(|index| Elements::new(document, *index, types, place))
            .transpose()
    };
    let Some(positions) = attribute("POSITION", &["VEC3"])? else {
        return Ok(None);
    };
    let corners = corners(document, primitive, positions.count(), place)?;
    let mut triangles = triangles(primitive.mode.unwrap_or(TRIANGLES), &corners);
    if triangles.is_empty() {
        return Ok(None);
    }
    let used = used(&mut triangles, positions.count());
    let colors = attribute("COLOR_0", &["VEC3", "VEC4"])?;
    let texcoord = coordinates.map(|set| format!("TEXCOORD_{set}"));
    let texcoord = texcoord.map_or(Ok(None), |name| attribute(&name, &["VEC2"]))?;
    Ok(Some(MeshData {
        vertices: each(Some(positions), &used, Point::from)?,
        triangles,
        texture_coordinates: each(texcoord, &used, |[u, v]: [f64; 2]| {
            [u as f32, (1.0 - v) as f32]
        })?,
        colors: each(colors, &used, |color: [f64; 4]| {
            color.map(|lane| lane.clamp(0.0, 1.0) as f32)
        })?,
        normals: normals(attribute("NORMAL", &["VEC3"])?, &used),
    }))
}

const TRIANGLES: u32 = 4;
const STRIP: u32 = 5;
const FAN: u32 = 6;

/// The vertex number of each corner in turn.
fn corners(
    document: &Document<'_>,
    primitive: &Primitive,
    vertices: usize,
    place: &str,
) -> Result<Vec<u32>, GltfError> {
    let Some(index) = primitive.indices else {
        document.count(vertices)?;
        let last = u32::try_from(vertices);
        let last = last.map_err(|_| GltfError::at(place, "it has too many vertices"))?;
        return Ok((0..last).collect());
    };
    let indices = Elements::new(document, index, &["SCALAR"], place)?;
    indices.check_indices()?;
    document.count(indices.count())?;
    let corner = |at| {
        let [number] = indices.at::<1>(at)?;
        if number < vertices as f64 {
            return Ok(number as u32);
        }
        let fault = format!("element {at} is vertex {number}, but {place} has {vertices} vertices");
        Err(GltfError::at(indices.place(), fault))
    };
    (0..indices.count()).map(corner).collect()
}

/// Triples of corners, all with the same side in front.
fn triangles(mode: u32, corners: &[u32]) -> Vec<[u32; 3]> {
    match (mode, corners) {
        (TRIANGLES, _) => corners.as_chunks::<3>().0.to_vec(),
        (STRIP, _) => {
            let turned = corners.windows(3).enumerate();
            turned
                .map(|(number, three)| match number % 2 {
                    0 => [three[0], three[1], three[2]],
                    _ => [three[1], three[0], three[2]],
                })
                .collect()
        }
        (FAN, [hub, rim @ ..]) => {
            let spokes = rim.windows(2);
            spokes.map(|two| [*hub, two[0], two[1]]).collect()
        }
        _ => vec![],
    }
}

/// The numbers of the vertices that are kept; the triangles are renumbered.
fn used(triangles: &mut [[u32; 3]], vertices: usize) -> Vec<u32> {
    let corners = triangles.as_flattened_mut();
    if vertices <= corners.len() {
        return (0..vertices as u32).collect();
    }
    let mut used = corners.to_vec();
    used.sort_unstable();
    used.dedup();
    for corner in corners {
        *corner = used.partition_point(|vertex| vertex < corner) as u32;
    }
    used
}

/// What `convert` makes of an attribute of the used vertices; nothing if there is no such attribute.
fn each<const N: usize, T>(
    elements: Option<Elements<'_>>,
    used: &[u32],
    convert: impl Fn([f64; N]) -> T,
) -> Result<Vec<T>, GltfError> {
    let Some(elements) = elements else {
        return Ok(vec![]);
    };
    if let Some(last) = used
        .last()
        .filter(|last| **last as usize >= elements.count())
    {
        let fault = format!(
            "it has {} elements, but there is a vertex {last}",
            elements.count()
        );
        return Err(GltfError::at(elements.place(), fault));
    }
    let element = |vertex: &u32| elements.at(*vertex as usize).map(&convert);
    used.iter().map(element).collect()
}

/// The normals of the used vertices; none unless all have a direction.
fn normals(elements: Option<Elements<'_>>, used: &[u32]) -> Vec<[f32; 3]> {
    let normal = |vertex: &u32| {
        let elements = elements.as_ref()?;
        let vertex = Some(*vertex as usize).filter(|vertex| *vertex < elements.count())?;
        unit(elements.at(vertex).ok()?)
    };
    let normals: Option<Vec<_>> = used.iter().map(normal).collect();
    normals.unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_keep_their_side() {
        let corners = [0, 1, 2, 3, 4];
        let strip = [[0, 1, 2], [2, 1, 3], [2, 3, 4]];
        assert_eq!(triangles(STRIP, &corners), strip);
        let fan = [[0, 1, 2], [0, 2, 3], [0, 3, 4]];
        assert_eq!(triangles(FAN, &corners), fan);
        assert_eq!(triangles(TRIANGLES, &corners), [[0, 1, 2]]);
        assert!(triangles(1, &corners).is_empty() && triangles(FAN, &[]).is_empty());
    }

    #[test]
    fn only_used_vertices_are_kept() {
        let mut triangles = [[9, 2, 5], [5, 2, 7]];
        assert_eq!(used(&mut triangles, 100), [2, 5, 7, 9]);
        assert_eq!(triangles, [[3, 0, 1], [1, 0, 2]]);
    }
}
