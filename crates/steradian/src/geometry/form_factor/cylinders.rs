//! Cylinders inside one another, closed by their ends, and side by side.

use std::f64::consts::{FRAC_PI_2, PI};

use super::dimensions::{DimensionError, positive};
use super::discs::between_coaxial_discs;
use crate::quantity::Length;

/// A cylinder around another of the same length and axis.
///
/// With R = r₂/r₁, H = h/r₁, A = H² + R² − 1 and B = H² − R² + 1 (Howell's catalogue, C-91 and C-92, after D. C. Hamilton & W. R. Morgan,
/// NACA TN 2836, 1952, and H. Leuenberger & R. A. Person, ASME 56-A-144, 1956)
///
/// R F₂₁ = 1 − (1/π) (arccos(B/A) − (√((A + 2)² − 4R²) arccos(B/(RA)) + B arcsin(1/R) − ½ π A)/(2H))
///
/// F₂₂ = 1 − 1/R + (2/πR) arctan(2√(R² − 1)/H) − (H/2πR) (√(4R² + H²)/H arcsin((4(R² − 1) + H² (R² − 2)/R²)/(H² + 4(R² − 1))) −
/// arcsin((R² − 2)/R²) + ½ π (√(4R² + H²)/H − 1))
///
/// and the ring-shaped ends get the rest.
///
/// ```
/// use steradian::geometry::form_factor::ConcentricCylinders;
/// use steradian::quantity::Length;
/// let gap = ConcentricCylinders::new(Length::from_metres(1.0), Length::from_metres(2.0), Length::from_metres(2.0))?;
/// assert!((gap.inner_to_outer() - 2.0 * gap.outer_to_inner()).abs() < 1e-15); // A₁ F₁₂ = A₂ F₂₁
/// assert!((gap.outer_to_inner() - 0.337106).abs() < 1e-6);
/// # Ok::<(), steradian::geometry::form_factor::DimensionError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConcentricCylinders {
    /// Outer radius and length in units of the inner radius.
    ratio: f64,
    length: f64,
}

impl ConcentricCylinders {
    /// By the radii and the common length.
    ///
    /// # Errors
    /// If a length is not positive or the outer radius not larger than the inner one.
    pub fn new(inner: Length, outer: Length, length: Length) -> Result<Self, DimensionError> {
        let (inner, outer) = (
            positive("inner radius", inner)?,
            positive("outer radius", outer)?,
        );
        if outer <= inner {
            return Err(DimensionError::Intersecting(
                "the outer radius must be larger than the inner one",
            ));
        }
        Ok(Self {
            ratio: outer / inner,
            length: positive("length", length)? / inner,
        })
    }

    /// From the inside of the outer cylinder to the inner one.
    pub fn outer_to_inner(&self) -> f64 {
        self.inner_to_outer() / self.ratio
    }

    /// From the inner cylinder to the outer one.
    pub fn inner_to_outer(&self) -> f64 {
        let (r, h) = (self.ratio, self.length);
        let excess = (r - 1.0) * (r + 1.0);
        let (a, b) = (h * h + excess, h * h - excess);
        let root = ((a + 2.0 - 2.0 * r) * (a + 2.0 + 2.0 * r)).sqrt();
        let bracket = root * libm::acos(b / (r * a)) + b * libm::asin(1.0 / r) - FRAC_PI_2 * a;
        1.0 - (libm::acos(b / a) - bracket / (2.0 * h)) / PI
    }

    /// From the inside of the outer cylinder to itself.
    pub fn outer_to_outer(&self) -> f64 {
        let (r, h) = (self.ratio, self.length);
        let excess = (r - 1.0) * (r + 1.0);
        let slant = (4.0 * r * r + h * h).sqrt() / h;
        let inverse = (r * r - 2.0) / (r * r);
        let argument = (4.0 * excess + h * h * inverse) / (h * h + 4.0 * excess);
        let bracket =
            slant * libm::asin(argument) - libm::asin(inverse) + FRAC_PI_2 * (slant - 1.0);
        1.0 - 1.0 / r + 2.0 / (PI * r) * libm::atan(2.0 * excess.sqrt() / h)
            - h / (2.0 * PI * r) * bracket
    }

    /// From the inner cylinder to both ends together.
    pub fn inner_to_ends(&self) -> f64 {
        1.0 - self.inner_to_outer()
    }

    /// From the inside of the outer cylinder to both ends together.
    pub fn outer_to_ends(&self) -> f64 {
        1.0 - self.outer_to_inner() - self.outer_to_outer()
    }
}

/// The inside of a cylinder with both its ends: from [`between_coaxial_discs`] by closure and reciprocity.
///
/// ```
/// use steradian::geometry::form_factor::ClosedCylinder;
/// use steradian::quantity::Length;
/// let tin = ClosedCylinder::new(Length::from_metres(1.0), Length::from_metres(1.0))?;
/// assert!((tin.end_to_side() - (5.0_f64.sqrt() - 1.0) / 2.0).abs() < 1e-15);
/// assert!((2.0 * tin.side_to_end() + tin.side_to_side() - 1.0).abs() < 1e-15);
/// # Ok::<(), steradian::geometry::form_factor::DimensionError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosedCylinder {
    end_to_end: f64,
    /// The area of an end over that of the side.
    end_share: f64,
}

