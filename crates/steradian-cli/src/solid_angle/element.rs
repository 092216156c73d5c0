//! The small patch dA cosθ/r² beside the exact solid angle, as the patch grows.

use serde_json::json;
use steradian::geometry::{Direction, Point, SurfaceElement, Vector, solid_angle};
use steradian::quantity::{Area, Length, SolidAngle};
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::{exact, significant};

use crate::status::Failure;
use crate::values;

/// How often the patch grows fourfold.
const STEPS: i32 = 8;

/// A patch by place, normal and area.
#[derive(Clone, Copy, Debug)]
pub struct Element(SurfaceElement);

/// The patch at one size.
pub struct Row {
    area: Area,
    radius: Length,
    distance: Length,
    approximation: SolidAngle,
    exact: SolidAngle,
}

impl Element {
    /// `X,Y,Z,NX,NY,NZ,DA`.
    pub fn parse(text: &str) -> Result<Self, String> {
        let [x, y, z, nx, ny, nz, area] = values::numbers(text)?;
        if area <= 0.0 {
            return Err(format!(
                "the area of the patch must be positive, not {area}"
            ));
        }
        Ok(Self(SurfaceElement {
            position: Point::new(x, y, z),
            normal: Direction::new(Vector::new(nx, ny, nz)).map_err(|error| error.to_string())?,
            area: Area::from_square_metres(area),
        }))
    }

    /// The patch and larger ones, each four times the area of the one before.
    pub fn growing(&self, observer: Point) -> Result<Vec<Row>, Failure> {
        if self.0.normal.dot(observer - self.0.position) <= 0.0 {
            return Err(Failure::message(
                "the patch shows its back or its edge to the observer; turn its normal",
            ));
        }
        Ok((0..=STEPS)
            .map(|step| self.grown(observer, libm::pow(4.0, f64::from(step))))
            .collect())
    }

    fn grown(&self, observer: Point, factor: f64) -> Row {
        let element = SurfaceElement {
            area: self.0.area * factor,
            ..self.0
        };
        let radius =
            Length::from_metres((element.area.to_square_metres() / std::f64::consts::PI).sqrt());
        Row {
            area: element.area,
            radius,
            distance: element.position.distance(observer),
            approximation: element.solid_angle_from(observer),
            exact: solid_angle::of_disc(observer, element.position, element.normal, radius),
        }
    }
}

impl Row {
    fn ratio(&self) -> f64 {
        self.approximation / self.exact
    }
}

/// The rows as text.
pub fn table(rows: &[Row]) -> String {
    let headings = [
        "area (m2)",
        "radius/distance",
        "dA cosθ/r² (sr)",
        "disc, exact (sr)",
        "ratio",
        "error (%)",
    ];
    let mut columns = Columns::new(headings);
    for row in rows {
        columns.row([
            exact(row.area.to_square_metres()),
            significant(row.radius / row.distance, 4),
            exact(row.approximation.to_steradians()),
            exact(row.exact.to_steradians()),
            significant(row.ratio(), 8),
            significant(100.0 * (row.ratio() - 1.0), 4),
        ]);
    }
    format!(
        "{columns}\nThe error grows with the square of radius/distance, fourfold from row to row, while the patch is small.\n"
    )
}

/// The rows for programs.
pub fn json(rows: &[Row]) -> String {
    let row = |row: &Row| {
        json!({
            "area": { "value": row.area.to_square_metres(), "unit": "m2" },
            "radius_over_distance": row.radius / row.distance,
            "approximation": { "value": row.approximation.to_steradians(), "unit": "sr" },
            "exact": super::closed_form(row.exact.to_steradians()),
            "ratio": row.ratio(),
        })
    };
    let object = json!({ "shape": "disc", "rows": rows.iter().map(row).collect::<Vec<_>>() });
    format!("{object:#}\n")
}
