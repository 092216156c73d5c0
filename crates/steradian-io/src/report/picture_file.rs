//! A picture in the format that its file's name asks for.

use std::path::{Path, PathBuf};

use super::error::ReportError;
use super::image::RadianceImage;
use super::{exr, hdr, pfm, png};

/// The formats a picture can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// Every lane and error in 32-bit floats.
    Exr,
    /// Radiance's shared exponents.
    Hdr,
    /// 32-bit floats, errors in a file of their own.
    Pfm,
    /// Eight bits, to look at.
    Png,
}

/// How a PNG shows a picture; the other formats hold the numbers themselves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Look {
    /// False colours with a legend instead of a tone-mapped picture.
    pub false_colour: bool,
    /// Stops by which the tone-mapped picture is brighter than its middle grey asks for.
    pub stops: f64,
}

impl PictureFormat {
    /// The format that the ending of a name tells.
    ///
    /// # Errors
    /// If it tells none.
    pub fn of(path: &Path) -> Result<Self, ReportError> {
        let ending = path
            .extension()
            .and_then(|ending| ending.to_str())
            .map(str::to_lowercase);
        match ending.as_deref() {
            Some("exr") => Ok(Self::Exr),
            Some("hdr") => Ok(Self::Hdr),
            Some("pfm") => Ok(Self::Pfm),
            Some("png") => Ok(Self::Png),
            _ => Err(ReportError::UnknownFormat {
                path: path.to_owned(),
                expected: ".exr, .hdr, .pfm or .png",
            }),
        }
    }

    /// The files that hold the picture: one at `path`, and for PFM one with the errors beside it.
    ///
    /// # Errors
    /// If the format cannot hold the picture's lanes.
    pub fn encode(
        self,
        picture: &RadianceImage,
        look: Look,
        path: &Path,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>, ReportError> {
        let one = |bytes: Vec<u8>| vec![(path.to_owned(), bytes)];
        match self {
            Self::Exr => exr::encode(picture).map(one),
            Self::Hdr => hdr::encode(picture).map(one),
            Self::Png if look.false_colour => png::encode_false_colour(picture).map(one),
            Self::Png => png::encode_tone_mapped(picture, look.stops).map(one),
            Self::Pfm => {
                let errors = (pfm::error_path(path), pfm::encode_errors(picture)?);
                Ok(vec![(path.to_owned(), pfm::encode(picture)?), errors])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::image::tests::picture;
    use super::*;

    #[test]
    fn the_ending_tells_the_format() {
        assert_eq!(
            PictureFormat::of(Path::new("a.b/c.EXR")).unwrap(),
            PictureFormat::Exr
        );
        let message = PictureFormat::of(Path::new("c.jpeg"))
            .unwrap_err()
            .to_string();
        assert!(message.contains("c.jpeg") && message.contains(".exr"));
    }

    #[test]
    fn a_float_map_has_its_errors_beside_it() {
        let files = PictureFormat::Pfm
            .encode(
                &picture(2, 2, &["total"]),
                Look::default(),
                Path::new("x/a.pfm"),
            )
            .unwrap();
        let names: Vec<&Path> = files.iter().map(|(path, _)| path.as_path()).collect();
        assert_eq!(names, [Path::new("x/a.pfm"), Path::new("x/a.error.pfm")]);
    }
}
