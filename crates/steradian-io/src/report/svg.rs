//! Free drawings as SVG: lines, areas, circles and words in a plane whose second axis points downwards.
//!
//! ```
//! use steradian_io::report::svg::{Anchor, Stroke, Svg};
//! let mut drawing = Svg::new(100.0, 50.0);
//! drawing.line([10.0, 40.0], [90.0, 40.0], &Stroke::new("#444444", 1.5));
//! drawing.text([50.0, 20.0], "r < R", 12.0, Anchor::Middle, "#000000");
//! let text = drawing.finish();
//! assert!(text.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 100 50\""));
//! assert!(text.contains("r &lt; R"));
//! ```

use std::fmt::Write;

use super::error::ReportError;
use super::raster;

const FONTS: &str = "DejaVu Sans, Verdana, Liberation Sans, Arial, sans-serif";

/// How a line is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    pub(super) colour: String,
    pub(super) width: f64,
    pub(super) dashes: Option<[f64; 2]>,
}

impl Stroke {
    /// A line of a colour such as `#444444`, of a width in pixels.
    pub fn new(colour: &str, width: f64) -> Self {
        Self {
            colour: colour.to_owned(),
            width,
            dashes: None,
        }
    }

    /// The same in dashes, with gaps between them.
    pub fn dashed(mut self, dash: f64, gap: f64) -> Self {
        self.dashes = Some([dash, gap]);
        self
    }

    fn attributes(&self) -> String {
        let mut text = format!(
            r#"stroke="{}" stroke-width="{}""#,
            escaped(&self.colour),
            number(self.width)
        );
        if let Some([dash, gap]) = self.dashes {
            let _ = write!(
                text,
                r#" stroke-dasharray="{} {}""#,
                number(dash),
                number(gap)
            );
        }
        text
    }
}

/// Which part of a word stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
    /// Its right end.
    End,
}

impl Anchor {
    const fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// A drawing on white. What is drawn later covers what was drawn before.
#[derive(Clone, Debug, PartialEq)]
pub struct Svg {
    text: String,
    size: [f64; 2],
    marks: Vec<Mark>,
}

/// What was drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Mark {
    Line(Vec<[f64; 2]>, Stroke),
    Area {
        rings: Vec<Vec<[f64; 2]>>,
        fill: String,
        opacity: f64,
        stroke: Option<Stroke>,
    },
    Disc {
        center: [f64; 2],
        radius: f64,
        fill: String,
        stroke: Option<Stroke>,
    },
    Words {
        at: [f64; 2],
        words: String,
        size: f64,
        anchor: Anchor,
        colour: String,
        is_upward: bool,
    },
}

impl Svg {
    /// An empty sheet of this size in pixels.
    pub fn new(width: f64, height: f64) -> Self {
        let size = [width, height];
        let (width, height) = (number(width), number(height));
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             font-family=\"{FONTS}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
        );
        Self {
            text,
            size,
            marks: Vec::new(),
        }
    }

    /// Width and height in pixels.
    pub(super) const fn size(&self) -> [f64; 2] {
        self.size
    }

    /// What was drawn, in order.
    pub(super) fn marks(&self) -> &[Mark] {
        &self.marks
    }

    /// The sheet as a PNG of twice as many pixels. Words are set in a font of eight by eight dots.
    ///
    /// # Errors
    /// If there are too many pixels.
    pub fn to_png(&self) -> Result<Vec<u8>, ReportError> {
        raster::encode(self)
    }

    /// A straight line.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], stroke: &Stroke) {
        self.polyline(&[from, to], stroke);
    }

    /// A line through points.
    pub fn polyline(&mut self, points: &[[f64; 2]], stroke: &Stroke) {
        self.marks.push(Mark::Line(points.to_vec(), stroke.clone()));
        let _ = writeln!(
            self.text,
            r#"<polyline points="{}" fill="none" stroke-linejoin="round" {}/>"#,
            coordinates(points),
            stroke.attributes()
        );
    }

    /// An area inside one or more outlines; where they overlap, twice inside is outside. An opacity of 1 hides what is below.
    pub fn area(
        &mut self,
        outlines: &[Vec<[f64; 2]>],
        fill: &str,
        opacity: f64,
        stroke: Option<&Stroke>,
    ) {
        self.marks.push(Mark::Area {
            rings: outlines.to_vec(),
            fill: fill.to_owned(),
            opacity,
            stroke: stroke.cloned(),
        });
        let rings: Vec<String> = outlines
            .iter()
            .map(|ring| format!("M{}Z", coordinates(ring)))
            .collect();
        let _ = writeln!(
            self.text,
            r#"<path d="{}" fill="{}" fill-opacity="{}" fill-rule="evenodd" {}/>"#,
            rings.join(""),
            escaped(fill),
            number(opacity),
            stroke.map(Stroke::attributes).unwrap_or_default()
        );
    }

    /// A disc, filled, perhaps with a rim.
    pub fn circle(&mut self, center: [f64; 2], radius: f64, fill: &str, stroke: Option<&Stroke>) {
        self.marks.push(Mark::Disc {
            center,
            radius,
            fill: fill.to_owned(),
            stroke: stroke.cloned(),
        });
        let _ = writeln!(
            self.text,
            r#"<circle cx="{}" cy="{}" r="{}" fill="{}" {}/>"#,
            number(center[0]),
            number(center[1]),
            number(radius),
            escaped(fill),
            stroke.map(Stroke::attributes).unwrap_or_default()
        );
    }

    /// A line of words of a size in pixels, standing on `at`.
    pub fn text(&mut self, at: [f64; 2], words: &str, size: f64, anchor: Anchor, colour: &str) {
        self.mark_words(at, words, size, (anchor, false), colour);
        self.write_words(at, words, size, anchor, colour);
    }

    fn mark_words(
        &mut self,
        at: [f64; 2],
        words: &str,
        size: f64,
        (anchor, is_upward): (Anchor, bool),
        colour: &str,
    ) {
        self.marks.push(Mark::Words {
            at,
            words: words.to_owned(),
            size,
            anchor,
            colour: colour.to_owned(),
            is_upward,
        });
    }

    fn write_words(&mut self, at: [f64; 2], words: &str, size: f64, anchor: Anchor, colour: &str) {
        let _ = writeln!(
            self.text,
            r#"<text x="{}" y="{}" font-size="{}" text-anchor="{}" fill="{}">{}</text>"#,
            number(at[0]),
            number(at[1]),
            number(size),
            anchor.name(),
            escaped(colour),
            escaped(words)
        );
    }

    /// A line of words that runs upwards, its middle at `at`.
    pub fn upward_text(&mut self, at: [f64; 2], words: &str, size: f64, colour: &str) {
        self.turned_text(at, words, size, Anchor::Middle, colour);
    }

    /// A line of words that runs upwards and ends at `at`.
    pub fn hanging_text(&mut self, at: [f64; 2], words: &str, size: f64, colour: &str) {
        self.turned_text(at, words, size, Anchor::End, colour);
    }

    fn turned_text(&mut self, at: [f64; 2], words: &str, size: f64, anchor: Anchor, colour: &str) {
        self.mark_words(at, words, size, (anchor, true), colour);
        let [x, y] = at.map(number);
        let _ = writeln!(
            self.text,
            r#"<g transform="translate({x} {y}) rotate(-90)">"#
        );
        self.write_words([0.0, 0.0], words, size, anchor, colour);
        self.text.push_str("</g>\n");
    }

    /// The whole file.
    pub fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }
}

