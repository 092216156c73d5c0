//! Time that repeats.

/// A cycle that begins at `start` and lasts `period`, again and again in both directions of time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cycle {
    pub start: f64,
    pub period: f64,
}

impl Cycle {
    /// Whole cycles from `start` to `time`, and the time since the last of them began, from 0 to the period.
    pub fn split(self, time: f64) -> (f64, f64) {
        let since = time - self.start;
        let whole = (since / self.period).floor();
        // The quotient's rounding can put the rest outside by as much.
        (whole, (since - whole * self.period).clamp(0.0, self.period))
    }

    /// ∫ f over [from, to], of a function that the cycle repeats. `part` is ∫ f between two times since a cycle began.
    pub fn integral(self, [from, to]: [f64; 2], part: impl Fn(f64, f64) -> f64) -> f64 {
        let ((first, a), (last, b)) = (self.split(from), self.split(to));
        if first == last {
            return part(a, b);
        }
        let between = (last - first - 1.0) * part(0.0, self.period);
        part(a, self.period) + between + part(0.0, b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const HOURLY: Cycle = Cycle {
        start: 600.0,
        period: 3600.0,
    };

    #[test]
    fn times_before_the_start_belong_to_cycles_too() {
        assert_eq!(HOURLY.split(600.0), (0.0, 0.0));
        assert_eq!(HOURLY.split(4300.0), (1.0, 100.0));
        assert_eq!(HOURLY.split(500.0), (-1.0, 3500.0));
    }

    proptest! {
        /// The time itself, as the integral of 1: each end is rounded to ε × its size a few times.
        #[test]
        fn cycles_leave_no_time_out(from in -1e6..1e6_f64, duration in 0.0..1e6_f64) {
            let lasted = HOURLY.integral([from, from + duration], |a, b| b - a);
            prop_assert!((lasted - duration).abs() <= 8.0 * f64::EPSILON * 2e6, "{}", lasted);
        }
    }
}
