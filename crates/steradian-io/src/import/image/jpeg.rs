//! JPEG: baseline and progressive, grey and colour.

use steradian::material::Bitmap;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::{Encoding, ImageError, check_size, of_bytes};

/// The format has no larger pictures.
const MOST_PIXELS: usize = 65_535;

/// The marker of the end; within the coded data 0xff is followed by 0.
const END_OF_IMAGE: [u8; 2] = [0xff, 0xd9];

pub(super) fn read(bytes: &[u8], encoding: Encoding) -> Result<Bitmap, ImageError> {
    if !bytes.windows(2).any(|two| two == END_OF_IMAGE) {
        return Err(unreadable("it ends too early"));
    }
    let options = DecoderOptions::default()
        .set_strict_mode(true)
        .set_max_width(MOST_PIXELS)
        .set_max_height(MOST_PIXELS)
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(unreadable)?;
    let (width, height) = decoder
        .dimensions()
        .ok_or_else(|| unreadable("no size in its header"))?;
    check_size(width as u64, height as u64, bytes)?;
    let codes = decoder.decode().map_err(unreadable)?;
    of_bytes([width as u32, height as u32], 3, &codes, encoding)
}

fn unreadable(error: impl ToString) -> ImageError {
    ImageError::Unreadable {
        format: "JPEG",
        reason: error.to_string(),
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use steradian::material::Texels;

    pub const BASELINE: &[u8] = include_bytes!("../../../tests/data/two_blocks.jpg");
    pub const PROGRESSIVE: &[u8] = include_bytes!("../../../tests/data/two_blocks_progressive.jpg");
    const GREY: &[u8] = include_bytes!("../../../tests/data/grey.jpg");

    fn codes(bytes: &[u8]) -> Vec<[u8; 4]> {
        match read(bytes, Encoding::Srgb).unwrap().texels() {
            Texels::Srgb8(texels) => texels.clone(),
            other => panic!("{other:?}"),
        }
    }

    /// Blocks of one colour have only their mean, which is coded to ± 1 or so.
    fn close(found: [u8; 4], expected: [u8; 4]) -> bool {
        found.iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 2)
    }

    #[test]
    fn blocks_of_one_colour_keep_it() {
        for bytes in [BASELINE, PROGRESSIVE] {
            let texels = codes(bytes);
            assert_eq!(texels.len(), 128);
            assert!(close(texels[0], [200, 40, 80, 255]), "{:?}", texels[0]);
            assert!(close(texels[15], [128, 128, 128, 255]), "{:?}", texels[15]);
        }
        assert!(
            codes(GREY)
                .iter()
                .all(|texel| close(*texel, [128, 128, 128, 255]))
        );
    }

    #[test]
    fn a_file_cut_short_is_refused() {
        for end in 3..BASELINE.len() - 2 {
            assert!(read(&BASELINE[..end], Encoding::Srgb).is_err(), "{end}");
        }
    }
}
