//! Where a quantity that is known on a lattice has a value: lines, and the bands in which such a line may lie.
//!
//! Between the points of a lattice the quantity is bilinear. Each cell is divided into squares and these into two triangles,
//! on which it is linear, so that a line of equal values is a chain of segments, and the place where low ≤ level ≤ high a
//! polygon. Points on edges are computed from the same end for both neighbours: equal points have equal bits, and segments
//! are put together by them.

use std::collections::HashMap;

/// Triangulated squares across the whole lattice, about.
const SQUARES: usize = 96;

/// Points side by side, row by row.
#[derive(Clone, Debug)]
pub struct Points {
    /// Points along both edges, at least two each.
    pub count: [usize; 2],
    /// The first point.
    pub origin: [f64; 2],
    /// From a point to the next along both edges.
    pub steps: [[f64; 2]; 2],
}

/// A node of the divided lattice, and a place between two of them.
type Node = [usize; 2];
type Key = [u64; 2];

impl Points {
    /// Squares that a cell is divided into, along each edge.
    fn division(&self) -> usize {
        let cells = self.count[0].max(self.count[1]) - 1;
        SQUARES.div_ceil(cells).max(2)
    }

    fn place(&self, node: Node, division: usize) -> [f64; 2] {
        let [u, v] = node.map(|number| number as f64 / division as f64);
        std::array::from_fn(|k| self.origin[k] + self.steps[0][k] * u + self.steps[1][k] * v)
    }

    /// The bilinear value at a node.
    fn value(&self, values: &[f64], node: Node, division: usize) -> f64 {
        let cell: [usize; 2] = std::array::from_fn(|k| (node[k] / division).min(self.count[k] - 2));
        let part = |k: usize| (node[k] - cell[k] * division) as f64 / division as f64;
        let at = |i: usize, j: usize| values[(cell[1] + j) * self.count[0] + cell[0] + i];
        let along = |j: usize| at(0, j) + (at(1, j) - at(0, j)) * part(0);
        along(0) + (along(1) - along(0)) * part(1)
    }

    /// All triangles, each with its nodes in order of turning.
    fn triangles(&self, division: usize) -> impl Iterator<Item = [Node; 3]> {
        let [columns, rows] = self.count.map(|count| (count - 1) * division);
        let squares = (0..rows).flat_map(move |j| (0..columns).map(move |i| [i, j]));
        squares.flat_map(|[i, j]| {
            let (a, b, c, d) = ([i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]);
            [[a, b, c], [a, c, d]]
        })
    }
}

/// The lines on which `values` are `level`. A line that closes ends where it begins.
pub fn lines(points: &Points, values: &[f64], level: f64) -> Vec<Vec<[f64; 2]>> {
    let division = points.division();
    let sheet = Sheet {
        points,
        division,
        values,
    };
    let mut segments = Vec::new();
    for corners in points.triangles(division) {
        let crossings: Vec<[f64; 2]> = edges(corners)
            .filter_map(|edge| sheet.crossing(edge, level).map(|(_, place)| place))
            .collect();
        if let [from, to] = crossings[..] {
            segments.push([from, to]);
        }
    }
    chained(&segments)
}

/// The outlines of where `low ≤ level ≤ high`; twice inside is outside. Nowhere may `low` be above `high`.
pub fn band(points: &Points, [low, high]: [&[f64]; 2], level: f64) -> Vec<Vec<[f64; 2]>> {
    let division = points.division();
    let [low, high] = [low, high].map(|values| Sheet {
        points,
        division,
        values,
    });
    let mut outline = Outline::default();
    for corners in points.triangles(division) {
        let mut polygon = Vec::new();
        for edge in edges(corners) {
            let from = edge[0];
            if low.value(from) < level && level <= high.value(from) {
                polygon.push(points.place(from, division));
            }
            let crossings = [&low, &high].map(|sheet| sheet.crossing(edge, level));
            let mut crossings: Vec<_> = crossings.into_iter().flatten().collect();
            crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
            polygon.extend(crossings.into_iter().map(|(_, place)| place));
        }
        outline.add(&polygon);
    }
    chained(&outline.edges())
}

fn edges([a, b, c]: [Node; 3]) -> impl Iterator<Item = [Node; 2]> {
    [[a, b], [b, c], [c, a]].into_iter()
}

/// A quantity over the triangles.
struct Sheet<'a> {
    points: &'a Points,
    division: usize,
    values: &'a [f64],
}

impl Sheet<'_> {
    fn value(&self, node: Node) -> f64 {
        self.points.value(self.values, node, self.division)
    }

    /// Where an edge crosses the level: the part of it that lies before, and the place.
    fn crossing(&self, [from, to]: [Node; 2], level: f64) -> Option<(f64, [f64; 2])> {
        let is_turned = to < from;
        let [first, last] = if is_turned { [to, from] } else { [from, to] };
        let [a, b] = [first, last].map(|node| self.value(node));
        if (a < level) == (b < level) {
            return None;
        }
        let part = (level - a) / (b - a);
        let [p, q] = [first, last].map(|node| self.points.place(node, self.division));
        let place = std::array::from_fn(|k| p[k] + (q[k] - p[k]) * part);
        Some((if is_turned { 1.0 - part } else { part }, place))
    }
}

fn key(place: [f64; 2]) -> Key {
    place.map(|x| (x + 0.0).to_bits())
}

/// The edges of many polygons that only one of them has.
#[derive(Default)]
struct Outline {
    order: Vec<[[f64; 2]; 2]>,
    open: HashMap<[Key; 2], usize>,
}

