//! Portable float map: one lane (`Pf`) or red, green and blue (`PF`), 32-bit little-endian floats, bottom row first.
//!
//! The format has no place for errors, so they are a picture of their own, by convention `NAME.error.pfm` beside
//! `NAME.pfm`. Values are W/(m² sr).

use std::path::{Path, PathBuf};

use super::error::ReportError;
use super::image::{Channel, RadianceImage};

/// The values as the bytes of a PFM file.
pub fn encode(picture: &RadianceImage) -> Result<Vec<u8>, ReportError> {
    encode_lanes(picture, |channel| &channel.values)
}

/// The standard errors as the bytes of a PFM file.
pub fn encode_errors(picture: &RadianceImage) -> Result<Vec<u8>, ReportError> {
    encode_lanes(picture, |channel| &channel.std_errors)
}

/// Where the standard errors of `path` go: `a.pfm` becomes `a.error.pfm`.
pub fn error_path(path: &Path) -> PathBuf {
    path.with_extension("error.pfm")
}

fn encode_lanes(
    picture: &RadianceImage,
    lane: fn(&Channel) -> &[f32],
) -> Result<Vec<u8>, ReportError> {
    let lanes: Vec<&[f32]> = picture.one_or_three("PFM")?.iter().map(lane).collect();
    let kind = if lanes.len() == 3 { "PF" } else { "Pf" };
    let mut bytes = format!("{kind}\n{} {}\n-1.0\n", picture.width, picture.height).into_bytes();
    for row in (0..picture.height).rev() {
        for at in row * picture.width..(row + 1) * picture.width {
            bytes.extend(lanes.iter().flat_map(|lane| lane[at].to_le_bytes()));
        }
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::super::image::tests::picture;
    use super::*;

    /// Lanes a pixel, width, height, and the floats in the order of the file.
    fn decode(bytes: &[u8]) -> (usize, usize, usize, Vec<f32>) {
        let header_end = bytes
            .iter()
            .enumerate()
            .filter(|(_, byte)| **byte == b'\n')
            .nth(2)
            .unwrap()
            .0
            + 1;
        let header = std::str::from_utf8(&bytes[..header_end]).unwrap();
        let words: Vec<&str> = header.split_whitespace().collect();
        assert_eq!(words[3], "-1.0");
        let floats = bytes[header_end..]
            .chunks_exact(4)
            .map(|four| f32::from_le_bytes(four.try_into().unwrap()));
        let lanes = if words[0] == "PF" { 3 } else { 1 };
        (
            lanes,
            words[1].parse().unwrap(),
            words[2].parse().unwrap(),
            floats.collect(),
        )
    }

    #[test]
    fn values_read_back_bottom_row_first() {
        let picture = picture(3, 2, &["red", "green", "blue"]);
        let (lanes, width, height, floats) = decode(&encode(&picture).unwrap());
        assert_eq!((lanes, width, height, floats.len()), (3, 3, 2, 18));
        let bottom_left = 3;
        let pixel: Vec<f32> = picture
            .channels
            .iter()
            .map(|channel| channel.values[bottom_left])
            .collect();
        assert_eq!(floats[..3], pixel);
        assert_eq!(floats[9], picture.channels[0].values[0]);
    }

    #[test]
    fn errors_read_back_from_their_own_picture() {
        let picture = picture(2, 1, &["total"]);
        let (lanes, _, _, floats) = decode(&encode_errors(&picture).unwrap());
        assert_eq!((lanes, floats), (1, picture.channels[0].std_errors.clone()));
        assert_eq!(
            error_path(Path::new("out/a.pfm")),
            Path::new("out/a.error.pfm")
        );
    }
}
