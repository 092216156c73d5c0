//! A picture of luminances as what an observer sees, and the bright things in it.
//!
//! E_v = Σ L cosθ ω ,  L̄ = Σ L ω / Σ ω
//!
//! over the pixels in front of the observer, each taken at its middle.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | L, ω | luminance and solid angle of a pixel | cd/m², sr |
//! | θ | its angle from the line of sight | rad |
//! | E_v | illuminance at the eye, on a plane that faces the view | lx |
//!
//! Bright is what is brighter than a [`Threshold`]. Bright pixels within an angle of one another are one source, directly or by way of others; what is
//! brighter still becomes sources of its own, put together likewise, so that a sun is not mixed with the sky around it. The direction of a
//! source is the mean of its pixels', weighted with Lω. The method and its numbers are those of J. Wienold & J. Christoffersen, Energy and Buildings 38 (2006), with
//! the fixed threshold of C. Pierson, J. Wienold & M. Bodart, LEUKOS 14 (2018).

use super::cluster::clusters;
use super::position_index::{GREATEST_POSITION_INDEX, Gaze};
use super::unified::GlareSource;
use crate::geometry::{Direction, Vector};
use crate::quantity::{Angle, Illuminance, Luminance, SolidAngle};
use crate::sensor::Camera;

/// What someone sees.
#[derive(Clone, Debug)]
pub struct FieldOfView {
    pub(super) gaze: Gaze,
    width: usize,
    pub(super) pixels: Vec<Option<Pixel>>,
}

/// A pixel in front of the observer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixel {
    pub direction: Direction,
    /// ω in sr.
    pub solid_angle: f64,
    /// cosθ ω.
    pub projected: f64,
    /// L in cd/m².
    pub luminance: f64,
    /// Its standard error.
    pub std_error: f64,
}

/// Why a picture is no field of view.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FieldOfViewError {
    /// Not one number a pixel.
    #[error("{found} luminances for a picture of {columns} x {rows} pixels")]
    Count {
        /// Numbers given.
        found: usize,
        /// Columns.
        columns: u32,
        /// Rows.
        rows: u32,
    },
    /// Not a luminance.
    #[error("the pixel in column {column}, row {row} has the luminance {value} cd/m2")]
    Luminance {
        /// From 0 at the left.
        column: usize,
        /// From 0 at the top.
        row: usize,
        /// What it holds.
        value: f64,
    },
    /// Rays of the camera are parallel, or all are behind.
    #[error("no pixel of this projection sees a solid angle")]
    Unseen,
}

/// What counts as a source of glare.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Threshold {
    /// All that is brighter than this.
    Luminance(Luminance),
    /// All that is brighter than this multiple of the mean luminance of the picture.
    TimesMean(f64),
    /// All that is brighter than this multiple of the mean luminance of a task.
    TimesTask {
        /// The multiple.
        factor: f64,
        /// The middle of the task.
        towards: Direction,
        /// The full angle that it fills.
        angle: Angle,
    },
}

/// How sources are found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detection {
    /// What is bright.
    pub threshold: Threshold,
    /// Bright pixels up to this angle apart are one source.
    pub reach: Angle,
    /// What is at least as bright becomes a source of its own.
    pub peak: Option<Luminance>,
}

impl Default for Detection {
    /// 2000 cd/m², .1 rad, 50 000 cd/m².
    fn default() -> Self {
        Self {
            threshold: Threshold::Luminance(Luminance::from_candelas_per_square_metre(2000.0)),
            reach: Angle::from_radians(0.1),
            peak: Some(Luminance::from_candelas_per_square_metre(50_000.0)),
        }
    }
}

/// A source found in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundSource {
    /// Its mean luminance, its solid angle and its position index, at most 16.
    pub source: GlareSource,
    /// Where it is.
    pub direction: Direction,
    /// Its part of E_v.
    pub illuminance: Illuminance,
    /// Its greatest luminance.
    pub greatest: Luminance,
    /// Numbers of its pixels, row by row from the top left.
    pub pixels: Vec<usize>,
}

