//! Convex plane polygons: sampling, clipping by a plane.

use crate::geometry::{Direction, Point, Vector};

/// A convex plane polygon, counter-clockwise as seen from its normal's side.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPolygon {
    corners: Vec<Point>,
    normal: Direction,
    /// Twice the area of the fan's triangles (0, k, k + 1), up to and including each.
    cumulative: Vec<f64>,
}

/// Corners may lie this share of the diameter off the plane, or inside the edge of their neighbours.
const PLANARITY: f64 = 1e-9;

impl ConvexPolygon {
    /// More corners make no facet.
    pub const MOST_CORNERS: usize = 8;

    /// `None` unless the corners span an area and are plane and convex.
    pub fn new(corners: Vec<Point>) -> Option<Self> {
        let first = *corners.first()?;
        let spokes = corners.iter().map(|&corner| corner - first);
        let doubled = spokes.clone().zip(spokes.clone().skip(1));
        let doubled = doubled.fold(Vector::ZERO, |sum, (a, b)| sum + a.cross(b));
        let normal = Direction::new(doubled).ok()?;
        let diameter = spokes.fold(0.0_f64, |most, spoke| most.max(spoke.length()));
        let tolerance = PLANARITY * diameter;
        let polygon = Self::of_plane(corners, normal);
        let is_plane = polygon
            .corners
            .iter()
            .all(|&corner| normal.dot(corner - first).abs() <= tolerance);
        let has_area = doubled.length() > tolerance * diameter;
        (has_area && is_plane && polygon.is_convex(tolerance * diameter)).then_some(polygon)
    }

    fn of_plane(corners: Vec<Point>, normal: Direction) -> Self {
        let mut total = 0.0;
        let triangles = corners.windows(2).skip(1).map(|pair| {
            total += (pair[0] - corners[0]).cross(pair[1] - corners[0]).length();
            total
        });
        let cumulative = triangles.collect();
        Self {
            corners,
            normal,
            cumulative,
        }
    }

    fn is_convex(&self, tolerance: f64) -> bool {
        let corner = |index: usize| self.corners[index % self.corners.len()];
        (0..self.corners.len()).all(|k| {
            let (back, ahead) = (corner(k + 1) - corner(k), corner(k + 2) - corner(k + 1));
            self.normal.dot(back.cross(ahead)) >= -tolerance
        })
    }

