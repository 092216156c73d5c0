//! A record of a quantity: its values at some times.

use std::marker::PhantomData;

use super::profile::Profile;
use super::{Interval, Rate, Rule, Summary, TimeError};
use crate::quantity::{Quantity, Time};

/// Values at increasing times, and what lies between them.
///
/// ```
/// use steradian::quantity::{Energy, Flux, Time};
/// use steradian::time::{Rule, Series};
///
/// // An energy meter, read every hour: 2 kWh, 2.1 kWh, 2.4 kWh.
/// let readings = [2.0, 2.1, 2.4].map(|kwh| Energy::from_joules(kwh * 3.6e6));
/// let meter = Series::new([0.0, 1.0, 2.0].map(Time::from_hours).into_iter().zip(readings), Rule::Linear)?;
/// let mean = Series::<Flux>::from_meter(&meter)?;
/// assert!((mean.at(Time::from_hours(0.5))?.to_watts() - 100.0).abs() < 1e-9);
/// assert!((mean.at(Time::from_hours(1.5))?.to_watts() - 300.0).abs() < 1e-9);
/// # Ok::<(), steradian::time::TimeError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Series<Q> {
    profile: Profile,
    quantity: PhantomData<Q>,
}

impl<Q: Quantity> Series<Q> {
    /// A record of points.
    ///
    /// # Errors
    /// If there are fewer than two, times do not increase, or a number is not finite.
    pub fn new(points: impl IntoIterator<Item = (Time, Q)>, rule: Rule) -> Result<Self, TimeError> {
        let plain = |(time, value): (Time, Q)| (time.to_seconds(), value.to_si());
        Ok(Self {
            profile: Profile::new(points.into_iter().map(plain), rule)?,
            quantity: PhantomData,
        })
    }

    /// The points.
    pub fn points(&self) -> impl Iterator<Item = (Time, Q)> {
        self.profile
            .points()
            .map(|(time, value)| (Time::from_seconds(time), Q::from_si(value)))
    }

    /// What lies between the points.
    pub const fn rule(&self) -> Rule {
        self.profile.rule()
    }

    /// From the first to the last time.
    pub fn interval(&self) -> Interval {
        Interval::of_record(self.profile.ends())
    }

    /// The value at a time.
    ///
    /// # Errors
    /// If the record does not cover it.
    pub fn at(&self, time: Time) -> Result<Q, TimeError> {
        let time = time.to_seconds();
        self.profile.cover([time, time])?;
        Ok(Q::from_si(self.profile.at(time)))
    }
}

impl<R: Rate> Series<R> {
    /// The mean rates between the readings of a meter that counts, Φ = ΔQ/Δt, each held until the next reading.
    ///
    /// Their integral between two readings is what the meter counted.
    ///
    /// # Errors
    /// If a rate is beyond the range of numbers.
    pub fn from_meter(readings: &Series<R::Total>) -> Result<Self, TimeError> {
        let points: Vec<(Time, R::Total)> = readings.points().collect();
        let mut rates: Vec<(Time, R)> = points
            .windows(2)
            .map(|pair| {
                let counted = pair[1].1.to_si() - pair[0].1.to_si();
                (
                    pair[0].0,
                    R::Total::from_si(counted) / (pair[1].0 - pair[0].0),
                )
            })
            .collect();
        let end = rates
            .last()
            .map(|&(_, rate)| (readings.interval().to(), rate));
        rates.extend(end);
        Self::new(rates, Rule::Held)
    }

    /// Q = ∫ Φ dt over an interval.
    ///
    /// # Errors
    /// If the record does not cover the interval, or the integral is beyond the range of numbers.
    pub fn integral(&self, interval: Interval) -> Result<R::Total, TimeError> {
        self.profile.cover(interval.ends())?;
        let total = self.profile.integral(interval.ends());
        let total = total.is_finite().then_some(total);
        total.map(R::Total::from_si).ok_or(TimeError::Overflow)
    }

