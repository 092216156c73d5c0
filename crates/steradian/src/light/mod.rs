//! Lights: where light comes from, and how a surface samples it.
//!
//! Every sample of every light is one [`LightSample`], so that reflection is one line for all of them:
//! L(d_e) += ρ · E_n · cosθ_i, with the normal irradiance E_n = I/r² of a point light and L·Δω = L/p of an area.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | E_n | irradiance of a plane that faces the light | W/m² |
//! | E = E_n cosθ | irradiance of the receiver (foreshortened) | W/m² |
//! | p | density of the sampled direction | 1/sr |

mod area;
mod environment_map;
mod far_field;
mod luminaire;
mod point;
mod spot;

pub use area::AreaLight;
pub(crate) use environment_map::horizontal;
pub use environment_map::{EnvironmentError, EnvironmentMap, EnvironmentSample};
pub use far_field::{FarField, FarFieldError, FarFieldSample, Planes};
pub use luminaire::{Body, Extent, LuminaireLight, Opening, Outlet};
pub use point::PointLight;
pub use spot::{Beam, SpotLight};

use std::sync::Arc;

use crate::geometry::{Direction, Point};
use crate::quantity::{Area, Flux, Intensity, Irradiance, Radiance};
use crate::shape::{Form, ShapeId};
use crate::spectrum::{CurveId, MAX_LANES};

/// A light, by number.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LightId(pub u32);

/// How likely a light sample was.
#[derive(Copy, Clone, Debug, PartialEq)]
pub enum Density {
    /// Density in solid angle, 1/sr.
    SolidAngle(f64),
    /// The only direction a light without extent is seen in.
    Delta,
}

/// One sample of a light as seen from a receiver, occlusion not counted.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct LightSample {
    /// d_i: from the receiver towards the light.
    pub direction: Direction,
    /// To the light, in metres; infinite for a directional light.
    pub distance: f64,
    /// E_n of each lane.
    pub normal_irradiance: [Irradiance; MAX_LANES],
    /// E_n·cosθ of each lane, zero from behind.
    pub irradiance: [Irradiance; MAX_LANES],
    /// How likely it was.
    pub density: Density,
    /// The light's group.
    pub group: u32,
}

/// A light with its group.
#[derive(Clone, Debug)]
pub struct Light {
    /// For reports.
    pub name: String,
    /// Number of its group.
    pub group: u32,
    /// What its lanes are multiplied with at a path's wavelengths.
    pub spectrum: Option<CurveId>,
    /// What it is.
    pub kind: Kind,
}

/// The closed set of lights.
#[derive(Clone, Debug)]
pub enum Kind {
    /// Equal intensity in all directions.
    Point(PointLight),
    /// A beam.
    Spot(SpotLight),
    /// Parallel light.
    Directional {
        /// The way it travels.
        direction: Direction,
        /// On a plane that faces it.
        irradiance: [Irradiance; MAX_LANES],
    },
    /// The same radiance from all directions.
    Environment {
        /// The radiance.
        radiance: [Radiance; MAX_LANES],
    },
    /// Radiance from all directions that a picture tells.
    EnvironmentMap {
        /// Where the picture is 1.
        radiance: [Radiance; MAX_LANES],
        /// The picture.
        map: Arc<EnvironmentMap>,
    },
    /// A shape that emits.
    Area(AreaLight),
    /// The intensity of a table, from a point or from an opening.
    Luminaire(LuminaireLight),
}

impl Light {
    /// Whether the light has no extent, so that only next-event estimation can find it.
    pub fn is_delta(&self) -> bool {
        match &self.kind {
            Kind::Point(_) | Kind::Spot(_) | Kind::Directional { .. } => true,
            Kind::Environment { .. } | Kind::EnvironmentMap { .. } | Kind::Area(_) => false,
            Kind::Luminaire(light) => light.surface().is_none(),
        }
    }

    /// Whether its light comes from infinitely far.
    pub fn is_infinitely_far(&self) -> bool {
        matches!(
            self.kind,
            Kind::Directional { .. } | Kind::Environment { .. } | Kind::EnvironmentMap { .. }
        )
    }

