//! Curves around a point, such as lobes of reflection in the plane of incidence, or the intensity of a luminaire.

use super::PlotError;
use super::axis::Axis;
use super::frame::{INK, LABEL_SIZE, TICK_SIZE, TITLE_SIZE, width_of};
use super::line_plot::COLOURS;
use super::scale::Scale;
use crate::report::svg::{Anchor, Stroke, Svg};

const RADIUS: f64 = 270.0;
const MARGIN: f64 = 60.0;
const TOP: f64 = 78.0;
const BELOW: f64 = 64.0;
const KEY: f64 = 26.0;
const GRID: &str = "#dddddd";
/// Degrees between spokes.
const SPOKES: i32 = 15;
/// Degrees between spokes that have labels.
const LABELS: i32 = 30;
/// Decades of a logarithmic axis.
const DECADES: f64 = 1e-4;

/// A curve by angle and value.
#[derive(Clone, Debug, PartialEq)]
pub struct PolarCurve {
    /// For the key.
    pub name: String,
    /// (angle in degrees from the vertical, positive to the right, −180 … 180; value ≥ 0), in order.
    pub points: Vec<[f64; 2]>,
    /// Whether it is drawn in dashes.
    pub dashed: bool,
}

/// A diagram of one or more curves. Angles run from the vertical; the half beyond the horizontal is drawn only where something lies there.
///
/// ```
/// use steradian_io::report::plot::{Axis, PolarCurve, PolarPlot, Zero};
/// let cosine = |degrees: i32| [f64::from(degrees), libm::cos(f64::from(degrees).to_radians())];
/// let plot = PolarPlot {
///     title: "Lambert's law".to_owned(),
///     value: Axis::new("intensity", "W/sr"),
///     curves: vec![PolarCurve { name: "cosine".to_owned(), points: (-90..=90).map(cosine).collect(), dashed: false }],
///     arrows: vec![],
///     zero: Zero::Above,
/// };
/// assert!(plot.to_svg()?.contains("intensity (W/sr)"));
/// # Ok::<(), steradian_io::report::plot::PlotError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PolarPlot {
    /// Above the diagram.
    pub title: String,
    /// What the distance from the middle shows. On a logarithmic axis, of four decades, smaller values are in the middle.
    pub value: Axis,
    /// The curves. The first seven have colours of their own.
    pub curves: Vec<PolarCurve>,
    /// Arrows that come in from these angles in degrees.
    pub arrows: Vec<f64>,
    /// Where the angle 0 is.
    pub zero: Zero,
}

/// Which way the angle 0 points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Zero {
    /// Up, as of lobes over a surface.
    #[default]
    Above,
    /// Down, as of lamps.
    Below,
}

/// Where things are on the sheet.
struct Place {
    center: [f64; 2],
    is_whole: bool,
    zero: Zero,
}

