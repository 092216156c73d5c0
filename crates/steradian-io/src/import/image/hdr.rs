//! Radiance's picture format: red, green and blue with a shared exponent, plain or run-length coded.
//!
//! A pixel (r, g, b, e) with e > 0 is (m + ½)/256 · 2^(e − 128) for each mantissa m, divided by the product of the
//! header's `EXPOSURE`s; with e = 0 it is black. Rows run from the top left (`-Y h +X w`). After G. Ward, "Real Pixels",
//! Graphics Gems II (1991), and the run-length code of Radiance 2.

use steradian::material::{Bitmap, Texels};

use super::{ImageError, check_size};

/// The widths that the newer run-length code can hold.
const CODED_WIDTHS: std::ops::Range<usize> = 8..32768;

pub(super) fn read(bytes: &[u8]) -> Result<Bitmap, ImageError> {
    let mut rest = bytes;
    let exposure = exposure(&mut rest)?;
    let [width, height] = resolution(&mut rest)?;
    check_size(width, height, bytes)?;
    let mut texels = Vec::new();
    for _ in 0..height {
        let row = row(&mut rest, width as usize).ok_or_else(|| unreadable("it ends too early"))?;
        texels.extend(row.into_iter().map(|pixel| value(pixel, exposure)));
    }
    Ok(Bitmap::new(
        width as u32,
        height as u32,
        Texels::Float(texels),
    )?)
}

/// The next line without its end.
fn line<'a>(rest: &mut &'a [u8]) -> Result<&'a str, ImageError> {
    let end = rest.iter().position(|byte| *byte == b'\n');
    let end = end.ok_or_else(|| unreadable("its header has no end"))?;
    let line = &rest[..end];
    *rest = &rest[end + 1..];
    str::from_utf8(line)
        .map(str::trim)
        .map_err(|_| unreadable("its header is no text"))
}

/// Reads the lines up to the empty one.
fn exposure(rest: &mut &[u8]) -> Result<f64, ImageError> {
    let mut exposure = 1.0;
    loop {
        let line = line(rest)?;
        match line.split_once('=') {
            _ if line.is_empty() => return Ok(exposure),
            Some(("EXPOSURE", factor)) => exposure *= positive(factor)?,
            Some(("FORMAT", format)) if format.trim() != "32-bit_rle_rgbe" => {
                return Err(unreadable(format!("the format {format} is not supported")));
            }
            _ => {}
        }
    }
}

fn positive(factor: &str) -> Result<f64, ImageError> {
    let parsed = factor.trim().parse().ok();
    parsed
        .filter(|factor: &f64| *factor > 0.0 && factor.is_finite())
        .ok_or_else(|| unreadable(format!("its exposure is {factor}")))
}

/// Width and height.
fn resolution(rest: &mut &[u8]) -> Result<[u64; 2], ImageError> {
    let line = line(rest)?;
    let words: Vec<&str> = line.split_whitespace().collect();
    let ["-Y", height, "+X", width] = words[..] else {
        return Err(unreadable(format!(
            "expected \"-Y height +X width\", found {line:?}"
        )));
    };
    match (width.parse::<u32>(), height.parse::<u32>()) {
        (Ok(width), Ok(height)) => Ok([width.into(), height.into()]),
        _ => Err(unreadable(format!("its size is {width} x {height}"))),
    }
}

/// The pixels of a row; `None` at the end of the file.
fn row(rest: &mut &[u8], width: usize) -> Option<Vec<[u8; 4]>> {
    let coded = CODED_WIDTHS.contains(&width) && rest.starts_with(&[2, 2]);
    if !coded || usize::from(*rest.get(2)?) << 8 | usize::from(*rest.get(3)?) != width {
        return plain(rest, width);
    }
    *rest = &rest[4..];
    let mut pixels = vec![[0; 4]; width];
    for component in 0..4 {
        let mut at = 0;
        while at < width {
            let (count, run) = run(rest)?;
            for pixel in pixels.get_mut(at..at + count)? {
                pixel[component] = match run {
                    Some(byte) => byte,
                    None => take(rest)?,
                };
            }
            at += count;
        }
    }
    Some(pixels)
}

