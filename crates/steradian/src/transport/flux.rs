//! Flux meters: a point drawn uniformly over a surface, and what light counts there.
//!
//! | what is counted | of what arrives, ρ reflectance, α opacity | of the emission |
//! |---|---|---|
//! | incident | 1 | |
//! | leaving | αρ | 1 |
//! | absorbed | α(1 − ρ) | |
//! | emitted | | 1 |
//! | net = incident − leaving | 1 − αρ | −1 |
//!
//! On a surface that does not block light, leaving is what arrives from the other side, and net the difference.
//!
//! Where reflection depends on the angle, or light goes through, no weight of what arrives tells what leaves: a direction
//! of density cosθ/π is drawn for the light that leaves, and the model there asked for its radiance. What is a difference
//! is sampled in parts, each by as many samples, with its sign: absorbed = incident − reflected to this side − transmitted to
//! the other.

use super::appearance::site_at;
use super::columns::Place;
use super::scatter::to_world;
use super::scattering::Encounter;
use super::tables::{Lanes4, Model, Side, Tables};
use crate::geometry::{Direction, Point};
use crate::material::Site;
use crate::sampling::{hash, warp};
use crate::sensor::FluxOf;
use crate::shape::{Form, PartId};
use crate::spectrum::Wavelengths;

/// The parts of a shape, and the number of its first primitive.
pub(super) type Parts<'a> = (&'a [PartId], u32);

/// A surface whose flux is sampled.
pub(super) struct FluxMeter<'a> {
    /// Forms with the cumulative share of their sampling area.
    pub forms: Vec<(&'a Form, Option<Parts<'a>>, f64)>,
    /// The first primitive of each shape, in ascending order; none of a surface that does not block light.
    pub shapes: Vec<u32>,
    /// Sum of their sampling areas.
    pub area: f64,
    /// The front is counted.
    pub front: bool,
    pub of: FluxOf,
}

/// What a path looks for at its start.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Looks {
    /// Light that arrives.
    Outwards,
    /// Light that the model there scatters; only what comes through the surface, or only what is reflected, if told.
    AtModel { through: Option<bool> },
}

/// How a path starts at a point of a surface.
pub(super) struct Start {
    /// It looks at what is in front, or at the front.
    pub front: bool,
    pub looks: Looks,
    /// Of what arrives.
    pub weights: Lanes4,
    /// What all that the path gathers is multiplied with.
    pub sign: f64,
    /// Group and radiance of an emission that varies over the surface, as far as it counts.
    pub emitted: Option<(u32, Lanes4)>,
}

