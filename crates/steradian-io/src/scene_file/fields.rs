//! A table of the scene file, held against its rows in the table of keys.
//!
//! Opening a table reports unknown keys, missing keys and keys that exclude each other; the readers of sections
//! then only ask for values.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::context::Context;
use super::keys::{Key, Need, Value, With};
use super::node::{Node, in_file_order};
use super::value::Read;
use crate::nearest::nearest;

/// The keys of one table that are in the file.
pub(super) struct Fields<'a> {
    node: Node<'a>,
    table: &'a DeTable<'a>,
    keys: Vec<&'static Key>,
}

impl<'a> Fields<'a> {
    /// The fields of a table that `node` holds, whose keys these are, and `tag`.
    pub fn open(
        node: Node<'a>,
        table: &'a DeTable<'a>,
        keys: Vec<&'static Key>,
        tag: Option<&str>,
        noun: &str,
    ) -> Self {
        let fields = Self { node, table, keys };
        let meant = fields.check_known(tag, noun);
        for key in fields.keys.iter().filter(|key| !meant.contains(&key.name)) {
            fields.check_need(key, noun);
        }
        fields.check_groups(&meant, noun);
        fields
    }

    /// The value of a key, or its default; `None` if it is absent, or wrong, which has been reported.
    pub fn get<T: Read>(&self, name: &str) -> Option<T> {
        let row = self.keys.iter().find(|key| key.name == name)?;
        debug_assert!(T::fits(&row.value), "the row of `{name}`");
        if let Some(value) = self.table.get(name) {
            return T::read(Node::new(value, self.node.context));
        }
        let Need::Default(text) = row.need else {
            return None;
        };
        let default = DeValue::parse(text).ok()?;
        T::read(Node {
            toml: default.get_ref(),
            ..self.node
        })
    }

    /// The value of a key that is there.
    pub fn node(&self, name: &str) -> Option<Node<'a>> {
        let value = self.table.get(name)?;
        Some(Node::new(value, self.node.context))
    }

    pub fn has(&self, name: &str) -> bool {
        self.table.contains_key(name)
    }

    pub fn context(&self) -> &'a Context<'a> {
        self.node.context
    }

    /// Where the table is in the file.
    pub fn span(&self) -> Range<usize> {
        self.node.range()
    }

    /// Where the value of a key is, or else the table.
    pub fn span_of(&self, name: &str) -> Range<usize> {
        self.table
            .get(name)
            .map_or_else(|| self.span(), Spanned::span)
    }

    /// The names of the keys that are there, in the order of the file.
    pub fn names(&self) -> Vec<&'a str> {
        in_file_order(self.table)
            .into_iter()
            .map(|(key, _)| key.get_ref().as_ref())
            .collect()
    }

    /// Reports unknown keys, and gives the valid ones that they seem to mean.
    fn check_known(&self, tag: Option<&str>, noun: &str) -> Vec<&'static str> {
        let mut meant = Vec::new();
        for (key, _) in in_file_order(self.table) {
            let name = key.get_ref().as_ref();
            match self.keys.iter().find(|known| known.name == name) {
                None if Some(name) != tag => {
                    let (nearest, hint) = self.suggestion(name);
                    meant.extend(nearest);
                    self.context().error(
                        key.span(),
                        format!("unknown key `{name}` of {noun}"),
                        Some(hint),
                    );
                }
                _ => (),
            }
        }
        meant
    }

    fn suggestion(&self, name: &str) -> (Option<&'static str>, String) {
        let valid = || self.keys.iter().map(|key| key.name);
        match nearest(name, valid()) {
            Some(meant) => (Some(meant), format!("did you mean `{meant}`?")),
            None => (
                None,
                format!("its keys are {}", valid().collect::<Vec<_>>().join(", ")),
            ),
        }
    }

    fn check_need(&self, key: &Key, noun: &str) {
        if let Some(with) = &key.with
            && !with.names.contains(&self.choice(with.key))
        {
            return self.check_absent(key, with, noun);
        }
        let allowed = key.beside.is_none_or(|other| self.has(other));
        let present = self.has(key.name);
        if let (true, false, Some(other)) = (present, allowed, key.beside) {
            let message = format!(
                "key `{}` of {noun} has a meaning only beside `{other}`",
                key.name
            );
            self.context().error(self.span_of(key.name), message, None);
        }
        if !present && allowed && key.need == Need::Required {
            let message = format!(
                "missing key `{}` of {noun}: {}",
                key.name,
                key.value.describe()
            );
            self.context().error(self.span(), message, None);
        }
    }

    /// The name that a key chooses, or that stands for it where it is absent.
    fn choice(&self, name: &str) -> &str {
        let row = self.keys.iter().find(|key| key.name == name);
        let default = match row.map(|key| key.need) {
            Some(Need::Default(text)) => text.trim_matches('"'),
            _ => "",
        };
        let given = self.table.get(name).map(|value| value.get_ref().as_str());
        given.map_or(default, Option::unwrap_or_default)
    }

    /// Reports a key that has no meaning with what another chooses, if that is a name at all.
    fn check_absent(&self, key: &Key, with: &With, noun: &str) {
        let choice = self.choice(with.key);
        if !self.has(key.name) || !self.is_name(with.key, choice) {
            return;
        }
        let message = format!(
            "key `{}` of {noun} has no meaning with {} = {choice:?}",
            key.name, with.key
        );
        let names: Vec<String> = with.names.iter().map(|name| format!("{name:?}")).collect();
        let hint = format!("it belongs to {} = {}", with.key, names.join(", "));
        self.context()
            .error(self.span_of(key.name), message, Some(hint));
    }

    /// Whether a key may choose this name.
    fn is_name(&self, key: &str, name: &str) -> bool {
        let row = self.keys.iter().find(|row| row.name == key);
        row.is_some_and(|row| matches!(row.value, Value::Choice(names) if names.contains(&name)))
    }

    /// Reports groups of which not exactly one key is there.
    fn check_groups(&self, meant: &[&str], noun: &str) {
        let mut groups: Vec<&str> = self.keys.iter().filter_map(|key| group_of(key)).collect();
        groups.sort_unstable();
        groups.dedup();
        for group in groups {
            let group = self.keys.iter().filter(|key| group_of(key) == Some(group));
            let names: Vec<&str> = group.map(|key| key.name).collect();
            if !names.iter().any(|name| meant.contains(name)) {
                self.check_group(&names, noun);
            }
        }
    }

    fn check_group(&self, names: &[&str], noun: &str) {
        let listed: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        let listed = listed.join(", ");
        let mut present = self.names();
        present.retain(|name| names.contains(name));
        match present[..] {
            [_] => (),
            [] => {
                let message = format!("missing key of {noun}: one of {listed}");
                self.context().error(self.span(), message, None);
            }
            [first, second, ..] => {
                let message = format!("keys `{first}` and `{second}` of {noun} exclude each other");
                let hint = format!("keep one of {listed}");
                self.context()
                    .error(self.span_of(second), message, Some(hint));
            }
        }
    }
}

fn group_of(key: &Key) -> Option<&'static str> {
    match key.need {
        Need::OneOf(group) => Some(group),
        _ => None,
    }
}
