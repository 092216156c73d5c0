//! What a ray has still to visit.
//!
//! The children that a ray meets are put on its stack as keys, where the ray enters above the child's number: for non-negative numbers the
//! order of the bits is the order of the values. The topmost keys, older ones among them, are sorted by a network, and the nearest
//! is taken next. After a hit all that begins behind it is dropped.

use crate::node::{Child, WIDTH};
use crate::simd::{Floats, Mask, Simd};
use crate::traversal::pack;
use std::hint::select_unpredictable;

/// Keys that the network sorts. A stack begins with as many that are greater than all others.
pub(super) const SORTED: usize = 4;

/// Puts the children of the mask on the stack, whose topmost keys lie below the place for new ones. How many there were, and which
/// key is then the topmost: read back from where vectors have just been stored, it would have to be waited for.
#[inline(always)]
pub(super) fn push<S: Simd>(
    set: S,
    met: <S::Eight as Floats>::Mask,
    entry: S::Eight,
    children: &[Child; WIDTH],
    any: bool,
    top: &mut [u64; SORTED + WIDTH],
) -> (usize, u64) {
    let before = top[SORTED - 1];
    let Some(free) = top.last_chunk_mut() else {
        return (0, before);
    };
    let count = set.pairs(met, entry, children.map(|child| child.0), free);
    if any {
        let last = (met.bits() | 1).ilog2() as usize % WIDTH;
        let newest = u64::from(children[last].0);
        return (count, select_unpredictable(count == 0, before, newest));
    }
    if count > SORTED {
        sort_many(free, count);
        return (count, free[(count - 1) % WIDTH]);
    }
    (count, top[count..].first_chunk_mut().map_or(before, sort))
}

/// Five comparisons; the smallest, which is given back, comes last.
#[inline(always)]
fn sort(keys: &mut [u64; SORTED]) -> u64 {
    let order = |a: u64, b: u64| (a.max(b), a.min(b));
    let [a, b, c, d] = *keys;
    let ((a, b), (c, d)) = (order(a, b), order(c, d));
    let ((a, c), (b, d)) = (order(a, c), order(b, d));
    let (b, c) = order(b, c);
    *keys = [a, b, c, d];
    d
}

#[cold]
fn sort_many(keys: &mut [u64; WIDTH], count: usize) {
    keys[..count].sort_unstable_by(|a, b| b.cmp(a));
}

/// Moves the keys that begin before or at `last` to the front, and says how many.
#[inline(always)]
pub(super) fn keep(keys: &mut [u64], last: f32) -> usize {
    let last = pack(last, Child(u32::MAX));
    let mut kept = 0;
    for place in 0..keys.len() {
        let key = keys[place];
        keys[kept] = key;
        kept += usize::from(key <= last);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::{SORTED, keep, sort};
    use crate::node::Child;
    use crate::traversal::pack;

    /// A network that sorts every sequence of zeros and ones sorts everything.
    #[test]
    fn the_network_sorts() {
        for bits in 0..1_u64 << SORTED {
            let mut keys = [0, 1, 2, 3].map(|place| bits >> place & 1);
            let smallest = sort(&mut keys);
            assert_eq!(smallest, keys[SORTED - 1]);
            assert!(keys.is_sorted_by(|a, b| a >= b), "{bits:b}: {keys:?}");
        }
    }

    #[test]
    fn what_begins_at_the_hit_stays() {
        let mut keys = [3.0, 1.0, 2.0, 2.5].map(|entry| pack(entry, Child::leaf(7)));
        assert_eq!(keep(&mut keys, 2.0), 2);
        assert_eq!(
            keys[..2],
            [1.0, 2.0].map(|entry| pack(entry, Child::leaf(7)))
        );
    }
}
