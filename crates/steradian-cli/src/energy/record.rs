//! Records of files.

use std::path::Path;

use steradian::quantity::{
    Energy, Flux, Illuminance, Irradiance, LuminousEnergy, LuminousExposure, LuminousFlux,
    Quantity, RadiantExposure, Time,
};
use steradian::time::{Rate, Rule, Series, TimeError};
use steradian_io::diagnostic::Diagnostic;
use steradian_io::files::DiskFiles;
use steradian_io::import::series::{Column, RATES, TOTALS, read_series};

use super::{Arguments, Entry};
use crate::status::Failure;

/// What each column of a file adds up to.
pub fn entries(path: &Path, arguments: &Arguments) -> Result<Vec<Entry>, Failure> {
    let quantities = if arguments.derivative {
        &TOTALS
    } else {
        &RATES
    };
    let file = read_series(path, quantities, &DiskFiles::default())
        .map_err(|problems| Failure::Input(hinted(problems, path, arguments.derivative)))?;
    let entry = |column: &Column| {
        let record = Record {
            path,
            times: &file.times,
            column,
            arguments,
        };
        record.entry()
    };
    file.columns.iter().map(entry).collect()
}

/// The problems, with the remark that the file can be read with or without `--derivative`, if that is so.
fn hinted(problems: Vec<Diagnostic>, path: &Path, derivative: bool) -> Vec<Diagnostic> {
    let (others, hint) = if derivative {
        (
            &RATES,
            "these are fluxes; leave out --derivative to add them up",
        )
    } else {
        (
            &TOTALS,
            "if a meter has counted this, --derivative gives the mean fluxes between its readings",
        )
    };
    if read_series(path, others, &DiskFiles::default()).is_err() {
        return problems;
    }
    problems
        .into_iter()
        .map(|problem| problem.hint(hint))
        .collect()
}

/// A column with its times.
struct Record<'a> {
    path: &'a Path,
    times: &'a [Time],
    column: &'a Column,
    arguments: &'a Arguments,
}

impl Record<'_> {
    fn entry(&self) -> Result<Entry, Failure> {
        match self.column.table.quantity {
            name if name == Flux::NAME => self.rate::<Flux>(),
            name if name == Irradiance::NAME => self.rate::<Irradiance>(),
            name if name == LuminousFlux::NAME => self.rate::<LuminousFlux>(),
            name if name == Illuminance::NAME => self.rate::<Illuminance>(),
            name if name == Energy::NAME => self.meter::<Flux>(),
            name if name == RadiantExposure::NAME => self.meter::<Irradiance>(),
            name if name == LuminousEnergy::NAME => self.meter::<LuminousFlux>(),
            name if name == LuminousExposure::NAME => self.meter::<Illuminance>(),
            other => Err(Failure::message(format!("{other} does not add up in time"))),
        }
    }

    fn rate<R: Rate>(&self) -> Result<Entry, Failure> {
        self.integral(&self.series::<R>(self.arguments.rule.into())?)
    }

    fn meter<R: Rate>(&self) -> Result<Entry, Failure> {
        let readings = self.series::<R::Total>(Rule::Linear)?;
        let rates = Series::<R>::from_meter(&readings).map_err(|error| self.fault(&error))?;
        Ok(self.integral(&rates)?.with_steps(&rates))
    }

    fn series<Q: Quantity>(&self, rule: Rule) -> Result<Series<Q>, Failure> {
        let values = self.column.values.iter().map(|value| Q::from_si(*value));
        Series::new(self.times.iter().copied().zip(values), rule)
            .map_err(|error| self.fault(&error))
    }

    fn integral<R: Rate>(&self, series: &Series<R>) -> Result<Entry, Failure> {
        let interval = self.arguments.interval(Some(series.interval()))?;
        let summary = series
            .summary(interval)
            .map_err(|error| self.fault(&error))?;
        Entry::new(&self.column.name, &summary, self.arguments)
    }

    fn fault(&self, error: &TimeError) -> Failure {
        let (path, column) = (self.path.display(), &self.column.name);
        Failure::message(format!("{path}, column \"{column}\": {error}"))
    }
}
