//! The products and quotients of quantities that have a name: the whole list.
//!
//! `A * B = C` makes a·b, b·a, c/b and c/a. Where C/B already has another meaning, or none that is lawful, it is
//! written `A * B => C`, which makes a·b, b·a and c/a only; such a quotient is a named function instead
//! (`Exitance::from_flux`). `A<V>` and `C<V>` may hold a [`Spectrum`](super::Spectrum); c/a is a number then only
//! if V is `f64`.

use std::ops::{Div, Mul};

use super::{
    Angle, AngularFrequency, Area, Energy, Exitance, Flux, Illuminance, Intensity, Irradiance,
    Length, Luminance, LuminousEfficacy, LuminousEnergy, LuminousExitance, LuminousExposure,
    LuminousFlux, LuminousIntensity, ProjectedSolidAngle, Radiance, RadiantExposure,
    ScalarIrradiance, SolidAngle, Time, Value,
};

macro_rules! laws {
    () => {};
    ($a:ident<V> * $b:ident = $c:ident<V>; $($rest:tt)*) => {
        laws!(@product [V: Value] [$a<V>] $b [$c<V>] $c);
        laws!(@quotient [V: Value] [$c<V>] $b [$a<V>] $a);
        laws!(@quotient [] [$c] $a [$b] $b);
        laws!($($rest)*);
    };
    ($a:ident<V> * $b:ident => $c:ident<V>; $($rest:tt)*) => {
        laws!(@product [V: Value] [$a<V>] $b [$c<V>] $c);
        laws!(@quotient [] [$c] $a [$b] $b);
        laws!($($rest)*);
    };
    ($a:ident * $b:ident = $c:ident; $($rest:tt)*) => {
        laws!(@product [] [$a] $b [$c] $c);
        laws!(@quotient [] [$c] $b [$a] $a);
        laws!(@quotient [] [$c] $a [$b] $b);
        laws!($($rest)*);
    };
    ($a:ident * $b:ident => $c:ident; $($rest:tt)*) => {
        laws!(@product [] [$a] $b [$c] $c);
        laws!(@quotient [] [$c] $a [$b] $b);
        laws!($($rest)*);
    };
    (@product [$($bound:tt)*] [$($a:tt)*] $b:ident [$($c:tt)*] $result:ident) => {
        impl<$($bound)*> Mul<$b> for $($a)* {
            type Output = $($c)*;
            #[inline]
            fn mul(self, factor: $b) -> $($c)* {
                $result(self.0 * factor.0)
            }
        }

        impl<$($bound)*> Mul<$($a)*> for $b {
            type Output = $($c)*;
            #[inline]
            fn mul(self, factor: $($a)*) -> $($c)* {
                factor * self
            }
        }
    };
    (@quotient [$($bound:tt)*] [$($c:tt)*] $b:ident [$($a:tt)*] $result:ident) => {
        impl<$($bound)*> Div<$b> for $($c)* {
            type Output = $($a)*;
            #[inline]
            fn div(self, divisor: $b) -> $($a)* {
                $result(self.0 / divisor.0)
            }
        }
    };
}

laws! {
    Irradiance<V> * Area = Flux<V>;
    Exitance<V> * Area => Flux<V>;
    Intensity<V> * SolidAngle = Flux<V>;
    Radiance<V> * Area = Intensity<V>;
    Radiance<V> * ProjectedSolidAngle = Irradiance<V>;
    Radiance<V> * SolidAngle = ScalarIrradiance<V>;
    Flux<V> * Time = Energy<V>;
    Irradiance<V> * Time = RadiantExposure<V>;
    RadiantExposure<V> * Area = Energy<V>;

    Illuminance * Area = LuminousFlux;
    LuminousExitance * Area => LuminousFlux;
    LuminousIntensity * SolidAngle = LuminousFlux;
    Luminance * Area = LuminousIntensity;
    Luminance * ProjectedSolidAngle = Illuminance;
    LuminousFlux * Time = LuminousEnergy;
    Illuminance * Time = LuminousExposure;
    LuminousExposure * Area = LuminousEnergy;

    AngularFrequency * Time = Angle;

    Energy * LuminousEfficacy = LuminousEnergy;
    Flux * LuminousEfficacy = LuminousFlux;
    Irradiance * LuminousEfficacy = Illuminance;
    Exitance * LuminousEfficacy = LuminousExitance;
    RadiantExposure * LuminousEfficacy = LuminousExposure;
    Intensity * LuminousEfficacy = LuminousIntensity;
    Radiance * LuminousEfficacy = Luminance;
}

impl Mul for Length {
    type Output = Area;
    #[inline]
    fn mul(self, other: Self) -> Area {
        Area(self.0 * other.0)
    }
}

impl Div<Length> for Area {
    type Output = Length;
    #[inline]
    fn div(self, divisor: Length) -> Length {
        Length(self.0 / divisor.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::Spectrum;

    #[test]
    fn a_law_gives_both_products_and_both_quotients() {
        let (irradiance, area) = (
            Irradiance::from_watts_per_square_metre(6.0),
            Area::from_square_metres(0.5),
        );
        let flux = Flux::from_watts(3.0);
        assert_eq!((irradiance * area, area * irradiance), (flux, flux));
        assert_eq!((flux / area, flux / irradiance), (irradiance, area));
    }

    #[test]
    fn a_spectrum_obeys_the_law_in_each_lane() {
        let radiance = Radiance::from_watts_per_square_metre_steradian(Spectrum::from_lanes([
            1.0, 2.0, 3.0, 4.0,
        ]));
        let irradiance = radiance * ProjectedSolidAngle::from_steradians(2.0);
        assert_eq!(
            irradiance.to_watts_per_square_metre().to_lanes(),
            [2.0, 4.0, 6.0, 8.0]
        );
        assert_eq!(
            irradiance / ProjectedSolidAngle::from_steradians(2.0),
            radiance
        );
    }

    #[test]
    fn exposure_may_be_summed_over_time_or_over_area_first() {
        let irradiance = Irradiance::from_watts_per_square_metre(8.0);
        let (area, time) = (Area::from_square_metres(0.25), Time::from_seconds(10.0));
        assert_eq!((irradiance * time) * area, (irradiance * area) * time);
    }

    #[test]
    fn efficacy_commutes_with_the_laws() {
        let (intensity, solid_angle) = (
            Intensity::from_watts_per_steradian(2.0),
            SolidAngle::from_steradians(0.5),
        );
        let efficacy = LuminousEfficacy::MAXIMUM;
        assert_eq!(
            (intensity * efficacy) * solid_angle,
            (intensity * solid_angle) * efficacy
        );
        assert_eq!((intensity * efficacy) / intensity, efficacy);
    }
}