impl FieldOfView {
    /// From the camera that took a picture and the luminances of its pixels in cd/m², row by row from the top left, with their standard errors
    /// if they are known.
    ///
    /// # Errors
    /// If the numbers do not fit the camera's resolution, one is negative or not finite, or nothing is seen.
    pub fn new(
        camera: &Camera,
        luminances: &[f64],
        std_errors: Option<&[f64]>,
    ) -> Result<Self, FieldOfViewError> {
        let [columns, rows] = camera.resolution;
        let (width, count) = (columns as usize, columns as usize * rows as usize);
        let lengths = [Some(luminances), std_errors].into_iter().flatten();
        if let Some(numbers) = lengths.map(<[f64]>::len).find(|length| *length != count) {
            let found = numbers;
            return Err(FieldOfViewError::Count {
                found,
                columns,
                rows,
            });
        }
        let up = -camera.frame().bitangent();
        let gaze = Gaze::new(camera.frame().normal(), up).ok_or(FieldOfViewError::Unseen)?;
        let mut pixels = Vec::with_capacity(count);
        for (index, &luminance) in luminances.iter().enumerate() {
            let pixel = pixel(camera, gaze, [index % width, index / width], luminance)?;
            let std_error = std_errors.map_or(0.0, |errors| errors[index]);
            pixels.push(pixel.map(|pixel| Pixel { std_error, ..pixel }));
        }
        let view = Self {
            gaze,
            width,
            pixels,
        };
        match view.solid_angle().to_steradians() > 0.0 {
            true => Ok(view),
            false => Err(FieldOfViewError::Unseen),
        }
    }

    pub(super) fn seen(&self) -> impl Iterator<Item = &Pixel> {
        self.pixels.iter().flatten()
    }

    /// Σ ω of what is in front.
    pub fn solid_angle(&self) -> SolidAngle {
        SolidAngle::from_steradians(self.seen().map(|pixel| pixel.solid_angle).sum())
    }

    /// E_v.
    pub fn illuminance(&self) -> Illuminance {
        Illuminance::from_lux(self.seen().map(|p| p.luminance * p.projected).sum())
    }

    /// L̄.
    pub fn mean_luminance(&self) -> Luminance {
        mean_luminance(self.seen())
    }

    /// The sources, in the order in which they are met from the top left.
    pub fn sources(&self, detection: &Detection) -> Vec<FoundSource> {
        let limit = self.limit(detection.threshold);
        let reach = detection.reach.to_radians();
        let peak = detection
            .peak
            .map_or(f64::INFINITY, Luminance::to_candelas_per_square_metre);
        let bright: Vec<usize> = self.brighter(0..self.pixels.len(), |luminance| luminance > limit);
        let mut found = Vec::new();
        for group in self.clusters(&bright, reach) {
            let rest = self.brighter(group.iter().copied(), |luminance| luminance < peak);
            let peaks = self.brighter(group.iter().copied(), |luminance| luminance >= peak);
            let parts = std::iter::once(rest).chain(self.clusters(&peaks, reach));
            found.extend(parts.filter_map(|pixels| self.source(pixels)));
        }
        found
    }

    /// What is bright, in cd/m².
    pub fn limit(&self, threshold: Threshold) -> f64 {
        match threshold {
            Threshold::Luminance(limit) => limit.to_candelas_per_square_metre(),
            Threshold::TimesMean(factor) => {
                factor * self.mean_luminance().to_candelas_per_square_metre()
            }
            Threshold::TimesTask {
                factor,
                towards,
                angle,
            } => {
                let least = (0.5 * angle).cos();
                let task = self
                    .seen()
                    .filter(|pixel| pixel.direction.dot(towards) >= least);
                factor * mean_luminance(task).to_candelas_per_square_metre()
            }
        }
    }

    fn brighter(
        &self,
        pixels: impl Iterator<Item = usize>,
        is_meant: impl Fn(f64) -> bool,
    ) -> Vec<usize> {
        pixels
            .filter(|&index| self.pixels[index].is_some_and(|pixel| is_meant(pixel.luminance)))
            .collect()
    }

    fn clusters(&self, members: &[usize], reach: f64) -> Vec<Vec<usize>> {
        let ahead = self.gaze.forward();
        let direction = |index: usize| self.pixels[index].map_or(ahead, |pixel| pixel.direction);
        clusters(self.width, members, direction, reach)
    }