impl PolarPlot {
    /// The drawing.
    ///
    /// # Errors
    /// If there are no curves, or a value is negative, infinite or NaN.
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
        let scale = self.scale();
        let place = Place::new(self.reaches_beyond_the_horizontal(), self.zero);
        let bottom = place.bottom();
        let mut sheet = Svg::new(2.0 * (MARGIN + RADIUS) + self.key_width(), bottom + BELOW);
        sheet.text(
            [place.center[0], 28.0],
            &self.title,
            TITLE_SIZE,
            Anchor::Middle,
            INK,
        );
        place.grid(&mut sheet, &scale);
        let label = [place.center[0], bottom + 46.0];
        sheet.text(label, &self.value.label, LABEL_SIZE, Anchor::Middle, INK);
        for (curve, colour) in self.coloured() {
            place.curve(&mut sheet, curve, &scale, colour);
        }
        self.arrows
            .iter()
            .for_each(|&angle| place.arrow(&mut sheet, angle));
        self.key(&mut sheet);
        Ok(sheet)
    }

    fn check(&self) -> Result<(), PlotError> {
        if self.curves.iter().all(|curve| curve.points.is_empty()) {
            return Err(PlotError::Empty);
        }
        for curve in &self.curves {
            for &[angle, value] in &curve.points {
                let bad = [angle, value].into_iter().find(|x| !x.is_finite());
                let bad = bad.or(Some(value).filter(|value| *value < 0.0));
                if let Some(value) = bad {
                    let place = curve.name.clone();
                    return Err(PlotError::NotFinite { place, value });
                }
            }
        }
        Ok(())
    }

    fn largest(&self) -> f64 {
        let points = self.curves.iter().flat_map(|curve| &curve.points);
        points.fold(0.0, |largest, [_, value]| value.max(largest))
    }

    fn scale(&self) -> Scale {
        let largest = self.largest();
        if self.value.is_logarithmic && largest > 0.0 {
            return Scale::new(
                &self.value.clone().from_to(DECADES * largest, largest),
                [largest; 2],
            );
        }
        let linear = Axis {
            is_logarithmic: false,
            ..self.value.clone()
        };
        Scale::new(&linear, [0.0, largest])
    }

    /// Whether anything but 0 lies there.
    fn reaches_beyond_the_horizontal(&self) -> bool {
        let points = self.curves.iter().flat_map(|curve| &curve.points);
        points
            .clone()
            .any(|[angle, value]| angle.abs() > 90.0 && *value > 0.0)
    }

    fn coloured(&self) -> impl Iterator<Item = (&PolarCurve, &str)> {
        self.curves.iter().zip(COLOURS.into_iter().cycle())
    }

    fn key_width(&self) -> f64 {
        let widths = self
            .curves
            .iter()
            .map(|curve| width_of(&curve.name, TICK_SIZE));
        widths.fold(0.0, f64::max) + KEY + 16.0
    }

    fn key(&self, sheet: &mut Svg) {
        for ((curve, colour), line) in self.coloured().zip(0..) {
            let [x, y] = [2.0 * (MARGIN + RADIUS) - 12.0, TOP + 20.0 * f64::from(line)];
            sheet.line([x, y], [x + KEY, y], &stroke(curve, colour));
            sheet.text(
                [x + KEY + 8.0, y + 4.0],
                &curve.name,
                TICK_SIZE,
                Anchor::Start,
                INK,
            );
        }
    }
}

impl Place {
    fn new(is_whole: bool, zero: Zero) -> Self {
        let above = match zero {
            Zero::Below if !is_whole => 0.0,
            _ => RADIUS,
        };
        Self {
            center: [MARGIN + RADIUS, TOP + above],
            is_whole,
            zero,
        }
    }

    /// The lower end of the diagram.
    fn bottom(&self) -> f64 {
        let below = match self.zero {
            Zero::Above if !self.is_whole => 0.0,
            _ => RADIUS + 20.0,
        };
        self.center[1] + below
    }

    /// The point at this angle and part of the radius.
    fn at(&self, degrees: f64, part: f64) -> [f64; 2] {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let up = match self.zero {
            Zero::Above => cos,
            Zero::Below => -cos,
        };
        [
            self.center[0] + RADIUS * part * sin,
            self.center[1] - RADIUS * part * up,
        ]
    }

    fn grid(&self, sheet: &mut Svg, scale: &Scale) {
        let reach: i32 = if self.is_whole { 180 } else { 90 };
        for (part, label) in scale.ticks().filter(|(part, _)| *part > 1e-9) {
            let arc: Vec<[f64; 2]> = (-reach..=reach)
                .map(|angle| self.at(f64::from(angle), part))
                .collect();
            sheet.polyline(&arc, &Stroke::new(GRID, 1.0));
            let [x, y] = self.at(90.0, part);
            let beside = match self.zero {
                Zero::Above => 16.0,
                Zero::Below => -6.0,
            };
            sheet.text([x, y + beside], &label, TICK_SIZE, Anchor::Middle, INK);
        }
        for angle in (-reach..=reach).step_by(SPOKES as usize) {
            sheet.line(
                self.center,
                self.at(f64::from(angle), 1.0),
                &Stroke::new(GRID, 1.0),
            );
            if angle % LABELS == 0 && angle != -180 {
                let [x, y] = self.at(f64::from(angle), 1.05);
                let anchor = match angle {
                    0 | 180 => Anchor::Middle,
                    right if right > 0 => Anchor::Start,
                    _ => Anchor::End,
                };
                sheet.text(
                    [x, y + 4.0],
                    &format!("{}°", angle.abs()),
                    TICK_SIZE,
                    anchor,
                    INK,
                );
            }
        }
        sheet.line(
            self.at(-90.0, 1.0),
            self.at(90.0, 1.0),
            &Stroke::new(INK, 1.5),
        );
    }

