//! Fresnel's equations: how much of a plane wave a smooth interface reflects.
//!
//! With the relative index η = n_t/n_i of the far side over the near side, or η + iκ for a conductor, and Snell's law
//! sinθ_i = η sinθ_t:
//!
//! r_s = (cosθ_i − η cosθ_t)/(cosθ_i + η cosθ_t),  r_p = (η cosθ_i − cosθ_t)/(η cosθ_i + cosθ_t),  R = (|r_s|² + |r_p|²)/2.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | θ_i, θ_t | angle to the normal on the near and the far side | rad |
//! | r_s, r_p | ratio of amplitudes, electric field across and in the plane of incidence | 1 |
//! | R, T = 1 − R | share of the power reflected and transmitted, unpolarised light | 1 |
//! | η, κ | index of refraction and of extinction, relative to the near side | 1 |
//!
//! Where sinθ_i > η nothing is transmitted (total internal reflection). A transmitted beam is narrower by cosθ_t/cosθ_i η²
//! in solid angle times cosine, so that L_t = η² T L_i: L/n² is what an interface keeps.
//!
//! Source: M. Born and E. Wolf, *Principles of Optics*, 7th ed., §1.5.2 eq. 21, §14.2 eq. 13–18. Valid for flat
//! interfaces of isotropic media that are thick against the wavelength.
//!
//! ```
//! use steradian::brdf::fresnel::{dielectric, refracted_cosine};
//! // Glass at normal incidence: ((1.5 − 1)/(1.5 + 1))² = 0.04.
//! assert!((dielectric(1.0, 1.5).mean() - 0.04).abs() < 1e-15);
//! // From inside at 45°, sinθ_i = .707 > 1/1.5: all is reflected.
//! assert_eq!(refracted_cosine(0.5_f64.sqrt(), 1.0 / 1.5), None);
//! ```

use crate::geometry::{Direction, gauss};

/// Reflectance of the two linear polarisations.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Polarised {
    /// Electric field across the plane of incidence.
    pub s: f64,
    /// Electric field in the plane of incidence.
    pub p: f64,
}

impl Polarised {
    /// Reflectance of unpolarised light.
    pub fn mean(self) -> f64 {
        0.5 * (self.s + self.p)
    }
}

/// cosθ_t by Snell's law; `None` for total internal reflection.
pub fn refracted_cosine(cos_incident: f64, eta: f64) -> Option<f64> {
    let sin_squared = (1.0 - cos_incident * cos_incident) / (eta * eta);
    (sin_squared <= 1.0).then(|| (1.0 - sin_squared).sqrt())
}

/// The direction on the far side of an interface of normal `normal`, both directions pointing away from it.
///
/// `incident` lies on the side of the normal; `eta` is the index of the far side over that of the near side.
pub fn refract(incident: Direction, normal: Direction, eta: f64) -> Option<Direction> {
    let cos_incident = incident.dot(normal);
    let cos_refracted = refracted_cosine(cos_incident, eta)?;
    let along = normal * (cos_incident / eta - cos_refracted);
    Direction::new(along - incident.to_vector() / eta).ok()
}

/// The amplitudes (r_s, r_p) of a wave reflected by a dielectric; `None` for total internal reflection, where both have
/// size 1.
pub fn dielectric_amplitudes(cos_incident: f64, eta: f64) -> Option<(f64, f64)> {
    let cos_refracted = refracted_cosine(cos_incident, eta)?;
    let ratio = |near: f64, far: f64| (near - far) / (near + far);
    Some((
        ratio(cos_incident, eta * cos_refracted),
        ratio(eta * cos_incident, cos_refracted),
    ))
}

/// Reflectance of a dielectric of relative index `eta`.
pub fn dielectric(cos_incident: f64, eta: f64) -> Polarised {
    if eta == 1.0 {
        return Polarised { s: 0.0, p: 0.0 };
    }
    let (s, p) = dielectric_amplitudes(cos_incident, eta).unwrap_or((1.0, 1.0));
    Polarised { s: s * s, p: p * p }
}

/// Reflectance of a conductor of relative index `eta` + i `kappa`.
///
/// With a + ib = √((η + iκ)² − sin²θ_i), squared sizes of r_s and of r_p/r_s are quotients of real numbers.
pub fn conductor(cos_incident: f64, eta: f64, kappa: f64) -> Polarised {
    let cos_squared = cos_incident * cos_incident;
    let sin_squared = 1.0 - cos_squared;
    let real = eta * eta - kappa * kappa - sin_squared;
    let product = eta * kappa;
    let size = (real * real + 4.0 * product * product).sqrt();
    let a = if real > 0.0 {
        (0.5 * (size + real)).sqrt()
    } else {
        product / (0.5 * (size - real)).sqrt().max(f64::MIN_POSITIVE)
    };
    let quotient = |even: f64, odd: f64| (even - odd) / (even + odd);
    let s = quotient(size + cos_squared, 2.0 * a * cos_incident);
    let squares = cos_squared * size + sin_squared * sin_squared;
    let p = if cos_incident > 0.0 {
        s * quotient(squares, 2.0 * a * cos_incident * sin_squared)
    } else {
        s
    };
    Polarised { s, p }
}

