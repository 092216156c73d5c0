//! Light from everywhere that a picture tells: radiance by direction.
//!
//! The picture holds all directions, azimuth α along its rows and elevation λ along its columns: the middle of its width is seen in a
//! horizontal direction of choice, what is right of it in the picture is right of it in the world, the top row is overhead. Each texel is
//! a patch of constant radiance:
//!
//! ω = Δα (sinλ₁ − sinλ₀),  E₀ = Δα (sin²λ₁ − sin²λ₀)/2 on a horizontal plane that faces up (above the horizon)
//!
//! Directions are drawn by luminance times solid angle, p = Y/Σ Y ω, which is the density of what is looked up: a sample has the weight
//! Σ Y ω in luminance, whatever its direction.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Y | luminance of a texel | 1, times the light's radiance |
//! | ω | solid angle of a texel | sr |
//! | p | density of a sampled direction | 1/sr |
//!
//! Sources: M. Pharr, W. Jakob & G. Humphreys, *Physically Based Rendering* (4th ed. 2023), §12.5; Rec.709 weights: ITU-R BT.709-6, item
//! 3.2.
//!
//! ```
//! use std::sync::Arc;
//! use steradian::geometry::Vector;
//! use steradian::light::EnvironmentMap;
//! use steradian::material::{Bitmap, Texels};
//!
//! // White above, black below: 2π sr, and π on a plane that faces up.
//! let texels = Texels::Float(vec![[1.0; 4], [0.0, 0.0, 0.0, 1.0]]);
//! let picture = Arc::new(Bitmap::new(1, 2, texels)?);
//! let map = EnvironmentMap::new(&picture, Vector::new(0.0, 1.0, 0.0)).unwrap();
//! assert!((map.integral() - 2.0 * std::f64::consts::PI).abs() < 1e-14);
//! assert!((map.horizontal() - std::f64::consts::PI).abs() < 1e-14);
//! # Ok::<(), steradian::material::BitmapError>(())
//! ```

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use thiserror::Error;

use crate::geometry::{Direction, Frame, Vector};
use crate::material::{Bitmap, Interpolation};
use crate::sampling::discrete::Discrete;
use crate::spectrum::REC709_LUMINANCE;

/// Why a picture is no environment.
#[derive(Copy, Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum EnvironmentError {
    /// No texel gives any light.
    #[error("the picture of the environment is black")]
    Black,
    /// Upright, zero or not finite.
    #[error("the middle of the picture is seen in a direction that is not upright")]
    Upright,
}

/// A picture of all directions, and how they are drawn.
#[derive(Clone, Debug)]
pub struct EnvironmentMap {
    picture: Arc<Bitmap>,
    /// Towards the middle of the picture, to its left, and up.
    frame: Frame,
    rows: Discrete,
    columns: Vec<Option<Discrete>>,
    /// ω of a texel, by row.
    patches: Vec<f64>,
    /// sinλ at the lower and the upper border, by row.
    borders: Vec<[f64; 2]>,
    integral: f64,
}

/// Means above which a direction is a peak.
const PEAK: f64 = 4.0;

/// A direction drawn from a map.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct EnvironmentSample {
    /// Towards the light.
    pub direction: Direction,
    /// Column and row of its texel.
    pub texel: [usize; 2],
    /// Density in 1/sr.
    pub pdf: f64,
}

impl EnvironmentMap {
    /// Of a picture whose middle is seen in the direction `middle`, as far as this is horizontal; its texels are not interpolated.
    ///
    /// # Errors
    /// If the picture is black or `middle` upright.
    pub fn new(picture: &Arc<Bitmap>, middle: Vector) -> Result<Self, EnvironmentError> {
        let frame = Frame::from_normal_and_tangent(Direction::Z, middle);
        let frame = frame.ok_or(EnvironmentError::Upright)?;
        let mut picture = Arc::clone(picture);
        if picture.interpolation != Interpolation::Nearest {
            Arc::make_mut(&mut picture).interpolation = Interpolation::Nearest;
        }
        let [width, height] = picture.size().map(|count| count as usize);
        let of_row = |row: usize| -> Vec<f64> {
            let column = |column| luminance(&picture, row * width + column);
            (0..width).map(column).collect()
        };
        let weigh = |row: usize| {
            let weights = of_row(row);
            let solid_angle = patch(&picture, row);
            let sum: f64 = weights.iter().sum();
            (Discrete::new(&weights), solid_angle * sum)
        };
        let (columns, sums): (Vec<_>, Vec<f64>) = (0..height).map(weigh).unzip();
        Ok(Self {
            rows: Discrete::new(&sums).ok_or(EnvironmentError::Black)?,
            integral: sums.iter().sum(),
            columns,
            patches: (0..height).map(|row| patch(&picture, row)).collect(),
            borders: (0..height).map(|row| sines(&picture, row)).collect(),
            frame,
            picture,
        })
    }

