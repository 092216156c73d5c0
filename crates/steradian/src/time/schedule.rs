//! How much of its full light a lamp gives in the course of time.
//!
//! A lamp whose light at full power adds E to a reading adds E f(t) when its schedule's factor is f(t), for light is
//! linear in its sources. Over an interval it adds
//!
//! ```text
//! H = E ∫ f(t) dt ,
//! ```
//!
//! the reading at full power times the [*full-power time*](Schedule::full_power_time) of the schedule: 4 h at one half are
//! 2 h at full power.

use serde::{Deserialize, Serialize};

use super::cycle::Cycle;
use super::profile::Profile;
use super::{Interval, Rule, TimeError};
use crate::quantity::Time;

/// Factors at increasing times, what lies between them, and whether they repeat.
///
/// ```
/// use steradian::quantity::Time;
/// use steradian::time::{Interval, Rule, Schedule};
///
/// // On for the first quarter of an hour, every hour.
/// let points = [(Time::ZERO, 1.0), (Time::from_hours(0.25), 0.0)];
/// let quarter = Schedule::new(points, Rule::Held, Some(Time::from_hours(1.0)))?;
/// let day = Interval::lasting(Time::from_hours(8.0), Time::ZERO)?;
/// assert_eq!(quarter.full_power_time(day)?, Time::from_hours(2.0));
/// assert_eq!(quarter.at(Time::from_hours(5.1))?, 1.0);
/// # Ok::<(), steradian::time::TimeError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Unchecked")]
pub struct Schedule {
    profile: Profile,
    period: Option<f64>,
}

/// What a file says.
#[derive(Deserialize)]
struct Unchecked {
    profile: Profile,
    period: Option<f64>,
}

impl TryFrom<Unchecked> for Schedule {
    type Error = TimeError;

    fn try_from(file: Unchecked) -> Result<Self, TimeError> {
        let points = file.profile.points();
        let points = points.map(|(time, factor)| (Time::from_seconds(time), factor));
        let period = file.period.map(Time::from_seconds);
        Self::new(points, file.profile.rule(), period)
    }
}

impl Schedule {
    /// A schedule through points of time and factor; with a `period` they repeat, the first following the last (by a straight
    /// line if the rule is linear).
    ///
    /// # Errors
    /// If there are fewer than two points, times do not increase, a number is not finite, a factor is negative, or the
    /// points do not fit into the period.
    pub fn new(
        points: impl IntoIterator<Item = (Time, f64)>,
        rule: Rule,
        period: Option<Time>,
    ) -> Result<Self, TimeError> {
        let plain = |(time, factor): (Time, f64)| (time.to_seconds(), factor);
        let profile = Profile::new(points.into_iter().map(plain), rule)?;
        if let Some((index, (time, value))) =
            profile.points().enumerate().find(|(_, (_, f))| *f < 0.0)
        {
            return Err(TimeError::Negative { index, time, value });
        }
        match period.map(Time::to_seconds) {
            None => Ok(Self {
                profile,
                period: None,
            }),
            Some(period) => Ok(Self {
                profile: closed(&profile, period)?,
                period: Some(period),
            }),
        }
    }

    /// The factor at a time.
    ///
    /// # Errors
    /// If the schedule has no period and does not cover it.
    pub fn at(&self, time: Time) -> Result<f64, TimeError> {
        let time = time.to_seconds();
        if let Some(cycle) = self.cycle() {
            let (_, since) = cycle.split(time);
            return Ok(self
                .profile
                .at((cycle.start + since).min(self.profile.ends()[1])));
        }
        self.profile.cover([time, time])?;
        Ok(self.profile.at(time))
    }

    /// ∫ f dt over an interval: the time at full power that gives as much light.
    ///
    /// # Errors
    /// If the schedule has no period and does not cover the interval, or the integral is beyond the range of numbers.
    pub fn full_power_time(&self, interval: Interval) -> Result<Time, TimeError> {
        let seconds = match self.cycle() {
            Some(cycle) => {
                let [start, end] = self.profile.ends();
                cycle.integral(interval.ends(), |a, b| {
                    self.profile.integral([start + a, (start + b).min(end)])
                })
            }
            None => {
                self.profile.cover(interval.ends())?;
                self.profile.integral(interval.ends())
            }
        };
        let seconds = seconds.is_finite().then_some(seconds);
        seconds.map(Time::from_seconds).ok_or(TimeError::Overflow)
    }

    fn cycle(&self) -> Option<Cycle> {
        let [start, _] = self.profile.ends();
        self.period.map(|period| Cycle { start, period })
    }
}

