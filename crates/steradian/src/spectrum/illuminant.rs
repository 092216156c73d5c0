//! Standard illuminants: relative spectral power.
//!
//! | illuminant | law or table | range, step |
//! |---|---|---|
//! | A | 100 (560/λ)⁵ (exp(c₂/(2848 · 560)) − 1)/(exp(c₂/(2848 λ)) − 1), c₂ = 1.435·10⁷ nm K | 300–830, 1 nm |
//! | D50, D55, D65, D75 | S₀ + M₁ S₁ + M₂ S₂, a [phase of daylight](daylight) | 300–830, 10 nm |
//! | E | 100 | 300–830 |
//! | FL2, FL7, FL11 | fluorescent lamps: cool white, daylight, three narrow bands of 4000 K | 380–780, 5 nm |
//! | HP1 | high-pressure sodium lamp | 380–780, 5 nm |
//! | LED-B3 | blue-pumped phosphor LED, 4103 K | 380–780, 5 nm |
//!
//! D50 to D75 are daylight of the nominal temperature times 1.4388/1.4380, which the value of c₂ has grown by since they
//! were defined. S₀, S₁, S₂ are tabulated every 10 nm and joined by straight lines; the CIE's table every 5 nm is the
//! same function.
//!
//! ```text
//! x = −4.6070·10⁹/T³ + 2.9678·10⁶/T² + 0.09911·10³/T + 0.244063    4000 K ≤ T ≤ 7000 K
//! x = −2.0064·10⁹/T³ + 1.9018·10⁶/T² + 0.24748·10³/T + 0.237040    7000 K < T ≤ 25 000 K
//! y = −3 x² + 2.870 x − 0.275
//! M₁ = (−1.3515 − 1.7703 x + 5.9114 y)/M ,  M₂ = (0.0300 − 31.4424 x + 30.0717 y)/M ,
//! M = 0.0241 + 0.2562 x − 0.7341 y ,  M₁ and M₂ rounded to three decimals
//! ```
//!
//! Source: CIE 15:2004, §3.1 with notes, and tables T.2, T.6, T.8; CIE 15:2018 for LED-B3. They are shapes: 100 at
//! 560 nm for A, D and E, an arbitrary scale for the lamps.

use std::sync::LazyLock;

use super::{Beyond, Curve, CurveError, tables};

/// A standard illuminant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Illuminant {
    /// Incandescent lamp, 2856 K.
    A,
    /// Daylight, 5003 K.
    D50,
    /// Daylight, 5503 K.
    D55,
    /// Daylight, 6504 K.
    D65,
    /// Daylight, 7504 K.
    D75,
    /// Equal energy.
    E,
    /// Fluorescent lamp, cool white.
    Fl2,
    /// Fluorescent lamp, daylight.
    Fl7,
    /// Fluorescent lamp of three narrow bands.
    Fl11,
    /// High-pressure sodium lamp.
    Hp1,
    /// LED with phosphor.
    LedB3,
}

impl Illuminant {
    /// All illuminants, in the order of their names.
    pub const ALL: [Self; 11] = [
        Self::A,
        Self::D50,
        Self::D55,
        Self::D65,
        Self::D75,
        Self::E,
        Self::Fl2,
        Self::Fl7,
        Self::Fl11,
        Self::Hp1,
        Self::LedB3,
    ];

    /// The name that the CIE gives.
    pub fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::D50 => "D50",
            Self::D55 => "D55",
            Self::D65 => "D65",
            Self::D75 => "D75",
            Self::E => "E",
            Self::Fl2 => "FL2",
            Self::Fl7 => "FL7",
            Self::Fl11 => "FL11",
            Self::Hp1 => "HP1",
            Self::LedB3 => "LED-B3",
        }
    }

    /// The illuminant of this name, in capitals or not.
    ///
    /// ```
    /// use steradian::spectrum::Illuminant;
    /// assert_eq!(Illuminant::from_name("D65"), Some(Illuminant::D65));
    /// assert_eq!(Illuminant::from_name("led-b3"), Some(Illuminant::LedB3));
    /// assert_eq!(Illuminant::from_name("D66"), None);
    /// ```
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|illuminant| illuminant.name().eq_ignore_ascii_case(name))
    }

    /// Its relative spectral power.
    ///
    /// ```
    /// use steradian::spectrum::Illuminant;
    /// assert_eq!(Illuminant::D65.curve().at(560.0), 100.0);
    /// ```
    pub fn curve(self) -> &'static Curve {
        static CURVES: LazyLock<[Curve; 11]> = LazyLock::new(|| Illuminant::ALL.map(compute));
        &CURVES[self as usize]
    }
}

fn compute(illuminant: Illuminant) -> Curve {
    let curve = match illuminant {
        Illuminant::A => Curve::from_function(CIE_RANGE, 1.0, Beyond::Zero, incandescent),
        Illuminant::D50 => daylight(5000.0 * C2_GROWTH),
        Illuminant::D55 => daylight(5500.0 * C2_GROWTH),
        Illuminant::D65 => daylight(6500.0 * C2_GROWTH),
        Illuminant::D75 => daylight(7500.0 * C2_GROWTH),
        Illuminant::E => Curve::new(CIE_RANGE.map(|end| (end, 100.0)).to_vec(), Beyond::Zero),
        Illuminant::Fl2 => Ok(tables::column(tables::LAMPS, 1)),
        Illuminant::Fl7 => Ok(tables::column(tables::LAMPS, 2)),
        Illuminant::Fl11 => Ok(tables::column(tables::LAMPS, 3)),
        Illuminant::Hp1 => Ok(tables::column(tables::LAMPS, 4)),
        Illuminant::LedB3 => Ok(tables::column(tables::LAMPS, 5)),
    };
    curve.expect("the standard's ranges and temperatures are valid")
}

