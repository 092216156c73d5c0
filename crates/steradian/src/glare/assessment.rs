//! All measures of glare of a picture, with the errors that the picture's own errors make.
//!
//! With standard errors σ_i of the pixels, taken as independent, a measure M has
//!
//! σ_M² = Σ (∂M/∂L_i)² σ_i²
//!
//! | measure | ∂/∂L_i, with e_i = cosθ_i ω_i and W = Σ L²ω/p² |
//! |---|---|
//! | E_v | e_i |
//! | L̄ | ω_i / Σ ω |
//! | L_b = (E_v − E_sources)/π | e_i/π outside the sources |
//! | DGP | 5.87·10⁻⁵ e_i + 0.0918/ln 10 · (w_i − 1.87 W e_i/E_v)/(E_v^1.87 + W) |
//! | UGR | 8/ln 10 · (w_i/W − e_i/(π L_b) outside the sources) |
//!
//! with w_i = 2 L ω_i/p² for the pixels of a source of luminance L, 0 for others. Which pixels are bright, and the position index, are held fixed: errors
//! that move a pixel over the threshold are not included, nor that a brighter edge of a wide source moves its place, which is of the size of the edge's own part.

use std::f64::consts::{LN_10, PI};

use super::daylight::{C1, C2, EXPONENT, daylight_glare_index, daylight_glare_probability};
use super::field_of_view::{Detection, FieldOfView, FoundSource};
use super::unified::{GlareSource, unified_glare_rating};
use crate::quantity::Luminance;

/// A measure with its standard error, 0 where the picture has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// The measure.
    pub value: f64,
    /// Its standard error.
    pub std_error: f64,
}

/// What a field of view is like.
#[derive(Clone, Debug, PartialEq)]
pub struct Assessment {
    /// E_v in lx.
    pub illuminance: Figure,
    /// L̄ in cd/m².
    pub mean_luminance: Figure,
    /// L_b in cd/m².
    pub background: Figure,
    /// DGP.
    pub daylight_glare_probability: Figure,
    /// UGR; none without sources or without a background.
    pub unified_glare_rating: Option<Figure>,
    /// DGI, likewise.
    pub daylight_glare_index: Option<f64>,
    /// What is brighter than this, in cd/m², is a source.
    pub threshold: f64,
    /// The sources.
    pub sources: Vec<FoundSource>,
}

/// Sums over the pixels of the squares of derivatives times errors.
#[derive(Default)]
struct Variances {
    illuminance: f64,
    mean: f64,
    background: f64,
    probability: f64,
    rating: f64,
}

impl FieldOfView {
    /// All measures.
    pub fn assess(&self, detection: &Detection) -> Assessment {
        let found = self.sources(detection);
        let sources: Vec<GlareSource> = found.iter().map(|each| each.source).collect();
        let eye = self.illuminance();
        let of_sources: f64 = found.iter().map(|each| each.illuminance.to_lux()).sum();
        let background = ((eye.to_lux() - of_sources) / PI).max(0.0);
        let luminance = Luminance::from_candelas_per_square_metre(background);
        let variances = self.variances(&found, background);
        let figure = |value: f64, variance: f64| Figure {
            value,
            std_error: variance.sqrt(),
        };
        let mean = self.mean_luminance().to_candelas_per_square_metre();
        let probability = daylight_glare_probability(eye, &sources);
        let rating = unified_glare_rating(luminance, &sources);
        Assessment {
            illuminance: figure(eye.to_lux(), variances.illuminance),
            mean_luminance: figure(mean, variances.mean),
            background: figure(background, variances.background),
            daylight_glare_probability: figure(probability, variances.probability),
            unified_glare_rating: rating.map(|rating| figure(rating, variances.rating)),
            daylight_glare_index: daylight_glare_index(luminance, &sources)
                .filter(|_| background > 0.0),
            threshold: self.limit(detection.threshold),
            sources: found,
        }
    }

