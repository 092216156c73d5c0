//! Light at a surface: what goes where, of flux instead of radiance.
//!
//! With ρ(d_e, d_i) for radiance, flux Φ along d_i becomes the intensity Φ ρ |cosθ_e| |cosθ_i′|/|cosθ_i| along d_e, where θ is at the true normal
//! and θ′ at the one that the model reckons with. A polished surface sends on Φ R |cosθ_i′ cosθ_e|/(|cosθ_i cosθ_e′|), R being the factor of
//! radiance less its (n_e/n_i)².
//!
//! The normal of a model may depend on where it is seen from, and so does the side whose model counts: both are those that a path from
//! d_e finds, so that light goes the same ways in either direction.

use std::borrow::Cow;
use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use crate::brdf::{Brdf, Scatter};
use crate::geometry::{Direction, Frame};
use crate::material::Site;
use crate::sampling::warp;
use crate::spectrum::Wavelengths;
use crate::transport::columns::Place;
use crate::transport::interaction::Hit;
use crate::transport::scatter::to_world;
use crate::transport::scattering::{Encounter, local};
use crate::transport::tables::{Lanes4, Model, Side, Tables};

/// Light that has met a surface.
pub(in crate::transport) struct Arrival<'a> {
    pub tables: &'a Tables<'a>,
    pub hit: &'a Hit,
    pub wavelengths: &'a Wavelengths,
    side: &'a Side,
    site: Site,
}

/// How light leaves a surface.
pub(in crate::transport) struct Departure {
    pub direction: Vec3,
    /// Flux over what arrived.
    pub weight: Lanes4,
    pub is_specular: bool,
    /// The medium that it enters, if it goes through.
    pub medium: Option<u32>,
}

impl<'a> Arrival<'a> {
    pub fn new(tables: &'a Tables<'a>, hit: &'a Hit, wavelengths: &'a Wavelengths) -> Self {
        Self {
            tables,
            hit,
            wavelengths,
            side: &tables.sides[hit.side as usize],
            site: tables.site(hit),
        }
    }

    /// The medium before the surface, if it tells.
    pub fn medium_before(&self) -> Option<u32> {
        self.side
            .media
            .map(|media| media.before(self.is_at_front()))
    }

    fn is_at_front(&self) -> bool {
        self.hit.side.is_multiple_of(2)
    }

    fn cos_arriving(&self) -> f64 {
        f64::from(self.hit.cos_theta)
    }

    /// Intensity towards a direction per flux that arrives.
    pub fn towards(&self, direction: Vec3) -> Option<Lanes4> {
        match self.side.model {
            Model::Lambertian => {
                let cosine = direction.dot(Vec3::from_array(self.hit.place.normal));
                let share = self.reflectance();
                (cosine > 0.0).then(|| share.map(|lane| lane * FRAC_1_PI * cosine))
            }
            Model::Any => self.seen_from(direction)?.intensity(self),
            Model::Black | Model::Mirror | Model::Pane => None,
        }
    }

    /// One of the ways on.
    pub fn scatter(&self, u: [f32; 2]) -> Option<Departure> {
        match self.side.model {
            Model::Lambertian => {
                let local = warp::cosine_hemisphere(u[0], u[1]);
                Some(Departure {
                    direction: to_world(self.hit.place.normal, local).into(),
                    weight: self.reflectance(),
                    is_specular: false,
                    medium: None,
                })
            }
            Model::Mirror => Some(mirrored(self.hit, self.reflectance())),
            Model::Any => self.scatter_by_model(u),
            Model::Black | Model::Pane => None,
        }
    }

    fn reflectance(&self) -> Lanes4 {
        let tinted = &self.side.reflectance;
        self.tables.lanes_at(tinted, self.wavelengths, || self.site)
    }

    fn scatter_by_model(&self, u: [f32; 2]) -> Option<Departure> {
        let here = self.seen_from(Vec3::from_array(self.hit.viewer))?;
        let scatter = here.brdf.sample(here.viewer, u.map(f64::from))?;
        let way = here.frame.to_world(scatter.wi()).to_array();
        let direction = Vec3::from_array(way.map(|x| x as f32));
        let there = self.seen_from(direction)?;
        let weight = match scatter {
            Scatter::Finite { pdf, .. } => there.intensity(self)?.map(|lane| lane / pdf as f32),
            Scatter::Specular { wi, reflectance } => {
                let factor = self.specular_factor(&here, &there, wi)?;
                (reflectance * factor).to_lanes()
            }
        };
        let media = self.side.media.filter(|_| there.is_beyond);
        Some(Departure {
            direction,
            weight,
            is_specular: matches!(scatter, Scatter::Specular { .. }),
            medium: media.map(|media| media.before(!self.is_at_front())),
        })
    }

