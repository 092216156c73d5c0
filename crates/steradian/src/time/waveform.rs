//! Rates that a formula gives, with their integrals in closed form.
//!
//! | waveform | Φ(t) | Q from a to b |
//! |---|---|---|
//! | constant | Φ₀ | Φ₀ (b − a) |
//! | sinusoid | Φ₀ + B sin(ω t + φ) | Φ₀ (b − a) + B (b − a) sinc(ω (b − a)/2) sin(ω (a + b)/2 + φ) |
//! | exponential | Φ₀ exp(−t/τ) | Φ₀ τ exp(−a/τ) · −expm1(−(b − a)/τ) |
//! | duty cycle | Φ₀ where t mod T < d T, else 0 | Φ₀ × the time on |
//!
//! The sinusoid's is (B/ω)(cos(ω a + φ) − cos(ω b + φ)) written as a product: no cancellation over short intervals, and
//! right at ω = 0. A phase ω t is known to ε |ω t|, so that a thousand million radians leave seven digits of it.

use libm::{exp, expm1, sin};
use std::f64::consts::PI;

use super::cycle::Cycle;
use super::{Interval, Rate, Summary, TimeError};
use crate::quantity::{Angle, AngularFrequency, Quantity, Time};

/// A rate that a formula gives at all times.
///
/// ```
/// use steradian::quantity::{Flux, Time};
/// use steradian::time::{Interval, Waveform};
///
/// // A charge that decays with 2 s: 5 W × 2 s × (1 − e⁻⁵) in ten seconds, and 10 J in the end.
/// let glow = Waveform::Exponential { initial: Flux::from_watts(5.0), time_constant: Time::from_seconds(2.0) };
/// let ten = Interval::lasting(Time::from_seconds(10.0), Time::ZERO)?;
/// assert!((glow.integral(ten)?.to_joules() - 9.932_620_530_009_146).abs() < 1e-14);
/// assert_eq!(glow.total().unwrap().to_joules(), 10.0);
/// # Ok::<(), steradian::time::TimeError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Waveform<R> {
    /// Φ₀ at all times.
    Constant(R),
    /// Φ₀ + B sin(ω t + φ).
    Sinusoid {
        /// Φ₀, its mean.
        offset: R,
        /// B.
        amplitude: R,
        /// ω.
        angular_frequency: AngularFrequency,
        /// φ.
        phase: Angle,
    },
    /// Φ₀ exp(−t/τ).
    Exponential {
        /// Φ₀, what it is at t = 0.
        initial: R,
        /// τ, the time in which it falls to 1/e.
        time_constant: Time,
    },
    /// On at the beginning of each period, the first of which begins at t = 0, then off.
    DutyCycle {
        /// Φ₀ while it is on.
        on: R,
        /// T.
        period: Time,
        /// d, the part of a period that it is on: 0 to 1.
        duty: f64,
    },
}

impl<R: Rate> Waveform<R> {
    /// Q = ∫ Φ dt over an interval.
    ///
    /// # Errors
    /// If a parameter is outside its domain, or the integral beyond the range of numbers.
    pub fn integral(&self, interval: Interval) -> Result<R::Total, TimeError> {
        self.check()?;
        let total = self.area_under(interval);
        let total = total.is_finite().then_some(total);
        total.map(R::Total::from_si).ok_or(TimeError::Overflow)
    }

    /// Integral, mean and extremes over an interval.
    ///
    /// # Errors
    /// As [`Waveform::integral`].
    pub fn summary(&self, interval: Interval) -> Result<Summary<R>, TimeError> {
        let total = self.integral(interval)?;
        let extremes = self.extremes(interval).map(R::from_si);
        Ok(Summary::new(interval, total, extremes))
    }

    /// What comes after t = 0 in all, where that is finite: Φ₀ τ of an exponential decay.
    pub fn total(&self) -> Option<R::Total> {
        match *self {
            Self::Exponential {
                initial,
                time_constant,
            } => Some(initial * time_constant),
            _ => None,
        }
    }

    fn area_under(&self, interval: Interval) -> f64 {
        let ([from, to], duration) = (interval.ends(), interval.duration().to_seconds());
        match *self {
            Self::Constant(value) => value.to_si() * duration,
            Self::Sinusoid {
                offset,
                amplitude,
                angular_frequency,
                phase,
            } => {
                let omega = angular_frequency.to_radians_per_second();
                let middle = omega * (0.5 * (from + to)) + phase.to_radians();
                let mean = amplitude.to_si() * sinc(0.5 * omega * duration) * sin(middle);
                (offset.to_si() + mean) * duration
            }
            Self::Exponential {
                initial,
                time_constant,
            } => {
                let tau = time_constant.to_seconds();
                initial.to_si() * tau * exp(-from / tau) * -expm1(-duration / tau)
            }
            Self::DutyCycle { on, period, duty } => {
                let [time_on, _] = times_on_and_off(period.to_seconds(), duty, [from, to]);
                on.to_si() * time_on
            }
        }
    }

