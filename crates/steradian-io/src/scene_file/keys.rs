//! The keys of a scene file: one table for reading, the JSON Schema, `help scene` and hints.
//!
//! The rows are in [`tables`](super::tables); this module says what a row is.

use steradian::quantity::UnitTable;

/// One key of a table.
#[derive(Debug, PartialEq)]
pub(super) struct Key {
    pub name: &'static str,
    pub value: Value,
    pub need: Need,
    /// The key beside which alone this one has a meaning.
    pub beside: Option<&'static str>,
    /// The choice with which alone this key has a meaning, and is needed if required.
    pub with: Option<With>,
    /// One line, without a full stop.
    pub doc: &'static str,
}

/// Some of the names that another key chooses from.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(super) struct With {
    pub key: &'static str,
    pub names: &'static [&'static str],
}

/// Whether a key must be there, and what its absence means.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(super) enum Need {
    Required,
    Optional,
    /// TOML text that stands for an absent key.
    Default(&'static str),
    /// Exactly one key of the group of this name must be there.
    OneOf(&'static str),
}

/// What a key holds.
#[derive(Debug, PartialEq)]
pub(super) enum Value {
    Text,
    /// The name of a part of the scene, such as "material".
    Name(&'static str),
    File,
    Flag,
    Count,
    /// A number without a unit.
    Number,
    /// A string with a unit of one of these tables.
    Quantity(&'static [&'static UnitTable]),
    /// The name of a unit of length.
    LengthUnit,
    /// Three lengths.
    Point,
    /// Three numbers.
    Direction,
    /// Three lengths: a step or an edge.
    Displacement,
    /// A point and a direction in one array of six.
    PointAndDirection,
    /// A time and a factor of at least 0.
    TimeAndFactor,
    /// A number for each lane of a spectrum, or for each wavelength.
    Lanes,
    /// First and last wavelength.
    Wavelengths,
    /// First and last wavelength and a step.
    Intervals,
    Choice(&'static [&'static str]),
    Array(&'static Value, usize),
    List(&'static Value),
    OneOrMany(&'static Value),
    Either(&'static [Value]),
    Table(&'static Record),
    /// A table whose tag says which keys it has.
    Kinds(&'static Family),
}

/// A table with fixed keys.
#[derive(Debug, PartialEq)]
pub(super) struct Record {
    /// What it describes, with its article: "an emission".
    pub noun: &'static str,
    pub keys: &'static [Key],
}

/// Tables of several kinds, told apart by the value of one key.
#[derive(Debug, PartialEq)]
pub(super) struct Family {
    /// What each kind is one of: "light".
    pub noun: &'static str,
    /// The key that names the kind.
    pub tag: &'static str,
    pub kinds: &'static [Kind],
    /// Keys of every kind that does not stand alone.
    pub common: &'static [Key],
    /// The kind that is meant if the tag is absent and one of its own keys is there.
    pub untagged: Option<&'static str>,
}

/// One kind of a family.
#[derive(Debug, PartialEq)]
pub(super) struct Kind {
    pub name: &'static str,
    pub doc: &'static str,
    /// `None` for a kind that is known but not yet read.
    pub keys: Option<&'static [Key]>,
    /// It has none of the keys that the others share.
    pub is_alone: bool,
}

/// A table at the top of a scene file.
#[derive(Debug)]
pub(super) struct Section {
    pub name: &'static str,
    pub doc: &'static str,
    pub form: Form,
}

/// How a section is written.
#[derive(Debug)]
pub(super) enum Form {
    /// `[scene]`
    One(&'static Record),
    /// `[materials.NAME]`
    Named(&'static Family),
    /// `[[shapes]]`
    List(&'static Family),
    /// Known, but not yet read.
    NotYet,
}

impl Key {
    const fn new(name: &'static str, value: Value, need: Need, doc: &'static str) -> Self {
        Self {
            name,
            value,
            need,
            beside: None,
            with: None,
            doc,
        }
    }

    pub const fn required(name: &'static str, value: Value, doc: &'static str) -> Self {
        Self::new(name, value, Need::Required, doc)
    }

    pub const fn optional(name: &'static str, value: Value, doc: &'static str) -> Self {
        Self::new(name, value, Need::Optional, doc)
    }

    pub const fn default(
        name: &'static str,
        value: Value,
        default: &'static str,
        doc: &'static str,
    ) -> Self {
        Self::new(name, value, Need::Default(default), doc)
    }

    pub const fn one_of(
        group: &'static str,
        name: &'static str,
        value: Value,
        doc: &'static str,
    ) -> Self {
        Self::new(name, value, Need::OneOf(group), doc)
    }

    /// The same key, allowed only (and if required, needed only) beside `key`.
    pub const fn beside(self, key: &'static str) -> Self {
        Self {
            name: self.name,
            value: self.value,
            need: self.need,
            beside: Some(key),
            with: self.with,
            doc: self.doc,
        }
    }

    /// The same key, allowed only (and if required, needed only) where `key` chooses one of these names.
    pub const fn with(self, key: &'static str, names: &'static [&'static str]) -> Self {
        Self {
            name: self.name,
            value: self.value,
            need: self.need,
            beside: self.beside,
            with: Some(With { key, names }),
            doc: self.doc,
        }
    }
}

impl Kind {
    pub const fn new(name: &'static str, doc: &'static str, keys: &'static [Key]) -> Self {
        Self {
            name,
            doc,
            keys: Some(keys),
            is_alone: false,
        }
    }

    /// The same kind without the keys that the others share.
    pub const fn alone(self) -> Self {
        Self {
            is_alone: true,
            ..self
        }
    }

    pub const fn not_yet(name: &'static str) -> Self {
        Self {
            name,
            doc: "",
            keys: None,
            is_alone: false,
        }
    }
}

impl Family {
    pub fn kind(&self, name: &str) -> Option<&'static Kind> {
        self.kinds.iter().find(|kind| kind.name == name)
    }

    /// All keys of a kind; `None` if it is not yet read.
    pub fn keys(&self, kind: &Kind) -> Option<Vec<&'static Key>> {
        let common = if kind.is_alone { &[] } else { self.common };
        Some(kind.keys?.iter().chain(common).collect())
    }

    /// The kinds that can be read.
    pub fn readable(&self) -> impl Iterator<Item = (&'static Kind, &'static [Key])> {
        self.kinds
            .iter()
            .filter_map(|kind| Some((kind, kind.keys?)))
    }
}

impl Value {
    /// What is expected, for messages: "a point: three lengths, such as [0, 0, 1.5]".
    pub fn describe(&self) -> String {
        match self {
            Self::Text => "a string".into(),
            Self::Name(noun) => format!("the name of a {noun}"),
            Self::File => "the path of a file".into(),
            Self::Flag => "true or false".into(),
            Self::Count => "a whole number, 0 or more".into(),
            Self::Number => "a number without a unit".into(),
            Self::Quantity(tables) => describe_quantity(tables),
            Self::LengthUnit => "a unit of length such as \"mm\"".into(),
            Self::Point => "a point of three lengths such as [0, 0, 1.5] in metres".into(),
            Self::Direction => "three numbers such as [0, 0, 1]".into(),
            Self::Displacement => "a vector of three lengths such as [2, 0, 0] in metres".into(),
            Self::PointAndDirection => "a point and a direction: [x, y, z, dx, dy, dz]".into(),
            Self::TimeAndFactor => "a time and a factor, 0 or more, such as [\"8 h\", 0.5]".into(),
            Self::Lanes => {
                "a number, \"#rrggbb\", [r, g, b], a table of bands, [[nm, value], …] or { file, column }".into()
            }
            Self::Wavelengths => "two wavelengths such as \"380:780 nm\"".into(),
            Self::Intervals => "two wavelengths and a step such as \"400:700:10 nm\"".into(),
            Self::Choice(names) => describe_choice(names),
            Self::Array(value, count) => format!("an array of {count}: {}", value.describe()),
            Self::List(value) => format!("a list, each {}", value.describe()),
            Self::OneOrMany(value) => format!("{}, or a list of these", value.describe()),
            Self::Either(values) => values
                .iter()
                .map(Self::describe)
                .collect::<Vec<_>>()
                .join(", or "),
            Self::Table(record) => {
                let names: Vec<&str> = record.keys.iter().map(|key| key.name).collect();
                format!("a table {{ {} }}", names.join(", "))
            }
            Self::Kinds(family) => format!("a table {{ {} = …, … }}", family.tag),
        }
    }
}

fn describe_quantity(tables: &[&UnitTable]) -> String {
    let names: Vec<&str> = tables.iter().map(|table| table.quantity).collect();
    let units: Vec<&str> = tables
        .iter()
        .flat_map(|table| table.units)
        .map(|unit| unit.symbol)
        .collect();
    let bare = if tables.iter().any(|table| table.allows_bare_numbers) {
        "; bare numbers are metres"
    } else {
        ""
    };
    format!("{} in {}{bare}", names.join(" or "), units.join(", "))
}

fn describe_choice(names: &[&str]) -> String {
    names
        .iter()
        .map(|name| format!("{name:?}"))
        .collect::<Vec<_>>()
        .join(", ")
}
