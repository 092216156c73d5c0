//! The UGR table of a luminaire: its glare in rooms of 19 shapes and five reflectances, seen across and along its axis.
//!
//! Luminaires hang in a regular array, H/4 apart and H/8 from the walls, H = 2 m above the eye. The observer sits at the middle of a wall and looks at
//! the opposite one. A luminaire at R ahead and T aside has
//!
//! L = I/A_p ,  ω = A_p/(R² + T² + H²) ,  so that  L²ω = I²/(A_p (R² + T² + H²))
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | I | intensity of the luminaire towards the eye | cd |
//! | A_p | projected area of its luminous opening | m² |
//! | p | position index; luminaires at p > 16 or T/R > 3, beyond the standard's table of p, do not count | – |
//!
//! Crosswise, the C0 plane of each luminaire points to the observer's wall, and the axis of a linear luminaire, which is along C90, is
//! across the line of sight; endwise, the C90 plane points there. The standard supposes luminaires with two planes of symmetry. The background is that of
//! a cavity in which the luminaires are spread evenly. UGR is that of the flux of the luminaire itself.
//!
//! Source: CIE 117:1995, §4; CIE 190:2010, for spacing H/4 as catalogues have it. The standard finds the share of light that falls on the plane by
//! multipliers fitted to arrays of some kinds of luminaires; here it is integrated.

use std::f64::consts::FRAC_PI_2;

use super::direct_share::{DirectShare, FirstFlux};
use super::position_index::{GREATEST_POSITION_INDEX, Gaze};
use super::standard_room::{Cavity, Reflectances, Room};
use super::unified::rating;
use crate::geometry::{Direction, Vector};
use crate::light::FarField;
use crate::quantity::Area;

/// H, the height of the luminaires above the eye, in metres.
const HEIGHT: f64 = 2.0;
/// Spacing of the luminaires over H.
const SPACING: f64 = 0.25;
/// Greatest T/R.
const MOST_ASIDE: f64 = 3.0;

/// UGR by room, reflectances and line of sight.
#[derive(Clone, Debug, PartialEq)]
pub struct UgrTable {
    /// One for each of [`Room::STANDARD`].
    pub rows: Vec<UgrRow>,
}

/// A room of the table; `None` where no luminaire shines towards the observer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UgrRow {
    /// The room.
    pub room: Room,
    /// The line of sight across the luminaires' axis, for each of [`Reflectances::STANDARD`].
    pub crosswise: [Option<f64>; 5],
    /// The line of sight along the axis.
    pub endwise: [Option<f64>; 5],
}

/// Why there is no table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum UgrTableError {
    /// The luminance would be infinite.
    #[error("the luminaire has no luminous opening in some direction in which it shines")]
    NoOpening,
    /// Nothing shines.
    #[error("the luminaire has no light")]
    Dark,
}

impl UgrTable {
    /// From intensities in cd, and the area that the luminous opening shows in a direction away from the luminaire, with C0 = +x, C90 = +y and
    /// light downwards towards −z.
    ///
    /// # Errors
    /// If the luminaire has no light, or shines from an opening without area.
    pub fn new(
        far_field: &FarField,
        projected_area: impl Fn(Direction) -> Area,
    ) -> Result<Self, UgrTableError> {
        if far_field.flux() <= 0.0 {
            return Err(UgrTableError::Dark);
        }
        let luminaire = Luminaire {
            far_field,
            projected_area,
            share: DirectShare::new(far_field),
        };
        let rows = Room::STANDARD.iter().map(|room| luminaire.row(*room));
        rows.collect::<Result<_, _>>().map(|rows| Self { rows })
    }
}

struct Luminaire<'a, A> {
    far_field: &'a FarField,
    projected_area: A,
    share: DirectShare,
}

impl<A: Fn(Direction) -> Area> Luminaire<'_, A> {
    fn row(&self, room: Room) -> Result<UgrRow, UgrTableError> {
        let cavity = Cavity::new([room.x * HEIGHT, room.y * HEIGHT], HEIGHT);
        let count = (room.x / SPACING) * (room.y / SPACING);
        let column =
            |turn: f64, extent: [f64; 2]| {
                let sum = self.sum(room, turn)?;
                let first = self.share.in_room(extent).times(count);
                let backgrounds = Reflectances::STANDARD.map(|each| cavity.background(first, each));
                Ok(backgrounds
                    .map(|background| rating(background.to_candelas_per_square_metre(), sum)))
            };
        Ok(UgrRow {
            room,
            crosswise: column(0.0, [room.y, room.x])?,
            endwise: column(FRAC_PI_2, [room.x, room.y])?,
        })
    }

    /// Σ L²ω/p² of all luminaires whose plane C = `turn` points to the observer's wall.
    fn sum(&self, room: Room, turn: f64) -> Result<f64, UgrTableError> {
        let step = SPACING * HEIGHT;
        let (columns, rows) = ((room.x / SPACING) as usize, (room.y / SPACING) as usize);
        let mut sum = 0.0;
        for row in 0..rows {
            let ahead = (row as f64 + 0.5) * step;
            for column in 0..columns {
                let aside = (column as f64 + 0.5) * step - 0.5 * room.x * HEIGHT;
                sum += self.weight(ahead, aside, turn)?;
            }
        }
        Ok(sum)
    }

    /// L²ω/p² of the luminaire R ahead and T aside.
    fn weight(&self, ahead: f64, aside: f64, turn: f64) -> Result<f64, UgrTableError> {
        let Some(index) = index_in_table(ahead, aside) else {
            return Ok(0.0);
        };
        let (sin, cos) = libm::sincos(turn);
        let (x, y) = (ahead * cos - aside * sin, ahead * sin + aside * cos);
        let to_eye = Vector::new(x, y, -HEIGHT);
        let Ok(direction) = Direction::new(to_eye) else {
            return Ok(0.0);
        };
        let intensity = self.far_field.intensity(direction);
        let area = (self.projected_area)(direction).to_square_metres();
        match (intensity > 0.0, area > 0.0) {
            (false, _) => Ok(0.0),
            (true, false) => Err(UgrTableError::NoOpening),
            _ => Ok(intensity * intensity / (area * to_eye.length_squared() * index * index)),
        }
    }
}

