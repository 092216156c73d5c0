//! Drawings as pixels.
//!
//! A line covers a pixel by the distance of its middle from the line, an area by the part of four by four points that lie inside
//! (odd crossings). Words are areas too: the dots of a font of eight by eight, stretched to the width that layouts reckon with.

use font8x8::{BASIC_FONTS, GREEK_FONTS, LATIN_FONTS, UnicodeFonts};

use super::error::ReportError;
use super::png::{Pixels, encode_with_texts};
use super::svg::{Anchor, Mark, Stroke, Svg};

/// Pixels of the picture for one of the sheet.
const ZOOM: f64 = 2.0;
/// Points across a pixel at which areas are looked at.
const POINTS: usize = 4;
/// Dots across and down a character.
const DOTS: usize = 8;
/// Width of a character for its size.
const ADVANCE: f64 = 0.62;
/// Height of a character for its size, and how far below the line it reaches.
const HEIGHT: f64 = 0.86;
const DESCENT: f64 = 0.11;

type Ring = Vec<[f64; 2]>;

/// The bytes of a PNG.
pub(super) fn encode(drawing: &Svg) -> Result<Vec<u8>, ReportError> {
    encode_with_texts::<0>(&pixels(drawing), [])
}

fn pixels(drawing: &Svg) -> Pixels {
    let [width, height] = drawing
        .size()
        .map(|side| (side * ZOOM).ceil().max(1.0) as usize);
    let mut sheet = Sheet {
        pixels: Pixels::filled(width, height, [255; 3]),
    };
    drawing.marks().iter().for_each(|mark| sheet.mark(mark));
    sheet.pixels
}

struct Sheet {
    pixels: Pixels,
}

impl Sheet {
    fn mark(&mut self, mark: &Mark) {
        match mark {
            Mark::Line(points, stroke) => self.line(points, stroke),
            Mark::Area {
                rings,
                fill,
                opacity,
                stroke,
            } => {
                self.fill(rings, fill, *opacity);
                for (ring, stroke) in rings.iter().zip(stroke.iter().cycle()) {
                    self.line(&closed(ring), stroke);
                }
            }
            Mark::Disc {
                center,
                radius,
                fill,
                stroke,
            } => {
                let ring = circle(*center, *radius);
                self.fill(std::slice::from_ref(&ring), fill, 1.0);
                stroke
                    .iter()
                    .for_each(|stroke| self.line(&closed(&ring), stroke));
            }
            Mark::Words {
                at,
                words,
                size,
                anchor,
                colour,
                is_upward,
            } => {
                let dots = dots(words, *size, *anchor);
                let placed = |[x, y]: [f64; 2]| match is_upward {
                    true => [at[0] + y, at[1] - x],
                    false => [at[0] + x, at[1] + y],
                };
                for dot in dots {
                    self.fill(&[dot.map(placed).to_vec()], colour, 1.0);
                }
            }
        }
    }

    fn line(&mut self, points: &[[f64; 2]], stroke: &Stroke) {
        let Some(colour) = colour(&stroke.colour) else {
            return;
        };
        let pieces = match stroke.dashes {
            Some([dash, gap]) => dashes(points, dash, gap),
            None => vec![points.to_vec()],
        };
        for piece in pieces {
            self.piece(&piece, 0.5 * ZOOM * stroke.width, colour);
        }
    }

    /// Every pixel once, by its distance to the nearest part of the line.
    fn piece(&mut self, points: &[[f64; 2]], half_width: f64, colour: [u8; 3]) {
        let points: Ring = points.iter().map(|point| point.map(|x| x * ZOOM)).collect();
        let Some(window) = self.window(&points, half_width + 1.0) else {
            return;
        };
        let [x0, y0, x1, y1] = window;
        let mut coverage = vec![0.0_f64; (x1 - x0) * (y1 - y0)];
        for edge in points.windows(2) {
            let Some([a0, b0, a1, b1]) = self.window(edge, half_width + 1.0) else {
                continue;
            };
            for (x, y) in (b0..b1).flat_map(|y| (a0..a1).map(move |x| (x, y))) {
                let away = distance([x as f64 + 0.5, y as f64 + 0.5], [edge[0], edge[1]]);
                let part = (half_width + 0.5 - away)
                    .clamp(0.0, 1.0)
                    .min(2.0 * half_width);
                let cell = &mut coverage[(y - y0) * (x1 - x0) + x - x0];
                *cell = cell.max(part);
            }
        }
        self.blend(window, &coverage, colour);
    }

