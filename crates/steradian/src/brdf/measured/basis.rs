//! A hemisphere divided into rings, and each ring into equal patches: the angle bases of Klems.
//!
//! A direction is a point of the unit disc, (x, y) of the unit vector, so that areas on the disc are projected solid angles:
//! a patch of a ring θ₀ … θ₁ with n patches has Ω = π/n (sin²θ₁ − sin²θ₀). Patches are numbered ring by ring from the
//! normal; the first of a ring is centred on azimuth 0. Source: J. H. Klems, ASHRAE Transactions 100 (1994) 1065; names and
//! bounds as the programs WINDOW and Radiance use them.

use std::f64::consts::{PI, TAU};

use super::MeasuredError;

/// A point of the unit disc: (x, y) of a direction.
pub(super) type DiscPoint = [f64; 2];

/// How a hemisphere is divided.
///
/// ```
/// use steradian::brdf::measured::AngleBasis;
/// // Bounds 0°, 5°, 15°, …, 75°, 90°.
/// let full = &AngleBasis::named("LBNL/Klems Full")[0];
/// assert_eq!(full.patches(), 145);
/// let normal = std::f64::consts::PI * 5.0_f64.to_radians().sin().powi(2);
/// assert!((full.projected_solid_angle(0) - normal).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct AngleBasis {
    name: String,
    rings: Vec<Ring>,
}

#[derive(Clone, Debug, PartialEq)]
struct Ring {
    /// sin² of the bounds.
    from: f64,
    to: f64,
    patches: usize,
    /// Number of its first patch.
    first: usize,
}

const FULL: &[(f64, usize)] = &[
    (5.0, 1),
    (15.0, 8),
    (25.0, 16),
    (35.0, 20),
    (45.0, 24),
    (55.0, 24),
    (65.0, 24),
    (75.0, 16),
    (90.0, 12),
];
const HALF: &[(f64, usize)] = &[
    (6.5, 1),
    (19.5, 8),
    (32.5, 12),
    (46.5, 16),
    (61.5, 20),
    (76.5, 12),
    (90.0, 4),
];
const HALF_OF_77: &[(f64, usize)] = &[
    (6.5, 1),
    (19.5, 8),
    (32.5, 12),
    (45.5, 16),
    (58.5, 20),
    (71.5, 12),
    (90.0, 8),
];
const QUARTER: &[(f64, usize)] = &[(9.0, 1), (27.0, 8), (45.0, 12), (63.0, 12), (90.0, 8)];

impl AngleBasis {
    /// Most patches of a basis.
    pub const MOST_PATCHES: usize = 10_000;

    /// From the upper bound in degrees and the number of patches of each ring, from the normal outwards.
    ///
    /// # Errors
    /// If the bounds do not rise, do not lie within 0 … 90°, or a ring has no patch.
    pub fn new(name: &str, rings: &[(f64, usize)]) -> Result<Self, MeasuredError> {
        let mut basis = Self {
            name: name.to_owned(),
            rings: vec![],
        };
        let mut below = 0.0;
        for &(degrees, patches) in rings {
            let rises = degrees > below && degrees <= 90.0;
            let room = Self::MOST_PATCHES.saturating_sub(basis.patches());
            if !rises || patches == 0 || patches > room {
                return Err(MeasuredError::Ring { degrees, patches });
            }
            basis.rings.push(Ring {
                from: square_of_sine(below),
                to: square_of_sine(degrees),
                patches,
                first: basis.patches(),
            });
            below = degrees;
        }
        match basis.rings.is_empty() {
            true => Err(MeasuredError::Empty),
            false => Ok(basis),
        }
    }

    /// The bases of this name that programs know; of half resolution there are two.
    pub fn named(name: &str) -> Vec<Self> {
        let tables: &[&[(f64, usize)]] = match name.to_ascii_lowercase().as_str() {
            "lbnl/klems full" => &[FULL],
            "lbnl/klems half" => &[HALF, HALF_OF_77],
            "lbnl/klems quarter" => &[QUARTER],
            _ => &[],
        };
        let bases = tables.iter().map(|rings| Self::new(name, rings));
        bases.filter_map(Result::ok).collect()
    }

    /// What it is called.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it divides the hemisphere as another does.
    pub fn divides_as(&self, other: &Self) -> bool {
        let same = |(a, b): (&Ring, &Ring)| {
            a.patches == b.patches && (a.from - b.from).abs() < 1e-6 && (a.to - b.to).abs() < 1e-6
        };
        self.rings.len() == other.rings.len() && self.rings.iter().zip(&other.rings).all(same)
    }