/// Length of the next run and its byte; none where the bytes follow one by one.
fn run(rest: &mut &[u8]) -> Option<(usize, Option<u8>)> {
    match take(rest)? {
        0 => None,
        count @ 1..=128 => Some((count.into(), None)),
        count => Some((usize::from(count - 128), Some(take(rest)?))),
    }
}

fn take(rest: &mut &[u8]) -> Option<u8> {
    let (first, after) = rest.split_first()?;
    *rest = after;
    Some(*first)
}

/// Pixels one by one; (1, 1, 1, n) repeats the last one n times, and more with a place value of 256 directly after.
fn plain(rest: &mut &[u8], width: usize) -> Option<Vec<[u8; 4]>> {
    let mut pixels: Vec<[u8; 4]> = Vec::new();
    let mut shift = 0;
    while pixels.len() < width {
        let (&pixel, after) = rest.split_first_chunk::<4>()?;
        *rest = after;
        if pixel[..3] != [1, 1, 1] {
            pixels.push(pixel);
            shift = 0;
            continue;
        }
        let count = usize::from(pixel[3]).checked_shl(shift)?;
        let last = *pixels.last()?;
        if count > width - pixels.len() {
            return None;
        }
        pixels.extend(std::iter::repeat_n(last, count));
        shift += 8;
    }
    Some(pixels)
}

fn value([r, g, b, e]: [u8; 4], exposure: f64) -> [f32; 4] {
    if e == 0 {
        return [0.0, 0.0, 0.0, 1.0];
    }
    let unit = libm::ldexp(1.0 / exposure, i32::from(e) - 136);
    let [r, g, b] = [r, g, b].map(|mantissa| ((f64::from(mantissa) + 0.5) * unit) as f32);
    [r, g, b, 1.0]
}

fn unreadable(reason: impl Into<String>) -> ImageError {
    ImageError::Unreadable {
        format: "Radiance HDR",
        reason: reason.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floats(bytes: &[u8]) -> Vec<[f32; 4]> {
        match read(bytes).unwrap().texels() {
            Texels::Float(texels) => texels.clone(),
            other => panic!("{other:?}"),
        }
    }

    /// Nine pixels of exponent 129: reds 0 to 8 one by one, greens a run of 16, blues 1.
    fn coded() -> Vec<u8> {
        let header = b"#?RADIANCE\nEXPOSURE=2\nEXPOSURE=0.5\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 9\n";
        let row = [
            &[2, 2, 0, 9, 9, 0, 1, 2, 3, 4, 5, 6, 7, 8][..],
            &[128 + 9, 16, 128 + 9, 1, 128 + 5, 129, 4, 129, 129, 129, 129],
        ];
        [&header[..], row[0], row[1]].concat()
    }

    #[test]
    fn runs_are_unrolled() {
        let texels = floats(&coded());
        // (m + ½)/128 for m = 8, 16, 1.
        assert_eq!(texels.len(), 9);
        assert_eq!(texels[8], [8.5 / 128.0, 16.5 / 128.0, 1.5 / 128.0, 1.0]);
    }

    #[test]
    fn old_runs_repeat_the_last_pixel() {
        let header = b"#?RGBE\n\n-Y 1 +X 5\n";
        let pixels = [[9, 9, 9, 136], [1, 1, 1, 3], [0, 0, 0, 0]];
        let texels = floats(&[&header[..], pixels.as_flattened()].concat());
        assert_eq!(texels[..4], [[9.5, 9.5, 9.5, 1.0]; 4]);
        assert_eq!(texels[4], [0.0, 0.0, 0.0, 1.0]);
    }

    #[test]
    fn exposures_are_divided_out() {
        let header = b"#?RGBE\nEXPOSURE=2\n\n-Y 1 +X 1\n";
        let texels = floats(&[&header[..], &[8, 8, 8, 136]].concat());
        assert_eq!(texels[0][0], 4.25);
    }

    #[test]
    fn a_file_cut_short_or_unsupported_is_refused() {
        let bytes = coded();
        for end in 0..bytes.len() {
            assert!(read(&bytes[..end]).is_err(), "{end}");
        }
        for text in [
            "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n0000",
            "#?RADIANCE\n\n+Y 1 +X 1\n0000",
            "#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\n0000",
        ] {
            assert!(read(text.as_bytes()).is_err(), "{text}");
        }
    }
}
