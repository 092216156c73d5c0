//! Pictures: PNG, JPEG, OpenEXR and Radiance HDR, recognised by their first bytes.
//!
//! Codes of 8 and 16 bits are kept as they are, with what they stand for: light by the sRGB transfer function, or
//! numbers. What the file itself says about that (`gAMA`, `iCCP`, Exif) is passed over, as it is for textures in
//! glTF. Floats are linear light in any case. A picture without alpha is opaque; grey is equal red, green and blue.
//!
//! ```
//! use steradian::material::Texels;
//! use steradian_io::import::image::{Encoding, read};
//!
//! // One pixel of Radiance's format: (128 + ½)/256 · 2^(129 − 128).
//! let picture = read(b"#?RADIANCE\n\n-Y 1 +X 1\n\x80\x80\x80\x81", Encoding::Linear)?;
//! assert_eq!(picture.texels(), &Texels::Float(vec![[1.003_906_25, 1.003_906_25, 1.003_906_25, 1.0]]));
//! # Ok::<(), steradian_io::import::image::ImageError>(())
//! ```

mod hdr;
mod jpeg;
mod openexr;
mod png;

use steradian::material::{Bitmap, BitmapError, Texels};
use thiserror::Error;

/// What the integer codes of a picture stand for.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub enum Encoding {
    /// Light, by the sRGB transfer function.
    Srgb,
    /// Numbers from 0 to 1.
    Linear,
}

/// Why bytes are no picture.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ImageError {
    /// No known signature.
    #[error("expected a PNG, JPEG, OpenEXR or Radiance HDR picture")]
    Format,
    /// More texels than are read, or than so few bytes can hold.
    #[error("a picture of {width} x {height} in {bytes} bytes is too large")]
    TooLarge {
        /// Columns.
        width: u64,
        /// Rows.
        height: u64,
        /// Size of the file.
        bytes: usize,
    },
    /// Cut short, damaged, or not supported.
    #[error("not a readable {format} picture: {reason}")]
    Unreadable {
        /// The format by its signature.
        format: &'static str,
        /// What is wrong.
        reason: String,
    },
    /// Read, but not usable.
    #[error(transparent)]
    Bitmap(#[from] BitmapError),
}

/// Reads a picture; it repeats and is bilinear.
///
/// # Errors
/// If the bytes are no whole picture of a known format.
pub fn read(bytes: &[u8], encoding: Encoding) -> Result<Bitmap, ImageError> {
    let starts = |signature: &[u8]| bytes.starts_with(signature);
    if starts(b"\x89PNG\r\n\x1a\n") {
        png::read(bytes, encoding)
    } else if starts(b"\xff\xd8\xff") {
        jpeg::read(bytes, encoding)
    } else if starts(&[0x76, 0x2f, 0x31, 0x01]) {
        openexr::read(bytes)
    } else if starts(b"#?") {
        hdr::read(bytes)
    } else {
        Err(ImageError::Format)
    }
}

/// Larger pictures are refused: 16384 × 16384.
const MOST_TEXELS: u64 = 1 << 28;

/// No format packs more texels into a byte: of Deflate, 1032 bytes of eight grey texels.
const MOST_TEXELS_A_BYTE: u64 = 8256;

/// Refuses sizes that would need more memory than the file warrants.
fn check_size(width: u64, height: u64, bytes: &[u8]) -> Result<(), ImageError> {
    let most = (bytes.len() as u64 * MOST_TEXELS_A_BYTE).min(MOST_TEXELS);
    let fits = width.checked_mul(height).is_some_and(|count| count <= most);
    fits.then_some(()).ok_or(ImageError::TooLarge {
        width,
        height,
        bytes: bytes.len(),
    })
}

/// A picture of one to four channels of 8 bits: grey, grey and alpha, colour, colour and alpha.
fn of_bytes(
    [width, height]: [u32; 2],
    channels: usize,
    codes: &[u8],
    encoding: Encoding,
) -> Result<Bitmap, ImageError> {
    let texels = texels(channels, codes, u8::MAX, |code| *code);
    let texels = match encoding {
        Encoding::Srgb => Texels::Srgb8(texels),
        Encoding::Linear => Texels::Linear8(texels),
    };
    Ok(Bitmap::new(width, height, texels)?)
}

/// Four channels of each texel, from its `channels` elements.
fn texels<T, C: Copy>(
    channels: usize,
    elements: &[T],
    opaque: C,
    code: impl Fn(&T) -> C,
) -> Vec<[C; 4]> {
    let of = |texel: &[T]| match texel {
        [grey] => [code(grey), code(grey), code(grey), opaque],
        [grey, alpha] => [code(grey), code(grey), code(grey), code(alpha)],
        [red, green, blue] => [code(red), code(green), code(blue), opaque],
        [red, green, blue, alpha, ..] => [code(red), code(green), code(blue), code(alpha)],
        [] => [opaque; 4],
    };
    elements.chunks_exact(channels.max(1)).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn other_bytes_are_refused() {
        for bytes in [&b""[..], b"GIF89a", b"\x89PN"] {
            assert_eq!(read(bytes, Encoding::Srgb), Err(ImageError::Format));
        }
    }

    #[test]
    fn sizes_beyond_the_bytes_are_refused() {
        let text = b"#?RADIANCE\n\n-Y 100000 +X 100000\n";
        let message = read(text, Encoding::Linear).unwrap_err().to_string();
        assert!(message.contains("100000 x 100000"), "{message}");
    }

    /// A whole file of each kind.
    fn whole(kind: usize) -> Vec<u8> {
        use ::png::{BitDepth, ColorType};
        match kind {
            0 => jpeg::tests::BASELINE.to_vec(),
            1 => jpeg::tests::PROGRESSIVE.to_vec(),
            2 => png::tests::file(ColorType::Rgba, BitDepth::Eight, &[7; 8], None),
            _ => openexr::tests::file(&[("R", [1.0, 2.0]), ("G", [0.0; 2]), ("B", [0.5; 2])]),
        }
    }

    proptest! {
        #[test]
        fn damaged_pictures_are_read_or_refused(
            kind in 0_usize..4, changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..5),
        ) {
            let mut bytes = whole(kind);
            for (index, byte) in changes {
                let at = index.index(bytes.len());
                bytes[at] = byte;
            }
            if let Ok(bitmap) = read(&bytes, Encoding::Srgb) {
                prop_assert!(bitmap.size()[1] > 0);
            }
        }

        #[test]
        fn any_bytes_are_read_or_refused(
            signature in prop::sample::select(vec![
                &b"\x89PNG\r\n\x1a\n"[..], b"\xff\xd8\xff\xe0", &[0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0], b"#?RADIANCE\n\n-Y 2 +X 9\n",
            ]),
            rest in prop::collection::vec(any::<u8>(), 0..200),
        ) {
            let bytes = [signature, &rest].concat();
            if let Ok(bitmap) = read(&bytes, Encoding::Srgb) {
                prop_assert!(bitmap.size()[0] > 0);
            }
        }
    }
}
