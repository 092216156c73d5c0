//! Units as text spells them, and the table of units that a quantity accepts.
//!
//! A unit is looked up by its *normal form*: its factors with their exponents, sorted. So "W/(m2 sr)",
//! "W/m²/sr", "W m^-2 sr^-1" and "W·sr⁻¹·m⁻²" are one unit, and a table holds it once. Upper and lower case
//! differ (mW is not MW).

use std::fmt;

/// One unit of a quantity: its spelling and its size in SI units, as a fraction whose halves are exact wherever
/// the unit is a rational multiple of the SI unit ("3 mm" is 3/1000, correctly rounded).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// The spelling that messages print.
    pub symbol: &'static str,
    /// Other accepted spellings.
    pub aliases: &'static [&'static str],
    multiplier: f64,
    divisor: f64,
}

impl Unit {
    /// The unit of `multiplier / divisor` SI units.
    pub(super) const fn new(symbol: &'static str, multiplier: f64, divisor: f64) -> Self {
        Self {
            symbol,
            aliases: &[],
            multiplier,
            divisor,
        }
    }

    /// The same unit, accepting `aliases` too.
    pub(super) const fn or(mut self, aliases: &'static [&'static str]) -> Self {
        self.aliases = aliases;
        self
    }

    /// `value` of this unit, in SI units.
    ///
    /// ```
    /// use steradian::quantity::{Length, Quantity};
    /// let inch = Length::TABLE.find("in").unwrap();
    /// assert_eq!(inch.to_si(100.0), 2.54);
    /// ```
    pub const fn to_si(&self, value: f64) -> f64 {
        value * self.multiplier / self.divisor
    }

    /// `value` in SI units, in this unit.
    ///
    /// ```
    /// use steradian::quantity::{Energy, Quantity};
    /// let watt_hour = Energy::TABLE.find("Wh").unwrap();
    /// assert_eq!(watt_hour.of_si(9000.0), 2.5);
    /// ```
    pub const fn of_si(&self, value: f64) -> f64 {
        value * self.divisor / self.multiplier
    }

    fn is_spelled(&self, text: &str, factors: Option<&Factors>) -> bool {
        std::iter::once(&self.symbol)
            .chain(self.aliases)
            .any(|spelling| {
                *spelling == text
                    || (factors.is_some() && Factors::of(spelling).as_ref() == factors)
            })
    }
}

/// The units in which text may give a quantity.
#[derive(Debug, PartialEq)]
pub struct UnitTable {
    /// The quantity's name: "luminous flux".
    pub quantity: &'static str,
    /// The SI unit, as printed.
    pub si: &'static str,
    /// A value as a user would write it.
    pub example: &'static str,
    /// The accepted units, the most usual first.
    pub units: &'static [Unit],
    /// Whether a number without a unit is taken to be in SI units (metres only).
    pub allows_bare_numbers: bool,
}

impl UnitTable {
    /// The accepted unit that `text` spells.
    pub fn find(&self, text: &str) -> Option<&'static Unit> {
        let factors = Factors::of(text);
        self.units
            .iter()
            .find(|unit| unit.is_spelled(text, factors.as_ref()))
    }

    /// Writes `value` with the SI unit.
    pub(super) fn print(&self, value: f64, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = value.abs();
        let plain = size == 0.0 || (1e-4..1e12).contains(&size) || !size.is_finite();
        match (f.precision(), plain) {
            (Some(precision), _) => write!(f, "{value:.precision$} {}", self.si),
            (None, true) => write!(f, "{value} {}", self.si),
            (None, false) => write!(f, "{value:e} {}", self.si),
        }
    }
}

/// A unit as factors with exponents, sorted by symbol, none with exponent zero.
#[derive(Debug, PartialEq)]
struct Factors(Vec<(String, i32)>);

impl Factors {
    /// Reads `factor { separator factor }`, where a factor is a symbol with an optional exponent or a group in
    /// parentheses; `/` inverts the one factor or group that follows it, so "W/m2 sr" is W sr/m².
    ///
    /// Text longer than any unit is refused, which bounds the depth of parentheses.
    fn of(text: &str) -> Option<Self> {
        if text.len() > 64 {
            return None;
        }
        let text: Vec<char> = text.trim().chars().flat_map(plain_characters).collect();
        let mut reader = FactorReader {
            text: &text,
            at: 0,
            factors: Vec::new(),
        };
        reader.product(1)?;
        (reader.at == text.len()).then(|| Self(merged(reader.factors)))
    }
}

