//! Portable float maps: `PF` or `Pf`, width and height, a scale whose sign tells the order of bytes, then rows from the bottom.

use std::path::Path;

use super::{EFFICACY, LuminanceMap, LuminanceMapError, weighted};
use crate::files::Files;
use crate::import::image::ImageError;
use crate::report::pfm::error_path;
use steradian::spectrum::REC709_LUMINANCE;

pub(super) fn read(
    path: &Path,
    bytes: &[u8],
    files: &dyn Files,
) -> Result<LuminanceMap, LuminanceMapError> {
    let (size, luminances) = decode(bytes)?;
    let errors = files.read(&error_path(path)).ok();
    let std_errors = match errors.map(|bytes| decode(&bytes)).transpose()? {
        Some((other, _)) if other != size => {
            let message = "the picture of errors beside it has another size";
            return Err(LuminanceMapError::Meaning(message.into()));
        }
        errors => errors.map(|(_, errors)| errors),
    };
    Ok(LuminanceMap {
        size,
        luminances,
        std_errors,
        projection: None,
    })
}

/// Size and luminances.
fn decode(bytes: &[u8]) -> Result<([u32; 2], Vec<f64>), LuminanceMapError> {
    let mut rest = bytes;
    let lanes = match word(&mut rest)? {
        "PF" => 3,
        "Pf" => 1,
        _ => return Err(unreadable("it does not begin with PF or Pf")),
    };
    let mut number = |what: &str| {
        let number = word(&mut rest)?.parse::<f64>();
        number.map_err(|_| unreadable(&format!("expected {what}")))
    };
    let [width, height] = [number("its width")?, number("its height")?].map(|side| side as usize);
    let scale = number("its scale")?;
    let most = rest.len() / (4 * lanes);
    if width == 0 || height == 0 || width.checked_mul(height).is_none_or(|count| count > most) {
        return Err(unreadable("its size does not fit its bytes"));
    }
    let float = |bytes: &[u8]| {
        let bytes = [bytes[0], bytes[1], bytes[2], bytes[3]];
        if scale < 0.0 {
            f32::from_le_bytes(bytes)
        } else {
            f32::from_be_bytes(bytes)
        }
    };
    let floats: Vec<f32> = rest[..4 * lanes * width * height]
        .chunks_exact(4)
        .map(float)
        .collect();
    let luminance = |pixel: &[f32]| match pixel {
        [r, g, b] => EFFICACY * weighted([*r, *g, *b], REC709_LUMINANCE),
        grey => EFFICACY * f64::from(grey[0]),
    };
    let rows = floats.chunks_exact(lanes * width).rev();
    let luminances = rows.flat_map(|row| row.chunks_exact(lanes).map(luminance));
    Ok(([width as u32, height as u32], luminances.collect()))
}

/// The next word of the header, and one blank after it.
fn word<'a>(rest: &mut &'a [u8]) -> Result<&'a str, LuminanceMapError> {
    let end = rest.iter().position(u8::is_ascii_whitespace);
    let end = end.ok_or_else(|| unreadable("its header has no end"))?;
    let word = str::from_utf8(&rest[..end]).map_err(|_| unreadable("its header is no text"))?;
    *rest = &rest[end + 1..];
    Ok(word)
}

fn unreadable(reason: &str) -> LuminanceMapError {
    let (format, reason) = ("PFM", reason.to_owned());
    ImageError::Unreadable { format, reason }.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::MemoryFiles;

    fn map(kind: &str, size: &str, floats: &[f32]) -> Vec<u8> {
        let mut bytes = format!("{kind}\n{size}\n-1.0\n").into_bytes();
        bytes.extend(floats.iter().flat_map(|float| float.to_le_bytes()));
        bytes
    }

    #[test]
    fn the_bottom_row_comes_first_and_errors_lie_beside() {
        let bytes = map("Pf", "2 2", &[3.0, 4.0, 1.0, 2.0]);
        let files = MemoryFiles::default().with("a.error.pfm", map("Pf", "2 2", &[0.5; 4]));
        let found = read(Path::new("a.pfm"), &bytes, &files).unwrap();
        assert_eq!(found.luminances, [179.0, 358.0, 537.0, 716.0]);
        assert_eq!(found.std_errors, Some(vec![89.5; 4]));
        let wrong = MemoryFiles::default().with("a.error.pfm", map("Pf", "1 2", &[0.5; 2]));
        assert!(read(Path::new("a.pfm"), &bytes, &wrong).is_err());
        let colour = map("PF", "1 1", &[1.0, 1.0, 1.0]);
        let found = read(Path::new("b.pfm"), &colour, &files).unwrap();
        assert!((found.luminances[0] - 179.0).abs() < 1e-9 && found.std_errors.is_none());
    }

    #[test]
    fn cut_files_are_refused() {
        let bytes = map("PF", "2 1", &[1.0; 6]);
        for length in 0..bytes.len() {
            assert!(decode(&bytes[..length]).is_err());
        }
        assert!(decode(&map("Pf", "9999999999 9999999999", &[1.0])).is_err());
    }
}
