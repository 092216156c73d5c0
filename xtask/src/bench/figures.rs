//! Figures as the programs of `benchmarks/suite` print them, a line of JSON each, and what several rounds of one come to.

use crate::json::{self, Value};

/// One measurement of one round, beside a peer's or alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    pub what: String,
    pub unit: String,
    pub ours: f64,
    pub theirs: Option<f64>,
    pub peer: Option<String>,
    pub less_is_better: bool,
    /// The ratio that is aimed at.
    pub goal: Option<f64>,
    /// Samplers, filters, depths, samples and the like, of both sides.
    pub how: String,
}

/// A line that a program of the suite may print.
#[derive(Clone, Debug, PartialEq)]
pub enum Line {
    Figure(Figure),
    Note(String),
    /// A peer that is not there, and how to install it.
    Missing {
        peer: String,
        install: String,
    },
}

/// Reads a line.
pub fn read(line: &str) -> Result<Line, String> {
    let value = json::parse(line)?;
    let text = |key: &str| value.get(key).and_then(Value::text).map(str::to_owned);
    if let Some(note) = text("note") {
        return Ok(Line::Note(note));
    }
    if let (Some(peer), Some(install)) = (text("missing"), text("install")) {
        return Ok(Line::Missing { peer, install });
    }
    let (Some(what), Some(unit), Some(ours)) = (text("what"), text("unit"), number(&value, "ours"))
    else {
        return Err(format!("neither a figure nor a note: {line}"));
    };
    Ok(Line::Figure(Figure {
        what,
        unit,
        ours,
        theirs: number(&value, "theirs"),
        peer: text("peer"),
        less_is_better: text("better").as_deref() == Some("less"),
        goal: number(&value, "goal"),
        how: text("how").unwrap_or_default(),
    }))
}

fn number(value: &Value, key: &str) -> Option<f64> {
    match value.get(key)? {
        Value::Number(text) => text.parse().ok(),
        _ => None,
    }
}

impl Figure {
    /// How many times as good as the peer's ours is.
    pub fn ratio(&self) -> Option<f64> {
        let theirs = self.theirs?;
        Some(if self.less_is_better {
            theirs / self.ours
        } else {
            self.ours / theirs
        })
    }

    fn is_of_same_row(&self, other: &Self) -> bool {
        (&self.what, &self.unit, &self.peer) == (&other.what, &other.unit, &other.peer)
    }
}

/// A row of the table: the medians over the rounds, and the least and the greatest ratio of a round.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    pub figure: Figure,
    pub rounds: usize,
    /// The median ratio of rounds, not the ratio of medians: both sides of a round met the same load.
    pub ratio: Option<f64>,
    pub range: Option<[f64; 2]>,
}

impl Row {
    /// Whether the goal is met; nothing without a goal or a peer.
    pub fn is_met(&self) -> Option<bool> {
        Some(self.ratio? >= self.figure.goal?)
    }
}

/// Rows in the order in which they first appear.
pub fn rows(figures: &[Figure]) -> Vec<Row> {
    let mut groups: Vec<Vec<&Figure>> = Vec::new();
    for figure in figures {
        match groups
            .iter_mut()
            .find(|group| group[0].is_of_same_row(figure))
        {
            Some(group) => group.push(figure),
            None => groups.push(vec![figure]),
        }
    }
    groups.iter().map(|group| row(group)).collect()
}

