//! Text in aligned columns.
//!
//! ```
//! use steradian_io::report::columns::Columns;
//!
//! let mut columns = Columns::new(["name", "value"]).right_aligned(1);
//! columns.row(["lamp", "12.5"]);
//! assert_eq!(columns.to_string(), "name  value\nlamp   12.5\n");
//! ```

use std::fmt;

/// Rows of cells under a heading.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    rows: Vec<Vec<String>>,
    right: Vec<usize>,
}

impl Columns {
    /// No rows yet under these headings.
    pub fn new<S: Into<String>>(headings: impl IntoIterator<Item = S>) -> Self {
        Self {
            rows: vec![headings.into_iter().map(Into::into).collect()],
            right: Vec::new(),
        }
    }

    /// The same with one column flush right.
    pub fn right_aligned(mut self, column: usize) -> Self {
        self.right.push(column);
        self
    }

    /// Adds a row.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    fn widths(&self) -> Vec<usize> {
        let count = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let width = |column: usize| {
            self.rows
                .iter()
                .filter_map(|row| row.get(column))
                .map(|cell| cell.chars().count())
                .max()
        };
        (0..count)
            .map(|column| width(column).unwrap_or(0))
            .collect()
    }
}

impl fmt::Display for Columns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let widths = self.widths();
        for row in &self.rows {
            let padded = row.iter().enumerate().map(|(column, cell)| {
                let width = widths[column];
                if self.right.contains(&column) {
                    format!("{cell:>width$}")
                } else {
                    format!("{cell:<width$}")
                }
            });
            let line = padded.collect::<Vec<_>>().join("  ");
            writeln!(f, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_as_wide_as_their_widest_cell() {
        let mut columns = Columns::new(["a", "b"]);
        columns.row(["x ± 1", "y"]);
        columns.row(["longest cell", ""]);
        assert_eq!(
            columns.to_string(),
            "a             b\nx ± 1         y\nlongest cell\n"
        );
    }
}
