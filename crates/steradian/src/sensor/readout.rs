//! Which quantities a sensor reports, in which unit, and how they are read from the lanes.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::spectrum::{Curve, Lanes};

/// Which quantity a sensor reports.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Response {
    /// Photometric when every light is given photometrically, radiant when every light is given radiometrically, else both.
    #[default]
    Auto,
    /// Watts.
    Radiant,
    /// Lumens.
    Photopic,
    /// Lumens of the eye adapted to the dark, 1700 V′(λ) (only in `spectral`, as all that follow).
    Scotopic,
    /// CIE 1931 tristimulus values, scaled so that Y is photometric.
    Xyz,
    /// Photons from 400 to 700 nm, in µmol.
    Par,
    /// Melanopic watts (CIE S 026), and the equivalent daylight.
    Melanopic,
    /// Watts weighted by a table.
    Table {
        /// What it is called.
        name: String,
        /// The weights.
        curve: Arc<Curve>,
    },
}

/// Intervals of wavelength that are read one by one.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Bins {
    /// First and last wavelength in nm.
    pub range: [f64; 2],
    /// Width of an interval in nm; divides the range evenly.
    pub width: f64,
    /// Mean per nm in each interval, instead of the total.
    pub per_nm: bool,
}

/// How one quantity is read from the lanes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Readout {
    /// The field's name, e.g. `irradiance`.
    pub name: String,
    /// The SI unit, e.g. `W/m2`.
    pub unit: String,
    /// The value is Σ weight · lane.
    pub weights: Vec<f64>,
    /// What a channel reports is factor · lane.
    pub channel_factor: f64,
    /// Whether the unit is photometric.
    pub photometric: bool,
}

/// Radiant and photometric name and unit of what a sensor measures.
#[derive(Copy, Clone, Debug)]
pub(crate) struct Names {
    pub radiant: (&'static str, &'static str),
    pub photometric: (&'static str, &'static str),
}

pub(crate) const IRRADIANCE: Names = Names {
    radiant: ("irradiance", "W/m2"),
    photometric: ("illuminance", "lx"),
};
pub(crate) const SCALAR: Names = Names {
    radiant: ("scalar irradiance", "W/m2"),
    photometric: ("scalar illuminance", "lx"),
};
pub(crate) const CYLINDRICAL: Names = Names {
    radiant: ("cylindrical irradiance", "W/m2"),
    photometric: ("cylindrical illuminance", "lx"),
};
pub(crate) const SEMICYLINDRICAL: Names = Names {
    radiant: ("semicylindrical irradiance", "W/m2"),
    photometric: ("semicylindrical illuminance", "lx"),
};
pub(crate) const RADIANCE: Names = Names {
    radiant: ("radiance", "W/(m2 sr)"),
    photometric: ("luminance", "cd/m2"),
};
pub(crate) const FLUX: Names = Names {
    radiant: ("flux", "W"),
    photometric: ("luminous flux", "lm"),
};
pub(crate) const MEAN_INCIDENT: Names = Names {
    radiant: ("mean irradiance", "W/m2"),
    photometric: ("mean illuminance", "lx"),
};
pub(crate) const MEAN_LEAVING: Names = Names {
    radiant: ("mean exitance", "W/m2"),
    photometric: ("mean luminous exitance", "lm/m2"),
};
pub(crate) const MEAN_EMITTED: Names = Names {
    radiant: ("mean emitted exitance", "W/m2"),
    photometric: ("mean emitted luminous exitance", "lm/m2"),
};
pub(crate) const MEAN_ABSORBED: Names = Names {
    radiant: ("mean absorbed irradiance", "W/m2"),
    photometric: ("mean absorbed illuminance", "lx"),
};
pub(crate) const MEAN_NET: Names = Names {
    radiant: ("mean net irradiance", "W/m2"),
    photometric: ("mean net illuminance", "lx"),
};

/// The readouts of a quantity, radiant before photometric; `scale` divides an area away or is 1.
///
/// `efficacy` is K in lm/W.
pub fn readouts(
    lanes: &Lanes,
    names: impl Into<Quantity>,
    radiant: bool,
    photometric: bool,
    efficacy: f64,
) -> Vec<Readout> {
    let quantity: Quantity = names.into();
    let mut all = Vec::new();
    if radiant {
        all.push(quantity.readout(quantity.names.radiant, lanes.radiant_weights(), 1.0, false));
    }
    if let (true, Some(weights)) = (photometric, lanes.light_weights()) {
        all.push(quantity.readout(quantity.names.photometric, weights, efficacy, true));
    }
    all
}

/// Names with a scale.
#[derive(Copy, Clone, Debug)]
pub struct Quantity {
    names: Names,
    scale: f64,
}

impl From<Names> for Quantity {
    fn from(names: Names) -> Self {
        Self { names, scale: 1.0 }
    }
}

impl Names {
    /// The mean over an area: every number divided by it.
    pub(crate) fn per(self, area: f64) -> Quantity {
        Quantity {
            names: self,
            scale: 1.0 / area,
        }
    }
}

impl Quantity {
    /// Radiant name and unit.
    pub(crate) fn radiant(&self) -> (&'static str, &'static str) {
        self.names.radiant
    }

    /// Photometric name and unit.
    pub(crate) fn photometric(&self) -> (&'static str, &'static str) {
        self.names.photometric
    }

    pub(crate) fn readout(
        &self,
        (name, unit): (&str, &str),
        weights: Vec<f64>,
        factor: f64,
        photometric: bool,
    ) -> Readout {
        let factor = factor * self.scale;
        Readout {
            name: name.into(),
            unit: unit.into(),
            weights: weights.iter().map(|weight| weight * factor).collect(),
            channel_factor: factor,
            photometric,
        }
    }
}
