//! Surfaces of any model: each vertex asks its [`Brdf`] by itself.
//!
//! At a vertex of throughput T a light sampled with density p_l gives T ρ |cosθ_i| L/p_l, and a direction sampled from
//! the surface carries T ρ |cosθ_i|/p on; both find extended lights, and share them by the power heuristic with the
//! model's own density p (see [`path`](super::path)). A polished surface has no density: what it reflects or refracts
//! competes with no light sample.
//!
//! | vertex | local axes |
//! |---|---|
//! | of a model that transmits | z along the normal of the front, the outside |
//! | of any other model | z on the side of the viewer |
//!
//! Refraction scales radiance by (n_e/n_i)², but not the power: 1/η² into glass, η² out of it again. Roulette looks at
//! the throughput without that scale, so that a path in glass lives as long as it would in air and no weight grows on
//! the way out. Paths carry radiance from the sensor's end only, so that no other factor for shading
//! normals or refraction is due; who traces power from the lights needs both (E. Veach 1997, §5.2 and §5.3).

mod metals;
mod rows;

use std::borrow::Cow;

use glam::Vec3;

pub(super) use metals::Metals;

use super::choice::choose;
use super::columns::{Flight, Flights, Luggage, Place, Shadows, Vertices, Workspace};
use super::interaction::Hit;
use super::light_tree::{Highlight, Receiving};
use super::next_event::NextEvent;
use super::path::Tracer;
use super::scatter::survives;
use super::tables::{Lanes4, Side, Tables};
use crate::brdf::{Brdf, Scatter};
use crate::geometry::{Direction, Frame, Vector};
use crate::material::Site;
use crate::sampling::block;
use crate::spectrum::Wavelengths;

/// A path at a surface.
#[derive(Clone, Debug)]
pub(super) struct Encounter {
    pub place: Place,
    /// Number of the side.
    pub side: u32,
    pub primitive: u32,
    /// From the point back along the path.
    pub viewer: [f32; 3],
    pub site: Site,
    /// Only light that comes through the surface counts, or only what is reflected, if told.
    pub through: Option<bool>,
    pub throughput: Lanes4,
    /// Slot, key and index.
    pub identity: (u32, u64, u32),
    /// Numbers to sample a light with.
    pub light: [f32; 2],
}

impl Encounter {
    /// What a sensor sees, before any path is drawn.
    pub fn seen(hit: &Hit, site: Site) -> Self {
        Self {
            place: hit.place,
            side: hit.side,
            primitive: hit.primitive,
            viewer: hit.viewer,
            site,
            through: None,
            throughput: [1.0; 4],
            identity: (0, 0, 0),
            light: [0.0; 2],
        }
    }

    /// Where flight `i` meets a surface.
    pub fn of_flight(flights: &Flights, i: usize, hit: &Hit, site: Site) -> Self {
        Self {
            throughput: flights.throughput.each_ref().map(|lane| lane[i]),
            identity: flights.identity.at(i),
            light: [flights.light_u[i], flights.light_v[i]],
            ..Self::seen(hit, site)
        }
    }
}

/// Samples a light at every encounter and sends the paths on; `segment` is the number of segments so far.
pub(super) fn scatter(tracer: &Tracer, workspace: &mut Workspace, segment: u32) {
    if workspace.encounters.is_empty() {
        return;
    }
    let encounters = std::mem::take(&mut workspace.encounters);
    workspace.shadows.clear();
    workspace.lit.clear();
    let by_itself = |encounter: &Encounter, workspace: &mut Workspace| {
        scatter_by_itself(tracer, encounter, workspace, segment);
    };
    metals::scatter(tracer, &encounters, workspace, segment, by_itself);
    workspace.encounters = encounters;
    NextEvent {
        tracer,
        candidates: tracer.tables.for_surfaces(),
        still: false,
    }
    .settle_lit(workspace);
}

fn scatter_by_itself(
    tracer: &Tracer,
    encounter: &Encounter,
    workspace: &mut Workspace,
    segment: u32,
) {
    let slot = encounter.identity.0 as usize;
    let wavelengths = workspace.wavelengths[slot];
    let Some(surface) = Surface::new(tracer.tables, encounter, &wavelengths) else {
        return;
    };
    workspace.receiving[slot] = surface.receiving();
    let luggage = &mut workspace.luggage[slot];
    let lit = (&mut workspace.lit, &mut workspace.shadows);
    surface.light(tracer, (luggage, &wavelengths), lit);
    if let Some(flight) = surface.leave(tracer.tables.lanes, luggage, segment) {
        workspace.flights.push(flight);
    }
}

/// An encounter with the model there.
struct Surface<'a> {
    encounter: &'a Encounter,
    side: &'a Side,
    brdf: Cow<'a, Brdf>,
    frame: Frame,
    wo: Direction,
}

impl<'a> Surface<'a> {
    fn new(
        tables: &'a Tables<'_>,
        encounter: &'a Encounter,
        wavelengths: &Wavelengths,
    ) -> Option<Self> {
        let side = &tables.sides[encounter.side as usize];
        let brdf = tables.brdf(side, &encounter.site, wavelengths)?;
        let inverted = side.transmits && !encounter.is_at_front();
        let normal = tables.shading_normal(encounter)?;
        let normal = if inverted { -normal } else { normal };
        let frame = tables.frame(encounter.primitive, normal);
        let wo = local(&frame, encounter.viewer)?;
        Some(Self {
            encounter,
            side,
            brdf,
            frame,
            wo,
        })
    }

