//! Lines over two axes.

use super::PlotError;
use super::axis::Axis;
use super::frame::{Frame, INK, LABEL_SIZE, TICK_SIZE, width_of};
use super::scale::Scale;
use crate::report::svg::{Anchor, Stroke, Svg};

/// The colours of M. Okabe & K. Ito, "Color Universal Design" (2008), which colour-blind readers tell apart, without
/// yellow, which is faint on white.
pub(super) const COLOURS: [&str; 7] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000",
];
const PICTURE: Frame = Frame {
    left: 84.0,
    top: 48.0,
    width: 520.0,
    height: 330.0,
};
const BELOW: f64 = 62.0;
const KEY: f64 = 26.0;
const CAP: f64 = 3.0;

/// A line through points.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    name: String,
    points: Vec<[f64; 2]>,
    half_widths: Vec<f64>,
    is_dashed: bool,
    colour: Option<usize>,
}

impl Series {
    /// A line through (x, y), in this order. An empty name keeps it out of the legend.
    pub fn new(name: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        Self {
            name: name.to_owned(),
            points: points.into_iter().collect(),
            half_widths: Vec::new(),
            is_dashed: false,
            colour: None,
        }
    }

    /// The same, dashed: for what is not computed but expected.
    pub fn dashed(mut self) -> Self {
        self.is_dashed = true;
        self
    }

    /// The same in the colour of another line, by its number from 0.
    pub fn in_colour_of(mut self, line: usize) -> Self {
        self.colour = Some(line);
        self
    }

    /// The same with an error bar of y ± half-width at each point, in their order.
    pub fn with_half_widths(mut self, half_widths: impl IntoIterator<Item = f64>) -> Self {
        self.half_widths = half_widths.into_iter().collect();
        self
    }

    fn check(&self, x: &Axis, y: &Axis) -> Result<(), PlotError> {
        for point in &self.points {
            x.check(&self.name, point[0])?;
            y.check(&self.name, point[1])?;
        }
        for [low, high] in self.bars() {
            y.check(&self.name, low[1])?;
            y.check(&self.name, high[1])?;
        }
        Ok(())
    }

    /// Both ends of each error bar.
    fn bars(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        let both = self.points.iter().zip(&self.half_widths);
        both.map(|(&[x, y], half_width)| [[x, y - half_width], [x, y + half_width]])
    }

    /// Everything that is drawn of it.
    fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        self.points.iter().copied().chain(self.bars().flatten())
    }

    fn stroke(&self, colour: &str) -> Stroke {
        let stroke = Stroke::new(colour, 2.0);
        if self.is_dashed {
            stroke.dashed(7.0, 4.0)
        } else {
            stroke
        }
    }
}

/// A diagram of one or more lines.
///
/// ```
/// use steradian_io::report::plot::{Axis, LinePlot, Series};
/// let cosine = (0..=90).map(|degrees| [f64::from(degrees), libm::cos(f64::from(degrees).to_radians())]);
/// let plot = LinePlot::new("Foreshortening", Axis::new("tilt", "°"), Axis::new("projected area", "m²"))
///     .with(Series::new("square of 1 m²", cosine));
/// assert!(plot.to_svg()?.starts_with("<svg"));
/// # Ok::<(), steradian_io::report::plot::PlotError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LinePlot {
    title: String,
    x: Axis,
    y: Axis,
    series: Vec<Series>,
}

impl LinePlot {
    /// No lines yet.
    pub fn new(title: &str, x: Axis, y: Axis) -> Self {
        Self {
            title: title.to_owned(),
            x,
            y,
            series: Vec::new(),
        }
    }

    /// The same with one line more. The first seven have colours of their own.
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// The drawing.
    ///
    /// # Errors
    /// If there are no points, or a number has no place on its axis.
    pub fn to_svg(&self) -> Result<String, PlotError> {
        Ok(self.drawing()?.finish())
    }

    /// The drawing as pixels.
    ///
    /// # Errors
    /// Those of [`to_svg`](Self::to_svg), and if there are too many pixels.
    pub fn to_png(&self) -> Result<Vec<u8>, PlotError> {
        Ok(self.drawing()?.to_png()?)
    }

    fn drawing(&self) -> Result<Svg, PlotError> {
        self.check()?;
        let [x, y] =
            [(&self.x, 0), (&self.y, 1)].map(|(axis, part)| Scale::new(axis, self.extent(part)));
        let mut sheet = Svg::new(
            PICTURE.right() + self.legend_width(),
            PICTURE.bottom() + BELOW,
        );
        PICTURE.title(&mut sheet, &self.title);
        PICTURE.horizontal_axis(&mut sheet, &x, &self.x.label);
        PICTURE.vertical_axis(&mut sheet, &y, &self.y.label);
        PICTURE.edges(&mut sheet);
        for (series, colour) in self.coloured() {
            draw(&mut sheet, series, &series.stroke(colour), [&x, &y]);
        }
        self.legend(&mut sheet);
        Ok(sheet)
    }

    fn check(&self) -> Result<(), PlotError> {
        if self.series.iter().all(|series| series.points.is_empty()) {
            return Err(PlotError::Empty);
        }
        self.x.check_range()?;
        self.y.check_range()?;
        self.series
            .iter()
            .try_for_each(|series| series.check(&self.x, &self.y))
    }

