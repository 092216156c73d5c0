//! From a document to a description: walks over the nodes and places what they name.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;

use steradian::geometry::Transform;
use steradian::scene::description::{
    GeometryDescription, MeshData, SceneDescription, SensorDescription, SensorKind,
    ShapeDescription, SpectrumMode,
};
use steradian::shape::Parallelogram;

use super::document::{Document, part};
use super::error::GltfError;
use super::instances::{self, MOST_SHAPES};
use super::materials::{Attributes, Finish, Materials};
use super::names::Names;
use super::nodes::{self, Placed};
use super::notes::Notes;
use super::schema::{Node, Primitive};
use super::textures::Textures;
use super::uri::Resources;
use super::{cameras, extensions, lights, primitives};
use crate::import::normals;
use crate::import::scene::y_to_z_up;

/// More triangles than this are refused.
const MOST_TRIANGLES: usize = 1 << 27;

/// Reads the scene of a document; `name` is that of the file.
pub(super) fn read(
    document: &Document<'_>,
    resources: &Resources<'_>,
    name: &str,
) -> Result<SceneDescription, GltfError> {
    let mut notes = Notes::default();
    extensions::check(&document.root, &mut notes)?;
    notes.tell("metres, y up: turned so that z points up");
    if !document.root.animations.is_empty() {
        notes.tell("animations are not read: everything is where it is at rest");
    }
    let mut builder = Builder {
        document,
        materials: Materials::new(document, Textures::new(document, resources)),
        surfaces: HashMap::new(),
        cameras: Names::default(),
        triangles: 0,
        notes,
        description: SceneDescription {
            name: title(document).unwrap_or(name).to_owned(),
            spectrum: SpectrumMode::Rgb,
            ..SceneDescription::default()
        },
    };
    for placed in nodes::placed(&document.root)? {
        builder.add(&placed)?;
    }
    builder.finish()
}

fn title<'d>(document: &'d Document<'_>) -> Option<&'d str> {
    let root = &document.root;
    let scene = root.scenes.get(root.scene.unwrap_or(0))?;
    scene.name.as_deref().filter(|name| *name != "Scene")
}

/// Triangles with their finish.
#[derive(Clone)]
struct Surface {
    mesh: Arc<MeshData>,
    finish: Finish,
}

struct Builder<'d> {
    document: &'d Document<'d>,
    materials: Materials<'d>,
    /// What was read of each mesh.
    surfaces: HashMap<usize, Vec<Surface>>,
    cameras: Names,
    triangles: usize,
    notes: Notes,
    description: SceneDescription,
}

