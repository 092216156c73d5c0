//! The curves of a scene: each once, by number.

use std::sync::Arc;

use crate::spectrum::{Curve, CurveId};

/// Collects curves.
#[derive(Default)]
pub(super) struct Curves(pub Vec<Arc<Curve>>);

impl Curves {
    /// The number of a curve; equal curves have the same.
    pub fn number(&mut self, curve: Option<Arc<Curve>>) -> Option<CurveId> {
        let curve = curve?;
        let same = |known: &Arc<Curve>| Arc::ptr_eq(known, &curve) || *known == curve;
        let known = self.0.iter().position(same);
        let number = known.unwrap_or_else(|| {
            self.0.push(curve);
            self.0.len() - 1
        });
        Some(CurveId(number as u32))
    }
}
