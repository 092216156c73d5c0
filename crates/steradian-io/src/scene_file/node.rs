//! A value of the scene file, with its place: the start of all reading.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::context::Context;
use super::fields::Fields;
use super::keys::{Family, Record, Value};
use crate::nearest::nearest;

/// A value of the file.
#[derive(Copy, Clone)]
pub(super) struct Node<'a> {
    pub toml: &'a DeValue<'a>,
    /// Where it is in the file; where its table is, for a default.
    pub span: (usize, usize),
    pub context: &'a Context<'a>,
}

impl<'a> Node<'a> {
    pub fn new(toml: &'a Spanned<DeValue<'a>>, context: &'a Context<'a>) -> Self {
        let span = toml.span();
        Self {
            toml: toml.get_ref(),
            span: (span.start, span.end),
            context,
        }
    }

    pub fn range(&self) -> Range<usize> {
        self.span.0..self.span.1
    }

    /// Reports that this is not what was expected.
    pub fn expected(&self, what: &str) {
        self.expected_with_hint(what, None);
    }

    /// The same with a hint.
    pub fn expected_with_hint(&self, what: &str, hint: Option<String>) {
        self.context.error(
            self.range(),
            format!("expected {what}, found {}", self.found()),
            hint,
        );
    }

    /// The elements, if it is an array.
    pub fn elements(self) -> Option<impl ExactSizeIterator<Item = Node<'a>>> {
        let array = self.toml.as_array()?;
        Some(
            array
                .iter()
                .map(move |element| Node::new(element, self.context)),
        )
    }

    fn found(&self) -> String {
        match self.toml {
            DeValue::String(text) => format!("{text:?}"),
            DeValue::Integer(number) => format!("the number {number}"),
            DeValue::Float(number) => format!("the number {number}"),
            DeValue::Boolean(flag) => flag.to_string(),
            DeValue::Datetime(date) => format!("the date {date}"),
            DeValue::Array(array) => format!("an array of {}", array.len()),
            DeValue::Table(_) => "a table".into(),
        }
    }

    /// The fields of a table with fixed keys.
    pub fn record(self, record: &'static Record) -> Option<Fields<'a>> {
        let table = self.table_or_report(|| Value::Table(record).describe())?;
        Some(Fields::open(
            self,
            table,
            record.keys.iter().collect(),
            None,
            record.noun,
        ))
    }

    /// The kind and the fields of a table of a family.
    pub fn kind(self, family: &'static Family) -> Option<(&'static str, Fields<'a>)> {
        let table = self.table_or_report(|| format!("a table of a {}", family.noun))?;
        let name = self.kind_name(family, table)?;
        let Some(kind) = family.kind(name) else {
            self.report_unknown_kind(family, table, name);
            return None;
        };
        let Some(keys) = family.keys(kind) else {
            let message = format!("{} {name:?} is not supported yet", family.noun);
            self.context.error(tag_span(family, table), message, None);
            return None;
        };
        let noun = format!("the {} {}", kind.name, family.noun);
        Some((
            kind.name,
            Fields::open(self, table, keys, Some(family.tag), &noun),
        ))
    }

    fn table_or_report(&self, expected: impl Fn() -> String) -> Option<&'a DeTable<'a>> {
        let table = self.toml.as_table();
        if table.is_none() {
            self.expected(&expected());
        }
        table
    }

    fn kind_name(&self, family: &'static Family, table: &'a DeTable<'a>) -> Option<&'a str> {
        if let Some(tag) = table.get(family.tag) {
            let name = tag.get_ref().as_str();
            if name.is_none() {
                Node::new(tag, self.context)
                    .expected(&format!("the {} of a {}", family.tag, family.noun));
            }
            return name;
        }
        let untagged = family.untagged.filter(|name| {
            let keys = family
                .kind(name)
                .and_then(|kind| kind.keys)
                .unwrap_or_default();
            keys.iter().any(|key| table.contains_key(key.name))
        });
        if untagged.is_none() {
            let message = format!(
                "missing key `{}` of a {}, one of {}",
                family.tag,
                family.noun,
                readable(family)
            );
            self.context.error(self.range(), message, None);
        }
        untagged
    }

    fn report_unknown_kind(&self, family: &Family, table: &DeTable<'_>, name: &str) {
        let message = format!("unknown {} {name:?}", family.noun);
        let hint = match nearest(name, family.kinds.iter().map(|kind| kind.name)) {
            Some(meant) => format!("did you mean {meant:?}?"),
            None => format!("it may be {}", readable(family)),
        };
        self.context
            .error(tag_span(family, table), message, Some(hint));
    }
}

fn tag_span(family: &Family, table: &DeTable<'_>) -> Range<usize> {
    table.get(family.tag).map_or(0..0, Spanned::span)
}

fn readable(family: &Family) -> String {
    family
        .readable()
        .map(|(kind, _)| kind.name)
        .collect::<Vec<_>>()
        .join(", ")
}

/// A key and its value, each with its place.
pub(super) type Entry<'a> = (&'a Spanned<DeString<'a>>, &'a Spanned<DeValue<'a>>);

/// The entries of a table in the order of the file.
pub(super) fn in_file_order<'a>(table: &'a DeTable<'a>) -> Vec<Entry<'a>> {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    entries
}
