//! A picture in false colours: one quantity by colour on a linear scale from zero, with a legend that states the unit.
//!
//! The scale ends at the round number (1, 2 or 5 · 10ⁿ) at or above the 99.5th percentile, so that a lamp in the picture
//! does not darken the room; what lies above has the end's colour. Colours are those of viridis, which order the same
//! way in print and for most colour-blind readers.

use super::glyphs;
use super::image::RadianceImage;
use super::png::Pixels;

const PERCENTILE: f64 = 0.995;
const TICKS: usize = 5;
const BACKGROUND: [u8; 3] = [24; 3];
const INK: [u8; 3] = [235; 3];
/// Smallest height that a legend with its ticks fits into.
const LEGEND_HEIGHT: usize = 90;

/// A linear scale from zero to a round number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    top: f64,
}

impl Scale {
    /// The scale that suits these values.
    pub fn of(values: &[f64]) -> Self {
        let mut sorted: Vec<f64> = values
            .iter()
            .copied()
            .filter(|value| value.is_finite())
            .collect();
        sorted.sort_by(f64::total_cmp);
        let at = (PERCENTILE * sorted.len().saturating_sub(1) as f64).ceil() as usize;
        Self {
            top: round_up(sorted.get(at).copied().unwrap_or(0.0)),
        }
    }

    /// The value at the end of the scale.
    pub fn top(&self) -> f64 {
        self.top
    }

    /// The colour of a value.
    pub fn colour(&self, value: f64) -> [u8; 3] {
        let colour = colorous::VIRIDIS.eval_continuous((value / self.top).clamp(0.0, 1.0));
        [colour.r, colour.g, colour.b]
    }
}

/// The least of 1, 2 and 5 · 10ⁿ that is at least `value`; 1 for nothing positive.
fn round_up(value: f64) -> f64 {
    if value <= 0.0 {
        return 1.0;
    }
    let decade = libm::pow(10.0, libm::floor(libm::log10(value)));
    let steps = [1.0, 2.0, 5.0, 10.0];
    let fitting = steps
        .into_iter()
        .map(|step| step * decade)
        .find(|top| *top >= value * (1.0 - 1e-12));
    fitting.unwrap_or(10.0 * decade)
}

/// The picture with its legend to the right.
pub fn draw(picture: &RadianceImage, scale: &Scale) -> Pixels {
    let legend = Legend::new(picture, scale);
    let height = picture.height.max(LEGEND_HEIGHT);
    let mut pixels = Pixels::filled(picture.width + legend.width, height, BACKGROUND);
    for (at, value) in picture.quantity().iter().enumerate() {
        pixels.set(at % picture.width, at / picture.width, scale.colour(*value));
    }
    legend.draw(&mut pixels, scale, picture.width);
    pixels
}

/// Texts and sizes of a legend.
struct Legend {
    zoom: usize,
    width: usize,
    unit: String,
    labels: Vec<String>,
}

impl Legend {
    fn new(picture: &RadianceImage, scale: &Scale) -> Self {
        let zoom = (picture.height / 300).max(1);
        let unit = picture.facts.quantity.unit.clone();
        let label = |tick: usize| label(scale.top * tick as f64 / TICKS as f64);
        let labels: Vec<String> = (0..=TICKS).map(label).collect();
        let widest = labels
            .iter()
            .map(|label| glyphs::width(label, zoom))
            .max()
            .unwrap_or(0);
        let width = (widest + 26 * zoom).max(glyphs::width(&unit, zoom) + 14 * zoom);
        Self {
            zoom,
            width,
            unit,
            labels,
        }
    }

    fn draw(&self, pixels: &mut Pixels, scale: &Scale, left: usize) {
        let zoom = self.zoom;
        let (left, top) = (left + 7 * zoom, 20 * zoom);
        let bar = pixels.height - top - 8 * zoom;
        glyphs::draw(pixels, &self.unit, (left, 6 * zoom), zoom, INK);
        for offset in 0..bar {
            let colour = scale.colour(scale.top * (bar - 1 - offset) as f64 / (bar - 1) as f64);
            (0..10 * zoom).for_each(|x| pixels.set(left + x, top + offset, colour));
        }
        for (tick, label) in self.labels.iter().enumerate() {
            let y = top + (bar - 1) * (TICKS - tick) / TICKS;
            (10 * zoom..13 * zoom).for_each(|x| pixels.set(left + x, y, INK));
            glyphs::draw(pixels, label, (left + 15 * zoom, y - 3 * zoom), zoom, INK);
        }
    }
}

/// A tick's number, short, without the noise of binary fractions.
fn label(value: f64) -> String {
    let rounded = |text: String| text.trim_end_matches('0').trim_end_matches('.').to_owned();
    match value {
        0.0 => "0".to_owned(),
        v if !(1e-3..1e5).contains(&v) => {
            let text = format!("{v:.1e}");
            text.replace(".0e", "e")
        }
        v => rounded(format!("{v:.4}")),
    }
}

#[cfg(test)]
mod tests {
    use super::super::image::tests::picture;
    use super::*;

    #[test]
    fn scales_end_at_round_numbers() {
        for (value, top) in [
            (0.7, 1.0),
            (1.0, 1.0),
            (1.2, 2.0),
            (430.0, 500.0),
            (0.0021, 0.005),
            (7e8, 1e9),
            (0.0, 1.0),
        ] {
            assert!((round_up(value) / top - 1.0).abs() < 1e-12, "{value}");
        }
    }

    #[test]
    fn a_lamp_does_not_set_the_scale() {
        let mut values = vec![3.0; 1000];
        values[7] = 1e6;
        assert_eq!(Scale::of(&values).top(), 5.0);
    }

    #[test]
    fn colours_grow_lighter_along_the_scale() {
        let scale = Scale { top: 10.0 };
        let lightness = |value: f64| {
            scale
                .colour(value)
                .iter()
                .map(|part| u32::from(*part))
                .sum::<u32>()
        };
        assert!((0..10).all(|step| lightness(f64::from(step)) < lightness(f64::from(step + 1))));
        assert_eq!(scale.colour(11.0), scale.colour(10.0));
    }

    #[test]
    fn labels_are_short() {
        let labels = [0.0, 0.4, 250.0, 1e5, 2.5e-4, 0.30000000000000004].map(label);
        assert_eq!(labels, ["0", "0.4", "250", "1e5", "2.5e-4", "0.3"]);
    }

    #[test]
    fn the_picture_is_left_of_the_legend() {
        let picture = picture(10, 400, &["total"]);
        let scale = Scale::of(&picture.quantity());
        let pixels = draw(&picture, &scale);
        assert_eq!(pixels.rgb[0], scale.colour(picture.quantity()[0]));
        assert!(pixels.rgb.contains(&INK));
    }
}
