//! The tables of MERL: isotropic reflection by the half vector and the difference vector.
//!
//! With h = (d_e + d_i)/|d_e + d_i| and the difference d_i turned so that h is the pole, the table has 90 cells of
//! √(θ_h/(π/2)), 90 of θ_d and 180 of φ_d in 0 … π (half a turn exchanges the directions, so the table is reciprocal). A value is
//! that of its cell, without interpolation, as in the code that comes with the data. Negative entries mark cells that were not measured;
//! they are 0 here.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | θ_h, φ_h | polar angles of h | rad |
//! | θ_d, φ_d | polar angles of d_i about h | rad |
//!
//! Directions are drawn from a mixture: .3 of cosθ_i/π, and half vectors of a density that is constant on the cells of θ_h and
//! follows the table for 90 angles of d_e; the weight is at most π/.3 times the largest value. The albedo is a sum over the
//! half vectors, 180 angles by 48 azimuths, interpolated in θ_e: to 2e-3 for smooth tables.
//!
//! Sources: W. Matusik et al., *A data-driven reflectance model* (SIGGRAPH 2003); S. Rusinkiewicz, *A new change of variables for
//! efficient BRDF representation* (1998), eq. 1.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI, TAU};

use super::MeasuredError;
use super::reading::{Reading, luminance};
use crate::brdf::Scatter;
use crate::brdf::sampling::{above, choose, cosine_direction};
use crate::geometry::{Direction, Vector};
use crate::quantity::Spectrum;

/// Cells of θ_h and of θ_d.
const THETA: usize = 90;
/// Cells of φ_d.
const PHI: usize = 180;
/// Angles of d_e with a density of their own.
const VIEWS: usize = 90;
/// Part of the samples that follow the cosine.
const COSINE: f64 = 0.3;

/// A table of MERL, and the densities made of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Merl {
    values: Vec<[f32; 3]>,
    views: Vec<View>,
}

/// What is tabulated for an angle of d_e.
#[derive(Clone, Debug, PartialEq)]
struct View {
    /// Probability of the cells of θ_h up to and with each; all 0 if the table is black.
    cumulative: Vec<f64>,
    albedo: [f64; 3],
}

impl Merl {
    /// The number of cells of θ_h, θ_d and φ_d.
    pub const CELLS: [usize; 3] = [THETA, THETA, PHI];

    /// From values in 1/sr of red, green and blue, φ_d fastest; negative ones are missing.
    ///
    /// # Errors
    /// If their number is wrong, or one is not finite.
    pub fn new(mut values: Vec<[f32; 3]>) -> Result<Self, MeasuredError> {
        let (needed, found) = (THETA * THETA * PHI, values.len());
        if needed != found {
            return Err(MeasuredError::Count { needed, found });
        }
        for (index, value) in values.iter_mut().enumerate() {
            if let Some(&found) = value.iter().find(|channel| !channel.is_finite()) {
                return Err(MeasuredError::Value { index, found });
            }
            *value = value.map(|channel| channel.max(0.0));
        }
        let mut table = Self {
            values,
            views: vec![],
        };
        table.views = (0..VIEWS).map(|view| table.view(view)).collect();
        Ok(table)
    }

    /// The middle of a cell as θ_h, θ_d and φ_d.
    pub fn middle([half, difference, azimuth]: [usize; 3]) -> [f64; 3] {
        let at = |cell: usize, cells: usize| (cell as f64 + 0.5) / cells as f64;
        let root = at(half, THETA);
        [
            root * root * FRAC_PI_2,
            at(difference, THETA) * FRAC_PI_2,
            at(azimuth, PHI) * PI,
        ]
    }

    /// Red, green and blue in 1/sr.
    pub fn value(&self, wo: Direction, wi: Direction) -> [f64; 3] {
        match above(wo, wi) {
            true => self.values[cell(wo, wi)].map(f64::from),
            false => [0.0; 3],
        }
    }

    /// Directional-hemispherical reflectance of red, green and blue.
    pub fn albedo(&self, wo: Direction) -> [f64; 3] {
        if wo.z() <= 0.0 {
            return [0.0; 3];
        }
        let place = (view_place(wo) - 0.5).clamp(0.0, VIEWS as f64 - 1.0);
        let low = (place as usize).min(VIEWS - 2);
        let part = place - low as f64;
        let [a, b] = [0, 1].map(|k| self.views[low + k].albedo);
        std::array::from_fn(|k| a[k] + part * (b[k] - a[k]))
    }

    pub(super) fn evaluate(&self, wo: Direction, wi: Direction, reading: Reading) -> Spectrum {
        reading.of_colour(self.value(wo, wi))
    }

    pub(super) fn sample(&self, wo: Direction, u: [f64; 2], reading: Reading) -> Option<Scatter> {
        if wo.z() <= 0.0 {
            return None;
        }
        let (diffuse, u0) = choose(u[0], self.cosine_share(wo));
        let wi = match diffuse {
            true => cosine_direction([u0, u[1]]),
            false => mirrored(wo, self.half_vector(wo, [u0, u[1]]))?,
        };
        if wi.z() <= 0.0 {
            return None;
        }
        Scatter::finite(wi, self.evaluate(wo, wi, reading), self.pdf(wo, wi))
    }