    /// The same seen from behind.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self::of_plane(self.corners.iter().rev().copied().collect(), -self.normal)
    }

    /// The corners.
    pub fn corners(&self) -> &[Point] {
        &self.corners
    }

    /// The side that radiates.
    pub fn normal(&self) -> Direction {
        self.normal
    }

    /// In m².
    pub fn area(&self) -> f64 {
        0.5 * self.cumulative.last().copied().unwrap_or(0.0)
    }

    /// The mean of the corners.
    pub fn middle(&self) -> Point {
        let first = self.corners[0];
        let sum = self
            .corners
            .iter()
            .fold(Vector::ZERO, |sum, &corner| sum + (corner - first));
        first + sum / self.corners.len() as f64
    }

    /// The greatest distance of two corners.
    pub fn diameter(&self) -> f64 {
        let pairs = self
            .corners
            .iter()
            .flat_map(|&a| self.corners.iter().map(move |&b| b - a));
        pairs
            .fold(0.0_f64, |most, edge| most.max(edge.length_squared()))
            .sqrt()
    }

    /// Whether opposite edges are parallel, so that the unit square maps to it evenly.
    fn is_parallelogram(&self) -> bool {
        let [a, b, c, d] = self.corners[..] else {
            return false;
        };
        (b - a - (c - d)).max_component() <= PLANARITY * (c - a).length()
    }

    /// A point, uniform by area.
    pub fn sample(&self, [u, v]: [f64; 2]) -> Point {
        let first = self.corners[0];
        if self.is_parallelogram() {
            return first + (self.corners[1] - first) * u + (self.corners[3] - first) * v;
        }
        let wanted = u * self.cumulative.last().copied().unwrap_or(0.0);
        let last = self.cumulative.len() - 1;
        let index = self
            .cumulative
            .partition_point(|&area| area <= wanted)
            .min(last);
        let before = if index == 0 {
            0.0
        } else {
            self.cumulative[index - 1]
        };
        let within = ((wanted - before) / (self.cumulative[index] - before)).clamp(0.0, 1.0);
        let (a, b) = (
            self.corners[index + 1] - first,
            self.corners[index + 2] - first,
        );
        let root = within.sqrt();
        first + a * (root * (1.0 - v)) + b * (root * v)
    }

    /// How far the corners reach below and above the plane through `point`.
    pub fn heights(&self, point: Point, normal: Direction) -> [f64; 2] {
        let heights = self
            .corners
            .iter()
            .map(|&corner| normal.dot(corner - point));
        heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], h| {
            [low.min(h), high.max(h)]
        })
    }

    /// The part above the plane through `point` (Sutherland & Hodgman 1974); `None` if that has no area.
    pub fn above(&self, point: Point, normal: Direction) -> Option<Self> {
        let mut kept = Vec::with_capacity(self.corners.len() + 1);
        for (index, &from) in self.corners.iter().enumerate() {
            let to = self.corners[(index + 1) % self.corners.len()];
            let (here, there) = (normal.dot(from - point), normal.dot(to - point));
            if here >= 0.0 {
                kept.push(from);
            }
            if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
                kept.push(from.lerp(to, here / (here - there)));
            }
        }
        let polygon = (kept.len() >= 3).then(|| Self::of_plane(kept, self.normal))?;
        (polygon.area() > PLANARITY * self.area()).then_some(polygon)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(flat: &[[f64; 2]]) -> Option<ConvexPolygon> {
        ConvexPolygon::new(flat.iter().map(|&[x, y]| Point::new(x, y, 2.0)).collect())
    }

    const TRAPEZIUM: [[f64; 2]; 4] = [[0.0, 0.0], [4.0, 0.0], [3.0, 2.0], [1.0, 2.0]];

    #[test]
    fn what_is_a_convex_polygon() {
        assert_eq!(polygon(&TRAPEZIUM).unwrap().area(), 6.0);
        assert_eq!(polygon(&TRAPEZIUM).unwrap().normal(), Direction::Z);
        assert!(
            polygon(&[[0.0, 0.0], [2.0, 0.0], [0.5, 0.5], [0.0, 2.0]]).is_none(),
            "concave"
        );
        assert!(
            polygon(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]).is_none(),
            "a line"
        );
        assert!(polygon(&[]).is_none() && polygon(&[[1.0, 1.0]; 4]).is_none());
        let bent = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.1],
            [0.0, 1.0, 0.0],
        ];
        assert!(ConvexPolygon::new(bent.map(Point::from).to_vec()).is_none());
    }

    #[test]
    fn samples_are_uniform_by_area() {
        use crate::sampling::testing::{assert_proportional, histogram, independent};
        let trapezium = polygon(&TRAPEZIUM).unwrap();
        // Left triangle, square, right triangle, each halved at mid height.
        let cell = |u| {
            let p = trapezium.sample(u);
            let column = usize::from(p.x > 1.0) + usize::from(p.x > 3.0);
            2 * column + usize::from(p.y > 1.0)
        };
        let counts = histogram(6, independent(21, 65_536).map(cell));
        assert_proportional(&counts, &[0.75, 0.25, 2.0, 2.0, 0.75, 0.25]);
    }

    #[test]
    fn the_part_above_a_plane() {
        let trapezium = polygon(&TRAPEZIUM).unwrap();
        let above = |x: f64, normal: Direction| trapezium.above(Point::new(x, 0.0, 0.0), normal);
        assert_eq!(above(2.0, Direction::X).unwrap().area(), 3.0);
        assert_eq!(above(3.0, -Direction::X).unwrap().area(), 5.0);
        assert_eq!(above(-1.0, Direction::X).unwrap(), trapezium);
        assert!(above(4.0, Direction::X).is_none());
        assert_eq!(trapezium.reversed().area(), 6.0);
    }
}
