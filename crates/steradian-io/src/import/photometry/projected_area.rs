//! How large a luminous opening looks, as tables of luminance and of UGR take it.
//!
//! A_p of a direction d is the area of the opening's shadow along d; of a box of sides w along C90 and l along C0
//!
//! A_p = w l |cosγ| + (w h_x |cosC| + l h_y |sinC|) sinγ
//!
//! with the heights h_x and h_y of those sides that face d. What is flat shows both its sides. Source: CIE 117:1995, equation 4.3; EULUMDAT's
//! heights of the luminous area at C0, C90, C180 and C270.

use std::f64::consts::FRAC_PI_4;

use steradian::geometry::Direction;
use steradian::quantity::Area;

use super::{Opening, Photometry};

impl Photometry {
    /// The area that the opening shows in a direction away from the luminaire, with C0 = +x, C90 = +y and light downwards towards −z.
    pub fn projected_area(&self, direction: Direction) -> Area {
        Area::from_square_metres(shadow(
            self.opening,
            self.side_heights,
            direction.to_array(),
        ))
    }
}

fn shadow(opening: Opening, side_heights: Option<[f64; 4]>, [x, y, z]: [f64; 3]) -> f64 {
    match opening {
        Opening::Point => 0.0,
        Opening::Box {
            width,
            length,
            height,
        } => {
            let [c0, c90, c180, c270] = side_heights.unwrap_or([height; 4]);
            let facing_x = if x >= 0.0 { c0 } else { c180 };
            let facing_y = if y >= 0.0 { c90 } else { c270 };
            width * length * z.abs() + width * facing_x * x.abs() + length * facing_y * y.abs()
        }
        Opening::Upright {
            width,
            length,
            height,
        } => {
            let [a, b] = [length * y, width * x];
            FRAC_PI_4 * width * length * z.abs() + height * (a * a + b * b).sqrt()
        }
        Opening::Lying {
            along_c0,
            length,
            diameter,
        } => {
            let along = if along_c0 { x } else { y };
            let across = (1.0 - along * along).max(0.0).sqrt();
            length * diameter * across + FRAC_PI_4 * diameter * diameter * along.abs()
        }
        Opening::Ellipsoid {
            diameters: [width, length, height],
        } => {
            let parts = [width * height * x, length * height * y, width * length * z];
            FRAC_PI_4 * parts.iter().map(|part| part * part).sum::<f64>().sqrt()
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn shown(opening: Opening, heights: Option<[f64; 4]>, direction: [f64; 3]) -> f64 {
        let direction = Direction::new(direction.into()).unwrap();
        shadow(opening, heights, direction.to_array())
    }

    /// Shadows along the axes are known shapes: below, C0, C90, C180, C270.
    #[test]
    fn openings_show_their_faces() {
        let (width, length) = (0.6, 1.2);
        let heights = Some([0.1, 0.2, 0.3, 0.4]);
        let upright = Opening::Upright {
            width,
            length,
            height: 0.5,
        };
        let lying = Opening::Lying {
            along_c0: true,
            length,
            diameter: 0.2,
        };
        let ellipsoid = Opening::Ellipsoid {
            diameters: [width, length, 0.4],
        };
        let cases = [
            (box_of(width, length, 0.4), [0.72, 0.06, 0.24, 0.18, 0.48]),
            (upright, [PI * 0.18, 0.3, 0.6, 0.3, 0.6]),
            (lying, [0.24, PI * 0.01, 0.24, PI * 0.01, 0.24]),
            (
                ellipsoid,
                [PI * 0.18, PI * 0.06, PI * 0.12, PI * 0.06, PI * 0.12],
            ),
            (Opening::Point, [0.0; 5]),
        ];
        let axes = [
            [0.0, 0.0, -1.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
        ];
        for (opening, areas) in cases {
            for (axis, area) in axes.into_iter().zip(areas) {
                let found = shown(opening, heights, axis);
                assert!(
                    (found - area).abs() < 1e-15,
                    "{opening:?} {axis:?}: {found}, {area}"
                );
            }
        }
    }

    fn box_of(width: f64, length: f64, height: f64) -> Opening {
        Opening::Box {
            width,
            length,
            height,
        }
    }

    /// A ball of diameter 1 shows π/4 from everywhere; a cube its three faces.
    #[test]
    fn slanting_directions_add_up() {
        let ball = Opening::Ellipsoid {
            diameters: [1.0; 3],
        };
        assert!((shown(ball, None, [0.3, -0.5, 0.8]) - FRAC_PI_4).abs() < 1e-15);
        let cube = box_of(1.0, 1.0, 1.0);
        assert!((shown(cube, None, [1.0, 1.0, -1.0]) - 3.0_f64.sqrt()).abs() < 1e-15);
    }
}
