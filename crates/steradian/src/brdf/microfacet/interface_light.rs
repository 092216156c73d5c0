//! What the facets of a rough interface reflect and transmit at the first meeting.
//!
//! With c = d_e·m and η the far index over the near one, a facet transmits 1 − F(c) where c² ≥ c₀² = 1 − η² (any c > 0, if
//! η ≥ 1). In the coordinates of [`quadrature`](super::quadrature) c = cosθ_e (1 − r t cosψ)/√(1 + r²), so that on every azimuth the
//! slopes that transmit form one interval, between roots of a quadratic; where d_e lies beyond the critical angle only azimuths
//! with −sinh x ≥ √(c₀² − cos²θ_e)/cosθ_e have one. Slopes at which the light that is let through stays above the surface are cut
//! off at borders found by halving. What is reflected is all light that a white facet would send back, less what is
//! transmitted.

use std::f64::consts::FRAC_PI_2;

use super::Facets;
use super::quadrature::{Fan, Ray};
use super::rough_conductor::mirrored_light;
use crate::brdf::fresnel::{dielectric, refract};
use crate::geometry::Direction;

/// One facet's reflectance and transmittance for light along `wo`, which lies above the surface.
pub(super) fn first_shares(facets: Facets, wo: Direction, eta: f64, fineness: usize) -> [f64; 2] {
    weighed_shares(facets, wo, eta, fineness, |_| 1.0)
}

/// The same, with the light of every direction multiplied by `f`.
pub(super) fn weighed_shares(
    facets: Facets,
    wo: Direction,
    eta: f64,
    fineness: usize,
    f: impl Fn(Direction) -> f64,
) -> [f64; 2] {
    let light = Light {
        facets,
        wo,
        eta,
        critical: (1.0 - eta * eta).max(0.0),
    };
    let fan = Fan::new(facets, wo, fineness);
    let last = light.last_place(&fan);
    let [white] = mirrored_light(facets, wo, fineness, |_| [1.0], &f);
    let both = |ray: &Ray| {
        let ([low, high], [_, border]) = (light.transmitting(ray)?, ray.mirroring()?);
        (low < border).then_some([low, high.min(border)])
    };
    let [kept] = fan.integrate_below(last, both, |m| [light.not_reflected(m, &f)]);
    let [transmitted] = fan.integrate_below(
        last,
        |ray| light.leaving(ray),
        |m| [light.transmitted(m, &f)],
    );
    [white - kept, transmitted]
}

/// The last place from `inside` towards `end` where it is so, by halving.
fn border(mut inside: f64, end: f64, holds: impl Fn(f64) -> bool) -> f64 {
    if holds(end) {
        return end;
    }
    let mut outside = end;
    for _ in 0..24 {
        let middle = 0.5 * (inside + outside);
        if holds(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}

struct Light {
    facets: Facets,
    wo: Direction,
    eta: f64,
    /// c₀².
    critical: f64,
}

impl Light {
    fn sine(&self) -> f64 {
        (self.wo.x() * self.wo.x() + self.wo.y() * self.wo.y()).sqrt()
    }

    /// The last v at which a facet transmits.
    fn last_place(&self, fan: &Fan) -> f64 {
        let cos = self.wo.z();
        if cos * cos >= self.critical {
            return FRAC_PI_2;
        }
        fan.place_of(-(self.critical - cos * cos).sqrt() / cos)
    }

    /// The slopes r with c ≥ c₀.
    fn transmitting(&self, ray: &Ray) -> Option<[f64; 2]> {
        let (cos, along) = (self.wo.z(), self.sine() * ray.cos);
        if self.critical == 0.0 {
            let last = if along > 0.0 {
                cos / along
            } else {
                f64::INFINITY
            };
            return Some([0.0, last]);
        }
        let square = along * along - self.critical;
        let rest = cos * cos - self.critical;
        let discriminant = self.critical * (along * along + rest);
        if discriminant < 0.0 {
            return None;
        }
        let q = cos * along + discriminant.sqrt().copysign(along);
        let mut roots = [q / square, rest / q].map(|r| {
            let facing = r > 0.0 && cos > r * along;
            if facing { r } else { f64::INFINITY }
        });
        roots.sort_by(f64::total_cmp);
        match roots {
            [first, _] if rest >= 0.0 => Some([0.0, first]),
            [first, _] if first == f64::INFINITY => None,
            interval => Some(interval),
        }
    }

    /// Those of them that refract to below the surface.
    fn leaving(&self, ray: &Ray) -> Option<[f64; 2]> {
        let [low, high] = self.transmitting(ray)?;
        if self.eta >= 1.0 {
            return Some([low, high]);
        }
        let [low, high] = [low, high].map(libm::atan);
        let leaves = |slope| self.leaves(ray, libm::tan(slope));
        let places = [0.0, 1.0, 0.75, 0.5, 0.25].map(|part| low + part * (high - low));
        let inside = places.into_iter().find(|&slope| leaves(slope))?;
        Some([low, high].map(|end| libm::tan(border(inside, end, leaves))))
    }

    /// Whether (c − √(c² − c₀²)) m_z ≤ cosθ_e, the refracted direction's height times −η.
    fn leaves(&self, ray: &Ray, r: f64) -> bool {
        let (cos, along) = (self.wo.z(), self.sine() * ray.cos);
        if r > 1e12 {
            return true;
        }
        let length = (1.0 + r * r).sqrt();
        let c = (cos - r * along) / length;
        (c - (c * c - self.critical).max(0.0).sqrt()) / length <= cos
    }

    fn not_reflected(&self, m: Direction, f: impl Fn(Direction) -> f64) -> f64 {
        let mirrored = m.mirror(self.wo);
        if mirrored.z() <= 0.0 {
            return 0.0;
        }
        let cos = self.wo.dot(m).clamp(0.0, 1.0);
        let visible = self.facets.shadowing(self.wo, mirrored) * f(mirrored);
        (1.0 - dielectric(cos, self.eta).mean()) * visible
    }

    fn transmitted(&self, m: Direction, f: impl Fn(Direction) -> f64) -> f64 {
        let cos = self.wo.dot(m).clamp(0.0, 1.0);
        let refracted = refract(self.wo, m, self.eta).filter(|refracted| refracted.z() < 0.0);
        let visible = refracted.map_or(0.0, |wi| self.facets.masking(wi) * f(wi));
        (1.0 - dielectric(cos, self.eta).mean()) * self.facets.masking(self.wo) * visible
    }
}
