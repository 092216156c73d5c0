//! What a choice among lights knows of a model.

use super::Facets;

/// How wide the highlight of a model is, and how much of its light is in it.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(crate) struct Gloss {
    /// α of facets of Trowbridge and Reitz.
    pub alpha: f32,
    /// Of all reflected light.
    pub share: f32,
}

impl Gloss {
    /// Of facets, by the greater of their widths.
    pub(super) fn of_facets(facets: Facets, share: f64) -> Self {
        let [along, across] = facets.widths();
        Self {
            alpha: along.max(across) as f32,
            share: share as f32,
        }
    }

    /// Where there is other light besides.
    pub(super) fn scaled(self, share: f64) -> Self {
        Self {
            share: self.share * share as f32,
            ..self
        }
    }
}
