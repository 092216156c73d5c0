//! The sheen of cloth: fibres that stand up, by the "Charlie" distribution.
//!
//! ρ = C D V,  D = (2 + 1/α) (sinθ_h)^(1/α)/(2π),  V = 1/(4 cosθ_e cosθ_i (1 + Λ(θ_e) + Λ(θ_i))).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | C | colour | 1 |
//! | α | square of the sheen's roughness, .07 … 1 | 1 |
//! | θ_h | angle of the half-way direction to the normal | rad |
//! | Λ | exp(L(cosθ)) for cosθ < .5, else exp(2 L(.5) − L(1 − cosθ)); L(x) = a/(1 + b xᶜ) + d x + e | 1 |
//!
//! a … e are the authors' fits, interpolated by (1 − α)². Source: A. Conty Estevez and C. Kulla, *Production Friendly Microfacet
//! Sheen BRDF*, SIGGRAPH 2017; KHR_materials_sheen. Below α = .07 (a roughness of .26) the lobe would send back up to
//! twice the light it receives near the horizon, so there it keeps that width. Directions are drawn evenly.

use std::f64::consts::{PI, TAU};

use crate::brdf::microfacet::half_way;
use crate::brdf::microfacet::shelf::{Blend, Shelf};
use crate::brdf::microfacet::table::Table;
use crate::geometry::{Direction, gauss};

/// The least α at which the lobe keeps its energy.
const NARROWEST: f64 = 0.07;
/// Azimuths of the quadrature.
const AZIMUTHS: usize = 24;

/// Standing fibres.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sheen {
    color: [f64; 4],
    alpha: f64,
    /// Its albedo at C = 1.
    albedo: Blend<1>,
}

impl Sheen {
    pub(super) fn new(color: [f64; 4], roughness: f64) -> Self {
        static WIDTHS: Shelf<1> = Shelf::new();
        let alpha = (roughness * roughness).max(NARROWEST);
        Self {
            color,
            alpha,
            albedo: WIDTHS.blend(alpha, |alpha| {
                [Table::new(None, |wo| [hemispherical(alpha, wo.z()), 0.0])]
            }),
        }
    }

    pub(super) fn evaluate(&self, wo: Direction, wi: Direction) -> [f64; 4] {
        let Some(m) = half_way(wo, wi) else {
            return [0.0; 4];
        };
        let value = lobe(self.alpha, [wo.z(), wi.z()], m.z());
        self.color.map(|color| color * value)
    }

    /// At C = 1.
    pub(super) fn albedo(&self, wo: Direction) -> f64 {
        self.albedo.missing(0, wo)
    }

    /// What it leaves of the light that comes to or from what it covers, by its strongest colour.
    pub(super) fn passed(&self, direction: Direction) -> f64 {
        1.0 - self.color.into_iter().fold(0.0, f64::max) * self.albedo(direction)
    }

    pub(super) fn mean_color(&self) -> f64 {
        0.25 * self.color.iter().sum::<f64>()
    }
}

/// D V.
fn lobe(alpha: f64, [cos_o, cos_i]: [f64; 2], cos_h: f64) -> f64 {
    let sin_squared = (1.0 - cos_h * cos_h).max(0.0);
    let density = (2.0 + 1.0 / alpha) * libm::pow(sin_squared, 0.5 / alpha) / TAU;
    density / (4.0 * cos_o * cos_i * (1.0 + lambda(alpha, cos_o) + lambda(alpha, cos_i)))
}

/// Λ.
fn lambda(alpha: f64, cos: f64) -> f64 {
    let part = (1.0 - alpha) * (1.0 - alpha);
    let between = |narrow: f64, wide: f64| wide + part * (narrow - wide);
    let [a, b, c] = [
        between(25.3245, 21.5473),
        between(3.324_35, 3.829_87),
        between(0.168_01, 0.198_23),
    ];
    let [d, e] = [between(-1.273_93, -1.977_60), between(-4.859_67, -4.320_54)];
    let fit = |x: f64| a / (1.0 + b * libm::pow(x, c)) + d * x + e;
    if cos < 0.5 {
        libm::exp(fit(cos))
    } else {
        libm::exp(2.0 * fit(0.5) - fit((1.0 - cos).max(0.0)))
    }
}

/// ∫ D V cosθ_i dω_i, by Gauss's rule in √cosθ_i and the midpoint rule in azimuth: to 6e-4.
fn hemispherical(alpha: f64, cos: f64) -> f64 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let around = |cos_i: f64| -> f64 {
        let sin_i = (1.0 - cos_i * cos_i).max(0.0).sqrt();
        let values = (0..AZIMUTHS).map(|k| {
            let phi = PI * (k as f64 + 0.5) / AZIMUTHS as f64;
            let facing = cos * cos_i + sin * sin_i * libm::cos(phi);
            let cos_h = (cos + cos_i) / (2.0 + 2.0 * facing).max(f64::MIN_POSITIVE).sqrt();
            lobe(alpha, [cos, cos_i], cos_h.min(1.0))
        });
        values.sum::<f64>() / AZIMUTHS as f64
    };
    gauss::integrate(gauss::MAX_ORDER, [0.0, 1.0], |root| {
        let cos_i = root * root;
        2.0 * root * TAU * cos_i * around(cos_i)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Along the normal of both directions sinθ_h = 0; with both at 60° on opposite sides as well, on one side
    /// cosθ_h = 1/2, D = 3 sin 60°/(2π) at α = 1.
    #[test]
    fn the_distribution_is_that_of_a_sine() {
        let cos = 0.5;
        let visible = 4.0 * cos * cos * (1.0 + 2.0 * lambda(1.0, cos));
        let found = lobe(1.0, [cos, cos], 0.5) * visible;
        assert!((found - 1.5 / PI * 0.75_f64.sqrt()).abs() < 1e-12);
        assert_eq!(lobe(1.0, [1.0, 1.0], 1.0), 0.0);
    }

    #[test]
    fn no_width_gains_light() {
        for alpha in [NARROWEST, 0.1, 0.25, 0.5, 1.0] {
            for degrees in [0.0_f64, 45.0, 70.0, 85.0, 89.0, 89.5, 89.9] {
                let albedo = hemispherical(alpha, libm::cos(degrees.to_radians()));
                assert!((0.0..=1.0).contains(&albedo), "{alpha} {degrees}: {albedo}");
            }
        }
    }
}
