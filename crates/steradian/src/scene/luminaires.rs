//! Luminaires: from a table and where it hangs to a light, with the shape of its opening.

use super::description::{LightDescription, LightKind, LuminaireDescription};
use super::forms::Forms;
use super::{Fault, lights::position_of};
use crate::geometry::{Bounds, Direction, Frame, Point, Vector};
use crate::light::{Body, LightId, LuminaireLight, Opening, Outlet};
use crate::material::MaterialId;
use crate::quantity::Intensity;
use crate::shape::{Placed, ShapeId, clearance_in};
use crate::spectrum::MAX_LANES;
use std::sync::Arc;

/// Where openings become shapes of the scene.
pub(super) struct Mounting<'a> {
    pub forms: &'a mut Forms,
    pub placed: &'a mut Vec<Placed>,
    /// How far an opening is moved off the surface in which it may be recessed.
    clearance: f64,
}

impl<'a> Mounting<'a> {
    pub fn new(
        forms: &'a mut Forms,
        placed: &'a mut Vec<Placed>,
        lights: &[LightDescription],
    ) -> Self {
        let positions = lights.iter().filter_map(ends).flatten();
        let positions = positions.filter(|position| position.is_finite());
        let shapes = placed.iter().filter_map(|placed| placed.form.bounds());
        let bounds = shapes.fold(Bounds::EMPTY, Bounds::union);
        let bounds = positions.fold(bounds, Bounds::including);
        Self {
            clearance: clearance_in(Some(bounds)),
            forms,
            placed,
        }
    }

    /// A black surface that emits as a light, of this number and name.
    fn add(&mut self, body: &Body, id: LightId, name: &str) -> ShapeId {
        let part = self.forms.part([MaterialId::BLACK; 2]);
        self.forms.parts[part.0 as usize].light = Some(id);
        self.forms.names.push(name.into());
        let parts = match &body.form {
            crate::shape::Form::Mesh(mesh) => vec![part; mesh.triangles.len()],
            _ => vec![part],
        };
        self.placed.push(Placed {
            form: body.form.clone(),
            parts,
        });
        ShapeId(self.placed.len() as u32 - 1)
    }
}

/// The positions of the first and the last copy of a luminaire.
fn ends(light: &LightDescription) -> Option<[Point; 2]> {
    let LightKind::Luminaire(luminaire) = &light.kind else {
        return None;
    };
    let first = luminaire.position;
    let steps = light.repeat.iter().flat_map(|repeat| {
        let steps = repeat.step.iter().zip(&repeat.count);
        steps.map(|(step, count)| *step * f64::from(count.saturating_sub(1)))
    });
    Some([first, steps.fold(first, |last, step| last + step)])
}

/// What is wrong with the numbers of a luminaire.
pub(super) fn check(luminaire: &LuminaireDescription) -> Result<(), Fault> {
    let LuminaireDescription {
        dimming,
        maintenance_factor,
        ..
    } = luminaire;
    if !(0.0..=1.0).contains(dimming) {
        let message = format!("dimming lies between 0 and 1, not at {dimming}");
        return Err(("dimming", message));
    }
    if !(*maintenance_factor > 0.0 && *maintenance_factor <= 1.0) {
        let message = format!(
            "a maintenance factor lies above 0 and at most at 1, not at {maintenance_factor}"
        );
        return Err(("maintenance_factor", message));
    }
    if luminaire.far_field.flux() <= 0.0 {
        return Err(("file", "the table of the luminaire holds no light".into()));
    }
    if !luminaire.opening.is_valid() {
        let message = "the lengths of a luminous opening are finite and not negative";
        return Err(("file", message.into()));
    }
    Ok(())
}

/// The luminaire moved by `step`, as the light of this number and name.
pub(super) fn luminaire(
    luminaire: &LuminaireDescription,
    step: Vector,
    unit: [f64; MAX_LANES],
    mounting: &mut Mounting<'_>,
    (id, name): (LightId, &str),
) -> Result<LuminaireLight, Fault> {
    let position = position_of(luminaire.position + step)?;
    let frame = frame(luminaire)?;
    let end = position - frame.normal() * mounting.clearance;
    let body = Body::new(&luminaire.opening, end, &frame);
    Ok(LuminaireLight {
        position,
        frame,
        far_field: Arc::clone(&luminaire.far_field),
        unit: unit.map(Intensity::from_watts_per_steradian),
        opening: match body {
            Some(_) => luminaire.opening,
            None => Opening::Point,
        },
        outlet: outlet(body, end, mounting, (id, name)),
    })
}

fn outlet(
    body: Option<Body>,
    end: Point,
    mounting: &mut Mounting<'_>,
    (id, name): (LightId, &str),
) -> Outlet {
    let Some(body) = body else {
        return Outlet::Point { end };
    };
    Outlet::Surface {
        shape: mounting.add(&body, id, name),
        two_sided: body.two_sided,
        extent: body.extent,
    }
}

/// C0, C90, and against the aim.
fn frame(luminaire: &LuminaireDescription) -> Result<Frame, Fault> {
    let message = "a direction is finite and not zero";
    let direction =
        |vector, key| Direction::new(vector).map_err(|_| -> Fault { (key, message.into()) });
    let aim = direction(luminaire.aim, "aim")?;
    let c0 = direction(luminaire.c0, "c0")?;
    Frame::from_normal_and_tangent(-aim, c0.to_vector()).ok_or_else(|| {
        let [x, y, z] = luminaire.c0.to_array();
        let message = format!(
            "c0 = [{x}, {y}, {z}] is parallel to the aim: it must point aside, to where the half plane C0 is"
        );
        ("c0", message)
    })
}
