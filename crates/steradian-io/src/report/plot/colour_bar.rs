//! Numbers as colours, and the bar that tells which is which.

use super::frame::{Frame, INK, PAPER, TICK_SIZE};
use super::scale::Scale;
use crate::report::svg::{Anchor, Stroke, Svg};

pub const BAR_WIDTH: f64 = 20.0;
const STEPS: u32 = 64;
/// From this place on a scale words on its colour are dark.
const LIGHT: f64 = 0.6;

/// The colour of a place between the ends of a scale, in viridis.
pub fn rgb(position: f64) -> [u8; 3] {
    let colour = colorous::VIRIDIS.eval_continuous(position.clamp(0.0, 1.0));
    [colour.r, colour.g, colour.b]
}

/// The same as `#rrggbb`.
pub fn colour(position: f64) -> String {
    let [r, g, b] = rgb(position);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The colour of words on the colour of a place.
pub fn ink(position: f64) -> &'static str {
    if position > LIGHT { INK } else { PAPER }
}

/// An area filled a quarter of a pixel beyond its edges, so that no seam shows.
pub fn fill(sheet: &mut Svg, outline: Vec<[f64; 2]>, colour: &str) {
    sheet.area(&[outline], colour, 1.0, Some(&Stroke::new(colour, 0.5)));
}

/// The colours of a scale in a frame, with its ticks to the right and what they show above.
pub fn draw(sheet: &mut Svg, bar: &Frame, scale: &Scale, legend: &str) {
    for step in 0..STEPS {
        let [low, high] = [step, step + 1].map(|step| f64::from(step) / f64::from(STEPS));
        let corners = [[0.0, low], [1.0, low], [1.0, high], [0.0, high]];
        let outline = corners.map(|[x, y]| bar.place(x, y)).to_vec();
        fill(sheet, outline, &colour((low + high) / 2.0));
    }
    bar.edges(sheet);
    for (place, label) in scale.ticks() {
        let [x, y] = bar.place(1.0, place);
        sheet.line([x, y], [x + 5.0, y], &Stroke::new(INK, 1.0));
        sheet.text([x + 9.0, y + 4.0], &label, TICK_SIZE, Anchor::Start, INK);
    }
    let above = [bar.left, bar.top - 10.0];
    sheet.text(above, legend, TICK_SIZE, Anchor::Start, INK);
}