fn row(group: &[&Figure]) -> Row {
    let ratios = sorted(group.iter().filter_map(|figure| figure.ratio()));
    let theirs = sorted(group.iter().filter_map(|figure| figure.theirs));
    let figure = Figure {
        ours: median(&sorted(group.iter().map(|figure| figure.ours))).unwrap_or(f64::NAN),
        theirs: median(&theirs),
        ..group[0].clone()
    };
    Row {
        figure,
        rounds: group.len(),
        ratio: median(&ratios),
        range: ratios
            .first()
            .zip(ratios.last())
            .map(|(&least, &most)| [least, most]),
    }
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The middle of sorted values, the mean of the two middle ones if their number is even.
fn median(sorted: &[f64]) -> Option<f64> {
    let (low, high) = (sorted.len().checked_sub(1)? / 2, sorted.len() / 2);
    Some((sorted[low] + sorted[high]) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(ours: f64, theirs: f64, less_is_better: bool) -> Figure {
        Figure {
            what: "Cornell box".to_owned(),
            unit: "1/s".to_owned(),
            ours,
            theirs: Some(theirs),
            peer: Some("Mitsuba".to_owned()),
            less_is_better,
            goal: Some(3.0),
            how: String::new(),
        }
    }

    #[test]
    fn reads_a_figure() {
        let line = r#"{"what": "Cornell box", "unit": "1/s", "ours": 9e2, "theirs": 300, "peer": "Mitsuba", "better": "more", "goal": 3, "how": "", "round": 1}"#;
        assert_eq!(read(line), Ok(Line::Figure(figure(900.0, 300.0, false))));
    }

    #[test]
    fn reads_a_figure_without_a_peer() {
        let line = r#"{"what": "peak", "unit": "MiB", "ours": 12.5, "theirs": null, "peer": null, "better": "less", "goal": null}"#;
        let Ok(Line::Figure(figure)) = read(line) else {
            panic!("{line}");
        };
        assert_eq!(
            (figure.ours, figure.theirs, figure.goal),
            (12.5, None, None)
        );
        assert!(figure.less_is_better);
        assert_eq!(figure.ratio(), None);
    }

    #[test]
    fn reads_notes_and_missing_peers() {
        assert_eq!(read(r#"{"note": "n"}"#), Ok(Line::Note("n".to_owned())));
        let missing = Line::Missing {
            peer: "Embree".to_owned(),
            install: "apt".to_owned(),
        };
        assert_eq!(
            read(r#"{"missing": "Embree", "install": "apt"}"#),
            Ok(missing)
        );
    }

    #[test]
    fn refuses_anything_else() {
        for line in ["", "{}", "warming up", r#"{"what": "a", "unit": "b"}"#] {
            assert!(read(line).is_err(), "{line}");
        }
    }

    #[test]
    fn a_ratio_above_one_is_better_whatever_is_measured() {
        assert_eq!(figure(6.0, 2.0, false).ratio(), Some(3.0));
        assert_eq!(figure(2.0, 6.0, true).ratio(), Some(3.0));
    }

    #[test]
    fn a_row_has_the_median_of_the_ratios_and_their_range() {
        let rounds = [
            figure(10.0, 5.0, false),
            figure(30.0, 5.0, false),
            figure(40.0, 10.0, false),
        ];
        let rows = rows(&rounds);
        assert_eq!(rows.len(), 1);
        assert_eq!(rows[0].ratio, Some(4.0));
        assert_eq!(rows[0].range, Some([2.0, 6.0]));
        assert_eq!(
            (rows[0].figure.ours, rows[0].figure.theirs),
            (30.0, Some(5.0))
        );
        assert_eq!((rows[0].rounds, rows[0].is_met()), (3, Some(true)));
    }

    #[test]
    fn rows_keep_peers_apart_and_their_order() {
        let other = Figure {
            peer: None,
            theirs: None,
            ..figure(1.0, 1.0, false)
        };
        let rows = rows(&[
            figure(1.0, 1.0, false),
            other.clone(),
            figure(2.0, 1.0, false),
        ]);
        assert_eq!(rows.len(), 2);
        assert_eq!((rows[0].rounds, rows[1].rounds), (2, 1));
        assert_eq!((rows[1].ratio, rows[1].is_met()), (None, None));
    }

    #[test]
    fn medians() {
        assert_eq!(median(&[]), None);
        assert_eq!(median(&[7.0]), Some(7.0));
        assert_eq!(median(&[1.0, 2.0]), Some(1.5));
        assert_eq!(median(&[1.0, 2.0, 9.0]), Some(2.0));
    }
}
