//! A rough metal of Trowbridge and Reitz' facets in single precision, without branches: for loops over many paths.
//!
//! The same law as [`RoughConductor`](super::RoughConductor)'s first term, written so that nothing cancels at the horizon. With h = d_e + d_i,
//! not of unit length, and l(ω) = √((α_x ω_x)² + (α_y ω_y)² + ω_z²),
//!
//! D = (h·h)²/(π α_x α_y s²), s = (h_x/α_x)² + (h_y/α_y)² + h_z², cos(d_e, m) = |h|/2,
//!
//! G₂/(4 cosθ_e cosθ_i) = 1/((cosθ_e + l_e)(cosθ_i + l_i)), or 1/(2 (l_e cosθ_i + l_i cosθ_e)) of correlated heights,
//!
//! pdf = D/(2 (k cosθ_e + l_e)).
//!
//! Rounding: h_x and h_y are off by up to 2 ε each, ε = 2⁻²⁴, as are the directions themselves, and |∂ ln D/∂h_x| ≤ 2/(α |h|) wherever that is;
//! all else is off by some 40 roundings of its own size, the Fresnel reflectance by 20 ε of 1. So ρ cosθ_i, which is ρ's share of it, and pdf are
//! right to 16 ε/(α |h|) + 64 ε: 1e-6 at α = 1, 1e-3 at α = .001, which is what rounding the directions alone does to D.
//!
//! Sources as of [`Facets`](super::Facets); E. Heitz, JCGT 3 (2014), eq. 72 for l.

use std::f32::consts::FRAC_1_PI;

use super::facets::{Facets, Shadowing, Slopes};
use crate::sampling::sincos;

type Lanes = [f32; 4];

/// What loops know of a rough metal.
#[derive(Copy, Clone, Debug, Default, PartialEq)]
pub(crate) struct Metal {
    /// α_x, α_y.
    pub alpha: [f32; 2],
    /// 1 where heights are correlated, else 0.
    pub correlated: f32,
    /// η of each lane.
    pub eta: Lanes,
    /// κ of each lane.
    pub kappa: Lanes,
}

impl Metal {
    /// Of facets that loops can deal with.
    pub(super) fn new(facets: Facets, [eta, kappa]: [[f64; 4]; 2]) -> Option<Self> {
        let single = |lanes: [f64; 4]| lanes.map(|lane| lane as f32);
        (facets.slopes() == Slopes::Ggx).then(|| Self {
            alpha: facets.widths().map(|width| width as f32),
            correlated: match facets.visibility() {
                Shadowing::HeightCorrelated => 1.0,
                Shadowing::Separable => 0.0,
            },
            eta: single(eta),
            kappa: single(kappa),
        })
    }

    /// ρ cosθ_i and the density of d_i, both 0 unless both directions lie above the surface.
    #[inline(always)]
    pub fn evaluate(&self, wo: [f32; 3], wi: [f32; 3]) -> (Lanes, f32) {
        let h: [f32; 3] = std::array::from_fn(|axis| wo[axis] + wi[axis]);
        let (hh, inverse) = (dot(h, h), self.alpha.map(|alpha| 1.0 / alpha));
        let [x, y] = [h[0] * inverse[0], h[1] * inverse[1]];
        let ratio = hh / (x * x + y * y + h[2] * h[2]);
        let density = ratio * ratio * (inverse[0] * inverse[1] * FRAC_1_PI);
        let [le, li] = [wo, wi].map(|direction| self.stretched(direction));
        let separable = (wo[2] + le) * (wi[2] + li);
        let shared = 2.0 * (le * wi[2] + li * wo[2]);
        let visible = 1.0 / select(self.correlated > 0.0, shared, separable);
        let pdf = density / (2.0 * (self.bound(wo) * wo[2] + le));
        let cos = (0.5 * hh.sqrt()).min(1.0);
        let above = wo[2] > 0.0 && wi[2] > 0.0;
        let scale = select(above, density * visible * wi[2], 0.0);
        let value = |lane: usize| scale * conductor(cos, self.eta[lane], self.kappa[lane]);
        (std::array::from_fn(value), select(above, pdf, 0.0))
    }

    /// A mirrored direction, that may lie below the surface.
    #[inline(always)]
    pub fn sample(&self, wo: [f32; 3], [u, v]: [f32; 2]) -> [f32; 3] {
        let inverse = 1.0 / self.stretched(wo);
        let z = wo[2] * inverse;
        let depth = self.bound(wo) * z;
        // As 1 − z the height on the cap keeps its digits where it is steep.
        let below = u * (1.0 + depth);
        let sin = (below * (2.0 - below)).max(0.0).sqrt();
        let (y, x) = sincos::sin_cos_two_pi(v);
        let stretched = [0, 1].map(|axis| self.alpha[axis] * wo[axis] * inverse);
        let m = [
            self.alpha[0] * (sin * x + stretched[0]),
            self.alpha[1] * (sin * y + stretched[1]),
            (1.0 - below + z).max(0.0),
        ];
        let along = 2.0 * dot(wo, m) / dot(m, m).max(f32::MIN_POSITIVE);
        std::array::from_fn(|axis| along * m[axis] - wo[axis])
    }

