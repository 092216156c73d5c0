//! OpenEXR: light in R, G and B, and what Steradian says about it.

use std::io::Cursor;

use exr::prelude::{
    AnyChannels, AttributeValue, FlatSamples, Layer, ReadChannels, ReadLayers, Text, read as reader,
};
use serde_json::Value;

use super::{EFFICACY, LuminanceMap, LuminanceMapError};
use crate::import::image::{self, Encoding, ImageError};
use crate::report::exr::ERROR_LAYER;
use steradian::spectrum::REC709_LUMINANCE;

/// Lanes and their weights in cd/m² per unit.
type Weights = Vec<(String, f64)>;

pub(super) fn read(bytes: &[u8]) -> Result<LuminanceMap, LuminanceMapError> {
    // Refuses sizes that the bytes cannot hold.
    image::read(bytes, Encoding::Linear)?;
    let image = reader()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| unreadable(&error.to_string()))?;
    let layer = image.layer_data;
    let weights = weights(&layer)?;
    let luminances =
        total(&layer, &weights, "").ok_or_else(|| unreadable("it has no channels R, G and B"))?;
    Ok(LuminanceMap {
        size: [layer.size.width() as u32, layer.size.height() as u32],
        luminances,
        std_errors: total(&layer, &weights, &format!("{ERROR_LAYER}.")),
        projection: None,
    })
}

type AnyLayer = Layer<AnyChannels<FlatSamples>>;

fn weights(layer: &AnyLayer) -> Result<Weights, LuminanceMapError> {
    let colours = ["R", "G", "B"].map(str::to_owned);
    let Some(AttributeValue::Text(facts)) = layer.attributes.other.get(&Text::from("steradian"))
    else {
        let white = layer.attributes.white_luminance.map_or(EFFICACY, f64::from);
        return Ok(colours
            .into_iter()
            .zip(REC709_LUMINANCE.map(|weight| white * weight))
            .collect());
    };
    let facts: Value = serde_json::from_str(&facts.to_string()).unwrap_or_default();
    let quantity = &facts["quantity"];
    if quantity["unit"] != "cd/m2" {
        let unit = quantity["unit"].as_str().unwrap_or("no unit");
        let message = format!("the picture shows {unit}, not luminance in cd/m2");
        return Err(LuminanceMapError::Meaning(message));
    }
    let weights = quantity["weights"]
        .as_array()
        .map_or(&[][..], Vec::as_slice);
    let weights: Vec<f64> = weights.iter().filter_map(Value::as_f64).collect();
    match weights.len() {
        3 => Ok(colours.into_iter().zip(weights).collect()),
        1 => Ok(band(layer).into_iter().zip(weights).collect()),
        _ => Err(LuminanceMapError::Meaning(
            "luminance is read from pictures in rgb or of one band".into(),
        )),
    }
}

/// The one lane that is no error.
fn band(layer: &AnyLayer) -> Option<String> {
    let names = layer
        .channel_data
        .list
        .iter()
        .map(|channel| channel.name.to_string());
    names
        .into_iter()
        .find(|name| !name.starts_with(ERROR_LAYER))
}

/// Σ weight · lane, of the lanes whose names have a prefix; `None` if one is missing.
fn total(layer: &AnyLayer, weights: &Weights, prefix: &str) -> Option<Vec<f64>> {
    let mut sums = vec![0.0; layer.size.width() * layer.size.height()];
    for (name, weight) in weights {
        let name = format!("{prefix}{name}");
        let mut channels = layer.channel_data.list.iter();
        let channel = channels.find(|channel| channel.name == *name.as_str())?;
        for (sum, value) in sums.iter_mut().zip(channel.sample_data.values_as_f32()) {
            *sum += weight * f64::from(value);
        }
    }
    (!weights.is_empty()).then_some(sums)
}

fn unreadable(reason: &str) -> LuminanceMapError {
    let (format, reason) = ("OpenEXR", reason.to_owned());
    ImageError::Unreadable { format, reason }.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::exr::encode;
    use crate::report::image::tests::picture;

    /// K = 179 and Rec.709 in the test's picture; a picture in W/(m² sr) only is refused.
    #[test]
    fn our_pictures_say_what_they_show() {
        let mut written = picture(4, 3, &["red", "green", "blue"]);
        written.facts.quantity.unit = "cd/m2".to_owned();
        written.facts.quantity.weights = vec![10.0, 100.0, 1.0];
        let found = read(&encode(&written).unwrap()).unwrap();
        assert_eq!(found.size, [4, 3]);
        let lane = |channel: usize, at: usize| f64::from(written.channels[channel].values[at]);
        let expected = 10.0 * lane(0, 5) + 100.0 * lane(1, 5) + lane(2, 5);
        assert!((found.luminances[5] - expected).abs() < 1e-9 * expected.abs());
        let errors = found.std_errors.unwrap();
        let error = |channel: usize| f64::from(written.channels[channel].std_errors[5]);
        let expected = 10.0 * error(0) + 100.0 * error(1) + error(2);
        assert!((errors[5] - expected).abs() <= 1e-9 * expected);
        written.facts.quantity.unit = "W/(m2 sr)".to_owned();
        let refused = read(&encode(&written).unwrap()).unwrap_err();
        assert!(refused.to_string().contains("not luminance"), "{refused}");
    }
}
