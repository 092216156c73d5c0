//! Coaxial discs.

use super::dimensions::{DimensionError, positive};
use crate::quantity::Length;

/// From a disc of the first radius to a parallel one of the second, with a common axis, that face each other at this distance.
///
/// With R = r/h, S = 1 + (1 + R₂²)/R₁²: F₁₂ = ½ (S − √(S² − 4 (r₂/r₁)²)) (Howell's catalogue, C-41; Z. Yamauti, Res. Electrotech.
/// Lab. Tokyo 148, 1924), written without its cancellation.
///
/// # Errors
/// If a length is not positive.
///
/// ```
/// use steradian::geometry::form_factor;
/// use steradian::quantity::Length;
/// let one = Length::from_metres(1.0);
/// let found = form_factor::between_coaxial_discs([one, one], one)?;
/// assert!((found - (3.0 - 5.0_f64.sqrt()) / 2.0).abs() < 1e-15);
/// # Ok::<(), form_factor::DimensionError>(())
/// ```
pub fn between_coaxial_discs(radii: [Length; 2], distance: Length) -> Result<f64, DimensionError> {
    let [from, to] = [
        positive("first radius", radii[0])?,
        positive("second radius", radii[1])?,
    ];
    let h = positive("distance", distance)?;
    // S² − 4 (r₂/r₁)² = ((r₁ − r₂)² + h²) ((r₁ + r₂)² + h²)/r₁⁴
    let near = libm::hypot(from - to, h);
    let far = libm::hypot(from + to, h);
    let sum = from * from + to * to + h * h + near * far;
    Ok(2.0 * to * to / sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::close;
    use crate::geometry::{Direction, Point, configuration_factor, gauss};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_disc_is_the_mean_of_its_elements(r1 in 0.1..3.0_f64, r2 in 0.1..3.0_f64, h in 1.0..4.0_f64) {
            let [from, to, distance] = [r1, r2, h].map(Length::from_metres);
            let element = |rho: f64| {
                let center = Point::new(0.0, 0.0, h);
                configuration_factor::of_disc(Point::new(rho, 0.0, 0.0), Direction::Z, center, Direction::Z, to)
            };
            let panel = |k: usize| {
                let ends = [k, k + 1].map(|k| r1 * k as f64 / 8.0);
                gauss::integrate(12, ends, |rho| 2.0 * rho * element(rho))
            };
            let mean = (0..8).map(panel).sum::<f64>() / (r1 * r1);
            prop_assert!(close(between_coaxial_discs([from, to], distance).unwrap(), mean, 1e-14));
        }
    }

    #[test]
    fn tiny_and_touching_discs_and_none() {
        let disc = |r1, r2, h| {
            between_coaxial_discs([r1, r2].map(Length::from_metres), Length::from_metres(h))
        };
        assert!(close(disc(1e-9, 1e-9, 1.0).unwrap() / 1e-18, 1.0, 1e-15));
        assert!(close(disc(1.0, 2.0, 1e-12).unwrap(), 1.0, 1e-15));
        assert!(disc(0.0, 1.0, 1.0).is_err() && disc(1.0, 1.0, f64::INFINITY).is_err());
    }
}
