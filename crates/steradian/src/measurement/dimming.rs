//! Readings at a moment, over an interval, and with lights dimmed: nothing is traced again.
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
//! A group can be dimmed by a constant factor as well, on top of its schedule. All are sums of the same columns with other
//! weights, made for each replicate before errors are estimated. So errors that groups share add up as they are, and those
//! that cancel cancel.

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

/// A light group that cannot be dimmed so.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RelightError {
    /// No group of this name.
    #[error("there is no light group `{0}`")]
    UnknownGroup(String),
    /// Light cannot be taken away.
    #[error("the factor of light group `{group}` is not negative and finite, not {factor}")]
    Factor {
        /// The group.
        group: String,
        /// What was asked for.
        factor: f64,
    },
}

/// How much light each group gives: when readings are taken, and over which interval they are added up.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Dimming {
    schedules: Vec<Option<Schedule>>,
    moment: Option<Moment>,
    period: Option<Period>,
    /// Factors on top of the schedules, by group; empty if all are 1.
    #[serde(default)]
    levels: Vec<f64>,
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

    /// The same with the light of a group multiplied by a factor, on top of its schedule and of earlier factors.
    ///
    /// # Errors
    /// If none of `groups` has this name, or the factor is negative or not finite.
    pub fn relit(
        mut self,
        group: &str,
        factor: f64,
        groups: &[String],
    ) -> Result<Self, RelightError> {
        let group = group.to_owned();
        if !(factor >= 0.0 && factor.is_finite()) {
            return Err(RelightError::Factor { group, factor });
        }
        if !groups.contains(&group) {
            return Err(RelightError::UnknownGroup(group));
        }
        self.levels.resize(groups.len(), 1.0);
        let levels = self.levels.iter_mut().zip(groups);
        let named = levels.filter(|(_, name)| **name == group);
        named.for_each(|(level, _)| *level *= factor);
        Ok(self)
    }

    /// The factors of [`relit`](Self::relit) that are not 1, with the names of their groups, each once.
    pub fn levels<'a>(&self, groups: &'a [String]) -> Vec<(&'a str, f64)> {
        let mut levels: Vec<(&str, f64)> = Vec::new();
        for (name, level) in groups.iter().zip(&self.levels) {
            if *level != 1.0 && !levels.iter().any(|(known, _)| known == name) {
                levels.push((name, *level));
            }
        }
        levels
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
        let fits_or_empty = |length: usize| length == 0 || fits(length);
        fits_or_empty(self.schedules.len())
            && fits_or_empty(self.levels.len())
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
        self.level(group) * moment.map_or(1.0, |moment| moment.factors[group])
    }

    /// The full-power time of a group, in seconds.
    pub(super) fn seconds(&self, group: usize) -> f64 {
        let period = self.period.as_ref();
        self.level(group) * period.map_or(0.0, |period| period.seconds[group])
    }

    fn level(&self, group: usize) -> f64 {
        self.levels.get(group).copied().unwrap_or(1.0)
    }
}