    /// Integral, mean and extremes over an interval.
    ///
    /// # Errors
    /// As [`Series::integral`].
    pub fn summary(&self, interval: Interval) -> Result<Summary<R>, TimeError> {
        let extremes = self.profile.extremes(interval.ends()).map(R::from_si);
        Ok(Summary::new(interval, self.integral(interval)?, extremes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::{Energy, Flux};
    use proptest::prelude::*;

    fn watts(points: &[(f64, f64)], rule: Rule) -> Result<Series<Flux>, TimeError> {
        let points = points.iter();
        Series::new(
            points.map(|&(s, w)| (Time::from_seconds(s), Flux::from_watts(w))),
            rule,
        )
    }

    fn interval(from: f64, to: f64) -> Interval {
        Interval::new(Time::from_seconds(from), Time::from_seconds(to)).unwrap()
    }

    const RECORD: [(f64, f64); 5] = [(0.0, 5.0), (1.0, 1.0), (3.0, 8.0), (4.0, 8.0), (10.0, 0.0)];

    #[test]
    fn lines_and_steps_have_their_own_integrals() {
        for (rule, joules, [least, greatest]) in [
            (Rule::Linear, 44.0, [0.0, 8.0]),
            (Rule::Held, 63.0, [1.0, 8.0]),
        ] {
            let record = watts(&RECORD, rule).unwrap();
            let summary = record.summary(record.interval()).unwrap();
            assert_eq!(summary.total, Energy::from_joules(joules));
            assert_eq!(summary.mean, Flux::from_watts(joules / 10.0));
            assert_eq!(
                [summary.least, summary.greatest],
                [least, greatest].map(Flux::from_watts)
            );
        }
    }

    #[test]
    fn an_interval_cuts_segments() {
        let part = interval(0.5, 3.5);
        let lines = watts(&RECORD, Rule::Linear).unwrap().summary(part).unwrap();
        // ½(3 + 1)½ + ½(1 + 8)2 + 8·½.
        assert_eq!(lines.total.to_joules(), 1.0 + 9.0 + 4.0);
        let steps = watts(&RECORD, Rule::Held).unwrap().summary(part).unwrap();
        assert_eq!(steps.total.to_joules(), 2.5 + 2.0 + 4.0);
        // What holds outside the interval is no extreme of it.
        let start = watts(&RECORD, Rule::Held)
            .unwrap()
            .summary(interval(0.0, 1.0));
        assert_eq!(start.unwrap().greatest, Flux::from_watts(5.0));
    }

    #[test]
    fn a_value_holds_until_the_next_time_and_the_last_ends_the_record() {
        let (lines, steps) = (
            watts(&RECORD, Rule::Linear).unwrap(),
            watts(&RECORD, Rule::Held).unwrap(),
        );
        for (time, line, step) in [
            (0.0, 5.0, 5.0),
            (2.0, 4.5, 1.0),
            (3.0, 8.0, 8.0),
            (10.0, 0.0, 0.0),
        ] {
            let time = Time::from_seconds(time);
            assert_eq!(lines.at(time).unwrap().to_watts(), line);
            assert_eq!(steps.at(time).unwrap().to_watts(), step);
        }
    }

    #[test]
    fn what_is_no_record_is_told() {
        let message = |points: &[(f64, f64)]| watts(points, Rule::Linear).unwrap_err().to_string();
        assert_eq!(message(&[]), "at least two points are needed, found 0");
        assert_eq!(
            message(&[(0.0, 1.0)]),
            "at least two points are needed, found 1"
        );
        assert_eq!(
            message(&[(0.0, 1.0), (2.0, 1.0), (2.0, 3.0)]),
            "times must increase: point 2 at 2 s follows 2 s"
        );
        assert!(
            message(&[(0.0, 1.0), (1.0, f64::NAN)]).contains("point 1 (1 s, NaN) is not finite")
        );
        assert!(message(&[(f64::NEG_INFINITY, 1.0), (1.0, 1.0)]).contains("not finite"));
        assert!(message(&[(-1e308, 1.0), (1e308, 1.0)]).contains("does not"));
    }

    #[test]
    fn outside_the_record_nothing_is_known() {
        let record = watts(&RECORD, Rule::Linear).unwrap();
        for part in [
            interval(-1.0, 5.0),
            interval(5.0, 10.5),
            interval(20.0, 30.0),
        ] {
            let message = record.integral(part).unwrap_err().to_string();
            assert!(
                message.contains("the record goes from 0 s to 10 s"),
                "{message}"
            );
        }
        assert!(record.at(Time::from_seconds(10.1)).is_err());
        let huge = watts(&[(0.0, 1e308), (1e3, 1e308)], Rule::Linear).unwrap();
        assert_eq!(huge.integral(interval(0.0, 1e3)), Err(TimeError::Overflow));
    }

    fn record() -> impl Strategy<Value = Vec<(f64, f64)>> {
        prop::collection::vec((0.1..10.0_f64, 0.0..100.0_f64), 2..30).prop_map(|steps| {
            let times = steps.iter().scan(-20.0, |time, step| {
                *time += step.0;
                Some(*time)
            });
            times.zip(steps.iter().map(|step| step.1)).collect()
        })
    }

    proptest! {
        /// Both sides are rounded some 30 times; values are positive, so nothing cancels.
        #[test]
        fn intervals_side_by_side_add_up(points in record(), cut in 0.01..0.99_f64, held: bool) {
            let rule = if held { Rule::Held } else { Rule::Linear };
            let series = watts(&points, rule).unwrap();
            let [from, to] = series.profile.ends();
            let middle = from + cut * (to - from);
            let part = |from, to| series.integral(interval(from, to)).unwrap().to_joules();
            let (whole, parts) = (part(from, to), part(from, middle) + part(middle, to));
            prop_assert!((whole - parts).abs() <= 1e-13 * whole.max(1.0), "{} {}", whole, parts);
        }

        /// Rounding of a reading is 2⁻⁵³ of the greatest.
        #[test]
        fn a_meter_gives_back_the_rates(points in record()) {
            let steps = watts(&points, Rule::Held).unwrap();
            let begin = points[0].0;
            let counted = points.iter().map(|&(time, _)| {
                let since = if time > begin { steps.profile.integral([begin, time]) } else { 0.0 };
                (Time::from_seconds(time), Energy::from_joules(since))
            });
            let meter = Series::new(counted.collect::<Vec<_>>(), Rule::Linear).unwrap();
            let rates = Series::<Flux>::from_meter(&meter).unwrap();
            let pairs = rates.points().zip(&points).take(points.len() - 1);
            for ((_, rate), (_, expected)) in pairs {
                // A reading of at most 3 × 10⁴ J is off by 4e-12 J, and two of them at least 0.1 s apart.
                prop_assert!((rate.to_watts() - expected).abs() <= 1e-10, "{} {}", rate, expected);
            }
        }
    }

    /// 3 million steps of .1 W over ⅛ s: times are exact, and what is left is the rounding of .1 and of the sum, where a
    /// plain sum is off by 1e-10.
    #[test]
    fn long_records_keep_their_digits() {
        let points: Vec<(f64, f64)> = (0..3_000_001)
            .map(|k| (f64::from(k) * 0.125, 0.1))
            .collect();
        let series = watts(&points, Rule::Held).unwrap();
        let total = series.integral(series.interval()).unwrap().to_joules();
        assert!(
            (total / 37_500.0 - 1.0).abs() <= 2.0 * f64::EPSILON,
            "{total:?}"
        );
    }
}
