//! Fluxes that a formula gives: `--sinusoid offset=100W amplitude=50W omega=1Hz`.

use std::str::FromStr;

use steradian::quantity::{Amount, Angle, Flux, Illuminance, Irradiance, LuminousFlux, Quantity};
use steradian::time::{Rate, Waveform};

use super::{Arguments, Entry};
use crate::status::Failure;

/// What the formula adds up to.
pub fn entry(arguments: &Arguments) -> Result<Entry, Failure> {
    let formula = Formula::of(arguments)?;
    let size = formula.text(formula.sizes()[0])?;
    match () {
        () if size.parse::<Irradiance>().is_ok() => formula.entry::<Irradiance>(arguments),
        () if size.parse::<LuminousFlux>().is_ok() => formula.entry::<LuminousFlux>(arguments),
        () if size.parse::<Illuminance>().is_ok() => formula.entry::<Illuminance>(arguments),
        () => formula.entry::<Flux>(arguments),
    }
}

/// The kinds of formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Constant,
    Sinusoid,
    Exponential,
    Duty,
}

/// A formula as it was given.
struct Formula<'a> {
    kind: Kind,
    pairs: Vec<(&'a str, &'a str)>,
}

impl<'a> Formula<'a> {
    fn of(arguments: &'a Arguments) -> Result<Self, Failure> {
        let given = [
            (Kind::Sinusoid, &arguments.sinusoid),
            (Kind::Exponential, &arguments.exponential),
            (Kind::Duty, &arguments.duty),
        ];
        let found = given
            .into_iter()
            .find_map(|(kind, pairs)| Some((kind, pairs.as_ref()?)));
        let Some((kind, pairs)) = found else {
            let value = arguments.constant.as_deref().unwrap_or_default();
            return Ok(Self {
                kind: Kind::Constant,
                pairs: vec![("value", value)],
            });
        };
        let pairs: Option<Vec<_>> = pairs.iter().map(|pair| pair.split_once('=')).collect();
        let expected = || Failure::message(format!("expected {}", kind.usage()));
        let formula = Self {
            kind,
            pairs: pairs.ok_or_else(expected)?,
        };
        formula.check()?;
        Ok(formula)
    }

    /// Every key is known and there once.
    fn check(&self) -> Result<(), Failure> {
        for (index, (key, _)) in self.pairs.iter().enumerate() {
            let fault = if !self.kind.keys().contains(key) {
                "is not known"
            } else if self.pairs[..index].iter().any(|(before, _)| before == key) {
                "is given twice"
            } else {
                continue;
            };
            let usage = self.kind.usage();
            return Err(Failure::message(format!(
                "`{key}` {fault}: expected {usage}"
            )));
        }
        Ok(())
    }

    /// The keys whose values are of the quantity that flows.
    const fn sizes(&self) -> &'static [&'static str] {
        match self.kind {
            Kind::Constant => &["value"],
            Kind::Sinusoid => &["offset", "amplitude"],
            Kind::Exponential => &["initial"],
            Kind::Duty => &["on"],
        }
    }

    fn given(&self, key: &str) -> Option<&'a str> {
        let mut pairs = self.pairs.iter();
        pairs
            .find(|(known, _)| *known == key)
            .map(|(_, value)| *value)
    }

    fn text(&self, key: &str) -> Result<&'a str, Failure> {
        let usage = self.kind.usage();
        self.given(key)
            .ok_or_else(|| Failure::message(format!("`{key}` is missing: expected {usage}")))
    }

    fn read<T: FromStr>(&self, key: &str) -> Result<T, Failure>
    where
        T::Err: std::fmt::Display,
    {
        let text = self.text(key)?;
        text.parse()
            .map_err(|error| Failure::message(format!("{key}: {error}")))
    }

    /// A value of the quantity that flows. Units of none are answered with both kinds of flux.
    fn size<R: Rate>(&self, key: &str) -> Result<R, Failure> {
        if R::NAME == Flux::NAME && key == self.sizes()[0] {
            self.read::<Amount<Flux, LuminousFlux>>(key)?;
        }
        self.read(key)
    }

    fn waveform<R: Rate>(&self) -> Result<Waveform<R>, Failure> {
        Ok(match self.kind {
            Kind::Constant => Waveform::Constant(self.size("value")?),
            Kind::Sinusoid => Waveform::Sinusoid {
                offset: self.size("offset")?,
                amplitude: self.size("amplitude")?,
                angular_frequency: self.read("omega")?,
                phase: match self.given("phase") {
                    Some(_) => self.read("phase")?,
                    None => Angle::ZERO,
                },
            },
            Kind::Exponential => Waveform::Exponential {
                initial: self.size("initial")?,
                time_constant: self.read("tau")?,
            },
            Kind::Duty => Waveform::DutyCycle {
                on: self.size("on")?,
                period: self.read("period")?,
                duty: self.read("duty")?,
            },
        })
    }

    fn entry<R: Rate>(&self, arguments: &Arguments) -> Result<Entry, Failure> {
        let waveform = self.waveform::<R>()?;
        let summary = waveform.summary(arguments.interval(None)?)?;
        let entry = Entry::new(R::NAME, &summary, arguments)?;
        Ok(match waveform.total() {
            Some(total) => entry.with_rest(total),
            None => entry,
        })
    }
}

impl Kind {
    const fn keys(self) -> &'static [&'static str] {
        match self {
            Self::Constant => &["value"],
            Self::Sinusoid => &["offset", "amplitude", "omega", "phase"],
            Self::Exponential => &["initial", "tau"],
            Self::Duty => &["on", "period", "duty"],
        }
    }

    const fn usage(self) -> &'static str {
        match self {
            Self::Constant => "--constant 100W",
            Self::Sinusoid => {
                "--sinusoid offset=100W amplitude=50W omega=1Hz, and perhaps phase=90deg"
            }
            Self::Exponential => "--exponential initial=5W tau=2s",
            Self::Duty => "--duty on=100W period=1h duty=0.5",
        }
    }
}
