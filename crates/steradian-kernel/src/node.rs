//! The nodes of the eight-wide tree.

/// Children of a node, triangles of a leaf.
pub(crate) const WIDTH: usize = 8;

/// An axis-parallel box.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) lower: [f32; 3],
    pub(crate) upper: [f32; 3],
}

impl Bounds {
    /// Holds nothing.
    pub(crate) const EMPTY: Self = Self {
        lower: [f32::INFINITY; 3],
        upper: [f32::NEG_INFINITY; 3],
    };

    /// The smallest box with these points.
    pub(crate) fn of_points(points: &[[f32; 3]]) -> Self {
        points.iter().fold(Self::EMPTY, |bounds, &point| {
            bounds.union(Self {
                lower: point,
                upper: point,
            })
        })
    }

    pub(crate) fn union(self, other: Self) -> Self {
        Self {
            lower: [0, 1, 2].map(|k| self.lower[k].min(other.lower[k])),
            upper: [0, 1, 2].map(|k| self.upper[k].max(other.upper[k])),
        }
    }

    /// Half the surface: the probability of a hit, up to a factor.
    pub(crate) fn half_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|k| self.upper[k] - self.lower[k]);
        x * y + y * z + z * x
    }

    /// Whether another box is flat and lies in one of the faces.
    pub(crate) fn has_in_a_face(&self, other: &Self) -> bool {
        (0..3).any(|k| {
            other.lower[k] == other.upper[k]
                && (other.lower[k] == self.lower[k] || other.upper[k] == self.upper[k])
        })
    }
}

/// Eight boxes, a column for each plane. 256 bytes, four cache lines.
#[derive(Clone)]
#[repr(C, align(256))]
pub(crate) struct Node {
    /// `planes[axis][0]` are the lower ones, `planes[axis][1]` the upper ones. Unused lanes hold an empty box.
    pub(crate) planes: [[[f32; WIDTH]; 2]; 3],
    pub(crate) children: [Child; WIDTH],
}

impl Node {
    pub(crate) const EMPTY: Self = Self {
        planes: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3],
        children: [Child::NONE; WIDTH],
    };

    pub(crate) fn set(&mut self, lane: usize, bounds: &Bounds, child: Child) {
        for (axis, planes) in self.planes.iter_mut().enumerate() {
            planes[0][lane] = bounds.lower[axis];
            planes[1][lane] = bounds.upper[axis];
        }
        self.children[lane] = child;
    }

    /// The children and their boxes.
    pub(crate) fn used(&self) -> impl Iterator<Item = (Bounds, Child)> {
        let lanes = (0..WIDTH).filter(|&lane| self.children[lane] != Child::NONE);
        lanes.map(|lane| (self.bounds(lane), self.children[lane]))
    }

    pub(crate) fn bounds(&self, lane: usize) -> Bounds {
        Bounds {
            lower: [0, 1, 2].map(|axis| self.planes[axis][0][lane]),
            upper: [0, 1, 2].map(|axis| self.planes[axis][1][lane]),
        }
    }
}

/// What is below a node: a kind in the two highest bits and an index.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub(crate) struct Child(pub(crate) u32);

/// A [`Child`] taken apart.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(crate) enum Below {
    Node(usize),
    Leaf(usize),
    Quadric(usize),
}

impl Child {
    const LEAF: u32 = 1 << 31;
    const QUADRIC: u32 = 1 << 30;

    /// In unused lanes.
    pub(crate) const NONE: Self = Self(u32::MAX);

    pub(crate) const fn node(index: usize) -> Self {
        Self(index as u32)
    }

    pub(crate) fn leaf(index: usize) -> Self {
        Self(index as u32 | Self::LEAF)
    }

    pub(crate) fn quadric(index: usize) -> Self {
        Self(index as u32 | Self::LEAF | Self::QUADRIC)
    }

    #[inline(always)]
    pub(crate) fn is_node(self) -> bool {
        self.0 & Self::LEAF == 0
    }

    /// Among the nodes, the leaves or the quadrics.
    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        (self.0 & !(Self::LEAF | Self::QUADRIC)) as usize
    }

    #[inline(always)]
    pub(crate) fn below(self) -> Below {
        let index = self.index();
        if self.is_node() {
            Below::Node(index)
        } else if self.0 & Self::QUADRIC == 0 {
            Below::Leaf(index)
        } else {
            Below::Quadric(index)
        }
    }
}

/// Up to eight triangles, a column for each coordinate.
#[derive(Clone)]
#[repr(C, align(64))]
pub(crate) struct Leaf {
    /// `corners[vertex][axis]`; NaN in unused lanes, which no test accepts.
    pub(crate) corners: [[[f32; WIDTH]; 3]; 3],
    /// Triangle numbers, `u32::MAX` in unused lanes.
    pub(crate) triangles: [u32; WIDTH],
}

impl Leaf {
    pub(crate) const EMPTY: Self = Self {
        corners: [[[f32::NAN; WIDTH]; 3]; 3],
        triangles: [u32::MAX; WIDTH],
    };

    pub(crate) fn set(&mut self, lane: usize, number: u32, corners: [[f32; 3]; 3]) {
        self.triangles[lane] = number;
        for (vertex, corner) in corners.into_iter().enumerate() {
            for (axis, coordinate) in corner.into_iter().enumerate() {
                self.corners[vertex][axis][lane] = coordinate;
            }
        }
    }

    /// The corners of one triangle, coordinates in the order `axes`.
    #[inline]
    pub(crate) fn triangle(&self, lane: usize, axes: [usize; 3]) -> [[f32; 3]; 3] {
        self.corners
            .map(|corner| axes.map(|axis| corner[axis][lane]))
    }

    /// Used lanes with their triangle numbers.
    pub(crate) fn lanes(&self) -> impl Iterator<Item = (usize, u32)> {
        self.triangles
            .iter()
            .copied()
            .enumerate()
            .filter(|&(_, number)| number != u32::MAX)
    }
}

#[cfg(test)]
mod tests {
    use super::{Below, Child, Leaf, Node};

    #[test]
    fn a_node_is_four_cache_lines() {
        assert_eq!((size_of::<Node>(), align_of::<Node>()), (256, 256));
        assert_eq!(size_of::<Leaf>(), 320);
    }

    #[test]
    fn children_survive_packing() {
        let index = (1 << 30) - 1;
        assert_eq!(Child::node(index).below(), Below::Node(index));
        assert_eq!(Child::leaf(index).below(), Below::Leaf(index));
        assert_eq!(Child::quadric(index).below(), Below::Quadric(index));
    }
}
