//! `EXT_mesh_gpu_instancing`: many copies of a node's mesh.

use steradian::geometry::Transform;

use super::accessors::Elements;
use super::document::Document;
use super::error::GltfError;
use super::nodes::of_parts;
use super::schema::Instancing;

/// More shapes than this are refused.
pub(super) const MOST_SHAPES: usize = 1 << 20;

/// The transforms of the copies in the node's own coordinates.
pub(super) fn transforms(
    document: &Document<'_>,
    instancing: &Instancing,
    place: &str,
) -> Result<Vec<Transform>, GltfError> {
    let place = format!("{place}.extensions.EXT_mesh_gpu_instancing");
    let elements = |name: &str, kind: &str| {
        let index = instancing.attributes.get(name);
        index
            .map(|index| Elements::new(document, *index, &[kind], &place))
            .transpose()
    };
    let translation = elements("TRANSLATION", "VEC3")?;
    let rotation = elements("ROTATION", "VEC4")?;
    let scale = elements("SCALE", "VEC3")?;
    let given = [&translation, &rotation, &scale];
    let counts = given.into_iter().flatten().map(Elements::count);
    let count = counts.min().unwrap_or(0);
    document.count(count)?;
    let copy = |index| {
        let translation = at(&translation, index, [0.0; 3])?;
        let rotation = at(&rotation, index, [0.0, 0.0, 0.0, 1.0])?;
        of_parts(translation, rotation, at(&scale, index, [1.0; 3])?).ok_or_else(|| {
            GltfError::at(
                &place,
                format!("the rotation of copy {index} is no quaternion"),
            )
        })
    };
    (0..count).map(copy).collect()
}

pub(super) fn too_many() -> GltfError {
    GltfError::TooLarge {
        what: "shapes",
        limit: MOST_SHAPES,
    }
}

fn at<const N: usize>(
    elements: &Option<Elements<'_>>,
    index: usize,
    otherwise: [f64; N],
) -> Result<[f64; N], GltfError> {
    elements
        .as_ref()
        .map_or(Ok(otherwise), |elements| elements.at(index))
}
