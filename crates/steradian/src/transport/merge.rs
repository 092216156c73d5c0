//! Putting the shards of a picture together.

use super::Picture;
use crate::estimation::EstimationError;
use crate::estimation::film::merge_exposures;

impl Picture {
    /// The picture whose parts these are, in any order: the same bits as the run in one piece.
    ///
    /// # Errors
    /// If they are not the parts of one run, or one is missing.
    pub fn merge(parts: Vec<Self>) -> Result<Self, EstimationError> {
        let mut exposures = Vec::with_capacity(parts.len());
        let mut whole: Option<Self> = None;
        for part in parts {
            if whole
                .as_ref()
                .is_some_and(|whole| !whole.belongs_with(&part))
            {
                let what = "they are of different scenes, cameras, seeds or settings";
                return Err(EstimationError::Shards(what.to_owned()));
            }
            exposures.push(part.exposure.clone());
            whole = Some(part);
        }
        let exposure = merge_exposures(exposures)?;
        let whole = whole.ok_or_else(|| EstimationError::Shards("there are none".to_owned()))?;
        Ok(Self {
            exposure,
            shard: None,
            ..whole
        })
    }

    /// Whether both were made of the same scene in the same way.
    fn belongs_with(&self, other: &Self) -> bool {
        let identity = |picture: &Self| {
            (
                picture.seed,
                picture.max_depth,
                picture.luminous_efficacy.map(f64::to_bits),
            )
        };
        self.scene_name == other.scene_name
            && self.camera == other.camera
            && self.lanes == other.lanes
            && self.readouts == other.readouts
            && identity(self) == identity(other)
    }
}
