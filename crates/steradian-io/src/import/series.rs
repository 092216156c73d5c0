//! Records in time from a CSV file: times in the first column, one record in each other column.
//!
//! The first line names every column with its unit, `time (h),flux (W)`; brackets may be square. Columns are parted by commas,
//! semicolons or tabs. Empty lines and lines that begin with `#` are skipped.
//!
//! ```
//! use std::path::Path;
//! use steradian_io::files::MemoryFiles;
//! use steradian_io::import::series::{RATES, read_series};
//!
//! let files = MemoryFiles::default().with("lamp.csv", "time (min),lamp (mW)\n0,500\n2,1500\n");
//! let record = read_series(Path::new("lamp.csv"), &RATES, &files).unwrap();
//! assert_eq!(record.times[1].to_seconds(), 120.0);
//! assert_eq!((record.columns[0].name.as_str(), record.columns[0].table.quantity), ("lamp", "flux"));
//! assert_eq!(record.columns[0].values, [0.5, 1.5]); // in W
//! ```

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use steradian::quantity::{
    Energy, Flux, Illuminance, Irradiance, LuminousEnergy, LuminousExposure, LuminousFlux,
    Quantity, RadiantExposure, Time, Unit, UnitTable,
};

use crate::diagnostic::{Diagnostic, SourceFile};
use crate::files::Files;

/// Largest file in bytes.
pub const LARGEST_FILE: usize = 64 << 20;
/// Problems after which reading ends.
const MOST_PROBLEMS: usize = 50;
/// What flows: quantities that add up in time.
pub const RATES: [&UnitTable; 4] = [
    Flux::TABLE,
    Irradiance::TABLE,
    LuminousFlux::TABLE,
    Illuminance::TABLE,
];
/// What a meter counts: the integrals of [`RATES`].
pub const TOTALS: [&UnitTable; 4] = [
    Energy::TABLE,
    RadiantExposure::TABLE,
    LuminousEnergy::TABLE,
    LuminousExposure::TABLE,
];

/// Records over the same times, of which there are at least two.
#[derive(Clone, Debug, PartialEq)]
pub struct SeriesFile {
    /// When; they increase.
    pub times: Vec<Time>,
    /// The records; at least one.
    pub columns: Vec<Column>,
}

/// One record.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its heading without the unit.
    pub name: String,
    /// What it is a record of.
    pub table: &'static UnitTable,
    /// A finite value for each time, in SI units.
    pub values: Vec<f64>,
}

/// Reads the records of a file, each of one of these quantities.
///
/// # Errors
/// Every heading without its unit, every field that is no finite number, every time that is not later than the one before
/// it; a file that cannot be read, or has fewer than two rows.
pub fn read_series(
    path: &Path,
    quantities: &'static [&'static UnitTable],
    files: &dyn Files,
) -> Result<SeriesFile, Vec<Diagnostic>> {
    let source = |text: String| {
        Arc::new(SourceFile {
            name: path.display().to_string(),
            text,
        })
    };
    let refuse = |message: String| vec![Diagnostic::error(message).about(&source(String::new()))];
    let bytes = files
        .read(path)
        .map_err(|error| refuse(format!("cannot read the series: {error}")))?;
    if bytes.len() > LARGEST_FILE {
        return Err(refuse(format!(
            "larger than the limit of {LARGEST_FILE} bytes"
        )));
    }
    let text =
        String::from_utf8(bytes).map_err(|_| refuse("the series is not UTF-8 text".to_owned()))?;
    let reader = Reader {
        file: source(text),
        quantities,
        problems: Vec::new(),
    };
    reader.read()
}

/// A field and where it is.
type Field<'a> = (Range<usize>, &'a str);

struct Reader {
    file: Arc<SourceFile>,
    quantities: &'static [&'static UnitTable],
    problems: Vec<Diagnostic>,
}

impl Reader {
    fn problem(&mut self, place: Range<usize>, message: impl Into<String>) {
        let problem = Diagnostic::error(message).at(&self.file, place);
        self.problems.push(problem);
    }

    fn read(mut self) -> Result<SeriesFile, Vec<Diagnostic>> {
        let file = Arc::clone(&self.file);
        let mut lines = content(&file.text);
        let headings = lines.next().map(|line| fields(&file.text, line));
        let Some((time, mut columns)) = headings.and_then(|fields| self.headings(&fields)) else {
            if self.problems.is_empty() {
                let example = example(self.quantities);
                let message = format!(
                    "expected a first line that names each column with its unit: time (s),{example}"
                );
                self.problems.push(Diagnostic::error(message).about(&file));
            }
            return Err(self.problems);
        };
        let mut times = Vec::new();
        for line in lines {
            self.row(&fields(&file.text, line), time, &mut times, &mut columns);
            if self.problems.len() >= MOST_PROBLEMS {
                break;
            }
        }
        if self.problems.is_empty() && times.len() < 2 {
            let message = format!("at least two rows are needed, found {}", times.len());
            self.problems.push(Diagnostic::error(message).about(&file));
        }
        if !self.problems.is_empty() {
            return Err(self.problems);
        }
        let columns = columns.into_iter().map(|(column, _)| column).collect();
        Ok(SeriesFile { times, columns })
    }

