//! The unified glare rating of the lights of a scene, for an observer in it.
//!
//! Every light with extent, a luminaire's opening or a shape that emits, is one source. Over points of equal area A/N on it
//!
//! ω = Σ V cosθ_l A/(N r²) ,  L = Σ L_i ω_i / ω ,  E = Σ L_i cosθ ω_i ,  L_b = (E_v − Σ E)/π
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | V | 1 where the eye sees the point, else 0: what lets a part of the light pass hides all the same | – |
//! | θ_l, θ | angles at the light, and from the line of sight | rad |
//! | r | distance of the eye | m |
//! | E_v | illuminance at the eye on a plane that faces the view, measured | lx |
//!
//! Points, spots and luminaires that shine as points have no luminance and cannot be rated; the sky and directional light are no sources. A source at
//! p > 16 does not count, but its light is no background either. The luminance of textured lights is that of the factor 1. Source: CIE 117:1995, equations 1 and 2.

use std::f64::consts::{LN_10, PI};

use steradian_kernel::{InstructionSet, RayBatch};

use super::position_index::{GREATEST_POSITION_INDEX, Gaze};
use super::unified::{GlareSource, rating};
use crate::estimation::Estimate;
use crate::geometry::{Direction, Point, Vector};
use crate::light::{Kind, Light};
use crate::quantity::{Illuminance, Luminance, Radiance, SolidAngle};
use crate::scene::Scene;
use crate::sensor::Readout;
use crate::shape::{Form, ShapeId};

/// Points of a light.
const POINTS: u32 = 1024;
/// Rays end before the light by this part of their length.
const SHORT: f64 = 1e-4;

/// A light as an observer sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenLight {
    /// Its name.
    pub name: String,
    /// What it is as a source; none where p > 16.
    pub source: Option<GlareSource>,
    /// Where it is.
    pub direction: Direction,
    /// What it gives directly to the eye, on a plane that faces the view.
    pub illuminance: Illuminance,
}

/// All lights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeenLights {
    /// Those in view.
    pub lights: Vec<SeenLight>,
    /// Names of those that cannot be rated.
    pub without_extent: Vec<String>,
}

impl SeenLights {
    /// Of a scene, for an eye; `readout` tells the luminance of channels.
    pub fn of(
        scene: &Scene,
        eye: Point,
        gaze: Gaze,
        readout: &Readout,
        set: InstructionSet,
    ) -> Self {
        let view = View {
            scene,
            eye,
            gaze,
            readout,
            set,
        };
        let mut seen = Self::default();
        for light in scene.lights() {
            match view.surface(light) {
                Some(surface) => seen.lights.extend(view.light(light, &surface)),
                None if light.is_delta() && !matches!(light.kind, Kind::Directional { .. }) => {
                    seen.without_extent.push(light.name.clone());
                }
                None => {}
            }
        }
        seen
    }

    /// UGR, from the illuminance at the eye in lx; `None` without sources, or where the lights alone give as much.
    pub fn unified_glare_rating(&self, eye: &Estimate) -> Option<Estimate> {
        let direct: f64 = self
            .lights
            .iter()
            .map(|light| light.illuminance.to_lux())
            .sum();
        let sum: f64 = self
            .lights
            .iter()
            .filter_map(|light| light.source)
            .map(|source| source.weight())
            .sum();
        let background = eye.plus_exact(-direct).scaled(1.0 / PI);
        let value = rating(background.value, sum)?;
        let interval = background.interval.and_then(|[low, high]| {
            let [worst, best] = [low, high].map(|luminance| rating(luminance, sum));
            Some([best?, worst?])
        });
        Some(Estimate {
            value,
            std_error: 8.0 / LN_10 * background.std_error / background.value,
            interval,
            upper_bound: None,
            ..background
        })
    }
}

/// Who looks, and where.
struct View<'a> {
    scene: &'a Scene,
    eye: Point,
    gaze: Gaze,
    readout: &'a Readout,
    set: InstructionSet,
}

/// What a light shines from.
struct Surface<'a> {
    form: &'a Form,
    two_sided: bool,
    /// L in cd/m² in a direction away from it.
    luminance: Box<dyn Fn(Direction) -> f64 + 'a>,
}

/// A point of a light that may be seen.
struct Part {
    direction: Direction,
    distance: f64,
    solid_angle: f64,
    luminance: f64,
}