    fn curve(&self, sheet: &mut Svg, curve: &PolarCurve, scale: &Scale, colour: &str) {
        let part = |value: f64| {
            if value > 0.0 {
                scale.position(value).clamp(0.0, 1.0)
            } else {
                0.0
            }
        };
        let points: Vec<[f64; 2]> = curve
            .points
            .iter()
            .map(|&[angle, value]| self.at(angle, part(value)))
            .collect();
        sheet.polyline(&points, &stroke(curve, colour));
    }

    /// From outside to the middle.
    fn arrow(&self, sheet: &mut Svg, angle: f64) {
        let ink = Stroke::new("#777777", 1.5);
        let tip = self.at(angle, 0.02);
        sheet.line(self.at(angle, 1.0), tip, &ink.clone().dashed(6.0, 4.0));
        for side in [-3.0, 3.0] {
            sheet.line(self.at(angle + side, 0.12), tip, &ink);
        }
    }
}

fn stroke(curve: &PolarCurve, colour: &str) -> Stroke {
    let stroke = Stroke::new(colour, 2.0);
    if curve.dashed {
        stroke.dashed(7.0, 4.0)
    } else {
        stroke
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(points: &[[f64; 2]]) -> PolarPlot {
        PolarPlot {
            title: "Test".to_owned(),
            value: Axis::new("ρ", "1/sr"),
            curves: vec![PolarCurve {
                name: "curve".to_owned(),
                points: points.to_vec(),
                dashed: true,
            }],
            arrows: vec![-45.0],
            zero: Zero::Above,
        }
    }

    #[test]
    fn values_are_distances_from_the_middle() {
        let svg = plot(&[[-90.0, 1.0], [0.0, 0.5], [90.0, 1.0]])
            .to_svg()
            .unwrap();
        // The middle is (330, 348).
        assert!(svg.contains(r#"points="60,348 330,213 600,348""#), "{svg}");
        for part in ["Test", "ρ (1/sr)", ">curve<", "90°", "30°"] {
            assert!(svg.contains(part), "{part}");
        }
        assert!(!svg.contains("120°"));
    }

    #[test]
    fn the_lower_half_is_drawn_where_light_goes_through() {
        assert!(
            plot(&[[0.0, 1.0], [170.0, 0.2]])
                .to_svg()
                .unwrap()
                .contains("150°")
        );
    }

    /// The middle is (330, 78) where no light goes up, and straight down is 270 below it.
    #[test]
    fn lamps_shine_down() {
        let lamp = |points: &[[f64; 2]]| PolarPlot {
            zero: Zero::Below,
            ..plot(points)
        };
        let svg = lamp(&[[-90.0, 0.0], [0.0, 1.0], [90.0, 0.0]]).to_svg();
        let svg = svg.unwrap();
        assert!(svg.contains(r#"points="330,78 330,348 330,78""#), "{svg}");
        let up = lamp(&[[0.0, 1.0], [180.0, 0.5]]).to_svg().unwrap();
        assert!(up.contains(r#"points="330,618 330,213""#), "{up}");
    }

    #[test]
    fn what_is_no_value_is_refused() {
        assert_eq!(plot(&[]).to_svg(), Err(PlotError::Empty));
        for value in [f64::NAN, -1.0] {
            assert!(matches!(
                plot(&[[0.0, value]]).to_svg(),
                Err(PlotError::NotFinite { .. })
            ));
        }
    }
}
