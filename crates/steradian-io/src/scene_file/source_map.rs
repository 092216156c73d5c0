//! Where the parts of a description are in the scene file.

use std::ops::Range;

use steradian::scene::{Part, Place};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::node::in_file_order;
use super::sections::Sections;

/// The spans of all entries and their keys.
#[derive(Clone, Debug, Default)]
pub(super) struct SourceMap {
    scene: Option<Entry>,
    materials: Vec<Entry>,
    shapes: Vec<Entry>,
    lights: Vec<Entry>,
    sensors: Vec<Entry>,
}

/// A table of the file: its own place, and those of the values in it and in the tables it holds.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    span: Range<usize>,
    values: Vec<(String, Range<usize>)>,
}

impl SourceMap {
    pub fn new(root: &DeTable<'_>, sections: &Sections) -> Self {
        let shapes = listed(root, "shapes");
        let shape = |entry: &usize| shapes.get(*entry).cloned();
        let of_files = sections.material_files.iter().cloned().map(Entry::plain);
        Self {
            scene: root.get("scene").map(Entry::new),
            materials: named(root, "materials")
                .into_iter()
                .chain(of_files)
                .collect(),
            shapes: sections.shape_entries.iter().filter_map(shape).collect(),
            lights: listed(root, "lights"),
            sensors: listed(root, "sensors"),
        }
    }

    /// The value of the place's key, else the part's own table; `None` if the file does not hold it.
    pub fn span(&self, place: Place) -> Option<Range<usize>> {
        let entry = match place.part {
            Part::Scene => self.scene.as_ref(),
            Part::Material(index) => self.materials.get(index),
            Part::Shape(index) => self.shapes.get(index),
            Part::Light(index) => self.lights.get(index),
            Part::Sensor(index) => self.sensors.get(index),
        }?;
        Some(
            place
                .key
                .and_then(|key| entry.value(key))
                .unwrap_or_else(|| entry.span.clone()),
        )
    }
}

impl Entry {
    pub fn new(table: &Spanned<DeValue<'_>>) -> Self {
        let mut values = Vec::new();
        if let DeValue::Table(entries) = table.get_ref() {
            collect(entries, &mut values);
        }
        Self {
            span: table.span(),
            values,
        }
    }

    /// A place without keys.
    fn plain(span: Range<usize>) -> Self {
        Self {
            span,
            values: vec![],
        }
    }

    /// The value of a key of the table itself or else of a table it holds.
    pub fn value(&self, key: &str) -> Option<Range<usize>> {
        self.values
            .iter()
            .find(|(name, _)| name == key)
            .map(|(_, span)| span.clone())
    }
}

/// The keys of a table, then those of the tables in it.
fn collect(table: &DeTable<'_>, values: &mut Vec<(String, Range<usize>)>) {
    for (key, value) in in_file_order(table) {
        values.push((key.get_ref().to_string(), value.span()));
    }
    for inner in table
        .iter()
        .filter_map(|(_, value)| value.get_ref().as_table())
    {
        collect(inner, values);
    }
}

fn named(root: &DeTable<'_>, section: &str) -> Vec<Entry> {
    let table = root
        .get(section)
        .and_then(|value| value.get_ref().as_table());
    table
        .into_iter()
        .flat_map(in_file_order)
        .map(|(_, entry)| Entry::new(entry))
        .collect()
}

fn listed(root: &DeTable<'_>, section: &str) -> Vec<Entry> {
    let array = root
        .get(section)
        .and_then(|value| value.get_ref().as_array());
    array.into_iter().flatten().map(Entry::new).collect()
}
