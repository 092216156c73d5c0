//! What is told about the device.

use roxmltree::Node;

use super::{child, text};

/// Elements of `Material`, in the order in which they are shown.
const ELEMENTS: [&str; 6] = [
    "Name",
    "Manufacturer",
    "DeviceType",
    "Thickness",
    "Width",
    "Height",
];

/// Names and values; values with their units.
pub(super) fn read(layer: Node) -> Vec<(String, String)> {
    let Some(material) = child(layer, "Material") else {
        return vec![];
    };
    let entry = |name: &str| {
        let node = child(material, name)?;
        let value = text(node);
        let unit = node.attribute("unit").map(str::to_lowercase);
        let told = match unit {
            Some(unit) => format!("{value} {unit}"),
            None => value.to_owned(),
        };
        (!value.is_empty()).then(|| (name.to_owned(), told))
    };
    ELEMENTS.into_iter().filter_map(entry).collect()
}
