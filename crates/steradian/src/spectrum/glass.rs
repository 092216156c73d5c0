//! Clear media by name: the index of refraction and what a path through them absorbs.
//!
//! n of Schott's glasses by Sellmeier's equation, n² − 1 = Σ B_j λ²/(λ² − C_j); n and k of the others from tables; absorption α = 4π k/λ.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | n, k | index of refraction and of extinction | 1 |
//! | λ | wavelength; in µm in Sellmeier's equation | m |
//! | α | absorption: a path s lets exp(−α s) through | 1/m |
//!
//! A dielectric has one index in all lanes: n_d, at 587.5618 nm, the yellow line of helium.
//!
//! Source: Schott, *Optical glass data sheets* (2023) for B and C; `data/spectra/SOURCES.md` for water (Hale and Querry 1973) and fused
//! silica (Malitson 1965). Valid at 20 °C from 380 to 780 nm; the ends are held beyond. The absorption of the
//! glasses is too small to matter in centimetres and is taken to be 0.
//!
//! ```
//! use steradian::spectrum::Glass;
//! assert!((Glass::NBk7.index() - 1.516_80).abs() < 5e-6);
//! // 1.333 at 575 nm, 1.332 at 600 nm.
//! assert!((Glass::Water.index() - 1.3325).abs() < 1e-4);
//! // Red light of 700 nm in water: 4π 3.35e-8/700 nm = .60/m.
//! assert!((Glass::Water.absorption().at(700.0) - 0.601).abs() < 5e-3);
//! ```

use std::f64::consts::PI;

use super::{Beyond, Curve, tables};

/// A clear medium.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Glass {
    /// H₂O.
    Water,
    /// SiO₂.
    FusedSilica,
    /// Schott's borosilicate crown.
    NBk7,
    /// Schott's dense flint.
    NSf11,
}

/// The yellow line of helium, in nm.
const HELIUM_D: f64 = 587.5618;
/// Where the tables are known, and how finely Sellmeier's equation is sampled.
const RANGE: [f64; 2] = [380.0, 780.0];
const STEP: f64 = 5.0;

/// B₁ B₂ B₃ and C₁ C₂ C₃ in µm².
type Sellmeier = [[f64; 3]; 2];

const N_BK7: Sellmeier = [
    [1.039_612_12, 0.231_792_344, 1.010_469_45],
    [0.006_000_698_67, 0.020_017_914_4, 103.560_653],
];
const N_SF11: Sellmeier = [
    [1.737_596_95, 0.313_747_346, 1.898_781_01],
    [0.013_188_707, 0.062_306_814_2, 155.236_29],
];

impl Glass {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Water, Self::FusedSilica, Self::NBk7, Self::NSf11];

    /// The name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Water => "water",
            Self::FusedSilica => "fused-silica",
            Self::NBk7 => "n-bk7",
            Self::NSf11 => "n-sf11",
        }
    }

    /// The medium of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|glass| glass.name() == name)
    }

    /// n_d.
    pub fn index(self) -> f64 {
        match self {
            Self::NBk7 => sellmeier(&N_BK7, HELIUM_D),
            Self::NSf11 => sellmeier(&N_SF11, HELIUM_D),
            Self::Water | Self::FusedSilica => self.curve().at(HELIUM_D),
        }
    }

    /// n.
    pub fn curve(self) -> Curve {
        let column = |index| tables::column(tables::INDICES, index).with_beyond(Beyond::Held);
        let sampled = |glass: &Sellmeier| {
            Curve::from_function(RANGE, STEP, Beyond::Held, |w| sellmeier(glass, w))
                .expect("the range is a multiple of the step")
        };
        match self {
            Self::Water => column(13),
            Self::FusedSilica => column(15),
            Self::NBk7 => sampled(&N_BK7),
            Self::NSf11 => sampled(&N_SF11),
        }
    }

    /// α in 1/m.
    pub fn absorption(self) -> Curve {
        if self != Self::Water {
            return Curve::constant(0.0);
        }
        let kappa = tables::column(tables::INDICES, 14);
        let at = |&w: &f64| (w, 4.0 * PI * kappa.at(w) / (w * 1e-9));
        let samples = kappa.wavelengths().iter().map(at).collect();
        Curve::new(samples, Beyond::Held).expect("the table's wavelengths are in order")
    }
}

fn sellmeier(&[b, c]: &Sellmeier, wavelength: f64) -> f64 {
    let square = 1e-6 * wavelength * wavelength;
    let terms = b.into_iter().zip(c).map(|(b, c)| b * square / (square - c));
    (1.0 + terms.sum::<f64>()).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// n_d of the data sheets, and the Abbe number of crown: (n_d − 1)/(n_F − n_C) = 64.17.
    #[test]
    fn indices_are_those_of_the_data_sheets() {
        assert!((Glass::NSf11.index() - 1.784_72).abs() < 5e-6);
        assert!((Glass::FusedSilica.index() - 1.458_46).abs() < 2e-5);
        let [n_f, n_c] = [486.1327, 656.2725].map(|w| sellmeier(&N_BK7, w));
        let abbe = (Glass::NBk7.index() - 1.0) / (n_f - n_c);
        assert!((abbe - 64.17).abs() < 5e-3);
    }

    #[test]
    fn names_are_read_back() {
        for glass in Glass::ALL {
            assert_eq!(Glass::from_name(glass.name()), Some(glass));
            assert!(glass.absorption().min() >= 0.0 && glass.curve().min() > 1.0);
        }
    }
}
