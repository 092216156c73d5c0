//! Reading single values: numbers, quantities, points, names and lists of them.

use std::str::FromStr;

use steradian::geometry::{Point, Vector};
use steradian::quantity::{Amount, Angle, Length, LuminousEfficacy, ParseQuantityError, Quantity};
use toml::de::{DeInteger, DeValue};

use super::keys::Value;
use super::node::Node;

/// A type that a value of the file can be read as.
pub(super) trait Read: Sized {
    /// What the row of such a key says.
    const VALUE: Value;

    /// Reads it, or reports what was expected.
    fn read(node: Node<'_>) -> Option<Self>;

    /// Whether a key with this row can be read as this type.
    fn fits(row: &Value) -> bool {
        *row == Self::VALUE
    }
}

/// Three numbers of which only the direction counts.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(super) struct Towards(pub Vector);

/// One, or a list.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct OneOrMany<T>(pub Vec<T>);

impl Read for String {
    const VALUE: Value = Value::Text;

    fn read(node: Node<'_>) -> Option<Self> {
        let text = node.toml.as_str().map(str::to_owned);
        if text.is_none() {
            node.expected("a string");
        }
        text
    }

    fn fits(row: &Value) -> bool {
        matches!(
            row,
            Value::Text | Value::Name(_) | Value::File | Value::LengthUnit
        )
    }
}

impl Read for bool {
    const VALUE: Value = Value::Flag;

    fn read(node: Node<'_>) -> Option<Self> {
        let flag = node.toml.as_bool();
        if flag.is_none() {
            node.expected(&Self::VALUE.describe());
        }
        flag
    }
}

impl Read for u32 {
    const VALUE: Value = Value::Count;

    fn read(node: Node<'_>) -> Option<Self> {
        let count = node
            .toml
            .as_integer()
            .and_then(whole_number)
            .and_then(|number| u32::try_from(number).ok());
        if count.is_none() {
            node.expected(&Self::VALUE.describe());
        }
        count
    }
}

impl Read for f64 {
    const VALUE: Value = Value::Number;

    fn read(node: Node<'_>) -> Option<Self> {
        let number = plain_number(node.toml).filter(|number| number.is_finite());
        if number.is_none() {
            node.expected(if is_number(node.toml) {
                "a finite number"
            } else {
                "a number without a unit"
            });
        }
        number
    }
}

fn is_number(toml: &DeValue<'_>) -> bool {
    toml.is_integer() || toml.is_float()
}

fn plain_number(toml: &DeValue<'_>) -> Option<f64> {
    match toml {
        DeValue::Integer(integer) => whole_number(integer).map(|number| number as f64),
        DeValue::Float(float) => float.as_str().parse().ok(),
        _ => None,
    }
}

fn whole_number(integer: &DeInteger<'_>) -> Option<i64> {
    i64::from_str_radix(integer.as_str(), integer.radix()).ok()
}

/// Reads text with a unit; a bare number is refused with the units that are accepted.
pub(super) fn quantity<T: FromStr<Err = ParseQuantityError>>(
    node: Node<'_>,
    value: &Value,
) -> Option<T> {
    let text = match node.toml {
        DeValue::String(text) => text.to_string(),
        DeValue::Integer(number) => number.to_string(),
        DeValue::Float(number) => number.to_string(),
        _ => {
            node.expected(&value.describe());
            return None;
        }
    };
    text.parse()
        .map_err(|error: ParseQuantityError| {
            node.context.error(node.range(), error.to_string(), None)
        })
        .ok()
}

impl<R: Quantity, P: Quantity> Read for Amount<R, P> {
    const VALUE: Value = Value::Quantity(&[R::TABLE, P::TABLE]);

    fn read(node: Node<'_>) -> Option<Self> {
        quantity(node, &Self::VALUE)
    }
}

impl Read for Angle {
    const VALUE: Value = Value::Quantity(&[Self::TABLE]);

    fn read(node: Node<'_>) -> Option<Self> {
        quantity(node, &Self::VALUE)
    }
}

impl Read for LuminousEfficacy {
    const VALUE: Value = Value::Quantity(&[Self::TABLE]);

    fn read(node: Node<'_>) -> Option<Self> {
        quantity(node, &Self::VALUE)
    }
}

impl Read for Length {
    const VALUE: Value = Value::Quantity(&[Self::TABLE]);

    fn read(node: Node<'_>) -> Option<Self> {
        if is_number(node.toml) {
            return f64::read(node).map(Self::from_metres);
        }
        quantity(node, &Self::VALUE)
    }
}

impl Read for Point {
    const VALUE: Value = Value::Point;

    fn read(node: Node<'_>) -> Option<Self> {
        let [x, y, z] = lengths(node, &Self::VALUE)?;
        Some(Self::new(x, y, z))
    }
}

impl Read for Vector {
    const VALUE: Value = Value::Displacement;

