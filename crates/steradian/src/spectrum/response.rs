//! Action spectra: what a watt at a wavelength does.
//!
//! A reading is the integral of the radiant quantity a nm times the weight,
//!
//! ```text
//! X = ∫ w(λ) Φ_λ dλ .
//! ```
//!
//! | action | w(λ) | unit of X for Φ in W | source |
//! |---|---|---|---|
//! | photopic | 683 lm/W · V(λ) | lm | ISO/CIE 23539 |
//! | scotopic | 1700 lm/W · V′(λ) | lm | ISO/CIE 23539 |
//! | melanopic | s_mel(λ) | W | CIE S 026/E:2018, table 2 |
//! | par | λ/(N_A h c) from 400 to 700 nm, 0 elsewhere | µmol/s | K. J. McCree, Agric. Meteorol. 9 (1972) |
//!
//! 683 lm/W belongs to 540 THz, 555.016 nm in air; at the maximum of V, 555 nm, the exact K_m is 683.002 lm/W. The
//! rounded 683 is used, as by most programs. Melanopic quantities are in melanopic watts; the equivalent daylight
//! illuminance is the reading divided by [`MELANOPIC_EFFICACY_OF_D65`].

use std::sync::LazyLock;

use super::blackbody::{LIGHT_SPEED, PLANCK};
use super::{Beyond, Curve, photopic, scotopic, tables};

/// Greatest photopic efficacy, lm/W.
pub const PHOTOPIC_EFFICACY: f64 = 683.0;
/// Greatest scotopic efficacy, lm/W.
pub const SCOTOPIC_EFFICACY: f64 = 1700.0;
/// Melanopic watts a lumen of daylight D65, W/lm (CIE S 026/E:2018, 3.9).
pub const MELANOPIC_EFFICACY_OF_D65: f64 = 1.3262e-3;
/// Avogadro's constant, 1/mol.
const AVOGADRO: f64 = 6.022_140_76e23;

/// What light does to a receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Action {
    /// Sight by day.
    Photopic,
    /// Sight by night.
    Scotopic,
    /// Response of the retina's ganglion cells that set the inner clock.
    Melanopic,
    /// Photons that drive photosynthesis.
    Par,
}

impl Action {
    /// All actions.
    pub const ALL: [Self; 4] = [Self::Photopic, Self::Scotopic, Self::Melanopic, Self::Par];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Photopic => "photopic",
            Self::Scotopic => "scotopic",
            Self::Melanopic => "melanopic",
            Self::Par => "par",
        }
    }

    /// The action of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|action| action.name() == name)
    }

    /// Unit of the weight.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Photopic | Self::Scotopic => "lm/W",
            Self::Melanopic => "W/W",
            Self::Par => "µmol/J",
        }
    }

    /// The weight of a watt at each wavelength.
    ///
    /// ```
    /// use steradian::spectrum::Action;
    ///
    /// assert_eq!(Action::Photopic.weight().at(555.0), 683.0);
    /// // A photon of 550 nm has 3.61e-19 J, so that a joule holds 4.6 µmol.
    /// assert!((Action::Par.weight().at(550.0) - 4.598).abs() < 1e-3);
    /// assert_eq!(Action::Par.weight().at(701.0), 0.0);
    /// ```
    pub fn weight(self) -> &'static Curve {
        static WEIGHTS: LazyLock<[Curve; 4]> = LazyLock::new(|| Action::ALL.map(compute));
        &WEIGHTS[self as usize]
    }
}

fn compute(action: Action) -> Curve {
    match action {
        Action::Photopic => photopic().scaled(PHOTOPIC_EFFICACY),
        Action::Scotopic => scotopic().scaled(SCOTOPIC_EFFICACY),
        Action::Melanopic => tables::column(tables::CIE_S026_MELANOPIC, 1),
        Action::Par => photons(),
    }
}

/// Micromoles a joule, from 400 to 700 nm.
fn photons() -> Curve {
    let micromoles = |nm: f64| nm * 1e-9 / (AVOGADRO * PLANCK * LIGHT_SPEED) * 1e6;
    let ends = [400.0, 700.0].map(|nm| (nm, micromoles(nm)));
    Curve::new(ends.to_vec(), Beyond::Zero).expect("two samples in order")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Illuminant, blackbody};

    fn efficacy(action: Action, light: &Curve) -> f64 {
        let range = [360.0, 830.0];
        light.product_integral(action.weight(), range) / light.integral(range)
    }

    /// The standard gives 1.3262 mW/lm, five digits.
    #[test]
    fn daylight_has_the_melanopic_efficacy_of_the_standard() {
        let daylight = Illuminant::D65.curve();
        let ratio = efficacy(Action::Melanopic, daylight) / efficacy(Action::Photopic, daylight);
        assert!(
            (ratio - MELANOPIC_EFFICACY_OF_D65).abs() < 0.5e-7,
            "{ratio}"
        );
    }

    /// The reference takes c₂ = 1.4388e-2 m K, which is another temperature, and trapezia of the product every nm. They
    /// differ from the integral of the product by h²/6 ∫ V′L′: at most 1/6 · 0.014/nm · 2 of ∫ V L = 107 nm, as
    /// L′/L = c₂/(λ²T) − 5/λ ≤ 0.014/nm near 560 nm.
    #[test]
    fn efficacy_of_black_bodies_agrees_with_a_reference() {
        const C2: f64 = 1.438_776_877e-2;
        for (kelvin, reference) in [
            (2000.0, 64.83781076230207),
            (2856.0, 122.96394374424588),
            (3500.0, 150.69955615702992),
            (5000.0, 173.8669915396868),
            (5777.0, 174.63276293714353),
            (6500.0, 172.82379436404005),
        ] {
            let light = blackbody(kelvin * C2 / 1.4388e-2, [360.0, 830.0], 1.0).unwrap();
            let value = efficacy(Action::Photopic, &light);
            assert!(
                (value / reference - 1.0).abs() < 5e-5,
                "{kelvin} K: {value}"
            );
        }
    }

    #[test]
    fn names_come_back() {
        for (index, action) in Action::ALL.into_iter().enumerate() {
            assert_eq!(action as usize, index);
            assert_eq!(Action::from_name(action.name()), Some(action));
        }
    }
}
