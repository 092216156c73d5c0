//! Lamps in groups: the facets of a plane in a binary tree of rectangles around them, so that a question about many of them is one question.
//!
//! Facets are of one plane if their normals differ by some 10⁻⁹ and their planes by as much of the scene's extent, a thousandth of the
//! clearance that ends of shadow rays keep.

use std::ops::Range;

use super::super::tables::{EmitterShape, Facet, Outline, Tables};
use crate::geometry::{Frame, Point, Vector};

/// Of more lamps none is known. In a hall under 1 000 panels to know them costs a point as much as 600 samples of one path, under 10 000 as much as 2 000, which is more than
/// a reading to 1 % needs.
const MOST_LAMPS: usize = 4096;

/// Relative difference of planes that are taken for one.
const SAME_PLANE: f64 = 1e-9;

/// A facet, a disc or a sphere of a lamp.
#[derive(Clone, Copy)]
pub(super) struct Piece {
    pub emitter: u32,
    /// Which of its facets.
    facet: u32,
}

impl Piece {
    /// Its outline, if it is flat.
    pub fn facet<'t>(&self, tables: &'t Tables<'_>) -> Option<&'t Facet> {
        match tables.emitters[self.emitter as usize].outline.as_ref()? {
            Outline::Facets(facets) => facets.get(self.facet as usize),
            Outline::Disc(_, around) => Some(around),
            Outline::Sphere { .. } => None,
        }
    }
}

/// Some pieces in a plane.
pub(super) struct Node {
    /// A rectangle around them; of a single one its own outline.
    pub outline: Facet,
    pub two_sided: bool,
    /// In [`Groups::order`].
    pub pieces: Range<usize>,
    /// The first of two nodes, unless this is one piece.
    pub below: Option<usize>,
}

/// All lamps that may be known.
#[derive(Default)]
pub(super) struct Groups {
    pub pieces: Vec<Piece>,
    /// Emitters by number, with their pieces.
    pub lamps: Vec<(usize, Range<usize>)>,
    pub nodes: Vec<Node>,
    /// The nodes of whole planes.
    pub planes: Vec<usize>,
    /// Flat pieces, those of a node side by side.
    pub order: Vec<usize>,
    /// The other pieces.
    pub spheres: Vec<usize>,
}

impl Groups {
    pub fn new(tables: &Tables<'_>) -> Self {
        let mut groups = Self::default();
        if tables.extended > MOST_LAMPS {
            return groups;
        }
        for (number, emitter) in tables.emitters[..tables.extended].iter().enumerate() {
            // What hides light from everywhere may stand beyond its portal.
            let is_portal = matches!(emitter.shape, EmitterShape::Portal(_));
            let count = match &emitter.outline {
                Some(Outline::Facets(facets)) if !is_portal => facets.len(),
                Some(Outline::Disc(..) | Outline::Sphere { .. }) => 1,
                _ => continue,
            };
            let first = groups.pieces.len();
            let piece = |facet| Piece {
                emitter: number as u32,
                facet,
            };
            groups.pieces.extend((0..count as u32).map(piece));
            groups.lamps.push((number, first..groups.pieces.len()));
        }
        groups.arrange(tables);
        groups
    }

    fn arrange(&mut self, tables: &Tables<'_>) {
        let mut flat = vec![];
        for (number, piece) in self.pieces.iter().enumerate() {
            match piece.facet(tables) {
                Some(facet) => {
                    let two_sided = tables.emitters[piece.emitter as usize].two_sided;
                    flat.push((plane_of(tables, facet, two_sided), (number, facet)));
                }
                None => self.spheres.push(number),
            }
        }
        flat.sort_by_key(|(plane, (number, _))| (*plane, *number));
        for plane in flat.chunk_by(|(a, _), (b, _)| a == b) {
            let mut pieces: Vec<_> = plane.iter().map(|(_, piece)| *piece).collect();
            let (two_sided, root) = (plane[0].0.1, self.nodes.len());
            let first = self.order.len();
            self.planes.push(root);
            self.nodes.push(Node::leaf(plane[0].1.1, two_sided, first));
            self.grow(root, &Axes::of(plane[0].1.1), &mut pieces, first);
            self.order.extend(pieces.iter().map(|(number, _)| *number));
        }
    }

