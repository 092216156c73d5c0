//! `steradian energy`: what a flux adds up to, and the flux behind an energy.

mod record;
mod report;
mod waveform;

use std::path::PathBuf;

use clap::{ArgGroup, Args, ValueEnum};
use steradian::quantity::{Length, Time};
use steradian::time::{Interval, Rule};

use crate::output::{self, Format};
use crate::status::{Failure, Outcome};
use report::Entry;

/// Integrate a flux over time, Q = ∫ Φ dt, or turn the readings of a meter into fluxes, Φ = dQ/dt
///
/// A record is a CSV file whose first line names each column with its unit: time (s),flux (W). Flux, irradiance, luminous flux
/// and illuminance become energy, radiant exposure, luminous energy and luminous exposure. The integral is exact for the
/// straight lines, or steps, between the rows; where the record does not reach nothing is assumed.
///
/// A flux that a formula gives needs no file: --constant, --sinusoid, --exponential, --duty.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
#[command(group = ArgGroup::new("source").required(true))]
pub struct Arguments {
    /// CSV file of a record, times in the first column
    #[arg(group = "source", value_name = "SERIES")]
    series: Option<PathBuf>,
    /// Always the same: 100W, 500lx …
    #[arg(
        long,
        group = "source",
        value_name = "VALUE",
        allow_hyphen_values = true
    )]
    constant: Option<String>,
    /// Φ₀ + B sin(ω t + φ): offset=100W amplitude=50W omega=50Hz (or rad/s), and perhaps phase=90deg
    #[arg(long, group = "source", value_name = "KEY=VALUE", num_args = 1..)]
    sinusoid: Option<Vec<String>>,
    /// Φ₀ exp(−t/τ): initial=5W tau=2s
    #[arg(long, group = "source", value_name = "KEY=VALUE", num_args = 1..)]
    exponential: Option<Vec<String>>,
    /// On at the beginning of each period, then off: on=100W period=1h duty=0.5
    #[arg(long, group = "source", value_name = "KEY=VALUE", num_args = 1..)]
    duty: Option<Vec<String>>,
    /// Begin at this time [default: the first of the record, or 0 s]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    from: Option<Time>,
    /// End at this time [default: the last of the record]
    #[arg(
        long,
        value_name = "TIME",
        allow_hyphen_values = true,
        conflicts_with = "duration"
    )]
    to: Option<Time>,
    /// Last so long
    #[arg(long, value_name = "TIME")]
    duration: Option<Time>,
    /// What a record is between its rows
    #[arg(long, value_enum, default_value_t, requires = "series")]
    rule: BetweenRows,
    /// The record is what a meter has counted: print the mean flux between its readings
    #[arg(long, requires = "series", conflicts_with = "rule")]
    derivative: bool,
    /// Print the integral in this unit: kWh, Wh/m2, lx h …
    #[arg(long, value_name = "UNIT")]
    unit: Option<String>,
    /// Count the photons of an energy of this wavelength in vacuum
    #[arg(long, value_name = "LENGTH")]
    wavelength: Option<Length>,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  steradian energy lamp.csv --unit Wh
  steradian energy lamp.csv --rule held --from 8h --to 17h
  steradian energy meter.csv --derivative
  steradian energy --sinusoid offset=100W amplitude=50W omega=1Hz --duration 1.5s
  steradian energy --exponential initial=5W tau=2s --duration 10s
  steradian energy --duty on=500lx period=1day duty=0.375 --duration 30days --unit \"klx h\"
  steradian energy --constant 1W --duration 1s --wavelength 555nm";

/// What lies between two rows.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum BetweenRows {
    /// A straight line
    #[default]
    Linear,
    /// The value holds until the next time; the last row only ends the record
    Held,
}

impl From<BetweenRows> for Rule {
    fn from(rule: BetweenRows) -> Self {
        match rule {
            BetweenRows::Linear => Self::Linear,
            BetweenRows::Held => Self::Held,
        }
    }
}

/// Integrates and prints.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let entries = match &arguments.series {
        Some(path) => record::entries(path, arguments)?,
        None => vec![waveform::entry(arguments)?],
    };
    output::print(&match arguments.format {
        Format::Table => report::table(&entries),
        Format::Json => report::json(&entries),
    })?;
    Ok(Outcome::Fine)
}

impl Arguments {
    /// The interval asked for, where nothing is stated that of the record.
    fn interval(&self, record: Option<Interval>) -> Result<Interval, Failure> {
        let from = self
            .from
            .or(record.map(Interval::from))
            .unwrap_or(Time::ZERO);
        let to = self.duration.map(|duration| from + duration).or(self.to);
        let Some(to) = to.or(record.map(Interval::to)) else {
            return Err(Failure::message(
                "give --duration or --to: a formula has no end",
            ));
        };
        Ok(Interval::new(from, to)?)
    }
}
