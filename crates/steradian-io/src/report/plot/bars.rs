//! Shares of sums as bars.

use super::PlotError;
use super::axis::Axis;
use super::frame::{Frame, INK, PAPER, TICK_SIZE, TITLE_SIZE, width_of};
use super::line_plot::COLOURS;
use super::scale::Scale;
use crate::report::numbers::significant;
use crate::report::svg::{Anchor, Stroke, Svg};

const WIDTH: f64 = 460.0;
const TOP: f64 = 56.0;
/// Height of a bar with its gap, and of the bar alone.
const PITCH: f64 = 26.0;
const BAR: f64 = 18.0;
const BELOW: f64 = 60.0;
const SWATCH: f64 = 12.0;
const EMPTY: &str = "#eeeeee";

/// A sum and what it is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// To its left.
    pub name: String,
    /// The parts, none of them negative.
    pub parts: Vec<f64>,
    /// The sum, with its unit, to its right.
    pub sum: String,
}

/// A bar for each sum, of equal length, divided in proportion to its parts. A sum of 0 has an empty bar.
///
/// ```
/// use steradian_io::report::plot::{Bar, ShareBars};
/// let bars = ShareBars {
///     title: "Desk".to_owned(),
///     parts: vec!["lamp".to_owned(), "window".to_owned()],
///     bars: vec![Bar { name: "illuminance".to_owned(), parts: vec![100.0, 300.0], sum: "400 lx".to_owned() }],
/// };
/// let drawing = bars.drawing()?.finish();
/// assert!(drawing.contains(">25 %<") && drawing.contains(">75 %<") && drawing.contains(">400 lx<"));
/// # Ok::<(), steradian_io::report::plot::PlotError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ShareBars {
    /// Above the bars.
    pub title: String,
    /// Names of the parts. The first seven have colours of their own.
    pub parts: Vec<String>,
    /// The bars, from above.
    pub bars: Vec<Bar>,
}

impl ShareBars {
    /// The drawing.
    ///
    /// # Errors
    /// If there are no bars, a bar has other parts than there are names, or a part is negative or not finite.
    pub fn drawing(&self) -> Result<Svg, PlotError> {
        self.check()?;
        let widest = |words: &mut dyn Iterator<Item = &str>| {
            words
                .map(|words| width_of(words, TICK_SIZE))
                .fold(0.0, f64::max)
        };
        let names = widest(&mut self.bars.iter().map(|bar| bar.name.as_str()));
        let sums = widest(&mut self.bars.iter().map(|bar| bar.sum.as_str()));
        let frame = Frame {
            left: names + 24.0,
            top: TOP + self.key_height(WIDTH),
            width: WIDTH,
            height: PITCH * self.bars.len() as f64,
        };
        let mut sheet = Svg::new(frame.right() + sums + 24.0, frame.bottom() + BELOW);
        let at = [frame.left, 30.0];
        sheet.text(at, &self.title, TITLE_SIZE, Anchor::Start, INK);
        self.key(&mut sheet, &frame);
        let share = Axis::new("", "").from_to(0.0, 100.0).tick_every(20.0);
        let scale = Scale::new(&share, [0.0, 100.0]);
        frame.horizontal_axis(&mut sheet, &scale, "share (%)");
        for (bar, line) in self.bars.iter().zip(0..) {
            let top = frame.top + PITCH * f64::from(line) + (PITCH - BAR) / 2.0;
            let row = Frame {
                top,
                height: BAR,
                ..frame
            };
            self.bar(&mut sheet, &row, bar);
        }
        Ok(sheet)
    }

    fn check(&self) -> Result<(), PlotError> {
        if self.bars.is_empty() || self.parts.is_empty() {
            return Err(PlotError::Empty);
        }
        for bar in &self.bars {
            let place = bar.name.clone();
            if bar.parts.len() != self.parts.len() {
                return Err(PlotError::Shape {
                    rows: self.bars.len(),
                    columns: self.parts.len(),
                    place,
                    found: bar.parts.len(),
                });
            }
            let fits = |value: &f64| value.is_finite() && *value >= 0.0;
            if let Some(&value) = bar.parts.iter().find(|value| !fits(value)) {
                return Err(PlotError::NoShare { place, value });
            }
        }
        Ok(())
    }

    fn bar(&self, sheet: &mut Svg, row: &Frame, bar: &Bar) {
        let middle = row.top + BAR / 2.0 + 4.0;
        let name = [row.left - 8.0, middle];
        sheet.text(name, &bar.name, TICK_SIZE, Anchor::End, INK);
        let sum = [row.right() + 8.0, middle];
        sheet.text(sum, &bar.sum, TICK_SIZE, Anchor::Start, INK);
        area(sheet, row, [0.0, 1.0], EMPTY);
        let whole: f64 = bar.parts.iter().sum();
        let mut from = 0.0;
        for (part, colour) in bar.parts.iter().zip(COLOURS.into_iter().cycle()) {
            if *part <= 0.0 {
                continue;
            }
            let to = from + part / whole;
            area(sheet, row, [from, to], colour);
            let words = percent(part / whole);
            if width_of(&words, TICK_SIZE) < (to - from) * row.width - 6.0 {
                let at = [row.left + row.width * (from + to) / 2.0, middle];
                sheet.text(at, &words, TICK_SIZE, Anchor::Middle, ink(colour));
            }
            from = to;
        }
    }

