//! Slices through a tree, and the parts of the disc on which they are constant.

use std::f64::consts::{FRAC_PI_4, PI};

use super::below_one;
use crate::brdf::measured::basis::DiscPoint;
use crate::brdf::measured::disc;

/// A box of the tree: its lowest corner and its width.
#[derive(Copy, Clone, Debug)]
pub(super) struct Voxel {
    pub(super) corner: [f64; 4],
    pub(super) width: f64,
}

impl Voxel {
    /// The unit box.
    pub(super) const WHOLE: Self = Self {
        corner: [0.0; 4],
        width: 1.0,
    };

    /// A part of it when it is halved along every axis.
    pub(super) fn part(&self, child: u32) -> Self {
        let width = 0.5 * self.width;
        let shift = |axis: usize| f64::from(child >> axis & 1) * width;
        let corner = std::array::from_fn(|axis| self.corner[axis] + shift(axis));
        Self { corner, width }
    }

    /// Two axes, stretched to −1 … 1: the lowest and the highest corner.
    fn side(&self, axis: usize) -> [[f64; 2]; 2] {
        let low = [0, 1].map(|k| 2.0 * self.corner[axis + k] - 1.0);
        [low, low.map(|x| x + 2.0 * self.width)]
    }

    /// Of the square of scattering of rank 3: how far it is from the axes of the stretched square.
    fn nearest(&self) -> [f64; 2] {
        let [low, high] = self.side(1);
        [0, 1].map(|k| low[k].max(-high[k]).max(0.0))
    }

    /// The least radius of scattering of rank 3.
    fn inner_radius(&self) -> f64 {
        let [x, y] = self.nearest();
        x.max(y)
    }

    /// Squares of the radii of incidence of rank 3.
    fn squares(&self) -> [f64; 2] {
        let radii = [self.corner[0] + self.width, self.corner[0]];
        radii.map(|at| (1.0 - 2.0 * at).max(0.0)).map(|r| r * r)
    }
}

/// Part of the disc on which a slice of the tree is constant.
#[derive(Copy, Clone, Debug)]
pub(super) enum Region {
    /// Part of the square.
    Square { corner: [f64; 2], width: f64 },
    /// Squares of two radii, and two azimuths.
    Sector {
        squares: [f64; 2],
        azimuths: [f64; 2],
    },
}

impl Region {
    pub(super) fn area(&self) -> f64 {
        match self {
            Self::Square { width, .. } => disc::AREA * width * width,
            Self::Sector { squares, azimuths } => {
                0.5 * (azimuths[1] - azimuths[0]) * (squares[1] - squares[0])
            }
        }
    }

    pub(super) fn point(&self, u: [f64; 2]) -> DiscPoint {
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

/// Which coordinates are held fixed.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Fixed {
    /// Two coordinates of rank 4, from this axis on; the two others are free.
    Square { axis: usize },
    /// Incidence of rank 3.
    Incidence,
    /// The radius of scattering of rank 3.
    Radius,
}

impl Fixed {
    /// Into how many parts halving divides what is fixed.
    pub(super) const fn parts(self) -> usize {
        match self {
            Self::Square { .. } => 4,
            Self::Incidence | Self::Radius => 2,
        }
    }

    /// Which of them a child of a box has; none where all have the whole, as the quarters around the normal have all radii.
    pub(super) fn part_of(self, voxel: Voxel, child: u32) -> Option<usize> {
        match self {
            Self::Square { axis } => Some((child >> axis & 3) as usize),
            Self::Incidence => Some((child & 1) as usize),
            Self::Radius if voxel.width == 1.0 => None,
            Self::Radius => {
                let outwards = voxel.part(child).inner_radius() - voxel.inner_radius();
                Some(usize::from(outwards > 0.0))
            }
        }
    }

    /// The area of the disc that a box has in a slice: the first number, or the sum of both, the second over the radius.
    pub(super) fn area(self, voxel: Voxel) -> [f64; 2] {
        if self != Self::Radius {
            return [disc::AREA * voxel.width * voxel.width, 0.0];
        }
        let [inner, outer] = voxel.squares();
        let ring = 0.5 * FRAC_PI_4 * (outer - inner);
        let [x, y] = voxel.nearest();
        if voxel.width == 1.0 {
            [PI * (outer - inner), 0.0]
        } else if x == y {
            [2.0 * ring, -2.0 * ring * x]
        } else {
            [0.0, 2.0 * ring * voxel.width]
        }
    }
}

/// What is held fixed, and where.
#[derive(Copy, Clone, Debug)]
pub(super) struct Slice {
    pub(super) fixed: Fixed,
    /// One coordinate or two.
    pub(super) at: [f64; 2],
}

impl Slice {
    pub(super) fn at_square(axis: usize, point: DiscPoint) -> Self {
        Self {
            fixed: Fixed::Square { axis },
            at: disc::to_square(point).map(below_one),
        }
    }

    pub(super) fn meets(&self, voxel: Voxel) -> bool {
        let [x, y] = self.at;
        let holds = |axis: usize, at: f64| {
            voxel.corner[axis] <= at && at < voxel.corner[axis] + voxel.width
        };
        match self.fixed {
            Fixed::Square { axis } => holds(axis, x) && holds(axis + 1, y),
            Fixed::Incidence => holds(0, x),
            Fixed::Radius => {
                let inner = voxel.inner_radius();
                voxel.corner[0] < 0.5 && inner <= x && x < inner + 2.0 * voxel.width
            }
        }
    }

    pub(super) fn regions(&self, voxel: Voxel, mut visit: impl FnMut(Region)) {
        let square = |axis: usize| Region::Square {
            corner: [voxel.corner[axis], voxel.corner[axis + 1]],
            width: voxel.width,
        };
        match self.fixed {
            Fixed::Square { axis } => visit(square(2 - axis)),
            Fixed::Incidence => visit(square(1)),
            Fixed::Radius => {
                let [low, high] = voxel.side(1);
                let squares = voxel.squares();
                disc::azimuths_within(low, high, self.at[0])
                    .for_each(|azimuths| visit(Region::Sector { squares, azimuths }));
            }
        }
    }
}
