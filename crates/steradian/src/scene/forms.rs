//! Shapes: the forms of each, one for each copy of a repeat, and what their parts are made of.

use super::box_form::{FACE_NAMES, faces_of, portals};
use super::description::{self, GeometryDescription, Opening, Repeat, ShapeDescription};
use super::geometry::{Shaped, form};
use super::materials::Materials;
use super::{Fault, Part, PartProperties, Problem};
use crate::geometry::{Transform, Vector};
use crate::material::{MaterialId, Pattern};
use crate::shape::{Form, Parallelogram, PartId, Placed, ShapeId};

/// Copies a repeat may make.
const MAX_COPIES: u64 = 10_000_000;

/// All forms of a scene.
#[derive(Default)]
pub(super) struct Forms {
    pub placed: Vec<Placed>,
    pub names: Vec<String>,
    pub parts: Vec<PartProperties>,
    /// Openings in the walls of rooms, through which light comes in.
    pub portals: Vec<Parallelogram>,
    /// The forms of each described shape.
    pub of_description: Vec<std::ops::Range<usize>>,
}

impl Forms {
    /// The forms of the shapes that have this name.
    pub fn named(&self, descriptions: &[ShapeDescription], name: &str) -> Vec<ShapeId> {
        let wanted = descriptions
            .iter()
            .zip(&self.of_description)
            .filter(|(shape, _)| shape.name.as_deref() == Some(name));
        wanted
            .flat_map(|(_, range)| range.clone().map(|index| ShapeId(index as u32)))
            .collect()
    }

    pub fn part(&mut self, sides: [MaterialId; 2]) -> PartId {
        self.parts.push(PartProperties {
            front: sides[0],
            back: sides[1],
            light: None,
        });
        PartId(self.parts.len() as u32 - 1)
    }
}

pub(super) fn prepare(
    shapes: &[ShapeDescription],
    materials: &Materials,
    problems: &mut Vec<Problem>,
) -> Forms {
    let mut forms = Forms::default();
    for (index, shape) in shapes.iter().enumerate() {
        let first = forms.placed.len();
        let part = Part::Shape(index);
        let sides = part_materials(shape, materials, part, problems);
        for (copy, step) in copies(shape.repeat.as_ref(), part, problems)
            .into_iter()
            .enumerate()
        {
            let transform = shape.transform.then(Transform::translate(step));
            let shaped = form(&shape.geometry, &transform);
            let shaped = shaped.and_then(|shaped| {
                check_textures(&shaped.form, shape, &sides, materials)?;
                Ok(shaped)
            });
            match shaped {
                Ok(shaped) => {
                    let portals = portals_of(&shape.geometry, &transform, (&sides, materials));
                    forms.portals.extend(portals);
                    add(&mut forms, shape, index, copy, shaped, &sides);
                }
                Err((key, message)) => {
                    problems.push(Problem::at(part, key, message));
                    break;
                }
            }
        }
        forms.of_description.push(first..forms.placed.len());
    }
    forms
}

/// The openings of a room that hold nothing, or what lets light pass straight.
fn portals_of(
    geometry: &GeometryDescription,
    transform: &Transform,
    (sides, materials): (&[Sides], &Materials),
) -> Vec<Parallelogram> {
    let GeometryDescription::Box {
        min,
        max,
        inside: true,
        openings,
        ..
    } = geometry
    else {
        return vec![];
    };
    let passes = |id: &MaterialId| {
        let material = &materials.materials[id.0 as usize].1;
        material.is_pane() || material.opacity.is_some()
    };
    let is_open = |(opening, sides): &(&Opening, &Sides)| {
        opening.material.is_none() || sides.iter().any(passes)
    };
    let open = openings.iter().zip(&sides[6..]).filter(is_open);
    let open: Vec<_> = open.map(|(opening, _)| opening.clone()).collect();
    portals((*min, *max), &open, transform)
}

fn add(
    forms: &mut Forms,
    shape: &ShapeDescription,
    index: usize,
    copy: usize,
    shaped: Shaped,
    sides: &[[MaterialId; 2]],
) {
    let parts: Vec<_> = sides.iter().map(|sides| forms.part(*sides)).collect();
    let parts = shaped.faces.iter().map(|face| parts[*face]).collect();
    let base = base_name(shape, index);
    forms.names.push(if shape.repeat.is_some() {
        format!("{base}[{copy}]")
    } else {
        base
    });
    forms.placed.push(Placed {
        form: shaped.form,
        parts,
    });
}