    /// Samples a light, if one may be seen.
    fn light(
        &self,
        tracer: &Tracer,
        (luggage, wavelengths): (&Luggage, &Wavelengths),
        (lit, shadows): (&mut Vertices, &mut Shadows),
    ) {
        let tables = tracer.tables;
        let candidates = tables.for_surfaces();
        if candidates.count == 0 {
            return;
        }
        let (place, [u, v]) = (&self.encounter.place, self.encounter.light);
        let Some((sampled, u)) = choose(tables, candidates, ([u, v], (0, 1)), || self.receiving())
        else {
            return;
        };
        let Some(towards) = sampled.towards(tables, place, [u, v]) else {
            return;
        };
        let way = (place.start(towards.direction), towards);
        let number = (sampled.number, sampled.rate);
        let towards = tables.shared(number, way, candidates, || self.receiving());
        let Some((value, own_density, beyond)) = self.towards(towards.direction) else {
            return;
        };
        let rate = sampled.rate;
        let ratio = own_density / f64::from(towards.density * rate);
        let gain = f64::from(towards.per_power) / (f64::from(rate) * (1.0 + ratio * ratio));
        let start = self.start(beyond);
        let (span, reach) = if towards.infinite {
            (towards.direction, f32::INFINITY)
        } else {
            (towards.end - Vec3::from_array(start), 1.0)
        };
        let way = span.length() * reach;
        let attenuation = tables.attenuation(self.medium(luggage, beyond), way, wavelengths);
        let response = std::array::from_fn(|lane| {
            self.encounter.throughput[lane] * value[lane] * attenuation[lane]
        });
        lit.push(*place, response, self.encounter.identity, [u, v]);
        let ray = (start, span.into(), reach);
        shadows.push(ray, gain as f32, sampled.number as u32, [u, v]);
    }

    /// What the choice of a light knows of this place: light from behind counts where it goes through.
    fn receiving(&self) -> Receiving {
        let place = &self.encounter.place;
        Receiving {
            point: Vec3::from_array(place.point),
            normal: (!self.side.transmits).then(|| Vec3::from_array(place.normal)),
            highlight: self.highlight(),
        }
    }

    fn highlight(&self) -> Option<Highlight> {
        Some(Highlight {
            viewer: Vec3::from_array(self.encounter.viewer),
            normal: Vec3::from_array(self.frame.normal().to_array().map(|x| x as f32)),
            gloss: self.brdf.gloss(self.wo)?,
        })
    }

    /// ρ |cosθ_i| and the density of a direction, and whether it leads through the surface; `None` if nothing comes from
    /// there.
    fn towards(&self, direction: Vec3) -> Option<(Lanes4, f64, bool)> {
        let wi = local(&self.frame, direction.into())?;
        let value = self.brdf.evaluate(self.wo, wi);
        let beyond = self.crosses(wi, direction)?;
        let density = self.brdf.pdf(self.wo, wi);
        (!value.is_zero()).then(|| ((value * wi.z().abs()).to_lanes(), density, beyond))
    }

    /// Sends the path on, or ends it by roulette.
    fn leave(&self, lanes: usize, luggage: &mut Luggage, segment: u32) -> Option<Flight> {
        let Encounter { identity, .. } = *self.encounter;
        let [a, b, light @ ..] = block::sample(identity.1, identity.2, segment);
        let scatter = self.brdf.sample(self.wo, [f64::from(a), f64::from(b)])?;
        let direction = self.frame.to_world(scatter.wi()).to_array();
        let direction = Vec3::from_array(direction.map(|x| x as f32));
        let beyond = self.crosses(scatter.wi(), direction)?;
        let scale = luggage.scale * self.brdf.radiance_scale(self.wo, scatter.wi()) as f32;
        let weight = scatter.weight().to_lanes();
        let throughput: Lanes4 = std::array::from_fn(|lane| match lane < lanes {
            true => self.encounter.throughput[lane] * weight[lane],
            false => 0.0,
        });
        let greatest = throughput.into_iter().fold(0.0, f32::max);
        let survival = survives(greatest / scale, identity, segment)?;
        *luggage = Luggage {
            medium: self.medium(luggage, beyond),
            scale,
        };
        Some(Flight {
            origin: self.start(beyond),
            direction: direction.into(),
            throughput: throughput.map(|lane| lane / survival),
            pdf: match scatter {
                Scatter::Finite { pdf, .. } => pdf as f32,
                Scatter::Specular { .. } => f32::INFINITY,
            },
            identity,
            light,
        })
    }

    /// Whether a direction leads through the surface; `None` where the local axes and the surface disagree, and where its
    /// light does not count.
    fn crosses(&self, wi: Direction, direction: Vec3) -> Option<bool> {
        let beyond = direction.dot(Vec3::from_array(self.encounter.place.normal)) < 0.0;
        let through = (wi.z() < 0.0) != (self.wo.z() < 0.0);
        let counts = self.encounter.through.is_none_or(|only| only == beyond);
        (beyond == through && counts).then_some(beyond)
    }

    /// Where rays start on this side of the surface, or on the other one.
    fn start(&self, beyond: bool) -> [f32; 3] {
        match beyond {
            true => self.encounter.place.beyond(),
            false => self.encounter.place.cleared(),
        }
    }

    /// The medium on this side of the surface, or on the other one.
    fn medium(&self, luggage: &Luggage, beyond: bool) -> u32 {
        match self.side.media {
            Some(media) if beyond => media.before(!self.encounter.is_at_front()),
            _ => luggage.medium,
        }
    }
}

impl Encounter {
    pub fn is_at_front(&self) -> bool {
        self.side.is_multiple_of(2)
    }
}

/// A world direction in local axes.
pub(super) fn local(frame: &Frame, direction: [f32; 3]) -> Option<Direction> {
    let direction = Vector::from(direction.map(f64::from));
    Direction::new(frame.vector_to_local(direction)).ok()
}