    /// The least and the greatest coordinate.
    fn extent(&self, part: usize) -> [f64; 2] {
        let all = self
            .series
            .iter()
            .flat_map(Series::places)
            .map(|place| place[part]);
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        })
    }

    fn coloured(&self) -> impl Iterator<Item = (&Series, &str)> {
        self.series.iter().enumerate().map(|(line, series)| {
            let colour = series.colour.unwrap_or(line);
            (series, COLOURS[colour % COLOURS.len()])
        })
    }

    fn legend_width(&self) -> f64 {
        let widths = self
            .series
            .iter()
            .map(|series| width_of(&series.name, TICK_SIZE));
        let widest = widths.fold(0.0, f64::max);
        if widest == 0.0 {
            LABEL_SIZE + 12.0
        } else {
            widest + KEY + 34.0
        }
    }

    fn legend(&self, sheet: &mut Svg) {
        let named = self
            .coloured()
            .filter(|(series, _)| !series.name.is_empty());
        for ((series, colour), line) in named.zip(0..) {
            let (x, y) = (
                PICTURE.right() + 16.0,
                PICTURE.top + 12.0 + 20.0 * f64::from(line),
            );
            sheet.line([x, y], [x + KEY, y], &series.stroke(colour));
            sheet.text(
                [x + KEY + 8.0, y + 4.0],
                &series.name,
                TICK_SIZE,
                Anchor::Start,
                INK,
            );
        }
    }
}

/// The line, cut at the edges of the picture, and its error bars.
fn draw(sheet: &mut Svg, series: &Series, stroke: &Stroke, [x, y]: [&Scale; 2]) {
    let positions = |point: &[f64; 2]| [x.position(point[0]), y.position(point[1])];
    let place = |[x, y]: [f64; 2]| PICTURE.place(x, y);
    let line: Vec<[f64; 2]> = series.points.iter().map(positions).collect();
    for run in super::cut::runs_inside(&line) {
        let places: Vec<[f64; 2]> = run.into_iter().map(place).collect();
        sheet.polyline(&places, stroke);
    }
    for bar in series.bars() {
        let ends = bar.map(|end| positions(&end));
        if let Some(visible) = super::cut::inside(ends) {
            let [low, high] = visible.map(place);
            sheet.line(low, high, stroke);
            for [x, y] in [low, high] {
                sheet.line([x - CAP, y], [x + CAP, y], stroke);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(points: &[[f64; 2]]) -> LinePlot {
        LinePlot::new(
            "Test",
            Axis::new("x", "m"),
            Axis::new("y", "sr").logarithmic(),
        )
        .with(Series::new("line", points.to_vec()))
    }

    #[test]
    fn titles_labels_units_and_names_are_drawn() {
        let dashed = Series::new("error < 1 %", [[0.0, 2.0], [1.0, 3.0]])
            .dashed()
            .with_half_widths([0.1, 0.2]);
        let svg = plot(&[[0.0, 1.0], [1.0, 10.0]])
            .with(dashed)
            .to_svg()
            .unwrap();
        for part in [
            "Test",
            "x (m)",
            "y (sr)",
            ">line<",
            "error &lt; 1 %",
            "stroke-dasharray",
        ] {
            assert!(svg.contains(part), "{part} is not in {svg}");
        }
    }

    #[test]
    fn a_line_goes_where_its_numbers_are() {
        let axis = || Axis::new("", "").from_to(0.0, 1.0);
        let plot = LinePlot::new("", axis(), axis())
            .with(Series::new("", [[0.0, 0.0], [0.5, 1.0], [1.0, 2.0]]));
        // From the lower left corner (84, 378) to the middle of the upper edge (344, 48); the rest is outside.
        let svg = plot.to_svg().unwrap();
        assert!(
            svg.contains(
                r##"points="84,378 344,48" fill="none" stroke-linejoin="round" stroke="#0072b2""##
            ),
            "{svg}"
        );
    }

    #[test]
    fn what_cannot_be_shown_is_refused() {
        assert_eq!(plot(&[]).to_svg(), Err(PlotError::Empty));
        let place = "line".to_owned();
        assert_eq!(
            plot(&[[0.0, 0.0]]).to_svg(),
            Err(PlotError::NotPositive {
                place: place.clone(),
                value: 0.0
            })
        );
        assert_eq!(
            plot(&[[f64::INFINITY, 1.0]]).to_svg(),
            Err(PlotError::NotFinite {
                place,
                value: f64::INFINITY
            })
        );
        let unknown_error =
            plot(&[[0.0, 1.0]]).with(Series::new("", [[0.0, 1.0]]).with_half_widths([f64::NAN]));
        assert!(matches!(
            unknown_error.to_svg(),
            Err(PlotError::NotFinite { .. })
        ));
        let backwards = LinePlot {
            x: Axis::new("x", "").from_to(1.0, 0.0),
            ..plot(&[[0.0, 1.0]])
        };
        assert!(matches!(backwards.to_svg(), Err(PlotError::Range { .. })));
    }
}
