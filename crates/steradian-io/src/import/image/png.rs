//! PNG: grey, palettes and colour, with and without alpha, up to 16 bits.

use std::io::Cursor;

use png::{BitDepth, Decoder, Limits, Transformations};
use steradian::material::{Bitmap, Texels};

use super::{Encoding, ImageError, check_size, of_bytes, texels};

/// Decoders that need more memory beside the picture itself are stopped.
const MOST_BYTES: usize = 1 << 28;

pub(super) fn read(bytes: &[u8], encoding: Encoding) -> Result<Bitmap, ImageError> {
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: MOST_BYTES });
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let mut reader = decoder.read_info().map_err(unreadable)?;
    let info = reader.info();
    let size = [info.width, info.height];
    check_size(size[0].into(), size[1].into(), bytes)?;
    let (color, depth) = reader.output_color_type();
    let length = reader.output_buffer_size().unwrap_or(0);
    let mut codes = vec![0; length];
    reader.next_frame(&mut codes).map_err(unreadable)?;
    match depth {
        BitDepth::Sixteen => of_words(size, color.samples(), &codes, encoding),
        _ => of_bytes(size, color.samples(), &codes, encoding),
    }
}

fn of_words(
    [width, height]: [u32; 2],
    channels: usize,
    codes: &[u8],
    encoding: Encoding,
) -> Result<Bitmap, ImageError> {
    let (words, _) = codes.as_chunks::<2>();
    let texels = texels(channels, words, u16::MAX, |word| u16::from_be_bytes(*word));
    let texels = match encoding {
        Encoding::Srgb => Texels::Srgb16(texels),
        Encoding::Linear => Texels::Linear16(texels),
    };
    Ok(Bitmap::new(width, height, texels)?)
}

fn unreadable(error: png::DecodingError) -> ImageError {
    ImageError::Unreadable {
        format: "PNG",
        reason: error.to_string(),
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use png::{ColorType, Encoder};

    pub fn file(color: ColorType, depth: BitDepth, data: &[u8], palette: Option<&[u8]>) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if let Some(palette) = palette {
            encoder.set_palette(palette.to_vec());
            encoder.set_trns(vec![255, 51]);
        }
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(data).unwrap();
        writer.finish().unwrap();
        bytes
    }

    fn texels_of(color: ColorType, depth: BitDepth, data: &[u8]) -> Texels {
        let bytes = file(color, depth, data, None);
        read(&bytes, Encoding::Linear).unwrap().texels().clone()
    }

    #[test]
    fn all_kinds_of_colour_become_four_channels() {
        use Texels::{Linear8, Linear16};
        let (eight, sixteen) = (BitDepth::Eight, BitDepth::Sixteen);
        assert_eq!(
            texels_of(ColorType::Grayscale, eight, &[7, 9]),
            Linear8(vec![[7, 7, 7, 255], [9, 9, 9, 255]])
        );
        assert_eq!(
            texels_of(ColorType::Grayscale, BitDepth::One, &[0b0100_0000]),
            Linear8(vec![[0, 0, 0, 255], [255; 4]])
        );
        assert_eq!(
            texels_of(ColorType::Rgb, eight, &[1, 2, 3, 4, 5, 6]),
            Linear8(vec![[1, 2, 3, 255], [4, 5, 6, 255]])
        );
        assert_eq!(
            texels_of(
                ColorType::GrayscaleAlpha,
                sixteen,
                &[1, 2, 3, 4, 0, 5, 0, 6]
            ),
            Linear16(vec![[258, 258, 258, 772], [5, 5, 5, 6]])
        );
    }

    #[test]
    fn palettes_are_looked_up_with_their_alpha() {
        let palette = [10, 20, 30, 40, 50, 60];
        let bytes = file(ColorType::Indexed, BitDepth::Eight, &[1, 0], Some(&palette));
        let bitmap = read(&bytes, Encoding::Srgb).unwrap();
        let expected = vec![[40, 50, 60, 51], [10, 20, 30, 255]];
        assert_eq!(bitmap.texels(), &Texels::Srgb8(expected));
    }

    #[test]
    fn a_file_cut_short_is_refused_wherever_it_ends() {
        let bytes = file(ColorType::Rgba, BitDepth::Eight, &[1; 8], None);
        let data_end = bytes.windows(4).position(|four| four == b"IEND").unwrap() - 8;
        for end in 8..data_end {
            assert!(read(&bytes[..end], Encoding::Srgb).is_err(), "{end}");
        }
    }
}