    fn fill(&mut self, rings: &[Ring], fill: &str, opacity: f64) {
        let Some(colour) = colour(fill) else {
            return;
        };
        let rings: Vec<Ring> = rings
            .iter()
            .map(|ring| ring.iter().map(|point| point.map(|x| x * ZOOM)).collect())
            .collect();
        let Some(window) = self.window(&rings.concat(), 0.0) else {
            return;
        };
        let [x0, y0, x1, y1] = window;
        let mut coverage = vec![0.0; (x1 - x0) * (y1 - y0)];
        let share = opacity / (POINTS * POINTS) as f64;
        for line in 0..(y1 - y0) * POINTS {
            let y = y0 as f64 + (line as f64 + 0.5) / POINTS as f64;
            let crossings = crossings(&rings, y);
            for pair in crossings.chunks_exact(2) {
                let first =
                    |x: f64| ((x - x0 as f64) * POINTS as f64 - 0.5).ceil().max(0.0) as usize;
                let end = first(pair[1]).min((x1 - x0) * POINTS);
                for point in first(pair[0])..end {
                    coverage[line / POINTS * (x1 - x0) + point / POINTS] += share;
                }
            }
        }
        self.blend(window, &coverage, colour);
    }

    /// Columns and rows of the pixels around points: from the first to before the last.
    fn window(&self, points: &[[f64; 2]], margin: f64) -> Option<[usize; 4]> {
        let end = [self.pixels.width, self.pixels.height];
        let side = |axis: usize| {
            let along = points.iter().map(move |point| point[axis]);
            let low = along.clone().fold(f64::INFINITY, f64::min) - margin;
            let high = along.fold(f64::NEG_INFINITY, f64::max) + margin;
            [
                low.floor().max(0.0) as usize,
                (high.ceil().max(0.0) as usize).min(end[axis]),
            ]
        };
        let [[x0, x1], [y0, y1]] = [side(0), side(1)];
        (x0 < x1 && y0 < y1).then_some([x0, y0, x1, y1])
    }

    fn blend(&mut self, [x0, y0, x1, y1]: [usize; 4], coverage: &[f64], colour: [u8; 3]) {
        let places = (y0..y1).flat_map(|y| (x0..x1).map(move |x| (x, y)));
        for ((x, y), &part) in places.zip(coverage).filter(|(_, part)| **part > 0.0) {
            let pixel = &mut self.pixels.rgb[y * self.pixels.width + x];
            for (old, new) in pixel.iter_mut().zip(colour) {
                let mixed = f64::from(*old) * (1.0 - part) + f64::from(new) * part;
                *old = mixed.round() as u8;
            }
        }
    }
}

/// `#rrggbb`; `None` for `none`.
fn colour(text: &str) -> Option<[u8; 3]> {
    let code = u32::from_str_radix(text.strip_prefix('#')?, 16).ok()?;
    let [_, r, g, b] = code.to_be_bytes();
    Some([r, g, b])
}

fn closed(ring: &[[f64; 2]]) -> Ring {
    ring.iter().chain(ring.first()).copied().collect()
}

fn circle([x, y]: [f64; 2], radius: f64) -> Ring {
    let at = |k: u32| {
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(k) / 90.0);
        [x + radius * cos, y + radius * sin]
    };
    (0..90).map(at).collect()
}