/// The name of a shape, or its kind and number.
pub(super) fn base_name(shape: &ShapeDescription, index: usize) -> String {
    let own = shape.name.clone();
    own.unwrap_or_else(|| format!("{} {index}", shape.geometry.kind()))
}

/// Textures need coordinates, and colours of vertices need a mesh that has them.
fn check_textures(
    form: &Form,
    shape: &ShapeDescription,
    sides: &[Sides],
    materials: &Materials,
) -> Result<(), Fault> {
    let ids = sides.iter().flatten();
    let emission = shape
        .emission
        .iter()
        .flat_map(|emission| &emission.textures);
    let of_emission = emission.map(|texture| texture.pattern == description::Pattern::VertexColor);
    let of_materials = ids.flat_map(|id| {
        let material = &materials.materials[id.0 as usize].1;
        let mut textures = material.textures();
        let colored = textures.any(|texture| texture.pattern == Pattern::VertexColor);
        let laid = material.needs_coordinates();
        [(colored, true), (laid, false)]
    });
    let of_materials = of_materials.filter_map(|(present, colored)| present.then_some(colored));
    for (key, vertex_color) in of_materials
        .map(|vertex_color| ("material", vertex_color))
        .chain(of_emission.map(|vertex_color| ("emission", vertex_color)))
    {
        let has_colors = matches!(form, Form::Mesh(mesh) if !mesh.attributes.colors.is_empty());
        if vertex_color && !has_colors {
            return Err((key, "this shape has no vertices with colours".into()));
        }
        if !vertex_color && !form.has_coordinates() {
            let message = "a texture needs texture coordinates, which this shape does not have";
            return Err((key, message.into()));
        }
    }
    Ok(())
}

/// Materials of the front and the back.
type Sides = [MaterialId; 2];

/// Materials of each part: one, or six faces and the openings of a box.
fn part_materials(
    shape: &ShapeDescription,
    materials: &Materials,
    part: Part,
    problems: &mut Vec<Problem>,
) -> Vec<Sides> {
    let mut lookup = |name: &str, key: &'static str| {
        materials.sides(name).unwrap_or_else(|| {
            problems.push(Problem::at(part, key, materials.unknown(name)));
            [MaterialId::BLACK; 2]
        })
    };
    let own = shape
        .material
        .as_deref()
        .map_or([MaterialId::BLACK; 2], |name| lookup(name, "material"));
    let GeometryDescription::Box {
        faces, openings, ..
    } = &shape.geometry
    else {
        return vec![own];
    };
    let sides = box_materials(own, faces, openings, lookup);
    if let Some((unknown, _)) = faces.iter().find(|(face, _)| faces_of(face).is_none()) {
        let message = format!("a box's faces are {FACE_NAMES}, not `{unknown}`");
        problems.push(Problem::at(part, "faces", message));
    }
    sides
}

fn box_materials(
    own: Sides,
    faces: &[(String, String)],
    openings: &[Opening],
    mut lookup: impl FnMut(&str, &'static str) -> Sides,
) -> Vec<Sides> {
    let mut sides = vec![own; 6 + openings.len()];
    for (face, material) in faces {
        let found = lookup(material, "faces");
        for index in faces_of(face).unwrap_or_default() {
            sides[*index] = found;
        }
    }
    for (opening, sides) in openings.iter().zip(&mut sides[6..]) {
        if let Some(material) = &opening.material {
            *sides = lookup(material, "openings");
        }
    }
    sides
}

/// Displacements of the copies.
pub(super) fn copies(
    repeat: Option<&Repeat>,
    part: Part,
    problems: &mut Vec<Problem>,
) -> Vec<Vector> {
    let Some(repeat) = repeat else {
        return vec![Vector::ZERO];
    };
    let counts = repeat.count.iter().map(|count| u64::from(*count));
    let total = counts.fold(1, u64::saturating_mul);
    let finite = repeat.step.iter().all(|step| step.is_finite());
    if repeat.count.len() != repeat.step.len() || !(1..=MAX_COPIES).contains(&total) || !finite {
        let message = format!(
            "repeat needs a finite step for each count and 1 to {MAX_COPIES} copies in all"
        );
        problems.push(Problem::at(part, "repeat", message));
        return vec![];
    }
    let mut steps = vec![Vector::ZERO];
    for (count, step) in repeat.count.iter().zip(&repeat.step) {
        steps = steps
            .iter()
            .flat_map(|base| (0..*count).map(move |i| *base + *step * f64::from(i)))
            .collect();
    }
    steps
}
