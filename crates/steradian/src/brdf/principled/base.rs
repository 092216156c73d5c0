//! What lies below coat and sheen: metal, opaque and transmitting dielectric in the shares that glTF mixes.

use std::f64::consts::FRAC_1_PI;

use super::Parameters;
use crate::brdf::fresnel::refract;
use crate::brdf::sampling::flipped;
use crate::brdf::smooth_dielectric::facing;
use crate::brdf::{
    ComplexIndex, Facets, ModelError, RoughConductor, RoughDielectric, Scatter, SmoothDielectric,
    to_spectrum,
};
use crate::geometry::Direction;
use crate::quantity::Spectrum;

/// Widths below this are smooth, where light goes through.
pub(super) const SMOOTH: f64 = 1e-3;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Base {
    /// Highlights of metal and opaque dielectric: both have the same facets, so that one lobe does for both.
    pub(super) gloss: RoughConductor,
    /// The highlights of the dielectric alone, by its strongest colour.
    dielectric: RoughConductor,
    /// Share and colour of the diffuse light, over 1 − Ē of the highlights.
    diffuse: [f64; 4],
    pub(super) through: Through,
}

/// How light gets to the other side.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Through {
    Not,
    /// Through a sheet, with this share and colour; `None` where it is smooth.
    Sheet {
        color: [f64; 4],
        spread: Option<RoughConductor>,
    },
    /// Into a solid, which covers this share.
    Solid {
        share: f64,
        interface: Interface,
    },
}

/// Between outside and inside.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Interface {
    Smooth(SmoothDielectric),
    Rough(Box<RoughDielectric>),
}

impl Base {
    pub(super) fn new(parameters: &Parameters, facets: Facets) -> Result<Self, ModelError> {
        let p = parameters;
        let dielectric = 1.0 - p.metallic;
        let clear = dielectric * p.transmission;
        // A sheet's highlights are those of any dielectric; a solid has its own.
        let opaque = if p.thin {
            dielectric
        } else {
            dielectric - clear
        };
        let ratio = (p.ior - 1.0) / (p.ior + 1.0);
        let specular = |lane: f32| (ratio * ratio * f64::from(lane)).min(1.0) * p.specular;
        let normal = p.specular_color.to_lanes().map(specular);
        let strongest = normal.into_iter().fold(0.0, f64::max);
        let color = p.base_color.to_lanes().map(f64::from);
        let mixed: [f64; 4] =
            std::array::from_fn(|lane| opaque * normal[lane] + p.metallic * color[lane]);
        let grazing = opaque * p.specular + p.metallic;
        let highlights = RoughConductor::schlick(
            facets,
            Spectrum::splat(strongest as f32),
            Spectrum::splat(p.specular as f32),
        )?;
        let scale = (dielectric - clear) / (1.0 - highlights.tabulated_average()[0]).max(1e-9);
        Ok(Self {
            gloss: RoughConductor::schlick(
                facets,
                to_spectrum(mixed.map(|lane| lane.min(1.0))),
                Spectrum::splat(grazing.min(1.0) as f32),
            )?,
            dielectric: highlights,
            diffuse: color.map(|lane| lane * scale),
            through: Through::new(p, facets, clear)?,
        })
    }

    /// The share of the light along a direction that the dielectric's highlights leave.
    pub(super) fn entering(&self, direction: Direction) -> f64 {
        let upper = if direction.z() < 0.0 {
            flipped(direction)
        } else {
            direction
        };
        (1.0 - self.dielectric.tabulated_albedo(upper)[0]).max(0.0)
    }

    /// ρ/(π (1 − Ē)) (1 − E(d_e)) (1 − E(d_i)).
    pub(super) fn diffuse(&self, wo: Direction, wi: Direction) -> [f64; 4] {
        let both = self.entering(wo) * self.entering(wi) * FRAC_1_PI;
        self.diffuse.map(|lane| lane * both)
    }

    /// About what is reflected diffusely.
    pub(super) fn diffuse_albedo(&self, wo: Direction) -> f64 {
        let mean = 0.25 * self.diffuse.iter().sum::<f64>();
        mean * self.entering(wo) * (1.0 - self.dielectric.tabulated_average()[0])
    }

