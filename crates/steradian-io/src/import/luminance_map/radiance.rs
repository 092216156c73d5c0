//! Radiance's pictures, with the view that their header states.

use steradian::material::Texels;
use steradian::quantity::Angle;
use steradian::sensor::{Fisheye, Projection};

use super::{EFFICACY, LuminanceMap, LuminanceMapError, weighted};
use crate::import::image::{self, Encoding};
use steradian::spectrum::REC709_LUMINANCE;

/// Luminance of Radiance's primaries.
const PRIMARIES: [f64; 3] = [0.265, 0.670, 0.065];
/// By how much the angles of a pixel may differ across and down.
const SQUARE: f64 = 0.01;

pub(super) fn read(bytes: &[u8]) -> Result<LuminanceMap, LuminanceMapError> {
    let bitmap = image::read(bytes, Encoding::Linear)?;
    let size = bitmap.size();
    let Texels::Float(texels) = bitmap.texels() else {
        return Err(LuminanceMapError::Format);
    };
    let header = header(bytes);
    let is_ours = header
        .iter()
        .any(|line| line.starts_with("SOFTWARE=Steradian"));
    let weights = if is_ours { REC709_LUMINANCE } else { PRIMARIES };
    let luminance = |[r, g, b, _]: &[f32; 4]| EFFICACY * weighted([*r, *g, *b], weights);
    Ok(LuminanceMap {
        size,
        luminances: texels.iter().map(luminance).collect(),
        std_errors: None,
        projection: projection(&header, size)?,
    })
}

/// The lines of the header; lines that a tabulator moves in are of pictures that this one was made from.
fn header(bytes: &[u8]) -> Vec<String> {
    let end = bytes.windows(2).position(|pair| pair == b"\n\n");
    let text = String::from_utf8_lossy(&bytes[..end.unwrap_or(bytes.len())]).into_owned();
    text.lines().map(str::to_owned).collect()
}

/// What the options of all `VIEW=` lines together say, later ones over earlier ones.
fn projection(header: &[String], size: [u32; 2]) -> Result<Option<Projection>, LuminanceMapError> {
    let lines = header.iter().filter_map(|line| line.strip_prefix("VIEW="));
    let words: Vec<&str> = lines.flat_map(str::split_whitespace).collect();
    if words.is_empty() {
        return Ok(None);
    }
    let number = |name: &str, default: f64| {
        let at = words.iter().rposition(|word| *word == name);
        at.and_then(|at| words.get(at + 1)?.parse::<f64>().ok())
            .unwrap_or(default)
    };
    let [across, down] = ["-vh", "-vv"].map(|name| number(name, 45.0));
    let refuse = |what: &str| {
        Err(LuminanceMapError::Meaning(format!(
            "the view of the picture {what}"
        )))
    };
    if [number("-vs", 0.0), number("-vl", 0.0)] != [0.0; 2] {
        return refuse("is shifted (-vs, -vl), which is not supported");
    }
    let kind = words
        .iter()
        .rev()
        .find_map(|word| word.strip_prefix("-vt"))
        .unwrap_or("v");
    let mapping = match kind {
        "a" => Fisheye::Equidistant,
        "h" => Fisheye::Hemispherical,
        "v" => {
            let fov = Angle::from_degrees(across);
            return Ok(Some(Projection::Perspective { fov }));
        }
        other => return refuse(&format!("is -vt{other}; -vta, -vth and -vtv are supported")),
    };
    let [width, height] = size.map(f64::from);
    if (across / width - down / height).abs() > SQUARE * across / width {
        return refuse("has other angles across than down (-vh, -vv) for its size");
    }
    let fov = Angle::from_degrees(across.min(down));
    Ok(Some(Projection::Fisheye { mapping, fov }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(header: &str) -> Vec<u8> {
        let mut bytes = format!("#?RADIANCE\n{header}\n-Y 1 +X 2\n").into_bytes();
        bytes.extend([128, 128, 128, 129, 0, 128, 0, 129]);
        bytes
    }

    /// 128.5/256 · 2 = 1.0039, and half a step of green's neighbours.
    #[test]
    fn luminance_is_by_the_primaries_of_the_program() {
        let radiance = read(&picture("FORMAT=32-bit_rle_rgbe\n")).unwrap();
        let value = 1.003_906_25;
        assert!((radiance.luminances[0] - 179.0 * value).abs() < 1e-9);
        let ours = read(&picture("SOFTWARE=Steradian 0.1.0\n")).unwrap();
        assert!((ours.luminances[0] - 179.0 * value).abs() < 1e-9);
        assert!(ours.luminances[1] > radiance.luminances[1]);
        assert_eq!((ours.size, ours.projection), ([2, 1], None));
    }

    #[test]
    fn views_are_read_from_the_header() {
        let of = |view: &str| read(&picture(&format!("VIEW= {view}\n"))).map(|map| map.projection);
        let fisheye = |mapping, degrees| {
            let fov = Angle::from_degrees(degrees);
            Ok(Some(Projection::Fisheye { mapping, fov }))
        };
        assert_eq!(
            of("-vta -vp 1 2 3 -vh 180 -vv 90"),
            fisheye(Fisheye::Equidistant, 90.0)
        );
        assert_eq!(
            of("-vth -vh 160 -vv 80 -vs 0 -vl 0"),
            fisheye(Fisheye::Hemispherical, 80.0)
        );
        assert!(
            of("-vta -vh 180 -vv 180")
                .unwrap_err()
                .to_string()
                .contains("other angles")
        );
        assert!(of("-vtc").unwrap_err().to_string().contains("-vtc"));
        assert!(of("-vta -vh 180 -vv 90 -vs .5").is_err());
        assert!(matches!(
            of("-vtv -vh 60 -vv 30"),
            Ok(Some(Projection::Perspective { .. }))
        ));
        let copied = read(&picture("\tVIEW= -vtc\n")).unwrap();
        assert_eq!(copied.projection, None);
    }
}
