//! A function of time through points, in plain numbers: seconds and SI units.

use serde::{Deserialize, Serialize};

use super::TimeError;
use super::sum::Sum;

/// What a record is between its points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Rule {
    /// A straight line from each point to the next.
    #[default]
    Linear,
    /// Each value holds until the next time; the last one only ends the record.
    Held,
}

/// A record of numbers in time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Unchecked")]
pub(super) struct Profile {
    times: Vec<f64>,
    values: Vec<f64>,
    rule: Rule,
}

/// What a file says.
#[derive(Deserialize)]
struct Unchecked {
    times: Vec<f64>,
    values: Vec<f64>,
    rule: Rule,
}

impl TryFrom<Unchecked> for Profile {
    type Error = TimeError;

    fn try_from(file: Unchecked) -> Result<Self, TimeError> {
        Self::new(file.times.into_iter().zip(file.values), file.rule)
    }
}

impl Profile {
    pub fn new(
        points: impl IntoIterator<Item = (f64, f64)>,
        rule: Rule,
    ) -> Result<Self, TimeError> {
        let (times, values): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        for (index, (&time, &value)) in times.iter().zip(&values).enumerate() {
            if !(time.is_finite() && value.is_finite()) {
                return Err(TimeError::NotFinite { index, time, value });
            }
            if index > 0 && time <= times[index - 1] {
                let previous = times[index - 1];
                return Err(TimeError::NotIncreasing {
                    index,
                    time,
                    previous,
                });
            }
        }
        let [first, .., last] = times[..] else {
            return Err(TimeError::TooFew { found: times.len() });
        };
        // The difference of two numbers can be beyond their range.
        let (from, to) = (first, last);
        if !(to - from).is_finite() {
            return Err(TimeError::Interval { from, to });
        }
        Ok(Self {
            times,
            values,
            rule,
        })
    }

    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.times.iter().copied().zip(self.values.iter().copied())
    }

    pub const fn rule(&self) -> Rule {
        self.rule
    }

    /// First and last time.
    pub fn ends(&self) -> [f64; 2] {
        [self.times[0], self.times[self.times.len() - 1]]
    }

    /// An error unless the record covers these times.
    pub fn cover(&self, [from, to]: [f64; 2]) -> Result<(), TimeError> {
        let [first, last] = self.ends();
        if first <= from && from <= to && to <= last {
            return Ok(());
        }
        Err(TimeError::Outside {
            from,
            to,
            first,
            last,
        })
    }

    /// The value at a time that the record covers.
    pub fn at(&self, time: f64) -> f64 {
        let segment = self.segment(time);
        if time == self.ends()[1] {
            return self.values[segment + 1];
        }
        self.within(segment, time)
    }

    /// The integral between two times that the record covers.
    pub fn integral(&self, ends: [f64; 2]) -> f64 {
        let mut sum = Sum::default();
        for (segment, [from, to]) in self.segments(ends) {
            let both = self.within(segment, from) + self.within(segment, to);
            sum.add(0.5 * both * (to - from));
        }
        sum.total()
    }

    /// Least and greatest value between two times that the record covers.
    pub fn extremes(&self, ends: [f64; 2]) -> [f64; 2] {
        let values = self
            .segments(ends)
            .flat_map(|(segment, times)| times.map(|time| self.within(segment, time)));
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        })
    }

    /// Each segment between two times, with the part of it that lies between them.
    fn segments(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = (usize, [f64; 2])> {
        let numbers = self.segment(from)..self.times.len() - 1;
        let clipped = move |segment: usize| {
            let part = [
                self.times[segment].max(from),
                self.times[segment + 1].min(to),
            ];
            (segment, part)
        };
        numbers.map(clipped).take_while(|(_, [from, to])| from < to)
    }

    /// The segment that a time lies in; the later one where two meet, the last one at the end.
    fn segment(&self, time: f64) -> usize {
        let after = self.times.partition_point(|known| *known <= time);
        after.clamp(1, self.times.len() - 1) - 1
    }

    /// The value of a segment at one of its times, of which both ends count.
    fn within(&self, segment: usize, time: f64) -> f64 {
        let ([t0, t1], [v0, v1]) = (
            [self.times[segment], self.times[segment + 1]],
            [self.values[segment], self.values[segment + 1]],
        );
        match self.rule {
            Rule::Held => v0,
            Rule::Linear if time == t1 => v1,
            Rule::Linear => v0 + (v1 - v0) * ((time - t0) / (t1 - t0)),
        }
    }
}