/// p where the standard has it.
fn index_in_table(ahead: f64, aside: f64) -> Option<f64> {
    let gaze = Gaze::new(Direction::X, Direction::Z)?;
    let towards = Direction::new(Vector::new(ahead, aside, HEIGHT)).ok()?;
    let inside = aside.abs() <= MOST_ASIDE * ahead;
    let index = gaze.position_index(towards).filter(|_| inside);
    index.filter(|index| *index <= GREATEST_POSITION_INDEX)
}

impl FirstFlux {
    fn times(self, count: f64) -> Self {
        Self {
            plane: count * self.plane,
            walls: count * self.walls,
            ceiling: count * self.ceiling,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::Planes;

    fn lambertian(factor: f64) -> FarField {
        let polars: Vec<f64> = (0..=36).map(|step| 2.5 * f64::from(step)).collect();
        let values = polars
            .iter()
            .map(|polar| factor * libm::cos(polar.to_radians()));
        let values: Vec<f64> = values.collect();
        let twice = [values.clone(), values].concat();
        FarField::new(Planes::C, &[0.0, 360.0], &polars, &twice).unwrap()
    }

    fn panel(direction: Direction) -> Area {
        Area::from_square_metres(0.36 * direction.z().abs())
    }

    /// Twice the flux: four times L², twice L_b, 8 log₁₀ 2 more.
    #[test]
    fn ratings_follow_the_flux() {
        let tables = [500.0, 1000.0].map(|peak| UgrTable::new(&lambertian(peak), panel).unwrap());
        let step = 8.0 * libm::log10(2.0);
        for (one, two) in tables[0].rows.iter().zip(&tables[1].rows) {
            for column in 0..5 {
                let difference = two.crosswise[column].unwrap() - one.crosswise[column].unwrap();
                assert!((difference - step).abs() < 1e-9);
            }
        }
    }

    /// A luminaire without direction looks the same from both sides, and rooms get worse with darker surfaces.
    #[test]
    fn round_luminaires_have_two_equal_halves() {
        let table = UgrTable::new(&lambertian(1000.0), panel).unwrap();
        for row in &table.rows {
            let [cross, end] = [row.crosswise, row.endwise].map(|half| half.map(Option::unwrap));
            for column in 0..5 {
                assert!((cross[column] - end[column]).abs() < 1e-9, "{row:?}");
            }
            assert!(cross[0] < cross[1] && cross[2] < cross[3] && cross[3] < cross[4]);
        }
    }

    /// The standard's first row by hand: 2H × 2H, 64 luminaires of L = 1000/.36 cd/m².
    #[test]
    fn the_first_room_sums_up() {
        let luminance = 1000.0 / 0.36;
        let table = UgrTable::new(&lambertian(1000.0), panel).unwrap();
        let mut sum = 0.0;
        for row in 0..8 {
            for column in 0..8 {
                let (ahead, aside) = (0.25 + 0.5 * f64::from(row), -1.75 + 0.5 * f64::from(column));
                let square: f64 = ahead * ahead + aside * aside + 4.0;
                let Some(index) = index_in_table(ahead, aside) else {
                    continue;
                };
                sum +=
                    luminance * luminance * 0.36 * 2.0 / square.sqrt() / square / (index * index);
            }
        }
        let cavity = Cavity::new([4.0, 4.0], 2.0);
        let share = 0.414_525_3; // Between squares of side 2 at distance 1.
        let flux = 64.0 * 1000.0 * std::f64::consts::PI;
        let first = FirstFlux {
            plane: share * flux,
            walls: (1.0 - share) * flux,
            ceiling: 0.0,
        };
        let background = cavity.background(first, Reflectances::STANDARD[0]);
        let expected = rating(background.to_candelas_per_square_metre(), sum).unwrap();
        // Tables of 2.5° are off by 2.4e-4, which is 8 · 2.4e-4/ln 10 for each factor.
        let found = table.rows[0].crosswise[0].unwrap();
        assert!((found - expected).abs() < 2e-3, "{found}, {expected}");
    }

    #[test]
    fn points_and_dark_luminaires_have_no_table() {
        let point = |_: Direction| Area::ZERO;
        assert_eq!(
            UgrTable::new(&lambertian(1.0), point),
            Err(UgrTableError::NoOpening)
        );
        assert_eq!(
            UgrTable::new(&lambertian(0.0), panel),
            Err(UgrTableError::Dark)
        );
    }

    #[test]
    fn uplights_do_not_glare() {
        let up = FarField::new(
            Planes::C,
            &[0.0, 360.0],
            &[90.0, 180.0],
            &[0.0, 1.0, 0.0, 1.0],
        );
        let table = UgrTable::new(&up.unwrap(), panel).unwrap();
        assert!(table.rows.iter().all(|row| row.crosswise == [None; 5]));
    }
}
