//! The models of materials with their keys, for lists.

use super::keys::{Key, Need};
use super::tables::MATERIALS;

/// A model of a material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelHelp {
    /// As `model = "…"` names it.
    pub name: &'static str,
    /// What it is, in one line.
    pub doc: &'static str,
    /// In the order of the table.
    pub keys: Vec<KeyHelp>,
}

/// A key of a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeyHelp {
    /// As the scene file spells it.
    pub name: &'static str,
    /// What it is, with its range, in one line.
    pub doc: &'static str,
    /// What is expected.
    pub expects: String,
    /// TOML text that stands for it where it is absent.
    pub default: Option<&'static str>,
    /// Whether it must be there; of a group, exactly one key.
    pub required: bool,
    /// The keys of which exactly one must be there.
    pub one_of: Vec<&'static str>,
    /// The key beside which alone it has a meaning.
    pub beside: Option<&'static str>,
}

/// Every model that can be read.
///
/// ```
/// let models = steradian_io::scene_file::models();
/// let pane = models.iter().find(|model| model.name == "pane").unwrap();
/// assert_eq!(pane.keys[0].name, "ior");
/// ```
pub fn models() -> Vec<ModelHelp> {
    let kinds = MATERIALS.readable();
    let model = |(kind, keys): (&'static super::keys::Kind, &'static [Key])| ModelHelp {
        name: kind.name,
        doc: kind.doc,
        keys: keys.iter().map(|key| key_help(key, keys)).collect(),
    };
    kinds.map(model).collect()
}

fn key_help(key: &'static Key, keys: &'static [Key]) -> KeyHelp {
    let one_of = match key.need {
        Need::OneOf(group) => {
            let same = keys.iter().filter(|other| other.need == Need::OneOf(group));
            same.map(|key| key.name).collect()
        }
        _ => vec![],
    };
    KeyHelp {
        name: key.name,
        doc: key.doc,
        expects: key.value.describe(),
        default: match key.need {
            Need::Default(text) => Some(text),
            _ => None,
        },
        required: key.need == Need::Required,
        one_of,
        beside: key.beside,
    }
}
