//! Spectra from a CSV file: wavelengths in nm in the first column, one spectrum in each other column.
//!
//! Columns are parted by commas, semicolons or tabs. Lines that do not begin with a number and come before the first that
//! does are headings, of which the last names the columns. Empty lines and lines that begin with `#` are skipped; so are
//! rows whose field in the wanted column is empty.
//!
//! ```
//! use steradian::spectrum::Beyond;
//! use steradian_io::import::spectrum;
//!
//! let file = b"nm,white,black\n400,0.8,0.03\n700,0.9,0.05\n";
//! let black = spectrum::read(file, Some("black"), Beyond::Held)?;
//! assert!((black.at(550.0) - 0.04).abs() < 1e-15);
//! assert_eq!(spectrum::read(file, None, Beyond::Held)?.at(400.0), 0.8);
//! # Ok::<(), spectrum::SpectrumError>(())
//! ```

use steradian::spectrum::{Beyond, Curve, CurveError};
use thiserror::Error;

/// Largest file in bytes.
pub const LARGEST_FILE: usize = 64 << 20;
/// Rows of a spectrum at most.
pub const MOST_ROWS: usize = 1_000_000;
/// Wavelengths in nm outside of which a first column is taken to have another unit.
const WAVELENGTHS: [f64; 2] = [10.0, 1e6];

/// What is wrong with a file of spectra.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SpectrumError {
    /// Too many bytes.
    #[error("larger than the limit of {LARGEST_FILE} bytes")]
    TooLarge,
    /// Too many rows.
    #[error("line {line}: more than {MOST_ROWS} rows")]
    TooManyRows {
        /// Number of the line, from 1.
        line: usize,
    },
    /// Bytes that are not UTF-8.
    #[error("not UTF-8 text")]
    NotText,
    /// No row of numbers.
    #[error("no spectrum: expected rows of numbers, a wavelength in nm and a value")]
    Empty,
    /// A column that is not there.
    #[error("there is no column {name:?}; the columns are {columns}")]
    NoColumn {
        /// What was asked for.
        name: String,
        /// What there is.
        columns: String,
    },
    /// A column by name in a file without headings.
    #[error("there is no column {name:?}: the file does not name its columns")]
    NoHeading {
        /// What was asked for.
        name: String,
    },
    /// A field that is no finite number.
    #[error("line {line}: expected a number, found {found:?}")]
    NotNumber {
        /// Number of the line, from 1.
        line: usize,
        /// The field.
        found: String,
    },
    /// A row that ends before the wanted column.
    #[error("line {line}: expected {expected} columns, found {found}")]
    ShortRow {
        /// Number of the line, from 1.
        line: usize,
        /// Columns up to the wanted one.
        expected: usize,
        /// Columns that there are.
        found: usize,
    },
    /// A wavelength of another unit.
    #[error("line {line}: {wavelength} is no wavelength in nm; convert the first column to nm")]
    Unit {
        /// Number of the line, from 1.
        line: usize,
        /// What was found.
        wavelength: f64,
    },
    /// Wavelengths that do not increase.
    #[error("line {line}: wavelengths must increase, but {wavelength} nm follows {previous} nm")]
    NotIncreasing {
        /// Number of the line, from 1.
        line: usize,
        /// Its wavelength in nm.
        wavelength: f64,
        /// The one before it in nm.
        previous: f64,
    },
    /// Samples that are no curve.
    #[error(transparent)]
    Curve(#[from] CurveError),
}

/// The spectrum in the column of this name, or in the second.
///
/// # Errors
/// If the file is too large, has no such column, or a row is not a wavelength above the last one and a number.
pub fn read(bytes: &[u8], column: Option<&str>, beyond: Beyond) -> Result<Curve, SpectrumError> {
    if bytes.len() > LARGEST_FILE {
        return Err(SpectrumError::TooLarge);
    }
    let text = std::str::from_utf8(bytes).map_err(|_| SpectrumError::NotText)?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lines: Vec<(usize, &str)> = content(text).collect();
    let rows_at = lines.iter().position(|(_, line)| begins_with_number(line));
    let (headings, rows) = lines.split_at(rows_at.ok_or(SpectrumError::Empty)?);
    let separator = separator(rows[0].1);
    let heading = headings.last().map(|(_, heading)| *heading);
    let column = column_number(heading, separator, column)?;
    let samples = samples(rows, separator, column)?;
    Ok(Curve::new(samples, beyond)?)
}

/// The lines that are neither empty nor comments, numbered from 1.
fn content(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.lines().map(str::trim).zip(1..);
    lines
        .map(|(line, number)| (number, line))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}

fn begins_with_number(line: &str) -> bool {
    let first = line.split([',', ';', '\t']).next().unwrap_or_default();
    number(first).is_some()
}

fn separator(row: &str) -> char {
    [';', '\t']
        .into_iter()
        .find(|mark| row.contains(*mark))
        .unwrap_or(',')
}

fn unquoted(field: &str) -> &str {
    let field = field.trim();
    let inner = field
        .strip_prefix('"')
        .and_then(|rest| rest.strip_suffix('"'));
    inner.unwrap_or(field).trim()
}

fn number(field: &str) -> Option<f64> {
    unquoted(field)
        .parse()
        .ok()
        .filter(|number: &f64| number.is_finite())
}

