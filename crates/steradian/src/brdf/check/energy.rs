//! No more light leaves than came.

use super::finding::{Check, Finding, Place};
use super::views::dense_views;
use crate::brdf::Brdf;

/// What a share may be off by.
///
/// Shares of the rough models come from quadrature; those of closed forms are rounded to single precision.
pub(super) const SHARE_ERROR: f64 = 2e-3;

/// albedo + transmittance ≤ 1, every three degrees in three planes, in every lane.
pub fn energy(model: &Brdf) -> Finding {
    let mut finding = Finding::new(Check::Energy, 1.0 + SHARE_ERROR);
    for wo in dense_views(model) {
        let sum = (model.albedo(wo) + model.transmittance(wo)).to_lanes();
        for (lane, share) in sum.into_iter().enumerate() {
            let place = Place {
                lane: Some(lane),
                ..Place::view(wo)
            };
            finding.see(f64::from(share), place);
        }
    }
    finding
}
