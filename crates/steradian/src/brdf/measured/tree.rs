//! A tensor tree: values that are constant on the leaves of a tree of halved boxes.
//!
//! | rank | axes of the unit box |
//! |---|---|
//! | 4 | the squares of incidence and of scattering, by the map of Shirley and Chiu |
//! | 3 | (1 − sinθ_i)/2, of which only the first half is used, and the square of scattering, turned to incidence along x |
//!
//! Children and values follow each other with the last axis fastest in grids and the first axis as the lowest bit in branches, as
//! Radiance writes them. Totals are exact sums over the leaves that a slice through the tree meets, at fixed scattering or at fixed
//! incidence, and sampling follows the data without remainder. At fixed scattering, where light is drawn, the sums are made once,
//! branch by branch: a call takes the time of a descent. At fixed incidence it takes that of the leaves that the slice meets.
//! Source: G. Ward et al., *A practical framework for sharing and rendering real-world bidirectional scattering distribution
//! functions*, LBNL-5954E (2012).

mod builder;
mod slice;
mod sums;

use super::basis::DiscPoint;
use super::disc;
use builder::Node;
pub use builder::{Rank, TreeBuilder};
use slice::{Fixed, Slice, Voxel};
use sums::Sums;

/// Values in 1/sr by the leaves of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct TensorTree {
    rank: Rank,
    nodes: Vec<Node>,
    reversed: bool,
    /// At fixed scattering.
    sums: Sums,
}

/// A node, its box, and how often the unit box was halved.
#[derive(Copy, Clone, Debug)]
struct Place {
    node: Node,
    voxel: Voxel,
    depth: usize,
}

impl TensorTree {
    fn new(rank: Rank, nodes: Vec<Node>, reversed: bool) -> Self {
        let fixed = match (rank, reversed) {
            (Rank::Four, true) => Fixed::Square { axis: 0 },
            (Rank::Four, false) => Fixed::Square { axis: 2 },
            (Rank::Three, true) => Fixed::Incidence,
            (Rank::Three, false) => Fixed::Radius,
        };
        let sums = Sums::new(rank, &nodes, fixed);
        Self {
            rank,
            nodes,
            reversed,
            sums,
        }
    }

    /// Whether it is isotropic.
    pub const fn rank(&self) -> Rank {
        self.rank
    }

