//! The JSON Schema (draft 2020-12) of a scene file, for editors.

use serde_json::{Map, Value as Json, json};

use super::keys::{Family, Form, Key, Need, Record, Value};
use super::tables::{SECTIONS, TABLE};

/// The schema of a scene file.
pub fn schema() -> Json {
    let mut definitions = Definitions::default();
    let mut sections = Map::new();
    for section in SECTIONS {
        let mut schema = match &section.form {
            Form::One(record) => definitions.record(record),
            Form::Named(family) => {
                json!({ "type": "object", "additionalProperties": definitions.family(family) })
            }
            Form::List(family) => json!({ "type": "array", "items": definitions.family(family) }),
            Form::NotYet => continue,
        };
        schema["description"] = section.doc.into();
        sections.insert(section.name.to_owned(), schema);
    }
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Steradian scene file",
        "type": "object",
        "properties": sections,
        "additionalProperties": false,
        "$defs": definitions.0,
    })
}

/// Schemas that several keys refer to, by name.
#[derive(Default)]
struct Definitions(Map<String, Json>);

impl Definitions {
    fn reference(&mut self, name: &str, schema: impl FnOnce(&mut Self) -> Json) -> Json {
        if !self.0.contains_key(name) {
            let schema = schema(self);
            self.0.insert(name.to_owned(), schema);
        }
        json!({ "$ref": format!("#/$defs/{name}") })
    }

    fn record(&mut self, record: &Record) -> Json {
        let keys: Vec<&Key> = record.keys.iter().collect();
        self.keys(&keys, Map::new(), Vec::new())
    }

    /// One schema for each set of keys; kinds that have the same share it.
    fn family(&mut self, family: &Family) -> Json {
        let kinds: Vec<_> = family.readable().collect();
        let alternatives = kinds
            .chunk_by(|(_, keys), (_, next)| keys == next)
            .map(|alike| {
                let (kind, _) = alike[0];
                let names: Vec<&str> = alike.iter().map(|(kind, _)| kind.name).collect();
                let tag = json!({ "enum": names, "description": kind.doc });
                let properties = Map::from_iter([(family.tag.to_owned(), tag)]);
                let required = if family.untagged == Some(kind.name) {
                    Vec::new()
                } else {
                    vec![family.tag]
                };
                let keys = family.keys(kind).unwrap_or_default();
                self.keys(&keys, properties, required)
            });
        json!({ "oneOf": alternatives.collect::<Vec<_>>() })
    }

    /// A table with these keys.
    fn keys(
        &mut self,
        keys: &[&Key],
        mut properties: Map<String, Json>,
        mut required: Vec<&str>,
    ) -> Json {
        for key in keys {
            properties.insert(key.name.to_owned(), self.key(key));
            if key.need == Need::Required && key.beside.is_none() && key.with.is_none() {
                required.push(key.name);
            }
        }
        let mut schema =
            json!({ "type": "object", "properties": properties, "additionalProperties": false });
        let optional = [
            ("required", Json::from(required)),
            (
                "allOf",
                [exclusive_groups(keys), chosen_keys(keys)].concat().into(),
            ),
            ("dependentRequired", companions(keys).into()),
        ];
        for (name, value) in optional {
            if !is_empty(&value) {
                schema[name] = value;
            }
        }
        schema
    }

    fn key(&mut self, key: &Key) -> Json {
        let mut schema = self.value(&key.value);
        schema["description"] = format!("{}. {}.", key.doc, key.value.describe()).into();
        if let Need::Default(text) = key.need
            && let Ok(default) = serde_json::from_str::<Json>(text)
        {
            schema["default"] = default;
        }
        schema
    }

    fn value(&mut self, value: &Value) -> Json {
        match value {
            Value::Text | Value::Name(_) | Value::File | Value::LengthUnit => {
                json!({ "type": "string" })
            }
            Value::Flag => json!({ "type": "boolean" }),
            Value::Count => json!({ "type": "integer", "minimum": 0 }),
            Value::Number => json!({ "type": "number" }),
            Value::Quantity(tables) if tables.iter().any(|table| table.allows_bare_numbers) => {
                length()
            }
            Value::Quantity(tables) => json!({ "type": "string", "examples": [tables[0].example] }),
            Value::Point | Value::Displacement => {
                self.reference("lengths", |_| array(&length(), 3))
            }
            Value::Direction => {
                self.reference("direction", |_| array(&json!({ "type": "number" }), 3))
            }
            Value::PointAndDirection => self.reference("ray", |_| ray()),
            Value::TimeAndFactor => self.reference("time-and-factor", |_| time_and_factor()),
            Value::Lanes => {
                let table = self.value(&Value::Table(&TABLE));
                self.reference("lanes", |_| lanes(table))
            }
            Value::Wavelengths => intervals(2),
            Value::Intervals => intervals(3),
            Value::Choice(names) => json!({ "enum": names }),
            Value::Array(inner, count) => array(&self.value(inner), *count),
            Value::List(inner) => json!({ "type": "array", "items": self.value(inner) }),
            Value::OneOrMany(inner) => {
                let one = self.value(inner);
                json!({ "anyOf": [one, { "type": "array", "items": one }] })
            }
            Value::Either(values) => {
                json!({ "anyOf": values.iter().map(|value| self.value(value)).collect::<Vec<_>>() })
            }
            Value::Table(record) => self.reference(&definition_name(record.noun), |definitions| {
                definitions.record(record)
            }),
            Value::Kinds(family) => {
                self.reference(family.noun, |definitions| definitions.family(family))
            }
        }
    }
}

