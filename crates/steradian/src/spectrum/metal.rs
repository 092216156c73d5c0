//! Metals by name: their indices of refraction n + ik, and what stands for these where lanes are no wavelengths.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | n, k | index of refraction and of extinction, against vacuum | 1 |
//! | R₀ | ((n − 1)² + k²)/((n + 1)² + k²), reflectance along the normal | 1 |
//!
//! In `spectral` n and k are curves. In `rgb` and in one band that carries light a metal keeps its reflectance: with R₀ the colour
//! under D65 of R₀(λ) (the mean for the eye under D65), within the range of R₀(λ) where the colour lies outside Rec.709 (gold), n is the mean of n(λ) under D65 over the positive part of the
//! channel's sensitivity, and k² = (R₀ (n + 1)² − (n − 1)²)/(1 − R₀). At other angles such a metal is off by what its indices vary within a channel.
//!
//! Source: `data/spectra/SOURCES.md`: Johnson and Christy (1972, 1974), aluminium by Rakić (1995). Valid for clean, thick films from
//! 380 to 780 nm; the ends are held beyond.
//!
//! ```
//! use steradian::spectrum::Metal;
//! let [n, k] = Metal::Gold.curves();
//! // Johnson and Christy's film at 650 nm.
//! assert!((n.at(650.0) - 0.1557).abs() < 5e-4 && (k.at(650.0) - 3.602).abs() < 5e-3);
//! assert_eq!(Metal::from_name("silver"), Some(Metal::Silver));
//! ```

use std::sync::LazyLock;

use super::colour::triple_integral;
use super::{
    Beyond, Curve, Illuminant, LaneCurve, LaneError, LaneValues, Lanes, Observer, apply, photopic,
    rgb_curves, rgb_from_xyz, tables, xyz_of,
};

/// A metal.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Metal {
    /// Ag.
    Silver,
    /// Al.
    Aluminium,
    /// Au.
    Gold,
    /// Cr.
    Chromium,
    /// Cu.
    Copper,
    /// Fe.
    Iron,
}

impl Metal {
    /// All of them, in the order of the table.
    pub const ALL: [Self; 6] = [
        Self::Silver,
        Self::Aluminium,
        Self::Gold,
        Self::Chromium,
        Self::Copper,
        Self::Iron,
    ];

    /// The name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Silver => "silver",
            Self::Aluminium => "aluminium",
            Self::Gold => "gold",
            Self::Chromium => "chromium",
            Self::Copper => "copper",
            Self::Iron => "iron",
        }
    }

    /// The metal of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|metal| metal.name() == name)
    }

    /// n and k.
    pub fn curves(self) -> &'static [Curve; 2] {
        static CURVES: LazyLock<[[Curve; 2]; 6]> = LazyLock::new(|| {
            let column = |index| tables::column(tables::INDICES, index).with_beyond(Beyond::Held);
            Metal::ALL.map(|metal| {
                let first = 1 + 2 * metal as usize;
                [column(first), column(first + 1)]
            })
        });
        &CURVES[self as usize]
    }

    /// R₀.
    pub fn reflectance(self) -> Curve {
        let [n, k] = self.curves();
        let samples = n
            .wavelengths()
            .iter()
            .map(|&w| (w, normal_reflectance(n.at(w), k.at(w))));
        Curve::new(samples.collect(), Beyond::Held).expect("the table's wavelengths are in order")
    }

    /// n and k of each lane.
    ///
    /// # Errors
    /// If the lanes are bands among which more than one, or none, carries light.
    pub fn in_lanes(self, lanes: &Lanes) -> Result<[LaneCurve; 2], LaneError> {
        let [n, k] = match (lanes.is_spectral(), lanes.is_rgb()) {
            (true, _) => self.curves().clone().map(LaneValues::table),
            (_, true) => self.rgb().map(LaneValues::Rgb),
            _ => {
                // Refuses the bands that a table cannot be told for.
                lanes.coefficient(&LaneValues::table(self.curves()[0].clone()))?;
                self.visible().map(LaneValues::Uniform)
            }
        };
        Ok([lanes.coefficient(&n)?, lanes.coefficient(&k)?])
    }

    /// n and k of the three channels of linear Rec.709.
    pub fn rgb(self) -> [[f64; 3]; 2] {
        let daylight = Illuminant::D65.curve();
        let white = xyz_of(daylight, None, Observer::Cie1931)[1];
        let colour = xyz_of(daylight, Some(&self.reflectance()), Observer::Cie1931);
        let reflectances = apply(&rgb_from_xyz(), colour.map(|value| value / white));
        let channels = rgb_curves(Observer::Cie1931);
        let pairs: [[f64; 2]; 3] =
            std::array::from_fn(|k| self.equivalent(reflectances[k], &channels[k]));
        [0, 1].map(|part| pairs.map(|pair| pair[part]))
    }

    /// n and k of one band of light.
    fn visible(self) -> [f64; 2] {
        let daylight = Illuminant::D65.curve();
        let seen = triple_integral(daylight, &self.reflectance(), photopic());
        let all = daylight.product_integral(photopic(), photopic().range());
        self.equivalent(seen / all, photopic())
    }

    /// n as seen by the positive part of a sensitivity, and k so that R₀ is this.
    fn equivalent(self, reflectance: f64, sensitivity: &Curve) -> [f64; 2] {
        let daylight = Illuminant::D65.curve();
        let positive = sensitivity.wavelengths().iter();
        let positive = positive.map(|&w| (w, sensitivity.at(w).max(0.0)));
        let positive = Curve::new(positive.collect(), Beyond::Zero)
            .expect("the observer's wavelengths are in order");
        let weight = daylight.product_integral(&positive, positive.range());
        let n = triple_integral(daylight, &self.curves()[0], &positive) / weight;
        let possible = self.reflectance();
        let r = reflectance.clamp(possible.min(), possible.max());
        let square = (r * (n + 1.0) * (n + 1.0) - (n - 1.0) * (n - 1.0)) / (1.0 - r);
        [n, square.max(0.0).sqrt()]
    }
}