impl Builder<'_> {
    fn add(&mut self, placed: &Placed) -> Result<(), GltfError> {
        let place = format!("nodes[{}]", placed.node);
        let node = &self.document.root.nodes[placed.node];
        if let Some(mesh) = node.mesh {
            self.add_mesh(node, mesh, placed, &place)?;
        }
        if let Some(reference) = &node.extensions.light {
            self.add_light(reference.light, node, &placed.transform, &place)?;
        }
        if let Some(camera) = node.camera {
            self.add_camera(camera, node, &placed.transform, &place)?;
        }
        Ok(())
    }

    fn add_mesh(
        &mut self,
        node: &Node,
        mesh: usize,
        placed: &Placed,
        place: &str,
    ) -> Result<(), GltfError> {
        let surfaces = self.surfaces(mesh, place)?;
        let named = self.document.root.meshes.get(mesh);
        let name = node
            .name
            .as_ref()
            .or(named.and_then(|mesh| mesh.name.as_ref()));
        for transform in self.transforms(node, placed, place)? {
            for surface in &surfaces {
                self.add_shape(name, surface, transform)?;
            }
        }
        Ok(())
    }

    /// Where the copies of a node's mesh are.
    fn transforms(
        &mut self,
        node: &Node,
        placed: &Placed,
        place: &str,
    ) -> Result<Vec<Transform>, GltfError> {
        if node.skin.is_some() {
            let text = "skins are not read: what they move is shown as it was modelled";
            self.notes.count("nodes", text, place);
            return Ok(vec![y_to_z_up()]);
        }
        let Some(instancing) = &node.extensions.instancing else {
            return Ok(vec![placed.transform]);
        };
        let copies = instances::transforms(self.document, instancing, place)?;
        Ok(copies
            .into_iter()
            .map(|copy| copy.then(placed.transform))
            .collect())
    }

    fn add_shape(
        &mut self,
        name: Option<&String>,
        surface: &Surface,
        transform: Transform,
    ) -> Result<(), GltfError> {
        if !has_area(&surface.mesh, &transform) {
            let text = "surfaces without area are left out";
            let number = self.description.shapes.len();
            self.notes.count("shapes", text, number.to_string());
            return Ok(());
        }
        self.triangles += surface.mesh.triangles.len();
        if self.triangles > MOST_TRIANGLES {
            let (what, limit) = ("triangles", MOST_TRIANGLES);
            return Err(GltfError::TooLarge { what, limit });
        }
        if self.description.shapes.len() == MOST_SHAPES {
            return Err(instances::too_many());
        }
        self.description.shapes.push(ShapeDescription {
            name: name.cloned(),
            geometry: GeometryDescription::Mesh(Arc::clone(&surface.mesh)),
            material: Some(surface.finish.material.clone()),
            transform,
            repeat: None,
            emission: surface.finish.emission.clone(),
        });
        Ok(())
    }

    /// The primitives of a mesh, read once.
    fn surfaces(&mut self, index: usize, place: &str) -> Result<Vec<Surface>, GltfError> {
        if let Entry::Occupied(known) = self.surfaces.entry(index) {
            return Ok(known.get().clone());
        }
        let document = self.document;
        let mesh = part(&document.root.meshes, index, "mesh", place)?;
        let mut surfaces = Vec::new();
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            let place = format!("meshes[{index}].primitives[{number}]");
            surfaces.extend(self.surface(primitive, &place)?);
        }
        self.surfaces.insert(index, surfaces.clone());
        Ok(surfaces)
    }

    fn surface(
        &mut self,
        primitive: &Primitive,
        place: &str,
    ) -> Result<Option<Surface>, GltfError> {
        if !primitive.targets.is_empty() {
            let text = "morph targets are not read";
            self.notes.count("primitives", text, place);
        }
        let set = self.materials.coordinate_set(primitive.material);
        let Some(mesh) = primitives::read(self.document, primitive, set, place)? else {
            let text = "points, lines and empty primitives are left out";
            self.notes.count("primitives", text, place);
            return Ok(None);
        };
        if mesh.normals.is_empty() && primitive.attributes.contains_key("NORMAL") {
            self.notes.count("primitives", normals::LEFT_OUT, place);
        }
        let attributes = Attributes {
            coordinates: !mesh.texture_coordinates.is_empty(),
            colors: !mesh.colors.is_empty(),
        };
        let notes = &mut self.notes;
        let finish = self
            .materials
            .finish(primitive.material, attributes, place, notes)?;
        let mesh = Arc::new(mesh);
        Ok(Some(Surface { mesh, finish }))
    }

    fn add_light(
        &mut self,
        index: usize,
        node: &Node,
        transform: &Transform,
        place: &str,
    ) -> Result<(), GltfError> {
        let lights = self.document.root.extensions.lights.as_ref();
        let lights = lights.map_or(&[][..], |lights| &lights.lights);
        let light = part(lights, index, "light", place)?;
        let place = format!("extensions.KHR_lights_punctual.lights[{index}]");
        let read = lights::read(light, transform, &place, &mut self.notes)?;
        self.description.lights.extend(read.map(|mut light| {
            light.name = node.name.clone().or(light.name);
            light
        }));
        Ok(())
    }

    fn add_camera(
        &mut self,
        index: usize,
        node: &Node,
        transform: &Transform,
        place: &str,
    ) -> Result<(), GltfError> {
        let camera = part(&self.document.root.cameras, index, "camera", place)?;
        let place = format!("cameras[{index}]");
        let read = cameras::read(camera, transform, &place)?;
        let name = node.name.as_deref().or(camera.name.as_deref());
        self.description.sensors.push(SensorDescription {
            name: self.cameras.unique(name.unwrap_or("camera")),
            response: None,
            bins: None,
            kind: SensorKind::Camera(read),
        });
        Ok(())
    }

    /// All of it.
    fn finish(self) -> Result<SceneDescription, GltfError> {
        let Self {
            notes,
            mut description,
            materials,
            ..
        } = self;
        if description.shapes.is_empty() {
            return Err(GltfError::Empty);
        }
        description.materials = materials.described;
        description.warnings = notes.into_warnings();
        Ok(description)
    }
}

fn has_area(mesh: &MeshData, transform: &Transform) -> bool {
    mesh.triangles.iter().any(|triangle| {
        let corner = |at: usize| mesh.vertices.get(triangle[at] as usize);
        let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) else {
            return false;
        };
        let [a, b, c] = [a, b, c].map(|corner| transform.point(*corner));
        Parallelogram::new(a, [b - a, c - a]).is_some()
    })
}
