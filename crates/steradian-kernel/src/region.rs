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

/// A primitive that reaches into a region.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Its number.
    pub primitive: u32,
    /// The corners of a triangle.
    pub corners: Option<[[f32; 3]; 3]>,
}

/// Asks an accelerator about regions, in memory that is used again.
pub struct Regions<'a> {
    accelerator: &'a Accelerator,
    open: Vec<usize>,
    clipper: Clipper,
}

impl<'a> Regions<'a> {
    pub(crate) fn new(accelerator: &'a Accelerator) -> Self {
        Self {
            accelerator,
            open: vec![],
            clipper: Clipper::default(),
        }
    }

    /// Adds the primitives that reach into the region of the points x with n · x ≤ d for every plane `[n_x, n_y, n_z, d]`, except those that
    /// `ignore` accepts; false, and not all of them, if they are more than `most`. [`Accelerator::region_is_clear`] tells what counts.
    pub fn collect(
        &mut self,
        planes: &[HalfSpace],
        ignore: &dyn Fn(u32) -> bool,
        most: usize,
        obstacles: &mut Vec<Obstacle>,
    ) -> bool {
        let most = obstacles.len() + most;
        self.each(planes, ignore, &mut |obstacle| {
            obstacles.push(obstacle);
            obstacles.len() <= most
        })
    }

    /// Whether an obstacle of another region reaches into this one.
    pub fn reaches(&mut self, planes: &[HalfSpace], obstacle: &Obstacle) -> bool {
        match &obstacle.corners {
            Some(corners) => self.clipper.reaches(&corners.map(homogeneous), planes),
            None => {
                let first = self.accelerator.quadric_number(0);
                let index = obstacle.primitive - first;
                reaches(&self.accelerator.quadrics()[index as usize], planes)
            }
        }
    }

    /// Shows the primitives in a region one by one for as long as `go_on` accepts them, and tells whether it always did.
    pub(crate) fn each(
        &mut self,
        planes: &[HalfSpace],
        ignore: &dyn Fn(u32) -> bool,
        go_on: &mut dyn FnMut(Obstacle) -> bool,
    ) -> bool {
        let accelerator = self.accelerator;
        for &index in accelerator.unbounded() {
            if !quadric_passes(accelerator, index as usize, (planes, ignore), go_on) {
                return false;
            }
        }
        let tree = accelerator.tree();
        self.open.clear();
        self.open.extend(0..tree.nodes.len().min(1));
        while let Some(node) = self.open.pop() {
            for (bounds, child) in tree.nodes[node].used() {
                if is_outside(&bounds, planes) {
                    continue;
                }
                let passed = match child.below() {
                    Below::Node(index) => {
                        self.open.push(index);
                        true
                    }
                    Below::Leaf(index) => {
                        let clipper = &mut self.clipper;
                        leaf_passes(&tree.leaves[index], (planes, ignore), clipper, go_on)
                    }
                    Below::Quadric(index) => {
                        quadric_passes(accelerator, index, (planes, ignore), go_on)
                    }
                };
                if !passed {
                    return false;
                }
            }
        }
        true
    }
}

fn leaf_passes(
    leaf: &Leaf,
    (planes, ignore): (&[HalfSpace], &dyn Fn(u32) -> bool),
    clipper: &mut Clipper,
    go_on: &mut dyn FnMut(Obstacle) -> bool,
) -> bool {
    leaf.lanes().all(|(lane, primitive)| {
        let corners = leaf.triangle(lane, [0, 1, 2]);
        ignore(primitive)
            || !clipper.reaches(&corners.map(homogeneous), planes)
            || go_on(Obstacle {
                primitive,
                corners: Some(corners),
            })
    })
}

fn quadric_passes(
    accelerator: &Accelerator,
    index: usize,
    (planes, ignore): (&[HalfSpace], &dyn Fn(u32) -> bool),
    go_on: &mut dyn FnMut(Obstacle) -> bool,
) -> bool {
    let primitive = accelerator.quadric_number(index);
    ignore(primitive)
        || !reaches(&accelerator.quadrics()[index], planes)
        || go_on(Obstacle {
            primitive,
            corners: None,
        })
}

fn homogeneous([x, y, z]: [f32; 3]) -> Homogeneous {
    [x.into(), y.into(), z.into(), 1.0]
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