    /// The unit of time, and the other columns with their units; none if a heading is wrong.
    fn headings(
        &mut self,
        fields: &[Field<'_>],
    ) -> Option<(&'static Unit, Vec<(Column, &'static Unit)>)> {
        let (first, others) = fields.split_first()?;
        let time = self.heading(first, &[Time::TABLE], "time (s)");
        let example = example(self.quantities);
        let columns: Vec<Option<_>> = others
            .iter()
            .map(|field| {
                let (name, table, unit) = self.heading(field, self.quantities, &example)?;
                let (name, values) = (name.to_owned(), Vec::new());
                Some((
                    Column {
                        name,
                        table,
                        values,
                    },
                    unit,
                ))
            })
            .collect();
        if others.is_empty() {
            let message = format!("expected a second column such as \"{example}\"");
            self.problem(first.0.clone(), message);
        }
        let columns: Option<Vec<_>> = columns.into_iter().collect();
        Some((time?.2, columns.filter(|columns| !columns.is_empty())?))
    }

    /// Name, quantity and unit of a heading.
    fn heading<'a>(
        &mut self,
        (place, text): &Field<'a>,
        tables: &[&'static UnitTable],
        example: &str,
    ) -> Option<(&'a str, &'static UnitTable, &'static Unit)> {
        let Some((name, unit)) = named_unit(text) else {
            let message =
                format!("expected a heading with its unit such as \"{example}\", found \"{text}\"");
            self.problem(place.clone(), message);
            return None;
        };
        let measured_by = |tables: &[&'static UnitTable]| {
            let mut tables = tables.iter();
            tables.find_map(|table| Some((name, *table, table.find(unit)?)))
        };
        let found = measured_by(tables);
        if found.is_none() {
            let names: Vec<&str> = tables.iter().map(|table| table.quantity).collect();
            let other = measured_by(&RATES).or_else(|| measured_by(&TOTALS));
            let known = other.map_or_else(
                || "not known".to_owned(),
                |(_, table, _)| format!("a unit of {}", table.quantity),
            );
            let message = format!(
                "expected a unit of {}; \"{unit}\" is {known}",
                names.join(" or ")
            );
            self.problem(place.clone(), message);
        }
        found
    }

    fn row(
        &mut self,
        fields: &[Field<'_>],
        time: &Unit,
        times: &mut Vec<Time>,
        columns: &mut [(Column, &Unit)],
    ) {
        let (Some(first), Some(last)) = (fields.first(), fields.last()) else {
            return;
        };
        if fields.len() != columns.len() + 1 {
            let (expected, found) = (columns.len() + 1, fields.len());
            let message = format!("expected {expected} columns, found {found}");
            return self.problem(first.0.start..last.0.end, message);
        }
        let before = times.last().copied();
        if let Some(now) = self.number(first, time).map(Time::from_seconds) {
            if let Some(before) = before.filter(|before| *before >= now) {
                let message = format!("times must increase: {now} follows {before}");
                self.problem(first.0.clone(), message);
            }
            times.push(now);
        }
        for (field, (column, unit)) in fields[1..].iter().zip(columns) {
            column.values.extend(self.number(field, unit));
        }
    }

    /// A finite number in SI units.
    fn number(&mut self, (place, text): &Field<'_>, unit: &Unit) -> Option<f64> {
        let number = text.parse::<f64>().ok().map(|number| unit.to_si(number));
        let number = number.filter(|number| number.is_finite());
        if number.is_none() {
            let message = format!(
                "expected a finite number in {}, found \"{text}\"",
                unit.symbol
            );
            self.problem(place.clone(), message);
        }
        number
    }
}

/// The places of lines that are neither empty nor comments.
fn content(text: &str) -> impl Iterator<Item = Range<usize>> {
    let starts = text.split_inclusive('\n').scan(0, |next, line| {
        let start = *next;
        *next += line.len();
        Some((start, line))
    });
    let start_of_file = |start| if start == 0 { '\u{feff}' } else { '\n' };
    starts
        .map(move |(start, line)| {
            let text = line.trim_start_matches(start_of_file(start)).trim();
            let start = start + line.find(text).unwrap_or(0);
            (text, start..start + text.len())
        })
        .filter(|(text, _)| !text.is_empty() && !text.starts_with('#'))
        .map(|(_, place)| place)
}

/// The fields of a line, without spaces and quotation marks.
fn fields(text: &str, line: Range<usize>) -> Vec<Field<'_>> {
    let content = &text[line.clone()];
    let marks = [';', '\t'];
    let separator = marks.into_iter().find(|mark| content.contains(*mark));
    let parts = content.split_inclusive(separator.unwrap_or(','));
    let mut next = line.start;
    let mut all: Vec<Field<'_>> = Vec::new();
    for part in parts {
        let trimmed = part
            .trim_end_matches(separator.unwrap_or(','))
            .trim()
            .trim_matches('"')
            .trim();
        let start = next + part.find(trimmed).unwrap_or(0);
        all.push((start..start + trimmed.len(), trimmed));
        next += part.len();
    }
    if content.ends_with(separator.unwrap_or(',')) {
        all.push((line.end..line.end, ""));
    }
    all
}

