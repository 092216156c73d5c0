//! An object tilted until it is seen edge-on.

use serde_json::json;
use steradian::geometry::{Direction, Frame, Point, Polygon, Vector, solid_angle};
use steradian::quantity::{Angle, Area, Length, SolidAngle};
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::{exact, significant};
use steradian_io::report::plot::{Axis, LinePlot, PlotError, Series};

use super::object::Object;
use crate::status::Failure;
use crate::values;

const STEPS: u32 = 18;

/// A range of tilts.
pub struct Sweep {
    ends: [Angle; 2],
}

/// The object at one tilt.
pub struct Row {
    tilt: Angle,
    projected_area: Area,
    approximation: SolidAngle,
    exact: SolidAngle,
}

/// A flat object with the middle around which it turns.
struct Flat<'a> {
    object: &'a Object,
    center: Point,
    frame: Frame,
    area: Area,
}

impl Sweep {
    /// `tilt` and `0:90deg`.
    pub fn parse(words: &[String]) -> Result<Self, Failure> {
        match words {
            [what, range] if what == "tilt" => Ok(Self {
                ends: values::angles(range).map_err(Failure::message)?,
            }),
            _ => Err(Failure::message(
                "expected --sweep tilt FROM:TO such as --sweep tilt 0:90deg",
            )),
        }
    }

    /// The object at even steps of tilt.
    pub fn rows(&self, object: &Object, observer: Point) -> Result<Vec<Row>, Failure> {
        let flat = Flat::new(object)?;
        let towards = Direction::new(observer - flat.center).map_err(|_| {
            Failure::message(
                "the observer is in the middle of the object, so that no tilt faces it",
            )
        })?;
        let [from, to] = self.ends;
        let tilt = |step| from + (to - from) * (f64::from(step) / f64::from(STEPS));
        Ok((0..=STEPS)
            .map(|step| flat.tilted(tilt(step), observer, towards))
            .collect())
    }
}

impl<'a> Flat<'a> {
    fn new(object: &'a Object) -> Result<Self, Failure> {
        let (center, normal, area) = match object {
            Object::Disc {
                center,
                normal,
                radius,
            } => (*center, *normal, radius.squared() * std::f64::consts::PI),
            Object::Ellipse {
                center,
                half_axes: [u, v],
            } => {
                let product = u.cross(*v);
                let normal = Direction::new(product)
                    .map_err(|_| Failure::message("the ellipse has no area"))?;
                (
                    *center,
                    normal,
                    Area::from_square_metres(std::f64::consts::PI * product.length()),
                )
            }
            Object::Polygon(outline) => {
                let polygon = Polygon::new(outline.clone(), Vec::new())
                    .map_err(|error| Failure::Other(error.into()))?;
                (centroid(&polygon), polygon.normal(), polygon.area())
            }
            _ => {
                let flat = "discs, ellipses, rectangles, triangles and polygons";
                return Err(Failure::message(format!(
                    "--sweep tilt is for flat objects: {flat}"
                )));
            }
        };
        Ok(Self {
            object,
            center,
            frame: Frame::from_normal(normal),
            area,
        })
    }

    /// Turned to the observer and then by the tilt around its own first axis.
    fn tilted(&self, tilt: Angle, observer: Point, towards: Direction) -> Row {
        let facing = Frame::from_normal(towards);
        let turned = |vector: Vector| {
            let local = self.frame.vector_to_local(vector);
            let (y, z) = (
                local.y * tilt.cos() - local.z * tilt.sin(),
                local.y * tilt.sin() + local.z * tilt.cos(),
            );
            facing.vector_to_world(Vector::new(local.x, y, z))
        };
        let exact = match self.object {
            Object::Disc { normal, radius, .. } => {
                let normal = Direction::new(turned((*normal).into())).unwrap_or(towards);
                solid_angle::of_disc(observer, self.center, normal, *radius)
            }
            Object::Ellipse { half_axes, .. } => {
                solid_angle::of_ellipse(observer, self.center, half_axes.map(turned))
            }
            Object::Polygon(outline) => {
                let corners: Vec<Point> = outline
                    .iter()
                    .map(|&corner| self.center + turned(corner - self.center))
                    .collect();
                solid_angle::of_polygon(observer, &corners)
            }
            _ => SolidAngle::ZERO,
        };
        let projected_area = self.area * tilt.cos().abs();
        let distance: Length = observer.distance(self.center);
        let approximation = SolidAngle::of_patch(projected_area, distance);
        Row {
            tilt,
            projected_area,
            approximation,
            exact,
        }
    }
}

/// The middle of the area.
fn centroid(polygon: &Polygon) -> Point {
    let origin = polygon.vertices()[0];
    let weighted = polygon.triangle_corners().map(|[a, b, c]| {
        let area = (b - a).cross(c - a).length() / 2.0;
        ((a - origin) + (b - origin) + (c - origin)) * (area / 3.0)
    });
    let sum = weighted.fold(Vector::ZERO, |sum, part| sum + part);
    origin + sum / polygon.area().to_square_metres()
}

/// The rows as text.
pub fn table(rows: &[Row]) -> String {
    let mut columns = Columns::new(["tilt (deg)", "A cosθ (m2)", "A cosθ/r² (sr)", "exact (sr)"]);
    for row in rows {
        columns.row([
            significant(row.tilt.to_degrees(), 6),
            exact(rounded(row.projected_area.to_square_metres())),
            exact(rounded(row.approximation.to_steradians())),
            exact(rounded(row.exact.to_steradians())),
        ]);
    }
    columns.to_string()
}

/// 0 for what is nothing but the rounding of a right angle.
fn rounded(value: f64) -> f64 {
    if value.abs() < 1e-15 { 0.0 } else { value }
}

/// The rows for programs.
pub fn json(rows: &[Row]) -> String {
    let row = |row: &Row| {
        json!({
            "tilt": { "value": row.tilt.to_radians(), "unit": "rad" },
            "projected_area": { "value": row.projected_area.to_square_metres(), "unit": "m2" },
            "approximation": { "value": row.approximation.to_steradians(), "unit": "sr" },
            "exact": super::closed_form(row.exact.to_steradians()),
        })
    };
    let object = json!({ "rows": rows.iter().map(row).collect::<Vec<_>>() });
    format!("{object:#}\n")
}

/// The curves of both solid angles.
pub fn plot(rows: &[Row]) -> Result<String, PlotError> {
    let curve = |value: fn(&Row) -> SolidAngle| {
        rows.iter()
            .map(move |row| [row.tilt.to_degrees(), value(row).to_steradians()])
            .collect::<Vec<_>>()
    };
    let ends = [&rows[0], &rows[rows.len() - 1]].map(|row| row.tilt.to_degrees());
    let tilt = Axis::new("tilt", "°").tick_every(15.0);
    let tilt = if ends[0] < ends[1] {
        tilt.from_to(ends[0], ends[1])
    } else {
        tilt
    };
    LinePlot::new(
        "Solid angle of a tilted object",
        tilt,
        Axis::new("solid angle", "sr"),
    )
    .with(Series::new("exact", curve(|row| row.exact)))
    .with(Series::new("A cosθ/r²", curve(|row| row.approximation)).dashed())
    .to_svg()
}
