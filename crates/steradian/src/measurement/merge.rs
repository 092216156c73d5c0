//! Putting the shards of a measurement together.

use super::{Measurements, PointRecord};
use crate::estimation::{EstimationError, Replicates, merge_shards};

impl Measurements {
    /// The measurement whose parts these are, in any order: the same bits as the run in one piece.
    ///
    /// # Errors
    /// If they are not the parts of one run, or one is missing.
    pub fn merge(mut parts: Vec<Self>) -> Result<Self, EstimationError> {
        let sampled = parts.iter().map(Self::sampled_points).collect::<Vec<_>>();
        let replicates = parts.iter_mut().map(Self::take_replicates).collect();
        let fault = |what: &str| Err(EstimationError::Shards(what.to_owned()));
        let Some(mut whole) = parts.pop() else {
            return fault("there are none");
        };
        let same_points = sampled.iter().all(|points| *points == sampled[0]);
        if !same_points || parts.iter().any(|part| *part != whole) {
            return fault("they are of different scenes, seeds or settings");
        }
        let merged = merge_shards(replicates)?;
        for (point, replicates) in whole.points_at(&sampled[0]).zip(merged) {
            point.replicates = Some(replicates);
        }
        Ok(whole)
    }

    pub(super) fn points_mut(&mut self) -> impl Iterator<Item = &mut PointRecord> {
        self.sensors
            .iter_mut()
            .flat_map(|sensor| &mut sensor.points)
    }

    /// Whether each point has a sampled part.
    fn sampled_points(&self) -> Vec<bool> {
        let points = self.sensors.iter().flat_map(|sensor| &sensor.points);
        points.map(|point| point.replicates.is_some()).collect()
    }

    fn points_at<'a>(
        &'a mut self,
        wanted: &'a [bool],
    ) -> impl Iterator<Item = &'a mut PointRecord> {
        let points = self.points_mut().zip(wanted);
        points.filter_map(|(point, wanted)| wanted.then_some(point))
    }

    /// Leaves what all parts of a run have in common.
    fn take_replicates(&mut self) -> Vec<Replicates> {
        self.shard = None;
        self.points_mut()
            .filter_map(|point| point.replicates.take())
            .collect()
    }
}
