//! Matrices in colour.

use super::PlotError;
use super::axis::Axis;
use super::colour_bar::{self, BAR_WIDTH, colour, fill};
use super::frame::{Frame, INK, TICK_SIZE, width_of};
use super::heat_pixels;
use super::scale::Scale;
use crate::report::numbers::significant;
use crate::report::svg::{Anchor, Svg};

/// Most rows or columns whose names are written; of more none is, as they would overlap.
const MOST_NAMES: usize = 40;
const SIDE: f64 = 480.0;
const TOP: f64 = 48.0;

/// A matrix with a colour for each number, the first row on top, beside a legend that states the unit. Colours are those
/// of viridis, over round ends that hold 0 and all numbers.
///
/// ```
/// use steradian_io::report::plot::HeatMap;
/// let map = HeatMap {
///     title: "Form factors".to_owned(),
///     legend: "F".to_owned(),
///     rows: vec!["floor".to_owned(), "ceiling".to_owned()],
///     columns: vec!["floor".to_owned(), "ceiling".to_owned()],
///     values: vec![vec![0.0, 0.2], vec![0.2, 0.0]],
///     with_numbers: true,
/// };
/// assert!(map.to_svg()?.contains("ceiling"));
/// # Ok::<(), steradian_io::report::plot::PlotError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// Above the matrix.
    pub title: String,
    /// What the colours show, with its unit.
    pub legend: String,
    /// Names of the rows, from above.
    pub rows: Vec<String>,
    /// Names of the columns, from the left.
    pub columns: Vec<String>,
    /// The numbers, row by row.
    pub values: Vec<Vec<f64>>,
    /// Whether the numbers are written where they fit.
    pub with_numbers: bool,
}

impl HeatMap {
    /// The drawing.
    ///
    /// # Errors
    /// If there are no numbers, one is not finite, or rows, columns and names do not fit.
    pub fn to_svg(&self) -> Result<String, PlotError> {
        Ok(self.drawing()?.finish())
    }

    /// The drawing, which as pixels has names and title too.
    ///
    /// # Errors
    /// Those of [`to_svg`](Self::to_svg).
    pub fn drawing(&self) -> Result<Svg, PlotError> {
        self.check()?;
        let scale = Scale::new(&Axis::new("", ""), self.extent());
        let frame = self.frame();
        let mut sheet = Svg::new(
            frame.right() + 120.0,
            frame.bottom() + 24.0 + widest(&self.columns),
        );
        frame.title(&mut sheet, &self.title);
        self.cells(&mut sheet, &frame, &scale);
        self.names(&mut sheet, &frame);
        frame.edges(&mut sheet);
        self.colour_bar(&mut sheet, &frame, &scale);
        Ok(sheet)
    }

    /// The bytes of a PNG: cells and legend, without names and title.
    ///
    /// # Errors
    /// Those of [`to_svg`](Self::to_svg), and if there are too many pixels.
    pub fn to_png(&self) -> Result<Vec<u8>, PlotError> {
        self.check()?;
        let scale = Scale::new(&Axis::new("", ""), self.extent());
        heat_pixels::encode(self, &scale)
    }

    fn check(&self) -> Result<(), PlotError> {
        let (rows, columns) = (self.rows.len(), self.columns.len());
        if rows == 0 || columns == 0 {
            return Err(PlotError::Empty);
        }
        let shape = |place: &str, found| {
            let place = place.to_owned();
            PlotError::Shape {
                rows,
                columns,
                place,
                found,
            }
        };
        if self.values.len() != rows {
            return Err(shape("the matrix", self.values.len()));
        }
        for (name, row) in self.rows.iter().zip(&self.values) {
            if row.len() != columns {
                return Err(shape(name, row.len()));
            }
            if let Some(&value) = row.iter().find(|value| !value.is_finite()) {
                return Err(PlotError::NotFinite {
                    place: name.clone(),
                    value,
                });
            }
        }
        Ok(())
    }

    fn extent(&self) -> [f64; 2] {
        let all = self.values.iter().flatten();
        all.fold([0.0, 0.0], |[low, high], &value| {
            [value.min(low), value.max(high)]
        })
    }

    /// The matrix on the sheet; its cells are squares.
    fn frame(&self) -> Frame {
        let (rows, columns) = (self.rows.len() as f64, self.columns.len() as f64);
        let cell = SIDE / rows.max(columns);
        let left = 28.0 + widest(&self.rows);
        Frame {
            left,
            top: TOP,
            width: cell * columns,
            height: cell * rows,
        }
    }

