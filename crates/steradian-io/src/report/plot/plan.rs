//! A field at true scale, in colours with numbers in them.

use super::PlotError;
use super::axis::Axis;
use super::colour_bar::{self, BAR_WIDTH, colour};
use super::field::{Field, Lattice, MAP_SIZE, MapSheet, SMALL_SIZE, Taken, key_width};
use super::frame::{INK, width_of};
use super::scale::Scale;
use crate::report::numbers::significant;
use crate::report::svg::{Anchor, Stroke, Svg};

/// Least and greatest size of numbers in cells, in pixels.
const SIZES: [f64; 2] = [7.0, 13.0];

/// A field as coloured cells with their numbers, or, where its places are no grid, as points with theirs. The least and
/// the greatest value are marked.
///
/// ```
/// use steradian_io::report::plot::{Field, Lattice, Plan};
/// let field = Field {
///     title: "Desk".to_owned(),
///     notes: vec!["mean 450 lx".to_owned()],
///     axes: ["x (m)".to_owned(), "y (m)".to_owned()],
///     quantity: "illuminance".to_owned(),
///     unit: "lx".to_owned(),
///     places: vec![[0.5, 0.5], [1.5, 0.5]],
///     values: vec![400.0, 500.0],
///     intervals: vec![[390.0, 410.0], [495.0, 505.0]],
///     percent: 95.0,
///     lattice: Some(Lattice { origin: [0.0, 0.0], edges: [[2.0, 0.0], [0.0, 1.0]], count: [2, 1] }),
/// };
/// let drawing = Plan { field: &field, with_errors: true }.drawing()?.finish();
/// assert!(drawing.contains(">500<") && drawing.contains("illuminance (lx)"));
/// # Ok::<(), steradian_io::report::plot::PlotError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// What is shown.
    pub field: &'a Field,
    /// Whether numbers come with the half-width of their interval.
    pub with_errors: bool,
}

impl Plan<'_> {
    /// The drawing.
    ///
    /// # Errors
    /// If there are no places, a number is not finite, or lists do not fit.
    pub fn drawing(&self) -> Result<Svg, PlotError> {
        self.field.check()?;
        let scale = Scale::new(&Axis::new("", ""), self.field.ends());
        let labels: Vec<String> = scale.ticks().map(|(_, label)| label).collect();
        let bar = BAR_WIDTH + key_width(labels.iter().map(String::as_str));
        let legend = self.field.legend();
        let mut map = MapSheet::new(self.field, bar.max(key_width([legend.as_str()])));
        match self.field.lattice {
            Some(lattice) => self.cells(&mut map, &lattice, &scale),
            None => self.points(&mut map, &scale),
        }
        let (frame, place) = (map.frame, map.bar());
        frame.edges(&mut map.sheet);
        colour_bar::draw(&mut map.sheet, &place, &scale, &legend);
        Ok(map.sheet)
    }

    fn cells(&self, map: &mut MapSheet, lattice: &Lattice, scale: &Scale) {
        let cells: Vec<Vec<[f64; 2]>> = (0..self.field.values.len())
            .map(|index| map.places(&lattice.cell(index)))
            .collect();
        for (cell, value) in cells.iter().zip(&self.field.values) {
            colour_bar::fill(
                &mut map.sheet,
                cell.clone(),
                &colour(scale.position(*value)),
            );
        }
        let room = room(&cells[0]);
        for (name, index) in self.extremes() {
            let ink = ink(scale, self.field.values[index]);
            let inset = inset(&cells[index], 2.0);
            map.sheet
                .area(&[inset], "none", 1.0, Some(&Stroke::new(ink, 2.0)));
            if room[1] > 3.0 * SMALL_SIZE && room[0] > width_of(name, SMALL_SIZE) {
                let [x, y] = map.place(self.field.places[index]);
                let at = [x, y - room[1] / 2.0 + SMALL_SIZE + 4.0];
                map.sheet.text(at, name, SMALL_SIZE, Anchor::Middle, ink);
            }
        }
        self.numbers(map, scale, room);
    }

    /// Numbers in cells, if all of them fit.
    fn numbers(&self, map: &mut MapSheet, scale: &Scale, [width, height]: [f64; 2]) {
        let lines: Vec<Vec<String>> = (0..self.field.values.len())
            .map(|n| self.lines(n))
            .collect();
        let longest = lines.iter().flatten().map(|words| width_of(words, 1.0));
        let wide = (width - 4.0) / longest.fold(0.0, f64::max);
        let high = (height - 2.0) / (1.2 * lines[0].len() as f64);
        let size = wide.min(high).min(SIZES[1]);
        if size < SIZES[0] {
            return;
        }
        for (index, lines) in lines.iter().enumerate() {
            let [x, y] = map.place(self.field.places[index]);
            let ink = ink(scale, self.field.values[index]);
            let first = y + 0.35 * size - 0.6 * size * (lines.len() as f64 - 1.0);
            for (words, line) in lines.iter().zip(0..) {
                let at = [x, first + 1.2 * size * f64::from(line)];
                map.sheet.text(at, words, size, Anchor::Middle, ink);
            }
        }
    }

    fn points(&self, map: &mut MapSheet, scale: &Scale) {
        let places = map.places(&self.field.places);
        for (&at, value) in places.iter().zip(&self.field.values) {
            map.point(at, &colour(scale.position(*value)));
        }
        let frame = map.frame;
        let mut taken = Taken::default();
        for at in &places {
            taken.take(&frame, [at[0], at[1] + 4.0], "", MAP_SIZE);
        }
        let extremes = self.extremes();
        let order = extremes.iter().map(|(_, index)| *index);
        let others = (0..places.len()).filter(|n| extremes.iter().all(|(_, e)| e != n));
        for index in order.chain(others).collect::<Vec<_>>() {
            let name = extremes.iter().find(|(_, extreme)| *extreme == index);
            let prefix = name.map_or_else(String::new, |(name, _)| format!("{name} "));
            let words = format!("{prefix}{}", self.lines(index).join(" "));
            label(map, &mut taken, places[index], &words);
        }
    }

    /// The least and the greatest, if they differ.
    fn extremes(&self) -> Vec<(&'static str, usize)> {
        let [least, greatest] = [self.field.least(), self.field.greatest()];
        if least == greatest {
            return Vec::new();
        }
        vec![("min", least), ("max", greatest)]
    }

    fn lines(&self, index: usize) -> Vec<String> {
        let value = self.field.words(index);
        let [low, high] = self.field.intervals[index];
        let half_width = (high - low) / 2.0;
        if !self.with_errors || half_width <= 0.0 {
            return vec![value];
        }
        vec![value, format!("± {}", significant(half_width, 2))]
    }
}

