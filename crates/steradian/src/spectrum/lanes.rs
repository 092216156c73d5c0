//! The meaning of the lanes: names, weights of a reading, and the way an author's numbers become lanes.
//!
//! Lanes are always radiant. A photometric value is K times the light-carrying part of the lanes:
//!
//! | mode | radiant value | photometric value |
//! |---|---|---|
//! | `rgb` | Y = .2126 R + .7152 G + .0722 B | K·Y |
//! | `broadband` | Σ bands | K · band `visible` (or `total`) |
//!
//! A light of power P and colour c has the lanes P·c/Y(c) in `rgb`, so that its luminance-weighted mean is P whatever
//! its colour. In `broadband` its power is shared among the bands in proportion to c.
//!
//! Rec.709 weights: ITU-R BT.709-6, item 3.2.

use thiserror::Error;

use super::LaneValues;

/// Lanes of a spectrum.
pub const MAX_LANES: usize = 4;

/// Luminance weights of linear Rec.709.
const REC709: [f64; 3] = [0.2126, 0.7152, 0.0722];

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
}

/// The meaning of the lanes of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Lanes {
    names: Vec<String>,
    rgb: bool,
}

impl Lanes {
    /// Linear Rec.709.
    pub fn rgb() -> Self {
        Self {
            names: ["red", "green", "blue"].map(String::from).to_vec(),
            rgb: true,
        }
    }

    /// Named bands.
    pub fn broadband(bands: &[String]) -> Result<Self, LaneError> {
        if bands.is_empty() || bands.len() > MAX_LANES {
            return Err(LaneError::BandCount(bands.len()));
        }
        if let Some(twice) = bands
            .iter()
            .enumerate()
            .find(|(i, band)| bands[..*i].contains(band))
        {
            return Err(LaneError::DuplicateBand(twice.1.clone()));
        }
        Ok(Self {
            names: bands.to_vec(),
            rgb: false,
        })
    }

    /// Number of lanes in use.
    pub fn count(&self) -> usize {
        self.names.len()
    }

    /// Names of the lanes.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Whether the lanes are Rec.709 channels.
    pub fn is_rgb(&self) -> bool {
        self.rgb
    }

    /// Weights of the lanes in a radiant value.
    pub fn radiant_weights(&self) -> Vec<f64> {
        if self.rgb {
            REC709.to_vec()
        } else {
            vec![1.0; self.count()]
        }
    }

    /// Weights of the lanes in the part that carries light (to be multiplied by K); `None` if no band does.
    pub fn light_weights(&self) -> Option<Vec<f64>> {
        if self.rgb {
            return Some(REC709.to_vec());
        }
        let band = self.light_band()?;
        Some(
            (0..self.count())
                .map(|lane| f64::from(u8::from(lane == band)))
                .collect(),
        )
    }

    /// True when watts and lumens are linked only by a number the author must give: the one band is `total`.
    pub fn needs_stated_efficacy(&self) -> bool {
        !self.rgb && !self.names.iter().any(|name| name == "visible")
    }

    fn light_band(&self) -> Option<usize> {
        let named = |wanted: &str| self.names.iter().position(|name| name == wanted);
        named("visible").or_else(|| named("total"))
    }

    /// Reflectance of each lane, 0 to 1.
    pub fn reflectance(&self, values: &LaneValues) -> Result<[f64; MAX_LANES], LaneError> {
        let lanes = self.values(values)?;
        match lanes.iter().find(|value| !(0.0..=1.0).contains(*value)) {
            Some(&outside) => Err(LaneError::Reflectance(outside)),
            None => Ok(lanes),
        }
    }

    /// Lanes of a light of radiant power `power` whose spectrum has this shape.
    pub fn radiant_power(
        &self,
        power: f64,
        shape: Option<&LaneValues>,
    ) -> Result<[f64; MAX_LANES], LaneError> {
        if shape.is_none() && !self.rgb && self.count() > 1 {
            return Err(LaneError::NoShares {
                bands: self.shares(),
            });
        }
        self.scaled(power, shape, &self.radiant_weights())
    }

    /// Lanes of a light whose luminous power is `lumens`, with K = `efficacy`.
    pub fn luminous_power(
        &self,
        lumens: f64,
        efficacy: f64,
        shape: Option<&LaneValues>,
    ) -> Result<[f64; MAX_LANES], LaneError> {
        let weights = self.light_weights().ok_or(LaneError::NoVisibleBand)?;
        if shape.is_none() && !self.rgb {
            return Ok(self.by_lane(|lane| weights[lane] * lumens / efficacy));
        }
        self.scaled(lumens / efficacy, shape, &weights)
    }

