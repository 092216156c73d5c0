//! EULUMDAT files (.ldt): one value a line.
//!
//! I = cd/klm of the table × conversion factor × flux of the lamps in klm; of several sets of lamps the first is meant, as other
//! programs take it. A negative number of lamps says that the photometry is absolute.
//!
//! | `Isym` | planes in the file |
//! |---|---|
//! | 0 | all |
//! | 1 | one, for all of them |
//! | 2 | C0 to C180, mirrored at C0-C180 |
//! | 3 | C270 by C0 to C90, mirrored at C90-C270 |
//! | 4 | C0 to C90, mirrored at both |
//!
//! The length of a luminaire is along C90, its width along C0. Numbers may have a comma for a point.
//!
//! Source: A. Stockmar, *EULUMDAT: ein Leuchtendatenformat für den europäischen Beleuchtungsplaner* (Licht 1990).

use std::ops::Range;
use std::path::Path;

use super::numbers::Numbers;
use super::source::{Source, shortened};
use super::{IntensityUnit, LampSet, Opening, Photometry, symmetry};
use crate::diagnostic::Diagnostic;
use crate::files::Files;

/// Most planes, and most angles of one.
const MOST_ANGLES: usize = 721;
const MOST_SETS: usize = 100;
/// Ratios of the utilance of rooms.
const RATIOS: usize = 10;

pub(super) fn read(path: &Path, files: &dyn Files) -> Result<Photometry, Vec<Diagnostic>> {
    let mut source = Source::read(path, files).map_err(|problem| vec![problem])?;
    Reader(&mut source).read().map_err(|problem| vec![problem])
}

struct Reader<'s>(&'s mut Source);

/// Lines 1 to 26 as far as they are used.
struct Head {
    keywords: Vec<(String, String)>,
    symmetry: (Range<usize>, usize),
    planes: usize,
    angles: usize,
    opening: (Opening, [f64; 4]),
    factor: f64,
    sets: Vec<LampSet>,
}

