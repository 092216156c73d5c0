//! What a file of a measured surface holds: header, blocks, hemispherical totals, reciprocity, and what is wrong.

use std::path::Path;

use serde_json::{Value, json};
use steradian::brdf::measured::{Block, Side, TwoSided};
use steradian_io::files::DiskFiles;
use steradian_io::import::bsdf::reciprocity::{Deviation, deviation};
use steradian_io::import::bsdf::summary::{Total, gains, side, totals};
use steradian_io::import::bsdf::{Band, MeasuredFile, division, read, two_sided};
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::significant;

use crate::output::{self, Format};
use crate::status::{Failure, Outcome};

/// Name and version of the format.
const SCHEMA: &str = "steradian.inspect-measured/1";
/// Digits of what is printed.
const DIGITS: i32 = 4;

/// What is known of a file beyond what it holds.
struct Inspection {
    file: MeasuredFile,
    totals: Vec<Total>,
    findings: Vec<String>,
}

/// Prints the lists.
pub fn run(path: &Path, format: Format, strict: bool) -> Result<Outcome, Failure> {
    let fault = |error| Failure::message(format!("{}: {error}", path.display()));
    let file = read(path, &DiskFiles::default()).map_err(fault)?;
    let totals: Vec<_> = file.bands.iter().flat_map(totals).collect();
    let inspection = Inspection {
        findings: file
            .warnings
            .iter()
            .cloned()
            .chain(gains(&totals))
            .collect(),
        totals,
        file,
    };
    output::print(&match format {
        Format::Table => inspection.table(path),
        Format::Json => format!("{:#}\n", inspection.json(path)),
    })?;
    Ok(Outcome::fine_if(inspection.findings.is_empty() || !strict))
}

impl Inspection {
    fn table(&self, path: &Path) -> String {
        let mut heading = Columns::new([path.display().to_string(), self.file.format.to_owned()]);
        for (name, value) in &self.file.header {
            heading.row([name, value]);
        }
        let blocks = self.blocks();
        let mut sections = vec![
            heading.to_string(),
            self.block_table(&blocks),
            self.total_table(),
        ];
        sections.push(self.reciprocity_table(&blocks));
        let findings = self
            .findings
            .iter()
            .map(|finding| format!("Warning: {finding}\n"));
        sections.push(findings.collect());
        sections.retain(|section| !section.is_empty());
        sections.join("\n")
    }

    fn blocks(&self) -> Vec<Entry<'_>> {
        self.file.bands.iter().flat_map(entries).collect()
    }

    fn block_table(&self, blocks: &[Entry]) -> String {
        if blocks.is_empty() {
            return String::new();
        }
        let mut columns = Columns::new(["band", "block", "divided by"]);
        for entry in blocks {
            columns.row([entry.band.to_owned(), entry.name(), division(entry.block)]);
        }
        columns.to_string()
    }

    fn total_table(&self) -> String {
        let headings = [
            "light from",
            "theta_i (deg)",
            "reflected",
            "transmitted",
            "largest sum",
        ];
        let mut columns = Columns::new(["channel"].into_iter().chain(headings));
        for total in &self.totals {
            let numbers = [
                total.theta,
                total.reflected,
                total.transmitted,
                total.largest,
            ];
            let numbers = numbers.map(|value| significant(value, DIGITS));
            let names = [total.channel.clone(), side(total.from).to_owned()];
            columns.row(names.into_iter().chain(numbers));
        }
        (2..6).fold(columns, Columns::right_aligned).to_string()
    }

    fn reciprocity_table(&self, blocks: &[Entry]) -> String {
        if blocks.is_empty() {
            return String::new();
        }
        let headings = ["not reciprocal by: least", "mean", "largest"];
        let mut columns = Columns::new(["band", "block"].into_iter().chain(headings));
        for entry in blocks {
            let Some(found) = entry.deviation() else {
                continue;
            };
            let numbers = [found.least, found.mean, found.largest];
            let numbers = numbers.map(|part| format!("{:.1} %", 100.0 * part));
            columns.row(
                [entry.band.to_owned(), entry.name()]
                    .into_iter()
                    .chain(numbers),
            );
        }
        (2..5).fold(columns, Columns::right_aligned).to_string()
    }

    fn json(&self, path: &Path) -> Value {
        let header = self
            .file
            .header
            .iter()
            .map(|(name, value)| json!({ "name": name, "value": value }));
        json!({
            "schema": SCHEMA,
            "version": env!("CARGO_PKG_VERSION"),
            "file": path.display().to_string(),
            "format": self.file.format,
            "header": header.collect::<Vec<_>>(),
            "bands": self.file.bands.iter().map(|band| &band.name).collect::<Vec<_>>(),
            "blocks": self.blocks().iter().map(Entry::json).collect::<Vec<_>>(),
            "totals": self.totals.iter().map(total_json).collect::<Vec<_>>(),
            "findings": self.findings,
        })
    }
}

/// A block of a band.
struct Entry<'a> {
    band: &'a str,
    table: &'a TwoSided,
    block: &'a Block,
    from: Side,
    to: Side,
}

fn entries(band: &Band) -> Vec<Entry<'_>> {
    let Some(table) = two_sided(&band.model) else {
        return vec![];
    };
    let sides = [Side::Above, Side::Below];
    let ways = sides
        .map(|from| (from, from))
        .into_iter()
        .chain(sides.map(|from| (from, from.other())));
    let entry = |(from, to): (Side, Side)| {
        let block = match from == to {
            true => table.reflection(from),
            false => table.transmission(from),
        };
        Some(Entry {
            band: &band.name,
            table,
            block: block?,
            from,
            to,
        })
    };
    ways.filter_map(entry).collect()
}

impl Entry<'_> {
    fn name(&self) -> String {
        let what = if self.from == self.to {
            "reflection"
        } else {
            "transmission"
        };
        format!("{what} of light from {}", side(self.from))
    }

    fn deviation(&self) -> Option<Deviation> {
        deviation(self.table, self.from, self.to)
    }

    fn json(&self) -> Value {
        let deviation = self.deviation();
        json!({
            "band": self.band,
            "kind": if self.from == self.to { "reflection" } else { "transmission" },
            "from": side(self.from),
            "divided_by": division(self.block),
            "reciprocity_deviation": deviation.map(|found| json!({
                "least": found.least,
                "mean": found.mean,
                "largest": found.largest,
            })),
        })
    }
}

fn total_json(total: &Total) -> Value {
    json!({
        "channel": total.channel,
        "from": side(total.from),
        "theta_i_degrees": total.theta,
        "reflected": total.reflected,
        "transmitted": total.transmitted,
        "largest_sum": total.largest,
    })
}
