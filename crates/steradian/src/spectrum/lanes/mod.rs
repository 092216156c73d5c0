//! The meaning of the lanes: what a path carries, what a sensor's columns hold, and how an author's numbers become lanes.
//!
//! A path carries *lanes*, a reading is made of *channels*. In `rgb` and `broadband` the two are the same and both are
//! radiant; in `spectral` a path carries four wavelengths and a channel is ∫ R(λ) L_λ dλ with a response R:
//!
//! | mode | lanes of a path | channels | radiant value | photometric value |
//! |---|---|---|---|---|
//! | `rgb` | R, G, B | R, G, B | Y = .2126 R + .7152 G + .0722 B | K·Y |
//! | `broadband` | bands | bands | Σ bands | K · band `visible` (or `total`) |
//! | `spectral` | L_λ at 4 wavelengths | responses | channel `radiant`, R = 1 | channel `photopic`, R = 683 V(λ) |
//!
//! A light of power P and colour c has the lanes P·c/Y(c) in `rgb`, so that its luminance-weighted mean is P whatever
//! its colour. In `broadband` its power is shared among the bands in proportion to c. In `spectral` its shape s(λ) is
//! scaled so that ∫ s dλ over the wavelengths its watts refer to is P, or 683 ∫ V s dλ its luminous power.
//!
//! Rec.709 weights: ITU-R BT.709-6, item 3.2.

mod error;
mod spectral;

pub use error::LaneError;
use spectral::{
    by_wavelength, check_visible, colour, daylight_mean, emission, scaled_to, unbounded_colour,
};

use std::sync::Arc;

use super::{Action, Beyond, Curve, Grid, LaneValues, VISIBLE, apply, rgb_from_xyz};

/// Lanes of a spectrum.
pub const MAX_LANES: usize = 4;

/// Widest range of wavelengths in nm.
const WIDEST: [f64; 2] = [280.0, 4000.0];

/// Name of the channel with response 1.
pub const RADIANT: &str = "radiant";

/// Luminance of Rec.709's linear primaries (ITU-R BT.709-6, item 3.2).
pub const REC709_LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Lanes of one reflectance or light: `lanes` times the curve at the path's wavelengths.
#[derive(Clone, Debug, PartialEq)]
pub struct LaneCurve {
    /// Where the curve is 1.
    pub lanes: [f64; MAX_LANES],
    /// By wavelength; none if it is the same at all of them, and in modes without wavelengths.
    pub curve: Option<Arc<Curve>>,
}

impl LaneCurve {
    /// The same by wavelength, with other lanes.
    #[must_use]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self {
            lanes: self.lanes.map(f),
            ..self
        }
    }
}

impl From<[f64; MAX_LANES]> for LaneCurve {
    fn from(lanes: [f64; MAX_LANES]) -> Self {
        Self { lanes, curve: None }
    }
}

/// What a sensor's column holds in `spectral`.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// A name, unique in the run.
    pub name: String,
    /// R(λ).
    pub response: Arc<Curve>,
}

/// The meaning of the lanes of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Lanes {
    names: Vec<String>,
    mode: Mode,
}

#[derive(Clone, Debug, PartialEq)]
enum Mode {
    Rgb,
    Bands,
    Spectral {
        grid: Grid,
        responses: Vec<Arc<Curve>>,
    },
}

impl Lanes {
    /// Linear Rec.709.
    pub fn rgb() -> Self {
        Self {
            names: ["red", "green", "blue"].map(String::from).to_vec(),
            mode: Mode::Rgb,
        }
    }