    /// How many patches it has.
    pub fn patches(&self) -> usize {
        self.rings
            .last()
            .map_or(0, |ring| ring.first + ring.patches)
    }

    /// The numbers of the patches of each ring.
    pub fn rings(&self) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        let range = |ring: &Ring| ring.first..ring.first + ring.patches;
        self.rings.iter().map(range)
    }

    /// The middles of the patches: (x, y) of directions.
    pub fn middles(&self) -> Vec<[f64; 2]> {
        (0..self.patches())
            .map(|patch| self.point(patch, [0.5; 2]))
            .collect()
    }

    /// ∫ cosθ dω over a patch in sr.
    ///
    /// # Panics
    /// If there is no such patch.
    pub fn projected_solid_angle(&self, patch: usize) -> f64 {
        let ring = self.ring(patch);
        PI * (ring.to - ring.from) / ring.patches as f64
    }

    fn ring(&self, patch: usize) -> &Ring {
        let above = self.rings.partition_point(|ring| ring.first <= patch);
        &self.rings[above - 1]
    }

    /// The patch that holds a point; none if the basis ends before.
    pub(super) fn patch(&self, [x, y]: DiscPoint) -> Option<usize> {
        let square = (x * x + y * y).min(1.0);
        let last = self.rings.last()?;
        let ring = match square == 1.0 && last.to == 1.0 {
            true => last,
            false => self.rings[self.rings.partition_point(|ring| ring.to <= square)..].first()?,
        };
        let turn = libm::atan2(y, x) / TAU;
        let place = (turn - turn.floor()) * ring.patches as f64 + 0.5;
        Some(ring.first + place as usize % ring.patches)
    }

    /// A point of a patch, uniform for uniform `u`; (½, ½) is its middle.
    pub(super) fn point(&self, patch: usize, u: [f64; 2]) -> DiscPoint {
        let ring = self.ring(patch);
        let radius = (ring.from + u[0] * (ring.to - ring.from)).sqrt();
        let place = (patch - ring.first) as f64 + u[1] - 0.5;
        let azimuth = TAU * place / ring.patches as f64;
        [radius * libm::cos(azimuth), radius * libm::sin(azimuth)]
    }
}

fn square_of_sine(degrees: f64) -> f64 {
    if degrees >= 90.0 {
        return 1.0;
    }
    let sine = libm::sin(degrees.to_radians());
    sine * sine
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known() -> Vec<AngleBasis> {
        ["Full", "Half", "Quarter"]
            .iter()
            .flat_map(|size| AngleBasis::named(&format!("LBNL/Klems {size}")))
            .collect()
    }

    #[test]
    fn patches_cover_the_hemisphere_once() {
        let counts: Vec<_> = known().iter().map(AngleBasis::patches).collect();
        assert_eq!(counts, [145, 73, 77, 41]);
        for basis in known() {
            let total: f64 = (0..basis.patches())
                .map(|p| basis.projected_solid_angle(p))
                .sum();
            assert!((total - PI).abs() < 1e-13);
        }
    }

    #[test]
    fn a_point_of_a_patch_lies_in_it() {
        for basis in known() {
            for patch in 0..basis.patches() {
                for u in [[0.5, 0.5], [0.01, 0.99], [0.99, 0.01]] {
                    assert_eq!(basis.patch(basis.point(patch, u)), Some(patch));
                }
            }
        }
    }

    #[test]
    fn the_horizon_belongs_to_the_last_ring_and_a_low_basis_ends_before() {
        let full = &known()[0];
        assert_eq!(full.patch([1.0, 0.0]), Some(133));
        let narrow = AngleBasis::new("narrow", &[(30.0, 1), (60.0, 4)]).unwrap();
        assert_eq!(narrow.patch([0.9, 0.0]), None);
        assert_eq!(narrow.patch([0.0, -0.7]), Some(4));
    }

    #[test]
    fn rings_that_do_not_rise_are_refused() {
        for rings in [
            &[(5.0, 1), (5.0, 8)][..],
            &[(95.0, 1)],
            &[(90.0, 0)],
            &[(f64::NAN, 1)],
            &[],
        ] {
            assert!(AngleBasis::new("bad", rings).is_err(), "{rings:?}");
        }
    }
}
