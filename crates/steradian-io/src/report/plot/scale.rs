//! From numbers to places along an axis: ends, ticks and their labels.
//!
//! A linear scale has ticks at the multiples of 1, 2 or 5 · 10ⁿ that give four to nine of them; a logarithmic one at powers
//! of ten, and at 2 and 5 times these where it spans less than two decades. Ends that nobody asked for are ticks.

use super::axis::Axis;
use crate::report::numbers::significant;

/// About how many ticks there shall be.
const TICKS: f64 = 6.0;
const MOST_TICKS: f64 = 100.0;
/// Ticks of a logarithmic scale that are written without an exponent.
const PLAIN: std::ops::RangeInclusive<f64> = 0.999e-2..=1.001e3;
/// A tick that rounding puts this part of a step beyond an end still counts.
const SLACK: f64 = 1e-9;

/// The scale of an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    ends: [f64; 2],
    ticks: Vec<f64>,
    is_logarithmic: bool,
}

impl Scale {
    /// The scale of this axis for data from `low` to `high`, which must be finite, and positive if it is logarithmic.
    pub fn new(axis: &Axis, [low, high]: [f64; 2]) -> Self {
        if axis.is_logarithmic {
            return Self::logarithmic(axis.range, [low, high]);
        }
        let [from, to] = axis.range.unwrap_or_else(|| apart([low, high]));
        let fits = |step: &f64| *step > 0.0 && (to - from) / step <= MOST_TICKS;
        let step = axis
            .step
            .filter(fits)
            .unwrap_or_else(|| round_step((to - from) / TICKS));
        let ends = axis.range.unwrap_or([
            (from / step + SLACK).floor() * step,
            (to / step - SLACK).ceil() * step,
        ]);
        let (first, last) = (
            (ends[0] / step - SLACK).ceil(),
            (ends[1] / step + SLACK).floor(),
        );
        let ticks = (0..=(last - first) as u32)
            .map(|k| (first + f64::from(k)) * step)
            .collect();
        Self {
            ends,
            ticks,
            is_logarithmic: false,
        }
    }

    fn logarithmic(range: Option<[f64; 2]>, [low, high]: [f64; 2]) -> Self {
        let [from, to] = range.unwrap_or([low, high]).map(libm::log10);
        let mantissas: &[f64] = if to - from < 2.0 {
            &[1.0, 2.0, 5.0]
        } else {
            &[1.0]
        };
        let stride = ((to - from) / (2.0 * TICKS)).ceil().max(1.0) as usize;
        let decades = (from.floor() as i32 - 1..=to.ceil() as i32 + 1).step_by(stride);
        let all: Vec<f64> = decades
            .flat_map(|decade| {
                mantissas
                    .iter()
                    .map(move |m| m * libm::pow(10.0, f64::from(decade)))
            })
            .collect();
        let ends = range.unwrap_or_else(|| around(&all, [low, high]));
        let is_within =
            |tick: &f64| ends[0] * (1.0 - SLACK) <= *tick && *tick <= ends[1] * (1.0 + SLACK);
        Self {
            ends,
            ticks: all.into_iter().filter(is_within).collect(),
            is_logarithmic: true,
        }
    }

    /// Where a value lies: 0 at the first end, 1 at the last.
    pub fn position(&self, value: f64) -> f64 {
        let [from, to] = self.ends;
        if self.is_logarithmic {
            return libm::log10(value / from) / libm::log10(to / from);
        }
        (value - from) / (to - from)
    }

    /// The numbers that have ticks.
    pub fn tick_values(&self) -> &[f64] {
        &self.ticks
    }

    /// Places of the ticks with their labels.
    pub fn ticks(&self) -> impl Iterator<Item = (f64, String)> {
        self.ticks
            .iter()
            .map(|&tick| (self.position(tick), self.label(tick)))
    }

