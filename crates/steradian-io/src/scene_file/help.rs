//! `help scene`: every section, kind and key, in words.

use std::fmt::Write;

use super::keys::{Family, Form, Key, Need, Record, Value};
use super::tables::SECTIONS;

/// The keys of a scene file, grouped by section and kind, with units and defaults. Ends with a newline.
pub fn key_help() -> String {
    let mut help = Help::default();
    for section in SECTIONS {
        match &section.form {
            Form::One(record) => {
                help.section(&format!("[{}]", section.name), section.doc, record.keys)
            }
            Form::Named(family) => {
                help.family(&format!("[{}.NAME]", section.name), section.doc, family)
            }
            Form::List(family) => {
                help.family(&format!("[[{}]]", section.name), section.doc, family)
            }
            Form::NotYet => (),
        }
    }
    help.inner_tables();
    help.text.truncate(help.text.trim_end().len());
    help.text.push('\n');
    help.text
}

#[derive(Default)]
struct Help {
    text: String,
    /// Tables that keys hold, explained at the end.
    records: Vec<&'static Record>,
}

impl Help {
    fn section(&mut self, header: &str, doc: &str, keys: &'static [Key]) {
        self.line(0, &format!("{header}  {doc}."));
        self.keys(keys);
        self.text.push('\n');
    }

    fn family(&mut self, header: &str, doc: &str, family: &'static Family) {
        self.line(0, &format!("{header}  {doc}."));
        self.keys(family.common);
        let kinds: Vec<_> = family.readable().collect();
        for alike in kinds.chunk_by(|(_, keys), (_, next)| keys == next) {
            self.text.push('\n');
            for (kind, _) in alike {
                self.line(
                    2,
                    &format!("{} = {:?}  {}.", family.tag, kind.name, kind.doc),
                );
            }
            self.keys(alike[0].1);
        }
        self.text.push('\n');
    }

    fn keys(&mut self, keys: &'static [Key]) {
        for key in keys {
            self.line(
                4,
                &format!("{:<18} {}. {}", key.name, key.doc, need(key, keys)),
            );
            self.line(23, &format!("{}.", capitalised(&key.value.describe())));
            self.remember(&key.value);
        }
    }

    fn remember(&mut self, value: &'static Value) {
        match value {
            Value::Table(record) if !self.records.contains(record) => self.records.push(record),
            Value::Array(inner, _) | Value::List(inner) | Value::OneOrMany(inner) => {
                self.remember(inner)
            }
            Value::Either(values) => values.iter().for_each(|value| self.remember(value)),
            _ => (),
        }
    }

    fn inner_tables(&mut self) {
        let mut next = 0;
        while let Some(record) = self.records.get(next).copied() {
            self.section(
                "{ … }",
                &format!("The keys of {}", record.noun),
                record.keys,
            );
            next += 1;
        }
    }

    fn line(&mut self, indent: usize, text: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{:indent$}{}", "", text.trim_end());
    }
}

fn need(key: &Key, keys: &[Key]) -> String {
    let beside = match (&key.with, key.beside) {
        (Some(with), _) => format!(" with {} = {}", with.key, with.names.join(", ")),
        (None, Some(other)) => format!(" beside `{other}`"),
        (None, None) => String::new(),
    };
    match key.need {
        Need::Required => format!("Required{beside}."),
        Need::Default(value) => format!("Default{beside}: {value}."),
        Need::OneOf(group) => {
            let same = keys.iter().filter(|other| other.need == Need::OneOf(group));
            format!(
                "One of {}.",
                same.map(|key| key.name).collect::<Vec<_>>().join(", ")
            )
        }
        Need::Optional => String::new(),
    }
}

fn capitalised(text: &str) -> String {
    let mut characters = text.chars();
    characters
        .next()
        .map(|first| first.to_uppercase().chain(characters).collect())
        .unwrap_or_default()
}