    /// Least and greatest value.
    fn extremes(&self, interval: Interval) -> [f64; 2] {
        let [from, to] = interval.ends();
        match *self {
            Self::Constant(value) => [value.to_si(); 2],
            Self::Sinusoid {
                offset,
                amplitude,
                angular_frequency,
                phase,
            } => {
                let angle =
                    |time| (angular_frequency * Time::from_seconds(time) + phase).to_radians();
                let swing = ordered([from, to].map(|time| sin(angle(time))));
                let [low, high] = with_crests(swing, ordered([angle(from), angle(to)]));
                let (offset, amplitude) = (offset.to_si(), amplitude.to_si());
                ordered([offset + amplitude * low, offset + amplitude * high])
            }
            Self::Exponential {
                initial,
                time_constant,
            } => ordered(
                [from, to].map(|time| initial.to_si() * exp(-time / time_constant.to_seconds())),
            ),
            Self::DutyCycle { on, period, duty } => {
                let times = times_on_and_off(period.to_seconds(), duty, [from, to]);
                let [high, low] = times.map(|time| time > 0.0);
                let on = on.to_si();
                ordered([if low { 0.0 } else { on }, if high { on } else { 0.0 }])
            }
        }
    }

    fn check(&self) -> Result<(), TimeError> {
        let positive =
            |name, value: f64| Self::require(name, "positive and finite", value, value > 0.0);
        let any = |name, value| Self::require(name, "finite", value, true);
        match *self {
            Self::Constant(value) => any("the constant", value.to_si()),
            Self::Sinusoid {
                offset,
                amplitude,
                angular_frequency,
                phase,
            } => any("the offset", offset.to_si())
                .and(any("the amplitude", amplitude.to_si()))
                .and(any("omega", angular_frequency.to_radians_per_second()))
                .and(any("the phase", phase.to_radians())),
            Self::Exponential {
                initial,
                time_constant,
            } => any("the initial value", initial.to_si())
                .and(positive("tau", time_constant.to_seconds())),
            Self::DutyCycle { on, period, duty } => any("the value while on", on.to_si())
                .and(positive("the period", period.to_seconds()))
                .and(Self::require(
                    "the duty",
                    "from 0 to 1",
                    duty,
                    (0.0..=1.0).contains(&duty),
                )),
        }
    }

    fn require(
        name: &'static str,
        expected: &'static str,
        value: f64,
        holds: bool,
    ) -> Result<(), TimeError> {
        if holds && value.is_finite() {
            return Ok(());
        }
        Err(TimeError::Parameter {
            name,
            expected,
            value,
        })
    }
}

fn ordered([a, b]: [f64; 2]) -> [f64; 2] {
    [a.min(b), a.max(b)]
}

/// How long a duty cycle is on and off; 0 without rounding where it is not.
fn times_on_and_off(period: f64, duty: f64, ends: [f64; 2]) -> [f64; 2] {
    let cycle = Cycle { start: 0.0, period };
    let switch = duty * period;
    [
        cycle.integral(ends, |a, b| b.min(switch) - a.min(switch)),
        cycle.integral(ends, |a, b| b.max(switch) - a.max(switch)),
    ]
}

/// sin x / x.
fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { sin(x) / x }
}

