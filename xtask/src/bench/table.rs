//! The one table of the suite: ratios first.

use super::figures::Row;

const HEADINGS: [&str; 8] = [
    "ratio", "range", "goal", "ours", "theirs", "unit", "what", "beside",
];
/// How many of the columns hold numbers, which are set to the right.
const NUMBERS: usize = 5;

/// The table as text, then how each row was measured: one line for all rows that were measured alike.
pub fn render(rows: &[Row]) -> String {
    let mut hows: Vec<&str> = Vec::new();
    let mut lines = vec![HEADINGS.map(str::to_owned)];
    for row in rows {
        let how = row.figure.how.as_str();
        let number = hows
            .iter()
            .position(|&other| other == how)
            .unwrap_or_else(|| {
                hows.push(how);
                hows.len() - 1
            });
        lines.push(cells(row, number + 1));
    }
    let notes = (1..)
        .zip(&hows)
        .map(|(number, how)| format!("[{number}] {how}\n"));
    format!("{}\n{}", aligned(&lines), notes.collect::<String>())
}

fn cells(row: &Row, how: usize) -> [String; 8] {
    let figure = &row.figure;
    let goal = figure.goal.map_or_else(String::new, |goal| {
        let verdict = if row.is_met() == Some(true) {
            "met"
        } else {
            "NOT"
        };
        format!("{} {verdict}", digits(goal))
    });
    [
        row.ratio.map_or_else(|| "-".to_owned(), digits),
        row.range.map_or_else(String::new, |[least, most]| {
            format!("{} to {}", digits(least), digits(most))
        }),
        goal,
        digits(figure.ours),
        figure.theirs.map_or_else(|| "-".to_owned(), digits),
        figure.unit.clone(),
        format!("{} [{how}]", figure.what),
        figure.peer.clone().unwrap_or_default(),
    ]
}

/// Three digits, without an exponent between a thousandth and a million.
fn digits(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        format!("{value:.2e}")
    } else if size >= 100.0 {
        format!("{value:.0}")
    } else if size >= 10.0 {
        format!("{value:.1}")
    } else if size >= 1.0 || size == 0.0 {
        format!("{value:.2}")
    } else {
        format!("{value:.3}")
    }
}

fn aligned(lines: &[[String; 8]]) -> String {
    let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max();
    let widths: Vec<usize> = (0..HEADINGS.len())
        .map(|column| width(column).unwrap_or(0))
        .collect();
    let cell = |(column, text): (usize, &String)| {
        let width = widths[column];
        if column < NUMBERS {
            format!("{text:>width$}")
        } else {
            format!("{text:width$}")
        }
    };
    let line = |line: &[String; 8]| {
        let cells: Vec<String> = line.iter().enumerate().map(cell).collect();
        format!("{}\n", cells.join("  ").trim_end())
    };
    lines.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::super::figures::{Figure, rows};
    use super::*;

    fn figure(what: &str, how: &str) -> Figure {
        Figure {
            what: what.to_owned(),
            unit: "1/s".to_owned(),
            ours: 900.0,
            theirs: Some(600.0),
            peer: Some("Mitsuba".to_owned()),
            less_is_better: false,
            goal: Some(3.0),
            how: how.to_owned(),
        }
    }

    #[test]
    fn ratios_come_first_and_a_missed_goal_is_told() {
        let table = render(&rows(&[figure("Cornell box", "64 spp")]));
        assert_eq!(
            table,
            "ratio         range      goal  ours  theirs  unit  what             beside\n \
             1.50  1.50 to 1.50  3.00 NOT   900     600  1/s   Cornell box [1]  Mitsuba\n\
             \n[1] 64 spp\n"
        );
    }

    #[test]
    fn rows_measured_alike_share_a_note() {
        let figures = [figure("a", "x"), figure("b", "y"), figure("c", "x")];
        let table = render(&rows(&figures));
        assert!(table.contains("c [1]"), "{table}");
        assert!(table.ends_with("[1] x\n[2] y\n"), "{table}");
    }

    #[test]
    fn three_digits() {
        let shown = [0.0, 0.0123, 1.0, 12.34, 123.4, 1e5, 2e6, 1e-4].map(digits);
        assert_eq!(
            shown,
            [
                "0.00", "0.012", "1.00", "12.3", "123", "100000", "2.00e6", "1.00e-4"
            ]
        );
    }
}