/// "a step of a transform" without its article, as one word.
fn definition_name(noun: &str) -> String {
    noun.split_once(' ')
        .map_or(noun, |(_, rest)| rest)
        .replace(' ', "-")
}

fn is_empty(value: &Json) -> bool {
    value.as_array().is_some_and(Vec::is_empty) || value.as_object().is_some_and(Map::is_empty)
}

/// `oneOf` for each group of keys that exclude each other.
fn exclusive_groups(keys: &[&Key]) -> Vec<Json> {
    let mut groups: Vec<(&str, Vec<Json>)> = Vec::new();
    for key in keys {
        let Need::OneOf(group) = key.need else {
            continue;
        };
        let alternative = json!({ "required": [key.name] });
        match groups.iter_mut().find(|(name, _)| *name == group) {
            Some((_, alternatives)) => alternatives.push(alternative),
            None => groups.push((group, vec![alternative])),
        }
    }
    groups
        .into_iter()
        .map(|(_, alternatives)| json!({ "oneOf": alternatives }))
        .collect()
}

/// Keys that need a choice of another key, and that such a choice needs.
fn chosen_keys(keys: &[&Key]) -> Vec<Json> {
    let rule = |key: &&Key| {
        let with = key.with.as_ref()?;
        let other = keys.iter().find(|other| other.name == with.key)?;
        let is_default = |name: &&str| matches!(other.need, Need::Default(text) if text.trim_matches('"') == *name);
        let mut chosen = json!({ "properties": { with.key: { "enum": with.names } } });
        if !with.names.iter().any(is_default) {
            chosen["required"] = json!([with.key]);
        }
        let present = json!({ "required": [key.name] });
        let mut rule = json!({ "if": chosen, "else": { "not": present } });
        if key.need == Need::Required {
            rule["then"] = present;
        }
        Some(rule)
    };
    keys.iter().filter_map(rule).collect()
}

/// Which keys need another: those that mean something only beside it, and it those that it requires.
fn companions(keys: &[&Key]) -> Map<String, Json> {
    let mut needs: Vec<(&str, Vec<&str>)> = Vec::new();
    let mut add = |from, to| match needs.iter_mut().find(|(name, _)| *name == from) {
        Some((_, others)) => others.push(to),
        None => needs.push((from, vec![to])),
    };
    for key in keys {
        let Some(other) = key.beside else { continue };
        add(key.name, other);
        if key.need == Need::Required {
            add(other, key.name);
        }
    }
    needs
        .into_iter()
        .map(|(name, others)| (name.to_owned(), others.into()))
        .collect()
}

fn array(items: &Json, count: usize) -> Json {
    json!({ "type": "array", "items": items, "minItems": count, "maxItems": count })
}

/// A number of metres, or text with a unit.
fn length() -> Json {
    json!({ "type": ["number", "string"] })
}

fn ray() -> Json {
    let number = json!({ "type": "number" });
    json!({
        "type": "array",
        "prefixItems": [length(), length(), length(), number, number, number],
        "items": false,
        "minItems": 6,
    })
}

fn time_and_factor() -> Json {
    json!({
        "type": "array",
        "prefixItems": [{ "type": "string" }, { "type": "number", "minimum": 0 }],
        "items": false,
        "minItems": 2,
    })
}

/// Numbers parted by colons, in nm.
fn intervals(count: usize) -> Json {
    let numbers = vec![r" *[0-9.eE+-]+ *"; count].join(":");
    json!({ "type": "string", "pattern": format!("^{numbers} *nm *$") })
}

fn lanes(table: Json) -> Json {
    json!({ "anyOf": [
        { "type": "number" },
        { "type": "string", "pattern": "^#[0-9A-Fa-f]{6}$" },
        array(&json!({ "type": "number" }), 3),
        { "type": "array", "items": array(&json!({ "type": "number" }), 2) },
        table,
        { "type": "object", "additionalProperties": { "type": "number" } },
    ] })
}