impl ClosedCylinder {
    /// By the radius and the height.
    ///
    /// # Errors
    /// If a length is not positive.
    pub fn new(radius: Length, height: Length) -> Result<Self, DimensionError> {
        let end_to_end = between_coaxial_discs([radius, radius], height)?;
        Ok(Self {
            end_to_end,
            end_share: 0.5 * (radius / height),
        })
    }

    /// From one end to the other.
    pub fn end_to_end(&self) -> f64 {
        self.end_to_end
    }

    /// From one end to the side.
    pub fn end_to_side(&self) -> f64 {
        1.0 - self.end_to_end
    }

    /// From the side to one end.
    pub fn side_to_end(&self) -> f64 {
        self.end_share * self.end_to_side()
    }

    /// From the side to itself.
    pub fn side_to_side(&self) -> f64 {
        1.0 - 2.0 * self.side_to_end()
    }
}

/// From one endless cylinder to another beside it, by their radii and the distance of their axes.
///
/// Crossed strings around both (see [`between_strips`](super::between_strips)): with the sum and the difference of the radii s and d
/// and the distance c,
///
/// 2π r₁ F₁₂ = √(c² − s²) − √(c² − d²) + s arcsin(s/c) − d arcsin(d/c) (Howell's catalogue, C-63)
///
/// # Errors
/// If a length is not positive or the cylinders overlap.
///
/// ```
/// use steradian::geometry::form_factor;
/// use steradian::quantity::Length;
/// // Two rods that touch: 1/2 − 1/π.
/// let found = form_factor::between_parallel_cylinders([Length::from_metres(1.0); 2], Length::from_metres(2.0))?;
/// assert!((found - (0.5 - std::f64::consts::FRAC_1_PI)).abs() < 1e-15);
/// # Ok::<(), form_factor::DimensionError>(())
/// ```
pub fn between_parallel_cylinders(
    radii: [Length; 2],
    distance: Length,
) -> Result<f64, DimensionError> {
    let [from, to] = [
        positive("first radius", radii[0])?,
        positive("second radius", radii[1])?,
    ];
    let between_axes = positive("distance", distance)?;
    if between_axes < from + to {
        return Err(DimensionError::Intersecting(
            "the distance of the axes must not be less than both radii together",
        ));
    }
    let string = |offset: f64| {
        let straight = ((between_axes - offset) * (between_axes + offset)).sqrt();
        straight + offset * libm::asin(offset / between_axes)
    };
    Ok((string(from + to) - string(from - to)) / (2.0 * PI * from))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::close;
    use crate::geometry::{Direction, Point, configuration_factor, gauss};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_outer_cylinder_is_the_mean_of_its_elements(outer in 1.2..4.0_f64, length in 0.3..5.0_f64) {
            let [one, r, h] = [1.0, outer, length].map(Length::from_metres);
            let cylinders = ConcentricCylinders::new(one, r, h).unwrap();
            let ends = [Point::ORIGIN, Point::new(0.0, 0.0, length)];
            let element = |z: f64| configuration_factor::of_cylinder(Point::new(-outer, 0.0, z), Direction::X, ends, one);
            let panel = |k: usize| gauss::integrate(16, [k, k + 1].map(|k| length * k as f64 / 16.0), element);
            let mean = (0..16).map(panel).sum::<f64>() / length;
            prop_assert!(close(cylinders.outer_to_inner(), mean, 1e-13));
        }

        #[test]
        fn a_wide_inner_cylinder_leaves_two_parallel_planes(length in 0.1..5.0_f64) {
            // A gap of 1 around a cylinder of radius 10⁵: strips of this length that face each other at the distance 1.
            let [inner, outer, h] = [1e5, 1e5 + 1.0, length].map(Length::from_metres);
            let cylinders = ConcentricCylinders::new(inner, outer, h).unwrap();
            let strips = super::super::between_parallel_strips(h, Length::from_metres(1.0)).unwrap();
            prop_assert!(close(cylinders.inner_to_outer(), strips, 1e-4), "{cylinders:?}");
            prop_assert!(cylinders.outer_to_outer().abs() < 2e-2);
        }

        #[test]
        fn reciprocity_of_parallel_cylinders(a in 0.1..3.0_f64, b in 0.1..3.0_f64, gap in 0.0..3.0_f64) {
            let [x, y, c] = [a, b, a + b + gap].map(Length::from_metres);
            let (forth, back) = (between_parallel_cylinders([x, y], c).unwrap(), between_parallel_cylinders([y, x], c).unwrap());
            prop_assert!(close(a * forth, b * back, 1e-14));
            prop_assert!((0.0..0.5).contains(&forth));
        }
    }

    #[test]
    fn cylinders_that_do_not_fit_are_refused() {
        let [one, two] = [1.0, 2.0].map(Length::from_metres);
        assert_eq!(
            ConcentricCylinders::new(two, one, one)
                .unwrap_err()
                .to_string(),
            "the outer radius must be larger than the inner one"
        );
        assert!(between_parallel_cylinders([two, two], one).is_err());
        assert!(ClosedCylinder::new(one, Length::ZERO).is_err());
    }
}