/// Hemispherical reflectance 2 ∫₀¹ R(µ) µ dµ of a dielectric: what it reflects of light that comes evenly from all of
/// one side.
///
/// For η > 1 Walsh's closed form (S. Q. Duntley, J. Opt. Soc. Am. 32 (1942) 61), else from its reverse:
/// (1 − R(η)) = η² (1 − R(1/η)). It loses digits towards η = 1: the error is below 1e-11 where |η − 1| > 1e-3.
pub fn dielectric_average(eta: f64) -> f64 {
    if eta == 1.0 {
        return 0.0;
    }
    if eta < 1.0 {
        return 1.0 - eta * eta * (1.0 - dielectric_average(1.0 / eta));
    }
    let n = eta;
    let (n2, n3, n4) = (n * n, n * n * n, n * n * n * n);
    let (plus, minus) = (n2 + 1.0, n4 - 1.0);
    let rational = 0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0))
        - 2.0 * n3 * (n2 + 2.0 * n - 1.0) / (plus * minus);
    let logarithms = n2 * (n2 - 1.0) * (n2 - 1.0) / (plus * plus * plus)
        * libm::log((n - 1.0) / (n + 1.0))
        + 8.0 * n4 * (n4 + 1.0) / (plus * minus * minus) * libm::log(n);
    (rational + logarithms).max(0.0)
}

/// Hemispherical reflectance 2 ∫₀¹ R(µ) µ dµ of a conductor, by Gauss's rule of order 16 in √µ.
pub fn conductor_average(eta: f64, kappa: f64) -> f64 {
    let integrand = |root: f64| {
        let cos = root * root;
        4.0 * conductor(cos, eta, kappa).mean() * cos * root
    };
    gauss::integrate(gauss::MAX_ORDER, [0.0, 1.0], integrand)
}

/// Schlick's approximation R₀ + (1 − R₀)(1 − cosθ)⁵, as glTF defines it (C. Schlick, Computer Graphics Forum 13 (1994)
/// 233, eq. 24). Up to a third off for real materials: use it only where a format asks for it.
pub fn schlick(cos_incident: f64, normal_reflectance: f64) -> f64 {
    normal_reflectance + (1.0 - normal_reflectance) * schlick_rise(cos_incident)
}

