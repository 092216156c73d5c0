//! The energy balance of a run for people and for programs.

use serde_json::{Map, Value, json};
use steradian::estimation::Estimate;
use steradian::measurement::{Balance, Reading};
use steradian::sensor::Term;

use super::columns::Columns;
use super::json;
use super::numbers::significant;
use super::table::with_unit;

/// One line an account that any light was seen in, then the sums, and whether they agree.
pub(super) fn table(balance: &Balance, confidence: f64) -> String {
    let percent = significant(100.0 * confidence, 4);
    let headings = [
        "account".to_owned(),
        format!("{} ({percent} %)", balance.quantity),
        "of emitted".to_owned(),
    ];
    let mut columns = Columns::new(headings).right_aligned(2);
    for reading in accounts(balance).filter(|reading| !reading.is_dark()) {
        columns.row(row(&reading.sensor, &reading.estimate, balance));
    }
    columns.row(["", "", ""]);
    for (term, total) in &balance.totals {
        columns.row(row(&format!("all {}", term.name()), total, balance));
    }
    columns.row(row("missing", &balance.missing, balance));
    let dark = dark(balance).map(|sentence| sentence + "\n");
    format!(
        "{columns}\n{}{}\n",
        dark.unwrap_or_default(),
        verdict(balance)
    )
}

/// The sums, what is missing, and whether that is chance; the accounts are among the readings.
pub(super) fn object(balance: &Balance) -> Value {
    let total = |(term, total): &(Term, Estimate)| (term.name().to_owned(), total_of(total));
    let mut object: Map<_, _> = balance.totals.iter().map(total).collect();
    object.insert("quantity".to_owned(), json!(balance.quantity));
    object.insert("unit".to_owned(), json!(balance.unit));
    object.insert("missing".to_owned(), total_of(&balance.missing));
    object.insert("chance".to_owned(), json!(balance.chance));
    object.insert("holds".to_owned(), json!(balance.holds()));
    Value::Object(object)
}

fn total_of(total: &Estimate) -> Value {
    Value::Object(json::estimate(total))
}

fn accounts(balance: &Balance) -> impl Iterator<Item = &Reading> {
    balance.accounts.iter().flat_map(|(_, readings)| readings)
}

fn row(name: &str, estimate: &Estimate, balance: &Balance) -> [String; 3] {
    let emitted = balance.totals[0].1.value;
    let share = format!("{:.2} %", 100.0 * estimate.value / emitted);
    [name.to_owned(), with_unit(estimate, &balance.unit), share]
}

fn dark(balance: &Balance) -> Option<String> {
    let dark: Vec<_> = accounts(balance)
        .filter(|reading| reading.is_dark())
        .collect();
    let samples: u64 = dark.iter().map(|reading| reading.samples).sum();
    (!dark.is_empty()).then(|| {
        format!(
            "{} accounts are dark: none of {samples} paths found light. They count as 0.",
            dark.len()
        )
    })
}

fn verdict(balance: &Balance) -> String {
    let chance = significant(balance.chance, 2);
    if balance.missing.std_error.is_infinite() {
        return "Whether it balances cannot be told: the error is not known.".into();
    }
    if balance.holds() {
        return format!(
            "Balanced: emitted = absorbed + escaped within the sampling error (chance of as much or more missing: {chance})."
        );
    }
    format!(
        "NOT balanced: sampling errors alone do not explain what is missing (chance of as much or more: {chance})."
    )
}
