//! Values over the directions of a hemisphere, in colour.

use super::PlotError;
use super::axis::Axis;
use super::frame::{INK, TICK_SIZE, TITLE_SIZE};
use super::scale::Scale;
use crate::report::svg::{Anchor, Stroke, Svg};

const RADIUS: f64 = 150.0;
const PANEL: f64 = 2.0 * RADIUS + 70.0;
const LEFT: f64 = 35.0;
const TOP: f64 = 92.0;
const BAR_WIDTH: f64 = 20.0;
const BAR_STEPS: u32 = 64;
/// Degrees of θ between circles.
const CIRCLES: usize = 30;
/// Decades of a logarithmic scale.
const DECADES: f64 = 1e-4;

/// Values by direction.
#[derive(Clone, Debug, PartialEq)]
pub struct HemispherePanel {
    /// Above the panel.
    pub name: String,
    /// Rings of equal width in θ from 0 to 90°, each with values at equal steps of φ from 0 to 360°, at the middles of the cells.
    pub rings: Vec<Vec<f64>>,
    /// A direction to mark: θ and φ in degrees.
    pub mark: Option<[f64; 2]>,
}

/// Panels beside one another with one legend: θ is the distance from the middle, φ the angle from the right, counter-clockwise.
/// Colours are those of viridis.
///
/// ```
/// use steradian_io::report::plot::{Axis, HemisphereMap, HemispherePanel};
/// let map = HemisphereMap {
///     title: "ρ".to_owned(),
///     value: Axis::new("ρ", "1/sr"),
///     panels: vec![HemispherePanel { name: "paper".to_owned(), rings: vec![vec![0.3; 8]; 4], mark: Some([45.0, 180.0]) }],
/// };
/// assert!(map.to_svg()?.contains("paper"));
/// # Ok::<(), steradian_io::report::plot::PlotError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct HemisphereMap {
    /// Above all panels.
    pub title: String,
    /// What the colours show; on a logarithmic axis, of four decades, smaller values have the first colour.
    pub value: Axis,
    /// From the left.
    pub panels: Vec<HemispherePanel>,
}

impl HemisphereMap {
    /// The drawing.
    ///
    /// # Errors
    /// If there are no values or one is not finite.
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
        let scale = self.scale()?;
        let width = LEFT + PANEL * self.panels.len() as f64;
        let mut sheet = Svg::new(width + 130.0, TOP + 2.0 * RADIUS + 44.0);
        sheet.text(
            [width / 2.0, 28.0],
            &self.title,
            TITLE_SIZE,
            Anchor::Middle,
            INK,
        );
        for (index, panel) in self.panels.iter().enumerate() {
            let center = [LEFT + RADIUS + PANEL * index as f64, TOP + RADIUS];
            panel.draw(&mut sheet, center, &scale);
        }
        self.legend(&mut sheet, width, &scale);
        Ok(sheet)
    }

    fn scale(&self) -> Result<Scale, PlotError> {
        let mut largest: Option<f64> = None;
        for panel in &self.panels {
            for &value in panel.rings.iter().flatten() {
                if !value.is_finite() {
                    let place = panel.name.clone();
                    return Err(PlotError::NotFinite { place, value });
                }
                largest = Some(largest.map_or(value, |most| most.max(value)));
            }
        }
        let largest = largest.ok_or(PlotError::Empty)?;
        if self.value.is_logarithmic && largest > 0.0 {
            return Ok(Scale::new(
                &self.value.clone().from_to(DECADES * largest, largest),
                [largest; 2],
            ));
        }
        let linear = Axis {
            is_logarithmic: false,
            ..self.value.clone()
        };
        Ok(Scale::new(&linear, [0.0, largest]))
    }

    fn legend(&self, sheet: &mut Svg, left: f64, scale: &Scale) {
        let (bottom, height) = (TOP + 2.0 * RADIUS, 2.0 * RADIUS);
        for step in 0..BAR_STEPS {
            let [low, high] = [step, step + 1].map(|step| f64::from(step) / f64::from(BAR_STEPS));
            let corners = [
                [left, low],
                [left + BAR_WIDTH, low],
                [left + BAR_WIDTH, high],
                [left, high],
            ];
            let outline = corners
                .map(|[x, part]| [x, bottom - part * height])
                .to_vec();
            fill(sheet, outline, 0.5 * (low + high));
        }
        for (part, label) in scale.ticks() {
            let [x, y] = [left + BAR_WIDTH, bottom - part * height];
            sheet.line([x, y], [x + 5.0, y], &Stroke::new(INK, 1.0));
            sheet.text([x + 9.0, y + 4.0], &label, TICK_SIZE, Anchor::Start, INK);
        }
        sheet.text(
            [left, TOP - 10.0],
            &self.value.label,
            TICK_SIZE,
            Anchor::Start,
            INK,
        );
    }
}