/// (1 − cosθ)⁵: how far Schlick's reflectance has risen from that along the normal to that at the horizon.
pub(super) fn schlick_rise(cos_incident: f64) -> f64 {
    let c = 1.0 - cos_incident.clamp(0.0, 1.0);
    (c * c) * (c * c) * c
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::tests::cases::{assert_case, cases_of};
    use crate::geometry::Vector;
    use proptest::prelude::*;

    fn cosine_of(degrees: f64) -> f64 {
        libm::cos(degrees.to_radians())
    }

    #[test]
    fn dielectrics_agree_with_the_reference_cases() {
        for case in cases_of("fresnel_dielectric", 23) {
            let r = dielectric(
                cosine_of(case.number("theta_i_deg")),
                case.number("eta_t_over_eta_i"),
            );
            for (name, found) in [
                ("Rs", r.s),
                ("Rp", r.p),
                ("R", r.mean()),
                ("T", 1.0 - r.mean()),
            ] {
                assert_case(&case, name, found, 1e-12);
            }
        }
    }

    #[test]
    fn conductors_agree_with_the_reference_cases() {
        for case in cases_of("fresnel_conductor", 21) {
            let cos = cosine_of(case.number("theta_i_deg"));
            let r = conductor(cos, case.number("eta"), case.number("k"));
            for (name, found) in [("Rs", r.s), ("Rp", r.p), ("R", r.mean())] {
                assert_case(&case, name, found, 1e-12);
            }
        }
    }

    #[test]
    fn averages_schlick_and_refraction_agree_with_the_reference_cases() {
        for case in cases_of("fresnel_hemispherical", 3) {
            let eta = case.number("eta_t_over_eta_i");
            assert_case(&case, "value", dielectric_average(eta), 1e-12);
        }
        for case in cases_of("schlick", 3) {
            let cos = cosine_of(case.number("theta_deg"));
            assert_case(&case, "value", schlick(cos, case.number("F0")), 1e-12);
        }
        for case in cases_of("refraction", 2) {
            let eta = case.number("eta");
            let cos = refracted_cosine(cosine_of(case.number("theta_i_deg")), eta).unwrap();
            assert_case(&case, "theta_t_deg", libm::acos(cos).to_degrees(), 1e-12);
            assert_case(&case, "radiance_scale", eta * eta, 1e-12);
            let critical = case.expected("critical_angle_deg");
            assert!(refracted_cosine(cosine_of(critical - 1e-9), 1.0 / eta).is_some());
            assert!(refracted_cosine(cosine_of(critical + 1e-9), 1.0 / eta).is_none());
            assert!(dielectric(cosine_of(case.expected("brewster_deg")), eta).p < 1e-30);
        }
    }

    /// Mitsuba 3's own tests state these amplitudes in single precision.
    #[test]
    fn amplitudes_are_those_that_mitsuba_states() {
        let (s, p) = dielectric_amplitudes(cosine_of(45.0), 1.5).unwrap();
        assert!((s + 0.303_337_045_290_423_5).abs() < 1e-15);
        assert!((p - 0.092_013_363_045_524_42).abs() < 1e-15);
        let (s, p) = dielectric_amplitudes(cosine_of(10.0), 1.0 / 1.5).unwrap();
        assert!((s - 0.209_494_319_638_520_14).abs() < 1e-12);
        assert!((p + 0.190_467_971_977_794_05).abs() < 1e-12);
        let brewster = cosine_of(libm::atan(1.5).to_degrees());
        let (s, _) = dielectric_amplitudes(brewster, 1.5).unwrap();
        assert!((s + 0.384_615_093_959_894_7).abs() < 5e-7);
    }

    /// 16 panels of order 16 take the kinks of R to 1e-9 and better.
    #[test]
    fn averages_are_the_integrals_of_their_reflectances() {
        let average = |f: &dyn Fn(f64) -> f64| -> f64 {
            let panel = |k: i32| [f64::from(k) / 64.0, f64::from(k + 1) / 64.0];
            let integrand = |root: f64| 4.0 * f(root * root) * root * root * root;
            (0..64)
                .map(|k| gauss::integrate(16, panel(k), integrand))
                .sum()
        };
        for eta in [1.01, 1.33, 1.5, 2.4, 5.0] {
            let found = dielectric_average(eta);
            assert!((found - average(&|cos| dielectric(cos, eta).mean())).abs() < 1e-9);
        }
        for (eta, kappa) in [(0.155, 3.6), (3.1, 3.3), (0.05, 4.2), (1.1, 0.01)] {
            let found = conductor_average(eta, kappa);
            let expected = average(&|cos| conductor(cos, eta, kappa).mean());
            assert!(
                (found - expected).abs() < 1e-6,
                "{eta} {kappa}: {found} {expected}"
            );
        }
    }

    proptest! {
        #[test]
        fn reflectances_lie_between_0_and_1(cos in 0.0..=1.0_f64, eta in 0.1..5.0_f64, kappa in 0.0..10.0_f64) {
            for r in [dielectric(cos, eta), conductor(cos, eta, kappa)] {
                prop_assert!((0.0..=1.0 + 1e-14).contains(&r.s), "{r:?}");
                prop_assert!((0.0..=1.0 + 1e-14).contains(&r.p), "{r:?}");
            }
        }

        #[test]
        fn without_extinction_a_conductor_is_a_dielectric(cos in 0.0..=1.0_f64, eta in 0.2..5.0_f64) {
            let (a, b) = (conductor(cos, eta, 0.0), dielectric(cos, eta));
            prop_assert!((a.s - b.s).abs() < 1e-7 && (a.p - b.p).abs() < 1e-7, "{a:?} {b:?}");
        }

        #[test]
        fn the_way_back_reflects_as_much(cos in 0.001..=1.0_f64, eta in 1.0..3.0_f64) {
            let inside = refracted_cosine(cos, eta).unwrap();
            let outside = refracted_cosine(inside, 1.0 / eta).unwrap();
            // Close to the horizon the rounding of one cosine shows in the other: cos dcos = η² cos_t dcos_t.
            prop_assert!((outside - cos).abs() < 8.0 * f64::EPSILON * eta * eta / cos);
            let back = dielectric(inside, 1.0 / eta);
            prop_assert!((back.mean() - dielectric(outside, eta).mean()).abs() < 1e-12);
        }

        #[test]
        fn refraction_keeps_the_tangential_part_over_eta(x in -0.6..0.6_f64, y in -0.6..0.6_f64, eta in 0.9..3.0_f64) {
            let incident = Direction::new(Vector::new(x, y, (1.0 - x * x - y * y).sqrt())).unwrap();
            if let Some(refracted) = refract(incident, Direction::Z, eta) {
                prop_assert!((refracted.x() * eta + incident.x()).abs() < 1e-14);
                prop_assert!((refracted.y() * eta + incident.y()).abs() < 1e-14);
                prop_assert!(refracted.z() <= 0.0);
            }
        }
    }
}
