//! Spectra by wavelength: tables inline or in files, the shapes of lights, intervals of wavelength.

use std::sync::Arc;

use steradian::quantity::{Quantity, Temperature};
use steradian::spectrum::{
    Beyond, Curve, CurveError, Illuminant, LaneValues, VISIBLE, blackbody, daylight,
};
use toml::de::DeValue;

use crate::import::spectrum;

use super::fields::Fields;
use super::keys::Value;
use super::node::Node;
use super::tables::{BLACKBODY_RANGE, BLACKBODY_STEP, LIGHT_SHAPE, LIGHT_SPECTRUM, TABLE};
use super::value::{Read, choice};

/// The samples `[[nm, value], …]`.
pub(super) fn inline(node: Node<'_>, beyond: Beyond) -> Option<Curve> {
    let samples: Vec<[f64; 2]> = Vec::read(node)?;
    let samples = samples.into_iter().map(<(f64, f64)>::from).collect();
    Curve::new(samples, beyond)
        .map_err(|error| report(node, &error))
        .ok()
}

/// Reports what is wrong with samples at the one that is wrong.
fn report(node: Node<'_>, error: &CurveError) {
    let sample = match error {
        CurveError::NotFinite { index, .. } | CurveError::NotIncreasing { index, .. } => *index,
        _ => 0,
    };
    let element = node
        .elements()
        .and_then(|mut elements| elements.nth(sample));
    let place = element.map_or(node.range(), |element| element.range());
    node.context.error(place, error.to_string(), None);
}

/// The spectrum in a file that the keys `file` and `column` name.
pub(super) fn from_file(fields: &Fields<'_>, beyond: Beyond) -> Option<Curve> {
    let (file, column) = (fields.get("file"), fields.get::<String>("column"));
    let file: String = file?;
    let span = fields.span_of("file");
    let bytes = fields.context().read_file(&file, span.clone())?;
    spectrum::read(&bytes, column.as_deref(), beyond)
        .map_err(|error| {
            let message = format!("{file}: {error}");
            fields.context().error(span, message, None);
        })
        .ok()
}

/// The reflectance that a table `{ file = "…", column = "…" }` names.
pub(super) fn reflectance(node: Node<'_>) -> Option<LaneValues> {
    let fields = node.record(&TABLE)?;
    from_file(&fields, Beyond::Held).map(LaneValues::table)
}

/// Shape of a light's spectrum.
pub(super) struct LightSpectrum(pub LaneValues);

impl Read for LightSpectrum {
    const VALUE: Value = LIGHT_SPECTRUM;

    fn read(node: Node<'_>) -> Option<Self> {
        let values = match node.toml {
            DeValue::String(name) if !name.starts_with('#') => illuminant(node),
            DeValue::Array(array) if array.iter().any(|element| element.get_ref().is_array()) => {
                inline(node, Beyond::Zero).map(LaneValues::table)
            }
            DeValue::Table(table)
                if LIGHT_SHAPE
                    .keys
                    .iter()
                    .any(|key| table.contains_key(key.name)) =>
            {
                shape(node)
            }
            _ => LaneValues::read(node),
        };
        values.map(Self)
    }
}

/// The illuminant of this name.
fn illuminant(node: Node<'_>) -> Option<LaneValues> {
    let names = Illuminant::ALL.map(Illuminant::name);
    let name = choice(node, &names)?;
    Illuminant::from_name(name).map(|illuminant| natural(illuminant.curve().clone()))
}

/// A shape whose watts are those between 360 and 830 nm.
fn natural(curve: Curve) -> LaneValues {
    LaneValues::Curve {
        curve: Arc::new(curve),
        watts: VISIBLE,
    }
}

fn shape(node: Node<'_>) -> Option<LaneValues> {
    let fields = node.record(&LIGHT_SHAPE)?;
    if fields.has("file") {
        return from_file(&fields, Beyond::Zero).map(LaneValues::table);
    }
    if let Some(IlluminantShape(values)) = fields.get("illuminant") {
        return Some(values);
    }
    let planckian = |kelvin| blackbody(kelvin, BLACKBODY_RANGE, BLACKBODY_STEP);
    of_temperature(&fields, "blackbody", planckian)
        .or_else(|| of_temperature(&fields, "daylight", daylight))
}

/// The curve of the temperature in the key `name`.
fn of_temperature(
    fields: &Fields<'_>,
    name: &str,
    curve: impl Fn(f64) -> Result<Curve, CurveError>,
) -> Option<LaneValues> {
    let temperature: Temperature = fields.get(name)?;
    curve(temperature.to_kelvin())
        .map(natural)
        .map_err(|error| {
            let span = fields.span_of(name);
            fields.context().error(span, error.to_string(), None);
        })
        .ok()
}

/// The curve of the illuminant that a key names.
struct IlluminantShape(LaneValues);

impl Read for IlluminantShape {
    const VALUE: Value = Value::Choice(super::tables::ILLUMINANT_NAMES);

    fn read(node: Node<'_>) -> Option<Self> {
        illuminant(node).map(Self)
    }
}

impl Read for Temperature {
    const VALUE: Value = Value::Quantity(&[Self::TABLE]);

    fn read(node: Node<'_>) -> Option<Self> {
        super::value::quantity(node, &Self::VALUE)
    }
}

/// First and last wavelength in nm: "380:780 nm".
pub(super) struct Wavelengths(pub [f64; 2]);

impl Read for Wavelengths {
    const VALUE: Value = Value::Wavelengths;

    fn read(node: Node<'_>) -> Option<Self> {
        numbers(node, &Self::VALUE).map(Self)
    }
}

/// First and last wavelength and the distance of neighbours in nm: "400:700:10 nm".
pub(super) struct Intervals(pub [f64; 3]);

impl Read for Intervals {
    const VALUE: Value = Value::Intervals;

    fn read(node: Node<'_>) -> Option<Self> {
        numbers(node, &Self::VALUE).map(Self)
    }
}

/// `N` numbers parted by colons, with the unit nm.
fn numbers<const N: usize>(node: Node<'_>, value: &Value) -> Option<[f64; N]> {
    let text = node.toml.as_str();
    let numbers = text.and_then(wavelengths);
    if numbers.is_none() {
        node.expected(&value.describe());
    }
    numbers
}

fn wavelengths<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers = text.trim().strip_suffix("nm")?.split(':');
    let numbers = numbers.map(|number| number.trim().parse().ok().filter(|x: &f64| x.is_finite()));
    numbers.collect::<Option<Vec<f64>>>()?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::super::tables::ILLUMINANT_NAMES;
    use super::*;

    #[test]
    fn intervals_have_a_unit() {
        assert_eq!(wavelengths("380:780 nm"), Some([380.0, 780.0]));
        assert_eq!(wavelengths(" 400 : 700 : 10nm"), Some([400.0, 700.0, 10.0]));
        for wrong in [
            "380:780",
            "380 nm",
            "380:780:5 nm",
            "a:b nm",
            "380:inf nm",
            ":nm",
            "",
        ] {
            assert_eq!(wavelengths::<2>(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn the_row_names_every_illuminant() {
        assert_eq!(Illuminant::ALL.map(Illuminant::name), ILLUMINANT_NAMES);
    }
}
