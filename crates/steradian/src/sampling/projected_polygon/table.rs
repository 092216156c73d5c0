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

/// Intervals between knots, in their order.
#[derive(Clone, Debug)]
pub(super) struct Table {
    intervals: Vec<Interval>,
}

#[derive(Copy, Clone, Debug)]
struct Interval {
    /// Area where it begins, and where it ends.
    from: f64,
    to: f64,
    /// 1/(to − from).
    scale: f64,
    /// p, q.
    slopes: [f64; 2],
}

impl Table {
    /// Of a sector with two arcs; `None` where the areas are too far from cubics.
    pub fn new(sector: &Sector, inner: &Arc) -> Option<Self> {
        let area = sector.area_up_to(sector.to);
        SIZES.iter().find_map(|size| {
            let table = Self::of_size(sector, inner, *size);
            table.holds(sector, inner, area).then_some(table)
        })
    }

    fn of_size(sector: &Sector, inner: &Arc, size: usize) -> Self {
        let width = 1.0 / size as f64;
        let knot = |k: usize| {
            let e = sector.at(k as f64 * width);
            let slope = sector.density(inner, e).max(0.0) * width;
            (sector.area_up_to(e), slope)
        };
        let knots: Vec<_> = (0..=size).map(knot).collect();
        let intervals = knots.windows(2).map(|pair| Interval::new(pair[0], pair[1]));
        Self {
            intervals: intervals.collect(),
        }
    }

    /// Whether the inverse leads back from a quarter, the middle and three quarters of every interval.
    fn holds(&self, sector: &Sector, inner: &Arc, area: f64) -> bool {
        let width = 1.0 / self.intervals.len() as f64;
        self.intervals.iter().enumerate().all(|(k, interval)| {
            let leads_back = |s: f64| {
                let e = sector.at((k as f64 + s) * width);
                let off = interval.inverse(sector.area_up_to(e)) - s;
                off.abs() * sector.density(inner, e).abs() * width <= TOLERANCE * area
            };
            interval.from < interval.to && [0.25, 0.5, 0.75].into_iter().all(leads_back)
        })
    }

    /// Where along the chord the area is `wanted`.
    pub fn inverse(&self, wanted: f64) -> f64 {
        let last = self.intervals.len() - 1;
        let before = self.intervals[..last].iter().filter(|i| i.to <= wanted);
        let index = before.count();
        (index as f64 + self.intervals[index].inverse(wanted)) / (last + 1) as f64
    }
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
