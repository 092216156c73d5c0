//! Radiance's picture format: red, green and blue with a shared exponent, run-length coded.
//!
//! A pixel is (r, g, b, e) with value (m + ½) / 256 · 2^(e − 128) for each mantissa m, so the largest lane of a pixel is
//! kept to better than 1 % and there is no room for errors; EXR has both. One lane is written as grey. Values are
//! W/(m² sr), and the header says so. Format after G. Ward, "Real Pixels", Graphics Gems II (1991).

use super::error::ReportError;
use super::image::RadianceImage;

/// The widths that Radiance's newer run-length code can hold.
const CODED_WIDTHS: std::ops::Range<usize> = 8..32768;

/// The bytes of an HDR file.
pub fn encode(picture: &RadianceImage) -> Result<Vec<u8>, ReportError> {
    let lanes = picture.one_or_three("HDR")?;
    let lane = |number: usize, at: usize| lanes[number.min(lanes.len() - 1)].values[at];
    let mut bytes = header(picture).into_bytes();
    for row in 0..picture.height {
        let pixels = row * picture.width..(row + 1) * picture.width;
        let coded: Vec<[u8; 4]> = pixels
            .map(|at| shared_exponent([lane(0, at), lane(1, at), lane(2, at)]))
            .collect();
        append_row(&mut bytes, &coded);
    }
    Ok(bytes)
}

fn header(picture: &RadianceImage) -> String {
    let facts = &picture.facts;
    format!(
        "#?RADIANCE\nSOFTWARE=Steradian {}\nUNIT={}\nSEED={}\nSCENE_HASH={}\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n",
        facts.version, facts.unit, facts.seed, facts.scene_hash, picture.height, picture.width
    )
}

/// The mantissas and the exponent of one pixel.
fn shared_exponent(lanes: [f32; 3]) -> [u8; 4] {
    let largest = lanes.into_iter().fold(0.0_f32, f32::max);
    if largest < 1e-32 {
        return [0; 4];
    }
    let (_, exponent) = libm::frexpf(largest);
    let mantissa = |lane: f32| libm::ldexpf(lane.max(0.0), 8 - exponent) as u8;
    let [r, g, b] = lanes.map(mantissa);
    [r, g, b, (exponent + 128) as u8]
}

fn append_row(bytes: &mut Vec<u8>, row: &[[u8; 4]]) {
    if !CODED_WIDTHS.contains(&row.len()) {
        bytes.extend(row.as_flattened());
        return;
    }
    bytes.extend([2, 2, (row.len() >> 8) as u8, row.len() as u8]);
    for component in 0..4 {
        let plane: Vec<u8> = row.iter().map(|pixel| pixel[component]).collect();
        append_runs(bytes, &plane);
    }
}

/// Runs of four and more equal bytes are a count above 128 and the byte; all else is a count up to 128 and the bytes.
fn append_runs(bytes: &mut Vec<u8>, mut plane: &[u8]) {
    while let Some(&first) = plane.first() {
        let run = run_length(plane);
        if run >= 4 {
            bytes.extend([128 + run as u8, first]);
            plane = &plane[run..];
        } else {
            let literal = literal_length(plane);
            bytes.push(literal as u8);
            bytes.extend(&plane[..literal]);
            plane = &plane[literal..];
        }
    }
}

fn run_length(plane: &[u8]) -> usize {
    plane
        .iter()
        .take(127)
        .take_while(|&&byte| byte == plane[0])
        .count()
}

fn literal_length(plane: &[u8]) -> usize {
    let until_run = (1..plane.len()).find(|&at| run_length(&plane[at..]) >= 4);
    until_run.unwrap_or(plane.len()).min(128)
}

#[cfg(test)]
mod tests {
    use super::super::image::tests::picture;
    use super::*;

    fn decode(bytes: &[u8], width: usize, height: usize) -> Vec<[f32; 3]> {
        let header_end = bytes.windows(4).position(|four| four == b"\n\n-Y").unwrap() + 2;
        let line = bytes[header_end..]
            .iter()
            .position(|&byte| byte == b'\n')
            .unwrap();
        let mut rest = &bytes[header_end + line + 1..];
        let mut pixels = Vec::new();
        for _ in 0..height {
            pixels.extend(decode_row(&mut rest, width));
        }
        assert!(rest.is_empty());
        pixels
    }

    fn decode_row(rest: &mut &[u8], width: usize) -> Vec<[f32; 3]> {
        if !CODED_WIDTHS.contains(&width) {
            let (row, after) = rest.split_at(4 * width);
            *rest = after;
            return row
                .chunks_exact(4)
                .map(|p| value([p[0], p[1], p[2], p[3]]))
                .collect();
        }
        assert_eq!(rest[..4], [2, 2, (width >> 8) as u8, width as u8]);
        *rest = &rest[4..];
        let planes: Vec<Vec<u8>> = (0..4).map(|_| decode_plane(rest, width)).collect();
        (0..width)
            .map(|at| value([planes[0][at], planes[1][at], planes[2][at], planes[3][at]]))
            .collect()
    }

    fn decode_plane(rest: &mut &[u8], width: usize) -> Vec<u8> {
        let mut plane = Vec::new();
        while plane.len() < width {
            let count = usize::from(rest[0]);
            if count > 128 {
                plane.extend(std::iter::repeat_n(rest[1], count - 128));
                *rest = &rest[2..];
            } else {
                plane.extend(&rest[1..=count]);
                *rest = &rest[count + 1..];
            }
        }
        plane
    }

    fn value([r, g, b, e]: [u8; 4]) -> [f32; 3] {
        let lane = |m: u8| {
            if e == 0 {
                0.0
            } else {
                libm::ldexpf(f32::from(m) + 0.5, i32::from(e) - 136)
            }
        };
        [lane(r), lane(g), lane(b)]
    }

    /// A mantissa step is 1/256 of a power of two above the largest lane, so at most 1/128 of that lane, and the
    /// reader's half step leaves half of it.
    fn assert_reads_back(width: usize, height: usize) {
        let picture = picture(width, height, &["red", "green", "blue"]);
        let pixels = decode(&encode(&picture).unwrap(), width, height);
        assert_eq!(pixels.len(), width * height);
        for (at, pixel) in pixels.iter().enumerate() {
            let largest = picture
                .channels
                .iter()
                .map(|channel| channel.values[at])
                .fold(0.0, f32::max);
            for (channel, lane) in picture.channels.iter().zip(pixel) {
                assert!(
                    (channel.values[at] - lane).abs() <= largest / 256.0 * 1.001,
                    "pixel {at}"
                );
            }
        }
    }

    #[test]
    fn narrow_and_wide_pictures_read_back() {
        assert_reads_back(5, 3);
        assert_reads_back(300, 2);
    }

    #[test]
    fn equal_pixels_are_coded_in_runs() {
        let mut picture = picture(1000, 1, &["total"]);
        picture.channels[0].values.fill(2.0);
        let bytes = encode(&picture).unwrap();
        assert!(bytes.len() < 300);
        assert!(
            decode(&bytes, 1000, 1)
                .iter()
                .all(|pixel| (pixel[0] - 2.0).abs() < 0.01)
        );
    }

    #[test]
    fn darkness_is_exactly_zero() {
        assert_eq!(value(shared_exponent([0.0; 3])), [0.0; 3]);
    }
}