/// Extremes of the sine from one angle to a greater one, from those of both ends: ±1 where a crest or a trough lies between.
fn with_crests([low, high]: [f64; 2], [from, to]: [f64; 2]) -> [f64; 2] {
    let passes =
        |peak: f64| ((from - peak) / (2.0 * PI)).ceil() <= ((to - peak) / (2.0 * PI)).floor();
    [
        if passes(-PI / 2.0) { -1.0 } else { low },
        if passes(PI / 2.0) { 1.0 } else { high },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::{Energy, Flux};
    use crate::time::{Rule, Series};
    use libm::cos;
    use proptest::prelude::*;

    fn interval(from: f64, to: f64) -> Interval {
        Interval::new(Time::from_seconds(from), Time::from_seconds(to)).unwrap()
    }

    fn sinusoid(offset: f64, amplitude: f64, omega: f64, phase: f64) -> Waveform<Flux> {
        Waveform::Sinusoid {
            offset: Flux::from_watts(offset),
            amplitude: Flux::from_watts(amplitude),
            angular_frequency: AngularFrequency::from_radians_per_second(omega),
            phase: Angle::from_radians(phase),
        }
    }

    fn pulses(duty: f64) -> Waveform<Flux> {
        Waveform::DutyCycle {
            on: Flux::from_watts(10.0),
            period: Time::from_seconds(4.0),
            duty,
        }
    }

    fn joules(waveform: &Waveform<Flux>, from: f64, to: f64) -> f64 {
        waveform.integral(interval(from, to)).unwrap().to_joules()
    }

    #[test]
    fn a_sinusoid_agrees_with_the_cosines() {
        let wave = sinusoid(1.0, 0.5, 3.0, 0.25);
        let expected = 7.0 - (0.5 / 3.0) * (cos(3.0 * 9.0 + 0.25) - cos(3.0 * 2.0 + 0.25));
        assert!((joules(&wave, 2.0, 9.0) - expected).abs() < 1e-14);
        // Without frequency it is a constant, 1 + ½ sin ¼.
        let still = sinusoid(1.0, 0.5, 0.0, 0.25);
        assert!((joules(&still, 0.0, 2.0) - (2.0 + sin(0.25))).abs() < 1e-15);
    }

    #[test]
    fn crests_within_the_interval_are_extremes() {
        let wave = sinusoid(10.0, 2.0, PI, 0.0);
        let extremes = |from, to| {
            let summary = wave.summary(interval(from, to)).unwrap();
            [summary.least.to_watts(), summary.greatest.to_watts()]
        };
        assert_eq!(extremes(0.0, 2.0), [8.0, 12.0]);
        let [least, greatest] = extremes(0.75, 1.25);
        assert!((least - (10.0 - 2.0_f64.sqrt())).abs() < 1e-14);
        assert!((greatest - (10.0 + 2.0_f64.sqrt())).abs() < 1e-14);
    }

    #[test]
    fn a_duty_cycle_counts_the_time_that_it_is_on() {
        let half = pulses(0.5);
        assert_eq!(joules(&half, 0.0, 8.0), 40.0);
        assert_eq!(joules(&half, 1.0, 5.0), 20.0);
        assert_eq!(joules(&half, 2.0, 4.0), 0.0);
        assert_eq!(joules(&half, -3.0, -1.0), 10.0);
        let extremes = |from, to| {
            let summary = half.summary(interval(from, to)).unwrap();
            [summary.least.to_watts(), summary.greatest.to_watts()]
        };
        assert_eq!(extremes(0.0, 8.0), [0.0, 10.0]);
        assert_eq!(extremes(0.5, 1.5), [10.0, 10.0]);
        assert_eq!(extremes(2.5, 3.5), [0.0, 0.0]);
    }

    #[test]
    fn parameters_have_domains() {
        let message = |waveform: Waveform<Flux>| {
            let result = waveform.integral(interval(0.0, 1.0));
            result.unwrap_err().to_string()
        };
        assert_eq!(
            message(pulses(1.5)),
            "the duty must be from 0 to 1, not 1.5"
        );
        let decay = |tau| Waveform::Exponential {
            initial: Flux::from_watts(1.0),
            time_constant: Time::from_seconds(tau),
        };
        assert_eq!(
            message(decay(0.0)),
            "tau must be positive and finite, not 0"
        );
        assert!(message(decay(f64::INFINITY)).contains("not inf"));
        assert!(message(sinusoid(f64::NAN, 1.0, 1.0, 0.0)).contains("the offset must be finite"));
        assert_eq!(
            Waveform::Constant(Flux::from_watts(1e308)).integral(interval(0.0, 1e3)),
            Err(TimeError::Overflow)
        );
    }

    fn waveforms() -> impl Strategy<Value = Waveform<Flux>> {
        prop_oneof![
            (0.1..9.0).prop_map(|watts| Waveform::Constant(Flux::from_watts(watts))),
            (0.0..1.0, 0.0..3.0, -3.0..3.0_f64)
                .prop_map(|(b, omega, phase)| sinusoid(1.0, b, omega, phase)),
            (0.5..5.0_f64).prop_map(|tau| Waveform::Exponential {
                initial: Flux::from_watts(2.0),
                time_constant: Time::from_seconds(tau),
            }),
            (0.0..=1.0).prop_map(pulses),
        ]
    }

    proptest! {
        /// A few roundings of each part; nothing is negative but for −10 s of a decay, whose parts are below e²⁰ × 10 J.
        #[test]
        fn intervals_side_by_side_add_up(wave in waveforms(), from in -10.0..10.0_f64, parts in (0.01..5.0_f64, 0.01..5.0_f64)) {
            let (middle, to) = (from + parts.0, from + parts.0 + parts.1);
            let (whole, sum) = (joules(&wave, from, to), joules(&wave, from, middle) + joules(&wave, middle, to));
            prop_assert!((whole - sum).abs() <= 1e-13 * (1.0 + whole.abs()), "{} {}", whole, sum);
        }

        /// The trapezia of 4096 points differ by at most h²/12 max|Φ″| duration: (3/4096)²/12 × 9 × 3 = 1.3e-6.
        #[test]
        fn closed_forms_agree_with_trapezia(b in 0.0..1.0_f64, omega in 0.0..3.0_f64, phase in -3.0..3.0_f64) {
            let wave = sinusoid(1.0, b, omega, phase);
            let points = (0..=4096).map(|k| {
                let time = 3.0 * f64::from(k) / 4096.0;
                (Time::from_seconds(time), Flux::from_watts(1.0 + b * sin(omega * time + phase)))
            });
            let record = Series::new(points, Rule::Linear).unwrap();
            let trapezia: Energy = record.integral(record.interval()).unwrap();
            prop_assert!((trapezia.to_joules() - joules(&wave, 0.0, 3.0)).abs() <= 1.3e-6);
        }
    }
}