    fn read(node: Node<'_>) -> Option<Self> {
        let [x, y, z] = lengths(node, &Self::VALUE)?;
        Some(Self::new(x, y, z))
    }
}

impl Read for Towards {
    const VALUE: Value = Value::Direction;

    fn read(node: Node<'_>) -> Option<Self> {
        let [x, y, z] = array::<f64, 3>(node, &Self::VALUE)?;
        Some(Self(Vector::new(x, y, z)))
    }
}

impl Read for (Point, Towards) {
    const VALUE: Value = Value::PointAndDirection;

    fn read(node: Node<'_>) -> Option<Self> {
        let elements: Vec<Node<'_>> = node.elements().into_iter().flatten().collect();
        if elements.len() != 6 {
            node.expected(&Self::VALUE.describe());
            return None;
        }
        let position: Vec<_> = elements[..3]
            .iter()
            .map(|element| Length::read(*element))
            .collect();
        let direction: Vec<_> = elements[3..]
            .iter()
            .map(|element| f64::read(*element))
            .collect();
        let [x, y, z] = all(position)?.map(Length::to_metres);
        let [dx, dy, dz] = all(direction)?;
        Some((Point::new(x, y, z), Towards(Vector::new(dx, dy, dz))))
    }
}

fn lengths(node: Node<'_>, value: &Value) -> Option<[f64; 3]> {
    array::<Length, 3>(node, value).map(|components| components.map(Length::to_metres))
}

/// Reads an array of `N`, reporting every bad element.
fn array<T: Read, const N: usize>(node: Node<'_>, value: &Value) -> Option<[T; N]> {
    match node.elements() {
        Some(elements) if elements.len() == N => all(elements.map(T::read).collect()),
        _ => {
            node.expected(&value.describe());
            None
        }
    }
}

fn all<T, const N: usize>(values: Vec<Option<T>>) -> Option<[T; N]> {
    values
        .into_iter()
        .collect::<Option<Vec<T>>>()?
        .try_into()
        .ok()
}

impl<T: Read, const N: usize> Read for [T; N] {
    const VALUE: Value = Value::Array(&T::VALUE, N);

    fn read(node: Node<'_>) -> Option<Self> {
        array(node, &Self::VALUE)
    }
}

impl<T: Read> Read for Vec<T> {
    const VALUE: Value = Value::List(&T::VALUE);

    fn read(node: Node<'_>) -> Option<Self> {
        let Some(elements) = node.elements() else {
            node.expected(&Self::VALUE.describe());
            return None;
        };
        elements
            .map(T::read)
            .collect::<Vec<_>>()
            .into_iter()
            .collect()
    }

    fn fits(row: &Value) -> bool {
        matches!(row, Value::List(inner) if T::fits(inner))
    }
}

impl<T: Read> Read for OneOrMany<T> {
    const VALUE: Value = Value::OneOrMany(&T::VALUE);

    /// A list, if the value is nested one level deeper than one `T` is.
    fn read(node: Node<'_>) -> Option<Self> {
        let first = node.toml.as_array().and_then(|array| array.first());
        let one_is_array = matches!(T::VALUE, Value::Displacement);
        let is_list = match first {
            Some(element) => element.get_ref().is_array() || !one_is_array,
            None => node.toml.is_array(),
        };
        if is_list {
            Vec::read(node).map(Self)
        } else {
            T::read(node).map(|one| Self(vec![one]))
        }
    }
}

/// Implements [`Read`] for an enum whose values the file calls by name.
macro_rules! choices {
    ($type:ty, $($name:literal => $value:expr),+ $(,)?) => {
        impl $crate::scene_file::value::Read for $type {
            const VALUE: $crate::scene_file::keys::Value = $crate::scene_file::keys::Value::Choice(&[$($name),+]);

            fn read(node: $crate::scene_file::node::Node<'_>) -> Option<Self> {
                match $crate::scene_file::value::choice(node, &[$($name),+])? {
                    $($name => Some($value),)+
                    _ => None,
                }
            }
        }
    };
}
pub(super) use choices;

/// The one of `names` that the value is, or a report of the nearest.
pub(super) fn choice<'n>(node: Node<'_>, names: &[&'n str]) -> Option<&'n str> {
    let text = node.toml.as_str();
    let found = text.and_then(|text| names.iter().copied().find(|name| *name == text));
    if found.is_none() {
        let listed = names
            .iter()
            .map(|name| format!("{name:?}"))
            .collect::<Vec<_>>()
            .join(", ");
        let nearest = text.and_then(|text| crate::nearest::nearest(text, names.iter().copied()));
        let hint = nearest.map(|name| format!("did you mean {name:?}?"));
        node.expected_with_hint(&format!("one of {listed}"), hint);
    }
    found
}
