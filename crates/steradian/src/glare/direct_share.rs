//! Where the light of evenly spread luminaires goes first: to the plane below, the walls or the ceiling.
//!
//! Of luminaires that are spread evenly over a rectangle X × Y, the light of intensity I(d) meets the plane at the depth H below inside the
//! same rectangle if the luminaire is not too near to the wall that it shines at:
//!
//! Φ_plane = ∫ I(d) (1 − |Δx|/X) (1 − |Δy|/Y) dω ,  (Δx, Δy) = H tanγ (cosC, sinC)
//!
//! with factors not below 0. What else goes down meets the walls, what goes up the ceiling.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::geometry::Direction;
use crate::light::FarField;

/// Steps of a quarter turn of γ, and of a turn of C. The midpoint rule's error is some (π/360)²/24 · I″/I: 10⁻⁴ of beams 10° wide.
const STEPS: [usize; 2] = [180, 144];

/// The lower half of a luminaire's light, in small cones.
pub(super) struct DirectShare {
    cones: Vec<Cone>,
    down: f64,
    up: f64,
}

/// Light of nearly one direction.
struct Cone {
    /// Where it meets a plane at unit depth: |x| along C0, |y| along C90.
    offset: [f64; 2],
    flux: f64,
}

/// Flux by what it meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FirstFlux {
    pub plane: f64,
    pub walls: f64,
    pub ceiling: f64,
}

impl DirectShare {
    /// The cones' fluxes are scaled so that all together have the flux of the table, which is exact.
    pub(super) fn new(far_field: &FarField) -> Self {
        let mut cones = half(far_field, -1.0);
        let flux_of = |cones: &[Cone]| cones.iter().map(|cone| cone.flux).sum::<f64>();
        let [down, up] = [flux_of(&cones), flux_of(&half(far_field, 1.0))];
        let scale = match down + up > 0.0 {
            true => far_field.flux() / (down + up),
            false => 0.0,
        };
        for cone in &mut cones {
            cone.flux *= scale;
        }
        Self {
            cones,
            down: scale * down,
            up: scale * up,
        }
    }

    /// Of one luminaire in a room of this extent along C0 and C90, in depths of the plane below it.
    pub(super) fn in_room(&self, extent: [f64; 2]) -> FirstFlux {
        let share = |offset: f64, extent: f64| (1.0 - offset / extent).max(0.0);
        let met = |cone: &Cone| {
            cone.flux * share(cone.offset[0], extent[0]) * share(cone.offset[1], extent[1])
        };
        let plane = self.cones.iter().map(met).sum();
        FirstFlux {
            plane,
            walls: self.down - plane,
            ceiling: self.up,
        }
    }
}

/// The light to one side of the horizontal, whose sign along z is `side`.
fn half(far_field: &FarField, side: f64) -> Vec<Cone> {
    let [gammas, planes] = STEPS;
    let gamma = |step: f64| FRAC_PI_2 * step / gammas as f64;
    let mut cones = Vec::with_capacity(gammas * planes);
    for row in 0..gammas {
        let row = row as f64;
        let bounds = [row, row + 1.0].map(|step| libm::cos(gamma(step)));
        let solid_angle = (bounds[0] - bounds[1]) * TAU / planes as f64;
        let (sin, cos) = libm::sincos(gamma(row + 0.5));
        for column in 0..planes {
            let (sin_c, cos_c) = libm::sincos(TAU * (column as f64 + 0.5) / planes as f64);
            let direction = Direction::from_unit([sin * cos_c, sin * sin_c, side * cos].into());
            cones.push(Cone {
                offset: [cos_c, sin_c].map(|part| sin / cos * part.abs()),
                flux: far_field.intensity(direction) * solid_angle,
            });
        }
    }
    cones
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::form_factor::between_parallel_rectangles;
    use crate::light::Planes;
    use crate::quantity::Length;

    /// I = cosγ: evenly spread, luminaires are a Lambertian ceiling, whose share is the form factor to the plane. The table of
    /// 1° is off by (π/180)²/8 = 4e-5.
    #[test]
    fn lambertian_luminaires_are_a_lambertian_ceiling() {
        let polars: Vec<f64> = (0..=90).map(f64::from).collect();
        let values: Vec<f64> = polars
            .iter()
            .map(|polar| libm::cos(polar.to_radians()))
            .collect();
        let twice = [values.clone(), values].concat();
        let lamp = FarField::new(Planes::C, &[0.0, 360.0], &polars, &twice).unwrap();
        let share = DirectShare::new(&lamp);
        for [x, y] in [[2.0, 2.0], [2.0, 12.0], [8.0, 4.0]] {
            let found = share.in_room([x, y]);
            let sides = [x, y].map(|side| [Length::ZERO, Length::from_metres(side)]);
            let expected = between_parallel_rectangles(sides, sides, Length::from_metres(1.0));
            let part = found.plane / lamp.flux();
            assert!((part - expected.unwrap()).abs() < 2e-4, "{part}");
            assert!(found.ceiling < 2e-4 * lamp.flux());
        }
    }

    /// A narrow beam down meets the plane alone; light upwards the ceiling.
    #[test]
    fn beams_meet_what_they_are_aimed_at() {
        let lamp = FarField::new(
            Planes::C,
            &[0.0, 360.0],
            &[0.0, 5.0, 175.0, 180.0],
            &[100.0, 0.0, 0.0, 50.0, 100.0, 0.0, 0.0, 50.0],
        );
        let found = DirectShare::new(&lamp.unwrap()).in_room([8.0, 8.0]);
        assert!(found.walls < 0.02 * found.plane, "{found:?}");
        assert!((found.ceiling / (found.plane + found.walls) - 0.5).abs() < 1e-12);
    }
}