    /// The same surface for light that goes the other way, if it is reciprocal.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self::new(self.rank, self.nodes.clone(), !self.reversed)
    }

    /// The number of leaves.
    pub fn leaves(&self) -> usize {
        let is_leaf = |node: &&Node| matches!(node, Node::Leaf(_));
        self.nodes.iter().filter(is_leaf).count()
    }

    /// The width of the smallest leaf, a power of ½.
    pub fn resolution(&self) -> f64 {
        let mut smallest = 1.0_f64;
        self.visit(&|_| true, &mut |voxel, _| {
            smallest = smallest.min(voxel.width)
        });
        smallest
    }

    pub(super) fn value(&self, scattered: DiscPoint, incident: DiscPoint) -> f64 {
        let (scattered, incident) = self.as_read(scattered, incident);
        let place = match self.rank {
            Rank::Four => {
                let ([a, b], [c, d]) = (disc::to_square(incident), disc::to_square(scattered));
                [a, b, c, d]
            }
            Rank::Three => {
                let [from, to] = [incident, scattered].map(|[x, y]| libm::atan2(y, x));
                let [b, c] = disc::polar_to_square(radius(scattered), to - from);
                [incidence(incident), b, c, 0.0]
            }
        };
        self.look_up(place.map(below_one))
    }

    fn look_up(&self, mut place: [f64; 4]) -> f64 {
        let mut node = self.nodes[0];
        loop {
            match node {
                Node::Leaf(value) => return f64::from(value),
                Node::Branch(first) => {
                    let mut child = 0;
                    for axis in 0..self.rank.axes() {
                        let upper = place[axis] >= 0.5;
                        child |= usize::from(upper) << axis;
                        place[axis] = 2.0 * place[axis] - f64::from(u8::from(upper));
                    }
                    node = self.nodes[first as usize + child];
                }
            }
        }
    }

    /// ∫ ρ cosθ dω over all incidence.
    pub(super) fn total(&self, scattered: DiscPoint) -> f64 {
        self.sum(self.root(), &self.slice_at_scattering(scattered))
    }

    /// ∫ ρ cosθ dω over all scattering.
    pub(super) fn hemispherical_at(&self, incident: DiscPoint) -> f64 {
        self.integral(match self.reversed {
            true => self.slice_at_read_scattering(opposite(incident)),
            false => self.slice_at_read_incidence(incident),
        })
    }

    fn integral(&self, slice: Slice) -> f64 {
        let mut sum = 0.0;
        let meets = |voxel: Voxel| slice.meets(voxel);
        self.visit(&meets, &mut |voxel, value| {
            slice.regions(voxel, |region| sum += value * region.area());
        });
        sum
    }

    /// Incidence of density ρ/total on the disc.
    pub(super) fn sample(
        &self,
        scattered: DiscPoint,
        total: f64,
        u: [f64; 2],
    ) -> Option<DiscPoint> {
        let slice = self.slice_at_scattering(scattered);
        let (mut place, mut rest) = (self.root(), u[0] * total);
        while let Node::Branch(first) = place.node {
            let parts = self.children(place, first);
            let met = parts.filter(|part| slice.meets(part.voxel));
            (place, rest, _) = choose(met.map(|part| (part, self.sum(part, &slice))), rest)?;
        }
        let mut regions = Vec::new();
        slice.regions(place.voxel, |region| regions.push(region));
        let areas = regions.into_iter().map(|region| (region, region.area()));
        let Node::Leaf(value) = place.node else {
            return None;
        };
        let (region, rest, area) = choose(areas, rest / f64::from(value))?;
        let point = region.point([(rest / area).clamp(0.0, 1.0), u[1]]);
        Some(self.oriented(scattered, point))
    }

    fn root(&self) -> Place {
        Place {
            node: self.nodes[0],
            voxel: Voxel::WHOLE,
            depth: 0,
        }
    }

    fn children(&self, of: Place, first: u32) -> impl Iterator<Item = Place> + '_ {
        (0..1_u32 << self.rank.axes()).map(move |child| Place {
            node: self.nodes[(first + child) as usize],
            voxel: of.voxel.part(child),
            depth: of.depth + 1,
        })
    }

    fn sum(&self, place: Place, slice: &Slice) -> f64 {
        self.sums.at(place.node, place.voxel, place.depth, slice)
    }

    /// The directions as the tree was read.
    fn as_read(&self, scattered: DiscPoint, incident: DiscPoint) -> (DiscPoint, DiscPoint) {
        match self.reversed {
            true => (opposite(incident), opposite(scattered)),
            false => (scattered, incident),
        }
    }

    fn slice_at_scattering(&self, scattered: DiscPoint) -> Slice {
        match self.reversed {
            true => self.slice_at_read_incidence(opposite(scattered)),
            false => self.slice_at_read_scattering(scattered),
        }
    }

    fn slice_at_read_incidence(&self, point: DiscPoint) -> Slice {
        match self.rank {
            Rank::Four => Slice::at_square(0, point),
            Rank::Three => Slice {
                fixed: Fixed::Incidence,
                at: [incidence(point), 0.0],
            },
        }
    }

    fn slice_at_read_scattering(&self, point: DiscPoint) -> Slice {
        match self.rank {
            Rank::Four => Slice::at_square(2, point),
            Rank::Three => Slice {
                fixed: Fixed::Radius,
                at: [radius(point), 0.0],
            },
        }
    }

    /// From the frame of a slice to the disc of incidence.
    fn oriented(&self, scattered: DiscPoint, point: DiscPoint) -> DiscPoint {
        match (self.rank, self.reversed) {
            (Rank::Four, false) => point,
            (Rank::Four, true) => opposite(point),
            // The azimuth of scattering as seen from incidence is that of scattering less that of incidence.
            (Rank::Three, false) => {
                let azimuth = libm::atan2(scattered[1], scattered[0]);
                turned([point[0], -point[1]], azimuth)
            }
            (Rank::Three, true) => {
                let azimuth = libm::atan2(-scattered[1], -scattered[0]);
                opposite(turned(point, azimuth))
            }
        }
    }

    fn visit(&self, meets: &impl Fn(Voxel) -> bool, visit: &mut impl FnMut(Voxel, f64)) {
        self.visit_part(0, Voxel::WHOLE, meets, visit);
    }

    fn visit_part(
        &self,
        node: u32,
        voxel: Voxel,
        meets: &impl Fn(Voxel) -> bool,
        visit: &mut impl FnMut(Voxel, f64),
    ) {
        if !meets(voxel) {
            return;
        }
        let first = match self.nodes[node as usize] {
            Node::Leaf(value) => return visit(voxel, f64::from(value)),
            Node::Branch(first) => first,
        };
        for child in 0..1_u32 << self.rank.axes() {
            self.visit_part(first + child, voxel.part(child), meets, visit);
        }
    }
}

/// The one in which `wanted` lies when shares follow each other: itself, what is left of `wanted`, and its share.
///
/// The last that is not 0, if rounding led beyond.
fn choose<T>(shares: impl Iterator<Item = (T, f64)>, wanted: f64) -> Option<(T, f64, f64)> {
    let (mut rest, mut last) = (wanted, None);
    for (one, share) in shares.filter(|(_, share)| *share > 0.0) {
        let found = rest < share;
        last = Some((one, rest.min(share), share));
        if found {
            break;
        }
        rest -= share;
    }
    last
}

/// The coordinate of incidence of rank 3: half of the box is used, ends of cells belong to the lower cell.
fn incidence(point: DiscPoint) -> f64 {
    (0.5 * (1.0 - length(point)) - 1e-12).max(0.0)
}

/// The radius of scattering of rank 3: not 0, and not where boxes end, so that all around the same ones are met.
fn radius(point: DiscPoint) -> f64 {
    (length(point) * (1.0 - 1e-12)).clamp(1e-12, 1.0 - 1e-12)
}

fn length([x, y]: DiscPoint) -> f64 {
    (x * x + y * y).sqrt()
}

fn opposite([x, y]: DiscPoint) -> DiscPoint {
    [-x, -y]
}

fn turned([x, y]: DiscPoint, azimuth: f64) -> DiscPoint {
    let (sin, cos) = (libm::sin(azimuth), libm::cos(azimuth));
    [x * cos - y * sin, x * sin + y * cos]
}

fn below_one(x: f64) -> f64 {
    x.clamp(0.0, 1.0 - f64::EPSILON / 2.0)
}

#[cfg(test)]
mod tests;