    fn cells(&self, sheet: &mut Svg, frame: &Frame, scale: &Scale) {
        let [width, height] = [
            frame.width / self.columns.len() as f64,
            frame.height / self.rows.len() as f64,
        ];
        for (row, values) in self.values.iter().enumerate() {
            let top = frame.top + row as f64 * height;
            for (column, value) in values.iter().enumerate() {
                let left = frame.left + column as f64 * width;
                let cell = Frame {
                    left,
                    top,
                    width,
                    height,
                };
                let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
                let outline = corners.map(|[x, y]| cell.place(x, y)).to_vec();
                fill(sheet, outline, &colour(scale.position(*value)));
                if self.with_numbers {
                    number(sheet, &cell, scale.position(*value), *value);
                }
            }
        }
    }

    fn names(&self, sheet: &mut Svg, frame: &Frame) {
        let part = |index: usize, count: usize| (index as f64 + 0.5) / count as f64;
        for (index, name) in written(&self.rows).iter().enumerate() {
            let [x, y] = frame.place(0.0, 1.0 - part(index, self.rows.len()));
            sheet.text([x - 8.0, y + 4.0], name, TICK_SIZE, Anchor::End, INK);
        }
        for (index, name) in written(&self.columns).iter().enumerate() {
            let [x, y] = frame.place(part(index, self.columns.len()), 0.0);
            sheet.hanging_text([x + 4.0, y + 8.0], name, TICK_SIZE, INK);
        }
    }

    fn colour_bar(&self, sheet: &mut Svg, frame: &Frame, scale: &Scale) {
        let bar = Frame {
            left: frame.right() + 24.0,
            width: BAR_WIDTH,
            ..*frame
        };
        colour_bar::draw(sheet, &bar, scale, &self.legend);
    }
}

/// A number in its cell, if it fits.
fn number(sheet: &mut Svg, cell: &Frame, position: f64, value: f64) {
    let words = significant(value, 3);
    if cell.height >= 1.5 * TICK_SIZE && cell.width >= width_of(&words, TICK_SIZE) + 4.0 {
        let [x, y] = cell.place(0.5, 0.5);
        let ink = colour_bar::ink(position);
        sheet.text([x, y + 4.0], &words, TICK_SIZE, Anchor::Middle, ink);
    }
}

fn written(names: &[String]) -> &[String] {
    if names.len() <= MOST_NAMES {
        names
    } else {
        &[]
    }
}

fn widest(names: &[String]) -> f64 {
    written(names)
        .iter()
        .map(|name| width_of(name, TICK_SIZE))
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(values: Vec<Vec<f64>>) -> HeatMap {
        let names = |letter: char| (1..=2).map(|number| format!("{letter}{number}")).collect();
        HeatMap {
            title: "Test".to_owned(),
            legend: "F (1)".to_owned(),
            rows: names('r'),
            columns: names('c'),
            values,
            with_numbers: false,
        }
    }

    #[test]
    fn rows_run_downwards_and_columns_to_the_right() {
        let svg = map(vec![vec![0.0, 0.0], vec![1.0, 0.0]]).to_svg().unwrap();
        for part in ["Test", "F (1)", ">r1<", ">r2<", ">c1<", ">c2<"] {
            assert!(svg.contains(part), "{part} is not in {svg}");
        }
        // Of four cells of 240 pixels the third, below on the left, is bright.
        let cells: Vec<&str> = svg
            .lines()
            .filter(|line| line.starts_with("<path"))
            .take(4)
            .collect();
        assert!(
            cells[2].contains("#fde725") && cells[2].contains(",528 "),
            "{}",
            cells[2]
        );
        assert!(
            [0, 1, 3]
                .iter()
                .all(|&cell| cells[cell].contains("#440154"))
        );
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let shape = |place: &str, found| {
            let place = place.to_owned();
            PlotError::Shape {
                rows: 2,
                columns: 2,
                place,
                found,
            }
        };
        assert_eq!(map(vec![]).to_svg(), Err(shape("the matrix", 0)));
        assert_eq!(
            map(vec![vec![1.0, 2.0], vec![1.0]]).to_svg(),
            Err(shape("r2", 1))
        );
        let unknown = map(vec![vec![1.0, f64::NAN], vec![1.0, 1.0]]).to_svg();
        assert!(matches!(unknown, Err(PlotError::NotFinite { place, .. }) if place == "r1"));
        let nothing = HeatMap {
            rows: vec![],
            ..map(vec![])
        };
        assert_eq!(nothing.to_svg(), Err(PlotError::Empty));
    }
}
