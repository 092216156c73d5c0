//! Numbers that catalogues state of a luminaire.
//!
//! | figure | law |
//! |---|---|
//! | beam angle, field angle | how far I stays above ½, 1/10 of its maximum in one plane, C and C + 180° together |
//! | N₁, N₂, N₃ | flux below π/2, π, 3π/2 sr about the nadir (γ = 41.4°, 60°, 75.5°) over that below 2π sr (90°) |
//! | N₄ | flux below 2π sr over the whole: the downward flux fraction |
//! | N₅ | flux over that of the lamps: the light output ratio |
//!
//! Source: CIE 17.4 (1987), 845-09-37 (beam spread); CIE 52-1982 (flux code); ANSI/IES LS-1 (field angle).

use std::f64::consts::PI;

use super::FarField;

/// Upper ends of the cones of the flux code: cosγ = ¾, ½, ¼, 0.
const CONES: [f64; 4] = [0.75, 0.5, 0.25, 0.0];

impl FarField {
    /// N₁ … N₄ of the flux code; `None` of a lamp that sends nothing down.
    pub fn flux_code(&self) -> Option<[f64; 4]> {
        let [first, second, third, down] = CONES.map(|cos| self.flux_within(libm::acos(cos)));
        (down > 0.0).then(|| {
            [
                first / down,
                second / down,
                third / down,
                down / self.flux(),
            ]
        })
    }

    /// The full angle in rad in which I in the plane of `azimuth` is at least this part of its maximum there.
    ///
    /// It is the angle about the maximum; `None` of a plane without light. The steps of the table bound the place of the maximum,
    /// which is a node.
    pub fn spread(&self, azimuth: f64, part: f64) -> Option<f64> {
        let angles = self.angles_of_plane();
        let at = |angle: f64| self.in_plane(azimuth, angle);
        let (mut best, mut most) = (0, 0.0);
        for (index, &angle) in angles.iter().enumerate() {
            // Of equal nodes the one nearest to the nadir.
            let (value, nearer) = (at(angle), angle.abs() < angles[best].abs());
            if value > most || (value == most && nearer) {
                (best, most) = (index, value);
            }
        }
        if most <= 0.0 {
            return None;
        }
        let level = part * most;
        let after = angles[best..].windows(2);
        let after = after.map(|pair| [pair[0], pair[1]]);
        let before = angles[..=best].windows(2).rev();
        let before = before.map(|pair| [pair[1], pair[0]]);
        let up = crossing(after, at, level).unwrap_or(angles[angles.len() - 1]);
        let down = crossing(before, at, level).unwrap_or(angles[0]);
        Some(up - down)
    }

    /// Signed angles from the nadir, −π … π, at which the table has nodes, and both sides of its ends.
    fn angles_of_plane(&self) -> Vec<f64> {
        let [_, polars] = self.nodes();
        let below = polars.iter().rev().map(|polar| -polar);
        let mut angles: Vec<f64> = below.chain(polars.iter().copied()).collect();
        angles.dedup();
        angles
    }

    /// I at a signed angle: negative ones are in the half plane opposite.
    fn in_plane(&self, azimuth: f64, angle: f64) -> f64 {
        let azimuth = if angle < 0.0 { azimuth + PI } else { azimuth };
        self.at_angles(azimuth, angle.abs())
    }
}

/// Where the first of these steps passes below a level.
fn crossing(
    mut steps: impl Iterator<Item = [f64; 2]>,
    at: impl Fn(f64) -> f64,
    level: f64,
) -> Option<f64> {
    steps.find_map(|[from, to]| {
        let (high, low) = (at(from), at(to));
        (low < level).then(|| from + (to - from) * (high - level) / (high - low))
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::light::Planes;

    fn rotational(polars: &[f64], values: &[f64]) -> FarField {
        let twice: Vec<f64> = values.iter().chain(values).copied().collect();
        FarField::new(Planes::C, &[0.0, 360.0], polars, &twice).unwrap()
    }

    /// Even light: below a cone goes 1 − cosγ of what goes below the horizontal.
    #[test]
    fn flux_code_of_even_light() {
        let code = rotational(&[0.0, 180.0], &[1.0, 1.0]).flux_code().unwrap();
        let expected = [0.25, 0.5, 0.75, 0.5];
        assert!(
            (0..4).all(|k| (code[k] - expected[k]).abs() < 1e-14),
            "{code:?}"
        );
        assert_eq!(rotational(&[90.0, 180.0], &[0.0, 1.0]).flux_code(), None);
    }

    /// I falls from 100 to 0 in 40°: a half at 20°, a tenth at 36°, to both sides.
    #[test]
    fn spread_of_a_triangle() {
        let lamp = rotational(&[0.0, 40.0, 90.0], &[100.0, 0.0, 0.0]);
        let degrees = |part: f64| lamp.spread(0.3, part).unwrap().to_degrees();
        assert!((degrees(0.5) - 40.0).abs() < 1e-12);
        assert!((degrees(0.1) - 72.0).abs() < 1e-12);
    }

    /// The greatest intensity lies aside in C90; C0, C180 and C270 are dark.
    #[test]
    fn spread_of_a_slanted_beam() {
        let mut values = [0.0; 16];
        values[5] = 80.0;
        let azimuths = [0.0, 90.0, 180.0, 360.0];
        let lamp = FarField::new(Planes::C, &azimuths, &[0.0, 20.0, 40.0, 60.0], &values);
        let lamp = lamp.unwrap();
        let spread = lamp.spread(FRAC_PI_2, 0.5).unwrap().to_degrees();
        assert!((spread - 20.0).abs() < 1e-12, "{spread}");
        assert_eq!(lamp.spread(0.0, 0.5), None);
    }

    #[test]
    fn light_that_ends_at_full_strength_spreads_to_the_end() {
        let lamp = rotational(&[0.0, 60.0], &[1.0, 1.0]);
        assert!((lamp.spread(0.0, 0.5).unwrap().to_degrees() - 120.0).abs() < 1e-12);
        assert_eq!(lamp.flux_within(FRAC_PI_2), lamp.flux());
    }
}
