//! The tree of nodes: each places its children, its mesh, its lamp and its camera.
//!
//! x′ = T R S x, or a matrix; a child's is applied before its parent's. glTF's y axis points up: the point (x, y, z) of
//! the file is the point (x, −z, y) of the description.

use steradian::geometry::{Transform, Vector};

use super::document::part;
use super::error::GltfError;
use super::schema::{Node, Root};
use crate::import::scene::y_to_z_up;

/// A node with the transform from its own coordinates to those of the description.
pub(super) struct Placed {
    pub node: usize,
    pub transform: Transform,
}

/// The nodes of the file's scene, parents before children, in the order of the file.
pub(super) fn placed(root: &Root) -> Result<Vec<Placed>, GltfError> {
    let mut placed = Vec::new();
    let mut seen = vec![false; root.nodes.len()];
    let (place, tops) = tops(root)?;
    let mut waiting: Vec<(usize, Transform, String)> = Vec::new();
    for &node in tops.iter().rev() {
        waiting.push((node, y_to_z_up(), place.clone()));
    }
    while let Some((index, parent, place)) = waiting.pop() {
        let node = part(&root.nodes, index, "node", place)?;
        let place = format!("nodes[{index}]");
        if std::mem::replace(&mut seen[index], true) {
            let fault = "it is reached twice, but nodes form trees";
            return Err(GltfError::at(place, fault));
        }
        let transform = local(node, &place)?.then(parent);
        let children = node.children.iter().rev();
        waiting.extend(children.map(|child| (*child, transform, place.clone())));
        placed.push(Placed {
            node: index,
            transform,
        });
    }
    Ok(placed)
}

/// The uppermost nodes of the scene, and where they are listed: all that are no child if the file has no scene.
fn tops(root: &Root) -> Result<(String, Vec<usize>), GltfError> {
    if root.scene.is_none() && root.scenes.is_empty() {
        let mut is_child = vec![false; root.nodes.len()];
        for &child in root.nodes.iter().flat_map(|node| &node.children) {
            if let Some(is_child) = is_child.get_mut(child) {
                *is_child = true;
            }
        }
        let tops = (0..root.nodes.len()).filter(|node| !is_child[*node]);
        return Ok(("nodes".into(), tops.collect()));
    }
    let index = root.scene.unwrap_or(0);
    let scene = part(&root.scenes, index, "scene", "scene")?;
    Ok((format!("scenes[{index}]"), scene.nodes.clone()))
}

fn local(node: &Node, place: &str) -> Result<Transform, GltfError> {
    if let Some(matrix) = &node.matrix {
        return of_matrix(matrix).ok_or_else(|| {
            GltfError::at(
                place,
                "its matrix is not affine: its last row is not 0 0 0 1",
            )
        });
    }
    let rotation = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale = node.scale.unwrap_or([1.0; 3]);
    let translation = node.translation.unwrap_or_default();
    of_parts(translation, rotation, scale)
        .ok_or_else(|| GltfError::at(place, "its rotation is no quaternion of length 1"))
}

/// By columns.
fn of_matrix(matrix: &[f64; 16]) -> Option<Transform> {
    let column = |index: usize| Vector::new(matrix[index], matrix[index + 1], matrix[index + 2]);
    let last = [matrix[3], matrix[7], matrix[11], matrix[15] - 1.0];
    let is_affine = last.iter().all(|entry| entry.abs() < 1e-6);
    let axes = Transform::from_axes([column(0), column(4), column(8)]);
    is_affine.then(|| axes.then(Transform::translate(column(12))))
}

/// T R S; `None` if the quaternion (x, y, z, w) is no rotation.
pub(super) fn of_parts(
    translation: [f64; 3],
    [x, y, z, w]: [f64; 4],
    scale: [f64; 3],
) -> Option<Transform> {
    let square = x * x + y * y + z * z + w * w;
    if !(square > 0.25 && square < 4.0) {
        return None;
    }
    let s = 2.0 / square;
    let axes = [
        Vector::new(
            1.0 - s * (y * y + z * z),
            s * (x * y + w * z),
            s * (x * z - w * y),
        ),
        Vector::new(
            s * (x * y - w * z),
            1.0 - s * (x * x + z * z),
            s * (y * z + w * x),
        ),
        Vector::new(
            s * (x * z + w * y),
            s * (y * z - w * x),
            1.0 - s * (x * x + y * y),
        ),
    ];
    let turned = Transform::scale_axes(scale).then(Transform::from_axes(axes));
    Some(turned.then(Transform::translate(translation.into())))
}
