//! A function of wavelength.
//!
//! Emission, reflectance, an observer and the response of a sensor are all [`Curve`]s: samples joined by straight lines.
//! What an instrument reads is the integral of a product of two of them,
//!
//! ```text
//! ∫ f(λ) g(λ) dλ   from λ₁ to λ₂ ,
//! ```
//!
//! a quadratic between neighbouring samples of either, which Simpson's rule integrates without error. The only error
//! left is rounding.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | λ | wavelength in air or vacuum, as the table has it | nm |
//! | f, g | emission a nm, reflectance, sensitivity | the author's |
//!
//! Outside its samples a curve is 0 ([`Beyond::Zero`]: a lamp emits only what its table shows) or keeps its last value
//! ([`Beyond::Held`]: a surface does not end at 780 nm). A `Zero` curve therefore jumps at its ends, where it still has
//! the value of its sample; integrals use the limit from the side they come from.

use thiserror::Error;

/// What a curve is outside its samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// 0, as emission and sensitivities are.
    Zero,
    /// The value of the nearest sample, as reflectances are.
    Held,
}

/// What samples can be wrong about.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CurveError {
    /// No sample at all.
    #[error("a spectrum needs at least one sample")]
    Empty,
    /// An infinite number or none.
    #[error("sample {index} ({wavelength} nm, {value}) is not finite")]
    NotFinite {
        /// Number of the sample, from 0.
        index: usize,
        /// Its wavelength in nm.
        wavelength: f64,
        /// Its value.
        value: f64,
    },
    /// Wavelengths that do not increase.
    #[error("wavelengths must increase: sample {index} at {wavelength} nm follows {previous} nm")]
    NotIncreasing {
        /// Number of the sample, from 0.
        index: usize,
        /// Its wavelength in nm.
        wavelength: f64,
        /// The wavelength before it in nm.
        previous: f64,
    },
    /// A range that is empty or a step that divides it into none or too many pieces.
    #[error(
        "{} to {} nm cannot be sampled every {step} nm: up to {MAX_STEPS} steps are", range[0], range[1]
    )]
    Sampling {
        /// First and last wavelength in nm.
        range: [f64; 2],
        /// Distance between samples in nm.
        step: f64,
    },
    /// A temperature that no body has.
    #[error("a temperature is positive and finite, not {0} K")]
    Temperature(f64),
    /// A temperature for which daylight is not defined.
    #[error("daylight is defined from 4000 K to 25000 K, not at {0} K")]
    Daylight(f64),
}

/// Steps that [`Curve::from_function`] takes at most.
pub const MAX_STEPS: usize = 1_000_000;

/// A piecewise linear function of wavelength.
///
/// ```
/// use steradian::spectrum::{Beyond, Curve};
///
/// let lamp = Curve::new(vec![(400.0, 0.0), (500.0, 2.0), (600.0, 2.0)], Beyond::Zero)?;
/// assert_eq!((lamp.at(450.0), lamp.at(600.0), lamp.at(601.0)), (1.0, 2.0, 0.0));
/// assert_eq!(lamp.integral([0.0, 1000.0]), 100.0 + 200.0);
/// let filter = Curve::new(vec![(400.0, 0.0), (500.0, 1.0)], Beyond::Held)?;
/// // From 400 to 500 nm 2 t² with t = (λ − 400)/100: 2/3 of 100 nm. Above, 2 · 1.
/// assert!((lamp.product_integral(&filter, [400.0, 700.0]) - (200.0 / 3.0 + 200.0)).abs() < 1e-12);
/// # Ok::<(), steradian::spectrum::CurveError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    wavelengths: Vec<f64>,
    values: Vec<f64>,
    beyond: Beyond,
}

impl Curve {
    /// A curve through samples (wavelength in nm, value) in the order of increasing wavelength.
    pub fn new(samples: Vec<(f64, f64)>, beyond: Beyond) -> Result<Self, CurveError> {
        if samples.is_empty() {
            return Err(CurveError::Empty);
        }
        for (index, &(wavelength, value)) in samples.iter().enumerate() {
            if !(wavelength.is_finite() && value.is_finite()) {
                return Err(CurveError::NotFinite {
                    index,
                    wavelength,
                    value,
                });
            }
            if index > 0 && wavelength <= samples[index - 1].0 {
                return Err(CurveError::NotIncreasing {
                    index,
                    wavelength,
                    previous: samples[index - 1].0,
                });
            }
        }
        let (wavelengths, values) = samples.into_iter().unzip();
        Ok(Self {
            wavelengths,
            values,
            beyond,
        })
    }

    /// The same value at every wavelength. Its one sample lies at 555 nm.
    pub fn constant(value: f64) -> Self {
        Self {
            wavelengths: vec![555.0],
            values: vec![value],
            beyond: Beyond::Held,
        }
    }

