//! The position index: by how much brighter a source may be away from the line of sight than on it, to trouble as much.
//!
//! Above the line of sight (S. K. Guth, Illuminating Engineering 58, 1963, in the form of the IESNA Lighting Handbook, 8th ed. 1993)
//!
//! p = exp[(35.2 − 0.31889 α − 1.22 e^(−2α/9)) 10⁻³ β + (21 + 0.26667 α − 0.002963 α²) 10⁻⁵ β²]
//!
//! and below it (T. Iwata & M. Tokura, Lighting Research & Technology 29, 1997; fitted to the same form at α = 90° by T. Iwata & W. Osterhaus, CIE 2010)
//!
//! p = exp(6.49·10⁻³ β′ + 21·10⁻⁵ β′²) ,  tanβ′ = tanβ (1 + 0.3225 cos²α)^½
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | α | angle between the vertical plane through the line of sight and the one through it and the source | ° |
//! | β | angle between the line of sight and the source | ° |
//! | p | position index, 1 on the line of sight | – |
//!
//! At the height of the eye, α = 90°, both give the same within .3 % up to β = 60°. Guth's observers saw sources at p ≤ 16, where the table
//! of CIE 117:1995 ends; the formula goes on. Nothing is known of sources behind the observer: they have no index.
//!
//! ```
//! use steradian::geometry::Direction;
//! use steradian::glare::Gaze;
//! // Table 4.1 of CIE 117: a source as far above as ahead, and as far aside, has p = 7.00.
//! let gaze = Gaze::new(Direction::X, Direction::Z).unwrap();
//! let source = Direction::new([1.0, 1.0, 1.0].into())?;
//! assert!((gaze.position_index(source).unwrap() - 7.03).abs() < 0.01);
//! # Ok::<(), steradian::geometry::NoDirection>(())
//! ```

use std::f64::consts::FRAC_PI_2;

use crate::geometry::{Direction, Frame};

/// Where the table of CIE 117:1995 ends.
pub const GREATEST_POSITION_INDEX: f64 = 16.0;

/// Where someone looks, and where up is for them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaze(Frame);

impl Gaze {
    /// Looking `forward`; `up` need not be perpendicular to it. `None` if they are parallel.
    pub fn new(forward: Direction, up: Direction) -> Option<Self> {
        Frame::from_normal_and_tangent(forward, up.to_vector()).map(Self)
    }

    /// The line of sight.
    pub const fn forward(&self) -> Direction {
        self.0.normal()
    }

    /// The part of up that is perpendicular to the line of sight.
    pub const fn up(&self) -> Direction {
        self.0.tangent()
    }

    /// p of a source in this direction; `None` if it is not in front.
    pub fn position_index(&self, towards: Direction) -> Option<f64> {
        let [up, aside, ahead] = self.0.to_local(towards).to_array();
        let beta = libm::atan2((up * up + aside * aside).sqrt(), ahead);
        let alpha = libm::atan2(aside.abs(), up);
        (beta < FRAC_PI_2).then(|| match alpha <= FRAC_PI_2 {
            true => above(alpha.to_degrees(), beta.to_degrees()),
            false => below(libm::cos(alpha), beta),
        })
    }
}

/// Guth's formula; angles in degrees.
fn above(alpha: f64, beta: f64) -> f64 {
    let linear = 35.2 - 0.31889 * alpha - 1.22 * libm::exp(-2.0 * alpha / 9.0);
    let square = 21.0 + 0.26667 * alpha - 0.002963 * alpha * alpha;
    libm::exp(1e-3 * linear * beta + 1e-5 * square * beta * beta)
}

/// Iwata's, β in rad.
fn below(cos_alpha: f64, beta: f64) -> f64 {
    let stretch = (1.0 + 0.3225 * cos_alpha * cos_alpha).sqrt();
    let beta = libm::atan(libm::tan(beta) * stretch).to_degrees();
    libm::exp(6.49e-3 * beta + 21e-5 * beta * beta)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looking along x: the index of a source at height H and T aside, R ahead.
    fn index(h: f64, t: f64, r: f64) -> f64 {
        let gaze = Gaze::new(Direction::X, Direction::Z).unwrap();
        let towards = Direction::new([r, t, h].into()).unwrap();
        gaze.position_index(towards).unwrap()
    }

    /// Table 4.1 of CIE 117:1995 was drawn by hand from the observations that the formula fits: the two differ by up to 8 %.
    #[test]
    fn the_formula_is_near_the_table() {
        let table = [
            (0.0, 0.0, 1.00),
            (0.5, 0.0, 2.86),
            (0.5, 0.5, 2.91),
            (1.0, 1.0, 7.00),
            (0.0, 1.0, 2.11),
            (0.3, 1.3, 3.70),
            (1.5, 2.0, 12.85),
            (1.7, 0.0, 16.2),
        ];
        for (h, t, p) in table {
            let found = index(h, t, 1.0);
            assert!(
                (found / p - 1.0).abs() < 0.08,
                "H/R {h}, T/R {t}: {found}, {p}"
            );
        }
    }

    #[test]
    fn left_is_as_right_and_both_formulas_meet_at_the_height_of_the_eye() {
        assert_eq!(index(0.4, 0.7, 1.0), index(0.4, -0.7, 1.0));
        for t in [0.1, 0.5, 1.0, 1.7] {
            let (above, below) = (index(1e-9, t, 1.0), index(-1e-9, t, 1.0));
            assert!((above / below - 1.0).abs() < 3e-3, "{above}, {below}");
        }
    }

    /// Iwata's observations, as given with the ratio R/D of the distance from the line of sight to that ahead:
    /// 1 + .8 R/D up to .6, then 1 + 1.2 R/D; the formula fits them within a fifth.
    #[test]
    fn below_the_line_of_sight_sources_trouble_more() {
        for (h, t) in [(0.3, 0.0), (0.3, 0.4), (1.0, 0.0)] {
            assert!(index(-h, t, 1.0) < index(h, t, 1.0));
        }
        for (h, expected) in [(0.2, 1.16), (0.5, 1.4), (1.0, 2.2), (1.5, 2.8)] {
            let found = index(-h, 0.0, 1.0);
            assert!(
                (found / expected - 1.0).abs() < 0.2,
                "{h}: {found}, {expected}"
            );
        }
    }

    #[test]
    fn what_is_behind_has_no_index_and_up_is_not_ahead() {
        let gaze = Gaze::new(Direction::X, Direction::Z).unwrap();
        assert_eq!(gaze.position_index(-Direction::X), None);
        assert_eq!(gaze.position_index(Direction::Y), None);
        assert!(Gaze::new(Direction::Z, Direction::Z).is_none());
        assert!(Gaze::new(Direction::Z, -Direction::Z).is_none());
    }
}
