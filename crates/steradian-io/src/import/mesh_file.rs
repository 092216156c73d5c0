//! What a mesh file holds, whatever its format: triangles by material, and the materials themselves.

use std::sync::Arc;

use steradian::scene::description::{
    EmissionDescription, LaneValues, MaterialDescription, MaterialModel, MeshData, Pattern,
    Placement, Texture, Varying,
};

/// The triangles of a file by material, in the file's own unit and axes.
#[derive(Clone, Debug, Default)]
pub struct MeshFile {
    /// One mesh a material, in order of first use; at least one.
    pub parts: Vec<MeshPart>,
    /// The materials that parts refer to.
    pub materials: Vec<MeshMaterial>,
    /// What was approximated or passed over.
    pub warnings: Vec<String>,
    /// The format itself says which axis points up and what the unit is: this is in metres, z up.
    pub is_oriented: bool,
}

/// The triangles of one material.
#[derive(Clone, Debug)]
pub struct MeshPart {
    /// Vertices and triangles.
    pub mesh: Arc<MeshData>,
    /// Index into the materials of the file; `None` where the file names none.
    pub material: Option<usize>,
}

/// A material of a mesh file.
#[derive(Clone, Debug)]
pub struct MeshMaterial {
    /// How it reflects.
    pub material: MaterialDescription,
    /// What its surfaces emit.
    pub emission: Option<EmissionDescription>,
}

impl MeshFile {
    /// A file of one mesh. Colours of its vertices, if it has any, are its reflectance.
    pub(super) fn single(mesh: MeshData, warnings: Vec<String>) -> Self {
        let materials = if mesh.colors.is_empty() {
            vec![]
        } else {
            vec![vertex_colors()]
        };
        let part = MeshPart {
            material: (!materials.is_empty()).then_some(0),
            mesh: Arc::new(mesh),
        };
        Self {
            parts: vec![part],
            materials,
            warnings,
            is_oriented: false,
        }
    }

    /// The number of a material, which is added unless there is one of its name.
    pub(super) fn index_of(&mut self, material: MeshMaterial) -> usize {
        let name = &material.material.name;
        let known = self
            .materials
            .iter()
            .position(|known| known.material.name == *name);
        known.unwrap_or_else(|| {
            self.materials.push(material);
            self.materials.len() - 1
        })
    }

    /// Says something, once.
    pub(super) fn warn(&mut self, warning: &str) {
        if !self.warnings.iter().any(|said| said == warning) {
            self.warnings.push(warning.into());
        }
    }

    /// How many triangles have no area.
    pub fn triangles_without_area(&self) -> usize {
        let parts = self.parts.iter();
        parts.map(|part| triangles_without_area(&part.mesh)).sum()
    }

    /// How many triangles there are.
    pub fn triangles(&self) -> usize {
        let parts = self.parts.iter();
        parts.map(|part| part.mesh.triangles.len()).sum()
    }

    /// All parts in one mesh. Texture coordinates, colours and normals are kept if all parts have them.
    ///
    /// `None` if there are more vertices than can be numbered.
    pub fn merged(&self) -> Option<Arc<MeshData>> {
        if let [part] = &self.parts[..] {
            return Some(Arc::clone(&part.mesh));
        }
        let meshes = || self.parts.iter().map(|part| &*part.mesh);
        let mut all = MeshData::default();
        for mesh in meshes() {
            let first = u32::try_from(all.vertices.len()).ok()?;
            first.checked_add(u32::try_from(mesh.vertices.len()).ok()?)?;
            let moved = mesh
                .triangles
                .iter()
                .map(|triangle| triangle.map(|i| i + first));
            all.triangles.extend(moved);
            all.vertices.extend_from_slice(&mesh.vertices);
        }
        if meshes().all(|mesh| !mesh.texture_coordinates.is_empty()) {
            all.texture_coordinates = meshes()
                .flat_map(|mesh| mesh.texture_coordinates.clone())
                .collect();
        }
        if meshes().all(|mesh| !mesh.colors.is_empty()) {
            all.colors = meshes().flat_map(|mesh| mesh.colors.clone()).collect();
        }
        if meshes().all(|mesh| !mesh.normals.is_empty()) {
            all.normals = meshes().flat_map(|mesh| mesh.normals.clone()).collect();
        }
        Some(Arc::new(all))
    }
}

/// How many triangles of a mesh have no area.
fn triangles_without_area(mesh: &MeshData) -> usize {
    let is_flat = |triangle: &&[u32; 3]| {
        let [a, b, c] = triangle.map(|corner| mesh.vertices[corner as usize]);
        (b - a).cross(c - a).length() == 0.0
    };
    mesh.triangles.iter().filter(is_flat).count()
}

/// The material of a mesh that has nothing but colours at its vertices.
pub(super) fn vertex_colors() -> MeshMaterial {
    let texture = Texture {
        pattern: Pattern::VertexColor,
        placement: Placement::default(),
    };
    let reflectance = Varying {
        factor: LaneValues::Uniform(1.0),
        textures: vec![texture],
    };
    MeshMaterial {
        material: MaterialDescription::new(
            "vertex colours",
            MaterialModel::Lambertian { reflectance },
        ),
        emission: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use steradian::geometry::Point;

    fn part(x: f64, coordinates: usize) -> MeshPart {
        let corner = |y, z| Point::new(x, y, z);
        let mesh = MeshData {
            vertices: vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)],
            triangles: vec![[0, 1, 2], [0, 1, 1]],
            texture_coordinates: vec![[0.0, 1.0]; coordinates],
            normals: vec![[0.0, 0.0, 1.0]; coordinates],
            ..MeshData::default()
        };
        MeshPart {
            mesh: Arc::new(mesh),
            material: None,
        }
    }

    #[test]
    fn parts_are_merged_with_what_all_of_them_have() {
        for (second, kept) in [(3, 6), (0, 0)] {
            let file = MeshFile {
                parts: vec![part(0.0, 3), part(7.0, second)],
                ..MeshFile::default()
            };
            let merged = file.merged().unwrap();
            assert_eq!(merged.triangles[2..], [[3, 4, 5], [3, 4, 4]]);
            assert_eq!(merged.vertices[4], Point::new(7.0, 1.0, 0.0));
            assert_eq!(merged.texture_coordinates.len(), kept);
            assert_eq!(merged.normals.len(), kept);
            assert_eq!((file.triangles(), file.triangles_without_area()), (4, 2));
        }
    }
}
