//! Matrices of form factors, row by row.

use serde_json::{Value, json};
use steradian::estimation::Method;
use steradian::exchange::{Entry, MatrixSummary, Residual, Row, Uncertain};

use super::ReportError;
use super::columns::Columns;
use super::npz::{self, Array};
use super::numbers::{exact, with_half_width};

/// Names the shape of the JSON object.
pub const SCHEMA: &str = "steradian.form-factors/1";

/// What is told beside the factors.
#[derive(Clone, Debug)]
pub struct FactorReport {
    /// Names of the surfaces.
    pub names: Vec<String>,
    /// Their areas in m².
    pub areas: Vec<f64>,
    /// Hash of the scene.
    pub scene_hash: String,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Version of the program.
    pub version: String,
    /// Probability of the printed intervals.
    pub confidence: f64,
}

impl FactorReport {
    /// The first line of a CSV file.
    pub const CSV_HEAD: &str = "from,to,from_name,to_name,value,std_error,method\n";

    /// A row as lines of CSV; `sky` is a surface without number.
    pub fn csv_row(&self, row: &Row) -> String {
        let from = quoted(&self.names[row.from]);
        let mut lines = String::new();
        for entry in &row.entries {
            let to = quoted(&self.names[entry.to as usize]);
            let Entry {
                value, std_error, ..
            } = entry;
            let method = method(entry.method);
            lines += &format!(
                "{},{},{from},{to},{value},{std_error},{method}\n",
                row.from, entry.to
            );
        }
        if let Some(rest) = row.rest {
            let Uncertain {
                value, std_error, ..
            } = rest.sky;
            lines += &format!("{},,{from},sky,{value},{std_error},estimate\n", row.from);
        }
        lines
    }

    /// The JSON object up to its rows.
    pub fn json_head(&self) -> String {
        let surfaces = self.names.iter().zip(&self.areas).enumerate();
        let surfaces = surfaces.map(|(number, (name, area))| json!({ "number": number, "name": name, "area": number_of(*area, "m2") }));
        let surfaces: Vec<Value> = surfaces.collect();
        let (hash, version, seed) = (json!(self.scene_hash), json!(self.version), self.seed);
        format!(
            "{{\"schema\":\"{SCHEMA}\",\"version\":{version},\"scene_hash\":{hash},\"seed\":{seed},\n\"surfaces\":{},\n\"rows\":[",
            Value::from(surfaces)
        )
    }

    /// A row of the JSON object.
    pub fn json_row(&self, row: &Row, is_first: bool) -> String {
        let factors = row.entries.iter().map(|entry| {
            let mut factor = uncertain(&entry.factor(), entry.method);
            factor["to"] = json!(entry.to);
            factor
        });
        let factors: Vec<Value> = factors.collect();
        let mut object = json!({
            "from": row.from,
            "name": self.names[row.from],
            "sum": estimated(&row.sum),
            "samples": row.samples,
            "converged": row.converged,
            "factors": factors,
        });
        if let Some(rest) = &row.rest {
            object["sky"] = estimated(&rest.sky);
            object["below"] = estimated(&rest.below);
            object["other"] = estimated(&rest.other);
        }
        let separator = if is_first { "\n" } else { ",\n" };
        format!("{separator}{object}")
    }

    /// The end of the JSON object.
    pub fn json_foot(&self, summary: &MatrixSummary) -> String {
        let residual = |residual: &Option<Residual>| {
            residual.as_ref().map(|residual| {
                let mut object = estimated(&residual.difference);
                object["surfaces"] = json!(residual.surfaces);
                object["deviation"] = json!(residual.deviation);
                object
            })
        };
        let object = json!({
            "complete": summary.complete,
            "rows": summary.rows,
            "rows_that_missed_the_tolerance": summary.missed,
            "closed_forms": summary.closed_forms,
            "estimates": summary.estimates,
            "unseen": summary.unseen,
            "samples": summary.samples,
            "closure": residual(&summary.closure),
            "reciprocity": residual(&summary.reciprocity),
        });
        format!("],\n\"summary\":{object}}}\n")
    }

    /// A table of the whole matrix, for a few surfaces.
    pub fn table(&self, rows: &[Row]) -> String {
        let has_sky = rows.iter().any(|row| row.rest.is_some());
        let sky = has_sky.then(|| "sky".to_owned());
        let headings = ["from \\ to".to_owned()].into_iter();
        let headings = headings.chain(self.names.iter().cloned());
        let mut columns = Columns::new(headings.chain(["sum".to_owned()]).chain(sky));
        for row in rows {
            let cells = (0..self.names.len()).map(|to| self.cell(&row.factor_to(to)));
            let rest = row.rest.map(|rest| self.cell(&rest.sky));
            let name = [self.names[row.from].clone()].into_iter();
            columns.row(name.chain(cells).chain([self.cell(&row.sum)]).chain(rest));
        }
        columns.to_string()
    }

