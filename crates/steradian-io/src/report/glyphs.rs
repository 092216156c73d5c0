//! The few characters that a legend needs, five pixels wide and seven high.

use super::png::Pixels;

/// Pixels from one character to the next.
pub const ADVANCE: usize = 6;
/// Pixels a line of text is high.
pub const HEIGHT: usize = 7;

/// Draws text with its top left corner at (x, y), each dot `zoom` pixels wide; unknown characters leave a gap.
pub fn draw(pixels: &mut Pixels, text: &str, (x, y): (usize, usize), zoom: usize, colour: [u8; 3]) {
    for (position, character) in text.chars().enumerate() {
        let left = x + position * ADVANCE * zoom;
        for (row, dots) in dots(character).iter().enumerate() {
            let lit = (0..5).filter(|column| dots & (16 >> column) != 0);
            for column in lit {
                fill(pixels, (left + column * zoom, y + row * zoom), zoom, colour);
            }
        }
    }
}

/// Width of a text in pixels.
pub fn width(text: &str, zoom: usize) -> usize {
    text.chars().count() * ADVANCE * zoom
}

fn fill(pixels: &mut Pixels, (x, y): (usize, usize), size: usize, colour: [u8; 3]) {
    for offset in 0..size * size {
        pixels.set(x + offset % size, y + offset / size, colour);
    }
}

/// Seven rows of five dots, the leftmost dot in bit 4.
#[rustfmt::skip]
fn dots(character: char) -> [u8; HEIGHT] {
    match character {
        '0' => [0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110],
        '1' => [0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110],
        '2' => [0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111],
        '3' => [0b11111, 0b00010, 0b00100, 0b00010, 0b00001, 0b10001, 0b01110],
        '4' => [0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010],
        '5' => [0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110],
        '6' => [0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110],
        '7' => [0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b01000, 0b01000],
        '8' => [0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110],
        '9' => [0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100],
        '.' => [0b00000, 0b00000, 0b00000, 0b00000, 0b00000, 0b01100, 0b01100],
        '-' => [0b00000, 0b00000, 0b00000, 0b11111, 0b00000, 0b00000, 0b00000],
        '/' => [0b00001, 0b00010, 0b00010, 0b00100, 0b01000, 0b01000, 0b10000],
        '(' => [0b00010, 0b00100, 0b01000, 0b01000, 0b01000, 0b00100, 0b00010],
        ')' => [0b01000, 0b00100, 0b00010, 0b00010, 0b00010, 0b00100, 0b01000],
        'W' => [0b10001, 0b10001, 0b10001, 0b10101, 0b10101, 0b11011, 0b10001],
        'c' => [0b00000, 0b00000, 0b01110, 0b10000, 0b10000, 0b10001, 0b01110],
        'd' => [0b00001, 0b00001, 0b01101, 0b10011, 0b10001, 0b10001, 0b01111],
        'e' => [0b00000, 0b00000, 0b01110, 0b10001, 0b11111, 0b10000, 0b01110],
        'l' => [0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110],
        'm' => [0b00000, 0b00000, 0b11010, 0b10101, 0b10101, 0b10101, 0b10101],
        'r' => [0b00000, 0b00000, 0b10110, 0b11001, 0b10000, 0b10000, 0b10000],
        's' => [0b00000, 0b00000, 0b01111, 0b10000, 0b01110, 0b00001, 0b11110],
        'x' => [0b00000, 0b00000, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001],
        _ => [0; HEIGHT],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_character_of_a_legend_has_its_own_shape() {
        let needed: Vec<char> = "0123456789.-e/()Wcdlmrsx".chars().collect();
        for (number, character) in needed.iter().enumerate() {
            assert_ne!(dots(*character), [0; HEIGHT], "{character}");
            assert!(
                needed[..number]
                    .iter()
                    .all(|other| dots(*other) != dots(*character)),
                "{character}"
            );
        }
    }

    #[test]
    fn a_zoomed_stroke_is_as_many_times_larger() {
        let lit = |zoom: usize| {
            let mut pixels = Pixels::filled(40, 40, [0; 3]);
            draw(&mut pixels, "5", (0, 0), zoom, [255; 3]);
            pixels
                .rgb
                .iter()
                .filter(|pixel| **pixel == [255; 3])
                .count()
        };
        assert_eq!(lit(3), 9 * lit(1));
    }
}
