//! Reading a quantity from text, and saying what was expected when that fails.

use std::fmt;

use super::unit::UnitTable;
use super::{
    Angle, AngularFrequency, Area, Energy, Flux, Illuminance, Intensity, Irradiance, Length,
    Luminance, LuminousEfficacy, LuminousEnergy, LuminousExposure, LuminousFlux, LuminousIntensity,
    Quantity, Radiance, RadiantExposure, SolidAngle, Temperature, Time,
};

/// What a place in the input asks for: shown in every message about a quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expected {
    /// With its article: "an intensity".
    pub quantity: String,
    /// A value as a user would write it.
    pub example: &'static str,
    /// The accepted units, the most usual first.
    pub accepted: Vec<&'static str>,
}

impl Expected {
    /// Any one of these quantities.
    pub(super) fn any_of(tables: &[&UnitTable]) -> Self {
        let names: Vec<String> = tables
            .iter()
            .map(|table| with_article(table.quantity))
            .collect();
        Self {
            quantity: names.join(" or "),
            example: tables[0].example,
            accepted: tables
                .iter()
                .flat_map(|table| table.units)
                .map(|unit| unit.symbol)
                .collect(),
        }
    }
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            quantity,
            example,
            accepted,
        } = self;
        write!(
            f,
            "{quantity} such as \"{example}\" (accepted units: {})",
            accepted.join(", ")
        )
    }
}

/// Why text is not the quantity that was asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ParseQuantityError {
    /// A number without a unit, where the unit is part of the meaning.
    #[error("expected {expected}, found \"{given}\", which has no unit")]
    MissingUnit {
        /// What was asked for.
        expected: Box<Expected>,
        /// The text.
        given: String,
    },
    /// A number with a unit of something else, or of nothing known.
    #[error(
        "expected {expected}, found \"{given}\", {}",
        describe_unit(unit, measures)
    )]
    UnknownUnit {
        /// What was asked for.
        expected: Box<Expected>,
        /// The text.
        given: String,
        /// The unit in it.
        unit: String,
        /// The quantity which that unit does measure.
        measures: Option<&'static str>,
    },
    /// Text that does not begin with a number.
    #[error("expected {expected}, found \"{given}\", which does not begin with a number")]
    NotANumber {
        /// What was asked for.
        expected: Box<Expected>,
        /// The text.
        given: String,
    },
    /// An infinite or undefined value, or one beyond the range of numbers.
    #[error("expected {expected}, found \"{given}\", which is not finite")]
    NotFinite {
        /// What was asked for.
        expected: Box<Expected>,
        /// The text.
        given: String,
    },
}

impl UnitTable {
    /// The SI value of a number followed by one of the units of this table.
    ///
    /// ```
    /// use steradian::quantity::{Length, Quantity};
    /// assert_eq!(Length::TABLE.parse("2.5 cm"), Ok(0.025));
    /// ```
    ///
    /// # Errors
    /// If the number is missing or not finite, or the unit missing or not in the table.
    pub fn parse(&self, text: &str) -> Result<f64, ParseQuantityError> {
        parse_any(text, &[self]).map(|(_, value)| value)
    }
}

/// Reads `text` by the first table that holds its unit: the table's index and the SI value.
pub(super) fn parse_any(
    text: &str,
    tables: &[&UnitTable],
) -> Result<(usize, f64), ParseQuantityError> {
    let expected = || Box::new(Expected::any_of(tables));
    let given = text.trim().to_owned();
    let Some((value, unit_text)) = split_number(text.trim()) else {
        return Err(ParseQuantityError::NotANumber {
            expected: expected(),
            given,
        });
    };
    if unit_text.is_empty() && value.is_finite() {
        return match tables.iter().position(|table| table.allows_bare_numbers) {
            Some(index) => Ok((index, value)),
            None => Err(ParseQuantityError::MissingUnit {
                expected: expected(),
                given,
            }),
        };
    }
    let found = tables
        .iter()
        .enumerate()
        .find_map(|(index, table)| Some((index, table.find(unit_text)?)));
    let si = found.map(|(index, unit)| (index, unit.to_si(value)));
    match si {
        Some((index, si)) if si.is_finite() => Ok((index, si)),
        None if value.is_finite() => Err(ParseQuantityError::UnknownUnit {
            expected: expected(),
            given,
            unit: unit_text.to_owned(),
            measures: quantity_measured_in(unit_text),
        }),
        _ => Err(ParseQuantityError::NotFinite {
            expected: expected(),
            given,
        }),
    }
}

