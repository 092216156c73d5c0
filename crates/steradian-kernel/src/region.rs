//! Is a convex region free of primitives?
//!
//! The region is an intersection of half-spaces `n · x ≤ d`. A box or a curved primitive is outside if one plane separates
//! it; a polygon, if nothing is left after clipping it by all planes (Sutherland & Hodgman 1974) in homogeneous coordinates,
//! in which an infinite plane is four triangles with two corners at infinity each. Each comparison leaves a margin for its
//! rounding on the side of "blocked".

use crate::accelerator::Accelerator;
use crate::geometry::Quadric;
use crate::node::{Below, Bounds, Leaf};

/// Relative to the sum of the magnitudes of a plane equation's terms.
const MARGIN: f64 = 1e-12;

/// A point `xyz/w`, or a direction for w = 0.
type Homogeneous = [f64; 4];

/// `[n_x, n_y, n_z, d]`.
type HalfSpace = [f64; 4];

pub(crate) fn is_clear(
    accelerator: &Accelerator,
    planes: &[HalfSpace],
    ignore: &dyn Fn(u32) -> bool,
) -> bool {
    let quadric_blocks = |index: usize| {
        !ignore(accelerator.quadric_number(index))
            && reaches(&accelerator.quadrics()[index], planes)
    };
    if accelerator
        .unbounded()
        .iter()
        .any(|&index| quadric_blocks(index as usize))
    {
        return false;
    }
    let tree = accelerator.tree();
    let mut clipper = Clipper::default();
    let mut open: Vec<usize> = (0..tree.nodes.len().min(1)).collect();
    while let Some(node) = open.pop() {
        for (bounds, child) in tree.nodes[node].used() {
            if is_outside(&bounds, planes) {
                continue;
            }
            let blocked = match child.below() {
                Below::Node(index) => {
                    open.push(index);
                    false
                }
                Below::Leaf(index) => {
                    leaf_blocks(&tree.leaves[index], planes, ignore, &mut clipper)
                }
                Below::Quadric(index) => quadric_blocks(index),
            };
            if blocked {
                return false;
            }
        }
    }
    true
}

fn leaf_blocks(
    leaf: &Leaf,
    planes: &[HalfSpace],
    ignore: &dyn Fn(u32) -> bool,
    clipper: &mut Clipper,
) -> bool {
    leaf.lanes().any(|(lane, number)| {
        let corners = leaf.triangle(lane, [0, 1, 2]);
        let corners = corners.map(|[x, y, z]| [x.into(), y.into(), z.into(), 1.0]);
        !ignore(number) && clipper.reaches(&corners, planes)
    })
}

fn reaches(quadric: &Quadric, planes: &[HalfSpace]) -> bool {
    match quadric {
        Quadric::Plane { point, normal } => plane_triangles(*point, *normal)
            .into_iter()
            .any(|triangle| Clipper::default().reaches(&triangle, planes)),
        bounded => !planes
            .iter()
            .any(|&[x, y, z, offset]| bounded.is_beyond([x, y, z], offset)),
    }
}

/// The lowest corner of the box along a plane's normal is still outside.
fn is_outside(bounds: &Bounds, planes: &[HalfSpace]) -> bool {
    planes.iter().any(|plane| {
        let lowest = [0, 1, 2].map(|k| {
            f64::from(if plane[k] > 0.0 {
                bounds.lower[k]
            } else {
                bounds.upper[k]
            })
        });
        excess(plane, &[lowest[0], lowest[1], lowest[2], 1.0]) > 0.0
    })
}

/// Positive if the point is certainly outside the half-space: n · x − d·w less the margin.
fn excess(plane: &HalfSpace, point: &Homogeneous) -> f64 {
    let terms = [
        plane[0] * point[0],
        plane[1] * point[1],
        plane[2] * point[2],
        -plane[3] * point[3],
    ];
    terms.iter().sum::<f64>() - MARGIN * terms.iter().map(|term| term.abs()).sum::<f64>()
}

/// Clips polygons, and keeps its memory between them.
#[derive(Default)]
struct Clipper {
    polygon: Vec<Homogeneous>,
    clipped: Vec<Homogeneous>,
}

impl Clipper {
    /// Whether a point at a finite distance is left of the triangle.
    fn reaches(&mut self, triangle: &[Homogeneous; 3], planes: &[HalfSpace]) -> bool {
        let beyond = |plane| triangle.iter().all(|point| excess(plane, point) > 0.0);
        if planes.iter().any(beyond) {
            return false;
        }
        self.polygon.clear();
        self.polygon.extend(triangle);
        for plane in planes {
            self.clip(plane);
            if self.polygon.is_empty() {
                return false;
            }
        }
        self.polygon.iter().any(|point| point[3] > 0.0)
    }

    /// Leaves the part inside a half-space and its margin.
    fn clip(&mut self, plane: &HalfSpace) {
        self.clipped.clear();
        for (index, point) in self.polygon.iter().enumerate() {
            let next = &self.polygon[(index + 1) % self.polygon.len()];
            let (here, there) = (excess(plane, point), excess(plane, next));
            if here <= 0.0 {
                self.clipped.push(*point);
            }
            if (here <= 0.0) != (there <= 0.0) {
                let s = here / (here - there);
                let crossing = [0, 1, 2, 3].map(|k| point[k] + s * (next[k] - point[k]));
                self.clipped.push(crossing);
            }
        }
        std::mem::swap(&mut self.polygon, &mut self.clipped);
    }
}

/// Four sectors around `point`, each with two corners at infinity.
fn plane_triangles(point: [f64; 3], normal: [f64; 3]) -> [[Homogeneous; 3]; 4] {
    let smallest = (0..3)
        .min_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()))
        .unwrap_or(0);
    let mut helper = [0.0; 3];
    helper[smallest] = 1.0;
    let e = unit(cross(normal, helper));
    let f = unit(cross(normal, e));
    let at_infinity = |v: [f64; 3], sign: f64| [sign * v[0], sign * v[1], sign * v[2], 0.0];
    let center = [point[0], point[1], point[2], 1.0];
    let around = [
        at_infinity(e, 1.0),
        at_infinity(f, 1.0),
        at_infinity(e, -1.0),
        at_infinity(f, -1.0),
    ];
    [0, 1, 2, 3].map(|k| [center, around[k], around[(k + 1) % 4]])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}
