//! The sheet of a diagram: where the picture is on it, title, axes, ticks and grid.

use super::scale::Scale;
use crate::report::svg::{Anchor, Stroke, Svg};

pub const INK: &str = "#222222";
pub const PAPER: &str = "#ffffff";
pub const TITLE_SIZE: f64 = 17.0;
pub const LABEL_SIZE: f64 = 14.0;
pub const TICK_SIZE: f64 = 12.0;
const GRID: &str = "#dddddd";
const TICK_LENGTH: f64 = 5.0;

/// About how wide words are in the fonts named.
pub fn width_of(words: &str, size: f64) -> f64 {
    0.62 * size * words.chars().count() as f64
}

/// A rectangle of the sheet, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
}

impl Frame {
    /// The place of a point given by its parts of the width, from the left, and of the height, from below.
    pub fn place(&self, x: f64, y: f64) -> [f64; 2] {
        [
            self.left + x * self.width,
            self.top + (1.0 - y) * self.height,
        ]
    }

    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Words in the middle above the frame.
    pub fn title(&self, sheet: &mut Svg, title: &str) {
        let at = [self.left + self.width / 2.0, self.top - 16.0];
        sheet.text(at, title, TITLE_SIZE, Anchor::Middle, INK);
    }

    /// Ticks with labels and lines of the grid for an axis along the lower edge.
    pub fn horizontal_axis(&self, sheet: &mut Svg, scale: &Scale, label: &str) {
        for (place, text) in scale.ticks() {
            let [x, y] = self.place(place, 0.0);
            sheet.line([x, y], self.place(place, 1.0), &Stroke::new(GRID, 1.0));
            sheet.line([x, y], [x, y + TICK_LENGTH], &Stroke::new(INK, 1.0));
            sheet.text([x, y + 19.0], &text, TICK_SIZE, Anchor::Middle, INK);
        }
        let at = [self.left + self.width / 2.0, self.bottom() + 42.0];
        sheet.text(at, label, LABEL_SIZE, Anchor::Middle, INK);
    }

    /// The same for an axis along the left edge.
    pub fn vertical_axis(&self, sheet: &mut Svg, scale: &Scale, label: &str) {
        let mut widest: f64 = 0.0;
        for (place, text) in scale.ticks() {
            let [x, y] = self.place(0.0, place);
            sheet.line([x, y], self.place(1.0, place), &Stroke::new(GRID, 1.0));
            sheet.line([x - TICK_LENGTH, y], [x, y], &Stroke::new(INK, 1.0));
            sheet.text([x - 8.0, y + 4.0], &text, TICK_SIZE, Anchor::End, INK);
            widest = widest.max(width_of(&text, TICK_SIZE));
        }
        let at = [self.left - widest - 16.0, self.top + self.height / 2.0];
        sheet.upward_text(at, label, LABEL_SIZE, INK);
    }

    /// The edges.
    pub fn edges(&self, sheet: &mut Svg) {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
        sheet.polyline(
            &corners.map(|[x, y]| self.place(x, y)),
            &Stroke::new(INK, 1.0),
        );
    }
}