/// Wavelengths for which the CIE defines A, D and E, in nm.
const CIE_RANGE: [f64; 2] = [300.0, 830.0];
/// Growth of the second radiation constant since the daylight illuminants were defined.
const C2_GROWTH: f64 = 1.4388 / 1.4380;

/// Illuminant A.
fn incandescent(wavelength: f64) -> f64 {
    let occupation = |wavelength: f64| libm::expm1(1.435e7 / (2848.0 * wavelength));
    let ratio = 560.0 / wavelength;
    100.0 * ratio * ratio * ratio * ratio * ratio * occupation(560.0) / occupation(wavelength)
}

/// A phase of daylight of a correlated colour temperature between 4000 K and 25 000 K, 100 at 560 nm.
///
/// ```
/// use steradian::spectrum::{Illuminant, daylight};
/// assert!((daylight(6504.0)?.at(450.0) / Illuminant::D65.curve().at(450.0) - 1.0).abs() < 1e-3);
/// assert!(daylight(3000.0).is_err());
/// # Ok::<(), steradian::spectrum::CurveError>(())
/// ```
pub fn daylight(kelvin: f64) -> Result<Curve, CurveError> {
    if !(4000.0..=25_000.0).contains(&kelvin) {
        return Err(CurveError::Daylight(kelvin));
    }
    let [m1, m2] = daylight_weights(daylight_x(kelvin));
    let [s0, s1, s2] = [1, 2, 3].map(|index| tables::column(tables::DAYLIGHT, index));
    let power = |w: f64| s0.at(w) + m1 * s1.at(w) + m2 * s2.at(w);
    Curve::from_function(CIE_RANGE, 10.0, Beyond::Zero, power)
}

/// Chromaticity x of daylight.
fn daylight_x(kelvin: f64) -> f64 {
    let [c3, c2, c1, c0] = if kelvin <= 7000.0 {
        [-4.607e9, 2.9678e6, 0.09911e3, 0.244063]
    } else {
        [-2.0064e9, 1.9018e6, 0.24748e3, 0.23704]
    };
    ((c3 / kelvin + c2) / kelvin + c1) / kelvin + c0
}

/// M₁ and M₂.
fn daylight_weights(x: f64) -> [f64; 2] {
    let y = -3.0 * x * x + 2.87 * x - 0.275;
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    let m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
    let m2 = (0.03 - 31.4424 * x + 30.0717 * y) / m;
    [m1, m2].map(|weight| (weight * 1000.0).round() / 1000.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the CIE's tables, which have three decimals (A six digits, D65 four decimals).
    #[test]
    fn laws_give_the_published_tables() {
        for (illuminant, wavelength, published) in [
            (Illuminant::A, 300.0, 0.930483),
            (Illuminant::A, 315.0, 1.62219),
            (Illuminant::A, 775.0, 239.37),
            (Illuminant::A, 780.0, 241.675),
            (Illuminant::D50, 300.0, 0.019),
            (Illuminant::D50, 315.0, 4.914),
            (Illuminant::D50, 775.0, 80.599),
            (Illuminant::D55, 315.0, 6.648),
            (Illuminant::D55, 780.0, 71.818),
            (Illuminant::D65, 300.0, 0.0341),
            (Illuminant::D65, 305.0, 1.6643),
            (Illuminant::D65, 315.0, 11.7652),
            (Illuminant::D65, 775.0, 65.0941),
            (Illuminant::D65, 780.0, 63.3828),
            (Illuminant::D65, 830.0, 60.3125),
            (Illuminant::D75, 315.0, 17.47),
            (Illuminant::D75, 775.0, 59.838),
        ] {
            let value = illuminant.curve().at(wavelength);
            let rounding = 5.1e-4_f64.max(2e-6 * published);
            assert!(
                (value - published).abs() < rounding,
                "{illuminant:?} {wavelength} {value}"
            );
        }
    }

    #[test]
    fn names_come_back() {
        for (index, illuminant) in Illuminant::ALL.into_iter().enumerate() {
            assert_eq!(illuminant as usize, index);
            assert_eq!(Illuminant::from_name(illuminant.name()), Some(illuminant));
            assert!(illuminant.curve().min() >= 0.0);
        }
    }

    #[test]
    fn daylight_has_a_range() {
        for kelvin in [3999.0, 25_001.0, f64::NAN] {
            assert!(matches!(daylight(kelvin), Err(CurveError::Daylight(_))));
        }
        let [cool, warm] = [15_000.0, 4500.0].map(|kelvin| daylight(kelvin).unwrap());
        assert!(cool.at(450.0) > warm.at(450.0) && cool.at(650.0) < warm.at(650.0));
    }
}
