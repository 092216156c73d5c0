//! PNG: a picture to look at, tone-mapped or in false colours with a legend.
//!
//! Text chunks tell what was done: unit, exposure or the ends of the scale, seed, scene hash.

use super::error::ReportError;
use super::false_colour;
use super::image::RadianceImage;
use super::tone::{exposure, srgb};

/// Eight-bit red, green and blue, row by row from the top left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pixels {
    /// Pixels a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The pixels.
    pub rgb: Vec<[u8; 3]>,
}

impl Pixels {
    /// A picture of one colour.
    pub fn filled(width: usize, height: usize, colour: [u8; 3]) -> Self {
        Self {
            width,
            height,
            rgb: vec![colour; width * height],
        }
    }

    /// Sets a pixel; outside the picture nothing happens.
    pub fn set(&mut self, x: usize, y: usize, colour: [u8; 3]) {
        if x < self.width && y < self.height {
            self.rgb[y * self.width + x] = colour;
        }
    }
}

/// The bytes of a tone-mapped PNG; each stop doubles the brightness. Lanes other than red, green and blue give the
/// picture's quantity in grey.
pub fn encode_tone_mapped(picture: &RadianceImage, stops: f64) -> Result<Vec<u8>, ReportError> {
    let (brightness, unit, of_white) = picture.brightness();
    let scale = exposure(&brightness, stops);
    let pixels = if picture.is_rgb() {
        colour_pixels(picture, scale * of_white)
    } else {
        grey_pixels(picture, &brightness, scale)
    };
    let note = format!(
        "tone-mapped: display-linear value = {scale:e} per {unit}, cut off at 1, sRGB curve"
    );
    encode(&pixels, picture, note)
}

/// The bytes of a PNG in false colours, with a legend that shows the unit.
pub fn encode_false_colour(picture: &RadianceImage) -> Result<Vec<u8>, ReportError> {
    let scale = false_colour::Scale::of(&picture.quantity());
    let unit = &picture.facts.quantity.unit;
    let [bottom, top] = scale.ends();
    let note = format!("false colours: viridis from {bottom:e} to {top:e} {unit}, logarithmic");
    encode(&false_colour::draw(picture, &scale), picture, note)
}

/// White is where all lanes reach 1 / `lane_scale`.
fn colour_pixels(picture: &RadianceImage, lane_scale: f64) -> Pixels {
    let [red, green, blue] = [0, 1, 2].map(|lane| &picture.channels[lane].values);
    let pixel = |at: usize| [red, green, blue].map(|lane| srgb(lane_scale * f64::from(lane[at])));
    let rgb = (0..picture.width * picture.height).map(pixel).collect();
    Pixels {
        width: picture.width,
        height: picture.height,
        rgb,
    }
}

fn grey_pixels(picture: &RadianceImage, quantity: &[f64], scale: f64) -> Pixels {
    let rgb = quantity
        .iter()
        .map(|value| [srgb(scale * value); 3])
        .collect();
    Pixels {
        width: picture.width,
        height: picture.height,
        rgb,
    }
}

fn encode(pixels: &Pixels, picture: &RadianceImage, note: String) -> Result<Vec<u8>, ReportError> {
    let facts = ("steradian", picture.facts_as_json()?);
    encode_with_texts(pixels, [("Description", note), facts])
}

/// The bytes of a PNG with texts by keyword.
pub fn encode_with_texts<const N: usize>(
    pixels: &Pixels,
    texts: [(&str, String); N],
) -> Result<Vec<u8>, ReportError> {
    let failed = |error: png::EncodingError| ReportError::Encoding(error.to_string());
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(
        &mut bytes,
        dimension(pixels.width)?,
        dimension(pixels.height)?,
    );
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    for (keyword, text) in texts {
        encoder
            .add_itxt_chunk(keyword.to_owned(), text)
            .map_err(failed)?;
    }
    let mut writer = encoder.write_header().map_err(failed)?;
    writer
        .write_image_data(pixels.rgb.as_flattened())
        .map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

fn dimension(pixels: usize) -> Result<u32, ReportError> {
    u32::try_from(pixels)
        .map_err(|_| ReportError::Encoding(format!("{pixels} pixels are too many for PNG")))
}

#[cfg(test)]
mod tests {
    use super::super::image::tests::picture;
    use super::*;
    use std::io::Cursor;

    fn decode(bytes: &[u8]) -> (Pixels, Vec<(String, String)>) {
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let mut buffer = vec![0; reader.output_buffer_size().unwrap()];
        let frame = reader.next_frame(&mut buffer).unwrap();
        let (rgb, _) = buffer.as_chunks::<3>();
        let texts = reader
            .info()
            .utf8_text
            .iter()
            .map(|text| (text.keyword.clone(), text.get_text().unwrap()));
        let pixels = Pixels {
            width: frame.width as usize,
            height: frame.height as usize,
            rgb: rgb.to_vec(),
        };
        (pixels, texts.collect())
    }

    #[test]
    fn a_uniform_picture_is_middle_grey_and_a_stop_brighter_is_lighter() {
        let mut uniform = picture(4, 3, &["red", "green", "blue"]);
        for channel in &mut uniform.channels {
            channel.values.fill(50.0);
        }
        let (pixels, _) = decode(&encode_tone_mapped(&uniform, 0.0).unwrap());
        assert_eq!(pixels, Pixels::filled(4, 3, [srgb(0.18); 3]));
        let (brighter, _) = decode(&encode_tone_mapped(&uniform, 1.0).unwrap());
        assert_eq!(brighter.rgb[0], [srgb(0.36); 3]);
    }

    #[test]
    fn bands_give_a_grey_picture() {
        let (pixels, _) =
            decode(&encode_tone_mapped(&picture(3, 3, &["visible", "nir"]), 0.0).unwrap());
        assert!(pixels.rgb.iter().all(|[r, g, b]| r == g && g == b));
        assert!(pixels.rgb[0] < pixels.rgb[8]);
    }

    #[test]
    fn the_texts_tell_what_was_done() {
        let (_, texts) = decode(&encode_false_colour(&picture(40, 30, &["total"])).unwrap());
        assert!(
            texts
                .iter()
                .any(|(key, text)| key == "Description" && text.contains("W/(m2 sr)"))
        );
        assert!(
            texts
                .iter()
                .any(|(key, text)| key == "steradian" && text.contains("\"scene_hash\":\"abc\""))
        );
    }

    #[test]
    fn false_colours_keep_the_picture_and_add_a_legend() {
        let (pixels, _) = decode(&encode_false_colour(&picture(40, 60, &["total"])).unwrap());
        assert!(pixels.width > 40 && pixels.height >= 60);
        assert_ne!(pixels.rgb[0], pixels.rgb[39 + 59 * pixels.width]);
    }
}