    /// What the factor of radiance is multiplied with to be that of flux; `None` if light is not sent back the same way.
    fn specular_factor(&self, here: &Seen<'_>, there: &Seen<'_>, wi: Direction) -> Option<f64> {
        let turned = (here.viewer.z() * there.cos_leaving).abs();
        let own = (self.cos_arriving() * wi.z()).abs();
        let scale = here.brdf.radiance_scale(here.viewer, wi);
        (there.normal == here.normal && own > 0.0).then_some(turned / (own * scale))
    }

    /// What a path from a viewer in this direction would meet.
    fn encounter_from(&self, direction: Vec3, is_beyond: bool) -> Encounter {
        let seen = Encounter::seen(self.hit, self.site);
        let place = self.hit.place;
        Encounter {
            viewer: direction.into(),
            side: seen.side ^ u32::from(is_beyond),
            place: match is_beyond {
                true => Place {
                    normal: place.normal.map(|axis| -axis),
                    ..place
                },
                false => place,
            },
            ..seen
        }
    }

    /// The model as it is for a viewer in this direction.
    fn seen_from(&self, direction: Vec3) -> Option<Seen<'a>> {
        let facing = Vec3::from_array(self.hit.place.normal);
        let cos_leaving = direction.dot(facing);
        let is_beyond = cos_leaving < 0.0;
        let encounter = self.encounter_from(direction, is_beyond);
        let side = &self.tables.sides[encounter.side as usize];
        // Nothing gets through a surface whose sides are not of one material.
        if side.material != self.side.material {
            return None;
        }
        let brdf = self.tables.brdf(side, &self.site, self.wavelengths)?;
        let normal = self.tables.shading_normal(&encounter)?;
        let is_inverted = side.transmits && !encounter.is_at_front();
        let up = if is_inverted { -normal } else { normal };
        let frame = self.tables.frame(self.hit.primitive, up);
        Some(Seen {
            brdf,
            viewer: local(&frame, encounter.viewer)?,
            light: local(&frame, self.hit.viewer)?,
            frame,
            normal: if encounter.is_at_front() {
                normal
            } else {
                -normal
            },
            cos_leaving: f64::from(cos_leaving),
            is_beyond,
        })
    }
}

/// Light at a surface and a viewer.
struct Seen<'a> {
    brdf: Cow<'a, Brdf>,
    frame: Frame,
    viewer: Direction,
    light: Direction,
    /// On the side of the front.
    normal: Direction,
    /// At the true normal on the side of the light.
    cos_leaving: f64,
    is_beyond: bool,
}

impl Seen<'_> {
    /// Intensity towards the viewer per flux; `None` if the local axes and the surface disagree about where that is.
    fn intensity(&self, arrival: &Arrival<'_>) -> Option<Lanes4> {
        let through = (self.light.z() < 0.0) != (self.viewer.z() < 0.0);
        let value = self.brdf.evaluate(self.viewer, self.light);
        if through != self.is_beyond || value.is_zero() || arrival.cos_arriving() == 0.0 {
            return None;
        }
        let turned = self.light.z() * self.cos_leaving / arrival.cos_arriving();
        Some((value * turned.abs()).to_lanes())
    }
}

/// Reflected by a mirror that lies in the surface.
pub(super) fn mirrored(hit: &Hit, weight: Lanes4) -> Departure {
    let viewer = Vec3::from_array(hit.viewer);
    let normal = Vec3::from_array(hit.place.normal);
    Departure {
        direction: (2.0 * normal.dot(viewer) * normal - viewer).normalize(),
        weight,
        is_specular: true,
        medium: None,
    }
}

/// Passed through without a turn.
pub(super) fn straight(hit: &Hit, weight: Lanes4) -> Departure {
    Departure {
        direction: -Vec3::from_array(hit.viewer),
        weight,
        is_specular: true,
        medium: None,
    }
}
