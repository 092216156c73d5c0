//! `--relight`: light groups dimmed or switched after the run.

use steradian::measurement::{Measurements, RelightError};
use steradian_io::nearest::nearest;

use crate::status::Failure;

/// Factors by name of the light group.
#[derive(Clone, Debug, PartialEq)]
pub struct Levels(Vec<(String, f64)>);

/// `desk=50%,window=off`.
pub fn levels(text: &str) -> Result<Levels, String> {
    let level = |part: &str| {
        let (name, level) = part.split_once('=').ok_or_else(|| expected(part))?;
        let name = name.trim();
        match level_of(level.trim()) {
            Some(level) if !name.is_empty() => Ok((name.to_owned(), level)),
            _ => Err(expected(part)),
        }
    };
    text.split(',')
        .map(level)
        .collect::<Result<_, _>>()
        .map(Levels)
}

fn level_of(text: &str) -> Option<f64> {
    let (number, scale) = match text {
        "off" => return Some(0.0),
        "on" => return Some(1.0),
        _ => text
            .strip_suffix('%')
            .map_or((text, 1.0), |number| (number, 0.01)),
    };
    let number: f64 = number.trim_end().parse().ok()?;
    (number >= 0.0 && number.is_finite()).then_some(number * scale)
}

fn expected(part: &str) -> String {
    format!(
        "expected light groups and factors such as desk=50%,window=off,lamp=1.2; found `{part}`"
    )
}

/// Multiplies the light of groups.
pub fn apply(levels: &Levels, measurements: &mut Measurements) -> Result<(), Failure> {
    for (name, level) in &levels.0 {
        let dimming = measurements.dimming.clone();
        let relit = dimming.relit(name, *level, &measurements.groups);
        measurements.dimming = relit.map_err(|error| match error {
            RelightError::UnknownGroup(name) => unknown_group(&name, measurements),
            error => Failure::message(error.to_string()),
        })?;
    }
    Ok(())
}

/// Tells what light groups there are, and which may have been meant.
pub fn unknown_group(name: &str, measurements: &Measurements) -> Failure {
    let known = measurements.group_names();
    let known = known.iter().map(|name| name.as_str());
    Failure::message(unknown("light group", name, known))
}

/// `there is no … ; did you mean …? There are …`.
pub fn unknown<'a>(what: &str, name: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    let hint = nearest(name, known.clone());
    let hint = hint.map_or_else(String::new, |meant| format!("; did you mean `{meant}`?"));
    let known: Vec<String> = known.map(|name| format!("`{name}`")).collect();
    format!(
        "there is no {what} `{name}`{hint} (there is {})",
        known.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_ratios_percents_or_words() {
        let Levels(found) = levels("desk = 50 %, a b=off,c=on,d=1.25,e=150%").unwrap();
        let found: Vec<(&str, f64)> = found.iter().map(|(name, x)| (name.as_str(), *x)).collect();
        let expected = [
            ("desk", 0.5),
            ("a b", 0.0),
            ("c", 1.0),
            ("d", 1.25),
            ("e", 1.5),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn other_words_are_told() {
        for bad in [
            "", "desk", "desk=", "=1", "desk=-1", "desk=dim", "desk=nan", "a=1,,b=2",
        ] {
            assert!(levels(bad).unwrap_err().contains("desk=50%"), "{bad}");
        }
    }

    #[test]
    fn a_misspelt_name_gets_a_hint() {
        let text = unknown("light group", "windw", ["desk", "window"].into_iter());
        assert_eq!(
            text,
            "there is no light group `windw`; did you mean `window`? (there is `desk`, `window`)"
        );
    }
}