    pub(super) fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        if !above(wo, wi) {
            return 0.0;
        }
        let share = self.cosine_share(wo);
        share * wi.z() * FRAC_1_PI + (1.0 - share) * self.half_vector_pdf(wo, wi)
    }

    fn cosine_share(&self, wo: Direction) -> f64 {
        match self.view_of(wo).cumulative[THETA - 1] > 0.0 {
            true => COSINE,
            false => 1.0,
        }
    }

    fn view_of(&self, wo: Direction) -> &View {
        &self.views[(view_place(wo) as usize).min(VIEWS - 1)]
    }

    fn half_vector(&self, wo: Direction, u: [f64; 2]) -> Direction {
        let sums = &self.view_of(wo).cumulative;
        let cell = sums.partition_point(|sum| *sum <= u[0]).min(THETA - 1);
        let before = if cell == 0 { 0.0 } else { sums[cell - 1] };
        let within = ((u[0] - before) / (sums[cell] - before)).clamp(0.0, 1.0);
        let [high, low] = cosines(cell);
        let cos = high + within * (low - high);
        Direction::from_polar((1.0 - cos * cos).max(0.0).sqrt(), cos, TAU * u[1])
    }

    fn half_vector_pdf(&self, wo: Direction, wi: Direction) -> f64 {
        let sums = &self.view_of(wo).cumulative;
        let sum = wo.to_vector() + wi.to_vector();
        let length = sum.length();
        let cell = half_cell(libm::acos((sum.z / length).min(1.0)));
        let before = if cell == 0 { 0.0 } else { sums[cell - 1] };
        let [high, low] = cosines(cell);
        // dω_i = 4 (d_e·h) dω_h, and d_e·h is half the length of the sum.
        (sums[cell] - before) / (TAU * (high - low)) / (2.0 * length)
    }

    /// Sums over half vectors: two angles in each cell of θ_h.
    fn view(&self, view: usize) -> View {
        let theta = (view as f64 + 0.5) / VIEWS as f64 * FRAC_PI_2;
        let wo = Direction::from_polar(libm::sin(theta), libm::cos(theta), 0.0);
        let (mut albedo, mut sum) = ([0.0; 3], 0.0);
        let mut cumulative = Vec::with_capacity(THETA);
        for cell in 0..THETA {
            let colour = self.reflected_by(wo, cell);
            (0..3).for_each(|k| albedo[k] += colour[k]);
            sum += luminance(colour);
            cumulative.push(sum);
        }
        if sum > 0.0 {
            cumulative.iter_mut().for_each(|part| *part /= sum);
        }
        View { cumulative, albedo }
    }

    /// ∫ ρ cosθ_i dω_i over the half vectors of a cell of θ_h.
    fn reflected_by(&self, wo: Direction, cell: usize) -> [f64; 3] {
        const AZIMUTHS: usize = 48;
        let [high, low] = cosines(cell);
        let mut colour = [0.0; 3];
        for k in 0..2 * AZIMUTHS {
            let cos = high + (low - high) * if k % 2 == 0 { 0.25 } else { 0.75 };
            let azimuth = TAU * (k as f64 + 0.5) / (2 * AZIMUTHS) as f64;
            let half = Direction::from_polar((1.0 - cos * cos).max(0.0).sqrt(), cos, azimuth);
            let Some(wi) = mirrored(wo, half).filter(|wi| wi.z() > 0.0) else {
                continue;
            };
            let weight = 4.0 * wo.dot(half) * wi.z() * TAU * (high - low) / (2 * AZIMUTHS) as f64;
            let value = self.value(wo, wi);
            (0..3).for_each(|channel| colour[channel] += value[channel] * weight);
        }
        colour
    }
}

/// Cosines of the bounds of a cell of θ_h, the larger first.
fn cosines(cell: usize) -> [f64; 2] {
    [cell, cell + 1].map(|bound| {
        let root = bound as f64 / THETA as f64;
        libm::cos(root * root * FRAC_PI_2)
    })
}

fn view_place(wo: Direction) -> f64 {
    libm::acos(wo.z().min(1.0)) / FRAC_PI_2 * VIEWS as f64
}

/// None if light from there comes from behind the facet.
fn mirrored(wo: Direction, half: Direction) -> Option<Direction> {
    (wo.dot(half) > 0.0).then(|| half.mirror(wo))
}

fn half_cell(theta: f64) -> usize {
    ((theta / FRAC_PI_2).sqrt() * THETA as f64).min(THETA as f64 - 1.0) as usize
}