    fn label(&self, tick: f64) -> String {
        let is_power = self.is_logarithmic && !PLAIN.contains(&tick);
        if !is_power {
            return significant(if tick == 0.0 { 0.0 } else { tick }, 6).replace('-', "−");
        }
        let decade = (libm::log10(tick) + SLACK).floor();
        let mantissa = tick / libm::pow(10.0, decade);
        let factor = if mantissa < 1.5 {
            String::new()
        } else {
            format!("{mantissa:.0}·")
        };
        format!("{factor}10{}", superscript(decade as i32))
    }
}

/// The ends of a range, apart by at least a little.
fn apart([low, high]: [f64; 2]) -> [f64; 2] {
    if high - low > 1e-12 * low.abs().max(high.abs()) {
        return [low, high];
    }
    let margin = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
    [low - margin, high + margin]
}

/// The least of 1, 2 and 5 · 10ⁿ that is at least `step`.
pub fn round_step(step: f64) -> f64 {
    let decade = libm::pow(10.0, libm::log10(step).floor());
    let factor = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|factor| factor * decade >= step * (1.0 - SLACK));
    factor.unwrap_or(10.0) * decade
}

/// The last tick at or below and the first at or above, at least one step apart.
fn around(ticks: &[f64], [low, high]: [f64; 2]) -> [f64; 2] {
    let below = ticks
        .iter()
        .rposition(|tick| *tick <= low * (1.0 + SLACK))
        .unwrap_or(0);
    let above = ticks
        .iter()
        .position(|tick| *tick >= high * (1.0 - SLACK))
        .unwrap_or(ticks.len() - 1);
    [ticks[below.min(above.saturating_sub(1))], ticks[above]]
}

fn superscript(number: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |c: char| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    number.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn labels(axis: &Axis, data: [f64; 2]) -> Vec<String> {
        Scale::new(axis, data)
            .ticks()
            .map(|(_, label)| label)
            .collect()
    }

    #[test]
    fn linear_ticks_are_round() {
        let axis = Axis::new("x", "");
        assert_eq!(labels(&axis, [0.0, 1.3]), ["0", "0.5", "1", "1.5"]);
        assert_eq!(
            labels(&axis, [-0.1, 0.3]),
            ["−0.1", "0", "0.1", "0.2", "0.3"]
        );
        assert_eq!(
            labels(&axis, [3.0, 3.0]),
            ["1.5", "2", "2.5", "3", "3.5", "4", "4.5"]
        );
        let degrees = axis.from_to(0.0, 90.0).tick_every(15.0);
        assert_eq!(
            labels(&degrees, [0.0, 80.0]),
            ["0", "15", "30", "45", "60", "75", "90"]
        );
    }

    #[test]
    fn logarithmic_ticks_are_powers_of_ten() {
        let axis = Axis::new("x", "").logarithmic();
        assert_eq!(
            labels(&axis, [3e-4, 40.0]),
            ["10⁻⁴", "10⁻³", "0.01", "0.1", "1", "10", "100"]
        );
        assert_eq!(labels(&axis, [3.0, 40.0]), ["2", "5", "10", "20", "50"]);
        assert_eq!(labels(&axis, [2e-5, 2e-5]), ["10⁻⁵", "2·10⁻⁵"]);
        assert!(labels(&axis, [1e-30, 1e30]).len() <= 14);
    }

    proptest! {
        #[test]
        fn data_and_ticks_lie_between_the_ends(low in -1e6..1e6_f64, width in 0.0..1e6_f64, is_logarithmic: bool) {
            let mut axis = Axis::new("x", "");
            axis.is_logarithmic = is_logarithmic;
            let low = if is_logarithmic { low.abs() + 1e-6 } else { low };
            let scale = Scale::new(&axis, [low, low + width]);
            let places = scale.ticks().map(|tick| tick.0).chain([scale.position(low), scale.position(low + width)]);
            for place in places {
                prop_assert!((-1e-8..=1.0 + 1e-8).contains(&place), "{place} {scale:?}");
            }
            prop_assert!((2..=20).contains(&scale.ticks().count()), "{scale:?}");
        }
    }
}
