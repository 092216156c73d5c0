//! The macro that defines a quantity: the newtype, its unit functions and its linear arithmetic.

/// Defines a quantity that holds any [`Value`](super::Value) (`Flux<V>`) or one `f64` (`Area`).
///
/// `Name, TABLE, from_unit, to_unit, "unit in words"`: the functions and the words name the SI unit, the table
/// holds the units of text.
macro_rules! quantity {
    ($(#[$doc:meta])* $name:ident<V>, $($rest:tt)*) => {
        quantity!(
            @define [$(#[$doc])*] $name [V: $crate::quantity::Value = f64] [V: $crate::quantity::Value] [<V>] [V]
            $($rest)*
        );
    };
    (@define [$($doc:tt)*] $name:ident [$($declared:tt)*] [$($bound:tt)*] [$($arg:tt)*] [$value:ty]
     $table:expr, $from:ident, $to:ident, $words:literal) => {
        $($doc)*
        #[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
        #[repr(transparent)]
        pub struct $name<$($declared)*>(pub(super) $value);

        impl<$($bound)*> $name $($arg)* {
            /// Nothing of it: the neutral element of addition.
            pub const ZERO: Self = Self(<$value as $crate::quantity::Value>::ZERO);

            #[doc = concat!("From ", $words, ".")]
            #[inline]
            pub const fn $from(value: $value) -> Self {
                Self(value)
            }

            #[doc = concat!("In ", $words, ".")]
            #[inline]
            pub const fn $to(self) -> $value {
                self.0
            }
        }

        quantity!(@linear $name [$($bound)*] [$($arg)*]);
        quantity!(@scalar $name, $table);
    };
    (@linear $name:ident [$($bound:tt)*] [$($arg:tt)*]) => {
        impl<$($bound)*> std::ops::Add for $name $($arg)* {
            type Output = Self;
            #[inline]
            fn add(self, other: Self) -> Self {
                Self(self.0 + other.0)
            }
        }

        impl<$($bound)*> std::ops::Sub for $name $($arg)* {
            type Output = Self;
            #[inline]
            fn sub(self, other: Self) -> Self {
                Self(self.0 - other.0)
            }
        }

        impl<$($bound)*> std::ops::AddAssign for $name $($arg)* {
            #[inline]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl<$($bound)*> std::ops::SubAssign for $name $($arg)* {
            #[inline]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }

        impl<$($bound)*> std::ops::Neg for $name $($arg)* {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl<$($bound)*> std::ops::Mul<f64> for $name $($arg)* {
            type Output = Self;
            #[inline]
            fn mul(self, factor: f64) -> Self {
                Self(self.0 * factor)
            }
        }

        impl<$($bound)*> std::ops::Mul<$name $($arg)*> for f64 {
            type Output = $name $($arg)*;
            #[inline]
            fn mul(self, quantity: $name $($arg)*) -> $name $($arg)* {
                quantity * self
            }
        }

        impl<$($bound)*> std::ops::Div<f64> for $name $($arg)* {
            type Output = Self;
            #[inline]
            fn div(self, divisor: f64) -> Self {
                Self(self.0 / divisor)
            }
        }

        impl<$($bound)*> std::iter::Sum for $name $($arg)* {
            fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
                terms.fold(Self::ZERO, |sum, term| sum + term)
            }
        }
    };
    (@scalar $name:ident, $table:expr) => {
        impl $name {
            /// Neither infinite nor NaN.
            pub const fn is_finite(self) -> bool {
                self.0.is_finite()
            }

            /// The magnitude.
            pub const fn abs(self) -> Self {
                Self(self.0.abs())
            }
        }

        /// The ratio of two of a kind is a number.
        impl std::ops::Div for $name {
            type Output = f64;
            #[inline]
            fn div(self, other: Self) -> f64 {
                self.0 / other.0
            }
        }

        impl $crate::quantity::Quantity for $name {
            const TABLE: &'static $crate::quantity::UnitTable = &$table;

            #[inline]
            fn from_si(value: f64) -> Self {
                Self(value)
            }

            #[inline]
            fn to_si(self) -> f64 {
                self.0
            }
        }

        impl std::str::FromStr for $name {
            type Err = $crate::quantity::ParseQuantityError;

            fn from_str(text: &str) -> Result<Self, Self::Err> {
                $table.parse(text).map(Self)
            }
        }

        /// The value with its SI unit; a precision is honoured: `{:.2}` prints "0.50 W".
        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                $table.print(self.0, f)
            }
        }
    };
    ($(#[$doc:meta])* $name:ident, $($rest:tt)*) => {
        quantity!(@define [$(#[$doc])*] $name [] [] [] [f64] $($rest)*);
    };
}
pub(super) use quantity;