/// The cell of two directions above the surface, the same when they are exchanged.
fn cell(wo: Direction, wi: Direction) -> usize {
    let (wo, wi) = (wo.to_vector(), wi.to_vector());
    let (sum, difference) = (wo + wi, wi - wo);
    let across = (sum.x * sum.x + sum.y * sum.y).sqrt();
    let theta_h = libm::atan2(across, sum.z);
    let theta_d = libm::atan2(difference.length(), sum.length());
    let difference_cell = (theta_d / FRAC_PI_2 * THETA as f64).min(THETA as f64 - 1.0) as usize;
    let azimuth_cell = (azimuth(sum, difference, across) / PI * PHI as f64).min(PHI as f64 - 1.0);
    (half_cell(theta_h) * THETA + difference_cell) * PHI + azimuth_cell as usize
}

/// φ_d in 0 … π: from the meridian of h, away from the normal.
fn azimuth(sum: Vector, difference: Vector, across: f64) -> f64 {
    let [cos, sin] = match across > 0.0 {
        true => [sum.x / across, sum.y / across],
        false => [1.0, 0.0],
    };
    let length = sum.length();
    let along =
        (difference.x * cos + difference.y * sin) * sum.z / length - difference.z * across / length;
    let aside = difference.y * cos - difference.x * sin;
    let turned = aside < 0.0 || (aside == 0.0 && along < 0.0);
    let sign = if turned { -1.0 } else { 1.0 };
    libm::atan2(sign * aside, sign * along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::any_direction;
    use proptest::prelude::*;
    use std::sync::LazyLock;

    pub(super) fn tabulated(f: impl Fn([f64; 3]) -> f64) -> Merl {
        let at = |k: usize| Merl::middle([k / (THETA * PHI), k / PHI % THETA, k % PHI]);
        let values = (0..THETA * THETA * PHI).map(|k| [f(at(k)) as f32; 3]);
        Merl::new(values.collect()).unwrap()
    }

    static GREY: LazyLock<Merl> = LazyLock::new(|| tabulated(|_| 0.5 * FRAC_1_PI));

    /// ρ π = albedo at all angles but the last degrees, where the sum over half vectors is coarse.
    #[test]
    fn a_constant_table_is_lambertian() {
        for theta in [0.0, 0.3, 0.8, 1.2, 1.4] {
            let wo = Direction::from_polar(libm::sin(theta), libm::cos(theta), 0.4);
            let [albedo, ..] = GREY.albedo(wo);
            assert!((albedo - 0.5).abs() < 2e-3, "{theta}: {albedo}");
        }
    }

    /// θ_h, θ_d and φ_d are those of the reference: turn back d_i by −φ_h about z and by −θ_h about y.
    #[test]
    fn the_angles_are_those_of_rusinkiewicz() {
        let wi = Direction::new(Vector::new(0.3, -0.5, 0.6)).unwrap();
        let wo = Direction::new(Vector::new(0.1, 0.7, 0.4)).unwrap();
        let h = Direction::new(wi.to_vector() + wo.to_vector()).unwrap();
        let (theta, phi) = (libm::acos(h.z()), libm::atan2(h.y(), h.x()));
        let (s, c) = (libm::sin(-phi), libm::cos(-phi));
        let about_z = Vector::new(wi.x() * c - wi.y() * s, wi.x() * s + wi.y() * c, wi.z());
        let (s, c) = (libm::sin(-theta), libm::cos(-theta));
        let d = Vector::new(
            about_z.x * c + about_z.z * s,
            about_z.y,
            about_z.z * c - about_z.x * s,
        );
        let theta_d = libm::acos(d.z);
        let phi_d = libm::atan2(d.y, d.x).rem_euclid(PI);
        let half = ((theta / FRAC_PI_2).sqrt() * 90.0) as usize;
        let [difference, azimuth] = [theta_d / FRAC_PI_2 * 90.0, phi_d / PI * 180.0];
        let expected = (half * 90 + difference as usize) * 180 + azimuth as usize;
        assert_eq!(cell(wo, wi), expected);
    }

    proptest! {
        #[test]
        fn a_cell_is_the_same_when_the_directions_are_exchanged(a in any_direction(), b in any_direction()) {
            let up = |d: Direction| if d.z() < 0.0 { -d } else { d };
            prop_assert_eq!(cell(up(a), up(b)), cell(up(b), up(a)));
        }
    }

    #[test]
    fn missing_entries_are_black_and_bad_tables_are_refused() {
        let missing = Merl::new(vec![[-1.0; 3]; THETA * THETA * PHI]).unwrap();
        assert_eq!(missing.value(Direction::Z, Direction::Z), [0.0; 3]);
        assert_eq!(missing.pdf(Direction::Z, Direction::Z), FRAC_1_PI);
        let (needed, found) = (THETA * THETA * PHI, 1);
        assert_eq!(
            Merl::new(vec![[0.0; 3]]),
            Err(MeasuredError::Count { needed, found })
        );
        let mut values = vec![[0.0; 3]; needed];
        values[7][1] = f32::NAN;
        assert!(matches!(
            Merl::new(values),
            Err(MeasuredError::Value { index: 7, .. })
        ));
    }
}