    fn scaled(
        &self,
        power: f64,
        shape: Option<&LaneValues>,
        weights: &[f64],
    ) -> Result<[f64; MAX_LANES], LaneError> {
        let white = LaneValues::Uniform(1.0);
        let shape = self.values(shape.unwrap_or(&white))?;
        let valid = shape.iter().all(|value| value.is_finite() && *value >= 0.0);
        if !valid || shape.iter().all(|value| *value == 0.0) {
            return Err(LaneError::Spectrum);
        }
        let weighted: f64 = weights.iter().zip(&shape).map(|(w, x)| w * x).sum();
        if weighted == 0.0 {
            return Err(LaneError::NoVisiblePower);
        }
        Ok(shape.map(|value| power * value / weighted))
    }

    fn values(&self, values: &LaneValues) -> Result<[f64; MAX_LANES], LaneError> {
        match values {
            LaneValues::Uniform(value) => Ok(self.by_lane(|_| *value)),
            LaneValues::Rgb(rgb) if self.rgb => Ok([rgb[0], rgb[1], rgb[2], 0.0]),
            LaneValues::Rgb(_) => Err(LaneError::RgbInBands {
                bands: self.names.join(", "),
            }),
            LaneValues::Bands(_) if self.rgb => Err(LaneError::BandsInRgb),
            LaneValues::Bands(bands) => self.by_band(bands),
        }
    }

    fn by_band(&self, bands: &[(String, f64)]) -> Result<[f64; MAX_LANES], LaneError> {
        if let Some((band, _)) = bands.iter().find(|(band, _)| !self.names.contains(band)) {
            return Err(LaneError::UnknownBand {
                band: band.clone(),
                bands: self.names.join(", "),
            });
        }
        let mut lanes = [0.0; MAX_LANES];
        for (lane, name) in self.names.iter().enumerate() {
            let given = bands.iter().find(|(band, _)| band == name);
            lanes[lane] = given.ok_or_else(|| LaneError::MissingBand(name.clone()))?.1;
        }
        Ok(lanes)
    }

    fn by_lane(&self, value: impl Fn(usize) -> f64) -> [f64; MAX_LANES] {
        std::array::from_fn(|lane| {
            if lane < self.count() {
                value(lane)
            } else {
                0.0
            }
        })
    }

    fn shares(&self) -> String {
        self.names
            .iter()
            .map(|name| format!("{name} = …"))
            .collect::<Vec<_>>()
            .join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bands(names: &[&str]) -> Lanes {
        Lanes::broadband(
            &names
                .iter()
                .map(|name| name.to_string())
                .collect::<Vec<_>>(),
        )
        .unwrap()
    }

    #[test]
    fn rgb_power_does_not_depend_on_colour() {
        let lanes = Lanes::rgb();
        for colour in [[1.0, 1.0, 1.0], [0.2, 0.5, 0.9], [1.0, 0.0, 0.0]] {
            let power = lanes
                .radiant_power(7.0, Some(&LaneValues::Rgb(colour)))
                .unwrap();
            let value: f64 = lanes
                .radiant_weights()
                .iter()
                .zip(&power)
                .map(|(w, x)| w * x)
                .sum();
            assert!((value - 7.0).abs() < 1e-14 * 7.0);
        }
    }

    #[test]
    fn lumens_fill_the_visible_band_and_watts_are_shared() {
        let lanes = bands(&["visible", "nir"]);
        assert_eq!(
            lanes.luminous_power(1790.0, 179.0, None).unwrap(),
            [10.0, 0.0, 0.0, 0.0]
        );
        let shape = LaneValues::Bands(vec![("nir".into(), 3.0), ("visible".into(), 1.0)]);
        assert_eq!(
            lanes.radiant_power(8.0, Some(&shape)).unwrap(),
            [2.0, 6.0, 0.0, 0.0]
        );
        assert_eq!(
            lanes.luminous_power(179.0, 179.0, Some(&shape)).unwrap(),
            [1.0, 3.0, 0.0, 0.0]
        );
        assert_eq!(lanes.light_weights(), Some(vec![1.0, 0.0]));
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let two = bands(&["visible", "nir"]);
        assert!(matches!(
            two.radiant_power(1.0, None),
            Err(LaneError::NoShares { .. })
        ));
        assert!(matches!(
            two.reflectance(&LaneValues::Rgb([0.5; 3])),
            Err(LaneError::RgbInBands { .. })
        ));
        assert_eq!(
            two.reflectance(&LaneValues::Uniform(1.2)),
            Err(LaneError::Reflectance(1.2))
        );
        assert!(two.reflectance(&LaneValues::Uniform(f64::NAN)).is_err());
        let missing = LaneValues::Bands(vec![("nir".into(), 0.1)]);
        assert_eq!(
            two.reflectance(&missing),
            Err(LaneError::MissingBand("visible".into()))
        );
        assert_eq!(
            bands(&["uv"]).luminous_power(1.0, 179.0, None),
            Err(LaneError::NoVisibleBand)
        );
        assert_eq!(Lanes::broadband(&[]), Err(LaneError::BandCount(0)));
    }
}