/// Number of the wanted column; that of the wavelengths is 0.
fn column_number(
    heading: Option<&str>,
    separator: char,
    wanted: Option<&str>,
) -> Result<usize, SpectrumError> {
    let Some(name) = wanted else {
        return Ok(1);
    };
    let heading = heading.ok_or_else(|| SpectrumError::NoHeading { name: name.into() })?;
    let names: Vec<&str> = heading.split(separator).map(unquoted).collect();
    let place = names.iter().skip(1).position(|known| *known == name);
    place
        .map(|place| place + 1)
        .ok_or_else(|| SpectrumError::NoColumn {
            name: name.into(),
            columns: names[1..].join(", "),
        })
}

fn samples(
    rows: &[(usize, &str)],
    separator: char,
    column: usize,
) -> Result<Vec<(f64, f64)>, SpectrumError> {
    if let Some(&(line, _)) = rows.get(MOST_ROWS) {
        return Err(SpectrumError::TooManyRows { line });
    }
    let mut samples: Vec<(f64, f64)> = Vec::with_capacity(rows.len());
    for &(line, row) in rows {
        let Some((wavelength, value)) = sample(line, row, separator, column)? else {
            continue;
        };
        if let Some(&(previous, _)) = samples.last()
            && wavelength <= previous
        {
            return Err(SpectrumError::NotIncreasing {
                line,
                wavelength,
                previous,
            });
        }
        samples.push((wavelength, value));
    }
    Ok(samples)
}

/// Wavelength and value of a row; none if the value is empty.
fn sample(
    line: usize,
    row: &str,
    separator: char,
    column: usize,
) -> Result<Option<(f64, f64)>, SpectrumError> {
    let fields: Vec<&str> = row.split(separator).map(unquoted).collect();
    let field = fields.get(column).ok_or(SpectrumError::ShortRow {
        line,
        expected: column + 1,
        found: fields.len(),
    })?;
    let read = |field: &str| {
        let found = || SpectrumError::NotNumber {
            line,
            found: field.into(),
        };
        number(field).ok_or_else(found)
    };
    let wavelength = read(fields[0])?;
    if !(WAVELENGTHS[0]..=WAVELENGTHS[1]).contains(&wavelength) {
        return Err(SpectrumError::Unit { line, wavelength });
    }
    if field.is_empty() {
        return Ok(None);
    }
    Ok(Some((wavelength, read(field)?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(text: &str, column: Option<&str>) -> Result<Curve, SpectrumError> {
        read(text.as_bytes(), column, Beyond::Zero)
    }

    fn message(file: &str, column: Option<&str>) -> String {
        text(file, column).unwrap_err().to_string()
    }

    #[test]
    fn dialects_of_csv() {
        let expected = Curve::new(vec![(400.0, 1.0), (500.0, 2.5)], Beyond::Zero).unwrap();
        for file in [
            "400,1\n500,2.5",
            "\u{feff}nm;value\r\n400;1\r\n500;2.5\r\n",
            "# measured\n\nnm\tvalue\n400\t1\n500\t2.5e0\n",
            "A title of the table,,\nwavelength,\"value\"\n\"400\", 1 ,x\n500,2.5\n",
        ] {
            assert_eq!(text(file, None).unwrap(), expected, "{file}");
        }
    }

    #[test]
    fn columns_are_chosen_by_name() {
        let file = "nm,white (a),black\n400,0.8,0.1\n410,,0.2\n420,0.9,0.3\n";
        assert_eq!(text(file, Some("black")).unwrap().at(410.0), 0.2);
        let white = text(file, Some("white (a)")).unwrap();
        assert_eq!(white.wavelengths(), [400.0, 420.0]);
        assert_eq!(
            message(file, Some("grey")),
            "there is no column \"grey\"; the columns are white (a), black"
        );
        assert!(message("400,1\n", Some("x")).contains("does not name"));
        // The wavelengths are no spectrum.
        assert!(text(file, Some("nm")).is_err());
    }

    #[test]
    fn problems_name_their_line() {
        for (file, expected) in [
            (
                "nm,v\n400,1\n500,x\n",
                "line 3: expected a number, found \"x\"",
            ),
            ("400,1\n500\n", "line 2: expected 2 columns, found 1"),
            (
                "400,1\n\n400,2\n",
                "line 3: wavelengths must increase, but 400 nm follows 400 nm",
            ),
            ("0.4,1\n", "line 1: 0.4 is no wavelength in nm"),
            ("400,1\nabc,2\n", "line 2: expected a number, found \"abc\""),
            (
                "400,1\n500,inf\n",
                "line 2: expected a number, found \"inf\"",
            ),
            ("nm,v\n", "no spectrum"),
            ("", "no spectrum"),
            ("400,\n", "at least one sample"),
        ] {
            let message = message(file, None);
            assert!(message.contains(expected), "{message}");
        }
        assert_eq!(
            read(&[0xff, 0xfe], None, Beyond::Zero),
            Err(SpectrumError::NotText)
        );
    }

    #[test]
    fn long_files_are_refused() {
        let rows = (0..=MOST_ROWS).map(|row| format!("{},1\n", 400.0 + row as f64 * 1e-3));
        let error = text(&rows.collect::<String>(), None);
        assert_eq!(
            error,
            Err(SpectrumError::TooManyRows {
                line: MOST_ROWS + 1
            })
        );
        let large = vec![b'#'; LARGEST_FILE + 1];
        assert_eq!(
            read(&large, None, Beyond::Zero),
            Err(SpectrumError::TooLarge)
        );
    }
}
