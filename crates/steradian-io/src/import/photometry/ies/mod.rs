//! IES LM-63 files of 1986, 1991, 1995, 2002 and 2019.
//!
//! A header, `TILT=`, and then numbers: lamps, lumens of each (−1: absolute photometry), multiplier, count of vertical and of
//! lateral angles, type (1 C, 2 B, 3 A), unit of lengths (1 feet, 2 metres), width, length and height of the opening, ballast
//! factor, a number whose meaning changed, watts, the angles, and the intensities of each lateral angle in turn.
//!
//! I = multiplier × ballast factor × table. The number after the ballast factor is one more factor in files up to 1991
//! (ballast-lamp photometric factor); later it is reserved, and in 2019 it tells how the file was made.
//!
//! The factor of `TILT` is not in the intensities: it holds where the luminaire hangs inclined.
//!
//! Source: ANSI/IES LM-63-02 and LM-63-19.

mod header;
mod table;

use std::path::Path;

use super::source::Source;
use super::{IntensityUnit, Photometry};
use crate::diagnostic::{Diagnostic, Severity};
use crate::files::Files;
use header::Header;
use table::Table;

/// The part of its flux that a lamp keeps when the luminaire is inclined.
#[derive(Clone, Debug, PartialEq)]
pub struct Tilt {
    /// How the lamp stands in the luminaire: 1 base up or down, 2 along C0 and level, 3 across and level.
    pub geometry: u32,
    /// Angles in degrees and factors.
    pub factors: Vec<(f64, f64)>,
}

pub(super) fn read(path: &Path, files: &dyn Files) -> Result<Photometry, Vec<Diagnostic>> {
    let alone = |problem: Diagnostic| vec![problem];
    let mut source = Source::read(path, files).map_err(alone)?;
    let header = Header::read(&mut source, path, files).map_err(alone)?;
    let table = Table::read(&mut source, &header).map_err(alone)?;
    let mut warnings = table.warnings.clone();
    let unit = header.unit(&source, &mut warnings);
    if let Some(rest) = source.rest() {
        let message = "what follows the last intensity is not read";
        warnings.push(warning(source.error(rest, message)));
    }
    Ok(Photometry {
        lamp_flux: table.lamp_flux(),
        lamps: table.lamps,
        watts: table.watts,
        other_sets: Vec::new(),
        opening: table.opening,
        side_heights: None,
        far_field: table.far_field,
        symmetry: table.symmetry,
        format: header.format,
        keywords: header.keywords,
        tilt: header.tilt,
        unit,
        warnings,
    })
}

/// The same as a warning.
fn warning(problem: Diagnostic) -> Diagnostic {
    Diagnostic {
        severity: Severity::Warning,
        ..problem
    }
}

impl Header {
    /// mW/sr where a keyword says so; a warning where other words hint at it.
    fn unit(&self, source: &Source, warnings: &mut Vec<Diagnostic>) -> IntensityUnit {
        let stated = self.keyword("_INTENSITYUNITS");
        if stated.is_some_and(is_milliwatt) {
            return IntensityUnit::MilliwattPerSteradian;
        }
        if self.keywords.iter().any(|(_, text)| is_milliwatt(text)) {
            let message = "the header speaks of mW/sr, but there is no [_INTENSITYUNITS] mW/sr: intensities are read as cd";
            warnings.push(warning(Diagnostic::error(message).about(&source.file)));
        }
        IntensityUnit::Candela
    }
}

fn is_milliwatt(text: &str) -> bool {
    text.to_ascii_lowercase().replace(' ', "").contains("mw/sr")
}
