//! Which readings of a result a picture shows.

use steradian::estimation::Estimate;
use steradian::measurement::{Measurements, Reading, Statistics};
use steradian::sensor::Layout;

/// The readings of one quantity of one sensor.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Name of the sensor.
    pub sensor: String,
    /// The quantity.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// One of each point.
    pub readings: Vec<Reading>,
    /// How the points lie side by side, if they are a grid.
    pub layout: Option<Layout>,
    /// What the points have in common, if there are several.
    pub statistics: Option<Statistics>,
}

impl Subject {
    /// Every quantity of every sensor of a result, in order; none of sensors without points.
    pub fn all(measurements: &Measurements) -> Vec<Self> {
        let readings = measurements.readings();
        let mut left = &readings[..];
        let mut statistics = measurements.statistics().into_iter().peekable();
        let mut subjects = Vec::new();
        for sensor in &measurements.sensors {
            let (own, rest) = left.split_at(sensor.points.len() * sensor.quantities.len());
            left = rest;
            for (number, quantity) in sensor.quantities.iter().enumerate() {
                let of_points = own.iter().skip(number).step_by(sensor.quantities.len());
                let fits = |found: &Statistics| {
                    found.sensor == sensor.name && found.quantity == quantity.name
                };
                subjects.push(Self {
                    sensor: sensor.name.clone(),
                    quantity: quantity.name.clone(),
                    unit: quantity.unit.clone(),
                    readings: of_points.cloned().collect(),
                    layout: sensor.layout,
                    statistics: statistics.next_if(fits),
                });
            }
        }
        subjects.retain(|subject| !subject.readings.is_empty());
        subjects
    }

    /// The mean over the points; of a single point its value.
    pub fn mean(&self) -> Option<&Estimate> {
        match &self.statistics {
            Some(found) => Some(&found.mean),
            None => self.readings.first().map(|reading| &reading.estimate),
        }
    }

    /// What each light group gives of [`mean`](Self::mean), by name.
    pub fn groups(&self) -> &[(String, Estimate)] {
        match &self.statistics {
            Some(found) => &found.groups,
            None => self.readings.first().map_or(&[], |reading| &reading.groups),
        }
    }

    /// Whether a [`plan`](super::plan) can show it.
    pub fn has_places(&self) -> bool {
        let mut readings = self.readings.iter();
        readings.any(|reading| reading.position.is_some())
    }

    /// Whether [`isolines`](super::isolines) can show it.
    pub fn is_grid(&self) -> bool {
        let layout = self.layout.as_ref();
        layout.is_some_and(|layout| layout.count.iter().all(|count| *count >= 2))
    }
}

/// What is asked of a result. What is left open is the first that suits.
#[derive(Clone, Copy, Debug, Default)]
pub struct Choice<'a> {
    /// Name of the sensor.
    pub sensor: Option<&'a str>,
    /// Name of the quantity.
    pub quantity: Option<&'a str>,
}

/// What a picture needs of its sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// Points that lie somewhere; a grid rather than others.
    Places,
    /// A grid of at least 2 by 2.
    Grid,
}

/// Why there are no such readings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ChoiceError {
    /// No sensor of this name.
    #[error("there is no sensor `{name}`; the result has {known}")]
    Sensor {
        /// The name.
        name: String,
        /// The sensors there are.
        known: String,
    },
    /// No sensor reports this quantity.
    #[error("{sensor} does not report `{name}`, but {known}")]
    Quantity {
        /// The sensor, or the result.
        sensor: String,
        /// The quantity asked for.
        name: String,
        /// What it reports.
        known: String,
    },
    /// The sensors that may be shown are of another kind.
    #[error("{sensor} does not have {wanted}; {others}")]
    Unsuitable {
        /// The sensor, or the result.
        sensor: String,
        /// What was looked for.
        wanted: &'static str,
        /// Sensors that have it.
        others: String,
    },
}

impl Need {
    fn is_met(self, subject: &Subject) -> bool {
        match self {
            Self::Places => subject.has_places(),
            Self::Grid => subject.is_grid(),
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Self::Places => "points in space",
            Self::Grid => "a grid of at least 2 x 2 points",
        }
    }
}