impl FluxMeter<'_> {
    /// A point by area; `None` in an opening.
    pub fn draw(&self, u: [f64; 2]) -> Option<Drawn<'_>> {
        let index = self
            .forms
            .partition_point(|(_, _, share)| *share <= u[0])
            .min(self.forms.len() - 1);
        let before = if index == 0 {
            0.0
        } else {
            self.forms[index - 1].2
        };
        let (form, parts, share) = &self.forms[index];
        let within = ((u[0] - before) / (share - before)).clamp(0.0, 1.0 - f64::EPSILON);
        let sample = form.sample_area([within, u[1]])?;
        let part = |ids: &[PartId]| ids[if ids.len() > 1 { sample.face } else { 0 }].0;
        Some(Drawn {
            part: parts.map(|(ids, _)| part(ids)),
            primitive: parts.map_or(0, |(_, first)| first + sample.face as u32),
            form,
            face: sample.face,
            point: sample.point,
            normal: sample.normal,
        })
    }

    /// On a surface that does not block light both sides of a net alternate: what passes backwards is counted negative.
    pub fn on_virtual(&self, (_, key, index): (u32, u64, u32)) -> Start {
        let (front, sign) = match self.of {
            FluxOf::Incident | FluxOf::Absorbed | FluxOf::Emitted => (self.front, 1.0),
            FluxOf::Leaving => (!self.front, 1.0),
            FluxOf::Net if hash::mix_64(key ^ u64::from(index)) & 1 == 0 => (true, 2.0),
            FluxOf::Net => (false, -2.0),
        };
        Start {
            front,
            looks: Looks::Outwards,
            weights: [1.0; 4],
            sign,
            emitted: None,
        }
    }

    /// On a surface whose model no weight stands for.
    pub fn on_model(
        &self,
        tables: &Tables<'_>,
        drawn: &Drawn<'_>,
        part: u32,
        wavelengths: &Wavelengths,
        (_, key, index): (u32, u64, u32),
    ) -> Start {
        let side = &tables.sides[2 * part as usize + usize::from(!self.front)];
        let opacity = tables.opacity(side, || drawn.site()).unwrap_or(1.0);
        let scattered = |through| Looks::AtModel { through };
        let all = (self.front, scattered(None), opacity, -1.0);
        let reflected = (self.front, scattered(Some(false)), opacity, -1.0);
        let transmitted = (!self.front, scattered(Some(true)), opacity, -1.0);
        let arriving = |weight| (self.front, Looks::Outwards, weight, 1.0);
        let parts: &[_] = match self.of {
            FluxOf::Incident => &[arriving(1.0)],
            FluxOf::Leaving => &[(self.front, scattered(None), opacity, 1.0)],
            FluxOf::Net => &[arriving(1.0), all],
            FluxOf::Absorbed if side.transmits => &[arriving(opacity), reflected, transmitted],
            FluxOf::Absorbed => &[arriving(opacity), reflected],
            FluxOf::Emitted => &[arriving(0.0)],
        };
        let chosen = hash::mix_64(key ^ u64::from(index)) % parts.len() as u64;
        let (front, looks, weight, sign) = parts[chosen as usize];
        let sign = sign * parts.len() as f64;
        let emitted = self.emitted(tables, side, drawn, wavelengths);
        Start {
            front,
            looks,
            weights: [weight; 4],
            sign,
            emitted: emitted.map(|lanes| (side.group, lanes.map(|lane| lane / sign as f32))),
        }
    }

    /// A path that started with a weight below 1 would end by roulette at once: the sign takes the weight instead.
    pub fn on_shape(
        &self,
        tables: &Tables<'_>,
        drawn: &Drawn<'_>,
        part: u32,
        wavelengths: &Wavelengths,
    ) -> Start {
        let side = &tables.sides[2 * part as usize + usize::from(!self.front)];
        let weights = self.weights(tables, side, || drawn.site(), wavelengths);
        let lanes = weights[..tables.lanes].iter().copied();
        let greatest = match lanes.fold(0.0, f32::max) {
            greatest if greatest > 0.0 => greatest,
            _ => 1.0,
        };
        let emitted = self.emitted(tables, side, drawn, wavelengths);
        Start {
            front: self.front,
            looks: Looks::Outwards,
            weights: weights.map(|weight| weight / greatest),
            sign: f64::from(greatest),
            emitted: emitted.map(|radiance| (side.group, radiance.map(|lane| lane / greatest))),
        }
    }

    /// Of what arrives at a side.
    pub fn weights(
        &self,
        tables: &Tables<'_>,
        side: &Side,
        site: impl Fn() -> Site,
        wavelengths: &Wavelengths,
    ) -> Lanes4 {
        let reflectance = match (self.of, side.model) {
            (FluxOf::Incident, _) => return [1.0; 4],
            (FluxOf::Emitted, _) => return [0.0; 4],
            (_, Model::Black | Model::Pane | Model::Any) => [0.0; 4],
            _ => tables.lanes_at(&side.reflectance, wavelengths, &site),
        };
        let opacity = tables.opacity(side, &site).unwrap_or(1.0);
        reflectance.map(|lane| match self.of {
            FluxOf::Incident => 1.0,
            FluxOf::Emitted => 0.0,
            FluxOf::Leaving => opacity * lane,
            FluxOf::Absorbed => opacity * (1.0 - lane),
            FluxOf::Net => 1.0 - opacity * lane,
        })
    }

    /// Emission that is the same everywhere has a closed form.
    fn emitted(
        &self,
        tables: &Tables<'_>,
        side: &Side,
        drawn: &Drawn<'_>,
        wavelengths: &Wavelengths,
    ) -> Option<Lanes4> {
        let sign = match self.of {
            FluxOf::Leaving | FluxOf::Emitted => 1.0,
            FluxOf::Net => -1.0,
            FluxOf::Incident | FluxOf::Absorbed => return None,
        };
        let varies = side.emits && tables.has_textures(&side.radiance);
        let radiance =
            varies.then(|| tables.lanes_at(&side.radiance, wavelengths, || drawn.site()))?;
        Some(radiance.map(|lane| sign * lane))
    }
}

/// A point of a surface with the normal of its front, and its part unless the surface is virtual.
pub(super) struct Drawn<'a> {
    form: &'a Form,
    face: usize,
    point: Point,
    normal: Direction,
    pub part: Option<u32>,
    primitive: u32,
}

impl Drawn<'_> {
    fn site(&self) -> Site {
        site_at(self.form, self.face, self.point)
    }

    /// A side of this surface, seen from the direction that two uniform numbers choose with density cosθ/π.
    pub fn seen(&self, tables: &Tables<'_>, part: u32, start: &Start, u: [f32; 2]) -> Encounter {
        let place = self.place(tables, start.front);
        let through = match start.looks {
            Looks::AtModel { through } => through,
            Looks::Outwards => None,
        };
        Encounter {
            viewer: to_world(place.normal, warp::cosine_hemisphere(u[0], u[1])),
            place,
            side: 2 * part + u32::from(!start.front),
            primitive: self.primitive,
            site: self.site(),
            through,
            throughput: start.weights,
            identity: (0, 0, 0),
            light: [0.0; 2],
        }
    }

    /// The point, facing the front or the back.
    pub fn place(&self, tables: &Tables<'_>, front: bool) -> Place {
        let surfaces = tables.scene.surfaces();
        let normal = if front { self.normal } else { -self.normal };
        Place {
            point: surfaces.to_kernel(self.point),
            normal: normal.to_array().map(|x| x as f32),
            clearance: surfaces.clearance() as f32,
        }
    }
}
