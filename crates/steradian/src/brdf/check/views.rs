//! The directions from which a model is looked at.

use std::f64::consts::FRAC_PI_2;

use crate::brdf::Brdf;
use crate::geometry::Direction;

/// Polar angles of views by chance, in degrees: from above, and close to the horizon.
const POLAR: [f64; 5] = [0.0, 30.0, 60.0, 80.0, 88.0];
/// An azimuth that no symmetry hides, in radians.
const AZIMUTH: f64 = 0.6;

/// A direction by its angles; below the surface beyond a right angle.
pub(super) fn polar(theta: f64, phi: f64) -> Direction {
    Direction::from_polar(libm::sin(theta), libm::cos(theta), phi)
}

/// Directions at 0, 30, 60, 80 and 88° to the normal, on the sides where the model scatters any light.
pub fn views(model: &Brdf) -> Vec<Direction> {
    let above = POLAR.map(|degrees| polar(degrees.to_radians(), AZIMUTH));
    on_sides_that_scatter(model, &above)
}

/// Every three degrees, up to a tenth of a degree above the horizon, in the planes of both axes and between them.
pub(super) fn dense_views(model: &Brdf) -> Vec<Direction> {
    let polar_angles = (0..30).map(|k| 3.0 * f64::from(k)).chain([89.0, 89.9]);
    let above: Vec<Direction> = polar_angles
        .flat_map(|degrees| [0.0, AZIMUTH, FRAC_PI_2].map(|phi| polar(degrees.to_radians(), phi)))
        .collect();
    on_sides_that_scatter(model, &above)
}

/// These directions, which are above, and the same below; sides that are black at the normal are left out.
fn on_sides_that_scatter(model: &Brdf, above: &[Direction]) -> Vec<Direction> {
    let scatters = |side: Direction| !(model.albedo(side) + model.transmittance(side)).is_zero();
    let upper = above.iter().copied().filter(|_| scatters(Direction::Z));
    let lower = above
        .iter()
        .map(|&view| -view)
        .filter(|_| scatters(-Direction::Z));
    upper.chain(lower).collect()
}
