//! What is known of surfaces that exchange heat, from a CSV file.
//!
//! A heading names the columns: `surface`, and any of `emissivity` (0 to 1), `temperature` (K), `exitance` (W/m², emitted) and `net_flux`
//! (W/m², 0 for an insulated surface). Each line has just one of the last three. A surface is named as the matrix names it; the name of an
//! object stands for all its faces, and `*` for every surface that no other line names. Empty lines and lines that begin with `#`
//! are skipped.

use std::path::Path;

use steradian::exchange::radiosity::Boundary;
use thiserror::Error;

use crate::files::{Files, reason};

/// A line of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundaryLine {
    /// The surface, the object or `*`.
    pub surface: String,
    /// ε; none leaves it to the material.
    pub emissivity: Option<f64>,
    /// What is known.
    pub boundary: Boundary,
}

/// Why a file is no list of boundaries.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BoundaryError {
    /// It cannot be read.
    #[error("cannot read {path}: {reason}")]
    File {
        /// The file.
        path: String,
        /// Why.
        reason: String,
    },
    /// The heading lacks what is needed.
    #[error(
        "{0}: the heading names a column `surface` and some of emissivity, temperature, exitance, net_flux"
    )]
    Heading(String),
    /// A column that is not known.
    #[error(
        "{path}: there is no column `{column}`; expected surface, emissivity, temperature, exitance, net_flux"
    )]
    Column {
        /// The file.
        path: String,
        /// Its name.
        column: String,
    },
    /// A line that is wrong.
    #[error("{path}, line {line}: {message}")]
    Line {
        /// The file.
        path: String,
        /// Its number, from 1.
        line: u64,
        /// What is wrong.
        message: String,
    },
}

const COLUMNS: [&str; 5] = [
    "surface",
    "emissivity",
    "temperature",
    "exitance",
    "net_flux",
];

/// The lines of a file.
///
/// # Errors
/// The first thing that is wrong.
pub fn read_boundaries(path: &Path, files: &dyn Files) -> Result<Vec<BoundaryLine>, BoundaryError> {
    let name = path.display().to_string();
    let bytes = files.read(path).map_err(|error| BoundaryError::File {
        path: name.clone(),
        reason: reason(&error),
    })?;
    parse(&name, &bytes)
}

fn parse(path: &str, bytes: &[u8]) -> Result<Vec<BoundaryLine>, BoundaryError> {
    let mut builder = csv::ReaderBuilder::new();
    let builder = builder.trim(csv::Trim::All).comment(Some(b'#'));
    let mut reader = builder.from_reader(bytes);
    let heading = reader
        .headers()
        .map_err(|error| wrong(path, &error))?
        .clone();
    if let Some(column) = heading.iter().find(|column| !COLUMNS.contains(column)) {
        let (path, column) = (path.to_owned(), column.to_owned());
        return Err(BoundaryError::Column { path, column });
    }
    let places = COLUMNS.map(|column| heading.iter().position(|name| name == column));
    let [Some(surface), numbers @ ..] = places else {
        return Err(BoundaryError::Heading(path.to_owned()));
    };
    let mut lines = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| wrong(path, &error))?;
        let fail = |message: String| BoundaryError::Line {
            path: path.to_owned(),
            line: record.position().map_or(0, csv::Position::line),
            message,
        };
        let fields = numbers.map(|place| place.and_then(|place| record.get(place)).unwrap_or(""));
        lines.push(line(&record[surface], fields).map_err(fail)?);
    }
    Ok(lines)
}

fn wrong(path: &str, error: &csv::Error) -> BoundaryError {
    BoundaryError::Line {
        path: path.to_owned(),
        line: error.position().map_or(1, csv::Position::line),
        message: error.to_string(),
    }
}

fn line(surface: &str, fields: [&str; 4]) -> Result<BoundaryLine, String> {
    let number = |text: &str| match text {
        "" => Ok(None),
        text => match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(Some(number)),
            _ => Err(format!("`{text}` is no number")),
        },
    };
    if surface.is_empty() {
        return Err("the surface has no name; `*` is every other one".to_owned());
    }
    let [emissivity, temperature, exitance, net_flux] = fields.map(number);
    let known = [
        temperature?.map(Boundary::Temperature),
        exitance?.map(Boundary::Exitance),
        net_flux?.map(Boundary::NetFlux),
    ];
    let mut known = known.into_iter().flatten();
    let (Some(boundary), None) = (known.next(), known.next()) else {
        return Err("give one of temperature, exitance and net_flux".to_owned());
    };
    Ok(BoundaryLine {
        surface: surface.to_owned(),
        emissivity: emissivity?,
        boundary,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_in_any_order_and_fields_left_out() {
        let text = "surface,temperature,emissivity,net_flux\n# walls\nroom/0, 300, 0.9,\n\n*,,,0\n";
        let lines = parse("b.csv", text.as_bytes()).unwrap();
        let expected = |surface: &str, emissivity, boundary| BoundaryLine {
            surface: surface.to_owned(),
            emissivity,
            boundary,
        };
        let wall = expected("room/0", Some(0.9), Boundary::Temperature(300.0));
        assert_eq!(lines, [wall, expected("*", None, Boundary::NetFlux(0.0))]);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let message = |text: &str| parse("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(message("name,temperature\na,1\n").contains("no column `name`"));
        assert!(message("temperature\n1\n").contains("heading"));
        assert!(message("surface,temperature\na,hot\n").contains("line 2: `hot` is no number"));
        assert!(message("surface,temperature\na,nan\n").contains("line 2: `nan` is no number"));
        assert!(message("surface,temperature\n,1\n").contains("line 2: the surface has no name"));
        assert!(message("surface,temperature,exitance\na,1,2\n").contains("give one of"));
        assert!(message("surface,temperature\na\n").contains("line 2"));
    }
}
