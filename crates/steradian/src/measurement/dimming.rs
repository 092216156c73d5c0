//! Readings at a moment and over an interval, from schedules: nothing is traced again.
//!
//! Light is linear in its sources. If a light group adds Eg to a reading while its lights give all they can, and its schedule
//! is fg(t), then
//!
//! ```text
//! E(t) = Σg fg(t) Eg         H = ∫ E dt = Σg Eg ∫ fg dt
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Eg | what the group g adds to the reading at factor 1 | that of the reading |
//! | fg | factor of its schedule; 1 without one | 1 |
//! | E(t), H | the reading at a time, and its integral | lx; lx s |
//!
//! Both are sums of the same columns with other weights, made for each replicate before errors are estimated. So errors that
//! groups share add up as they are, and those that cancel cancel.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::quantity::Time;
use crate::time::{Interval, Schedule, TimeError};

/// A schedule that does not reach where it is asked for.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("the schedule of a light in group `{group}`: {fault}")]
pub struct ScheduleError {
    /// The light group.
    pub group: String,
    /// What is wrong.
    pub fault: TimeError,
}

/// How much light each group gives: when readings are taken, and over which interval they are added up.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Dimming {
    schedules: Vec<Option<Schedule>>,
    moment: Option<Moment>,
    period: Option<Period>,
}

/// A time, and each group's factor at it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Moment {
    seconds: f64,
    factors: Vec<f64>,
}

/// An interval, and each group's full-power time in it, in seconds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Period {
    interval: Interval,
    seconds: Vec<f64>,
}

impl Dimming {
    /// Groups with these schedules, in their order; readings are at factor 1.
    pub fn new(schedules: Vec<Option<Schedule>>) -> Self {
        Self {
            schedules,
            ..Self::default()
        }
    }

    /// The same, readings taken at this time.
    ///
    /// # Errors
    /// If a schedule does not cover it; `groups` are the names in messages.
    pub fn at(mut self, time: Time, groups: &[String]) -> Result<Self, ScheduleError> {
        let factors = self.of_groups(groups, 1.0, |schedule| schedule.at(time))?;
        let seconds = time.to_seconds();
        self.moment = Some(Moment { seconds, factors });
        Ok(self)
    }

    /// The same, readings added up over this interval.
    ///
    /// # Errors
    /// If a schedule does not cover it; `groups` are the names in messages.
    pub fn over(mut self, interval: Interval, groups: &[String]) -> Result<Self, ScheduleError> {
        let always = interval.duration().to_seconds();
        let full_power = |schedule: &Schedule| schedule.full_power_time(interval);
        let seconds = self.of_groups(groups, always, |schedule| {
            full_power(schedule).map(Time::to_seconds)
        })?;
        self.period = Some(Period { interval, seconds });
        Ok(self)
    }

    /// A number of each schedule, and `always` of groups without one.
    fn of_groups(
        &self,
        groups: &[String],
        always: f64,
        number: impl Fn(&Schedule) -> Result<f64, TimeError>,
    ) -> Result<Vec<f64>, ScheduleError> {
        let of_group = |(schedule, group): (&Option<Schedule>, &String)| {
            let number = schedule.as_ref().map_or(Ok(always), &number);
            number.map_err(|fault| ScheduleError {
                group: group.clone(),
                fault,
            })
        };
        self.schedules.iter().zip(groups).map(of_group).collect()
    }

    /// Whether it is about so many groups.
    pub(super) fn is_of(&self, groups: usize) -> bool {
        let fits = |length: usize| length == groups;
        let moment = self.moment.as_ref();
        let period = self.period.as_ref();
        (self.schedules.is_empty() || fits(self.schedules.len()))
            && moment.is_none_or(|moment| fits(moment.factors.len()))
            && period.is_none_or(|period| fits(period.seconds.len()))
    }

    /// Whether any group has a schedule.
    pub fn has_schedules(&self) -> bool {
        self.schedules.iter().any(Option::is_some)
    }

    /// When readings are taken; none if all groups give all they can.
    pub fn moment(&self) -> Option<Time> {
        let moment = self.moment.as_ref();
        moment.map(|moment| Time::from_seconds(moment.seconds))
    }

    /// The interval over which readings are added up, if one was asked for.
    pub fn interval(&self) -> Option<Interval> {
        self.period.as_ref().map(|period| period.interval)
    }

    /// The factor of a group's light in readings.
    pub(super) fn factor(&self, group: usize) -> f64 {
        let moment = self.moment.as_ref();
        moment.map_or(1.0, |moment| moment.factors[group])
    }

    /// The full-power time of a group, in seconds.
    pub(super) fn seconds(&self, group: usize) -> f64 {
        let period = self.period.as_ref();
        period.map_or(0.0, |period| period.seconds[group])
    }
}