impl Outline {
    fn add(&mut self, polygon: &[[f64; 2]]) {
        let next = polygon.iter().cycle().skip(1);
        for (&from, &to) in polygon.iter().zip(next) {
            let (a, b) = (key(from), key(to));
            if a != b && self.open.remove(&[b, a]).is_none() {
                self.open.insert([a, b], self.order.len());
                self.order.push([from, to]);
            }
        }
    }

    fn edges(&self) -> Vec<[[f64; 2]; 2]> {
        let mut numbers: Vec<usize> = self.open.values().copied().collect();
        numbers.sort_unstable();
        numbers
            .into_iter()
            .map(|number| self.order[number])
            .collect()
    }
}

/// Segments put together where their ends are the same.
fn chained(segments: &[[[f64; 2]; 2]]) -> Vec<Vec<[f64; 2]>> {
    let mut at: HashMap<Key, Vec<usize>> = HashMap::new();
    let segments: Vec<_> = segments.iter().filter(|s| key(s[0]) != key(s[1])).collect();
    for (number, segment) in segments.iter().enumerate() {
        for end in segment.iter() {
            at.entry(key(*end)).or_default().push(number);
        }
    }
    let mut used = vec![false; segments.len()];
    let mut extend = |line: &mut Vec<[f64; 2]>, used: &mut [bool]| {
        while let Some(&end) = line.last() {
            let here = at.get_mut(&key(end));
            let Some(number) = here.and_then(|all| all.iter().copied().find(|&n| !used[n])) else {
                return;
            };
            used[number] = true;
            let [from, to] = *segments[number];
            line.push(if key(from) == key(end) { to } else { from });
        }
    };
    let mut found = Vec::new();
    for number in 0..segments.len() {
        if used[number] {
            continue;
        }
        used[number] = true;
        let mut line = segments[number].to_vec();
        extend(&mut line, &mut used);
        line.reverse();
        extend(&mut line, &mut used);
        found.push(line);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn points(columns: usize, rows: usize) -> Points {
        Points {
            count: [columns, rows],
            origin: [0.0, 0.0],
            steps: [[1.0, 0.0], [0.0, 1.0]],
        }
    }

    fn area(rings: &[Vec<[f64; 2]>]) -> f64 {
        let cross = |pair: &[[f64; 2]]| pair[0][0] * pair[1][1] - pair[1][0] * pair[0][1];
        let of = |ring: &Vec<[f64; 2]>| ring.windows(2).map(cross).sum::<f64>() / 2.0;
        rings.iter().map(|ring| of(ring).abs()).sum()
    }

    /// On a slope x the level .75 is one straight line across the lattice.
    #[test]
    fn a_slope_has_one_straight_line() {
        let found = lines(&points(3, 2), &[0.0, 1.0, 2.0, 0.0, 1.0, 2.0], 0.75);
        assert_eq!(found.len(), 1);
        assert!(found[0].iter().all(|place| (place[0] - 0.75).abs() < 1e-12));
        let ends = [found[0][0][1], found[0][found[0].len() - 1][1]];
        assert_eq!(ends.iter().sum::<f64>(), 1.0);
    }

    /// Of a slope x ± .25 the line .75 may lie between x = .5 and 1; of one that is exact, on the line alone.
    #[test]
    fn the_band_of_a_slope_is_as_wide_as_its_interval() {
        let shifted = |by: f64| [0.0, 1.0, 2.0, 0.0, 1.0, 2.0].map(|x| x + by);
        let (low, high) = (shifted(-0.25), shifted(0.25));
        let rings = band(&points(3, 2), [&low, &high], 0.75);
        assert_eq!(rings.len(), 1);
        assert_eq!(rings[0].first(), rings[0].last());
        assert!((area(&rings) - 0.5).abs() < 1e-12, "{}", area(&rings));
        let exact = shifted(0.0);
        assert!(area(&band(&points(3, 2), [&exact, &exact], 0.75)) < 1e-12);
    }

    /// Around a peak the lines close.
    #[test]
    fn a_peak_has_closed_lines() {
        let mut values = vec![0.0; 25];
        values[12] = 1.0;
        let found = lines(&points(5, 5), &values, 0.5);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].first(), found[0].last());
    }

    proptest! {
        /// The interpolated value on a line is the level: the squares are linear but for a term that divides by them twice.
        #[test]
        fn lines_lie_where_the_value_is(values in prop::collection::vec(0.0..1.0_f64, 12), level in 0.05..0.95_f64) {
            let points = points(4, 3);
            for [x, y] in lines(&points, &values, level).concat() {
                let division = 1 << 20;
                let node = [x, y].map(|part| (part * f64::from(division)).round() as usize);
                let found = points.value(&values, node, division as usize);
                prop_assert!((found - level).abs() < 1e-3, "{found} instead of {level}");
            }
        }

        /// Every point is either below, in the band, or above: areas add up to that of the lattice.
        #[test]
        fn bands_and_what_is_beside_them_fill_the_lattice(values in prop::collection::vec(0.0..1.0_f64, 9), level in 0.2..0.8_f64) {
            let points = points(3, 3);
            let (never, always) = (vec![-1e9; 9], vec![1e9; 9]);
            let below = band(&points, [&never, &always], level);
            prop_assert!((area(&below) - 4.0).abs() < 1e-9);
            let rings = band(&points, [&values, &always], level);
            prop_assert!(rings.iter().all(|ring| ring.first() == ring.last()));
        }
    }
}
