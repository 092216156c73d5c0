//! A heat map as pixels: the matrix and its legend, without the names of rows and columns.

use super::colour_bar::rgb as colour;
use super::heat_map::HeatMap;
use super::scale::Scale;
use crate::report::glyphs;
use crate::report::png::{Pixels, encode_with_texts};

use super::PlotError;

/// Pixels that the longer side of the matrix has at least.
const SIDE: usize = 480;
const MARGIN: usize = 24;
const BAR_WIDTH: usize = 20;
/// Right of the bar, for its numbers.
const NUMBERS: usize = 96;
/// Each dot of a number.
const ZOOM: usize = 2;
const PAPER: [u8; 3] = [255; 3];
const INK: [u8; 3] = [51; 3];

/// The bytes of a PNG.
pub(super) fn encode(map: &HeatMap, scale: &Scale) -> Result<Vec<u8>, PlotError> {
    let pixels = draw(map, scale);
    let note = format!("{}. Colours: {}", map.title, map.legend);
    Ok(encode_with_texts(&pixels, [("Description", note)])?)
}

fn draw(map: &HeatMap, scale: &Scale) -> Pixels {
    let (rows, columns) = (map.rows.len(), map.columns.len());
    let cell = SIDE.div_ceil(rows.max(columns));
    let (width, height) = (cell * columns, cell * rows);
    let left = width + 2 * MARGIN;
    let sheet = [
        left + BAR_WIDTH + NUMBERS,
        height.max(SIDE / 2) + 2 * MARGIN,
    ];
    let mut pixels = Pixels::filled(sheet[0], sheet[1], PAPER);
    for at in 0..width * height {
        let (x, y) = (at % width, at / width);
        let value = map.values[y / cell][x / cell];
        pixels.set(MARGIN + x, MARGIN + y, colour(scale.position(value)));
    }
    bar(&mut pixels, scale, left, sheet[1] - 2 * MARGIN);
    pixels
}

fn bar(pixels: &mut Pixels, scale: &Scale, left: usize, height: usize) {
    for offset in 0..height {
        let colour = colour(1.0 - offset as f64 / (height - 1) as f64);
        (0..BAR_WIDTH).for_each(|x| pixels.set(left + x, MARGIN + offset, colour));
    }
    for (place, label) in scale.ticks() {
        let y = MARGIN + ((1.0 - place) * (height - 1) as f64).round() as usize;
        let right = left + BAR_WIDTH;
        (0..5).for_each(|x| pixels.set(right + x, y, INK));
        let top = y.saturating_sub(glyphs::HEIGHT * ZOOM / 2);
        glyphs::draw(
            pixels,
            &label.replace('−', "-"),
            (right + 10, top),
            ZOOM,
            INK,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::plot::Axis;

    #[test]
    fn cells_are_squares_of_their_colour_beside_a_legend() {
        let names = |count: usize| vec![String::new(); count];
        let map = HeatMap {
            title: "Test".to_owned(),
            legend: "F".to_owned(),
            rows: names(2),
            columns: names(3),
            values: vec![vec![0.0, 0.0, 1.0], vec![0.5, 0.0, 0.0]],
            with_numbers: false,
        };
        let scale = Scale::new(&Axis::new("", ""), [0.0, 1.0]);
        let pixels = draw(&map, &scale);
        let at = |x: usize, y: usize| pixels.rgb[(MARGIN + y) * pixels.width + MARGIN + x];
        assert_eq!((at(0, 0), at(479, 0)), (colour(0.0), colour(1.0)));
        assert_eq!((at(159, 160), at(160, 319)), (colour(0.5), colour(0.0)));
        assert!(pixels.rgb.contains(&INK));
        let bytes = encode(&map, &scale).unwrap();
        assert!(bytes.starts_with(b"\x89PNG"));
    }
}