impl<'a> View<'a> {
    /// None of lights without extent or shape.
    fn surface(&self, light: &'a Light) -> Option<Surface<'a>> {
        let form = |shape: ShapeId| &self.scene.surfaces().shape(shape).form;
        match &light.kind {
            Kind::Area(area) => {
                let lanes = area
                    .radiance
                    .map(Radiance::to_watts_per_square_metre_steradian);
                let luminance = self.photometric(light, lanes);
                Some(Surface {
                    form: form(area.shape),
                    two_sided: area.two_sided,
                    luminance: Box::new(move |_| luminance),
                })
            }
            Kind::Luminaire(luminaire) => {
                let (shape, two_sided) = luminaire.surface()?;
                let lanes = luminaire
                    .unit
                    .map(crate::quantity::Intensity::to_watts_per_steradian);
                let unit = self.photometric(light, lanes);
                Some(Surface {
                    form: form(shape),
                    two_sided,
                    luminance: Box::new(move |away| unit * luminaire.factor(away)),
                })
            }
            _ => None,
        }
    }

    /// Lanes in watts as the eye weighs them.
    fn photometric(&self, light: &Light, lanes: [f64; crate::spectrum::MAX_LANES]) -> f64 {
        let channels = self.scene.channels(light, lanes);
        let weights = self.readout.weights.iter();
        weights
            .zip(channels)
            .map(|(weight, channel)| weight * channel)
            .sum()
    }

    fn light(&self, light: &Light, surface: &Surface<'_>) -> Option<SeenLight> {
        let parts = self.visible(self.parts(surface));
        let solid_angle: f64 = parts.iter().map(|part| part.solid_angle).sum();
        let total: f64 = parts
            .iter()
            .map(|part| part.luminance * part.solid_angle)
            .sum();
        if total <= 0.0 {
            return None;
        }
        let weighted =
            |sum: Vector, part: &Part| sum + part.direction * (part.luminance * part.solid_angle);
        let direction = Direction::new(parts.iter().fold(Vector::ZERO, weighted)).ok()?;
        let index = self.gaze.position_index(direction)?;
        let cosine = |part: &Part| part.direction.dot(self.gaze.forward());
        let illuminance = parts
            .iter()
            .map(|part| part.luminance * part.solid_angle * cosine(part));
        let source = GlareSource {
            luminance: Luminance::from_candelas_per_square_metre(total / solid_angle),
            solid_angle: SolidAngle::from_steradians(solid_angle),
            position_index: index,
        };
        Some(SeenLight {
            name: light.name.clone(),
            source: (index <= GREATEST_POSITION_INDEX).then_some(source),
            direction,
            illuminance: Illuminance::from_lux(illuminance.sum()),
        })
    }

    /// Those in front of the eye that face it.
    fn parts(&self, surface: &Surface<'_>) -> Vec<Part> {
        let area = surface.form.sampling_area() / f64::from(POINTS);
        let part = |index: u32| {
            let reversed = f64::from(index.reverse_bits()) / 4_294_967_296.0;
            let u = [(f64::from(index) + 0.5) / f64::from(POINTS), reversed];
            let sample = surface.form.sample_area(u)?;
            let towards = sample.point - self.eye;
            let direction = Direction::new(towards).ok()?;
            let cosine = -direction.dot(sample.normal);
            let cosine = if surface.two_sided {
                cosine.abs()
            } else {
                cosine
            };
            let luminance = (surface.luminance)(-direction);
            let in_front = direction.dot(self.gaze.forward()) > 0.0;
            (in_front && cosine > 0.0 && luminance > 0.0).then(|| Part {
                direction,
                distance: towards.length(),
                solid_angle: area * cosine / towards.length_squared(),
                luminance,
            })
        };
        (0..POINTS).filter_map(part).collect()
    }

    fn visible(&self, parts: Vec<Part>) -> Vec<Part> {
        let surfaces = self.scene.surfaces();
        let origin = surfaces.to_kernel(self.eye);
        let mut rays = RayBatch::with_capacity(parts.len());
        for part in &parts {
            let end = part.distance * (1.0 - SHORT) - surfaces.clearance();
            let direction = part.direction.to_array().map(|x| x as f32);
            rays.push(origin, direction, end.max(0.0) as f32);
        }
        let mut hidden = Vec::new();
        surfaces.occluded(&rays, &mut hidden, self.set);
        let seen = parts.into_iter().zip(hidden).filter(|(_, hidden)| !hidden);
        seen.map(|(part, _)| part).collect()
    }
}
