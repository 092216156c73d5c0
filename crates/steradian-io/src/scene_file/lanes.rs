//! Numbers for the lanes of a spectrum, and what the lanes stand for.

use steradian::material::linear_from_srgb;
use steradian::scene::description::{LaneValues, SpectrumMode};
use steradian::spectrum::{Beyond, VISIBLE};
use toml::de::{DeTable, DeValue};

use super::fields::Fields;
use super::keys::Value;
use super::node::{Node, in_file_order};
use super::spectrum::{self, Wavelengths, inline};
use super::tables::{MODE, SPECTRUM, SPECTRUM_NAMES};
use super::value::{Read, choice};

impl Read for LaneValues {
    const VALUE: Value = Value::Lanes;

    fn read(node: Node<'_>) -> Option<Self> {
        match node.toml {
            DeValue::Integer(_) | DeValue::Float(_) => f64::read(node).map(Self::Uniform),
            DeValue::String(code) => colour(code).or_else(|| not_lanes(node)),
            DeValue::Array(array) if array.iter().any(|element| element.get_ref().is_array()) => {
                inline(node, Beyond::Held).map(Self::table)
            }
            DeValue::Array(array) if array.len() == 3 => <[f64; 3]>::read(node).map(Self::Rgb),
            DeValue::Table(table) if table.contains_key("file") => spectrum::reflectance(node),
            DeValue::Table(table) => bands(node, table),
            _ => not_lanes(node),
        }
    }
}

fn not_lanes(node: Node<'_>) -> Option<LaneValues> {
    node.expected(&Value::Lanes.describe());
    None
}

fn bands(node: Node<'_>, table: &DeTable<'_>) -> Option<LaneValues> {
    let mut values = Vec::new();
    for (name, value) in in_file_order(table) {
        values.push((
            name.get_ref().to_string(),
            f64::read(Node::new(value, node.context)),
        ));
    }
    let values: Option<Vec<_>> = values
        .into_iter()
        .map(|(name, value)| Some((name, value?)))
        .collect();
    values.map(LaneValues::Bands)
}

/// `#rrggbb`: sRGB components, made linear.
fn colour(code: &str) -> Option<LaneValues> {
    let digits = code.strip_prefix('#')?;
    if digits.len() != 6 || !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    let rgb = u32::from_str_radix(digits, 16).ok()?;
    let [_, red, green, blue] = rgb.to_be_bytes();
    Some(LaneValues::Rgb(
        [red, green, blue].map(|code| linear_from_srgb(f64::from(code) / 255.0)),
    ))
}

impl Read for SpectrumMode {
    const VALUE: Value = SPECTRUM;

    fn read(node: Node<'_>) -> Option<Self> {
        if node.toml.is_table() {
            return mode(&node.record(&MODE)?);
        }
        match choice(node, SPECTRUM_NAMES)? {
            "rgb" => Some(Self::Rgb),
            "spectral" => Some(Self::Spectral { range: VISIBLE }),
            _ => Some(Self::default()),
        }
    }
}

/// Bands by name, or wavelengths.
fn mode(fields: &Fields<'_>) -> Option<SpectrumMode> {
    if fields.has("range") {
        let Wavelengths(range) = fields.get("range")?;
        return Some(SpectrumMode::Spectral { range });
    }
    let bands = fields.get("bands")?;
    Some(SpectrumMode::Broadband { bands })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hexadecimal_colours_are_made_linear() {
        let Some(LaneValues::Rgb([red, green, blue])) = colour("#ff8000") else {
            panic!("no colour")
        };
        assert_eq!((red, blue), (1.0, 0.0));
        // 128/255 = .50196 encodes ((.50196 + .055)/1.055)^2.4 = .215861.
        assert!((green - 0.215_860_5).abs() < 1e-7, "{green}");
    }

    #[test]
    fn other_strings_are_no_colours() {
        for code in [
            "", "#", "ff8000", "#ff80", "#ff80000", "#gg0000", "#+10000", "#é0000", "red",
        ] {
            assert_eq!(colour(code), None, "{code}");
        }
    }
}
