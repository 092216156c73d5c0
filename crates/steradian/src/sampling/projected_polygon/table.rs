//! The area of a sector between two ellipses at knots along its chord, to be inverted without iterating over arc tangents.
//!
//! Between neighbouring knots A(x) is the cubic that has the areas there and the densities as slopes (Hermite). With s from 0 to 1
//! between the knots, y the share of the area in between, and slopes p and q in the same units,
//!
//! y = p s + (3 − 2p − q) s² + (p + q − 2) s³ ,
//!
//! whose last term vanishes where the density is linear. From the root without it two steps of Newton's method remain.
//!
//! The cubic's error is greatest half-way to leading order, h⁴ρ‴/384. What the whole inverse moves a sample by is measured there and half-way from there to the
//! knots: a table is only made if it is below 2⁻²⁴ of the sector's area in all these places, the distance of two numbers that a sampler tells apart.

use super::{Arc, Sector};

/// What a table may be wrong by, as a part of the sector's area.
const TOLERANCE: f64 = 1.0 / (1 << 24) as f64;

/// Numbers of intervals that are tried.
const SIZES: [usize; 3] = [8, 16, 32];

/// So many intervals between knots, in their order, among those of all tables.
#[derive(Copy, Clone, Debug)]
pub(super) struct Table {
    first: usize,
    size: usize,
}

#[derive(Copy, Clone, Debug)]
pub(super) struct Interval {
    /// Area where it begins, and where it ends.
    from: f64,
    to: f64,
    /// 1/(to − from).
    scale: f64,
    /// p, q.
    slopes: [f64; 2],
}

impl Table {
    /// Of a sector with two arcs, added to the intervals of others; `None` where the areas are too far from cubics.
    pub fn new(sector: &Sector, inner: &Arc, intervals: &mut Vec<Interval>) -> Option<Self> {
        let (first, area) = (intervals.len(), sector.area_up_to(sector.to));
        for size in SIZES {
            intervals.truncate(first);
            add(sector, inner, size, intervals);
            let table = Self { first, size };
            if table.holds((sector, inner), area, intervals) {
                return Some(table);
            }
        }
        intervals.truncate(first);
        None
    }

    fn of<'a>(&self, intervals: &'a [Interval]) -> &'a [Interval] {
        &intervals[self.first..][..self.size]
    }

    /// Whether the inverse leads back from a quarter, the middle and three quarters of every interval.
    fn holds(&self, (sector, inner): (&Sector, &Arc), area: f64, intervals: &[Interval]) -> bool {
        let width = 1.0 / self.size as f64;
        self.of(intervals).iter().enumerate().all(|(k, interval)| {
            let leads_back = |s: f64| {
                let e = sector.at((k as f64 + s) * width);
                let off = interval.inverse(sector.area_up_to(e)) - s;
                off.abs() * sector.density(inner, e).abs() * width <= TOLERANCE * area
            };
            interval.from < interval.to && [0.25, 0.5, 0.75].into_iter().all(leads_back)
        })
    }

    /// Where along the chord the area is `wanted`.
    pub fn inverse(&self, wanted: f64, intervals: &[Interval]) -> f64 {
        let intervals = self.of(intervals);
        let last = self.size - 1;
        let before = intervals[..last].iter().filter(|i| i.to <= wanted);
        let index = before.count();
        (index as f64 + intervals[index].inverse(wanted)) / self.size as f64
    }
}

/// Adds the intervals of a sector that is cut into so many.
fn add(sector: &Sector, inner: &Arc, size: usize, intervals: &mut Vec<Interval>) {
    let width = 1.0 / size as f64;
    let knot = |k: usize| {
        let e = sector.at(k as f64 * width);
        let slope = sector.density(inner, e).max(0.0) * width;
        (sector.area_up_to(e), slope)
    };
    let mut from = knot(0);
    intervals.extend((1..=size).map(|k| {
        let to = knot(k);
        Interval::new(std::mem::replace(&mut from, to), to)
    }));
}

impl Interval {
    /// Between two knots, each an area and its slope by intervals.
    fn new((from, p): (f64, f64), (to, q): (f64, f64)) -> Self {
        let scale = 1.0 / (to - from);
        Self {
            from,
            to,
            scale,
            slopes: [p * scale, q * scale],
        }
    }

    /// Where the cubic is `wanted`, from 0 to 1.
    fn inverse(&self, wanted: f64) -> f64 {
        let [p, q] = self.slopes;
        let y = ((wanted - self.from) * self.scale).clamp(0.0, 1.0);
        let (square, cube) = (3.0 - 2.0 * p - q, p + q - 2.0);
        let root = (p * p + y * (q * q - p * p)).max(0.0).sqrt();
        let mut s = if p + root > 0.0 {
            y * (p + q) / (p + root)
        } else {
            y
        };
        for _ in 0..2 {
            let excess = s * (p + s * (square + s * cube)) - y;
            let slope = p + s * (2.0 * square + s * 3.0 * cube);
            if slope > 0.0 {
                s = (s - excess / slope).clamp(0.0, 1.0);
            }
        }
        s
    }
}