impl HemispherePanel {
    fn draw(&self, sheet: &mut Svg, center: [f64; 2], scale: &Scale) {
        let count = self.rings.len() as f64;
        for (ring, values) in self.rings.iter().enumerate() {
            let ends = [ring as f64 / count, (ring + 1) as f64 / count];
            let step = 360.0 / values.len() as f64;
            for (index, &value) in values.iter().enumerate() {
                let from = step * index as f64;
                let part = if value > 0.0 {
                    scale.position(value).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                fill(sheet, cell(center, ends, [from, from + step]), part);
            }
        }
        graticule(sheet, center);
        let name = [center[0], center[1] - RADIUS - 26.0];
        sheet.text(name, &self.name, TICK_SIZE, Anchor::Middle, INK);
        if let Some([theta, phi]) = self.mark {
            let stroke = Stroke::new("#ffffff", 1.5);
            sheet.circle(at(center, theta / 90.0, phi), 5.0, "#d55e00", Some(&stroke));
        }
    }
}

/// The place at a part of the radius and an azimuth in degrees.
fn at(center: [f64; 2], part: f64, phi: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(phi.to_radians());
    [
        center[0] + RADIUS * part * cos,
        center[1] - RADIUS * part * sin,
    ]
}

fn cell(center: [f64; 2], [inner, outer]: [f64; 2], [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    let middle = 0.5 * (from + to);
    let rim = [
        (inner, from),
        (outer, from),
        (outer, middle),
        (outer, to),
        (inner, to),
        (inner, middle),
    ];
    rim.map(|(part, phi)| at(center, part, phi)).to_vec()
}

fn graticule(sheet: &mut Svg, center: [f64; 2]) {
    for degrees in (CIRCLES..=90).step_by(CIRCLES) {
        let part = degrees as f64 / 90.0;
        let ring: Vec<[f64; 2]> = (0..=90)
            .map(|k| at(center, part, 4.0 * f64::from(k)))
            .collect();
        let colour = if degrees == 90 { INK } else { "#ffffff" };
        sheet.polyline(&ring, &Stroke::new(colour, 0.8));
        let [x, y] = at(center, part, 90.0);
        sheet.text(
            [x + 3.0, y + 12.0],
            &format!("{degrees}°"),
            10.0,
            Anchor::Start,
            "#ffffff",
        );
    }
    for (phi, anchor) in [
        (0.0, Anchor::Start),
        (90.0, Anchor::Middle),
        (180.0, Anchor::End),
        (270.0, Anchor::Middle),
    ] {
        let [x, y] = at(center, 1.04, phi);
        let below = if phi == 270.0 { 10.0 } else { 4.0 };
        sheet.text([x, y + below], &format!("{phi}°"), 10.0, anchor, INK);
    }
}

/// Filled a quarter of a pixel beyond its edges, so that no seam shows.
fn fill(sheet: &mut Svg, outline: Vec<[f64; 2]>, part: f64) {
    let colour = colorous::VIRIDIS.eval_continuous(part.clamp(0.0, 1.0));
    let colour = format!("#{colour:x}");
    sheet.area(&[outline], &colour, 1.0, Some(&Stroke::new(&colour, 0.5)));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(rings: Vec<Vec<f64>>) -> HemisphereMap {
        HemisphereMap {
            title: "Test".to_owned(),
            value: Axis::new("ρ", "1/sr"),
            panels: vec![HemispherePanel {
                name: "panel".to_owned(),
                rings,
                mark: None,
            }],
        }
    }

    #[test]
    fn rings_run_outwards_and_cells_from_the_right() {
        let svg = map(vec![vec![1.0; 4], vec![0.0, 0.0, 1.0, 0.0]])
            .to_svg()
            .unwrap();
        let cells: Vec<&str> = svg
            .lines()
            .filter(|line| line.starts_with("<path"))
            .take(8)
            .collect();
        assert!(
            cells[..4].iter().all(|cell| cell.contains("#fde725")),
            "{cells:?}"
        );
        // The bright cell of the outer ring begins on the left: 185 − 150.
        assert!(
            cells[6].contains("#fde725") && cells[6].contains("35,242"),
            "{}",
            cells[6]
        );
        assert!(cells[4].contains("#440154"));
    }

    #[test]
    fn what_is_no_value_is_refused() {
        assert_eq!(map(vec![]).to_svg(), Err(PlotError::Empty));
        assert!(matches!(
            map(vec![vec![f64::NAN]]).to_svg(),
            Err(PlotError::NotFinite { .. })
        ));
    }
}
