//! Rooms of UGR tables, and the light on their walls that comes by reflection.
//!
//! Luminaires in a regular array light a box between their own height and that of the eye, H below. Its ceiling, walls and plane are
//! taken as one even, Lambertian surface each, of reflectance ρ_i and area A_i, so that
//!
//! E_i = Φ_i/A_i + Σ_j F_ij ρ_j E_j ,  L_b = (E_walls − Φ_walls/A_walls)/π
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Φ_i | flux that reaches surface i first | lm |
//! | F_ij | form factor, in closed form | – |
//! | E_i | illuminance | lx |
//! | L_b | luminance of the background: of a wall that reflects all | cd/m² |
//!
//! Source: CIE 190:2010, §4 (method), whose transfer factors these form factors give to all its digits.

use super::direct_share::FirstFlux;
use crate::exchange::radiosity::{self, Boundary, GreySurface, Surroundings};
use crate::exchange::{Entry, Row, Uncertain};
use crate::geometry::form_factor::between_parallel_rectangles;
use crate::quantity::{Length, Luminance};

/// A room by its sides over H.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// Across the line of sight.
    pub x: f64,
    /// Along the line of sight.
    pub y: f64,
}

impl Room {
    /// The rooms of the standard table, in its order.
    pub const STANDARD: [Self; 19] = {
        let sides = [
            [2, 2],
            [2, 3],
            [2, 4],
            [2, 6],
            [2, 8],
            [2, 12],
            [4, 2],
            [4, 3],
            [4, 4],
            [4, 6],
            [4, 8],
            [4, 12],
            [8, 4],
            [8, 6],
            [8, 8],
            [8, 12],
            [12, 4],
            [12, 6],
            [12, 8],
        ];
        let mut rooms = [Self { x: 0.0, y: 0.0 }; 19];
        let mut index = 0;
        while index < rooms.len() {
            let [x, y] = sides[index];
            rooms[index] = Self {
                x: x as f64,
                y: y as f64,
            };
            index += 1;
        }
        rooms
    };
}

/// What surfaces of a room reflect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflectances {
    /// Of the plane of the luminaires.
    pub ceiling: f64,
    /// Of the walls between the luminaires and the eye.
    pub walls: f64,
    /// Of the plane at the height of the eye.
    pub plane: f64,
}

impl Reflectances {
    /// The columns of the standard table, in its order.
    pub const STANDARD: [Self; 5] = [
        Self::new(0.7, 0.5),
        Self::new(0.7, 0.3),
        Self::new(0.5, 0.5),
        Self::new(0.5, 0.3),
        Self::new(0.3, 0.3),
    ];

    const fn new(ceiling: f64, walls: f64) -> Self {
        Self {
            ceiling,
            walls,
            plane: 0.2,
        }
    }
}

/// The room as a cavity of three surfaces: plane, walls, ceiling.
pub(super) struct Cavity {
    rows: [Row; 3],
    areas: [f64; 3],
}

impl Cavity {
    /// Of sides and height in metres, all positive.
    pub(super) fn new([x, y]: [f64; 2], height: f64) -> Self {
        let sides = [x, y].map(|side| [Length::ZERO, Length::from_metres(side)]);
        let across = between_parallel_rectangles(sides, sides, Length::from_metres(height));
        let across = across.expect("sides and height are positive");
        let (plane, walls) = (x * y, 2.0 * (x + y) * height);
        let back = (1.0 - across) * plane / walls;
        let row = |from: usize, factors: [f64; 3]| Row {
            from,
            entries: (0..3)
                .map(|to| Entry::exact(to, factors[to as usize]))
                .collect(),
            sum: Uncertain::exact(1.0),
            rest: None,
            samples: 0,
            converged: true,
        };
        Self {
            rows: [
                row(0, [0.0, 1.0 - across, across]),
                row(1, [back, 1.0 - 2.0 * back, back]),
                row(2, [across, 1.0 - across, 0.0]),
            ],
            areas: [plane, walls, plane],
        }
    }

    /// L_b from the flux of all luminaires.
    pub(super) fn background(&self, first: FirstFlux, reflectances: Reflectances) -> Luminance {
        let fluxes = [first.plane, first.walls, first.ceiling];
        let reflectances = [reflectances.plane, reflectances.walls, reflectances.ceiling];
        let surface = |index: usize| GreySurface {
            emissivity: 1.0 - reflectances[index],
            boundary: Boundary::Exitance(reflectances[index] * fluxes[index] / self.areas[index]),
        };
        let surroundings = Surroundings {
            exitance: None,
            reciprocal: true,
        };
        let surfaces = [0, 1, 2].map(surface);
        let found = radiosity::exchange(&self.rows, &self.areas, &surfaces, surroundings);
        // What arrives from the other surfaces, without what comes from the luminaires.
        let indirect = found.expect("surfaces absorb").surfaces[1].irradiance.value;
        Luminance::from_candelas_per_square_metre(indirect / std::f64::consts::PI)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Transfer factors of CIE 190:2010, table 5: A_walls E_walls of unit flux on the plane, walls and ceiling, without the direct part. It has
    /// three digits.
    #[test]
    fn transfer_factors_are_those_of_the_standard() {
        let expected = [
            ([2.0, 2.0], 0, [0.220, 0.422, 0.646]),
            ([2.0, 2.0], 4, [0.157, 0.181, 0.227]),
            ([4.0, 8.0], 1, [0.106, 0.117, 0.283]),
            ([12.0, 8.0], 2, [0.061, 0.117, 0.125]),
        ];
        for (sides, column, factors) in expected {
            let cavity = Cavity::new(sides, 1.0);
            for (surface, factor) in factors.into_iter().enumerate() {
                let mut flux = [0.0; 3];
                flux[surface] = 1.0;
                let [plane, walls, ceiling] = flux;
                let first = FirstFlux {
                    plane,
                    walls,
                    ceiling,
                };
                let found = cavity.background(first, Reflectances::STANDARD[column]);
                let found =
                    found.to_candelas_per_square_metre() * std::f64::consts::PI * cavity.areas[1];
                assert!(
                    (found - factor).abs() < 6e-4,
                    "{sides:?} {column} {surface}: {found}"
                );
            }
        }
    }

    /// Surfaces that reflect nothing give no background.
    #[test]
    fn black_rooms_have_no_background() {
        let black = Reflectances {
            ceiling: 0.0,
            walls: 0.0,
            plane: 0.0,
        };
        let first = FirstFlux {
            plane: 1.0,
            walls: 1.0,
            ceiling: 1.0,
        };
        let found = Cavity::new([4.0, 8.0], 2.0).background(first, black);
        assert_eq!(found.to_candelas_per_square_metre(), 0.0);
    }
}