fn distance(point: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let (along, to) = (
        [b[0] - a[0], b[1] - a[1]],
        [point[0] - a[0], point[1] - a[1]],
    );
    let squared = along[0] * along[0] + along[1] * along[1];
    let t = if squared > 0.0 {
        ((to[0] * along[0] + to[1] * along[1]) / squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    libm::hypot(to[0] - t * along[0], to[1] - t * along[1])
}

/// Where the outlines cross a horizontal line, from the left.
fn crossings(rings: &[Ring], y: f64) -> Vec<f64> {
    let mut found = Vec::new();
    for ring in rings {
        for edge in closed(ring).windows(2) {
            let [a, b] = [edge[0], edge[1]];
            if (a[1] <= y) != (b[1] <= y) {
                found.push(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
            }
        }
    }
    found.sort_by(f64::total_cmp);
    found
}

/// The dashes of a line.
fn dashes(points: &[[f64; 2]], dash: f64, gap: f64) -> Vec<Ring> {
    let mut pieces: Vec<Ring> = vec![points.iter().take(1).copied().collect()];
    let (mut is_dash, mut left) = (true, dash);
    for edge in points.windows(2) {
        let [mut from, to] = [edge[0], edge[1]];
        loop {
            let length = libm::hypot(to[0] - from[0], to[1] - from[1]);
            let step = left.min(length);
            let at = |k: usize| from[k] + (to[k] - from[k]) * step / length.max(f64::MIN_POSITIVE);
            let next = if step == length { to } else { [at(0), at(1)] };
            if let Some(piece) = pieces.last_mut().filter(|_| is_dash) {
                piece.push(next);
            }
            left -= step;
            from = next;
            if left > 0.0 {
                break;
            }
            is_dash = !is_dash;
            left = if is_dash { dash } else { gap };
            if is_dash {
                pieces.push(vec![next]);
            }
        }
    }
    pieces
}

/// The dots of a line of words around the origin, each as a rectangle.
fn dots(words: &str, size: f64, anchor: Anchor) -> Vec<[[f64; 2]; 4]> {
    let width = ADVANCE * size * words.chars().count() as f64;
    let start = match anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => -0.5 * width,
        Anchor::End => -width,
    };
    let [dx, dy] = [ADVANCE * size / DOTS as f64, HEIGHT * size / DOTS as f64];
    let top = DESCENT * size - HEIGHT * size;
    let mut found = Vec::new();
    for (index, character) in words.chars().enumerate() {
        let left = start + ADVANCE * size * index as f64;
        for (row, bits) in glyph(character).into_iter().enumerate() {
            let y = top + dy * row as f64;
            for column in (0..DOTS).filter(|column| bits >> column & 1 == 1) {
                let x = left + dx * column as f64;
                found.push([[x, y], [x + dx, y], [x + dx, y + dy], [x, y + dy]]);
            }
        }
    }
    found
}

/// Larger than the font's, which reads as an e.
const THETA: [u8; DOTS] = [0x1c, 0x36, 0x63, 0x7f, 0x63, 0x36, 0x1c, 0];

/// Rows of dots, the leftmost in bit 0; an unknown character is a gap.
fn glyph(character: char) -> [u8; DOTS] {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let of = |plain: char| {
        let fonts = BASIC_FONTS.get(plain).or_else(|| LATIN_FONTS.get(plain));
        fonts.or_else(|| GREEK_FONTS.get(plain)).unwrap_or_default()
    };
    if let Some(digit) = RAISED.iter().position(|raised| *raised == character) {
        return raised(of(char::from(b'0' + digit as u8)));
    }
    match character {
        'θ' => THETA,
        '−' | '–' => of('-'),
        '⁻' => raised(of('-')),
        '₀' => of('0'),
        '₂' => of('2'),
        other => of(other),
    }
}

/// Half as high.
fn raised(dots: [u8; DOTS]) -> [u8; DOTS] {
    std::array::from_fn(|row| {
        if row < DOTS / 2 {
            dots[2 * row] | dots[2 * row + 1]
        } else {
            0
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(draw: impl Fn(&mut Svg)) -> Pixels {
        let mut drawing = Svg::new(20.0, 10.0);
        draw(&mut drawing);
        pixels(&drawing)
    }

    /// What is not white, as a number of whole black pixels.
    fn ink(pixels: &Pixels) -> f64 {
        pixels
            .rgb
            .iter()
            .map(|pixel| f64::from(255 - pixel[0]) / 255.0)
            .sum()
    }

    #[test]
    fn areas_cover_as_many_pixels_as_they_are_large() {
        let triangle = vec![[1.0, 1.0], [9.0, 1.0], [1.0, 9.0]];
        let found =
            drawn(|sheet| sheet.area(std::slice::from_ref(&triangle), "#000000", 1.0, None));
        assert_eq!([found.width, found.height], [40, 20]);
        // Half of 8 × 8, four pixels each, and an eighth of a pixel at each of the sixteen steps of the long side.
        assert!((ink(&found) - 128.0).abs() < 3.0, "{}", ink(&found));
        let half = drawn(|sheet| sheet.area(std::slice::from_ref(&triangle), "#000000", 0.5, None));
        assert!((ink(&half) - 64.0).abs() < 1.5);
    }

    #[test]
    fn lines_are_as_wide_as_they_are_said_to_be() {
        let stroke = Stroke::new("#000000", 1.5);
        let whole = drawn(|sheet| sheet.line([2.0, 5.0], [18.0, 5.0], &stroke));
        // 16 × 1.5, with a round end on both sides.
        let expected = 4.0 * (16.0 * 1.5 + std::f64::consts::PI * 0.75 * 0.75);
        assert!((ink(&whole) - expected).abs() < 3.0, "{}", ink(&whole));
        let dashed =
            drawn(|sheet| sheet.line([2.0, 5.0], [18.0, 5.0], &stroke.clone().dashed(2.0, 6.0)));
        assert!(ink(&dashed) < 0.5 * ink(&whole));
    }

    #[test]
    fn words_stand_where_their_anchor_says() {
        let left = |anchor| {
            let found = drawn(|sheet| sheet.text([10.0, 8.0], "H", 8.0, anchor, "#000000"));
            let place = found.rgb.iter().position(|pixel| *pixel != [255; 3]);
            place.map(|place| place % found.width)
        };
        assert_eq!(left(Anchor::Start), Some(20));
        assert!(
            left(Anchor::End) < left(Anchor::Middle) && left(Anchor::Middle) < left(Anchor::Start)
        );
    }

    #[test]
    fn units_and_angles_have_their_letters() {
        for character in "ρθφω°²³¹₀·×±−1/srmW".chars() {
            assert_ne!(glyph(character), [0; DOTS], "{character}");
        }
    }
}