/// The points with the end of the period, where the first follows.
fn closed(profile: &Profile, period: f64) -> Result<Profile, TimeError> {
    let [start, last] = profile.ends();
    let end = start + period;
    if !(end.is_finite() && end >= last) {
        let span = last - start;
        return Err(TimeError::Period { period, span });
    }
    let first = profile.points().next().map(|(_, factor)| (end, factor));
    let closing = first.filter(|_| end > last);
    Profile::new(profile.points().chain(closing), profile.rule())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn hours(points: &[(f64, f64)]) -> Vec<(Time, f64)> {
        let points = points.iter();
        points
            .map(|&(hour, factor)| (Time::from_hours(hour), factor))
            .collect()
    }

    fn interval(from: f64, to: f64) -> Interval {
        Interval::new(Time::from_hours(from), Time::from_hours(to)).unwrap()
    }

    fn full_hours(schedule: &Schedule, from: f64, to: f64) -> f64 {
        schedule
            .full_power_time(interval(from, to))
            .unwrap()
            .to_hours()
    }

    #[test]
    fn a_ramp_has_its_trapezium() {
        let ramp = Schedule::new(
            hours(&[(0.0, 0.0), (1.0, 1.0), (8.0, 1.0)]),
            Rule::Linear,
            None,
        )
        .unwrap();
        assert_eq!(full_hours(&ramp, 0.0, 8.0), 7.5);
        assert_eq!(ramp.at(Time::from_hours(0.25)), Ok(0.25));
        assert!(ramp.full_power_time(interval(0.0, 9.0)).is_err());
        assert!(ramp.at(Time::from_hours(-1.0)).is_err());
    }

    #[test]
    fn a_period_closes_the_line_and_holds_the_step() {
        let points = hours(&[(6.0, 1.0), (18.0, 0.0)]);
        let day = Some(Time::from_hours(24.0));
        let (line, step) = (
            Schedule::new(points.clone(), Rule::Linear, day).unwrap(),
            Schedule::new(points, Rule::Held, day).unwrap(),
        );
        // From 18 h the line rises again to 1 at 30 h.
        assert_eq!(line.at(Time::from_hours(24.0)), Ok(0.5));
        assert_eq!(
            (full_hours(&line, 0.0, 24.0), full_hours(&step, 0.0, 24.0)),
            (12.0, 12.0)
        );
        assert_eq!(
            (full_hours(&step, 18.0, 30.0), full_hours(&step, 12.0, 18.0)),
            (0.0, 6.0)
        );
        assert_eq!(full_hours(&line, -48.0, 0.0), 24.0);
    }

    /// A saw tooth: its last point is the end of the period, where it jumps to the first.
    #[test]
    fn a_full_period_may_jump() {
        let saw = Schedule::new(
            hours(&[(0.0, 0.0), (1.0, 1.0)]),
            Rule::Linear,
            Some(Time::from_hours(1.0)),
        )
        .unwrap();
        assert_eq!(full_hours(&saw, 0.0, 10.0), 5.0);
        assert_eq!(saw.at(Time::from_hours(3.0)), Ok(0.0));
    }

    #[test]
    fn what_is_no_schedule_is_told() {
        let message = |points: &[(f64, f64)], period: Option<f64>| {
            let schedule = Schedule::new(hours(points), Rule::Held, period.map(Time::from_hours));
            schedule.unwrap_err().to_string()
        };
        assert_eq!(
            message(&[(0.0, 1.0), (1.0, -0.5)], None),
            "a factor is not negative: point 1 at 3600 s has -0.5"
        );
        let two = [(0.0, 1.0), (2.0, 0.0)];
        assert_eq!(
            message(&two, Some(1.0)),
            "a period of 3600 s is too short for points that span 7200 s"
        );
        assert!(message(&two, Some(f64::NAN)).contains("period"));
        assert!(message(&[(0.0, 1.0)], None).contains("two points"));
    }

    proptest! {
        /// Some ten roundings of at most 60 h.
        #[test]
        fn intervals_side_by_side_add_up(from in -30.0..30.0_f64, parts in (0.01..30.0_f64, 0.01..30.0_f64), held: bool) {
            let rule = if held { Rule::Held } else { Rule::Linear };
            let points = hours(&[(7.0, 0.2), (8.0, 1.0), (17.0, 0.3), (19.0, 0.0)]);
            let schedule = Schedule::new(points, rule, Some(Time::from_hours(24.0))).unwrap();
            let (middle, to) = (from + parts.0, from + parts.0 + parts.1);
            let (whole, sum) = (
                full_hours(&schedule, from, to),
                full_hours(&schedule, from, middle) + full_hours(&schedule, middle, to),
            );
            prop_assert!((whole - sum).abs() <= 1e-12, "{} {}", whole, sum);
        }
    }
}
