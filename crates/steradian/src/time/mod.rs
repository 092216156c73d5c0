//! What flows in time, and what it adds up to.
//!
//! Energy is the integral of flux over time, and flux the derivative of energy:
//!
//! ```text
//! Q = ∫ Φ(t) dt        Φ = dQ/dt
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | t | time, from any origin | s |
//! | Φ | flux, or any other [`Rate`]: irradiance, luminous flux, illuminance | W |
//! | Q | energy, or what that rate adds up to: exposure, luminous energy, luminous exposure | J |
//! | f | factor of a [`Schedule`]: the part of its full light that a lamp gives | 1 |
//!
//! | Φ(t) | type | Q from a to b |
//! |---|---|---|
//! | straight lines between points | [`Series`], [`Rule::Linear`] | Σ ½ (Φₖ + Φₖ₊₁) Δt |
//! | steps, each held until the next time | [`Series`], [`Rule::Held`] | Σ Φₖ Δt |
//! | constant Φ₀ | [`Waveform::Constant`] | Φ₀ (b − a) |
//! | Φ₀ + B sin(ω t + φ) | [`Waveform::Sinusoid`] | Φ₀ (b − a) + (2B/ω) sin(ω(b − a)/2) sin(ω(a + b)/2 + φ) |
//! | Φ₀ exp(−t/τ) | [`Waveform::Exponential`] | Φ₀ τ exp(−a/τ) (1 − exp(−(b − a)/τ)) |
//! | Φ₀ in the first part d of each period, else 0 | [`Waveform::DutyCycle`] | Φ₀ × the time that it is on |
//!
//! Each is exact: trapezia are the integral of straight lines, not an approximation of something smoother. What is left is
//! rounding; sums are compensated (A. Neumaier, Z. Angew. Math. Mech. 54 (1974) 39–51), so that a record of a million points
//! keeps its digits.
//!
//! A record is known from its first to its last time and nowhere else: an interval that leaves it is an error, not an
//! extrapolation. A meter that counts energy gives mean fluxes between its readings, [`Series::from_meter`].
//!
//! ```
//! use steradian::quantity::{Energy, Flux, Time};
//! use steradian::time::{Interval, Rule, Series};
//!
//! // 5 W falling to 1 W in a second, then rising to 8 W in two: 3 J + 9 J.
//! let times = [0.0, 1.0, 3.0].map(Time::from_seconds);
//! let watts = [5.0, 1.0, 8.0].map(Flux::from_watts);
//! let lamp = Series::new(times.into_iter().zip(watts), Rule::Linear)?;
//! assert_eq!(lamp.integral(lamp.interval())?, Energy::from_joules(12.0));
//!
//! // Its second half: from 1.5 s, where it gives 2.75 W, ½ (2.75 + 8) × 1.5.
//! let half = Interval::new(Time::from_seconds(1.5), Time::from_seconds(3.0))?;
//! assert_eq!(lamp.integral(half)?, Energy::from_joules(8.0625));
//! # Ok::<(), steradian::time::TimeError>(())
//! ```

mod cycle;
mod error;
mod interval;
mod profile;
mod rate;
mod schedule;
mod series;
mod sum;
mod waveform;

pub use error::TimeError;
pub use interval::Interval;
pub use profile::Rule;
pub use rate::{Rate, Summary};
pub use schedule::Schedule;
pub use series::Series;
pub use waveform::Waveform;