    /// The picture.
    pub fn picture(&self) -> &Arc<Bitmap> {
        &self.picture
    }

    /// ∫ Y dω over all directions.
    pub fn integral(&self) -> f64 {
        self.integral
    }

    /// Share of ∫ Y dω in directions brighter than four times the mean: near 0 of skies without sun.
    pub fn peaks(&self) -> f64 {
        let [width, height] = self.picture.size().map(|count| count as usize);
        let bright = PEAK * self.integral / (4.0 * PI);
        let of_row = |row: usize| -> f64 {
            let texels = (0..width).map(|column| luminance(&self.picture, row * width + column));
            self.patches[row] * texels.filter(|texel| *texel > bright).sum::<f64>()
        };
        (0..height).map(of_row).sum::<f64>() / self.integral
    }

    /// ∫ Y cosθ dω of what is above the horizon.
    pub fn horizontal(&self) -> f64 {
        horizontal(&self.picture)
    }

    /// A direction of density p from two uniform numbers; `None` in a row without light, which rounding alone chooses.
    pub fn sample(&self, [u, v]: [f32; 2]) -> Option<EnvironmentSample> {
        let row = self.rows.choose(u);
        let column = self.columns[row.index].as_ref()?.choose(v);
        let [width, _] = self.picture.size().map(f64::from);
        let across = (column.index as f64 + f64::from(column.remapped)) / width - 0.5;
        let [below, above] = self.borders[row.index];
        let up = above + (below - above) * f64::from(row.remapped);
        let ring = (1.0 - up * up).max(0.0).sqrt();
        // To the right of the middle is against the second axis.
        let (sin, cos) = libm::sincos(TAU * across);
        let local = Vector::new(ring * cos, -ring * sin, up);
        let texel = [column.index, row.index];
        Some(EnvironmentSample {
            direction: Direction::from_unit(self.frame.vector_to_world(local)),
            texel,
            pdf: row.probability * column.probability / self.patches[row.index],
        })
    }

    /// Density with which a direction is drawn.
    pub fn pdf(&self, direction: Direction) -> f64 {
        let [column, row] = self.texel(direction);
        let within = self.columns[row].as_ref();
        let chosen = within.map_or(0.0, |columns| columns.probability(column));
        self.rows.probability(row) * chosen / self.patches[row]
    }

    /// Column and row of the texel in a direction.
    pub fn texel(&self, direction: Direction) -> [usize; 2] {
        let local = self.frame.vector_to_local(direction.to_vector());
        let [width, height] = self.picture.size().map(f64::from);
        let azimuth = libm::atan2(-local.y, local.x);
        let elevation = libm::atan2(local.z, libm::hypot(local.x, local.y));
        let column = ((azimuth / TAU + 0.5) * width).floor();
        let row = ((0.5 - elevation / PI) * height).floor();
        // Straight behind is both borders of the picture; the zenith is a border, too.
        let column = if column >= width { 0.0 } else { column };
        [
            column.max(0.0) as usize,
            row.clamp(0.0, height - 1.0) as usize,
        ]
    }

    /// Coordinates of the middle of a texel in the picture.
    pub fn coordinates(&self, [column, row]: [usize; 2]) -> [f32; 2] {
        let [width, height] = self.picture.size().map(f64::from);
        let across = (column as f64 + 0.5) / width;
        let up = 1.0 - (row as f64 + 0.5) / height;
        [across as f32, up as f32]
    }
}

/// ∫ Y cosθ dω of what a picture shows above the horizon, on a plane that faces up.
pub(crate) fn horizontal(picture: &Bitmap) -> f64 {
    let [width, height] = picture.size().map(|count| count as usize);
    let of_row = |row: usize| {
        let [low, high] = sines(picture, row).map(|sine| sine.max(0.0));
        let sum: f64 = (0..width)
            .map(|column| luminance(picture, row * width + column))
            .sum();
        sum * TAU / width as f64 * 0.5 * (high - low) * (high + low)
    };
    (0..height).map(of_row).sum()
}

fn luminance(picture: &Bitmap, index: usize) -> f64 {
    let [r, g, b, _] = picture.texels().at(index).map(f64::from);
    let [red, green, blue] = REC709_LUMINANCE;
    red * r + green * g + blue * b
}

/// sinλ at the lower and the upper border of a row.
fn sines(picture: &Bitmap, row: usize) -> [f64; 2] {
    let height = f64::from(picture.size()[1]);
    let border = |row: usize| libm::cos(PI * row as f64 / height);
    [border(row + 1), border(row)]
}

