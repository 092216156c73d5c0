//! Lines of equal values over a field, with the bands in which they may lie.

use super::PlotError;
use super::axis::Axis;
use super::colour_bar::colour;
use super::contour::{self, Points};
use super::field::{Field, Lattice, MAP_SIZE, MapSheet, SMALL_SIZE, Taken, key_width};
use super::frame::{INK, PAPER, TICK_SIZE, width_of};
use super::scale::Scale;
use crate::report::numbers::significant;
use crate::report::svg::{Anchor, Stroke, Svg};

const BAND_OPACITY: f64 = 0.28;
/// The darker part of viridis, which is seen on white.
const DARK: f64 = 0.8;
/// Parts of a line's length where its label may stand, the best first.
const ANCHORS: [f64; 7] = [0.5, 0.35, 0.65, 0.2, 0.8, 0.1, 0.9];
/// Lines shorter than this, in pixels, have no label.
const SHORT: f64 = 40.0;
/// Fewer levels than this are halved.
const FEW: usize = 5;
const GREY: &str = "#999999";
const SWATCH: f64 = 26.0;

/// A field as lines of equal values, at true scale. Around each line is shaded where it may lie: where the interval of the
/// value holds the level.
///
/// Between points values are interpolated, and so are the ends of their intervals; beyond the outermost points nothing is
/// drawn. Intervals are those of single points. Errors that are independent partly cancel when values are interpolated, so
/// that between points a band is rather too wide.
#[derive(Clone, Copy, Debug)]
pub struct Isolines<'a> {
    /// What is shown; its places must be a grid of at least 2 by 2.
    pub field: &'a Field,
    /// The values that have lines; round ones if there are none.
    pub levels: &'a [f64],
}