/// A heading: `flux (W)`.
fn example(quantities: &[&UnitTable]) -> String {
    let first = quantities.first().copied().unwrap_or(Flux::TABLE);
    format!("{} ({})", first.quantity, first.si)
}

/// `flux (W)` or `flux [W]`: a name and a unit.
fn named_unit(text: &str) -> Option<(&str, &str)> {
    let (open, close) = if text.ends_with(']') {
        ('[', ']')
    } else {
        ('(', ')')
    };
    let (name, unit) = text.strip_suffix(close)?.split_once(open)?;
    let (name, unit) = (name.trim(), unit.trim());
    Some((name, unit)).filter(|_| !name.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::render;
    use crate::files::MemoryFiles;

    fn read(text: &str) -> Result<SeriesFile, Vec<Diagnostic>> {
        read_series(
            Path::new("s.csv"),
            &RATES,
            &MemoryFiles::default().with("s.csv", text),
        )
    }

    fn message(text: &str) -> String {
        render(&read(text).unwrap_err(), false)
    }

    #[test]
    fn dialects_of_csv() {
        let expected = read("time (s),a (W),b (lx)\n0,1,2\n60,3,4\n").unwrap();
        assert_eq!(expected.columns[1].table, Illuminance::TABLE);
        for text in [
            "\u{feff}time [min];\"a [W]\";b (klx)\r\n0; 1 ;2e-3\r\n1;3;4e-3\r\n",
            "# a lamp\n\ntime (s)\ta (mW)\tb (lx)\n0\t1000\t2\n# here\n60\t3000\t4\n",
        ] {
            assert_eq!(read(text).unwrap(), expected, "{text}");
        }
    }

    #[test]
    fn units_in_parentheses_may_have_their_own() {
        assert_eq!(named_unit("E (W/(m2 sr))"), Some(("E", "W/(m2 sr)")));
        assert_eq!(named_unit("E [W/m2]"), Some(("E", "W/m2")));
        assert_eq!(named_unit("E"), None);
        assert_eq!(named_unit("(W)"), None);
    }

    #[test]
    fn every_problem_is_shown_with_its_line_and_column() {
        let text = message("time (s),a (W)\n0,1\n0,2\n1,x\n2\n3,nan\n4,1,\n");
        for part in [
            "s.csv:3:1",
            "times must increase: 0 s follows 0 s",
            "s.csv:4:3",
            "expected a finite number in W, found \"x\"",
            "s.csv:5:1",
            "expected 2 columns, found 1",
            "found \"nan\"",
            "expected 2 columns, found 3",
        ] {
            assert!(text.contains(part), "{part} is not in\n{text}");
        }
    }

    #[test]
    fn headings_need_units_of_the_right_kind() {
        for (file, expected) in [
            (
                "0,1\n1,2\n",
                "expected a heading with its unit such as \"time (s)\", found \"0\"",
            ),
            (
                "time (s),flux\n0,1\n1,2\n",
                "such as \"flux (W)\", found \"flux\"",
            ),
            (
                "time (W),flux (W)\n0,1\n1,2\n",
                "expected a unit of time; \"W\" is a unit of flux",
            ),
            (
                "time (s),mass (kg)\n0,1\n1,2\n",
                "or illuminance; \"kg\" is not known",
            ),
            ("time (s)\n0\n1\n", "expected a second column"),
            ("", "expected a first line that names each column"),
            (
                "time (s),flux (W)\n0,1\n",
                "at least two rows are needed, found 1",
            ),
            ("time (s),flux (W)\n", "found 0"),
        ] {
            let text = message(file);
            assert!(text.contains(expected), "{expected} is not in\n{text}");
        }
    }

    #[test]
    fn a_file_of_nonsense_is_not_read_to_its_end() {
        let text = format!("time (s),flux (W)\n{}", "a,b\n".repeat(10_000));
        assert!(read(&text).unwrap_err().len() <= MOST_PROBLEMS + 1);
        let missing = read_series(Path::new("q.csv"), &RATES, &MemoryFiles::default()).unwrap_err();
        assert!(missing[0].message.contains("cannot read"));
    }
}
