//! A picture in false colours: one quantity by colour on a logarithmic scale, with a legend that states the unit.
//!
//! The scale begins and ends at round numbers (1, 2 or 5 · 10ⁿ): it ends at or above the largest value, and begins at or
//! below the first percentile but not more than four decades down, so that a lamp and the room it lights are both seen.
//! Values beyond the ends have the ends' colours. Colours are those of viridis, which order the same way in print and for
//! most colour-blind readers.

use super::glyphs;
use super::image::RadianceImage;
use super::png::Pixels;

const LOWEST_PERCENTILE: f64 = 0.01;
const MOST_DECADES: f64 = 1e4;
const STEPS: [f64; 3] = [1.0, 2.0, 5.0];
const BACKGROUND: [u8; 3] = [24; 3];
const INK: [u8; 3] = [235; 3];
/// Smallest height that a legend with its ticks fits into.
const LEGEND_HEIGHT: usize = 160;

/// A logarithmic scale between round numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    ticks: Vec<f64>,
}

impl Scale {
    /// The scale that suits these values; 0.1 to 1 where nothing is positive.
    pub fn of(values: &[f64]) -> Self {
        let mut sorted: Vec<f64> = values
            .iter()
            .copied()
            .filter(|value| *value > 0.0 && value.is_finite())
            .collect();
        sorted.sort_by(f64::total_cmp);
        let lowest = sorted
            .get((LOWEST_PERCENTILE * sorted.len() as f64) as usize)
            .copied()
            .unwrap_or(0.1);
        let largest = sorted.last().copied().unwrap_or(1.0);
        Self {
            ticks: round_numbers(lowest.max(largest / MOST_DECADES), largest),
        }
    }

    /// Both ends.
    pub fn ends(&self) -> [f64; 2] {
        [self.ticks[0], self.ticks[self.ticks.len() - 1]]
    }

    /// Where a value lies between the ends, 0 to 1.
    fn position(&self, value: f64) -> f64 {
        let [bottom, top] = self.ends();
        if value <= bottom {
            return 0.0;
        }
        (libm::log(value / bottom) / libm::log(top / bottom)).min(1.0)
    }

    /// The colour of a value.
    pub fn colour(&self, value: f64) -> [u8; 3] {
        colour_at(self.position(value))
    }
}

fn colour_at(position: f64) -> [u8; 3] {
    let colour = colorous::VIRIDIS.eval_continuous(position);
    [colour.r, colour.g, colour.b]
}

/// The numbers 1, 2 and 5 · 10ⁿ from at or below `low` to at or above `high`, at least two.
fn round_numbers(low: f64, high: f64) -> Vec<f64> {
    let first = libm::floor(libm::log10(low)) as i32 - 1;
    let last = libm::floor(libm::log10(high)) as i32 + 1;
    let all = (first..=last)
        .flat_map(|decade| STEPS.map(|step| step * libm::pow(10.0, f64::from(decade))));
    let all: Vec<f64> = all.collect();
    let below = |limit: f64| {
        all.iter()
            .rposition(|number| *number <= limit * (1.0 + 1e-12))
            .unwrap_or(0)
    };
    let end = all
        .iter()
        .position(|number| *number >= high * (1.0 - 1e-12))
        .unwrap_or(all.len() - 1);
    all[below(low).min(end - 1)..=end].to_vec()
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
        let labels: Vec<String> = scale.ticks.iter().copied().map(label).collect();
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
        let last = pixels.height - top - 8 * zoom - 1;
        glyphs::draw(pixels, &self.unit, (left, 6 * zoom), zoom, INK);
        for offset in 0..=last {
            let colour = colour_at((last - offset) as f64 / last as f64);
            (0..10 * zoom).for_each(|x| pixels.set(left + x, top + offset, colour));
        }
        for (tick, label) in scale.ticks.iter().zip(&self.labels) {
            let y = top + ((1.0 - scale.position(*tick)) * last as f64).round() as usize;
            (10 * zoom..13 * zoom).for_each(|x| pixels.set(left + x, y, INK));
            glyphs::draw(pixels, label, (left + 15 * zoom, y - 3 * zoom), zoom, INK);
        }
    }
}

/// A round number, short, without the noise of binary fractions.
fn label(value: f64) -> String {
    if (1e-3..1e5).contains(&value) {
        let text = format!("{value:.4}");
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    format!("{value:.0e}")
}

#[cfg(test)]
mod tests {
    use super::super::image::tests::picture;
    use super::*;

    fn assert_ends(values: &[f64], expected: [f64; 2]) {
        for (end, expected) in Scale::of(values).ends().iter().zip(expected) {
            assert!(
                (end / expected - 1.0).abs() < 1e-12,
                "{values:?}: {end} instead of {expected}"
            );
        }
    }

    #[test]
    fn scales_end_at_round_numbers() {
        assert_ends(&[0.3, 7.0], [0.2, 10.0]);
        assert_ends(&[1.0, 1.0], [0.5, 1.0]);
        assert_ends(&[3.0, 3.0], [2.0, 5.0]);
        assert_ends(&[0.0, 430.0, 1e-9], [0.02, 500.0]);
        assert_ends(&[0.0], [0.1, 1.0]);
    }

    #[test]
    fn colours_grow_lighter_along_the_scale() {
        let scale = Scale::of(&[1.0, 1000.0]);
        let lightness = |value: f64| {
            scale
                .colour(value)
                .iter()
                .map(|part| u32::from(*part))
                .sum::<u32>()
        };
        let values = [1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0];
        assert!(
            values
                .windows(2)
                .all(|pair| lightness(pair[0]) < lightness(pair[1]))
        );
        assert_eq!(
            (scale.colour(2000.0), scale.colour(0.0)),
            (scale.colour(1000.0), scale.colour(1.0))
        );
    }

    #[test]
    fn labels_are_short() {
        let labels = [0.2, 250.0, 1e5, 2e-4, 0.1 + 0.2].map(label);
        assert_eq!(labels, ["0.2", "250", "1e5", "2e-4", "0.3"]);
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