impl Isolines<'_> {
    /// The drawing.
    ///
    /// # Errors
    /// If there are no places, they are no grid, a number is not finite, or lists do not fit.
    pub fn drawing(&self) -> Result<Svg, PlotError> {
        self.field.check()?;
        let lattice = self.field.lattice.ok_or(PlotError::NoGrid)?;
        if lattice.count.iter().any(|count| *count < 2) {
            return Err(PlotError::NoGrid);
        }
        let levels = self.levels();
        let key = self.key();
        let width = key_width(key.iter().map(String::as_str)) + SWATCH + 8.0;
        let mut map = MapSheet::new(self.field, width);
        let outline = map.places(&lattice.corners());
        let rim = Stroke::new(GREY, 1.0);
        map.sheet.area(&[outline], "none", 1.0, Some(&rim));
        let points = between(&lattice);
        for (level, colour) in &levels {
            self.band(&mut map, &points, *level, colour);
        }
        self.dots(&mut map);
        let mut labels = Labels::default();
        self.extremes(&mut map, &mut labels);
        for (level, colour) in &levels {
            self.lines(&mut map, &points, (*level, colour), &mut labels);
        }
        labels.write(&mut map);
        self.legend(&mut map, &key);
        Ok(map.sheet)
    }

    /// The levels with their colours.
    fn levels(&self) -> Vec<(f64, String)> {
        let ends = self.field.ends();
        let round = Scale::new(&Axis::new("", ""), ends);
        let levels = match self.levels {
            [] => round_levels(round.tick_values(), ends),
            given => given.to_vec(),
        };
        let colour = |level: f64| colour(DARK * round.position(level).clamp(0.0, 1.0));
        let coloured = |level| (level, colour(level));
        levels.into_iter().map(coloured).collect()
    }

    /// Lines of the key.
    fn key(&self) -> Vec<String> {
        let percent = significant(self.field.percent, 3);
        let is_exact = self.field.intervals.iter().all(|[low, high]| low == high);
        let band = if is_exact {
            "values are exact".to_owned()
        } else {
            format!("{percent} %: the line lies here")
        };
        let mut key = vec![self.field.legend(), band, "calculation point".to_owned()];
        let [low, high] = self.field.ends();
        let beyond = self
            .levels
            .iter()
            .filter(|level| **level < low || high < **level);
        let beyond: Vec<String> = beyond.map(|level| significant(*level, 6)).collect();
        if !beyond.is_empty() {
            key.push(format!("not reached: {}", beyond.join(", ")));
        }
        key
    }

    fn band(&self, map: &mut MapSheet, points: &Points, level: f64, colour: &str) {
        let ends = |end: usize| -> Vec<f64> {
            let intervals = self.field.intervals.iter();
            intervals.map(|interval| interval[end]).collect()
        };
        let rings = contour::band(points, [&ends(0), &ends(1)], level);
        let rings: Vec<_> = rings.iter().map(|ring| map.places(ring)).collect();
        if !rings.is_empty() {
            map.sheet.area(&rings, colour, BAND_OPACITY, None);
        }
    }

    fn lines(
        &self,
        map: &mut MapSheet,
        points: &Points,
        (level, colour): (f64, &str),
        labels: &mut Labels,
    ) {
        for line in contour::lines(points, &self.field.values, level) {
            let line = map.places(&line);
            map.sheet.polyline(&line, &Stroke::new(colour, 1.8));
            let length = length(&line);
            if length < SHORT {
                continue;
            }
            let places = ANCHORS.map(|part| along(&line, part * length));
            labels.place(map, &places, &significant(level, 6), (MAP_SIZE, colour));
        }
    }

    fn dots(&self, map: &mut MapSheet) {
        for place in map.places(&self.field.places) {
            map.sheet.circle(place, 1.2, GREY, None);
        }
    }

    /// The least and the greatest value, where they were found.
    fn extremes(&self, map: &mut MapSheet, labels: &mut Labels) {
        let field = self.field;
        let (least, greatest) = (field.least(), field.greatest());
        if least == greatest {
            return;
        }
        for (name, index) in [("min", least), ("max", greatest)] {
            let [x, y] = map.place(field.places[index]);
            cross(map, [x, y]);
            let words = format!("{name} {}", field.words(index));
            let half = words.chars().count() as f64 * 0.31 * SMALL_SIZE + 8.0;
            let places = [[x, y - 12.0], [x, y + 12.0], [x + half, y], [x - half, y]];
            labels.place(map, &places, &words, (SMALL_SIZE, INK));
        }
    }

    fn legend(&self, map: &mut MapSheet, key: &[String]) {
        let left = map.frame.right() + 28.0;
        let line = |number: usize| map.frame.top + 12.0 + 22.0 * number as f64;
        let middle = [left + SWATCH / 2.0, line(1) - 4.0];
        let colour = colour(DARK / 2.0);
        let band = [[0.0, -7.0], [SWATCH, -7.0], [SWATCH, 7.0], [0.0, 7.0]];
        let band = band.map(|[x, y]| [left + x, middle[1] + y]).to_vec();
        map.sheet.area(&[band], &colour, BAND_OPACITY, None);
        let ends = [[left, middle[1]], [left + SWATCH, middle[1]]];
        map.sheet.line(ends[0], ends[1], &Stroke::new(&colour, 1.8));
        let dot = [middle[0], line(2) - 4.0];
        map.sheet.circle(dot, 1.2, GREY, None);
        for (words, number) in key.iter().zip(0..) {
            let indent = if number == 0 { 0.0 } else { SWATCH + 8.0 };
            let at = [left + indent, line(number)];
            map.sheet.text(at, words, TICK_SIZE, Anchor::Start, INK);
        }
    }
}

/// Words on a map, which stand where nothing else does and hide what is below.
#[derive(Default)]
struct Labels {
    taken: Taken,
    placed: Vec<([f64; 2], String, f64, String)>,
}

impl Labels {
    /// Puts words with their middle at the first of these places that is free, if one is.
    fn place(
        &mut self,
        map: &MapSheet,
        places: &[[f64; 2]],
        words: &str,
        (size, colour): (f64, &str),
    ) {
        for &[x, y] in places {
            let at = [x, y + 0.35 * size];
            if self.taken.take(&map.frame, at, words, size) {
                let label = (at, words.to_owned(), size, colour.to_owned());
                self.placed.push(label);
                return;
            }
        }
    }

    fn write(&self, map: &mut MapSheet) {
        for (at, words, size, colour) in &self.placed {
            let half = [width_of(words, *size) / 2.0, 0.5 * size];
            let middle = [at[0], at[1] - 0.35 * size];
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            let outline = corners.map(|[x, y]| [middle[0] + x * half[0], middle[1] + y * half[1]]);
            map.sheet.area(&[outline.to_vec()], PAPER, 0.85, None);
            map.sheet.text(*at, words, *size, Anchor::Middle, colour);
        }
    }
}

/// The ticks of a scale that lie between the ends of the data, halved where they are few.
fn round_levels(ticks: &[f64], [low, high]: [f64; 2]) -> Vec<f64> {
    let within = |level: &f64| low < *level && *level < high;
    let inside: Vec<f64> = ticks.iter().copied().filter(within).collect();
    if inside.len() >= FEW {
        return inside;
    }
    let halved = ticks
        .windows(2)
        .flat_map(|pair| [pair[0], (pair[0] + pair[1]) / 2.0]);
    halved.filter(within).collect()
}