fn merged(mut factors: Vec<(String, i32)>) -> Vec<(String, i32)> {
    factors.sort();
    factors.dedup_by(|next, kept| {
        let same = next.0 == kept.0;
        if same {
            kept.1 += next.1;
        }
        same
    });
    factors.retain(|(_, exponent)| *exponent != 0);
    factors
}

/// Superscripts become digits, the signs of multiplication a space, Greek mu and the micro sign "u".
fn plain_characters(character: char) -> Option<char> {
    Some(match character {
        '²' => '2',
        '³' => '3',
        '¹' => '1',
        '⁻' => '-',
        'µ' | 'μ' => 'u',
        '·' | '⋅' | '*' | '.' => ' ',
        '^' => return None,
        other => other,
    })
}

struct FactorReader<'a> {
    text: &'a [char],
    at: usize,
    factors: Vec<(String, i32)>,
}

impl FactorReader<'_> {
    fn product(&mut self, sign: i32) -> Option<()> {
        let mut sign_of_next = sign;
        loop {
            self.factor(sign_of_next)?;
            let spaces = self.skip_spaces();
            sign_of_next = match self.peek() {
                None | Some(')') => return Some(()),
                Some('/') => {
                    self.at += 1;
                    -sign
                }
                Some(_) if spaces => sign,
                Some(_) => return None,
            };
        }
    }

    fn factor(&mut self, sign: i32) -> Option<()> {
        self.skip_spaces();
        if self.peek() == Some('(') {
            self.at += 1;
            self.product(sign)?;
            let closed = self.peek() == Some(')');
            self.at += 1;
            return closed.then_some(());
        }
        let symbol = self.take_while(|c| c.is_alphabetic() || c == '°');
        let exponent = self.take_while(|c| c.is_ascii_digit() || c == '-');
        let exponent = if exponent.is_empty() {
            1
        } else {
            exponent.parse::<i8>().ok()?
        };
        self.factors.push((symbol, sign * i32::from(exponent)));
        self.factors
            .last()
            .is_some_and(|(symbol, _)| !symbol.is_empty())
            .then_some(())
    }

    fn peek(&self) -> Option<char> {
        self.text.get(self.at).copied()
    }

    fn skip_spaces(&mut self) -> bool {
        !self.take_while(char::is_whitespace).is_empty()
    }

    fn take_while(&mut self, wanted: impl Fn(char) -> bool) -> String {
        let taken: String = self.text[self.at..]
            .iter()
            .take_while(|&&c| wanted(c))
            .collect();
        self.at += taken.chars().count();
        taken
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::{Quantity, Radiance};

    #[test]
    fn spellings_of_one_unit_have_one_normal_form() {
        let expected = Factors::of("W/(m2 sr)");
        assert!(expected.is_some());
        for spelling in [
            "W/(m² sr)",
            "W/m2/sr",
            "W/m^2/sr",
            "W m-2 sr-1",
            "W·sr⁻¹·m⁻²",
            "W/(sr*m^2)",
            "W / ( m2 sr )",
            "W/sr/m/m",
        ] {
            assert_eq!(Factors::of(spelling), expected, "{spelling}");
        }
        assert_ne!(Factors::of("W/m2 sr"), expected);
        assert_ne!(Factors::of("w/(m2 sr)"), expected);
    }

    #[test]
    fn malformed_units_have_no_normal_form() {
        for malformed in [
            "", "W/", "/W", "W/(m2", "W/m2)", "W//m2", "2W", "m--2", "m2-", "m999", "()", "W(",
            "m2sr",
        ] {
            assert_eq!(Factors::of(malformed), None, "{malformed}");
        }
    }

    #[test]
    fn a_table_finds_its_units_by_any_spelling() {
        let unit = Radiance::TABLE.find("mW/cm²/sr");
        assert_eq!(unit.map(|unit| unit.to_si(1.0)), Some(10.0));
        assert_eq!(Radiance::TABLE.find("W/sr"), None);
    }
}
