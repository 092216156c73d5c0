//! Two triangles tested as one: they share an edge function, and the ray passes through one of them at most.
//!
//! Each triangle has a *margin*, the least of its three edge functions or of their negatives: it is positive where the ray passes through.
//! The greater one of two margins tells which triangle may be hit, and only that one's `t` is computed. Both can be positive only if the
//! quadrilateral is folded, as rounding may do to one that is seen edge-on; such rays, and those on a border, are looked at again.

use crate::simd::{Floats, Mask};
use crate::triangle::{Edges, Intersection, SMALLEST_CERTAIN};

/// The triangles (a, b, c) and (a, c, d), or a lone one with d = c, of whose second half no ray is inside.
#[derive(Copy, Clone)]
pub(super) struct Quad {
    /// Indices of a, b, c and d.
    corners: [u16; 4],
    /// Place of the first triangle in the scene's numbers; the second is the next one.
    place: u32,
}

/// Triangles by number, in pairs where two that follow each other are the halves of a quadrilateral.
pub(super) fn quads(triangles: &[[u16; 3]]) -> Vec<Quad> {
    let mut quads = Vec::new();
    let mut place = 0;
    while let Some(&[a, b, c]) = triangles.get(place) {
        let second = triangles.get(place + 1).filter(|next| next[..2] == [a, c]);
        quads.push(Quad {
            corners: [a, b, c, second.map_or(c, |next| next[2])],
            place: place as u32 + 1,
        });
        place += 1 + usize::from(second.is_some());
    }
    quads
}

/// What has to be looked at again: rays on borders, and rays in both halves of a quadrilateral, which only a folded one has.
pub(super) struct Doubt<F: Floats> {
    on_border: F::Mask,
    /// The lesser margin of two halves, where it is greatest.
    in_both: F,
}

impl<F: Floats> Doubt<F> {
    #[inline(always)]
    pub(super) fn none(set: F::Set) -> Self {
        let zero = F::splat(set, 0.0);
        Self {
            on_border: zero.less(zero),
            in_both: F::splat(set, -1.0),
        }
    }

    #[inline(always)]
    pub(super) fn lanes(&self, set: F::Set) -> u32 {
        (self.on_border | F::splat(set, 0.0).less_equal(self.in_both)).bits()
    }
}

/// What a quad has to say about a group.
pub(super) struct Found<F: Floats> {
    /// Where the ray passes through one of the triangles, far from its border.
    pub(super) certain: F::Mask,
    pub(super) crossing: Intersection<F>,
    /// Place of the triangle in the scene's numbers, as bits.
    pub(super) index: F,
}

impl Quad {
    #[inline(always)]
    pub(super) fn crossing<F: Floats>(
        &self,
        set: F::Set,
        sheared: &[[F; 3]],
        doubt: &mut Doubt<F>,
    ) -> Found<F> {
        let [a, b, c, d] = self.corners.map(|corner| sheared[usize::from(corner)]);
        let first = Edges::new(a, b, c);
        let second = first.of_neighbour(set, a, c, d);
        let margins = [first.margin(set), second.margin(set)];
        let is_second = margins[0].less(margins[1]);
        let margin = margins[0].maximum(margins[1]);
        let certain = F::splat(set, SMALLEST_CERTAIN).less(margin);
        let inside = F::splat(set, 0.0).less_equal(margin);
        doubt.on_border = doubt.on_border | inside.without(certain);
        doubt.in_both = margins[0].minimum(margins[1]).maximum(doubt.in_both);
        let edges = Edges::select(is_second, second, first);
        let depths = [
            a[2],
            F::select(is_second, c[2], b[2]),
            F::select(is_second, d[2], c[2]),
        ];
        let [one, next] =
            [self.place, self.place + 1].map(|place| F::splat(set, f32::from_bits(place)));
        Found {
            certain,
            crossing: edges.intersection(depths),
            index: F::select(is_second, next, one),
        }
    }

    pub(super) fn triangles(&self) -> [[u16; 3]; 2] {
        let [a, b, c, d] = self.corners;
        [[a, b, c], [a, c, d]]
    }
}