/// The centres of cells.
fn between(lattice: &Lattice) -> Points {
    let [columns, rows] = lattice.count.map(|count| count as f64);
    let step = |edge: [f64; 2], count: f64| edge.map(|x| x / count);
    Points {
        count: lattice.count,
        origin: lattice.at(0.5 / columns, 0.5 / rows),
        steps: [
            step(lattice.edges[0], columns),
            step(lattice.edges[1], rows),
        ],
    }
}

fn cross(map: &mut MapSheet, [x, y]: [f64; 2]) {
    let stroke = Stroke::new(INK, 1.5);
    for [dx, dy] in [[4.0, 4.0], [4.0, -4.0]] {
        map.sheet.line([x - dx, y - dy], [x + dx, y + dy], &stroke);
    }
}

fn distance(pair: &[[f64; 2]]) -> f64 {
    libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1])
}

fn length(line: &[[f64; 2]]) -> f64 {
    line.windows(2).map(distance).sum()
}

/// The point that lies so far along a line.
fn along(line: &[[f64; 2]], mut left: f64) -> [f64; 2] {
    for pair in line.windows(2) {
        let step = distance(pair);
        if left <= step && step > 0.0 {
            return std::array::from_fn(|k| pair[0][k] + (pair[1][k] - pair[0][k]) * left / step);
        }
        left -= step;
    }
    line[line.len() - 1]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slope of 100 lx/m over a grid of 4 m by 2 m, ± 10 lx.
    fn slope() -> Field {
        let places: Vec<[f64; 2]> = (0..8)
            .map(|n| [f64::from(n % 4) + 0.5, f64::from(n / 4) + 0.5])
            .collect();
        let values: Vec<f64> = places.iter().map(|[x, _]| 100.0 * x).collect();
        Field {
            title: "Slope".to_owned(),
            notes: vec![],
            axes: ["x (m)".to_owned(), "y (m)".to_owned()],
            quantity: "illuminance".to_owned(),
            unit: "lx".to_owned(),
            intervals: values
                .iter()
                .map(|value| [value - 10.0, value + 10.0])
                .collect(),
            places,
            values,
            percent: 95.0,
            lattice: Some(Lattice {
                origin: [0.0, 0.0],
                edges: [[4.0, 0.0], [0.0, 2.0]],
                count: [4, 2],
            }),
        }
    }

    fn drawn(levels: &[f64]) -> String {
        let field = slope();
        let lines = Isolines {
            field: &field,
            levels,
        };
        lines.drawing().unwrap().finish()
    }

    /// A metre is 160 pixels: the line 200 lx is at x = 2 m, its band from 1.9 to 2.1 m.
    #[test]
    fn a_level_is_a_line_within_its_band() {
        let svg = drawn(&[200.0]);
        assert!(
            svg.contains("396,") && svg.contains("380,") && svg.contains("412,"),
            "{svg}"
        );
        for part in [
            ">200<",
            "95 %: the line lies here",
            ">min 50.0<",
            ">max 350<",
            "illuminance (lx)",
        ] {
            assert!(svg.contains(part), "{part} is not in {svg}");
        }
    }

    #[test]
    fn levels_that_nobody_asked_for_are_round() {
        let svg = drawn(&[]);
        for level in [100, 150, 200, 250, 300] {
            assert!(
                svg.contains(&format!(">{level}<")),
                "{level} is not in {svg}"
            );
        }
    }

    #[test]
    fn levels_beyond_all_values_are_told() {
        assert!(drawn(&[200.0, 40.0, 500.0]).contains(">not reached: 40, 500<"));
        assert!(!drawn(&[200.0]).contains("not reached"));
    }

    #[test]
    fn what_is_no_grid_has_no_lines() {
        let scattered = Field {
            lattice: None,
            ..slope()
        };
        let lines = Isolines {
            field: &scattered,
            levels: &[],
        };
        assert_eq!(lines.drawing(), Err(PlotError::NoGrid));
        let row = Lattice {
            count: [8, 1],
            ..slope().lattice.unwrap()
        };
        let row = Field {
            lattice: Some(row),
            ..slope()
        };
        assert_eq!(
            Isolines {
                field: &row,
                levels: &[]
            }
            .drawing(),
            Err(PlotError::NoGrid)
        );
    }
}