/// Words at a point, where there is room around it.
fn label(map: &mut MapSheet, taken: &mut Taken, [x, y]: [f64; 2], words: &str) {
    let half = width_of(words, MAP_SIZE) / 2.0;
    let right = [x + half + 9.0, y + 4.0];
    let left = [x - half - 9.0, y + 4.0];
    for at in [right, left, [x, y - 9.0], [x, y + 18.0]] {
        if taken.take(&map.frame, at, words, MAP_SIZE) {
            map.sheet.text(at, words, MAP_SIZE, Anchor::Middle, INK);
            return;
        }
    }
}

/// Width and height of a rectangle that fits into a cell.
fn room(cell: &[[f64; 2]]) -> [f64; 2] {
    let length = |k: usize| (cell[k][0] - cell[k + 1][0], cell[k][1] - cell[k + 1][1]);
    let [(ax, ay), (bx, by)] = [length(0), length(1)];
    let area = (ax * by - ay * bx).abs();
    let width = ax.abs().max(bx.abs());
    [width, area / width.max(f64::MIN_POSITIVE)]
}

/// A cell with its corners moved inwards.
fn inset(cell: &[[f64; 2]], by: f64) -> Vec<[f64; 2]> {
    let middle: [f64; 2] =
        std::array::from_fn(|k| cell.iter().map(|corner| corner[k]).sum::<f64>() / 4.0);
    let moved = |corner: &[f64; 2]| {
        std::array::from_fn(|k| corner[k] + by * (middle[k] - corner[k]).signum())
    };
    cell.iter().map(moved).collect()
}

fn ink(scale: &Scale, value: f64) -> &'static str {
    colour_bar::ink(scale.position(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(lattice: Option<Lattice>) -> Field {
        Field {
            title: "Desk".to_owned(),
            notes: vec!["mean 300 lx".to_owned()],
            axes: ["x (m)".to_owned(), "y (m)".to_owned()],
            quantity: "illuminance".to_owned(),
            unit: "lx".to_owned(),
            places: vec![[1.0, 0.5], [3.0, 0.5], [1.0, 1.5], [3.0, 1.5]],
            values: vec![100.0, 200.0, 300.0, 600.0],
            intervals: vec![
                [95.0, 105.0],
                [198.0, 202.0],
                [300.0, 300.0],
                [590.0, 610.0],
            ],
            percent: 95.0,
            lattice,
        }
    }

    fn grid() -> Option<Lattice> {
        Some(Lattice {
            origin: [0.0, 0.0],
            edges: [[4.0, 0.0], [0.0, 2.0]],
            count: [2, 2],
        })
    }

    fn drawn(field: &Field, with_errors: bool) -> String {
        let plan = Plan { field, with_errors };
        plan.drawing().unwrap().finish()
    }

    /// Four metres take 640 pixels and two 320, below the title and one note.
    #[test]
    fn cells_have_their_true_scale_and_place() {
        let svg = drawn(&field(grid()), false);
        let first = svg.lines().find(|line| line.starts_with("<path")).unwrap();
        assert!(first.contains("M76,396 396,396 396,236 76,236Z"), "{first}");
        for part in [
            ">100<",
            ">600<",
            ">min<",
            ">max<",
            "x (m)",
            "illuminance (lx)",
            "mean 300 lx",
        ] {
            assert!(svg.contains(part), "{part} is not in {svg}");
        }
        assert!(!svg.contains('±'));
    }

    #[test]
    fn errors_stand_below_numbers_that_have_some() {
        let svg = drawn(&field(grid()), true);
        assert_eq!(svg.matches('±').count(), 3);
        assert!(svg.contains(">± 5<") && svg.contains(">± 10<"), "{svg}");
    }

    #[test]
    fn points_that_are_no_grid_are_dots_with_labels() {
        let svg = drawn(&field(None), false);
        assert_eq!(svg.matches("<circle").count(), 4);
        assert!(svg.contains(">max 600<") && svg.contains(">200<"), "{svg}");
        let single = Field {
            places: vec![[0.0, 0.0]],
            values: vec![5.0],
            intervals: vec![[5.0, 5.0]],
            ..field(None)
        };
        assert!(drawn(&single, true).contains(">5.00<"));
    }

    #[test]
    fn lists_of_other_length_are_refused() {
        let short = Field {
            values: vec![1.0],
            ..field(None)
        };
        let refused = Plan {
            field: &short,
            with_errors: false,
        }
        .drawing();
        assert_eq!(refused, Err(PlotError::Places { count: 4, found: 1 }));
    }
}