impl Choice<'_> {
    /// What may be shown, in order.
    ///
    /// # Errors
    /// If there is no sensor or no quantity of the name asked for.
    pub fn matching<'s>(&self, subjects: &'s [Subject]) -> Result<Vec<&'s Subject>, ChoiceError> {
        let mut found: Vec<&Subject> = subjects.iter().collect();
        if let Some(name) = self.sensor {
            found.retain(|subject| subject.sensor == name);
            if found.is_empty() {
                return Err(ChoiceError::Sensor {
                    name: name.to_owned(),
                    known: listed(subjects.iter().map(|subject| &subject.sensor)),
                });
            }
        }
        if let Some(name) = self.quantity {
            let known = listed(found.iter().map(|subject| &subject.quantity));
            found.retain(|subject| subject.quantity == name);
            if found.is_empty() {
                return Err(ChoiceError::Quantity {
                    sensor: self.place(),
                    name: name.to_owned(),
                    known,
                });
            }
        }
        Ok(found)
    }

    /// The first that may be shown and is as it must be, a grid before others.
    ///
    /// # Errors
    /// Those of [`matching`](Self::matching), and if none of them is as it must be.
    pub fn one<'s>(&self, subjects: &'s [Subject], need: Need) -> Result<&'s Subject, ChoiceError> {
        let found = self.matching(subjects)?;
        let grid = found.iter().find(|subject| subject.is_grid());
        let fits = |subject: &&&Subject| need.is_met(subject);
        if let Some(subject) = grid.or_else(|| found.iter().find(fits)).filter(fits) {
            return Ok(subject);
        }
        let able = subjects.iter().filter(|subject| need.is_met(subject));
        let able = listed(able.map(|subject| &subject.sensor));
        Err(ChoiceError::Unsuitable {
            sensor: self.place(),
            wanted: need.words(),
            others: format!("sensors that do: {able}"),
        })
    }

    fn place(&self) -> String {
        let named = self.sensor.map(|name| format!("sensor `{name}`"));
        named.unwrap_or_else(|| "the result".to_owned())
    }
}

/// Names, each once.
fn listed<'a>(names: impl Iterator<Item = &'a String>) -> String {
    let mut listed: Vec<String> = Vec::new();
    for name in names.map(|name| format!("`{name}`")) {
        if !listed.contains(&name) {
            listed.push(name);
        }
    }
    match listed.is_empty() {
        true => "none".to_owned(),
        false => listed.join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::run::tests::measurements;
    use super::*;

    fn subjects(is_grid: bool) -> Vec<Subject> {
        let mut measurements = measurements();
        measurements.sensors[0].layout = is_grid.then_some(Layout {
            origin: [0.0; 3],
            edges: [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
            count: [2, 2],
        });
        let mut other = measurements.sensors[0].clone();
        other.name = "ceiling".to_owned();
        other.layout = None;
        other.quantities.push(other.quantities[0].clone());
        other.quantities[1].name = "illuminance".to_owned();
        measurements.sensors.insert(0, other);
        Subject::all(&measurements)
    }

    fn refused(sensor: Option<&str>, quantity: Option<&str>, need: Need) -> String {
        let choice = Choice { sensor, quantity };
        choice.one(&subjects(false), need).unwrap_err().to_string()
    }

    #[test]
    fn every_quantity_of_a_sensor_is_a_subject() {
        let found = subjects(false);
        let names: Vec<[&str; 2]> = found.iter().map(|s| [&*s.sensor, &*s.quantity]).collect();
        let expected = [
            ["ceiling", "irradiance"],
            ["ceiling", "illuminance"],
            ["a, b", "irradiance"],
        ];
        assert_eq!(names, expected);
        for subject in &found {
            assert_eq!(subject.readings.len(), 2);
            let fits = |reading: &Reading| {
                reading.sensor == subject.sensor && reading.quantity == subject.quantity
            };
            assert!(subject.readings.iter().all(fits));
        }
    }

    #[test]
    fn a_grid_comes_before_other_points() {
        let sensor = |is_grid| {
            let subjects = subjects(is_grid);
            Choice::default()
                .one(&subjects, Need::Places)
                .unwrap()
                .sensor
                .clone()
        };
        assert_eq!([sensor(true), sensor(false)], ["a, b", "ceiling"]);
    }

    #[test]
    fn what_is_not_there_is_told_with_what_is() {
        for (found, expected) in [
            (
                refused(Some("desk"), None, Need::Places),
                "there is no sensor `desk`; the result has `ceiling`, `a, b`",
            ),
            (
                refused(Some("a, b"), Some("illuminance"), Need::Places),
                "sensor `a, b` does not report `illuminance`, but `irradiance`",
            ),
            (
                refused(None, Some("luminance"), Need::Places),
                "the result does not report `luminance`, but `irradiance`, `illuminance`",
            ),
            (
                refused(Some("a, b"), None, Need::Grid),
                "sensor `a, b` does not have a grid of at least 2 x 2 points; sensors that do: none",
            ),
        ] {
            assert_eq!(found, expected);
        }
    }
}