    fn variances(&self, found: &[FoundSource], background: f64) -> Variances {
        let eye = self.illuminance().to_lux();
        let total = self.solid_angle().to_steradians();
        let weight: f64 = found.iter().map(|each| each.source.weight()).sum();
        let power = libm::pow(eye, EXPONENT);
        let slopes = self.slopes(found);
        let mut sums = Variances::default();
        for (pixel, slope) in self.pixels.iter().zip(slopes) {
            let Some(pixel) = pixel.filter(|pixel| pixel.std_error > 0.0) else {
                continue;
            };
            let variance = pixel.std_error * pixel.std_error;
            let add = |sum: &mut f64, derivative: f64| *sum += derivative * derivative * variance;
            let e = pixel.projected;
            let outside = if slope.is_some() { 0.0 } else { e };
            let w = slope.unwrap_or(0.0);
            add(&mut sums.illuminance, e);
            add(&mut sums.mean, pixel.solid_angle / total);
            add(&mut sums.background, outside / PI);
            let contrast = (w - EXPONENT * weight * e / eye) / (power + weight);
            add(&mut sums.probability, C1 * e + C2 / LN_10 * contrast);
            if weight > 0.0 && background > 0.0 {
                let relative = w / weight - outside / (PI * background);
                add(&mut sums.rating, 8.0 / LN_10 * relative);
            }
        }
        sums
    }

    /// w_i of the pixels of sources.
    fn slopes(&self, found: &[FoundSource]) -> Vec<Option<f64>> {
        let mut slopes = vec![None; self.pixels.len()];
        for FoundSource { source, pixels, .. } in found {
            let index = source.position_index;
            let slope = 2.0 * source.luminance.to_candelas_per_square_metre() / (index * index);
            for &pixel in pixels {
                slopes[pixel] = self.pixels[pixel].map(|pixel| slope * pixel.solid_angle);
            }
        }
        slopes
    }
}

#[cfg(test)]
mod tests {
    use super::super::field_of_view::tests::camera;
    use super::*;
    use crate::geometry::Direction;
    use crate::sensor::Fisheye;

    /// 30 × 30 pixels with a bright disc; `more` is added to the pixel of this number.
    fn view(changed: usize, more: f64, std_error: f64) -> FieldOfView {
        let camera = camera(Fisheye::Equisolid, 30);
        let disc = Direction::new([1.0, 0.2, 0.3].into()).unwrap();
        let luminance = |index: usize| {
            let film = [index % 30, index / 30].map(|place| place as f64 + 0.5);
            let direction = camera.ray(film, [0.0; 2]).map(|(_, direction)| direction);
            let bright = direction.is_some_and(|direction| direction.dot(disc) > 0.95);
            let base = if bright { 20_000.0 } else { 200.0 };
            base + if index == changed { more } else { 0.0 }
        };
        let luminances: Vec<f64> = (0..900).map(luminance).collect();
        let mut errors = vec![0.0; 900];
        errors[changed] = std_error;
        FieldOfView::new(&camera, &luminances, Some(&errors)).unwrap()
    }

    /// The error of one pixel moves each measure as a change of its luminance does: differences over ± 1 cd/m² of 200 or 20 000 are off by a
    /// relative (1/200)² at most. The position index is held fixed: of a pixel 2° aside of the source's place that is 10 % of UGR's derivative.
    #[test]
    fn errors_are_derivatives() {
        let detection = Detection::default();
        for (pixel, change) in [(2 * 30 + 15, 1.0), (11 * 30 + 13, 1.0), (20 * 30 + 20, 1.0)] {
            let [low, high] =
                [-change, change].map(|more| view(pixel, more, 0.0).assess(&detection));
            let found = view(pixel, 0.0, change).assess(&detection);
            let check = |of: &dyn Fn(&Assessment) -> Figure, tolerance: f64| {
                let expected = 0.5 * (of(&high).value - of(&low).value).abs();
                let error = of(&found).std_error;
                assert!(
                    (error - expected).abs() <= tolerance * expected + 1e-11,
                    "{pixel}: {error}, {expected}"
                );
            };
            check(&|all| all.illuminance, 1e-9);
            check(&|all| all.mean_luminance, 1e-9);
            check(&|all| all.background, 1e-9);
            check(&|all| all.daylight_glare_probability, 0.05);
            check(&|all| all.unified_glare_rating.unwrap(), 0.12);
        }
    }

    /// A picture without sources has no rating, and without errors no error.
    #[test]
    fn dim_pictures_have_no_rating() {
        let camera = camera(Fisheye::Equisolid, 20);
        let view = FieldOfView::new(&camera, &[100.0; 400], None).unwrap();
        let found = view.assess(&Detection::default());
        assert_eq!(found.unified_glare_rating, None);
        assert_eq!(found.daylight_glare_index, None);
        assert_eq!(found.daylight_glare_probability.std_error, 0.0);
        let expected = 0.16 + C1 * found.illuminance.value;
        assert!((found.daylight_glare_probability.value - expected).abs() < 1e-15);
    }
}
