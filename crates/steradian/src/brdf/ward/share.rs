//! What share of the light the lobe reflects.
//!
//! It is the mean of w = 2 cosθ_i/(cosθ_e + cosθ_i), or 0 where cosθ_i < 0, over the sampler's facets, whose slopes (α_x s, α_y t) have the
//! density exp(−s² − t²)/π. With t_e = tanθ_e, the direction e of (α_x d_e,x, α_y d_e,y) and T = t_e times the length that
//! (α_x, α_y) give to d_e's azimuth, coordinates a along e and b across make
//!
//! w = 2 − (1 + A a² + 2B a b + C b²)/(1 − T a),  squared slope r² = A a² + 2B a b + C b²,
//!
//! positive where C b² + 2B a b < 1 − 2T a − A a². The integral over b is a closed form of exp and erf. That over a is found by Gauss's rule in
//! ln(1 − T a), because of the pole, halved until it no longer changes: the same work for all widths and angles.

use std::f64::consts::FRAC_1_PI;

use crate::brdf::microfacet::Facets;
use crate::geometry::{Direction, gauss};

/// √π/2.
const HALF_SQRT_PI: f64 = 0.886_226_925_452_758;
/// Slopes beyond have a probability of 1e-16.
const STEEPEST: f64 = 6.0;
/// Of an interval's integral.
const TOLERANCE: f64 = 1e-7;
const MOST_HALVINGS: u32 = 12;

/// The mean weight of facets of density D m_z as seen from above.
pub(super) fn lobe_share(facets: Facets, wo: Direction) -> f64 {
    let lobe = Lobe::new(facets.widths(), wo);
    let [from, to] = lobe.ends();
    let whole = lobe.by_rule([from, to]);
    FRAC_1_PI * lobe.refined([from, to], whole, MOST_HALVINGS)
}

/// T and the coefficients of r².
struct Lobe {
    tan: f64,
    /// A, B and C.
    square: [f64; 3],
    /// A C − B².
    determinant: f64,
}

impl Lobe {
    fn new([x, y]: [f64; 2], wo: Direction) -> Self {
        let [along, across] = [x * wo.x(), y * wo.y()];
        let length = (along * along + across * across).sqrt();
        let [c, s] = match length > 0.0 {
            true => [along / length, across / length],
            false => [1.0, 0.0],
        };
        let (x2, y2) = (x * x, y * y);
        Self {
            tan: (length / wo.z()).clamp(1e-12, 1e12),
            square: [
                x2 * c * c + y2 * s * s,
                c * s * (y2 - x2),
                x2 * s * s + y2 * c * c,
            ],
            determinant: x2 * y2,
        }
    }

    /// ln(1 − T a) between which some facet mirrors light to above the surface.
    fn ends(&self) -> [f64; 2] {
        let c = self.square[2];
        let middle = c * self.tan;
        let reach = middle + (middle * middle + c * self.determinant).sqrt();
        let highest = (c / reach).min(STEEPEST);
        let lowest = (reach / self.determinant).min(STEEPEST);
        [-self.tan * highest, self.tan * lowest].map(libm::log1p)
    }

    /// The sum of the halves, as soon as it is what the whole gave.
    fn refined(&self, [from, to]: [f64; 2], whole: f64, halvings: u32) -> f64 {
        let middle = 0.5 * (from + to);
        let halves = [[from, middle], [middle, to]];
        let found = halves.map(|half| self.by_rule(half));
        let sum = found[0] + found[1];
        if halvings == 0 || (sum - whole).abs() <= TOLERANCE {
            return sum;
        }
        self.refined(halves[0], found[0], halvings - 1)
            + self.refined(halves[1], found[1], halvings - 1)
    }

    fn by_rule(&self, ends: [f64; 2]) -> f64 {
        gauss::integrate(gauss::MAX_ORDER, ends, |v| {
            let a = -libm::expm1(v) / self.tan;
            libm::exp(v - a * a) / self.tan * self.across(a)
        })
    }

    /// ∫ w exp(−b²) db.
    fn across(&self, a: f64) -> f64 {
        let [along, mixed, across] = self.square;
        let u = 1.0 - self.tan * a;
        let discriminant = across * (2.0 * u - 1.0) - self.determinant * a * a;
        let reach = discriminant.max(0.0).sqrt();
        let [low, high] = [-reach, reach].map(|reach| (reach - mixed * a) / across);
        let bells = [low, high].map(|b| libm::exp(-b * b));
        let zeroth = HALF_SQRT_PI * (libm::erf(high) - libm::erf(low));
        let first = 0.5 * (bells[0] - bells[1]);
        let second = 0.5 * (zeroth + low * bells[0] - high * bells[1]);
        let squares = (1.0 + along * a * a) * zeroth + 2.0 * mixed * a * first + across * second;
        2.0 * zeroth - squares / u
    }
}

#[cfg(test)]
mod tests {
    use crate::brdf::Ward;
    use crate::geometry::Direction;
    use crate::quantity::Spectrum;

    fn lobe(alpha: [f64; 2]) -> Ward {
        Ward::new(Spectrum::ZERO, Spectrum::ONE, alpha).unwrap()
    }

    fn view(degrees: f64, azimuth: f64) -> Direction {
        let (sin, cos) = libm::sincos(f64::to_radians(degrees));
        Direction::from_polar(sin, cos, azimuth)
    }

    /// The mean weight of samples whose numbers lie on a grid.
    fn mean_weight(lobe: &Ward, wo: Direction, cells: u32) -> f64 {
        let at = |k: u32| (f64::from(k) + 0.5) / f64::from(cells);
        let weight = |k: u32| {
            let sample = lobe.sample(wo, [at(k / cells), at(k % cells)]);
            sample.map_or(0.0, |scatter| f64::from(scatter.weight().mean()))
        };
        (0..cells * cells).map(weight).sum::<f64>() / f64::from(cells * cells)
    }

    /// The grid is off by the cells that the horizon cuts, by what a grid of 2048² cells changes.
    #[test]
    fn the_albedo_is_the_mean_weight_at_every_width_and_angle() {
        for alpha in [
            [1.0, 0.01],
            [0.01, 1.0],
            [1.0, 0.002],
            [0.002, 1.0],
            [0.3, 0.002],
            [0.05, 0.5],
            [1.0; 2],
            [0.002; 2],
        ] {
            for (degrees, error) in [
                (0.0, 1e-4),
                (30.0, 1e-4),
                (80.0, 1e-4),
                (88.0, 3e-4),
                (89.9, 2e-3),
            ] {
                for azimuth in [0.0, 0.01, 0.6, 1.57] {
                    let (lobe, wo) = (lobe(alpha), view(degrees, azimuth));
                    let albedo = f64::from(lobe.albedo(wo).mean());
                    let mean = mean_weight(&lobe, wo, 256);
                    assert!(
                        (albedo - mean).abs() < error,
                        "{alpha:?} {degrees} {azimuth}: {albedo} {mean}"
                    );
                }
            }
        }
    }

    /// Seen along the normal with equal widths, w = 1 − r² below r = 1, whose mean is 1 − α² (1 − exp(−1/α²)).
    #[test]
    fn along_the_normal_the_albedo_is_a_closed_form() {
        for alpha in [0.002, 0.1, 0.5, 1.0] {
            let square = alpha * alpha;
            let expected = 1.0 + square * libm::expm1(-1.0 / square);
            let albedo = f64::from(lobe([alpha; 2]).albedo(Direction::Z).mean());
            assert!((albedo - expected).abs() < 1e-6, "{alpha}: {albedo}");
        }
    }
}