    /// ρ of what lies below coat and sheen.
    pub(super) fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        let through = match &self.through {
            Through::Not => Spectrum::ZERO,
            Through::Sheet { color, spread } => self.through_sheet(*color, spread, wo, wi),
            Through::Solid { share, interface } => match interface {
                Interface::Smooth(_) => Spectrum::ZERO,
                Interface::Rough(rough) => rough.evaluate(wo, wi) * *share,
            },
        };
        let Some((wo, wi)) = self.reflecting(wo, wi) else {
            return through;
        };
        through + self.gloss.evaluate(wo, wi) + to_spectrum(self.diffuse(wo, wi))
    }

    /// Both directions above, if light is reflected by the opaque part: below only of a sheet, which has no inside.
    pub(super) fn reflecting(
        &self,
        wo: Direction,
        wi: Direction,
    ) -> Option<(Direction, Direction)> {
        let sheet = matches!(self.through, Through::Sheet { .. });
        match (wo.z(), wi.z()) {
            (o, i) if o > 0.0 && i > 0.0 => Some((wo, wi)),
            (o, i) if o < 0.0 && i < 0.0 && sheet => Some((flipped(wo), flipped(wi))),
            _ => None,
        }
    }

    /// What the sheet lets straight through at most, from one direction to the other.
    pub(super) fn let_through(&self, wo: Direction, wi: Direction) -> f64 {
        self.entering(wo).min(self.entering(wi))
    }

    fn through_sheet(
        &self,
        color: [f64; 4],
        spread: &Option<RoughConductor>,
        wo: Direction,
        wi: Direction,
    ) -> Spectrum {
        let (Some(spread), true) = (spread, wo.z() * wi.z() < 0.0) else {
            return Spectrum::ZERO;
        };
        let (near, far) = if wo.z() > 0.0 {
            (wo, flipped(wi))
        } else {
            (flipped(wo), wi)
        };
        let share = self.let_through(near, far);
        spread.evaluate(near, far) * to_spectrum(color.map(|lane| lane * share))
    }
}

impl Through {
    fn new(p: &Parameters, facets: Facets, clear: f64) -> Result<Self, ModelError> {
        let smooth = facets.widths() == [SMOOTH; 2];
        if clear == 0.0 {
            return Ok(Self::Not);
        }
        if p.thin {
            let spread = RoughConductor::new(facets, ComplexIndex::PERFECT);
            return Ok(Self::Sheet {
                color: p.base_color.to_lanes().map(|lane| f64::from(lane) * clear),
                spread: (!smooth).then_some(spread),
            });
        }
        let tints = (p.specular_color * p.specular).to_lanes();
        let reflected = Spectrum::from_lanes(tints.map(|lane| lane.min(1.0)));
        let interface = if smooth {
            let clear = SmoothDielectric::new(p.ior)?;
            Interface::Smooth(clear.with_tints(reflected, p.base_color)?)
        } else {
            let rough = RoughDielectric::new(facets, p.ior)?;
            Interface::Rough(Box::new(rough.with_tints(reflected, p.base_color)?))
        };
        Ok(Self::Solid {
            share: clear,
            interface,
        })
    }
}

impl Interface {
    pub(super) fn eta(&self) -> f64 {
        match self {
            Self::Smooth(smooth) => smooth.eta(),
            Self::Rough(rough) => rough.eta(),
        }
    }

    pub(super) fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        match self {
            Self::Smooth(smooth) => smooth.sample(wo, u),
            Self::Rough(rough) => rough.sample(wo, u),
        }
    }

    /// Reflected and transmitted shares of power, with every direction of incidence multiplied by f.
    pub(super) fn leaving(&self, wo: Direction, f: impl Fn(Direction) -> f64) -> [Spectrum; 2] {
        match self {
            Self::Smooth(smooth) => {
                let mirrored = Direction::Z.mirror(wo);
                let refracted = facing(wo, smooth.eta())
                    .and_then(|(normal, eta)| refract(wo, normal, eta))
                    .map_or(0.0, &f);
                [
                    smooth.albedo(wo) * f(mirrored),
                    smooth.transmittance(wo) * refracted,
                ]
            }
            Self::Rough(rough) => {
                let [reflected, transmitted] = rough.leaving(wo, f);
                let [mirrored, refracted] = rough.tints();
                [mirrored * reflected, refracted * transmitted]
            }
        }
    }
}