impl Reader<'_> {
    fn read(mut self) -> Result<Photometry, Diagnostic> {
        let head = self.head()?;
        for _ in 0..RATIOS {
            self.text("a direct ratio")?;
        }
        let planes = self.angles(head.planes, "an angle C")?.1;
        let (start, gammas) = (self.0.place(), self.angles(head.angles, "an angle γ")?.1);
        let laterals = self.listed(&head, &planes)?;
        let mut sets = head.sets.into_iter();
        let first = sets.next();
        let klm = first.as_ref().map_or(0.0, |set| set.flux / 1000.0);
        let table = self.intensities(laterals.len() * gammas.len(), head.factor * klm)?;
        let (far_field, symmetry) = symmetry::whole_turn(&laterals, &gammas, &table)
            .map_err(|message| self.0.error(start..self.0.place(), message))?;
        let absolute = first.as_ref().is_some_and(|set| set.lamps < 0.0);
        Ok(Photometry {
            format: "EULUMDAT".into(),
            keywords: head.keywords,
            unit: IntensityUnit::Candela,
            far_field,
            symmetry,
            lamp_flux: first.as_ref().map(|set| set.flux).filter(|_| !absolute),
            lamps: first.as_ref().map_or(0.0, |set| set.lamps.abs()),
            watts: first.as_ref().map_or(0.0, |set| set.watts),
            other_sets: sets.collect(),
            opening: head.opening.0,
            side_heights: Some(head.opening.1),
            tilt: None,
            warnings: Vec::new(),
        })
    }

    fn head(&mut self) -> Result<Head, Diagnostic> {
        let mut keywords = vec![("company".to_owned(), self.text("the company")?.1)];
        self.optional("the kind of luminaire (Ityp, 1 to 3)")?;
        let symmetry = self.count("the symmetry (Isym)", 0..=4)?;
        let planes = self
            .count("the number of C planes (Mc)", 1..=MOST_ANGLES)?
            .1;
        self.optional("the distance of the C planes (Dc)")?;
        let angles = self
            .count("the number of angles γ (Ng)", 2..=MOST_ANGLES)?
            .1;
        self.optional("the distance of the angles γ (Dg)")?;
        for key in ["report", "luminaire", "number", "file", "date"] {
            keywords.push((key.to_owned(), self.text(key)?.1));
        }
        for what in ["the length", "the width", "the height"] {
            self.optional(what)?;
        }
        let opening = self.opening()?;
        self.optional("the downward flux fraction")?;
        self.optional("the light output ratio")?;
        let (span, factor) = self.number("the conversion factor of the intensities")?;
        if factor <= 0.0 {
            let message = format!("the conversion factor is greater than 0, not {factor}");
            return Err(self.0.error(span, message));
        }
        self.optional("the tilt of the luminaire when it was measured")?;
        Ok(Head {
            keywords,
            symmetry,
            planes,
            angles,
            opening,
            factor,
            sets: self.sets()?,
        })
    }

    /// In millimetres: length (or diameter), width (0: round), and the height of each side.
    fn opening(&mut self) -> Result<(Opening, [f64; 4]), Diagnostic> {
        let mut metres = |what: &str| Ok(self.optional(what)?.1.abs() / 1000.0);
        let length = metres("the length of the luminous area")?;
        let width = metres("the width of the luminous area")?;
        let mut heights = [0.0; 4];
        for (height, side) in heights.iter_mut().zip(["C0", "C90", "C180", "C270"]) {
            *height = metres(&format!("the height of the luminous area at {side}"))?;
        }
        let opening = match (length > 0.0, width > 0.0) {
            (false, false) => Opening::Point,
            (true, false) => Opening::Upright {
                width: length,
                length,
                height: heights.into_iter().fold(0.0, f64::max),
            },
            _ => Opening::Box {
                width: length,
                length: width,
                height: heights.into_iter().fold(0.0, f64::max),
            },
        };
        Ok((opening, heights))
    }

    fn sets(&mut self) -> Result<Vec<LampSet>, Diagnostic> {
        let count = self.count("the number of sets of lamps", 1..=MOST_SETS)?.1;
        (0..count).map(|_| self.set()).collect()
    }

    fn set(&mut self) -> Result<LampSet, Diagnostic> {
        let lamps = self.number("the number of lamps")?.1;
        let kind = self.text("the type of the lamps")?.1;
        let (span, flux) = self.number("the flux of the lamps")?;
        if flux < 0.0 {
            let message = format!("the flux of lamps is not negative, found {flux}");
            return Err(self.0.error(span, message));
        }
        self.text("the colour of the light")?;
        self.text("the colour rendering")?;
        let watts = self.optional("the power of the lamps")?.1;
        Ok(LampSet {
            lamps,
            kind,
            flux,
            watts,
        })
    }

    /// The planes whose intensities are in the file, in its order.
    fn listed(&self, head: &Head, planes: &[f64]) -> Result<Vec<f64>, Diagnostic> {
        let (span, symmetry) = &head.symmetry;
        let at = |angle: f64| {
            let place = planes.iter().position(|plane| *plane == angle);
            place.ok_or_else(|| {
                let message = format!(
                    "the symmetry {symmetry} needs a plane C{angle}, which is not among the planes"
                );
                self.0.error(span.clone(), message)
            })
        };
        Ok(match symmetry {
            0 => planes.to_vec(),
            1 => vec![0.0],
            2 => planes[at(0.0)?..=at(180.0)?].to_vec(),
            3 => {
                let before = planes[at(270.0)?..].iter().filter(|plane| **plane < 360.0);
                let before = before.map(|plane| plane - 360.0);
                before
                    .chain(planes[at(0.0)?..=at(90.0)?].iter().copied())
                    .collect()
            }
            _ => planes[at(0.0)?..=at(90.0)?].to_vec(),
        })
    }

    fn text(&mut self, what: &str) -> Result<(Range<usize>, String), Diagnostic> {
        if let Some((span, line)) = self.0.line() {
            return Ok((span, line.to_owned()));
        }
        let end = self.0.file.text.len();
        let message = format!("expected {what}, found the end of the file");
        Err(self.0.error(end.saturating_sub(1)..end, message))
    }

    /// A number; an empty line is 0.
    fn optional(&mut self, what: &str) -> Result<(Range<usize>, f64), Diagnostic> {
        let (span, text) = self.text(what)?;
        if text.is_empty() {
            return Ok((span, 0.0));
        }
        self.parse(span, &text, what)
    }

    fn parse(
        &self,
        span: Range<usize>,
        text: &str,
        what: &str,
    ) -> Result<(Range<usize>, f64), Diagnostic> {
        match text.replace(',', ".").parse::<f64>() {
            Ok(number) if number.is_finite() => Ok((span, number)),
            _ => {
                let message = format!("expected {what}, found \"{}\"", shortened(text));
                Err(self.0.error(span, message))
            }
        }
    }

    fn count(
        &mut self,
        what: &str,
        range: std::ops::RangeInclusive<usize>,
    ) -> Result<(Range<usize>, usize), Diagnostic> {
        let (span, number) = self.number(what)?;
        let whole = number as usize;
        if number.fract() == 0.0 && number >= 0.0 && range.contains(&whole) {
            return Ok((span, whole));
        }
        let (from, to) = (range.start(), range.end());
        let message = format!("expected {what}, {from} to {to}, found {number}");
        Err(self.0.error(span, message))
    }
}

impl Numbers for Reader<'_> {
    fn number(&mut self, what: &str) -> Result<(Range<usize>, f64), Diagnostic> {
        let (span, text) = self.text(what)?;
        self.parse(span, &text, what)
    }

    fn error(&self, span: Range<usize>, message: String) -> Diagnostic {
        self.0.error(span, message)
    }
}