    /// Puts pieces into a node, those in the order from `first` on.
    fn grow(&mut self, node: usize, axes: &Axes, pieces: &mut [(usize, &Facet)], first: usize) {
        let two_sided = self.nodes[node].two_sided;
        if let [(_, facet)] = pieces {
            self.nodes[node] = Node::leaf(facet, two_sided, first);
            return;
        }
        let [low, high] = axes.bounds(pieces.iter().map(|(_, facet)| *facet));
        let k = usize::from(high[1] - low[1] > high[0] - low[0]);
        let along = |facet: &Facet| {
            let [low, high] = axes.bounds([facet]);
            low[k] + high[k]
        };
        pieces.sort_by(|(_, a), (_, b)| along(a).total_cmp(&along(b)));
        let below = self.nodes.len();
        self.nodes[node] = Node {
            outline: axes.rectangle(low, high),
            two_sided,
            pieces: first..first + pieces.len(),
            below: Some(below),
        };
        let (left, right) = pieces.split_at_mut(pieces.len() / 2);
        for half in [&left, &right] {
            self.nodes.push(Node::leaf(half[0].1, two_sided, first));
        }
        let middle = first + left.len();
        self.grow(below, axes, left, first);
        self.grow(below + 1, axes, right, middle);
    }
}

/// Tells planes and sides that emit apart.
fn plane_of(tables: &Tables<'_>, facet: &Facet, two_sided: bool) -> ([i64; 4], bool) {
    let surfaces = tables.scene.surfaces();
    let bounds = surfaces.bounds();
    let extent = bounds.map_or(1.0, |bounds| bounds.diagonal().to_metres());
    let [x, y, z] = facet.normal.to_array();
    let offset = facet.normal.dot(facet.corners[0] - surfaces.origin()) / extent;
    let parts = [x, y, z, offset].map(|part| (part / SAME_PLANE).round() as i64);
    (parts, two_sided)
}

impl Node {
    fn leaf(facet: &Facet, two_sided: bool, place: usize) -> Self {
        Self {
            outline: facet.clone(),
            two_sided,
            pieces: place..place + 1,
            below: None,
        }
    }
}

/// Axes of a plane.
struct Axes {
    origin: Point,
    frame: Frame,
}

impl Axes {
    /// Along the first edge of a facet.
    fn of(facet: &Facet) -> Self {
        let (origin, normal) = (facet.corners[0], facet.normal);
        let along = Frame::from_normal_and_tangent(normal, facet.corners[1] - origin);
        Self {
            origin,
            frame: along.unwrap_or_else(|| Frame::from_normal(normal)),
        }
    }

    /// The least and greatest coordinates of facets.
    fn bounds<'f>(&self, facets: impl IntoIterator<Item = &'f Facet>) -> [[f64; 2]; 2] {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for corner in facets.into_iter().flat_map(|facet| &facet.corners) {
            let local = self.frame.vector_to_local(*corner - self.origin);
            for (k, x) in [local.x, local.y].into_iter().enumerate() {
                low[k] = low[k].min(x);
                high[k] = high[k].max(x);
            }
        }
        [low, high]
    }

    fn rectangle(&self, low: [f64; 2], high: [f64; 2]) -> Facet {
        let corners = [
            [low[0], low[1]],
            [high[0], low[1]],
            [high[0], high[1]],
            [low[0], high[1]],
        ];
        let world =
            |[x, y]: [f64; 2]| self.origin + self.frame.vector_to_world(Vector::new(x, y, 0.0));
        Facet {
            corners: corners.map(world).to_vec(),
            normal: self.frame.normal(),
            primitives: 0..0,
        }
    }
}