    /// A function sampled at equal distances of at most `step` nm, both ends of `range` among them.
    pub fn from_function(
        range: [f64; 2],
        step: f64,
        beyond: Beyond,
        function: impl Fn(f64) -> f64,
    ) -> Result<Self, CurveError> {
        let [low, high] = range;
        // The allowance keeps 400 nm in steps of 0.1 nm from becoming 4001 steps by rounding.
        let steps = ((high - low) / step - 1e-9).ceil();
        if !(low.is_finite() && step > 0.0 && steps >= 1.0 && steps <= MAX_STEPS as f64) {
            return Err(CurveError::Sampling { range, step });
        }
        let at = |index: usize| low + (high - low) * (index as f64 / steps);
        let samples = (0..=steps as usize).map(|index| (at(index), function(at(index))));
        Self::new(samples.collect(), beyond)
    }

    /// Wavelengths of the samples in nm.
    pub fn wavelengths(&self) -> &[f64] {
        &self.wavelengths
    }

    /// Values of the samples.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// What the curve is outside its samples.
    pub fn beyond(&self) -> Beyond {
        self.beyond
    }

    /// Wavelengths of the first and the last sample in nm.
    pub fn range(&self) -> [f64; 2] {
        [self.wavelengths[0], self.wavelengths[self.last()]]
    }

    /// The greatest value among the samples.
    pub fn max(&self) -> f64 {
        self.values
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// The least value among the samples.
    pub fn min(&self) -> f64 {
        self.values.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The value at a wavelength in nm.
    pub fn at(&self, wavelength: f64) -> f64 {
        let above = self.wavelengths.partition_point(|w| *w <= wavelength);
        let [low, high] = self.range();
        if self.beyond == Beyond::Zero && !(low <= wavelength && wavelength <= high) {
            return 0.0;
        }
        if above == 0 || above > self.last() {
            return self.values[above.min(self.last())];
        }
        let (start, end) = (self.wavelengths[above - 1], self.wavelengths[above]);
        let t = (wavelength - start) / (end - start);
        self.values[above - 1] * (1.0 - t) + self.values[above] * t
    }

    /// The curve multiplied by a number.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            values: self.values.iter().map(|value| value * factor).collect(),
            ..self.clone()
        }
    }

    /// The same samples, and this outside them.
    #[must_use]
    pub fn with_beyond(&self, beyond: Beyond) -> Self {
        Self {
            beyond,
            ..self.clone()
        }
    }

    /// The product at the samples of both curves, joined by straight lines.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let all = [f64::NEG_INFINITY, f64::INFINITY];
        let mut wavelengths = breakpoints(&[self, other], all);
        wavelengths.retain(|wavelength| wavelength.is_finite());
        let values = wavelengths.iter().map(|&at| self.at(at) * other.at(at));
        let beyond = match (self.beyond, other.beyond) {
            (Beyond::Held, Beyond::Held) => Beyond::Held,
            _ => Beyond::Zero,
        };
        Self {
            values: values.collect(),
            wavelengths,
            beyond,
        }
    }

    /// ∫ f dλ over `range` in nm; 0 if the range is empty.
    pub fn integral(&self, range: [f64; 2]) -> f64 {
        self.product_integral(&Self::constant(1.0), range)
    }

    /// ∫ f g dλ over `range` in nm; 0 if the range is empty.
    pub fn product_integral(&self, other: &Self, range: [f64; 2]) -> f64 {
        let places = breakpoints(&[self, other], range);
        let pieces = places.windows(2).map(|piece| {
            let (start, end) = (piece[0], piece[1]);
            let [f0, f1] = self.limits(start, end);
            let [g0, g1] = other.limits(start, end);
            let simpson = 2.0 * (f0 * g0 + f1 * g1) + f0 * g1 + f1 * g0;
            (end - start) * simpson / 6.0
        });
        pieces.sum()
    }

    /// The values at both ends of an interval without samples inside, each the limit from within.
    pub(super) fn limits(&self, start: f64, end: f64) -> [f64; 2] {
        let [low, high] = self.range();
        if self.beyond == Beyond::Zero && (end <= low || start >= high) {
            return [0.0; 2];
        }
        [self.at(start), self.at(end)]
    }

    fn last(&self) -> usize {
        self.wavelengths.len() - 1
    }
}

