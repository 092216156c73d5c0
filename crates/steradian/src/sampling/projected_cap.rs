//! Directions towards a sphere, in proportion to the cosine: uniform in projected solid angle.
//!
//! From a receiver with the normal z a sphere in the direction (ρ, 0, a) fills the cap of directions within α of it, sinα = R/d. Seen along
//! the normal, on the unit disc, the cap's edge is an ellipse around (ρ cosα, 0) with the half axes a sinα and sinα. A cap above
//! the horizon (a ≥ sinα) is that ellipse. One that the horizon cuts reaches, in the line of each y, from
//!
//! x = ρ cosα − a √(sin²α − y²)  to  √(1 − y²) for |y| ≤ y_t,  to  ρ cosα + a √(sin²α − y²) beyond
//!
//! where y_t² = (sin²α − a²)/ρ² is where the edge meets the horizon. The area up to y has a closed form of arc sines, which
//! Newton's method inverts within a bracket.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Ω | projected solid angle ∫ cosθ dω = πF | sr |
//! | R, d | radius of the sphere and distance of its centre | m |
//! | a, ρ | cosine and sine of the centre's angle from the normal | – |
//!
//! Density: cosθ/Ω per steradian. A sample of radiance L has the weight LΩ in irradiance: the irradiance by an unoccluded sphere is
//! estimated without variance, and no weight exceeds L·Ω ≤ πL.
//!
//! Source: C. Peters & C. Dachsbacher, *Sampling projected spherical caps in real time* (I3D 2019), §3, for the regions of the disc;
//! the cut caps are mapped by lines of constant y here.
//!
//! ```
//! use steradian::geometry::Vector;
//! use steradian::sampling::projected_cap::ProjectedCap;
//! // Overhead: Ω = π sin²α.
//! let cap = ProjectedCap::new(Vector::new(0.0, 0.0, 4.0), 1.0).unwrap();
//! assert!((cap.projected_solid_angle().to_steradians() - std::f64::consts::PI / 16.0).abs() < 1e-16);
//! ```

use std::f64::consts::{PI, TAU};

use crate::geometry::{Direction, Vector};
use crate::quantity::ProjectedSolidAngle;

/// A sphere as seen from outside by a receiver at the origin whose normal is z.
#[derive(Copy, Clone, Debug)]
pub struct ProjectedCap {
    /// Azimuth of the centre, in the disc.
    azimuth: [f64; 2],
    /// ρ cosα.
    middle: f64,
    /// a.
    height: f64,
    /// sinα.
    sine: f64,
    /// y_t; none if the horizon does not cut the cap.
    cut: Option<f64>,
    area: f64,
}

impl ProjectedCap {
    /// The sphere around `center`, in the receiver's frame; `None` from inside, and if nothing of it is above the horizon.
    pub fn new(center: Vector, radius: f64) -> Option<Self> {
        let distance = center.length();
        if !(radius > 0.0 && distance > radius) {
            return None;
        }
        let (sine, height) = (radius / distance, center.z / distance);
        let cosine = ((distance - radius) * (distance + radius)).sqrt() / distance;
        let across = libm::hypot(center.x, center.y);
        let azimuth = if across > 0.0 {
            [center.x / across, center.y / across]
        } else {
            [1.0, 0.0]
        };
        let rho = across / distance;
        let cut =
            (height < sine).then(|| ((sine - height) * (sine + height)).max(0.0).sqrt() / rho);
        let mut cap = Self {
            azimuth,
            middle: rho * cosine,
            height,
            sine,
            cut,
            area: PI * sine * sine * height,
        };
        if let Some(cut) = cut {
            cap.area = 2.0 * cap.area_up_to(cap.last_line(cut), cut);
        }
        (height > -sine && cap.area > 0.0).then_some(cap)
    }

    /// Ω.
    pub fn projected_solid_angle(&self) -> ProjectedSolidAngle {
        ProjectedSolidAngle::from_steradians(self.area)
    }

    /// A direction of density cosθ/Ω, in the receiver's frame.
    pub fn sample(&self, [u, v]: [f64; 2]) -> Direction {
        let [x, y] = match self.cut {
            None => {
                let (sin, cos) = libm::sincos(TAU * v);
                let radius = u.sqrt() * self.sine;
                [self.middle + self.height * radius * cos, radius * sin]
            }
            Some(cut) => {
                let y = self.line(2.0 * u - 1.0, cut);
                let [left, right] = self.ends(y, cut);
                [left + v * (right - left), y]
            }
        };
        let z = (1.0 - (x * x + y * y)).max(0.0).sqrt();
        let [c, s] = self.azimuth;
        let direction = Vector::new(c * x - s * y, s * x + c * y, z);
        Direction::from_unit(direction / direction.length())
    }

    /// The greatest y of the region.
    fn last_line(&self, cut: f64) -> f64 {
        if self.height > 0.0 {
            self.sine
        } else {
            cut.min(self.sine)
        }
    }

    /// Where the line of y begins and ends.
    fn ends(&self, y: f64, cut: f64) -> [f64; 2] {
        let half = self.height * ((self.sine - y) * (self.sine + y)).max(0.0).sqrt();
        let right = if y.abs() <= cut {
            ((1.0 - y) * (1.0 + y)).max(0.0).sqrt()
        } else {
            self.middle + half
        };
        [self.middle - half, right]
    }

