//! Measurements that come in blocks of points.

use std::fmt;

use super::{Measurements, SensorRecord};
use crate::estimation::{LargestSamples, Replicates};

/// Points of a sensor that a run did not come to before it ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unmeasured {
    /// The sensor.
    pub sensor: String,
    /// How many points are missing, from the end.
    pub points: usize,
    /// How many the sensor has.
    pub of: usize,
}

impl fmt::Display for Unmeasured {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { sensor, points, of } = self;
        write!(
            f,
            "the last {points} of {of} points of sensor `{sensor}`: the run ended before them"
        )
    }
}

impl SensorRecord {
    /// Whether points before its first are in a block before.
    #[must_use]
    pub fn goes_on(&self) -> bool {
        self.points.first().is_some_and(|point| point.index > 0)
    }

    fn without_points(&self) -> Self {
        Self {
            name: self.name.clone(),
            quantities: self.quantities.clone(),
            layout: self.layout,
            points: vec![],
        }
    }
}

impl Measurements {
    /// Adds the next block of the same run.
    pub fn append(&mut self, block: Self) {
        for sensor in block.sensors {
            match self.sensors.last_mut() {
                Some(last) if sensor.goes_on() && last.name == sensor.name => {
                    last.points.extend(sensor.points);
                }
                _ => self.sensors.push(sensor),
            }
        }
    }

    /// Adds what the next block says of its sensors, but not their points.
    pub fn append_without_points(&mut self, block: &Self) {
        for sensor in &block.sensors {
            let is_known = self
                .sensors
                .last()
                .is_some_and(|last| last.name == sensor.name);
            if !(is_known && sensor.goes_on()) {
                self.sensors.push(sensor.without_points());
            }
        }
    }

    /// The same sensors without their points.
    #[must_use]
    pub fn without_points(&self) -> Self {
        let sensors = self.sensors.iter();
        Self {
            scene_name: self.scene_name.clone(),
            lanes: self.lanes.clone(),
            groups: self.groups.clone(),
            dimming: self.dimming.clone(),
            sensors: sensors.map(SensorRecord::without_points).collect(),
            unsampled: self.unsampled.clone(),
            warnings: self.warnings.clone(),
            ..*self
        }
    }

    /// Says which points are missing; what is left of a grid is no grid.
    pub fn leave_out(&mut self, missing: &[Unmeasured]) {
        for sensor in &mut self.sensors {
            if missing.iter().any(|one| one.sensor == sensor.name) {
                sensor.layout = None;
            }
        }
        self.unsampled
            .extend(missing.iter().map(ToString::to_string));
    }

    /// Tells every stream the largest sample that any of its sensor has.
    pub(crate) fn share_largest(&mut self) {
        let mut largest = LargestSamples::default();
        self.replicates().for_each(|stream| largest.see(stream));
        self.replicates_mut()
            .for_each(|stream| largest.tell(stream));
    }

    pub(super) fn replicates(&self) -> impl Iterator<Item = &Replicates> {
        let points = self.sensors.iter().flat_map(|sensor| &sensor.points);
        points.filter_map(|point| point.replicates.as_ref())
    }

    pub(super) fn replicates_mut(&mut self) -> impl Iterator<Item = &mut Replicates> {
        self.points_mut()
            .filter_map(|point| point.replicates.as_mut())
    }
}
