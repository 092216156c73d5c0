//! The sections of a scene file, each handed to its reader.

use std::collections::HashMap;
use std::ops::Range;

use steradian::quantity::LuminousEfficacy;
use steradian::scene::description::SceneDescription;
use toml::de::{DeTable, DeValue};

use super::context::Context;
use super::fields::Fields;
use super::keys::Form;
use super::node::{Node, in_file_order};
use super::tables::{SCENE, SECTIONS};
use super::{light, material, sensor, shape};
use crate::nearest::nearest;

/// What the sections say, and where its parts come from.
pub(super) struct Sections {
    pub description: SceneDescription,
    /// For each shape, which entry of `[[shapes]]` it is of.
    pub shape_entries: Vec<usize>,
    /// Where the scene names the files that the last materials are from.
    pub material_files: Vec<Range<usize>>,
}

/// Reads all sections, reporting what is wrong with them.
pub(super) fn read(root: &DeTable<'_>, context: &Context<'_>) -> Sections {
    check_sections(root, context);
    let mut description = SceneDescription::default();
    if let Some(scene) = root.get("scene") {
        read_header(Node::new(scene, context), &mut description);
    }
    description.materials = named(root, "materials", context, material::read);
    let shapes = listed(root, "shapes", context, shape::read);
    description.lights = listed(root, "lights", context, light::read);
    description.sensors = listed(root, "sensors", context, sensor::read);
    check_names(root, "shapes", context);
    check_names(root, "sensors", context);
    let (materials, material_files) = context.take_materials();
    description.materials.extend(materials);
    description.warnings = context.take_warnings();
    let numbered = shapes.iter().enumerate();
    Sections {
        shape_entries: numbered
            .flat_map(|(entry, shapes)| vec![entry; shapes.len()])
            .collect(),
        description: SceneDescription {
            shapes: shapes.into_iter().flatten().collect(),
            ..description
        },
        material_files,
    }
}

/// Reports sections that are unknown or not yet read.
fn check_sections(root: &DeTable<'_>, context: &Context<'_>) {
    for (key, _) in in_file_order(root) {
        let name = key.get_ref().as_ref();
        let section = SECTIONS.iter().find(|section| section.name == name);
        match section.map(|section| &section.form) {
            None => {
                let message = format!("unknown section `{name}`");
                context.error(key.span(), message, Some(section_hint(name)));
            }
            Some(Form::NotYet) => {
                let message = format!("section `{name}` is not supported yet");
                context.error(key.span(), message, None);
            }
            Some(_) => (),
        }
    }
}

fn section_hint(name: &str) -> String {
    let names: Vec<&str> = SECTIONS.iter().map(|section| section.name).collect();
    match nearest(name, names.iter().copied()) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => format!("the sections are {}", names.join(", ")),
    }
}

fn read_header(node: Node<'_>, description: &mut SceneDescription) {
    let Some(fields) = node.record(&SCENE) else {
        return;
    };
    let header = |fields: &Fields<'_>| {
        let (name, spectrum, response) = (
            fields.get("name"),
            fields.get("spectrum"),
            fields.get("response"),
        );
        node.context.up.set(fields.get("up")?);
        Some((name?, spectrum?, response?))
    };
    if let Some((name, spectrum, response)) = header(&fields) {
        (description.name, description.spectrum, description.response) = (name, spectrum, response);
    }
    description.luminous_efficacy = fields
        .get("luminous_efficacy")
        .map(LuminousEfficacy::to_lumens_per_watt);
}

/// Reads `[NAME.…]`, each entry a table with a name.
fn named<T>(
    root: &DeTable<'_>,
    section: &str,
    context: &Context<'_>,
    read: impl Fn(&str, Node<'_>) -> Option<T>,
) -> Vec<T> {
    let Some(value) = root.get(section) else {
        return Vec::new();
    };
    let Some(table) = value.get_ref().as_table() else {
        Node::new(value, context).expected(&format!("tables [{section}.NAME]"));
        return Vec::new();
    };
    let entries = in_file_order(table).into_iter();
    entries
        .filter_map(|(name, entry)| {
            reported(read(name.get_ref(), Node::new(entry, context)), context)
        })
        .collect()
}

/// Reads `[[NAME]]`, each entry a table.
fn listed<T>(
    root: &DeTable<'_>,
    section: &str,
    context: &Context<'_>,
    read: impl Fn(Node<'_>) -> Option<T>,
) -> Vec<T> {
    let Some(value) = root.get(section) else {
        return Vec::new();
    };
    let node = Node::new(value, context);
    let Some(entries) = node.elements() else {
        node.expected(&format!("tables [[{section}]]"));
        return Vec::new();
    };
    entries
        .filter_map(|entry| reported(read(entry), context))
        .collect()
}

/// Nothing is left out in silence.
fn reported<T>(entry: Option<T>, context: &Context<'_>) -> Option<T> {
    debug_assert!(
        entry.is_some() || context.has_problems(),
        "an entry was dropped without a report"
    );
    entry
}

/// Reports names that two entries of a list share.
fn check_names(root: &DeTable<'_>, section: &str, context: &Context<'_>) {
    let entries = root
        .get(section)
        .and_then(|value| value.get_ref().as_array());
    let mut seen = HashMap::new();
    for name in entries
        .into_iter()
        .flatten()
        .filter_map(|entry| entry.get_ref().get("name"))
    {
        let DeValue::String(text) = name.get_ref() else {
            continue;
        };
        if let Some(first) = seen.insert(text.to_string(), name.span().start) {
            let line = context.source.text[..first].lines().count();
            let hint = format!("the other one is in line {line}");
            context.error(
                name.span(),
                format!("two of the {section} are called {text:?}"),
                Some(hint),
            );
        }
    }
}
