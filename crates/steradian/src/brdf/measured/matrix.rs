//! A matrix of values, constant on patches of incidence × patches of scattering.

use super::MeasuredError;
use super::basis::{AngleBasis, DiscPoint};

/// Values in 1/sr of light that arrives in one patch and leaves in another.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchMatrix {
    incident: AngleBasis,
    scattered: AngleBasis,
    /// Row by row: a row holds the values of one patch of scattering.
    values: Vec<f32>,
    /// For each patch of scattering, ∫ ρ cosθ dω over the patches of incidence up to and with each.
    cumulative: Vec<f64>,
    /// Whether the roles of incidence and scattering were exchanged, which turns both directions about the normal.
    turned: bool,
}

impl PatchMatrix {
    /// From values in 1/sr, row by row: a row holds those of one patch of scattering.
    ///
    /// # Errors
    /// If there are too few or too many values, or one is negative or not finite.
    pub fn new(
        incident: AngleBasis,
        scattered: AngleBasis,
        values: Vec<f32>,
    ) -> Result<Self, MeasuredError> {
        let needed = incident.patches() * scattered.patches();
        if values.len() != needed {
            let found = values.len();
            return Err(MeasuredError::Count { needed, found });
        }
        super::check_values(&values)?;
        Ok(Self::from_sound(incident, scattered, values, false))
    }

    fn from_sound(
        incident: AngleBasis,
        scattered: AngleBasis,
        values: Vec<f32>,
        turned: bool,
    ) -> Self {
        let width = incident.patches();
        let angles: Vec<_> = (0..width)
            .map(|patch| incident.projected_solid_angle(patch))
            .collect();
        let mut cumulative = Vec::with_capacity(values.len());
        for row in values.chunks(width) {
            let mut sum = 0.0;
            cumulative.extend(row.iter().zip(&angles).map(|(value, angle)| {
                sum += f64::from(*value) * angle;
                sum
            }));
        }
        Self {
            incident,
            scattered,
            values,
            cumulative,
            turned,
        }
    }

    /// The same surface for light that goes the other way, if it is reciprocal.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let (width, height) = (self.incident.patches(), self.scattered.patches());
        let at = |k: usize| self.values[k % height * width + k / height];
        let values = (0..width * height).map(at).collect();
        Self::from_sound(
            self.scattered.clone(),
            self.incident.clone(),
            values,
            !self.turned,
        )
    }

    /// Patches of incidence.
    pub fn incident(&self) -> &AngleBasis {
        &self.incident
    }

    /// Patches of scattering.
    pub fn scattered(&self) -> &AngleBasis {
        &self.scattered
    }

    /// The value in 1/sr of two patches.
    pub fn at(&self, scattered: usize, incident: usize) -> f64 {
        f64::from(self.values[scattered * self.incident.patches() + incident])
    }

    /// The directional-hemispherical value of light that arrives in a patch: Σ ρ Ω over the patches of scattering.
    pub fn hemispherical(&self, incident: usize) -> f64 {
        let angle = |patch| self.scattered.projected_solid_angle(patch);
        (0..self.scattered.patches())
            .map(|patch| self.at(patch, incident) * angle(patch))
            .sum()
    }

    pub(super) fn value(&self, scattered: DiscPoint, incident: DiscPoint) -> f64 {
        let row = self.scattered.patch(self.oriented(scattered));
        let column = self.incident.patch(self.oriented(incident));
        match (row, column) {
            (Some(row), Some(column)) => self.at(row, column),
            _ => 0.0,
        }
    }

    pub(super) fn hemispherical_at(&self, incident: DiscPoint) -> f64 {
        let patch = self.incident.patch(self.oriented(incident));
        patch.map_or(0.0, |patch| self.hemispherical(patch))
    }

    /// ∫ ρ cosθ dω over all incidence.
    pub(super) fn total(&self, scattered: DiscPoint) -> f64 {
        let row = self.row(scattered);
        row.and_then(|sums| sums.last().copied()).unwrap_or(0.0)
    }

    /// Incidence of density ρ/total on the disc.
    pub(super) fn sample(&self, scattered: DiscPoint, u: [f64; 2]) -> Option<DiscPoint> {
        let sums = self.row(scattered)?;
        let wanted = u[0] * sums.last()?;
        let patch = sums.partition_point(|sum| *sum <= wanted);
        let before = if patch == 0 { 0.0 } else { sums[patch - 1] };
        let within = (wanted - before) / (*sums.get(patch)? - before);
        Some(self.oriented(self.incident.point(patch, [within, u[1]])))
    }

    fn row(&self, scattered: DiscPoint) -> Option<&[f64]> {
        let width = self.incident.patches();
        let patch = self.scattered.patch(self.oriented(scattered))?;
        self.cumulative.get(patch * width..(patch + 1) * width)
    }

    fn oriented(&self, [x, y]: DiscPoint) -> DiscPoint {
        match self.turned {
            true => [-x, -y],
            false => [x, y],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quarter() -> AngleBasis {
        AngleBasis::named("LBNL/Klems Quarter").remove(0)
    }

    #[test]
    fn a_constant_matrix_is_lambertian() {
        let values = vec![0.25; 41 * 41];
        let matrix = PatchMatrix::new(quarter(), quarter(), values).unwrap();
        let expected = 0.25 * std::f64::consts::PI;
        assert!((matrix.hemispherical(7) - expected).abs() < 1e-13);
        assert!((matrix.total([0.3, 0.1]) - expected).abs() < 1e-13);
        assert_eq!(matrix.value([0.3, 0.1], [0.0, 0.9]), 0.25);
    }

    #[test]
    fn reversing_exchanges_the_directions() {
        let values: Vec<f32> = (0..41 * 41).map(|k| k as f32).collect();
        let matrix = PatchMatrix::new(quarter(), quarter(), values).unwrap();
        let (a, b) = ([0.31, 0.2], [-0.6, 0.41]);
        let turned = |[x, y]: DiscPoint| [-x, -y];
        assert_eq!(
            matrix.reversed().value(turned(a), turned(b)),
            matrix.value(b, a)
        );
        assert_eq!(matrix.reversed().reversed(), matrix);
    }

    #[test]
    fn a_matrix_of_the_wrong_size_or_with_bad_values_is_refused() {
        let build = |values| PatchMatrix::new(quarter(), quarter(), values).unwrap_err();
        let (needed, found) = (1681, 4);
        assert_eq!(build(vec![0.0; 4]), MeasuredError::Count { needed, found });
        for bad in [-1.0, f32::NAN, f32::INFINITY] {
            let mut values = vec![0.0; 1681];
            values[3] = bad;
            assert!(matches!(
                build(values),
                MeasuredError::Value { index: 3, .. }
            ));
        }
    }
}
