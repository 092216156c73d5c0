//! Schedules of lights: `[["8 h", 1], ["17 h", 0.3]]`, or a table where values hold or repeat.

use steradian::quantity::{Quantity, Time};
use steradian::time::{Rule, Schedule, TimeError};

use super::keys::Value;
use super::node::Node;
use super::tables::{SCHEDULE, SCHEDULE_TABLE};
use super::value::{Read, quantity};

impl Read for Time {
    const VALUE: Value = Value::Quantity(&[Self::TABLE]);

    fn read(node: Node<'_>) -> Option<Self> {
        quantity(node, &Self::VALUE)
    }
}

impl Read for (Time, f64) {
    const VALUE: Value = Value::TimeAndFactor;

    fn read(node: Node<'_>) -> Option<Self> {
        let elements: Vec<Node<'_>> = node.elements().into_iter().flatten().collect();
        let [time, factor] = elements[..] else {
            node.expected(&Self::VALUE.describe());
            return None;
        };
        let (time, factor) = (Time::read(time), f64::read(factor));
        Some((time?, factor?))
    }
}

impl Read for Schedule {
    const VALUE: Value = SCHEDULE;

    fn read(node: Node<'_>) -> Option<Self> {
        if node.toml.is_array() {
            return build(node, Vec::read(node)?, Rule::Linear, None);
        }
        if !node.toml.is_table() {
            node.expected(&Self::VALUE.describe());
            return None;
        }
        let fields = node.record(&SCHEDULE_TABLE)?;
        let period = fields.get("period");
        if period.is_none() && fields.has("period") {
            return None;
        }
        let (key, rule) = if fields.has("held") {
            ("held", Rule::Held)
        } else {
            ("linear", Rule::Linear)
        };
        build(fields.node(key)?, fields.get(key)?, rule, period)
    }
}

/// The schedule through points, whose list is at `node`.
fn build(
    node: Node<'_>,
    points: Vec<(Time, f64)>,
    rule: Rule,
    period: Option<Time>,
) -> Option<Schedule> {
    Schedule::new(points, rule, period)
        .map_err(|error| report(node, &error))
        .ok()
}

/// Reports what is wrong with points at the one that is wrong.
fn report(node: Node<'_>, error: &TimeError) {
    let index = match error {
        TimeError::NotFinite { index, .. }
        | TimeError::NotIncreasing { index, .. }
        | TimeError::Negative { index, .. } => Some(*index),
        _ => None,
    };
    let element = index.and_then(|index| node.elements()?.nth(index));
    let place = element.map_or(node.range(), |element| element.range());
    node.context.error(place, error.to_string(), None);
}
