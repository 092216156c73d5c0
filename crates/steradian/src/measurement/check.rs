//! Whether measurements that were read from a file agree with themselves.

use thiserror::Error;

use super::{Measurements, PointRecord, SensorRecord};
use crate::estimation::Replicates;

/// What does not agree in measurements from a file.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Contradiction {
    /// Schedules of another number of groups.
    #[error("there are {0} light groups, but factors or schedules of another number")]
    Dimming(usize),
    /// A readout with weights for another number of lanes.
    #[error("`{quantity}` of sensor `{sensor}` is not about the {lanes} lanes of the run")]
    Lanes {
        /// The sensor.
        sensor: String,
        /// The readout.
        quantity: String,
        /// Lanes of the run.
        lanes: usize,
    },
    /// A grid of another number of cells than points.
    #[error("sensor `{sensor}` has {points} points on a grid of {cells} cells")]
    Layout {
        /// The sensor.
        sensor: String,
        /// Its points.
        points: usize,
        /// Cells of its grid.
        cells: u64,
    },
    /// A point with other columns than lanes times groups.
    #[error(
        "point {index} of sensor `{sensor}` does not hold {columns} columns with their replicates"
    )]
    Columns {
        /// The sensor.
        sensor: String,
        /// The point.
        index: usize,
        /// Lanes times groups.
        columns: usize,
    },
}

impl Measurements {
    /// What [`readings`](Self::readings) relies on, for measurements that did not come from a run.
    ///
    /// # Errors
    /// If the lengths of lists do not agree with one another.
    pub fn check(&self) -> Result<(), Contradiction> {
        if !self.dimming.is_of(self.groups.len()) {
            return Err(Contradiction::Dimming(self.groups.len()));
        }
        self.sensors
            .iter()
            .try_for_each(|sensor| self.check_sensor(sensor))
    }

    fn check_sensor(&self, sensor: &SensorRecord) -> Result<(), Contradiction> {
        let lanes = self.lanes.len();
        let mut quantities = sensor.quantities.iter();
        if let Some(quantity) = quantities.find(|quantity| quantity.weights.len() != lanes) {
            return Err(Contradiction::Lanes {
                sensor: sensor.name.clone(),
                quantity: quantity.name.clone(),
                lanes,
            });
        }
        let points = sensor.points.len();
        let cells = sensor.layout.map(|layout| layout.cells());
        if let Some(cells) = cells.filter(|cells| *cells != points as u64) {
            return Err(Contradiction::Layout {
                sensor: sensor.name.clone(),
                points,
                cells,
            });
        }
        let columns = lanes * self.groups.len();
        let mut points = sensor.points.iter();
        match points.find(|point| !point.is_of(columns)) {
            Some(point) => Err(Contradiction::Columns {
                sensor: sensor.name.clone(),
                index: point.index,
                columns,
            }),
            None => Ok(()),
        }
    }
}

impl PointRecord {
    fn is_of(&self, columns: usize) -> bool {
        let replicates = self.replicates.as_ref();
        let sampled = replicates.is_none_or(|replicates: &Replicates| replicates.are_of(columns));
        self.exact.len() == columns && self.closed.len() == columns && sampled
    }
}