/// The number at the start of `text` and the unit after it. The `e` of an exponent needs digits behind it.
fn split_number(text: &str) -> Option<(f64, &str)> {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let is_word = |word: &str| {
        unsigned
            .get(..word.len())
            .is_some_and(|start| start.eq_ignore_ascii_case(word))
            && !unsigned[word.len()..].starts_with(char::is_alphanumeric)
    };
    if let Some(word) = ["infinity", "inf", "nan"]
        .into_iter()
        .find(|word| is_word(word))
    {
        return Some((f64::NAN, unsigned[word.len()..].trim()));
    }
    let end = text.len() - unsigned.len() + number_length(unsigned.as_bytes());
    let (number, unit) = text.split_at(end);
    if unit.starts_with(',') || unit.starts_with('.') {
        return None;
    }
    Some((number.parse().ok()?, unit.trim()))
}

/// The bytes of `digits [. digits] [e [sign] digits]` at the start of an unsigned number.
fn number_length(text: &[u8]) -> usize {
    let digits_from = |start: usize| {
        text[start.min(text.len())..]
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count()
    };
    let mut end = digits_from(0);
    if text.get(end) == Some(&b'.') {
        end += 1 + digits_from(end + 1);
    }
    if matches!(text.get(end), Some(b'e' | b'E')) {
        let signed = usize::from(matches!(text.get(end + 1), Some(b'+' | b'-')));
        let digits = digits_from(end + 1 + signed);
        if digits > 0 {
            end += 1 + signed + digits;
        }
    }
    end
}

/// One table of each unit, so that a misplaced unit can be named.
const KNOWN_TABLES: [&UnitTable; 20] = [
    Length::TABLE,
    Area::TABLE,
    Angle::TABLE,
    SolidAngle::TABLE,
    Time::TABLE,
    AngularFrequency::TABLE,
    Temperature::TABLE,
    Energy::TABLE,
    Flux::TABLE,
    Irradiance::TABLE,
    RadiantExposure::TABLE,
    Intensity::TABLE,
    Radiance::TABLE,
    LuminousEnergy::TABLE,
    LuminousFlux::TABLE,
    Illuminance::TABLE,
    LuminousExposure::TABLE,
    LuminousIntensity::TABLE,
    Luminance::TABLE,
    LuminousEfficacy::TABLE,
];

/// Units of quantities that Steradian does not have.
const FOREIGN_UNITS: [(&str, &str); 17] = [
    ("kg", "mass"),
    ("g", "mass"),
    ("lb", "mass"),
    ("t", "mass"),
    ("N", "force"),
    ("Pa", "pressure"),
    ("K", "temperature"),
    ("°C", "temperature"),
    ("°F", "temperature"),
    ("V", "voltage"),
    ("A", "current"),
    ("mA", "current"),
    ("VA", "apparent power"),
    ("m3", "volume"),
    ("l", "volume"),
    ("m/s", "speed"),
    ("%", "ratio"),
];

fn quantity_measured_in(unit: &str) -> Option<&'static str> {
    let ours = KNOWN_TABLES
        .iter()
        .find(|table| table.find(unit).is_some())
        .map(|table| table.quantity);
    ours.or_else(|| {
        FOREIGN_UNITS
            .iter()
            .find(|(symbol, _)| *symbol == unit)
            .map(|(_, quantity)| *quantity)
    })
}

fn describe_unit(unit: &str, measures: &Option<&'static str>) -> String {
    match measures {
        Some(quantity) => format!("which is {}", with_article(quantity)),
        None => format!("whose unit \"{unit}\" is not known"),
    }
}

