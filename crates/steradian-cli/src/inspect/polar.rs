//! The intensity of a luminaire as curves around it.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

use steradian::light::Planes;
use steradian_io::import::photometry::{IntensityUnit, Photometry};
use steradian_io::report::numbers::significant;
use steradian_io::report::plot::{Axis, PlotError, PolarCurve, PolarPlot, Zero};

use crate::output;
use crate::status::Failure;

/// Points of a curve to a degree.
const STEPS: i32 = 2;

/// Writes the diagram.
pub fn draw(lamp: &Photometry, path: &Path, file: &Path) -> Result<(), Failure> {
    if lamp.far_field.planes() != Planes::C {
        return Err(Failure::message(
            "--plot draws the planes C0-C180 and C90-C270, which a lamp measured in A or B planes does not have",
        ));
    }
    let plot = diagram(lamp, path);
    let failed = |error: PlotError| Failure::Other(error.into());
    let bytes = match output::is_png(file)? {
        false => plot.to_svg().map_err(failed)?.into_bytes(),
        true => plot.to_png().map_err(failed)?,
    };
    output::write(&bytes, Some(file))
}

fn diagram(lamp: &Photometry, path: &Path) -> PolarPlot {
    let (value, flux_unit) = match lamp.unit {
        IntensityUnit::Candela => (Axis::new("luminous intensity", "cd"), "lm"),
        IntensityUnit::MilliwattPerSteradian => (Axis::new("radiant intensity", "mW/sr"), "mW"),
    };
    let across = curve(lamp, "C0-C180", 0.0);
    let along = PolarCurve {
        dashed: true,
        ..curve(lamp, "C90-C270", FRAC_PI_2)
    };
    let curves = match across.points == along.points {
        true => vec![PolarCurve {
            name: "all planes".into(),
            ..across
        }],
        false => vec![across, along],
    };
    let name = path.file_name().unwrap_or(path.as_os_str());
    PolarPlot {
        title: format!(
            "{}, {} {flux_unit}",
            name.to_string_lossy(),
            significant(lamp.far_field.flux(), 4)
        ),
        value,
        curves,
        arrows: vec![],
        zero: Zero::Below,
    }
}

/// C + 180° to the left, C to the right.
fn curve(lamp: &Photometry, name: &str, azimuth: f64) -> PolarCurve {
    let point = |step: i32| {
        let angle = f64::from(step) / f64::from(STEPS);
        let azimuth = if angle < 0.0 { azimuth + PI } else { azimuth };
        [
            angle,
            lamp.far_field.at_angles(azimuth, angle.abs().to_radians()),
        ]
    };
    PolarCurve {
        name: name.into(),
        points: (-180 * STEPS..=180 * STEPS).map(point).collect(),
        dashed: false,
    }
}
