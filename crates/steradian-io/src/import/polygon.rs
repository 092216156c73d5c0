//! Cutting polygons of mesh files into triangles.

use earcut::utils3d::project3d_to_2d;
use earcut::{Earcut, deviation};
use steradian::geometry::Point;
use thiserror::Error;

/// A concave polygon beyond this many corners is refused, for the time that cutting it may take grows with its square.
pub const MOST_CORNERS: usize = 10_000;

/// The part of a polygon's area that may be rounding.
const MOST_DEVIATION: f64 = 1e-9;

/// A concave polygon of too many corners.
#[derive(Copy, Clone, Debug, Error, PartialEq, Eq)]
#[error(
    "a concave polygon of {0} corners is not cut into triangles: at most {MOST_CORNERS} are allowed"
)]
pub struct PolygonTooLarge(pub usize);

/// Cuts polygons, and keeps its buffers between them.
#[derive(Default)]
pub(super) struct Cutter {
    earcut: Earcut<f64>,
    points: Vec<[f64; 3]>,
    flat: Vec<[f64; 2]>,
}

impl Cutter {
    /// Appends the triangles of the polygon with these three or more corners, which are numbers of vertices.
    ///
    /// A polygon without area becomes triangles without area.
    pub fn cut(
        &mut self,
        vertices: &[Point],
        corners: &[u32],
        triangles: &mut Vec<[u32; 3]>,
    ) -> Result<(), PolygonTooLarge> {
        if let [a, b, c] = corners[..] {
            triangles.push([a, b, c]);
            return Ok(());
        }
        let numbers = self.triangles(vertices, corners)?;
        let named = numbers
            .chunks_exact(3)
            .map(|triple| [0, 1, 2].map(|i| corners[triple[i] as usize]));
        triangles.extend(named);
        Ok(())
    }

    /// Corner numbers of the triangles.
    ///
    /// A fan from the first corner keeps every edge, so that neighbours leave no crack. Where it would fold back it is
    /// right only if the polygon crosses itself, by being far from plane; otherwise ears are cut.
    fn triangles(
        &mut self,
        vertices: &[Point],
        corners: &[u32],
    ) -> Result<Vec<u32>, PolygonTooLarge> {
        let places = corners.iter().map(|&corner| vertices[corner as usize]);
        self.points.clear();
        self.points.extend(places.map(|point| point.to_array()));
        self.flat.clear();
        let fan = fan(corners.len());
        let has_area = project3d_to_2d(&self.points, self.points.len(), &mut self.flat);
        if !has_area || !folds_back(&self.flat, &fan) {
            return Ok(fan);
        }
        if corners.len() > MOST_CORNERS {
            return Err(PolygonTooLarge(corners.len()));
        }
        Ok(self.ears().unwrap_or(fan))
    }

    /// Triangles that cover the whole polygon, if there are such.
    fn ears(&mut self) -> Option<Vec<u32>> {
        let (polygon, no_holes): (_, &[u32]) = (&self.flat, &[]);
        let mut ears: Vec<u32> = Vec::new();
        self.earcut
            .earcut(polygon.iter().copied(), no_holes, &mut ears);
        let is_cut = deviation(polygon.iter().copied(), no_holes, &ears) < MOST_DEVIATION;
        is_cut.then_some(ears)
    }
}

fn fan(corners: usize) -> Vec<u32> {
    (1..corners as u32 - 1)
        .flat_map(|corner| [0, corner, corner + 1])
        .collect()
}

/// Whether a triangle turns against the others, by more than rounding.
fn folds_back(polygon: &[[f64; 2]], triangles: &[u32]) -> bool {
    let areas = triangles.chunks_exact(3).map(|triple| {
        let [a, b, c] = [0, 1, 2].map(|i| polygon[triple[i] as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    });
    let all: f64 = areas.clone().map(f64::abs).sum();
    areas.into_iter().any(|area| area < -MOST_DEVIATION * all)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(points: &[[f64; 3]], corners: &[u32]) -> Vec<[u32; 3]> {
        let vertices: Vec<Point> = points
            .iter()
            .map(|[x, y, z]| Point::new(*x, *y, *z))
            .collect();
        let mut triangles = Vec::new();
        Cutter::default()
            .cut(&vertices, corners, &mut triangles)
            .unwrap();
        triangles
    }

    #[test]
    fn concave_polygons_keep_their_area_and_side() {
        // An arrowhead of area 2 − 1 = 1, once seen from either side; a fan from its first corner would cover 3.
        let points = [
            [1.0, 0.0, 0.0],
            [2.0, -1.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, -1.0, 0.0],
        ];
        for (corners, area) in [
            ([0, 1, 2, 3], 1.0),
            ([3, 2, 1, 0], -1.0),
            ([1, 2, 3, 0], 1.0),
        ] {
            let triangles = cut(&points, &corners);
            assert_eq!(triangles.len(), 2);
            let areas = triangles.iter().map(|triangle| {
                let [a, b, c] = triangle.map(|index| points[index as usize]);
                ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
            });
            assert!(areas.clone().all(|part| part * area > 0.0), "{corners:?}");
            assert!((areas.sum::<f64>() - area).abs() < 1e-15, "{corners:?}");
        }
    }

    #[test]
    fn every_corner_and_edge_is_kept() {
        // A unit square with a corner in the middle of a side, and one that is folded along its diagonal.
        let square = [[0.0, 0.0], [0.5, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let square = square.map(|[x, y]| [x, y, 0.0]);
        assert_eq!(
            cut(&square, &[0, 1, 2, 3, 4]),
            [[0, 1, 2], [0, 2, 3], [0, 3, 4]]
        );
        let folded = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 4.0],
            [0.0, 0.0, 0.1],
            [0.0, 1.0, 4.0],
        ];
        assert_eq!(cut(&folded, &[0, 1, 2, 3]).len(), 2);
    }

    #[test]
    fn a_polygon_without_area_stays_so() {
        let edge = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
        assert_eq!(cut(&edge, &[0, 1, 0, 1]), [[0, 1, 0], [0, 0, 1]]);
    }

    #[test]
    fn huge_polygons_are_cut_if_convex_and_refused_if_not() {
        let corners = MOST_CORNERS as u32 + 2;
        let comb = |x: u32, depth: f64| {
            Point::new(
                f64::from(x),
                if x.is_multiple_of(2) { 0.0 } else { depth },
                0.0,
            )
        };
        let polygon = |depth| {
            let teeth = (0..corners).map(|x| comb(x, depth));
            teeth
                .chain([
                    Point::new(f64::from(corners), 9.0, 0.0),
                    Point::new(-1.0, 9.0, 0.0),
                ])
                .collect::<Vec<_>>()
        };
        let numbers: Vec<u32> = (0..corners + 2).collect();
        let cut = |vertices: &[Point]| Cutter::default().cut(vertices, &numbers, &mut Vec::new());
        assert_eq!(cut(&polygon(0.0)), Ok(()));
        assert_eq!(
            cut(&polygon(3.0)),
            Err(PolygonTooLarge(corners as usize + 2))
        );
    }
}