fn normal_reflectance(n: f64, k: f64) -> f64 {
    let (below, above) = (n - 1.0, n + 1.0);
    (below * below + k * k) / (above * above + k * k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metals_keep_their_colour_in_rgb() {
        for metal in Metal::ALL {
            let [n, k] = metal.rgb();
            let daylight = Illuminant::D65.curve();
            let colour = xyz_of(daylight, Some(&metal.reflectance()), Observer::Cie1931);
            let white = xyz_of(daylight, None, Observer::Cie1931)[1];
            let expected = apply(&rgb_from_xyz(), colour.map(|value| value / white));
            let [least, most] = [metal.reflectance().min(), metal.reflectance().max()];
            for channel in 0..3 {
                let found = normal_reflectance(n[channel], k[channel]);
                let error = (found - expected[channel].clamp(least, most)).abs();
                assert!(error < 1e-9, "{metal:?} {channel}: {found} {expected:?}");
            }
        }
    }

    /// Gold is yellow, copper red, silver nearly white.
    #[test]
    fn metals_look_like_themselves() {
        let colour = |metal: Metal| {
            let [n, k] = metal.rgb();
            [0, 1, 2].map(|channel| normal_reflectance(n[channel], k[channel]))
        };
        let [r, g, b] = colour(Metal::Gold);
        assert!(
            r > 0.95 && (0.7..0.85).contains(&g) && b < 0.5,
            "{r} {g} {b}"
        );
        let [r, g, b] = colour(Metal::Copper);
        assert!(r > 0.9 && g < 0.7 && b < g);
        assert!(
            colour(Metal::Silver)
                .into_iter()
                .all(|channel| channel > 0.9)
        );
    }

    #[test]
    fn lanes_of_every_mode_have_an_index() {
        let visible = Lanes::broadband(&["visible".into()]).unwrap();
        let [n, k] = Metal::Aluminium.in_lanes(&visible).unwrap();
        assert!((normal_reflectance(n.lanes[0], k.lanes[0]) - 0.915).abs() < 0.01);
        let two = Lanes::broadband(&["visible".into(), "nir".into()]).unwrap();
        assert!(Metal::Aluminium.in_lanes(&two).is_err());
        let [n, _] = Metal::Iron.in_lanes(&Lanes::rgb()).unwrap();
        assert_eq!(n.lanes[..3], Metal::Iron.rgb()[0]);
        let spectral = Lanes::spectral([380.0, 780.0], vec![]).unwrap();
        assert!(Metal::Iron.in_lanes(&spectral).unwrap()[1].curve.is_some());
    }
}
