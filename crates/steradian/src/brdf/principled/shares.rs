//! How much light the material reflects and transmits in all.

use std::f64::consts::PI;

use super::Principled;
use super::base::Through;
use crate::brdf::sampling::flipped;
use crate::geometry::{Direction, gauss};
use crate::quantity::Spectrum;

/// Azimuths of the quadrature of what is wide.
const AZIMUTHS: usize = 32;

impl Principled {
    /// Shares of the light along `wo` that are reflected and transmitted, part by part.
    pub(super) fn shares_leaving(&self, wo: Direction) -> [[f64; 4]; 2] {
        let layers = |wi: Direction| self.layers(wo, wi);
        let [mut reflected, mut transmitted] = [[0.0; 4]; 2];
        if wo.z() > 0.0 {
            add(&mut reflected, self.coat_and_sheen(wo));
        }
        let upper = if wo.z() < 0.0 { flipped(wo) } else { wo };
        if self.base.reflecting(wo, wo).is_some() {
            let seen = |wi: Direction| layers(if wo.z() < 0.0 { flipped(wi) } else { wi });
            add(&mut reflected, self.base.gloss.leaving(upper, seen));
            add(&mut reflected, self.diffuse_light(upper, seen));
        }
        match &self.base.through {
            Through::Not => {}
            Through::Sheet { color, spread } => {
                let straight = |wi: Direction| {
                    self.base.let_through(upper, wi)
                        * layers(if wo.z() < 0.0 { wi } else { flipped(wi) })
                };
                let share = spread
                    .as_ref()
                    .map_or(straight(upper), |spread| spread.leaving(upper, straight)[0]);
                add(&mut transmitted, color.map(|lane| lane * share));
            }
            Through::Solid { share, interface } => {
                let [back, on] = interface.leaving(wo, layers);
                let part = |light: Spectrum| (light * *share).to_lanes().map(f64::from);
                add(&mut reflected, part(back));
                add(&mut transmitted, part(on));
            }
        }
        [reflected, transmitted]
    }

    fn coat_and_sheen(&self, wo: Direction) -> [f64; 4] {
        let mut light = [0.0; 4];
        if let Some(sheen) = &self.sheen {
            let below_coat = |wi| self.below_coat(wo, wi);
            add(
                &mut light,
                over_hemisphere(|wi| {
                    sheen
                        .evaluate(wo, wi)
                        .map(|lane| PI * lane * below_coat(wi))
                }),
            );
        }
        if let Some(coat) = &self.coat {
            add(&mut light, coat.leaving(wo, |_| 1.0));
        }
        light
    }

    fn diffuse_light(&self, wo: Direction, seen: impl Fn(Direction) -> f64) -> [f64; 4] {
        over_hemisphere(|wi| {
            let share = PI * seen(wi);
            self.base.diffuse(wo, wi).map(|lane| lane * share)
        })
    }
}

fn add(sum: &mut [f64; 4], light: [f64; 4]) {
    (0..4).for_each(|lane| sum[lane] += light[lane]);
}

/// (1/π) ∫ f cosθ dω, by Gauss's rule in √cosθ and the midpoint rule in azimuth.
fn over_hemisphere(f: impl Fn(Direction) -> [f64; 4]) -> [f64; 4] {
    let mut sum = [0.0; 4];
    for &(node, weight) in gauss::rule(gauss::MAX_ORDER) {
        let root = 0.5 * (1.0 + node);
        let cos = root * root;
        let sin = (1.0 - cos * cos).sqrt();
        let weight = weight * 2.0 * root * cos / AZIMUTHS as f64;
        for azimuth in 0..AZIMUTHS {
            let phi = 2.0 * PI * (azimuth as f64 + 0.5) / AZIMUTHS as f64;
            let light = f(Direction::from_polar(sin, cos, phi));
            add(&mut sum, light.map(|lane| weight * lane));
        }
    }
    sum
}
