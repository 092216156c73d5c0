//! The lines before the numbers.

use std::path::Path;

use super::Tilt;
use crate::diagnostic::Diagnostic;
use crate::files::Files;
use crate::import::photometry::source::{Source, shortened};

/// Years in which the standard changed.
#[derive(Copy, Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Edition {
    /// Without a line of version.
    Of1986,
    Of1991,
    Of1995,
    Of2002,
    Of2019,
}

pub(super) struct Header {
    pub edition: Edition,
    pub format: String,
    pub keywords: Vec<(String, String)>,
    pub tilt: Option<Tilt>,
}

/// Most lines before `TILT=`.
const MOST_LINES: usize = 1000;
/// Most angles of a table of tilts.
const MOST_TILTS: f64 = 1000.0;

impl Header {
    pub fn read(source: &mut Source, path: &Path, files: &dyn Files) -> Result<Self, Diagnostic> {
        let mut header = Self {
            edition: Edition::Of1986,
            format: "LM-63-1986".into(),
            keywords: Vec::new(),
            tilt: None,
        };
        for number in 0..MOST_LINES {
            let Some((span, line)) = source.line() else {
                break;
            };
            if let Some(tilt) = after_tilt(line) {
                let tilt = tilt.to_owned();
                header.tilt = read_tilt(&tilt, span, source, path, files)?;
                return Ok(header);
            }
            match edition(line).filter(|_| number == 0) {
                Some(edition) => (header.edition, header.format) = (edition, line.to_owned()),
                None => header.keywords.push(keyword(line)),
            }
        }
        let message =
            "expected a line TILT=NONE, TILT=INCLUDE or TILT=FILE, as every LM-63 file has";
        Err(Diagnostic::error(message).about(&source.file))
    }

    /// What a keyword says.
    pub fn keyword(&self, name: &str) -> Option<&str> {
        let found = self
            .keywords
            .iter()
            .find(|(key, _)| key.eq_ignore_ascii_case(name));
        found.map(|(_, text)| text.as_str())
    }
}

/// The edition that a first line names.
fn edition(line: &str) -> Option<Edition> {
    let line = line.to_ascii_uppercase().replace(' ', "");
    let known = [
        ("LM-63-2019", Edition::Of2019),
        ("LM-63-19", Edition::Of2019),
        ("LM-63-2002", Edition::Of2002),
        ("LM-63-1995", Edition::Of1995),
        ("LM-63-95", Edition::Of1995),
        ("LM-63-1991", Edition::Of1991),
        ("IESNA91", Edition::Of1991),
        ("IESNA95", Edition::Of1995),
        ("IESNA86", Edition::Of1986),
        ("LM-63-1986", Edition::Of1986),
    ];
    // "LM-63-19" begins "LM-63-1995" too, so the longest that is found counts.
    let found = known.into_iter().filter(|(name, _)| line.contains(name));
    found
        .max_by_key(|(name, _)| name.len())
        .map(|(_, edition)| edition)
}

/// `[KEY] text`.
fn keyword(line: &str) -> (String, String) {
    let parts = line.strip_prefix('[').and_then(|rest| rest.split_once(']'));
    let (key, text) = parts.unwrap_or(("", line));
    (key.trim().to_owned(), text.trim().to_owned())
}

fn after_tilt(line: &str) -> Option<&str> {
    let start = line.get(..4)?;
    let rest = line[4..].trim_start();
    start
        .eq_ignore_ascii_case("TILT")
        .then(|| rest.strip_prefix('='))?
        .map(str::trim)
}

fn read_tilt(
    tilt: &str,
    span: std::ops::Range<usize>,
    source: &mut Source,
    path: &Path,
    files: &dyn Files,
) -> Result<Option<Tilt>, Diagnostic> {
    if tilt.eq_ignore_ascii_case("NONE") {
        return Ok(None);
    }
    if tilt.eq_ignore_ascii_case("INCLUDE") {
        return table(source).map(Some);
    }
    if tilt.is_empty() {
        let message = "expected NONE, INCLUDE or the name of a file after TILT=";
        return Err(source.error(span, message));
    }
    let beside = path.parent().unwrap_or(Path::new("")).join(tilt);
    let mut other = Source::read(&beside, files).map_err(|problem| {
        let name = shortened(tilt);
        source.error(
            span,
            format!("cannot read the tilts of \"{name}\": {}", problem.message),
        )
    })?;
    table(&mut other).map(Some)
}

/// Geometry, count, angles and factors.
fn table(source: &mut Source) -> Result<Tilt, Diagnostic> {
    let (span, geometry) = source.number("the geometry of the lamp (1, 2 or 3)")?;
    if ![1.0, 2.0, 3.0].contains(&geometry) {
        let message = format!("the geometry of a lamp is 1, 2 or 3, not {geometry}");
        return Err(source.error(span, message));
    }
    let (span, count) = source.number("the number of angles of tilt")?;
    if count.fract() != 0.0 || !(1.0..=MOST_TILTS).contains(&count) {
        let message =
            format!("expected the number of angles of tilt, 1 to {MOST_TILTS}, found {count}");
        return Err(source.error(span, message));
    }
    let mut column = |what: &str| -> Result<Vec<f64>, Diagnostic> {
        (0..count as usize)
            .map(|_| Ok(source.number(what)?.1))
            .collect()
    };
    let angles = column("an angle of tilt")?;
    let factors = column("a factor of tilt")?;
    Ok(Tilt {
        geometry: geometry as u32,
        factors: angles.into_iter().zip(factors).collect(),
    })
}
