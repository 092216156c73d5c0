//! OpenEXR: the first layer with the channels R, G, B or Y, and A, in linear light.
//!
//! Colour in OpenEXR is multiplied by alpha; it is divided by it here, where alpha is not 0.

use std::io::Cursor;

use exr::prelude::{
    AnyChannels, FlatSamples, Layer, MetaData, ReadChannels, ReadLayers, read as reader,
};
use steradian::material::{Bitmap, Texels};

use super::{ImageError, check_size};

pub(super) fn read(bytes: &[u8]) -> Result<Bitmap, ImageError> {
    let headers = MetaData::read_from_buffered(Cursor::new(bytes), true).map_err(unreadable)?;
    for header in &headers.headers {
        let size = header.layer_size;
        check_size(size.width() as u64, size.height() as u64, bytes)?;
    }
    let image = reader()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .pedantic()
        .from_buffered(Cursor::new(bytes))
        .map_err(unreadable)?;
    let picture = image.layer_data.iter().find_map(texels);
    let (layer, texels) =
        picture.ok_or_else(|| unreadable("no layer has channels R, G and B, or Y"))?;
    Ok(Bitmap::new(
        layer.size.width() as u32,
        layer.size.height() as u32,
        Texels::Float(texels),
    )?)
}

type ColorLayer = Layer<AnyChannels<FlatSamples>>;

fn texels(layer: &ColorLayer) -> Option<(&ColorLayer, Vec<[f32; 4]>)> {
    let channel = |name: &str| {
        let mut channels = layer.channel_data.list.iter();
        let found = channels.find(|channel| channel.name == *name)?;
        Some(found.sample_data.values_as_f32().collect::<Vec<_>>())
    };
    let color = match channel("R") {
        Some(red) => [red, channel("G")?, channel("B")?],
        None => {
            let grey = channel("Y")?;
            [grey.clone(), grey.clone(), grey]
        }
    };
    let alpha = channel("A");
    let count = layer.size.width() * layer.size.height();
    let texel = |at: usize| {
        let alpha = alpha
            .as_ref()
            .map_or(Some(1.0), |alpha| alpha.get(at).copied())?;
        let divisor = if alpha == 0.0 { 1.0 } else { alpha };
        let [r, g, b] = [0, 1, 2].map(|lane: usize| color[lane].get(at).map(|x| x / divisor));
        Some([r?, g?, b?, alpha])
    };
    let texels: Option<Vec<[f32; 4]>> = (0..count).map(texel).collect();
    Some((layer, texels?))
}

fn unreadable(error: impl ToString) -> ImageError {
    ImageError::Unreadable {
        format: "OpenEXR",
        reason: error.to_string(),
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use exr::prelude::{AnyChannel, Encoding, Image, LayerAttributes, WritableImage};

    pub fn file(channels: &[(&str, [f32; 2])]) -> Vec<u8> {
        let channel = |(name, values): &(&str, [f32; 2])| {
            AnyChannel::new(*name, FlatSamples::F32(values.to_vec()))
        };
        let list = AnyChannels::sort(channels.iter().map(channel).collect());
        let layer = Layer::new(
            (2, 1),
            LayerAttributes::default(),
            Encoding::SMALL_LOSSLESS,
            list,
        );
        let mut bytes = Cursor::new(Vec::new());
        let image = Image::from_layer(layer);
        image
            .write()
            .non_parallel()
            .to_buffered(&mut bytes)
            .unwrap();
        bytes.into_inner()
    }

    #[test]
    fn colour_is_divided_by_alpha() {
        let channels = [
            ("R", [1.0, 6.0]),
            ("G", [2.0, 0.0]),
            ("B", [4.0, 0.5]),
            ("A", [0.5, 0.0]),
        ];
        let bitmap = read(&file(&channels)).unwrap();
        let expected = vec![[2.0, 4.0, 8.0, 0.5], [6.0, 0.0, 0.5, 0.0]];
        assert_eq!(bitmap.texels(), &Texels::Float(expected));
    }

    #[test]
    fn luminance_alone_is_grey() {
        let bitmap = read(&file(&[("Y", [0.25, 3.0])])).unwrap();
        let expected = vec![[0.25, 0.25, 0.25, 1.0], [3.0, 3.0, 3.0, 1.0]];
        assert_eq!(bitmap.texels(), &Texels::Float(expected));
        assert!(read(&file(&[("depth", [0.25, 3.0])])).is_err());
    }

    #[test]
    fn a_file_cut_short_is_refused() {
        let bytes = file(&[("Y", [0.25, 3.0])]);
        for end in 4..bytes.len() {
            assert!(read(&bytes[..end]).is_err(), "{end}");
        }
    }
}
