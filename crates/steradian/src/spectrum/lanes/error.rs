//! What an author's lane values can be wrong about.

use thiserror::Error;

/// What an author's lane values can be wrong about.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum LaneError {
    /// No band, or more than four.
    #[error("1 to 4 bands can be simulated in a run, not {0}")]
    BandCount(usize),
    /// The same band twice.
    #[error("band `{0}` is named twice")]
    DuplicateBand(String),
    /// `[r, g, b]` outside `rgb`.
    #[error("[r, g, b] values need `spectrum = \"rgb\"`; this scene has the bands {bands}")]
    RgbInBands {
        /// The scene's bands.
        bands: String,
    },
    /// Bands in `rgb`.
    #[error("values by band need `spectrum = {{ bands = [...] }}`; this scene is rgb")]
    BandsInRgb,
    /// An unknown band.
    #[error("there is no band `{band}`; the scene's bands are {bands}")]
    UnknownBand {
        /// What was named.
        band: String,
        /// The scene's bands.
        bands: String,
    },
    /// A band without a value.
    #[error("no value for band `{0}`")]
    MissingBand(String),
    /// Reflectance out of range.
    #[error("a reflectance lies between 0 and 1, not {0}")]
    Reflectance(f64),
    /// A number that is not finite, or negative.
    #[error("this number is finite and at least 0, not {0}")]
    Coefficient(f64),
    /// A spectrum that is no spectrum.
    #[error("a spectrum's values are finite, not negative and not all zero")]
    Spectrum,
    /// A colour without luminance for a light given in photometric units.
    #[error("a light given in photometric units needs some power in band `visible`")]
    NoVisiblePower,
    /// A radiometric light with several bands and no spectrum.
    #[error(
        "with several bands a light needs `spectrum = {{ {bands} }}`: the share of its power in each"
    )]
    NoShares {
        /// The scene's bands.
        bands: String,
    },
    /// Lumens where no band carries light.
    #[error("no band of this scene carries light: name one `visible` (or `total`)")]
    NoVisibleBand,
    /// A table outside `spectral`.
    #[error("a table of wavelengths needs `spectrum = \"spectral\"`")]
    TableNotSpectral,
    /// Bands in `spectral`.
    #[error("values by band need `spectrum = {{ bands = [...] }}`; this scene is spectral")]
    BandsInSpectral,
    /// A colour in a range that has more than colours.
    #[error(
        "[r, g, b] says nothing about light outside 360 to 830 nm, and this scene goes from {} to {} nm: give a table", range[0], range[1]
    )]
    RgbBeyondVisible {
        /// The scene's range in nm.
        range: [f64; 2],
    },
    /// A light that has no power where the run has wavelengths.
    #[error("this spectrum is 0 between {} and {} nm", range[0], range[1])]
    NoPower {
        /// The range in nm.
        range: [f64; 2],
    },
    /// A range that is none.
    #[error("wavelengths range from 280 nm to 4000 nm at most, not from {} to {} nm", range[0], range[1])]
    Range {
        /// The range in nm.
        range: [f64; 2],
    },
}