    /// What these pixels are together; none of no pixels.
    fn source(&self, pixels: Vec<usize>) -> Option<FoundSource> {
        let parts = || pixels.iter().filter_map(|&index| self.pixels[index]);
        let solid_angle = parts().map(|part| part.solid_angle).sum::<f64>();
        let total = parts()
            .map(|part| part.luminance * part.solid_angle)
            .sum::<f64>();
        let weighted =
            |sum: Vector, part: Pixel| sum + part.direction * (part.luminance * part.solid_angle);
        let direction = Direction::new(parts().fold(Vector::ZERO, weighted)).ok()?;
        let index = self.gaze.position_index(direction)?;
        Some(FoundSource {
            source: GlareSource {
                luminance: Luminance::from_candelas_per_square_metre(total / solid_angle),
                solid_angle: SolidAngle::from_steradians(solid_angle),
                position_index: index.min(GREATEST_POSITION_INDEX),
            },
            direction,
            illuminance: Illuminance::from_lux(parts().map(|p| p.luminance * p.projected).sum()),
            greatest: Luminance::from_candelas_per_square_metre(
                parts().map(|part| part.luminance).fold(0.0, f64::max),
            ),
            pixels,
        })
    }
}

/// The pixel, if it sees something in front.
fn pixel(
    camera: &Camera,
    gaze: Gaze,
    [column, row]: [usize; 2],
    luminance: f64,
) -> Result<Option<Pixel>, FieldOfViewError> {
    let film = [column, row].map(|place| place as f64 + 0.5);
    let Some((_, direction)) = camera.ray(film, [0.0; 2]) else {
        return Ok(None);
    };
    let cosine = direction.dot(gaze.forward());
    let solid_angle = camera.solid_angle(film).to_steradians();
    if !(cosine > 0.0 && solid_angle > 0.0 && solid_angle.is_finite()) {
        return Ok(None);
    }
    if !(luminance >= 0.0 && luminance.is_finite()) {
        return Err(FieldOfViewError::Luminance {
            column,
            row,
            value: luminance,
        });
    }
    Ok(Some(Pixel {
        direction,
        solid_angle,
        projected: cosine * solid_angle,
        luminance,
        std_error: 0.0,
    }))
}

fn mean_luminance<'a>(pixels: impl Iterator<Item = &'a Pixel>) -> Luminance {
    let sums = pixels.fold([0.0; 2], |[light, angle], pixel| {
        [
            light + pixel.luminance * pixel.solid_angle,
            angle + pixel.solid_angle,
        ]
    });
    let mean = if sums[1] > 0.0 {
        sums[0] / sums[1]
    } else {
        0.0
    };
    Luminance::from_candelas_per_square_metre(mean)
}