    /// Φ of each lane in all directions; `None` if it is infinite or varies over the surface in no closed form.
    pub fn flux(&self, area: impl Fn(ShapeId) -> Area) -> Option<[Flux; MAX_LANES]> {
        match &self.kind {
            Kind::Point(light) => Some(light.flux()),
            Kind::Spot(light) => Some(light.flux()),
            Kind::Luminaire(light) => Some(light.flux()),
            Kind::Area(light) => light
                .textures
                .is_empty()
                .then(|| light.flux(area(light.shape))),
            Kind::Directional { .. } | Kind::Environment { .. } | Kind::EnvironmentMap { .. } => {
                None
            }
        }
    }

    /// The shape that emits, and whether both of its sides do.
    pub fn surface(&self) -> Option<(ShapeId, bool)> {
        match &self.kind {
            Kind::Area(light) => Some((light.shape, light.two_sided)),
            Kind::Luminaire(light) => light.surface(),
            _ => None,
        }
    }

    /// What [`power`](Self::power) is multiplied with towards a direction away from the light, at a place where it emits; all
    /// lights but luminaires have it in their power.
    pub fn factor(&self, away: Direction) -> f64 {
        match &self.kind {
            Kind::Luminaire(light) => light.factor(away),
            _ => 1.0,
        }
    }

    /// Intensity, irradiance or radiance of the lanes, by kind, in SI units; of a luminaire per unit of its table.
    pub fn power(&self) -> [f64; MAX_LANES] {
        match &self.kind {
            Kind::Point(light) => light.intensity.map(Intensity::to_watts_per_steradian),
            Kind::Spot(light) => light.peak_intensity.map(Intensity::to_watts_per_steradian),
            Kind::Directional { irradiance, .. } => {
                irradiance.map(Irradiance::to_watts_per_square_metre)
            }
            Kind::Environment { radiance } | Kind::EnvironmentMap { radiance, .. } => {
                radiance.map(Radiance::to_watts_per_square_metre_steradian)
            }
            Kind::Area(light) => light
                .radiance
                .map(Radiance::to_watts_per_square_metre_steradian),
            Kind::Luminaire(light) => light.unit.map(Intensity::to_watts_per_steradian),
        }
    }

    /// A sample as seen from `point` on a surface of this `normal`; `None` when the light gives nothing there.
    ///
    /// `form` finds the geometry of a light that is a shape. Environments are not sampled here: a constant one is sampled as well as any by
    /// a surface's own directions, a picture by an [`EnvironmentMap`].
    pub fn sample<'a>(
        &self,
        point: Point,
        normal: Direction,
        u: [f64; 2],
        form: impl Fn(ShapeId) -> &'a Form,
    ) -> Option<LightSample> {
        let incident = match &self.kind {
            Kind::Point(light) => light.incident(point),
            Kind::Spot(light) => light.incident(point),
            Kind::Directional {
                direction,
                irradiance,
            } => Some(Incident {
                direction: -*direction,
                distance: f64::INFINITY,
                normal_irradiance: *irradiance,
                density: Density::Delta,
            }),
            Kind::Environment { .. } | Kind::EnvironmentMap { .. } => None,
            Kind::Area(light) => light.incident(form(light.shape), point, u),
            Kind::Luminaire(light) => light.incident(point, u, form),
        }?;
        let cos_theta = incident.direction.dot(normal).max(0.0);
        Some(LightSample {
            direction: incident.direction,
            distance: incident.distance,
            normal_irradiance: incident.normal_irradiance,
            irradiance: incident.normal_irradiance.map(|e| e * cos_theta),
            density: incident.density,
            group: self.group,
        })
    }
}

/// What arrives at a point before foreshortening.
pub(crate) struct Incident {
    pub direction: Direction,
    pub distance: f64,
    pub normal_irradiance: [Irradiance; MAX_LANES],
    pub density: Density,
}

#[cfg(test)]
mod tests;
