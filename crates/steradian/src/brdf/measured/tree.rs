//! A tensor tree: values that are constant on the leaves of a tree of halved boxes.
//!
//! | rank | axes of the unit box |
//! |---|---|
//! | 4 | the squares of incidence and of scattering, by the map of Shirley and Chiu |
//! | 3 | (1 − sinθ_i)/2, of which only the first half is used, and the square of scattering, turned to incidence along x |
//!
//! Children and values follow each other with the last axis fastest in grids and the first axis as the lowest bit in branches, as
//! Radiance writes them. Both slices through the tree, at fixed scattering or at fixed incidence, are walked leaf by leaf: totals
//! are exact sums, and sampling follows the data without remainder. A call takes the time of the leaves that the slice meets.
//! Source: G. Ward et al., *A practical framework for sharing and rendering real-world bidirectional scattering distribution
//! functions*, LBNL-5954E (2012).

use super::MeasuredError;
use super::basis::DiscPoint;
use super::disc;

/// Halvings of the unit box at most.
const DEPTH: usize = 16;

/// Which directions the numbers of a tree belong to, as it is read.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Rank {
    /// Isotropic.
    Three,
    /// Anisotropic.
    Four,
}

impl Rank {
    /// The number of axes.
    pub const fn axes(self) -> usize {
        match self {
            Self::Three => 3,
            Self::Four => 4,
        }
    }
}

#[derive(Copy, Clone, Debug, PartialEq)]
enum Node {
    /// The number of its first child; the others follow.
    Branch(u32),
    Leaf(f32),
}

/// Builds a tree from its branches and grids in the order of a file.
#[derive(Clone, Debug)]
pub struct TreeBuilder {
    rank: Rank,
    nodes: Vec<Node>,
    /// Children that are still to come, the next one last; with its depth.
    open: Vec<(u32, usize)>,
}

impl TreeBuilder {
    /// An empty tree.
    pub fn new(rank: Rank) -> Self {
        Self {
            rank,
            nodes: vec![Node::Leaf(0.0)],
            open: vec![(0, 0)],
        }
    }

    /// Whether nothing is missing.
    pub fn is_complete(&self) -> bool {
        self.open.is_empty()
    }

    /// The next part of the box is halved along every axis; its parts follow.
    ///
    /// # Errors
    /// If the tree is complete or too deep.
    pub fn branch(&mut self) -> Result<(), MeasuredError> {
        let (node, depth) = self.open.pop().ok_or(MeasuredError::TreeComplete)?;
        let first = self.split(node, depth)?;
        let children = first..first + (1 << self.rank.axes());
        self.open
            .extend(children.rev().map(|child| (child, depth + 1)));
        Ok(())
    }

    /// The next part of the box holds a grid of these values in 1/sr, one or a power of 2ʳᵃⁿᵏ of them.
    ///
    /// # Errors
    /// If the tree is complete or too deep, their number is wrong, or one is negative or not finite.
    pub fn grid(&mut self, values: &[f32]) -> Result<(), MeasuredError> {
        let (node, depth) = self.open.pop().ok_or(MeasuredError::TreeComplete)?;
        let halvings = values.len().max(1).ilog2() as usize / self.rank.axes();
        if values.len() != 1 << (halvings * self.rank.axes()) {
            let found = values.len();
            return Err(MeasuredError::Grid { found });
        }
        super::check_values(values)?;
        self.fill(node, depth, halvings, [0; 4], values)
    }

    fn fill(
        &mut self,
        node: u32,
        depth: usize,
        halvings: usize,
        corner: [usize; 4],
        values: &[f32],
    ) -> Result<(), MeasuredError> {
        let axes = self.rank.axes();
        let Some(finer) = halvings.checked_sub(1) else {
            let side = values.len().max(1).ilog2() as usize / axes;
            let index = corner[..axes].iter().fold(0, |sum, at| (sum << side) + at);
            self.nodes[node as usize] = Node::Leaf(values[index]);
            return Ok(());
        };
        let first = self.split(node, depth)?;
        for child in 0..1_u32 << axes {
            let part: [usize; 4] =
                std::array::from_fn(|axis| corner[axis] + ((child as usize >> axis & 1) << finer));
            self.fill(first + child, depth + 1, finer, part, values)?;
        }
        Ok(())
    }