    /// Area between the lines of 0 and y ≥ 0.
    fn area_up_to(&self, y: f64, cut: f64) -> f64 {
        let near = y.min(cut);
        let to_horizon = under_circle(near, 1.0) - self.middle * near;
        let beyond = if y > cut {
            under_circle(y, self.sine) - under_circle(cut, self.sine)
        } else {
            0.0
        };
        to_horizon + self.height * (under_circle(y.min(self.sine), self.sine) + beyond)
    }

    /// The line up to which, from 0, a part |w| of either half lies; on the side of the sign of w.
    fn line(&self, w: f64, cut: f64) -> f64 {
        let wanted = w.abs() * 0.5 * self.area;
        let [mut low, mut high] = [0.0, self.last_line(cut)];
        let scale = high;
        let mut y = w.abs() * high;
        for _ in 0..MOST_STEPS {
            let excess = self.area_up_to(y, cut) - wanted;
            (low, high) = if excess < 0.0 { (y, high) } else { (low, y) };
            let [left, right] = self.ends(y, cut);
            let next = y - excess / (right - left);
            let next = if next > low && next < high {
                next
            } else {
                0.5 * (low + high)
            };
            let done = (next - y).abs() < ACCURACY * scale;
            y = next;
            if done {
                break;
            }
        }
        y.copysign(w)
    }
}

/// Steps of the iteration; half of a bracket each would do.
const MOST_STEPS: u32 = 60;
/// Length of the last step of y, relative to its range. The error that it leaves is of the order of its square.
const ACCURACY: f64 = 1e-6;

/// ∫₀ʸ √(r² − t²) dt.
fn under_circle(y: f64, r: f64) -> f64 {
    let height = ((r - y) * (r + y)).max(0.0).sqrt();
    0.5 * (y * height + r * r * libm::atan2(y, height))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::any_vector;
    use crate::geometry::{Direction, Point, configuration_factor};
    use crate::quantity::Length;
    use crate::sampling::testing::{assert_uniform, from_projected, independent, to_projected};
    use proptest::prelude::*;

    fn expected(center: Vector, radius: f64) -> f64 {
        let center = Point::ORIGIN + center;
        PI * configuration_factor::of_sphere(
            Point::ORIGIN,
            Direction::Z,
            center,
            Length::from_metres(radius),
        )
    }

    /// Overhead, aside, touching the horizon, cut above and below its middle, nearly touched, tiny, and tiny at the horizon.
    #[test]
    fn samples_are_uniform_in_the_disc() {
        let spheres = [
            ([0.0, 0.0, 2.0], 1.0),
            ([1.0, 2.0, 1.5], 1.0),
            ([-3.0, 0.0, 1.0], 1.0),
            ([1.0, -2.0, 0.3], 1.0),
            ([0.0, 2.0, -0.6], 1.0),
            ([0.1, 0.2, 0.98], 1.0),
            ([0.8, 0.0, 0.6], 1e-6),
            ([3.0, 4.0, 1e-7], 1e-5),
        ];
        for (number, (center, radius)) in spheres.into_iter().enumerate() {
            let center = Vector::from(center);
            let cap = ProjectedCap::new(center, radius).unwrap();
            let samples = independent(number as u64, 65_536).map(|u| cap.sample(u).to_vector());
            let hit = |p| {
                let d = from_projected(p);
                d.dot(center) > 0.0 && d.cross(center).length() < radius
            };
            assert_uniform(samples.map(to_projected), hit);
            let off = (cap.area - expected(center, radius)).abs();
            assert!(off < 1e-15 + 1e-9 * cap.area, "{number}: {off}");
        }
    }

    #[test]
    fn nothing_is_sampled_from_inside_or_below() {
        let cap = |z: f64| ProjectedCap::new(Vector::new(0.0, 0.0, z), 1.0);
        assert!(cap(0.5).is_none() && cap(-1.5).is_none() && cap(1.5).is_some());
        assert!(ProjectedCap::new(Vector::ZERO, 0.0).is_none());
    }

    proptest! {
        #[test]
        fn the_area_is_that_of_the_closed_form(center in any_vector(3.0), radius in 0.01..3.0_f64) {
            prop_assume!(center.length() > 1.001 * radius);
            let area = ProjectedCap::new(center, radius).map_or(0.0, |cap| cap.area);
            prop_assert!((area - expected(center, radius)).abs() < 1e-13, "{area} {}", expected(center, radius));
        }

        #[test]
        fn samples_meet_the_sphere_above_the_horizon(
            center in any_vector(3.0), radius in 0.01..3.0_f64, u in 0.0..1.0_f64, v in 0.0..1.0_f64,
        ) {
            if let Some(cap) = ProjectedCap::new(center, radius) {
                let d = cap.sample([u, v]).to_vector();
                prop_assert!(d.z >= 0.0 && d.dot(center) > 0.0);
                prop_assert!(d.cross(center).length() < radius * (1.0 + 1e-6) + 1e-7);
            }
        }
    }
}