    /// l.
    #[inline(always)]
    fn stretched(&self, [x, y, z]: [f32; 3]) -> f32 {
        let [x, y] = [self.alpha[0] * x, self.alpha[1] * y];
        (x * x + y * y + z * z).sqrt()
    }

    /// k: how far below the horizon the cap of mirrored directions reaches, of the unbounded cap.
    #[inline(always)]
    fn bound(&self, [x, y, z]: [f32; 3]) -> f32 {
        let a = self.alpha[0].min(self.alpha[1]);
        let s = 1.0 + (x * x + y * y).sqrt();
        let (a2, s2) = (a * a, s * s);
        (1.0 - a2) * s2 / (s2 + a2 * z * z)
    }
}

/// Reflectance of unpolarised light, as [`fresnel::conductor`](crate::brdf::fresnel::conductor).
#[inline(always)]
fn conductor(cos: f32, eta: f32, kappa: f32) -> f32 {
    let cos_squared = cos * cos;
    let sin_squared = 1.0 - cos_squared;
    let real = (eta - kappa) * (eta + kappa) - sin_squared;
    let product = eta * kappa;
    let size = (real * real + 4.0 * product * product).sqrt();
    let root = (0.5 * (size + real.abs())).sqrt();
    let a = select(real > 0.0, root, product / root.max(f32::MIN_POSITIVE));
    let odd = 2.0 * a * cos;
    let s = quotient(size + cos_squared, odd);
    let squares = cos_squared * size + sin_squared * sin_squared;
    0.5 * s * (1.0 + quotient(squares, odd * sin_squared))
}

#[inline(always)]
fn quotient(even: f32, odd: f32) -> f32 {
    (even - odd) / (even + odd).max(f32::MIN_POSITIVE)
}

