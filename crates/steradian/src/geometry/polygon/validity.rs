//! What makes rings of points a polygon, and what is said when they are none.

use crate::geometry::{Direction, Point};
use crate::quantity::Length;

/// Why points are no polygon. Ring 0 is the outline, ring k the k-th hole.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PolygonError {
    /// A ring of fewer than three vertices.
    #[error("{} has {count} vertices, but needs at least 3", ring_name(*ring))]
    TooFewVertices {
        /// Which ring.
        ring: usize,
        /// How many it has.
        count: usize,
    },
    /// An infinite or NaN coordinate.
    #[error("vertex {vertex} of {} is not finite", ring_name(*ring))]
    NotFinite {
        /// Which ring.
        ring: usize,
        /// Which vertex of the ring, from 0.
        vertex: usize,
    },
    /// All vertices on a line or in a point, or holes as large as the outline.
    #[error("the polygon has no area")]
    ZeroArea,
    /// A vertex that lies off the plane.
    #[error("vertex {vertex} of {} lies {distance} off the plane of the polygon; at most {tolerance} is allowed", ring_name(*ring))]
    NotPlanar {
        /// The ring of the worst vertex.
        ring: usize,
        /// The worst vertex, from 0 in its ring.
        vertex: usize,
        /// How far it lies off.
        distance: Length,
        /// How far it may lie off.
        tolerance: Length,
    },
    /// Edges that cross, or a hole that is not inside.
    #[error("edges of the polygon cross, or a hole is not inside the outline or overlaps another")]
    CrossingEdges,
}

fn ring_name(ring: usize) -> String {
    if ring == 0 {
        "the outline".to_owned()
    } else {
        format!("hole {ring}")
    }
}

pub(super) fn check_vertices(rings: &[Vec<Point>]) -> Result<(), PolygonError> {
    for (ring, vertices) in rings.iter().enumerate() {
        if vertices.len() < 3 {
            return Err(PolygonError::TooFewVertices {
                ring,
                count: vertices.len(),
            });
        }
        if let Some(vertex) = vertices.iter().position(|vertex| !vertex.is_finite()) {
            return Err(PolygonError::NotFinite { ring, vertex });
        }
    }
    Ok(())
}

pub(super) fn check_planar(
    rings: &[Vec<Point>],
    normal: Direction,
    tolerance: Length,
) -> Result<(), PolygonError> {
    let outline = &rings[0];
    let height = |vertex: &Point| normal.dot(*vertex - outline[0]);
    let level = outline.iter().map(height).sum::<f64>() / outline.len() as f64;
    let heights = rings.iter().enumerate().flat_map(|(ring, vertices)| {
        vertices
            .iter()
            .enumerate()
            .map(move |(index, vertex)| (ring, index, (height(vertex) - level).abs()))
    });
    let worst = heights.max_by(|a, b| a.2.total_cmp(&b.2));
    match worst.map(|(ring, vertex, off)| (ring, vertex, Length::from_metres(off))) {
        Some((ring, vertex, distance)) if distance > tolerance => Err(PolygonError::NotPlanar {
            ring,
            vertex,
            distance,
            tolerance,
        }),
        _ => Ok(()),
    }
}
