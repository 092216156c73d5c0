//! The numbers after `TILT=`.

use std::ops::Range;

use steradian::light::{FarField, Planes};

use super::header::{Edition, Header};
use super::warning;
use crate::diagnostic::Diagnostic;
use crate::import::photometry::numbers::Numbers;
use crate::import::photometry::opening::{Opening, from_codes};
use crate::import::photometry::source::Source;
use crate::import::photometry::symmetry;

/// Most angles of one kind.
const MOST_ANGLES: f64 = 10_000.0;
/// Most intensities.
const MOST_NODES: f64 = 4e6;
const METRES_PER_FOOT: f64 = 0.3048;

pub(super) struct Table {
    pub lamps: f64,
    /// Of each lamp; negative for absolute photometry.
    lumens: f64,
    pub watts: f64,
    pub opening: Opening,
    pub far_field: FarField,
    pub symmetry: &'static str,
    pub warnings: Vec<Diagnostic>,
}

/// What stands before the angles.
struct Preamble {
    lamps: f64,
    lumens: f64,
    /// All factors of the intensities.
    factor: f64,
    counts: [usize; 2],
    planes: Planes,
    opening: Opening,
    watts: f64,
}

impl Table {
    pub fn read(source: &mut Source, header: &Header) -> Result<Self, Diagnostic> {
        let mut warnings = Vec::new();
        let preamble = Preamble::read(source, header.edition, &mut warnings)?;
        let [verticals, laterals] = preamble.counts;
        let verticals = source.angles(verticals, "a vertical angle")?;
        let laterals = source.angles(laterals, "a lateral angle")?;
        let table = intensities(
            source,
            laterals.1.len() * verticals.1.len(),
            preamble.factor,
        )?;
        let completed = match preamble.planes {
            Planes::C => symmetry::whole_turn(&laterals.1, &verticals.1, &table),
            planes => symmetry::latitudes(planes, &laterals.1, &verticals.1, &table),
        };
        let span = verticals.0.start..laterals.0.end;
        let (far_field, symmetry) = completed.map_err(|message| source.error(span, message))?;
        Ok(Self {
            lamps: preamble.lamps,
            lumens: preamble.lumens,
            watts: preamble.watts,
            opening: preamble.opening,
            far_field,
            symmetry,
            warnings,
        })
    }

    /// Of all lamps; `None` for absolute photometry.
    pub fn lamp_flux(&self) -> Option<f64> {
        (self.lumens > 0.0).then_some(self.lamps * self.lumens)
    }
}

impl Preamble {
    fn read(
        source: &mut Source,
        edition: Edition,
        warnings: &mut Vec<Diagnostic>,
    ) -> Result<Self, Diagnostic> {
        let lamps = source.number("the number of lamps")?.1;
        let lumens = source.number("the lumens of a lamp, or -1")?.1;
        let multiplier = factor(source, "the multiplier of the intensities")?;
        let counts = [
            count(source, "the number of vertical angles")?,
            count(source, "the number of lateral angles")?,
        ];
        let planes = choice(
            source,
            "the type of the angles: 1 (C), 2 (B) or 3 (A)",
            [Planes::C, Planes::B, Planes::A],
        )?;
        let metres = choice(
            source,
            "the unit of lengths: 1 (feet) or 2 (metres)",
            [METRES_PER_FOOT, 1.0],
        )?;
        let opening = opening(source, metres, warnings)?;
        let ballast = factor(source, "the ballast factor")?;
        let (span, number) = source.number("the number after the ballast factor")?;
        let second = second_factor(edition, number, &span, source, warnings)?;
        let watts = source.number("the input watts")?.1;
        Ok(Self {
            lamps,
            lumens,
            factor: multiplier * ballast * second,
            counts,
            planes,
            opening,
            watts,
        })
    }
}

/// The ballast-lamp photometric factor of early editions.
fn second_factor(
    edition: Edition,
    number: f64,
    span: &Range<usize>,
    source: &Source,
    warnings: &mut Vec<Diagnostic>,
) -> Result<f64, Diagnostic> {
    if edition <= Edition::Of1991 {
        return positive(
            source,
            span.clone(),
            number,
            "the ballast-lamp photometric factor",
        );
    }
    if edition < Edition::Of2019 && number != 1.0 {
        let message = format!("this number is reserved and should be 1: {number} is not used");
        warnings.push(warning(source.error(span.clone(), message)));
    }
    Ok(1.0)
}

fn factor(source: &mut Source, what: &str) -> Result<f64, Diagnostic> {
    let (span, number) = source.number(what)?;
    positive(source, span, number, what)
}

fn positive(
    source: &Source,
    span: Range<usize>,
    number: f64,
    what: &str,
) -> Result<f64, Diagnostic> {
    if number > 0.0 {
        return Ok(number);
    }
    Err(source.error(span, format!("{what} is greater than 0, not {number}")))
}

fn count(source: &mut Source, what: &str) -> Result<usize, Diagnostic> {
    let (span, number) = source.number(what)?;
    if number.fract() == 0.0 && (1.0..=MOST_ANGLES).contains(&number) {
        return Ok(number as usize);
    }
    let message = format!("expected {what}, 1 to {MOST_ANGLES}, found {number}");
    Err(source.error(span, message))
}

/// One of several things that are numbered from 1.
fn choice<T: Copy, const N: usize>(
    source: &mut Source,
    what: &str,
    choices: [T; N],
) -> Result<T, Diagnostic> {
    let (span, number) = source.number(what)?;
    let place = (1..=N).position(|choice| choice as f64 == number);
    place
        .map(|place| choices[place])
        .ok_or_else(|| source.error(span, format!("expected {what}, found {number}")))
}

fn opening(
    source: &mut Source,
    metres: f64,
    warnings: &mut Vec<Diagnostic>,
) -> Result<Opening, Diagnostic> {
    let (first, width) = source.number("the width of the opening")?;
    let length = source.number("the length of the opening")?.1;
    let (last, height) = source.number("the height of the opening")?;
    let codes = [width, length, height];
    Ok(from_codes(codes, metres).unwrap_or_else(|| {
        let message =
            "the signs of these dimensions stand for no shape: light is taken to come from a point";
        warnings.push(warning(source.error(first.start..last.end, message)));
        Opening::Point
    }))
}

/// The intensities of every lateral angle.
fn intensities(source: &mut Source, count: usize, factor: f64) -> Result<Vec<f64>, Diagnostic> {
    if count as f64 > MOST_NODES {
        let message = format!("{count} intensities are more than the limit of {MOST_NODES}");
        return Err(Diagnostic::error(message).about(&source.file));
    }
    source.intensities(count, factor)
}