#[inline(always)]
fn select(which: bool, yes: f32, no: f32) -> f32 {
    if which { yes } else { no }
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::brdf::{ComplexIndex, RoughConductor};
    use crate::geometry::{Direction, Vector};

    const EPSILON: f64 = 0.5 * f32::EPSILON as f64;

    fn metal(alpha: [f64; 2], shadowing: Shadowing, [eta, kappa]: [[f64; 4]; 2]) -> RoughConductor {
        let facets = Facets::anisotropic(Slopes::Ggx, alpha).unwrap();
        let index = ComplexIndex::new(eta, kappa).unwrap();
        RoughConductor::single_scattering(facets.with_shadowing(shadowing), index)
    }

    /// Whose indices single precision holds.
    fn any_metal() -> impl Strategy<Value = RoughConductor> {
        let width =
            || (-3.0..0.0).prop_map(|power| f64::from(libm::exp10(power) as f32).clamp(0.001, 1.0));
        let part = || prop::array::uniform4((0.05_f32..10.0).prop_map(f64::from));
        let shadowing = prop_oneof![
            Just(Shadowing::HeightCorrelated),
            Just(Shadowing::Separable)
        ];
        ([width(), width()], shadowing, [part(), part()])
            .prop_map(|(alpha, shadowing, index)| metal(alpha, shadowing, index))
    }

    /// Above the surface, half of them within a thousandth of the horizon.
    fn any_direction() -> impl Strategy<Value = [f32; 3]> {
        let height = prop_oneof![1e-6..1.0_f64, (-6.0..-3.0).prop_map(libm::exp10)];
        (height, 0.0..std::f64::consts::TAU).prop_map(|(z, phi)| {
            let (sin, cos) = libm::sincos(phi);
            let r = (1.0 - z * z).sqrt();
            [r * cos, r * sin, z].map(|axis| axis as f32)
        })
    }

    fn double(direction: [f32; 3]) -> Direction {
        let [x, y, z] = direction.map(f64::from);
        Direction::new(Vector::new(x, y, z)).unwrap()
    }

    /// What is said of rounding: that of D, and that of all else.
    fn tolerance(alpha: [f64; 2], wo: [f32; 3], wi: [f32; 3]) -> f64 {
        let half: f32 = (0..3)
            .map(|axis| (wo[axis] + wi[axis]) * (wo[axis] + wi[axis]))
            .sum();
        let width = alpha[0].min(alpha[1]) * f64::from(half).sqrt();
        16.0 * EPSILON / width + 64.0 * EPSILON
    }

    fn assert_alike(model: &RoughConductor, wo: [f32; 3], wi: [f32; 3], tolerance: f64) {
        let (found, found_pdf) = model.in_columns().unwrap().0.evaluate(wo, wi);
        let (e, i) = (double(wo), double(wi));
        let expected = model
            .evaluate(e, i)
            .to_lanes()
            .map(|lane| f64::from(lane) * i.z());
        let pdf = model.pdf(e, i);
        // The reflectance is right to parts of 1, not of itself.
        let white = expected.iter().fold(0.0_f64, |most, lane| most.max(*lane));
        for lane in 0..4 {
            let error = (f64::from(found[lane]) - expected[lane]).abs();
            assert!(
                error <= tolerance * (expected[lane] + white),
                "{found:?} {expected:?}"
            );
        }
        let error = (f64::from(found_pdf) - pdf).abs();
        assert!(error <= tolerance * pdf, "{found_pdf} {pdf}");
    }

    proptest! {
        #[test]
        fn values_and_densities_are_those_of_the_model(
            model in any_metal(), wo in any_direction(), wi in any_direction()
        ) {
            assert_alike(&model, wo, wi, tolerance(model.widths(), wo, wi));
        }

        /// Where D is great, along the mirrored direction and near it.
        #[test]
        fn highlights_are_those_of_the_model(
            model in any_metal(), wo in any_direction(), u in [0.0_f32..1.0, 0.0..1.0]
        ) {
            let row = model.in_columns().unwrap().0;
            let wi = row.sample(wo, u);
            let own = model.sample(double(wo), u.map(f64::from));
            // Directions that all but graze lie above for one and below for the other.
            if let (Some(own), true) = (own, wi[2] > 1e-5) {
                let error = (own.wi().to_vector() - double(wi).to_vector()).length();
                let [x, y] = model.widths();
                // A facet's normal may be as short as a width before it is made one.
                let rounding = 64.0 * EPSILON + 16.0 * EPSILON / x.min(y);
                prop_assert!(error < rounding, "{wi:?} {own:?}");
                assert_alike(&model, wo, wi, tolerance(model.widths(), wo, wi));
            }
        }
    }

    /// White facets with a second term, whose tables lie between those of two widths.
    #[test]
    fn both_terms_are_those_of_the_model() {
        for alpha in [0.05, 0.3, 0.77, 1.0] {
            let facets = Facets::isotropic(Slopes::Ggx, alpha).unwrap();
            let model = RoughConductor::new(facets, ComplexIndex::PERFECT);
            let (first, later) = model.in_columns().unwrap();
            let later = later.unwrap();
            for k in 0..400_u32 {
                let u = [0, 1].map(|d| crate::sampling::block::sample(9, k, d));
                let [wo, wi] = u.map(|[z, v, ..]| {
                    let (sin, cos) = libm::sincosf(std::f32::consts::TAU * v);
                    let r = (1.0 - z * z).sqrt();
                    [r * cos, r * sin, z]
                });
                if wo[2] == 0.0 || wi[2] == 0.0 {
                    continue;
                }
                let share = later.share(wo[2]);
                let found = later.added_to(first.evaluate(wo, wi), share, wi[2]);
                let (e, i) = (double(wo), double(wi));
                let value = f64::from(model.evaluate(e, i).to_lanes()[0]) * i.z();
                let tolerance = tolerance([alpha; 2], wo, wi) + 1e-5;
                assert!(
                    (f64::from(found.0[0]) - value).abs() < tolerance * (value + i.z()),
                    "{found:?} {value}"
                );
                let pdf = model.pdf(e, i);
                assert!(
                    (f64::from(found.1) - pdf).abs() < tolerance * (pdf + i.z()),
                    "{found:?} {pdf}"
                );
            }
        }
    }

    #[test]
    fn nothing_is_reflected_below() {
        let row = metal([0.1; 2], Shadowing::Separable, [[0.2; 4], [3.0; 4]])
            .in_columns()
            .unwrap()
            .0;
        let [up, down] = [[0.6, 0.0, 0.8], [0.6, 0.0, -0.8]];
        assert_eq!(row.evaluate(up, down), ([0.0; 4], 0.0));
        assert_eq!(row.evaluate(down, up), ([0.0; 4], 0.0));
        assert!(row.evaluate(up, up).1 > 0.0);
    }

    #[test]
    fn gaussian_facets_are_not_for_loops() {
        let facets = Facets::isotropic(Slopes::Beckmann, 0.1).unwrap();
        let metal = RoughConductor::single_scattering(facets, ComplexIndex::PERFECT);
        assert_eq!(metal.in_columns(), None);
    }
}