    /// Wavelengths within `range` in nm, read by these channels.
    ///
    /// # Errors
    /// If the range is empty or reaches beyond 280 to 4000 nm.
    pub fn spectral(range: [f64; 2], channels: Vec<Channel>) -> Result<Self, LaneError> {
        let [low, high] = range;
        if !(WIDEST[0] <= low && low < high && high <= WIDEST[1]) {
            return Err(LaneError::Range { range });
        }
        let (names, responses) = channels
            .into_iter()
            .map(|channel| (channel.name, channel.response))
            .unzip();
        let grid = Grid::new(range);
        Ok(Self {
            names,
            mode: Mode::Spectral { grid, responses },
        })
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
            mode: Mode::Bands,
        })
    }

    /// Number of channels: columns of a reading for each light group.
    pub fn count(&self) -> usize {
        self.names.len()
    }

    /// Number of lanes that a path carries.
    pub fn carried(&self) -> usize {
        match self.mode {
            Mode::Spectral { .. } => MAX_LANES,
            _ => self.count(),
        }
    }

    /// The wavelengths of a spectral run.
    pub fn grid(&self) -> Option<&Grid> {
        match &self.mode {
            Mode::Spectral { grid, .. } => Some(grid),
            _ => None,
        }
    }

    /// R(λ) of each channel of a spectral run; empty in other modes.
    pub fn responses(&self) -> &[Arc<Curve>] {
        match &self.mode {
            Mode::Spectral { responses, .. } => responses,
            _ => &[],
        }
    }

    /// Whether the colours of pictures and vertices can be told in the lanes.
    ///
    /// # Errors
    /// If the run has wavelengths that no colour says anything about.
    pub fn check_colours(&self) -> Result<(), LaneError> {
        self.grid().map_or(Ok(()), check_visible)
    }

    /// What a light or an emission of these lanes is in each channel.
    pub fn channels(&self, lanes: [f64; MAX_LANES], curve: Option<&Curve>) -> Vec<f64> {
        let Mode::Spectral { grid, responses } = &self.mode else {
            return lanes[..self.count()].to_vec();
        };
        let channel = |response: &Arc<Curve>| match curve {
            Some(curve) => lanes[0] * curve.product_integral(response, grid.range()),
            None => lanes[0] * response.integral(grid.range()),
        };
        responses.iter().map(channel).collect()
    }

    /// Number of the channel of this name.
    pub fn channel(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Names of the channels.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Whether the lanes are Rec.709 channels.
    pub fn is_rgb(&self) -> bool {
        matches!(self.mode, Mode::Rgb)
    }

    /// Whether paths carry wavelengths.
    pub fn is_spectral(&self) -> bool {
        matches!(self.mode, Mode::Spectral { .. })
    }

    /// Weights of the channels in a radiant value.
    pub fn radiant_weights(&self) -> Vec<f64> {
        match self.mode {
            Mode::Rgb => REC709_LUMINANCE.to_vec(),
            Mode::Bands => vec![1.0; self.count()],
            Mode::Spectral { .. } => self.only(self.channel(RADIANT)),
        }
    }

    /// 1 for one channel, 0 for all others.
    pub fn only(&self, wanted: Option<usize>) -> Vec<f64> {
        (0..self.count())
            .map(|channel| f64::from(u8::from(Some(channel) == wanted)))
            .collect()
    }

    /// Weights of the channels in the part that carries light, to be multiplied by K; `None` if no band does, and in
    /// `spectral`, which has no K.
    pub fn light_weights(&self) -> Option<Vec<f64>> {
        match self.mode {
            Mode::Rgb => return Some(REC709_LUMINANCE.to_vec()),
            Mode::Spectral { .. } => return None,
            Mode::Bands => {}
        }
        let band = self.light_band()?;
        Some(self.only(Some(band)))
    }

    /// True when watts and lumens are linked only by a number the author must give: the one band is `total`.
    pub fn needs_stated_efficacy(&self) -> bool {
        matches!(self.mode, Mode::Bands) && !self.names.iter().any(|name| name == "visible")
    }

    fn light_band(&self) -> Option<usize> {
        let named = |wanted: &str| self.names.iter().position(|name| name == wanted);
        named("visible").or_else(|| named("total"))
    }

    /// Reflectance of each lane, 0 to 1.
    pub fn reflectance(&self, values: &LaneValues) -> Result<LaneCurve, LaneError> {
        let lanes = match (values, self.grid()) {
            (LaneValues::Uniform(_), _) | (_, None) => self.values(values)?.into(),
            (LaneValues::Curve { curve, .. }, Some(_)) => {
                by_wavelength(curve.with_beyond(Beyond::Held))
            }
            (_, Some(grid)) => by_wavelength(colour(values, grid)?),
        };
        let curve = lanes.curve.iter().flat_map(|curve| curve.values());
        let mut all = curve.chain(&lanes.lanes);
        match all.find(|value| !(0.0..=1.0).contains(*value)) {
            Some(&outside) => Err(LaneError::Reflectance(outside)),
            None => Ok(lanes),
        }
    }

    /// A number of at least 0 that is no share of light, such as an index of refraction or an absorption; lanes that the
    /// run does not use have that of the first.
    ///
    /// Of a table, `rgb` has its colour under D65 and the one band that carries light its mean for the eye under D65.
    pub fn coefficient(&self, values: &LaneValues) -> Result<LaneCurve, LaneError> {
        let found: LaneCurve = match (values, self.grid()) {
            (LaneValues::Uniform(value), _) => [*value; MAX_LANES].into(),
            (LaneValues::Curve { curve, .. }, Some(_)) => {
                by_wavelength(curve.with_beyond(Beyond::Held))
            }
            (LaneValues::Curve { curve, .. }, None) => self.mean_under_daylight(curve)?.into(),
            (_, Some(grid)) => unbounded_colour(values, grid)?,
            _ => self.values(values)?.into(),
        };
        let curve = found.curve.iter().flat_map(|curve| curve.values());
        let mut all = curve.chain(&found.lanes);
        match all.find(|value| !(value.is_finite() && **value >= 0.0)) {
            Some(&outside) => Err(LaneError::Coefficient(outside)),
            None => Ok(self.filled(found)),
        }
    }

    fn mean_under_daylight(&self, curve: &Curve) -> Result<[f64; MAX_LANES], LaneError> {
        let xyz = daylight_mean(&curve.with_beyond(Beyond::Held));
        match (&self.mode, self.light_band(), self.count()) {
            (Mode::Rgb, ..) => {
                let [r, g, b] = apply(&rgb_from_xyz(), xyz).map(|lane| lane.max(0.0));
                Ok([r, g, b, r])
            }
            (Mode::Bands, Some(_), 1) => Ok([xyz[1]; MAX_LANES]),
            _ => Err(LaneError::TableNotSpectral),
        }
    }

    fn filled(&self, mut found: LaneCurve) -> LaneCurve {
        let first = found.lanes[0];
        found.lanes[self.carried()..].fill(first);
        found
    }

    /// Lanes of a light of radiant power `power` whose spectrum has this shape.
    pub fn radiant_power(
        &self,
        power: f64,
        shape: Option<&LaneValues>,
    ) -> Result<LaneCurve, LaneError> {
        if let Some(grid) = self.grid() {
            let (curve, watts) = emission(shape, grid)?;
            return scaled_to(power, curve.integral(watts), curve, watts);
        }
        if shape.is_none() && !self.is_rgb() && self.count() > 1 {
            return Err(LaneError::NoShares {
                bands: self.shares(),
            });
        }
        self.scaled(power, shape, &self.radiant_weights())
            .map(LaneCurve::from)
    }

    /// Lanes of a light whose luminous power is `lumens`, with K = `efficacy` in modes without wavelengths.
    pub fn luminous_power(
        &self,
        lumens: f64,
        efficacy: f64,
        shape: Option<&LaneValues>,
    ) -> Result<LaneCurve, LaneError> {
        if let Some(grid) = self.grid() {
            let curve = emission(shape, grid)?.0;
            let per_unit = curve.product_integral(Action::Photopic.weight(), VISIBLE);
            return scaled_to(lumens, per_unit, curve, VISIBLE);
        }
        let weights = self.light_weights().ok_or(LaneError::NoVisibleBand)?;
        if shape.is_none() && !self.is_rgb() {
            return Ok(self
                .by_lane(|lane| weights[lane] * lumens / efficacy)
                .into());
        }
        self.scaled(lumens / efficacy, shape, &weights)
            .map(LaneCurve::from)
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
            LaneValues::Curve { .. } => Err(LaneError::TableNotSpectral),
            LaneValues::Rgb(rgb) if self.is_rgb() => Ok([rgb[0], rgb[1], rgb[2], 0.0]),
            LaneValues::Rgb(_) => Err(LaneError::RgbInBands {
                bands: self.names.join(", "),
            }),
            LaneValues::Bands(_) if self.is_rgb() => Err(LaneError::BandsInRgb),
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
            if lane < self.carried() {
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
                .zip(&power.lanes)
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
            LaneCurve::from([10.0, 0.0, 0.0, 0.0])
        );
        let shape = LaneValues::Bands(vec![("nir".into(), 3.0), ("visible".into(), 1.0)]);
        assert_eq!(
            lanes.radiant_power(8.0, Some(&shape)).unwrap(),
            LaneCurve::from([2.0, 6.0, 0.0, 0.0])
        );
        assert_eq!(
            lanes.luminous_power(179.0, 179.0, Some(&shape)).unwrap(),
            LaneCurve::from([1.0, 3.0, 0.0, 0.0])
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
