//! Standard observers.
//!
//! | symbol | meaning | source |
//! |---|---|---|
//! | x̄, ȳ, z̄ | colour-matching functions, field of 2° | CIE 1931; CIE 15:2004, table T.4 |
//! | x̄₁₀, ȳ₁₀, z̄₁₀ | the same, field of 10° | CIE 1964; CIE 15:2004, table T.5 |
//! | V(λ) | photopic luminous efficiency, which is ȳ | CIE 1924; ISO/CIE 23539 |
//! | V′(λ) | scotopic luminous efficiency | CIE 1951; ISO/CIE 23539 |
//!
//! All are numbers without unit, tabulated every nm: from 360 to 830 nm, V′ from 380 to 780 nm. They are 0 outside.

use std::sync::LazyLock;

use super::{Curve, tables};

/// A colorimetric standard observer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Observer {
    /// Field of 2°, for whatever is seen under 1° to 4°.
    Cie1931,
    /// Field of 10°.
    Cie1964,
}

impl Observer {
    /// The functions x̄, ȳ, z̄. All three have the same wavelengths.
    ///
    /// ```
    /// use steradian::spectrum::Observer;
    ///
    /// let [x, y, z] = Observer::Cie1931.curves();
    /// assert_eq!(y.at(555.0), 1.0);
    /// // Equal energy is white: the three areas are equal to three digits.
    /// let area = y.integral(y.range());
    /// assert!((area - 106.857).abs() < 1e-3);
    /// assert!((x.integral(x.range()) / area - 1.0).abs() < 1e-4);
    /// assert!((z.integral(z.range()) / area - 1.0).abs() < 4e-4);
    /// ```
    pub fn curves(self) -> &'static [Curve; 3] {
        static CIE_1931: LazyLock<[Curve; 3]> =
            LazyLock::new(|| [1, 2, 3].map(|index| tables::column(tables::CIE_1931, index)));
        static CIE_1964: LazyLock<[Curve; 3]> =
            LazyLock::new(|| [1, 2, 3].map(|index| tables::column(tables::CIE_1964, index)));
        match self {
            Self::Cie1931 => &CIE_1931,
            Self::Cie1964 => &CIE_1964,
        }
    }
}

/// V(λ), the photopic luminous efficiency.
pub fn photopic() -> &'static Curve {
    &Observer::Cie1931.curves()[1]
}

/// V′(λ), the scotopic luminous efficiency.
///
/// ```
/// assert_eq!(steradian::spectrum::scotopic().at(507.0), 1.0);
/// ```
pub fn scotopic() -> &'static Curve {
    static SCOTOPIC: LazyLock<Curve> =
        LazyLock::new(|| tables::column(tables::CIE_1951_SCOTOPIC, 1));
    &SCOTOPIC
}