    /// Where each name of the key begins, and its line.
    fn key_places(&self, width: f64) -> Vec<(f64, u32)> {
        let (mut x, mut line) = (0.0, 0);
        let mut places = Vec::new();
        for name in &self.parts {
            let wide = SWATCH + 6.0 + width_of(name, TICK_SIZE) + 18.0;
            if x > 0.0 && x + wide > width {
                (x, line) = (0.0, line + 1);
            }
            places.push((x, line));
            x += wide;
        }
        places
    }

    fn key_height(&self, width: f64) -> f64 {
        let last = self.key_places(width).last().map_or(0, |place| place.1);
        20.0 * f64::from(last) + 10.0
    }

    fn key(&self, sheet: &mut Svg, frame: &Frame) {
        let places = self.key_places(frame.width);
        let coloured = self.parts.iter().zip(COLOURS.into_iter().cycle());
        for ((name, colour), (x, line)) in coloured.zip(places) {
            let swatch = Frame {
                left: frame.left + x,
                top: 42.0 + 20.0 * f64::from(line),
                width: SWATCH,
                height: SWATCH,
            };
            area(sheet, &swatch, [0.0, 1.0], colour);
            let at = [swatch.right() + 6.0, swatch.bottom() - 1.0];
            sheet.text(at, name, TICK_SIZE, Anchor::Start, INK);
        }
    }
}

fn area(sheet: &mut Svg, row: &Frame, [from, to]: [f64; 2], colour: &str) {
    let corners = [[from, 0.0], [to, 0.0], [to, 1.0], [from, 1.0]];
    let outline = corners.map(|[x, y]| row.place(x, y)).to_vec();
    let rim = Stroke::new(PAPER, 0.5);
    sheet.area(&[outline], colour, 1.0, Some(&rim));
}

/// A share in words: one decimal below a tenth.
fn percent(share: f64) -> String {
    let digits = if share < 0.1 { 2 } else { 3 };
    format!("{} %", significant((1000.0 * share).round() / 10.0, digits))
}

/// Dark words on the light ones of the colours.
fn ink(colour: &str) -> &'static str {
    match colour {
        "#56b4e9" | "#e69f00" | "#cc79a7" => INK,
        _ => PAPER,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bars(parts: &[f64]) -> ShareBars {
        ShareBars {
            title: "Test".to_owned(),
            parts: vec!["lamp".to_owned(), "sky & sun".to_owned()],
            bars: vec![Bar {
                name: "desk".to_owned(),
                parts: parts.to_vec(),
                sum: "4 lx".to_owned(),
            }],
        }
    }

    fn fills(svg: &str) -> Vec<&str> {
        svg.lines()
            .filter(|line| line.starts_with("<path"))
            .collect()
    }

    /// The bar begins after `desk` of 4 · .62 · 12 and 24 pixels, and is 460 wide.
    #[test]
    fn parts_are_as_long_as_their_share() {
        let svg = bars(&[1.0, 3.0]).drawing().unwrap().finish();
        let found = fills(&svg);
        let [left, edge, right] = [53.76, 53.76 + 115.0, 53.76 + 460.0];
        let of = |colour: &str, from: f64, to: f64| {
            found.iter().any(|path| {
                path.contains(colour)
                    && path.contains(&format!("M{from:.2},"))
                    && path.contains(&format!(" {to:.2},"))
            })
        };
        assert!(
            of(COLOURS[0], left, edge) && of(COLOURS[1], edge, right),
            "{svg}"
        );
        for words in [">25 %<", ">75 %<", ">4 lx<", ">sky &amp; sun<", ">desk<"] {
            assert!(svg.contains(words), "{words} is not in {svg}");
        }
    }

    #[test]
    fn nothing_has_an_empty_bar() {
        let svg = bars(&[0.0, 0.0]).drawing().unwrap().finish();
        assert!(svg.contains(EMPTY) && !svg.contains(">0 %<"), "{svg}");
    }

    #[test]
    fn what_has_no_share_is_refused() {
        for value in [-1.0, f64::NAN] {
            let refused = bars(&[value, 1.0]).drawing();
            assert!(matches!(refused, Err(PlotError::NoShare { .. })));
        }
        assert!(matches!(
            bars(&[1.0]).drawing(),
            Err(PlotError::Shape { .. })
        ));
        let none = ShareBars {
            bars: vec![],
            ..bars(&[])
        };
        assert_eq!(none.drawing(), Err(PlotError::Empty));
    }
}
