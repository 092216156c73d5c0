//! Reliefs of materials: pictures of normals and of heights.

use std::sync::Arc;

use super::Fault;
use super::description::{self, Pattern};
use crate::material::{Relief, ReliefKind};

/// A relief in metres and linear numbers.
pub(super) fn prepare(relief: &description::Relief) -> Result<Relief, Fault> {
    let (key, picture, scale) = match relief {
        description::Relief::Normals { picture, scale } => ("normal_map", picture, *scale),
        description::Relief::Height { picture, scale } => ("bump_map", picture, scale.to_metres()),
    };
    if !scale.is_finite() {
        return Err((key, format!("the scale of a relief is finite, not {scale}")));
    }
    let Pattern::Bitmap(bitmap) = &picture.pattern else {
        return Err((key, "a relief is told by a picture".into()));
    };
    let kind = match relief {
        description::Relief::Normals { .. } => ReliefKind::Normals { scale },
        description::Relief::Height { .. } => ReliefKind::Heights { scale },
    };
    Ok(Relief {
        bitmap: Arc::clone(bitmap),
        placement: picture.placement.0,
        kind,
    })
}
