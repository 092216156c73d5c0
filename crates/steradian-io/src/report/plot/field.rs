//! A quantity at places of a plane: what maps at true scale show, and the sheet they are drawn on.

use super::PlotError;
use super::axis::Axis;
use super::colour_bar::BAR_WIDTH;
use super::frame::{Frame, INK, LABEL_SIZE, TICK_SIZE, TITLE_SIZE, width_of};
use super::scale::{Scale, round_step};
use crate::report::svg::{Anchor, Stroke, Svg};

/// The most that a map takes of the sheet, in pixels.
const ROOM: [f64; 2] = [640.0, 520.0];
const LEFT: f64 = 76.0;
const TOP: f64 = 58.0;
const LINE: f64 = 18.0;
const BELOW: f64 = 60.0;
/// Least distance of ticks, in pixels.
const TICK_ROOM: f64 = 48.0;
/// Empty rim around places that are no grid, as a part of their extent.
const RIM: f64 = 0.12;
/// The shorter side of a map of such places, as a part of the longer, so that labels fit.
const LEAST_SIDE: f64 = 0.4;
/// A bar is at least so high, however flat the map.
const LEAST_BAR: f64 = 140.0;

/// How the places of a field lie side by side: cells of a parallelogram, row by row along its first edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// A corner, in metres.
    pub origin: [f64; 2],
    /// The edges that leave it, in metres.
    pub edges: [[f64; 2]; 2],
    /// Cells along each edge.
    pub count: [usize; 2],
}

impl Lattice {
    /// The point at these parts of both edges.
    pub fn at(&self, u: f64, v: f64) -> [f64; 2] {
        let [first, second] = self.edges;
        std::array::from_fn(|k| self.origin[k] + first[k] * u + second[k] * v)
    }

    /// The corners of a cell, in order of turning.
    pub(super) fn cell(&self, index: usize) -> [[f64; 2]; 4] {
        let [columns, rows] = self.count.map(|count| count as f64);
        let [i, j] = [index % self.count[0], index / self.count[0]].map(|part| part as f64);
        let corners = [[i, j], [i + 1.0, j], [i + 1.0, j + 1.0], [i, j + 1.0]];
        corners.map(|[u, v]| self.at(u / columns, v / rows))
    }

    /// The corners of the whole.
    pub(super) fn corners(&self) -> [[f64; 2]; 4] {
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[u, v]| self.at(u, v))
    }
}

/// A quantity at places of a plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Above the map.
    pub title: String,
    /// Lines below the title.
    pub notes: Vec<String>,
    /// What both axes show, with its unit.
    pub axes: [String; 2],
    /// The quantity.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// Where, in metres.
    pub places: Vec<[f64; 2]>,
    /// What was found there.
    pub values: Vec<f64>,
    /// Both ends of the interval of each value; equal where it is exact.
    pub intervals: Vec<[f64; 2]>,
    /// With which confidence an interval holds, in percent.
    pub percent: f64,
    /// How the places lie side by side, if they do.
    pub lattice: Option<Lattice>,
}

impl Field {
    pub(super) fn check(&self) -> Result<(), PlotError> {
        let count = self.places.len();
        if count == 0 {
            return Err(PlotError::Empty);
        }
        let cells = self.lattice.map_or(count, |l| l.count[0] * l.count[1]);
        for found in [self.values.len(), self.intervals.len(), cells] {
            if found != count {
                return Err(PlotError::Places { count, found });
            }
        }
        let places = self.places.iter().flatten();
        let intervals = self.intervals.iter().flatten();
        let mut all = places.chain(&self.values).chain(intervals);
        match all.find(|number| !number.is_finite()) {
            Some(&value) => Err(PlotError::NotFinite {
                place: self.quantity.clone(),
                value,
            }),
            None => Ok(()),
        }
    }

    /// The least and the greatest value.
    pub(super) fn ends(&self) -> [f64; 2] {
        [self.least(), self.greatest()].map(|index| self.values[index])
    }

    /// Number of the least value, the first of equals.
    pub(super) fn least(&self) -> usize {
        self.first(|a, b| a < b)
    }

    /// Number of the greatest value, the first of equals.
    pub(super) fn greatest(&self) -> usize {
        self.first(|a, b| a > b)
    }

    fn first(&self, beats: impl Fn(f64, f64) -> bool) -> usize {
        let values = &self.values;
        (0..values.len()).fold(0, |best, next| {
            if beats(values[next], values[best]) {
                next
            } else {
                best
            }
        })
    }

    /// The quantity with its unit, for legends.
    pub(super) fn legend(&self) -> String {
        format!("{} ({})", self.quantity, self.unit)
    }

    /// A value in few words: all digits before the point, and three in all where these are fewer.
    pub(super) fn words(&self, index: usize) -> String {
        let value = self.values[index];
        if value == 0.0 {
            return "0".to_owned();
        }
        let places = 2.0 - libm::log10(value.abs()).floor();
        let places = places.clamp(0.0, 6.0) as usize;
        format!("{value:.places$}").replace('-', "−")
    }