/// The ends of `range` and the samples of all curves between them, in order; none if the range is empty.
pub(super) fn breakpoints(curves: &[&Curve], [low, high]: [f64; 2]) -> Vec<f64> {
    let inside = |w: &f64| low < *w && *w < high;
    let samples = curves.iter().flat_map(|curve| &curve.wavelengths);
    let mut places: Vec<f64> = samples.copied().filter(inside).collect();
    if low < high {
        places.extend([low, high]);
    }
    places.sort_by(f64::total_cmp);
    places.dedup();
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn curve(samples: &[(f64, f64)], beyond: Beyond) -> Curve {
        Curve::new(samples.to_vec(), beyond).unwrap()
    }

    #[test]
    fn wrong_samples_are_named() {
        assert_eq!(Curve::new(vec![], Beyond::Zero), Err(CurveError::Empty));
        let repeated = Curve::new(vec![(400.0, 1.0), (400.0, 2.0)], Beyond::Zero);
        assert_eq!(
            repeated.unwrap_err().to_string(),
            "wavelengths must increase: sample 1 at 400 nm follows 400 nm"
        );
        let infinite = Curve::new(vec![(400.0, 1.0), (401.0, f64::INFINITY)], Beyond::Zero);
        assert!(matches!(
            infinite,
            Err(CurveError::NotFinite { index: 1, .. })
        ));
        assert!(Curve::new(vec![(f64::NAN, 1.0)], Beyond::Zero).is_err());
    }

    #[test]
    fn what_cannot_be_sampled_is_refused() {
        for (range, step) in [
            ([400.0, 400.0], 1.0),
            ([500.0, 400.0], 1.0),
            ([400.0, 500.0], 0.0),
            ([400.0, 500.0], -1.0),
            ([400.0, f64::INFINITY], 1.0),
            ([400.0, 500.0], f64::NAN),
            ([400.0, 500.0], 1e-9),
        ] {
            let sampled = Curve::from_function(range, step, Beyond::Zero, |_| 1.0);
            assert!(matches!(sampled, Err(CurveError::Sampling { .. })));
        }
        let tenths = Curve::from_function([400.0, 440.0], 0.1, Beyond::Zero, |w| w).unwrap();
        assert_eq!(tenths.values().len(), 401);
        assert_eq!(tenths.range(), [400.0, 440.0]);
    }

    #[test]
    fn a_table_of_emission_ends_with_a_jump() {
        let lamp = curve(&[(400.0, 3.0), (410.0, 1.0)], Beyond::Zero);
        assert_eq!(
            (lamp.at(400.0), lamp.at(399.9), lamp.at(410.0)),
            (3.0, 0.0, 1.0)
        );
        assert_eq!(lamp.integral([300.0, 400.0]), 0.0);
        assert_eq!(lamp.integral([300.0, 410.0]), 20.0);
        assert_eq!(lamp.integral([405.0, 900.0]), 7.5);
        let held = curve(&[(400.0, 3.0), (410.0, 1.0)], Beyond::Held);
        assert_eq!(held.integral([390.0, 420.0]), 30.0 + 20.0 + 10.0);
        assert_eq!((held.at(0.0), held.at(9e9)), (3.0, 1.0));
    }

    #[test]
    fn tables_that_touch_share_nothing() {
        let left = curve(&[(400.0, 1.0), (500.0, 1.0)], Beyond::Zero);
        let right = curve(&[(500.0, 1.0), (600.0, 1.0)], Beyond::Zero);
        assert_eq!(left.product_integral(&right, [0.0, 1000.0]), 0.0);
        let line = curve(&[(450.0, 7.0)], Beyond::Zero);
        assert_eq!((line.at(450.0), line.integral([400.0, 500.0])), (7.0, 0.0));
        assert_eq!(left.integral([500.0, 400.0]), 0.0);
    }

    fn any_curve() -> impl Strategy<Value = Curve> {
        let sample = (0.5..40.0, -2.0..2.0);
        (proptest::collection::vec(sample, 1..12), any::<bool>()).prop_map(|(steps, zero)| {
            let mut wavelength = 380.0;
            let samples = steps.into_iter().map(|(step, value)| {
                wavelength += step;
                (wavelength, value)
            });
            let beyond = if zero { Beyond::Zero } else { Beyond::Held };
            Curve::new(samples.collect(), beyond).unwrap()
        })
    }

    proptest! {
        /// A midpoint sum of n intervals misses at most by the intervals that hold a kink or a jump and by h² of the
        /// rest: 26 breakpoints, products up to 4, slopes of f up to 4/0.5 a nm.
        #[test]
        fn integrals_agree_with_a_sum(a in any_curve(), b in any_curve(), low in 350.0..500.0, length in 1.0..400.0) {
            let n = 100_000;
            let h = length / f64::from(n);
            let sum: f64 = (0..n).map(|i| {
                let w = low + (f64::from(i) + 0.5) * h;
                a.at(w) * b.at(w)
            }).sum::<f64>() * h;
            let bound = 26.0 * h * 8.0 + h * h * 128.0 / 12.0 * length;
            prop_assert!((a.product_integral(&b, [low, low + length]) - sum).abs() < bound);
        }

        /// Rounding of at most 100 terms of size 4 · 400.
        #[test]
        fn integrals_add_up(a in any_curve(), b in any_curve(), low in 350.0..500.0, cut in 0.0..1.0) {
            let middle = low + cut * 300.0;
            let whole = a.product_integral(&b, [low, low + 300.0]);
            let parts = a.product_integral(&b, [low, middle]) + b.product_integral(&a, [middle, low + 300.0]);
            prop_assert!((whole - parts).abs() < 1e-9);
            let twice = a.scaled(2.0).product_integral(&b, [low, low + 300.0]);
            prop_assert!((twice - 2.0 * whole).abs() < 1e-9);
        }
    }
}
