//! OpenEXR: every lane and its standard error in 32-bit floats.
//!
//! One part holds the channels `R`, `G`, `B` (or the bands by name) in W/(m² sr), and beside each a channel
//! `std_error.R` … with its standard error: by OpenEXR's naming convention, a layer called `std_error`. The attribute
//! `steradian` is a JSON object with units, seed, scene hash, luminous efficacy and samples. Where the run has a
//! luminous efficacy K, the standard attribute `whiteLuminance`, the luminance in cd/m² of the pixel (1, 1, 1), is K.

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, Image, Layer, LayerAttributes,
    Text, WritableImage,
};

use super::error::ReportError;
use super::image::{Channel, RadianceImage};

/// Name of the layer that holds the standard errors.
pub const ERROR_LAYER: &str = "std_error";

/// The bytes of an EXR file.
pub fn encode(picture: &RadianceImage) -> Result<Vec<u8>, ReportError> {
    let channels = picture.channels.iter().flat_map(pair).collect();
    let size = (picture.width, picture.height);
    let layer = Layer::new(
        size,
        attributes(picture)?,
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(channels),
    );
    let image = Image::from_layer(layer);
    let mut bytes = Cursor::new(Vec::new());
    let written = image.write().non_parallel().to_buffered(&mut bytes);
    written.map_err(|error| ReportError::Encoding(error.to_string()))?;
    Ok(bytes.into_inner())
}

fn pair(channel: &Channel) -> [AnyChannel<FlatSamples>; 2] {
    let name = short_name(&channel.name);
    let errors = format!("{ERROR_LAYER}.{name}");
    [
        AnyChannel::new(name, FlatSamples::F32(channel.values.clone())),
        AnyChannel::new(
            Text::from(errors.as_str()),
            FlatSamples::F32(channel.std_errors.clone()),
        ),
    ]
}

fn short_name(name: &str) -> &str {
    match name {
        "red" => "R",
        "green" => "G",
        "blue" => "B",
        band => band,
    }
}

/// All facts are in one attribute, since the crate writes attributes in no fixed order.
fn attributes(picture: &RadianceImage) -> Result<LayerAttributes, ReportError> {
    let mut attributes = LayerAttributes::default();
    let facts = picture.facts_as_json()?;
    attributes.other.insert(
        Text::from("steradian"),
        AttributeValue::Text(Text::from(facts.as_str())),
    );
    if picture.is_rgb() {
        attributes.white_luminance = picture
            .facts
            .luminous_efficacy
            .map(|efficacy| efficacy as f32);
    }
    Ok(attributes)
}

#[cfg(test)]
mod tests {
    use super::super::image::tests::picture;
    use super::*;
    use exr::prelude::{ReadChannels, ReadLayers, read};

    fn decode(bytes: &[u8]) -> Layer<AnyChannels<FlatSamples>> {
        let reader = read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes();
        reader
            .non_parallel()
            .from_buffered(Cursor::new(bytes))
            .unwrap()
            .layer_data
    }

    fn values(layer: &Layer<AnyChannels<FlatSamples>>, name: &str) -> Vec<f32> {
        let named = layer
            .channel_data
            .list
            .iter()
            .find(|channel| channel.name == *name);
        named.unwrap().sample_data.values_as_f32().collect()
    }

    #[test]
    fn every_lane_and_error_reads_back_bit_for_bit() {
        let picture = picture(5, 3, &["red", "green", "blue"]);
        let layer = decode(&encode(&picture).unwrap());
        assert_eq!((layer.size.0, layer.size.1), (5, 3));
        for (channel, name) in picture.channels.iter().zip(["R", "G", "B"]) {
            assert_eq!(values(&layer, name), channel.values);
            assert_eq!(
                values(&layer, &format!("std_error.{name}")),
                channel.std_errors
            );
        }
    }

    #[test]
    fn bands_keep_their_names_and_facts_read_back() {
        let picture = picture(2, 2, &["visible", "nir"]);
        let layer = decode(&encode(&picture).unwrap());
        assert_eq!(values(&layer, "nir"), picture.channels[1].values);
        let AttributeValue::Text(facts) = &layer.attributes.other[&Text::from("steradian")] else {
            panic!("text")
        };
        let facts: serde_json::Value = serde_json::from_str(&facts.to_string()).unwrap();
        assert_eq!(facts["unit"], "W/(m2 sr)");
        assert_eq!(facts["seed"], 7);
        assert_eq!(facts["luminous_efficacy"], 179.0);
    }

    #[test]
    fn the_same_picture_gives_the_same_bytes() {
        let picture = picture(9, 4, &["red", "green", "blue"]);
        assert_eq!(encode(&picture).unwrap(), encode(&picture).unwrap());
    }
}