    /// Both ends of what is drawn, by axis.
    fn extent(&self) -> [[f64; 2]; 2] {
        let corners = self.lattice.iter().flat_map(Lattice::corners);
        let all: Vec<[f64; 2]> = self.places.iter().copied().chain(corners).collect();
        let ends = |axis: usize| {
            let along = all.iter().map(|place| place[axis]);
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
                [low.min(x), high.max(x)]
            })
        };
        let ends = [ends(0), ends(1)];
        if self.lattice.is_some() {
            return ends;
        }
        let width = |[low, high]: [f64; 2]| high - low;
        let widest = width(ends[0]).max(width(ends[1]));
        let widest = if widest > 0.0 { widest } else { 1.0 };
        ends.map(|[low, high]| {
            let rim = RIM * widest + (LEAST_SIDE * widest - (high - low)).max(0.0) / 2.0;
            [low - rim, high + rim]
        })
    }
}

/// A sheet with title, notes and axes, on which a metre is as long in all directions.
pub struct MapSheet {
    pub sheet: Svg,
    pub frame: Frame,
    extent: [[f64; 2]; 2],
}

impl MapSheet {
    /// The axes are in place; `key` pixels are left to the right of the map.
    pub fn new(field: &Field, key: f64) -> Self {
        let extent = field.extent();
        let [width, height] = extent.map(|[low, high]| high - low);
        let per_metre = (ROOM[0] / width).min(ROOM[1] / height);
        let frame = Frame {
            left: LEFT,
            top: TOP + LINE * field.notes.len() as f64,
            width: width * per_metre,
            height: height * per_metre,
        };
        let words = field.notes.iter().map(|note| width_of(note, TICK_SIZE));
        let words = words.fold(width_of(&field.title, TITLE_SIZE), f64::max);
        let right = (frame.right() + key).max(LEFT + words + 16.0);
        let bottom = frame.bottom().max(frame.top + LEAST_BAR) + BELOW;
        let mut map = Self {
            sheet: Svg::new(right, bottom),
            frame,
            extent,
        };
        map.head(field);
        map.axes(field, per_metre);
        map
    }

    fn head(&mut self, field: &Field) {
        let start = Anchor::Start;
        self.sheet
            .text([LEFT, 30.0], &field.title, TITLE_SIZE, start, INK);
        for (note, line) in field.notes.iter().zip(1..) {
            let at = [LEFT, 32.0 + LINE * f64::from(line)];
            self.sheet.text(at, note, TICK_SIZE, start, INK);
        }
    }

    fn axes(&mut self, field: &Field, per_metre: f64) {
        let step = round_step(TICK_ROOM / per_metre);
        let scale = |[low, high]: [f64; 2]| {
            let axis = Axis::new("", "").from_to(low, high);
            Scale::new(&axis.tick_every(step.min(high - low)), [low, high])
        };
        let [x, y] = self.extent.map(scale);
        let frame = self.frame;
        frame.horizontal_axis(&mut self.sheet, &x, &field.axes[0]);
        frame.vertical_axis(&mut self.sheet, &y, &field.axes[1]);
    }

    /// Where on the sheet a point lies.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let part = |axis: usize, at: f64| {
            let [low, high] = self.extent[axis];
            (at - low) / (high - low)
        };
        self.frame.place(part(0, x), part(1, y))
    }

    /// Many of them.
    pub fn places(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        points.iter().map(|point| self.place(*point)).collect()
    }

    /// Where a bar of colours stands to the right.
    pub fn bar(&self) -> Frame {
        Frame {
            left: self.frame.right() + 28.0,
            top: self.frame.top + 16.0,
            width: BAR_WIDTH,
            height: (self.frame.height - 16.0).max(LEAST_BAR - 16.0),
        }
    }

    /// A disc of a colour.
    pub fn point(&mut self, center: [f64; 2], fill: &str) {
        self.sheet
            .circle(center, 5.0, fill, Some(&Stroke::new(INK, 1.0)));
    }
}

/// Rectangles of words that are taken.
#[derive(Default)]
pub struct Taken(Vec<[f64; 4]>);

impl Taken {
    /// Takes the room of words whose middle stands at `at`, if it is free and inside the frame.
    pub fn take(&mut self, frame: &Frame, at: [f64; 2], words: &str, size: f64) -> bool {
        let half = [width_of(words, size) / 2.0 + 2.0, 0.6 * size];
        let middle = [at[0], at[1] - 0.35 * size];
        let room = [
            middle[0] - half[0],
            middle[1] - half[1],
            middle[0] + half[0],
            middle[1] + half[1],
        ];
        let inside = room[0] >= frame.left
            && room[1] >= frame.top
            && room[2] <= frame.right()
            && room[3] <= frame.bottom();
        let meets =
            |other: &[f64; 4]| (0..2).all(|k| room[k] < other[k + 2] && other[k] < room[k + 2]);
        let free = inside && !self.0.iter().any(meets);
        if free {
            self.0.push(room);
        }
        free
    }
}

/// Words for the size of a key to the right of a map.
pub fn key_width<'a>(words: impl IntoIterator<Item = &'a str>) -> f64 {
    let widths = words.into_iter().map(|words| width_of(words, TICK_SIZE));
    28.0 + widths.fold(0.0, f64::max) + 12.0
}

/// The size of words on a map.
pub const MAP_SIZE: f64 = TICK_SIZE;
/// The size of the marks of extremes.
pub const SMALL_SIZE: f64 = LABEL_SIZE - 4.0;