fn with_article(noun: &str) -> String {
    let article = if noun.starts_with(['a', 'e', 'i', 'o']) {
        "an"
    } else {
        "a"
    };
    format!("{article} {noun}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use ParseQuantityError::{MissingUnit, NotANumber, NotFinite, UnknownUnit};
    use proptest::prelude::*;

    #[test]
    fn numbers_and_units_are_read_with_or_without_space() {
        for text in [
            "75 W/sr",
            "75W/sr",
            "  75   W/sr ",
            "+75 W/sr",
            "7.5e1 W/sr",
            "7.5E+1W/sr",
            "75000 mW/sr",
            "75. W/sr",
        ] {
            assert_eq!(
                text.parse(),
                Ok(Intensity::from_watts_per_steradian(75.0)),
                "{text}"
            );
        }
        assert_eq!("-.5e-3 kW".parse(), Ok(Flux::from_watts(-0.5)));
    }

    #[test]
    fn each_failure_is_told_apart() {
        let parse = |text: &str| text.parse::<Intensity>().unwrap_err();
        assert!(matches!(parse("75"), MissingUnit { .. }));
        for text in [
            "",
            "W/sr",
            "bright",
            "--5 W/sr",
            "2,5 W/sr",
            "1.2.3 W/sr",
            ".",
            "infinite W/sr",
        ] {
            assert!(matches!(parse(text), NotANumber { .. }), "{text}");
        }
        for text in [
            "inf",
            "nan W/sr",
            "-Infinity W/sr",
            "1e999 W/sr",
            "1e308 kW/sr",
        ] {
            assert!(matches!(parse(text), NotFinite { .. }), "{text}");
        }
        for text in ["75 W", "75 w/sr", "75 W/sr/", "75 W/sr 3", "1e W/sr"] {
            assert!(matches!(parse(text), UnknownUnit { .. }), "{text}");
        }
    }

    #[test]
    fn a_misplaced_unit_is_named() {
        let message = |text: &str| text.parse::<Intensity>().unwrap_err().to_string();
        let expected =
            "expected an intensity such as \"75 W/sr\" (accepted units: W/sr, mW/sr, kW/sr), found";
        assert_eq!(
            message("5 lx"),
            format!("{expected} \"5 lx\", which is an illuminance")
        );
        assert_eq!(
            message("5 kg"),
            format!("{expected} \"5 kg\", which is a mass")
        );
        assert_eq!(
            message("5 xyz"),
            format!("{expected} \"5 xyz\", whose unit \"xyz\" is not known")
        );
        assert_eq!(message("5"), format!("{expected} \"5\", which has no unit"));
        assert_eq!(
            message("five"),
            format!("{expected} \"five\", which does not begin with a number")
        );
    }

    #[test]
    fn every_table_reads_its_own_example_and_each_spelling_as_one_unit() {
        for table in KNOWN_TABLES {
            assert!(table.parse(table.example).is_ok(), "{}", table.quantity);
            assert_eq!(
                table.find(table.si).map(|unit| unit.to_si(1.0)),
                Some(1.0),
                "{}",
                table.quantity
            );
            for unit in table.units {
                for spelling in unit.aliases.iter().chain([&unit.symbol]) {
                    assert_eq!(table.find(spelling), Some(unit), "{spelling}");
                }
            }
        }
    }

    #[test]
    fn deep_parentheses_are_refused() {
        assert!(matches!(
            format!("1 {}", "(".repeat(1_000_000)).parse::<Length>(),
            Err(UnknownUnit { .. })
        ));
    }

    proptest! {
        #[test]
        fn no_text_is_a_panic(text in any::<String>(), tail in "[0-9eE.+ -]{0,6}[W/()m^2² sr-]{0,80}") {
            for text in [&text, &tail, &format!("1{text}")] {
                if let Ok(intensity) = text.parse::<Intensity>() {
                    prop_assert!(intensity.is_finite());
                }
            }
        }
    }

    #[test]
    fn only_lengths_may_be_bare() {
        assert_eq!("2.5".parse(), Ok(Length::from_metres(2.5)));
        assert!(matches!("2.5".parse::<Angle>(), Err(MissingUnit { .. })));
        assert!(matches!("2.5".parse::<Area>(), Err(MissingUnit { .. })));
    }
}
