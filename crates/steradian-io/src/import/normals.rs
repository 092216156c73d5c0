//! Normals of the vertices of mesh files.

use steradian::geometry::Direction;

/// What readers say where they do not use the normals of a mesh.
pub(super) const LEFT_OUT: &str =
    "normals of vertices are left out: some are missing, of no length or not finite";

/// The normal, made as long as 1; `None` if it has no direction.
pub(super) fn unit(normal: [f64; 3]) -> Option<[f32; 3]> {
    let normal = Direction::try_from(normal).ok()?;
    Some(<[f64; 3]>::from(normal).map(|part| part as f32))
}