fn coordinates(points: &[[f64; 2]]) -> String {
    let pair = |&[x, y]: &[f64; 2]| format!("{},{}", number(x), number(y));
    points.iter().map(pair).collect::<Vec<_>>().join(" ")
}

/// A number to a hundredth, which is far less than a pixel.
fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}

/// Words that cannot leave their element or attribute. Characters that XML does not know become `�`.
pub(super) fn escaped(text: &str) -> String {
    let is_unknown = |c: char| {
        c.is_control() && !matches!(c, '\t' | '\n' | '\r') || matches!(c, '\u{fffe}' | '\u{ffff}')
    };
    text.replace(is_unknown, "\u{fffd}")
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let cases = [
            (0.0, "0"),
            (-0.001, "0"),
            (1.0, "1"),
            (12.3456, "12.35"),
            (100.0, "100"),
            (-0.5, "-0.5"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn words_cannot_leave_their_element() {
        let mut drawing = Svg::new(10.0, 10.0);
        drawing.text(
            [0.0, 0.0],
            "</text><script>&\0",
            5.0,
            Anchor::Start,
            "\"red",
        );
        let text = drawing.finish();
        assert!(text.contains("&lt;/text&gt;&lt;script&gt;&amp;�</text>"));
        assert!(text.contains("fill=\"&quot;red\""));
    }

    #[test]
    fn areas_have_holes_by_the_rule_of_even_and_odd() {
        let square = |half: f64| vec![[-half, -half], [half, -half], [half, half], [-half, half]];
        let mut drawing = Svg::new(10.0, 10.0);
        drawing.area(&[square(2.0), square(1.0)], "#ff0000", 0.5, None);
        let text = drawing.finish();
        assert!(text.contains("M-2,-2 2,-2 2,2 -2,2ZM-1,-1 1,-1 1,1 -1,1Z"));
        assert!(text.contains(r#"fill-rule="evenodd""#));
    }

    #[test]
    fn every_element_is_closed_and_written_in_order() {
        let mut drawing = Svg::new(10.0, 10.0);
        let stroke = Stroke::new("#000000", 1.0).dashed(2.0, 3.0);
        drawing.circle([5.0, 5.0], 2.0, "none", Some(&stroke));
        drawing.line([0.0, 0.0], [1.0, 1.0], &stroke);
        let text = drawing.finish();
        assert!(text.find("<circle").unwrap() < text.find("<polyline").unwrap());
        assert_eq!(text.matches(r#"stroke-dasharray="2 3""#).count(), 2);
        assert_eq!(text.matches('<').count(), text.matches('>').count());
        assert!(text.ends_with("</svg>\n"));
    }
}