    fn cell(&self, found: &Uncertain) -> String {
        match (found.value, found.std_error) {
            (value, 0.0) => exact(value),
            (0.0, error) => format!("< {}", super::numbers::significant(3.0 * error, 1)),
            (value, _) => with_half_width(value, found.half_width(self.confidence)),
        }
    }

    /// The matrix as arrays for NumPy. `scipy.sparse.load_npz` reads it as a matrix of n × n by rows; beside are the standard errors of the
    /// same factors, and of each surface name, area and sum of its row.
    ///
    /// # Errors
    /// If it is too large.
    pub fn npz(&self, rows: &[Row]) -> Result<Vec<u8>, ReportError> {
        let entries = || rows.iter().flat_map(|row| &row.entries);
        let n = self.names.len() as i64;
        let mut ends = vec![0; self.names.len() + 1];
        for row in rows {
            ends[row.from + 1] = row.entries.len() as i64;
        }
        for index in 1..ends.len() {
            ends[index] += ends[index - 1];
        }
        let mut arrays = vec![
            ("format", Array::Ascii("csr".to_owned())),
            ("shape", Array::Integers(vec![n, n])),
            ("indptr", Array::Integers(ends)),
            (
                "indices",
                Array::Integers(entries().map(|entry| i64::from(entry.to)).collect()),
            ),
            (
                "data",
                Array::Floats(entries().map(|entry| entry.value).collect()),
            ),
            (
                "std_error",
                Array::Floats(entries().map(|entry| entry.std_error).collect()),
            ),
            ("names", Array::Texts(self.names.clone())),
            ("areas", Array::Floats(self.areas.clone())),
            (
                "sums",
                Array::Floats(rows.iter().map(|row| row.sum.value).collect()),
            ),
            (
                "sum_std_error",
                Array::Floats(rows.iter().map(|row| row.sum.std_error).collect()),
            ),
        ];
        let sky: Vec<Uncertain> = rows.iter().filter_map(|row| Some(row.rest?.sky)).collect();
        if !sky.is_empty() {
            arrays.push((
                "sky",
                Array::Floats(sky.iter().map(|sky| sky.value).collect()),
            ));
            arrays.push((
                "sky_std_error",
                Array::Floats(sky.iter().map(|sky| sky.std_error).collect()),
            ));
        }
        npz::encode(&arrays)
    }
}

/// How a factor was found, as reports call it.
pub fn method(method: Method) -> &'static str {
    match method {
        Method::ClosedForm => "closed-form",
        Method::Estimate => "estimate",
    }
}

fn number_of(value: f64, unit: &str) -> Value {
    json!({ "value": value, "unit": unit })
}

fn estimated(found: &Uncertain) -> Value {
    let exact = found.std_error == 0.0;
    uncertain(
        found,
        if exact {
            Method::ClosedForm
        } else {
            Method::Estimate
        },
    )
}

fn uncertain(found: &Uncertain, by: Method) -> Value {
    json!({ "value": found.value, "unit": "1", "std_error": found.std_error, "method": method(by) })
}

fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report() -> FactorReport {
        FactorReport {
            names: vec!["floor".into(), "a, \"b\"".into()],
            areas: vec![2.0, 1.0],
            scene_hash: "hash".into(),
            seed: 3,
            version: "1".into(),
            confidence: 0.95,
        }
    }

    fn rows() -> Vec<Row> {
        let error = Uncertain {
            value: 0.5,
            std_error: 0.01,
            degrees: 15.0,
        };
        let row = |from, entries, sum| Row {
            from,
            entries,
            sum,
            rest: None,
            samples: 16,
            converged: true,
        };
        vec![
            row(0, vec![Entry::exact(1, 0.25)], Uncertain::exact(0.25)),
            row(1, vec![Entry::estimated(0, error)], error),
        ]
    }

    #[test]
    fn csv_has_a_line_for_each_factor() {
        let lines = report().csv_row(&rows()[1]);
        assert_eq!(lines, "1,0,\"a, \"\"b\"\"\",floor,0.5,0.01,estimate\n");
    }

    #[test]
    fn the_pieces_are_one_json_object() {
        let (report, rows) = (report(), rows());
        let text = report.json_head()
            + &report.json_row(&rows[0], true)
            + &report.json_row(&rows[1], false)
            + &report.json_foot(&MatrixSummary::default());
        let object: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(object["rows"][1]["factors"][0]["std_error"], 0.01);
        assert_eq!(object["rows"][0]["sum"]["method"], "closed-form");
        assert_eq!(object["surfaces"][1]["name"], "a, \"b\"");
        assert_eq!(object["summary"]["complete"], false);
    }

    #[test]
    fn tables_show_half_widths_and_bounds() {
        let table = report().table(&rows());
        assert!(
            table.contains("0.25") && table.contains("0.500 ± 0.021"),
            "{table}"
        );
        let unseen = Uncertain {
            value: 0.0,
            std_error: 0.001,
            degrees: 15.0,
        };
        assert_eq!(report().cell(&unseen), "< 0.003");
        assert!(report().npz(&rows()).unwrap().starts_with(b"PK"));
    }
}
