//! What a sensor of a spectral run reports, and from which channels.
//!
//! | response | quantity | unit |
//! |---|---|---|
//! | radiant | irradiance (360-830 nm) | W/m2 |
//! | photopic | illuminance | lx |
//! | scotopic | scotopic illuminance | lx |
//! | xyz | X, Y, Z of illuminance | lx |
//! | par | photosynthetic photon irradiance | umol/(m2 s) |
//! | melanopic | melanopic irradiance, melanopic equivalent daylight (D65) illuminance | W/m2, lx |
//! | a table | irradiance weighted by NAME | W/m2 |
//! | bins | irradiance 400-410 nm, or spectral irradiance 400-410 nm | W/m2, W/(m2 nm) |
//!
//! and alike for flux, radiance and the others.

use super::channels::{bin_name, intervals, table_name};
use super::description::{Bins, Response};
use crate::sensor::Readout;
use crate::sensor::readout::Quantity;
use crate::spectrum::{
    Lanes, MELANOPIC_EFFICACY_OF_D65, PHOTOPIC_EFFICACY, RADIANT, REC709_LUMINANCE, VISIBLE,
};

/// Readouts of one quantity, of a sensor that is no camera.
pub(super) fn readouts(
    lanes: &Lanes,
    quantity: &Quantity,
    (radiant, photometric): (bool, bool),
    response: &Response,
    bins: Option<&Bins>,
) -> Result<Vec<Readout>, String> {
    let reader = Reader { lanes, quantity };
    let mut all = match response {
        Response::Auto | Response::Radiant | Response::Photopic => {
            reader.plain(radiant, photometric)
        }
        Response::Scotopic => vec![reader.light("scotopic", "scotopic ")],
        Response::Xyz => ["X", "Y", "Z"]
            .map(|name| reader.light(name, &format!("{name} of ")))
            .to_vec(),
        Response::Par => vec![reader.photons()],
        Response::Melanopic => reader.melanopic(),
        Response::Table { name, .. } => vec![reader.weighted(name)],
    };
    if let Some(bins) = bins {
        let each = |interval: &[f64; 2]| reader.bin(*interval, bins.per_nm);
        all.extend(intervals(bins)?.iter().map(each));
    }
    Ok(all)
}

/// Readouts of a camera, whose channels are linear Rec.709 and the radiant total.
pub(super) fn of_camera(quantity: &Quantity, radiant: bool, photometric: bool) -> Vec<Readout> {
    let mut all = Vec::new();
    if radiant {
        all.push(quantity.readout(quantity.radiant(), vec![0.0, 0.0, 0.0, 1.0], 1.0, false));
    }
    if photometric {
        let [red, green, blue] = REC709_LUMINANCE;
        let luminance = vec![red, green, blue, 0.0];
        all.push(quantity.readout(quantity.photometric(), luminance, PHOTOPIC_EFFICACY, true));
    }
    all
}

struct Reader<'a> {
    lanes: &'a Lanes,
    quantity: &'a Quantity,
}

impl Reader<'_> {
    fn channel(&self, name: &str, label: (&str, &str), factor: f64, photometric: bool) -> Readout {
        let weights = self.lanes.only(self.lanes.channel(name));
        self.quantity.readout(label, weights, factor, photometric)
    }

    fn plain(&self, radiant: bool, photometric: bool) -> Vec<Readout> {
        let (name, unit) = self.quantity.radiant();
        let [low, high] = self.lanes.grid().map_or(VISIBLE, |grid| grid.range());
        let label = format!("{name} ({low}-{high} nm)");
        let in_watts = || self.channel(RADIANT, (&label, unit), 1.0, false);
        let seen = || self.channel("photopic", self.quantity.photometric(), 1.0, true);
        let in_watts = radiant.then(in_watts);
        in_watts.into_iter().chain(photometric.then(seen)).collect()
    }

    fn light(&self, channel: &str, prefix: &str) -> Readout {
        let (name, unit) = self.quantity.photometric();
        self.channel(channel, (&format!("{prefix}{name}"), unit), 1.0, true)
    }

    fn photons(&self) -> Readout {
        let (name, unit) = self.quantity.radiant();
        let label = format!("photosynthetic photon {name}");
        let unit = per(&unit.replacen('W', "umol", 1), "s");
        self.channel("par", (&label, &unit), 1.0, false)
    }

    fn melanopic(&self) -> Vec<Readout> {
        let (radiant, unit) = self.quantity.radiant();
        let (light, lux) = self.quantity.photometric();
        let label = format!("melanopic {radiant}");
        let daylight = format!("melanopic equivalent daylight (D65) {light}");
        let lumens = 1.0 / MELANOPIC_EFFICACY_OF_D65;
        vec![
            self.channel("melanopic", (&label, unit), 1.0, false),
            self.channel("melanopic", (&daylight, lux), lumens, true),
        ]
    }

    fn weighted(&self, table: &str) -> Readout {
        let (name, unit) = self.quantity.radiant();
        let label = format!("{name} weighted by {table}");
        self.channel(&table_name(table), (&label, unit), 1.0, false)
    }

    fn bin(&self, interval: [f64; 2], per_nm: bool) -> Readout {
        let (name, unit) = self.quantity.radiant();
        let channel = bin_name(interval);
        if !per_nm {
            return self.channel(&channel, (&format!("{name} {channel}"), unit), 1.0, false);
        }
        let label = format!("spectral {name} {channel}");
        let factor = 1.0 / (interval[1] - interval[0]);
        self.channel(&channel, (&label, &per(unit, "nm")), factor, false)
    }
}

/// A unit divided by one more: W → W/nm, W/m2 → W/(m2 nm), W/(m2 sr) → W/(m2 sr nm).
fn per(unit: &str, divisor: &str) -> String {
    match unit.split_once('/') {
        None => format!("{unit}/{divisor}"),
        Some((above, below)) => {
            let below = below.trim_start_matches('(').trim_end_matches(')');
            format!("{above}/({below} {divisor})")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_divided() {
        assert_eq!(per("W", "nm"), "W/nm");
        assert_eq!(per("W/m2", "nm"), "W/(m2 nm)");
        assert_eq!(per("W/(m2 sr)", "nm"), "W/(m2 sr nm)");
    }
}