/// ω of a texel of a row.
fn patch(picture: &Bitmap, row: usize) -> f64 {
    let [below, above] = sines(picture, row);
    TAU / f64::from(picture.size()[0]) * (above - below)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Texels;

    /// Eight columns and five rows of uneven colours, two of them black.
    fn map() -> EnvironmentMap {
        let texel = |k: usize| {
            let part = |m: usize| (((k + 1) * m) % 11) as f32;
            [part(3), part(5), part(7), 1.0]
        };
        let mut texels: Vec<[f32; 4]> = (0..40).map(texel).collect();
        texels[9] = [0.0, 0.0, 0.0, 1.0];
        texels[20] = [0.0, 0.0, 0.0, 1.0];
        let picture = Bitmap::new(8, 5, Texels::Float(texels)).unwrap();
        EnvironmentMap::new(&Arc::new(picture), Vector::new(1.0, 1.0, 0.3)).unwrap()
    }

    #[test]
    fn the_texels_of_a_row_make_up_its_ring() {
        let map = map();
        let whole: f64 = (0..5).map(|row| 8.0 * patch(&map.picture, row)).sum();
        assert!((whole / (4.0 * PI) - 1.0).abs() < 1e-15);
    }

    /// A texel of 100 in a sky of 1 has the share 100 a/(100 a + 4π − a); a sky that is up to three times its mean has no peaks.
    #[test]
    fn a_sun_is_a_peak() {
        let sky = |sun: f32| {
            let texels = (0..40).map(|k| if k == 13 { sun } else { 1.0 });
            let texels = texels.map(|grey| [grey, grey, grey, 1.0]).collect();
            let picture = Bitmap::new(8, 5, Texels::Float(texels)).unwrap();
            EnvironmentMap::new(&Arc::new(picture), Vector::new(1.0, 0.0, 0.0)).unwrap()
        };
        let sunny = sky(100.0);
        let sun = 100.0 * patch(&sunny.picture, 1);
        let share = sun / (sun + 4.0 * PI - 0.01 * sun);
        assert!((sunny.peaks() / share - 1.0).abs() < 1e-12);
        assert_eq!(sky(3.0).peaks(), 0.0);
    }

    /// The middle of the picture is seen towards (1, 1, 0); right of it is clockwise from above.
    #[test]
    fn directions_have_their_texels() {
        let map = map();
        let texel = |x, y, z| map.texel(Direction::new(Vector::new(x, y, z)).unwrap());
        // A little right and left of the middle.
        assert_eq!(texel(1.0, 0.99, 0.0), [4, 2]);
        assert_eq!(texel(0.99, 1.0, 0.0), [3, 2]);
        // A quarter to the right, and to the left.
        assert_eq!(texel(1.0, -1.01, 0.0), [6, 2]);
        assert_eq!(texel(-1.01, 1.0, 0.0), [1, 2]);
        assert_eq!(texel(0.0, 0.0, 1.0)[1], 0);
        assert_eq!(texel(0.1, 0.2, -1.0)[1], 4);
    }

    #[test]
    fn samples_lie_in_their_texels_with_their_density() {
        let map = map();
        let mut inverse = 0.0;
        let count = 64;
        for i in 0..count {
            for j in 0..count {
                let u = [i, j].map(|k| (k as f32 + 0.5) / count as f32);
                let sample = map.sample(u).unwrap();
                assert_eq!(map.texel(sample.direction), sample.texel);
                assert!((map.pdf(sample.direction) / sample.pdf - 1.0).abs() < 1e-12);
                let [column, row] = sample.texel;
                let density = luminance(&map.picture, 8 * row + column) / map.integral;
                assert!((sample.pdf / density - 1.0).abs() < 1e-9);
                inverse += density / (sample.pdf * f64::from(count * count));
            }
        }
        assert!((inverse - 1.0).abs() < 1e-12);
    }

    #[test]
    fn coordinates_show_the_texel() {
        let map = map();
        for texel in [[0, 0], [7, 4], [3, 2]] {
            let [u, v] = map.coordinates(texel).map(f64::from);
            let expected = map.picture.texels().at(8 * texel[1] + texel[0]);
            assert_eq!(map.picture.at([u, v]), expected);
        }
    }

    #[test]
    fn what_is_no_environment_is_refused() {
        let black = Texels::Float(vec![[0.0, 0.0, 0.0, 1.0]; 2]);
        let black = Arc::new(Bitmap::new(2, 1, black).unwrap());
        let north = Vector::new(0.0, 1.0, 0.0);
        let refused = EnvironmentMap::new(&black, north).err();
        assert_eq!(refused, Some(EnvironmentError::Black));
        let upright = EnvironmentMap::new(map().picture(), Vector::new(0.0, 0.0, 2.0));
        assert_eq!(upright.err(), Some(EnvironmentError::Upright));
    }
}
