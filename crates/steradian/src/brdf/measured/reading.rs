//! How tables of colours become lanes.

use super::to_spectrum;
use crate::quantity::Spectrum;
use crate::spectrum::REC709_LUMINANCE;

/// What the lanes of a run are.
#[derive(Copy, Clone, Debug, Default, PartialEq)]
pub enum Reading {
    /// Red, green and blue of Rec.709; the fourth lane is 0.
    #[default]
    Rgb,
    /// Luminance in every lane.
    Luminance,
    /// Four wavelengths in nm.
    Wavelengths([f64; 4]),
}

impl Reading {
    /// Lanes of a colour; black at wavelengths, which a colour says nothing about.
    pub(super) fn of_colour(self, colour: [f64; 3]) -> Spectrum {
        let [r, g, b] = colour;
        match self {
            Self::Rgb => Spectrum::from_lanes([r as f32, g as f32, b as f32, 0.0]),
            Self::Luminance => to_spectrum(luminance(colour)),
            Self::Wavelengths(_) => Spectrum::ZERO,
        }
    }
}

pub(super) fn luminance(colour: [f64; 3]) -> f64 {
    colour
        .iter()
        .zip(REC709_LUMINANCE)
        .map(|(x, weight)| x * weight)
        .sum()
}