#[cfg(test)]
pub(super) mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::geometry::Point;
    use crate::sensor::{Fisheye, Projection};

    /// Looking along x, z up.
    pub fn camera(mapping: Fisheye, size: u32) -> Camera {
        let projection = Projection::Fisheye {
            mapping,
            fov: Angle::from_degrees(180.0),
        };
        let up = Vector::new(0.0, 0.0, 1.0);
        Camera::new(
            Point::ORIGIN,
            Point::new(1.0, 0.0, 0.0),
            up,
            projection,
            [size; 2],
        )
        .unwrap()
    }

    /// A picture whose luminances are those of directions.
    pub fn picture(camera: &Camera, luminance: impl Fn(Direction) -> f64) -> FieldOfView {
        let size = camera.resolution[0] as usize;
        let of = |index: usize| {
            let film = [index % size, index / size].map(|place| place as f64 + 0.5);
            camera
                .ray(film, [0.0; 2])
                .map_or(0.0, |(_, direction)| luminance(direction))
        };
        let luminances: Vec<f64> = (0..size * size).map(of).collect();
        FieldOfView::new(camera, &luminances, None).unwrap()
    }

    /// Of even luminance L: E_v = πL, L̄ = L, 2π sr. The rim of 200 pixels is off by a part in 200 at most; in an equidistant picture it weighs
    /// nothing for E_v.
    #[test]
    fn even_luminance_fills_the_hemisphere() {
        for mapping in [Fisheye::Equidistant, Fisheye::Equisolid] {
            let view = picture(&camera(mapping, 200), |_| 300.0);
            assert!((view.illuminance().to_lux() / (300.0 * PI) - 1.0).abs() < 1e-3);
            assert!((view.mean_luminance().to_candelas_per_square_metre() - 300.0).abs() < 1e-9);
            assert!((view.solid_angle().to_steradians() / (2.0 * PI) - 1.0).abs() < 5e-3);
        }
    }

    /// A cap of half angle 10°, 30° up: ω = 2π (1 − cos 10°), E = L π sin² 10° cos 30°.
    #[test]
    fn a_disc_is_one_source() {
        let (sin, cos) = libm::sincos(PI / 6.0);
        let middle = Direction::new([cos, 0.0, sin].into()).unwrap();
        let edge = libm::cos(PI / 18.0);
        let view = picture(&camera(Fisheye::Equisolid, 400), |d| {
            if d.dot(middle) > edge {
                10_000.0
            } else {
                100.0
            }
        });
        let found = view.sources(&Detection::default());
        assert_eq!(found.len(), 1);
        let FoundSource {
            source,
            direction,
            illuminance,
            ..
        } = &found[0];
        let solid_angle = source.solid_angle.to_steradians();
        assert!(
            (solid_angle / (2.0 * PI * (1.0 - edge)) - 1.0).abs() < 0.01,
            "{solid_angle}"
        );
        assert!(direction.dot(middle) > 1.0 - 1e-5);
        let expected = 10_000.0 * PI * (1.0 - edge * edge) * cos;
        assert!((illuminance.to_lux() / expected - 1.0).abs() < 0.01);
        let index = Gaze::new(Direction::X, Direction::Z)
            .unwrap()
            .position_index(middle);
        assert!((source.position_index / index.unwrap() - 1.0).abs() < 0.01);
    }

    /// Two discs 4° apart are one source, the brighter one a peak of its own; 40° apart they are two.
    #[test]
    fn near_discs_are_one_and_peaks_stand_out() {
        let at = |degrees: f64| {
            let (sin, cos) = libm::sincos(degrees.to_radians());
            Direction::new([cos, sin, 0.0].into()).unwrap()
        };
        let count = |degrees: f64, bright: f64| {
            let (one, two, edge) = (at(0.0), at(degrees), libm::cos(0.05));
            let view = picture(&camera(Fisheye::Equidistant, 300), |d| match d {
                d if d.dot(one) > edge => 5000.0,
                d if d.dot(two) > edge => bright,
                _ => 50.0,
            });
            view.sources(&Detection::default()).len()
        };
        assert_eq!(
            [
                count(9.0, 4000.0),
                count(9.0, 80_000.0),
                count(40.0, 4000.0)
            ],
            [1, 2, 2]
        );
    }

    #[test]
    fn thresholds_are_relative_if_wanted() {
        let view = picture(&camera(Fisheye::Equisolid, 100), |d| {
            if d.z() > 0.0 { 300.0 } else { 100.0 }
        });
        assert!((view.limit(Threshold::TimesMean(5.0)) - 1000.0).abs() < 1e-9);
        let task = Threshold::TimesTask {
            factor: 4.0,
            towards: Direction::new([1.0, 0.0, -1.0].into()).unwrap(),
            angle: Angle::from_degrees(40.0),
        };
        assert!((view.limit(task) - 400.0).abs() < 1e-9);
    }

    #[test]
    fn pictures_must_fit_their_camera() {
        let camera = camera(Fisheye::Equisolid, 4);
        let count = FieldOfView::new(&camera, &[1.0; 15], None).unwrap_err();
        assert!(
            count
                .to_string()
                .contains("15 luminances for a picture of 4 x 4")
        );
        let mut luminances = [1.0; 16];
        luminances[5] = f64::NAN;
        let error = FieldOfView::new(&camera, &luminances, None).unwrap_err();
        assert!(error.to_string().contains("column 1, row 1"), "{error}");
    }
}