    fn split(&mut self, node: u32, depth: usize) -> Result<u32, MeasuredError> {
        let first = self.nodes.len();
        let end = first + (1 << self.rank.axes());
        if depth >= DEPTH || end > u32::MAX as usize {
            return Err(MeasuredError::TreeDepth { most: DEPTH });
        }
        self.nodes.resize(end, Node::Leaf(0.0));
        self.nodes[node as usize] = Node::Branch(first as u32);
        Ok(first as u32)
    }

    /// The tree.
    ///
    /// # Errors
    /// If parts are missing.
    pub fn build(self) -> Result<TensorTree, MeasuredError> {
        match self.is_complete() {
            true => Ok(TensorTree {
                rank: self.rank,
                nodes: self.nodes,
                reversed: false,
            }),
            false => Err(MeasuredError::TreeIncomplete),
        }
    }
}

/// Values in 1/sr by the leaves of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct TensorTree {
    rank: Rank,
    nodes: Vec<Node>,
    reversed: bool,
}

/// A box of the tree: its lowest corner and its width.
#[derive(Copy, Clone, Debug)]
struct Voxel {
    corner: [f64; 4],
    width: f64,
}

/// Part of the disc on which a slice of the tree is constant.
#[derive(Copy, Clone, Debug)]
enum Region {
    /// Part of the square.
    Square { corner: [f64; 2], width: f64 },
    /// Squares of two radii, and two azimuths.
    Sector {
        squares: [f64; 2],
        azimuths: [f64; 2],
    },
}

impl Region {
    fn area(&self) -> f64 {
        match self {
            Self::Square { width, .. } => disc::AREA * width * width,
            Self::Sector { squares, azimuths } => {
                0.5 * (azimuths[1] - azimuths[0]) * (squares[1] - squares[0])
            }
        }
    }

    fn point(&self, u: [f64; 2]) -> DiscPoint {
        match self {
            Self::Square { corner, width } => {
                disc::to_disc([0, 1].map(|k| corner[k] + width * u[k]))
            }
            Self::Sector { squares, azimuths } => {
                let radius = (squares[0] + u[0] * (squares[1] - squares[0])).sqrt();
                let azimuth = azimuths[0] + u[1] * (azimuths[1] - azimuths[0]);
                [radius * libm::cos(azimuth), radius * libm::sin(azimuth)]
            }
        }
    }
}

/// What is held fixed in a slice.
#[derive(Copy, Clone, Debug)]
enum Slice {
    /// Two coordinates of rank 4, from this axis on; the two others are free.
    Square { axis: usize, at: [f64; 2] },
    /// Incidence of rank 3.
    Incidence { at: f64 },
    /// The radius of scattering of rank 3.
    Scattering { radius: f64 },
}

impl TensorTree {
    /// Whether it is isotropic.
    pub const fn rank(&self) -> Rank {
        self.rank
    }

