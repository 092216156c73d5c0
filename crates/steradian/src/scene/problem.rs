//! What is wrong with a scene, and where.

use std::fmt;

/// The part of a description that a problem is about.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// The scene as a whole.
    Scene,
    /// A material, by number.
    Material(usize),
    /// A shape, by number.
    Shape(usize),
    /// A light, by number.
    Light(usize),
    /// A sensor, by number.
    Sensor(usize),
}

/// A part and the key within it.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// The part.
    pub part: Part,
    /// The key within it, as the scene file spells it.
    pub key: Option<&'static str>,
}

/// The key that is wrong, and what is wrong with it.
pub(super) type Fault = (&'static str, String);

/// Something wrong with a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Where.
    pub place: Place,
    /// What is wrong and what was expected, in one sentence.
    pub message: String,
    /// What would mend it, where that is known.
    pub hint: Option<String>,
}

impl Problem {
    /// A problem of `part` at `key`.
    pub fn at(part: Part, key: &'static str, message: impl Into<String>) -> Self {
        Self {
            place: Place {
                part,
                key: Some(key),
            },
            message: message.into(),
            hint: None,
        }
    }

    /// A problem of a whole part.
    pub fn of(part: Part, message: impl Into<String>) -> Self {
        Self {
            place: Place { part, key: None },
            message: message.into(),
            hint: None,
        }
    }

    /// The same problem with a hint.
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.place.part {
            Part::Scene => write!(f, "scene: ")?,
            Part::Material(i) => write!(f, "material {i}: ")?,
            Part::Shape(i) => write!(f, "shape {i}: ")?,
            Part::Light(i) => write!(f, "light {i}: ")?,
            Part::Sensor(i) => write!(f, "sensor {i}: ")?,
        }
        write!(f, "{}", self.message)
    }
}
