//! Where things are: points and directions turned to z up, transforms and repeats.

use steradian::geometry::{Direction, Point, Transform, Vector};
use steradian::quantity::Angle;
use steradian::scene::description::Repeat;

use super::fields::Fields;
use super::keys::Value;
use super::node::Node;
use super::tables::{REPEAT, SCALE, TRANSFORM_STEP};
use super::value::{OneOrMany, Read, Towards};

/// A point, with z up.
pub(super) fn point(fields: &Fields<'_>, key: &str) -> Option<Point> {
    fields
        .get(key)
        .map(|point| fields.context().up.get().point(point))
}

/// A direction, with z up.
pub(super) fn direction(fields: &Fields<'_>, key: &str) -> Option<Vector> {
    fields
        .get(key)
        .map(|towards| fields.context().up.get().direction(towards))
}

/// The edges of a plane figure, with z up.
pub(super) fn edges(fields: &Fields<'_>, key: &str) -> Option<[Vector; 2]> {
    fields
        .get(key)
        .map(|edges: [Vector; 2]| edges.map(|edge| fields.context().up.get().vector(edge)))
}

/// `first`, the steps of a shape's transform, and the turn to z up.
pub(super) fn transform(fields: &Fields<'_>, first: Transform) -> Option<Transform> {
    let steps: Vec<Step> = fields.get("transform")?;
    let placed = steps
        .into_iter()
        .fold(first, |transform, step| transform.then(step.0));
    Some(placed.then(fields.context().up.get().turn()))
}

/// The copies of a shape or light, their steps with z up.
pub(super) fn repeat(fields: &Fields<'_>) -> Option<Repeat> {
    let mut repeat: Repeat = fields.get("repeat")?;
    for step in &mut repeat.step {
        *step = fields.context().up.get().vector(*step);
    }
    Some(repeat)
}

impl Read for Repeat {
    const VALUE: Value = Value::Table(&REPEAT);

    fn read(node: Node<'_>) -> Option<Self> {
        let fields = node.record(&REPEAT)?;
        let (count, step) = (fields.get("count"), fields.get("step"));
        let (OneOrMany(count), OneOrMany(step)) = (count?, step?);
        if count.len() != step.len() {
            let message = format!(
                "a repeat needs a step for each count: {} counts, {} steps",
                count.len(),
                step.len()
            );
            node.context.error(fields.span_of("step"), message, None);
            return None;
        }
        Some(Self { count, step })
    }
}

/// One step of a transform.
struct Step(Transform);

impl Read for Step {
    const VALUE: Value = Value::Table(&TRANSFORM_STEP);

    fn read(node: Node<'_>) -> Option<Self> {
        let fields = node.record(&TRANSFORM_STEP)?;
        let translation = fields.get("translate").map(Transform::translate);
        let scaling = fields
            .get("scale")
            .map(|Scale(factors)| Transform::scale_axes(factors));
        translation
            .or(scaling)
            .or_else(|| rotation(&fields))
            .map(Self)
    }
}

fn rotation(fields: &Fields<'_>) -> Option<Transform> {
    let (angle, axis, about) = (
        fields.get::<Angle>("rotate"),
        fields.get("axis"),
        fields.get::<Point>("about"),
    );
    let (angle, Towards(axis), about) = (angle?, axis?, about?);
    let axis = Direction::new(axis);
    if let Err(error) = &axis {
        fields
            .context()
            .error(fields.span_of("axis"), error.to_string(), None);
    }
    Some(Transform::rotate(axis.ok()?, angle, about))
}

/// A factor for each axis.
struct Scale([f64; 3]);

impl Read for Scale {
    const VALUE: Value = SCALE;

    fn read(node: Node<'_>) -> Option<Self> {
        if node.toml.is_array() {
            return Towards::read(node).map(|Towards(factors)| Self(factors.to_array()));
        }
        f64::read(node).map(|factor| Self([factor; 3]))
    }
}