    /// The same surface for light that goes the other way, if it is reciprocal.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self {
            reversed: !self.reversed,
            ..self.clone()
        }
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
                let azimuth = libm::atan2(incident[1], incident[0]);
                let [b, c] = disc::to_square(turned(scattered, -azimuth));
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
        self.integral(self.slice_at_scattering(scattered))
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
        self.walk(slice, &mut |region, value| sum += value * region.area());
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
        let wanted = u[0] * total;
        let (mut sum, mut found) = (0.0, None);
        self.walk(slice, &mut |region, value| {
            let next = sum + value * region.area();
            if found.is_none() && wanted < next {
                found = Some(region.point([(wanted - sum) / (next - sum), u[1]]));
            }
            sum = next;
        });
        found.map(|point| self.oriented(scattered, point))
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
            Rank::Three => Slice::Incidence {
                at: incidence(point),
            },
        }
    }

    fn slice_at_read_scattering(&self, point: DiscPoint) -> Slice {
        match self.rank {
            Rank::Four => Slice::at_square(2, point),
            Rank::Three => Slice::Scattering {
                radius: length(point).clamp(1e-12, 1.0 - 1e-12),
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

    /// The parts of the disc on which a slice is constant, with their values in 1/sr.
    fn walk(&self, slice: Slice, visit: &mut impl FnMut(Region, f64)) {
        let meets = |voxel: Voxel| slice.meets(voxel);
        self.visit(&meets, &mut |voxel, value| {
            slice.regions(voxel, |region| visit(region, value));
        });
    }

    fn visit(&self, meets: &impl Fn(Voxel) -> bool, visit: &mut impl FnMut(Voxel, f64)) {
        let whole = Voxel {
            corner: [0.0; 4],
            width: 1.0,
        };
        self.visit_part(0, whole, meets, visit);
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
        let width = 0.5 * voxel.width;
        for child in 0..1_u32 << self.rank.axes() {
            let shift = |axis: usize| f64::from(child >> axis & 1) * width;
            let corner = std::array::from_fn(|axis| voxel.corner[axis] + shift(axis));
            self.visit_part(first + child, Voxel { corner, width }, meets, visit);
        }
    }
}

impl Slice {
    fn at_square(axis: usize, point: DiscPoint) -> Self {
        let at = disc::to_square(point).map(below_one);
        Self::Square { axis, at }
    }

    fn meets(self, voxel: Voxel) -> bool {
        let holds = |axis: usize, at: f64| {
            voxel.corner[axis] <= at && at < voxel.corner[axis] + voxel.width
        };
        match self {
            Self::Square { axis, at } => holds(axis, at[0]) && holds(axis + 1, at[1]),
            Self::Incidence { at } => holds(0, at),
            Self::Scattering { radius } => {
                let [low, high] = voxel.side(1);
                let nearest = [0, 1].map(|k| low[k].max(-high[k]).max(0.0));
                let farthest = [0, 1].map(|k| high[k].max(-low[k]));
                let used = voxel.corner[0] < 0.5;
                let inside = nearest[0].max(nearest[1]) <= radius;
                used && inside && radius <= farthest[0].max(farthest[1])
            }
        }
    }

    fn regions(self, voxel: Voxel, mut visit: impl FnMut(Region)) {
        let square = |axis: usize| Region::Square {
            corner: [voxel.corner[axis], voxel.corner[axis + 1]],
            width: voxel.width,
        };
        match self {
            Self::Square { axis, .. } => visit(square(2 - axis)),
            Self::Incidence { .. } => visit(square(1)),
            Self::Scattering { radius } => {
                let [low, high] = voxel.side(1);
                let radii = [voxel.corner[0] + voxel.width, voxel.corner[0]]
                    .map(|at| (1.0 - 2.0 * at).max(0.0));
                let squares = radii.map(|r| r * r);
                disc::azimuths_within(low, high, radius)
                    .for_each(|azimuths| visit(Region::Sector { squares, azimuths }));
            }
        }
    }
}

impl Voxel {
    /// Two axes, stretched to −1 … 1: the lowest and the highest corner.
    fn side(&self, axis: usize) -> [[f64; 2]; 2] {
        let low = [0, 1].map(|k| 2.0 * self.corner[axis + k] - 1.0);
        [low, low.map(|x| x + 2.0 * self.width)]
    }
}

/// The coordinate of incidence of rank 3: half of the box is used, ends of cells belong to the lower cell.
fn incidence(point: DiscPoint) -> f64 {
    (0.5 * (1.0 - length(point)) - 1e-12).max(0.0)
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
