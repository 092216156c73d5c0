//! Building the tree: halves that are small, shine alike and are weak, from the whole down.
//!
//! A split into a left and a right half costs
//!
//! c = k (I_l D_l² M_l + I_r D_r² M_r), k = longest edge of the box of their middles / its edge across the split,
//!
//! with the greatest intensity I, the diagonal D and the measure M of the cone. The squared diagonal stands where the surface area is in
//! the source: that of lights on a line is nothing. Of each axis, 15 planes between 16 bins of the middles are tried. What no plane parts
//! (lights at one place), and what lies 32 splits deep, is halved by its order instead.
//!
//! Two levels of halves make the four balls of a node.
//!
//! The order of the lights and their bounds alone decide; nothing depends on threads.
//!
//! Source: A. Conty Estevez, C. Kulla (2018), §4.1, eq. 1 and 2.

use glam::DVec3;

use super::Item;
use super::bounds::Bounds;
use super::node::{Below, Node, WIDTH};

const BINS: usize = 16;

/// Splits from the root beyond which order decides: the halvings of 2³¹ lights that may follow fit into a trail of 64 bits.
const DEEPEST: u32 = 32;

/// Nodes as they are found, and the way to each light.
pub(super) struct Builder {
    pub nodes: Vec<Node>,
    pub trails: Vec<u64>,
    unit: f64,
}

impl Builder {
    pub fn new(items: &mut [Item]) -> Self {
        let unit: f64 = items.iter().map(|item| item.bounds.intensity).sum();
        let mut builder = Self {
            nodes: vec![Node::EMPTY],
            trails: vec![0; items.len()],
            unit: if unit > 0.0 { unit } else { 1.0 },
        };
        builder.grow(0, items, 0, 0);
        builder
    }

    /// Fills a node with these lights, to which `trail` leads in `steps` steps, and tells their bounds.
    fn grow(
        &mut self,
        number: usize,
        items: &mut [Item],
        trail: u64,
        steps: u32,
    ) -> Option<Bounds> {
        let mut all = None;
        for (k, part) in quarters(items, 2 * steps).into_iter().enumerate() {
            let trail = trail | (k as u64) << (2 * steps);
            let (bounds, below) = match part {
                [] => continue,
                [item] => {
                    self.trails[item.number] = trail;
                    (Some(item.bounds), Below::Light(item.number))
                }
                many => {
                    let next = self.nodes.len();
                    self.nodes.push(Node::EMPTY);
                    (self.grow(next, many, trail, steps + 1), Below::Node(next))
                }
            };
            if let Some(bounds) = &bounds {
                self.nodes[number].set(k, bounds, self.unit, below);
            }
            all = join(all, bounds);
        }
        all
    }
}

/// The halves of both halves.
fn quarters(items: &mut [Item], depth: u32) -> [&mut [Item]; WIDTH] {
    let [left, right] = halves(items, depth);
    let [a, b] = halves(left, depth + 1);
    let [c, d] = halves(right, depth + 1);
    [a, b, c, d]
}

fn halves(items: &mut [Item], depth: u32) -> [&mut [Item]; 2] {
    let middle = match items.len() {
        0 | 1 => items.len(),
        _ => split(items, depth),
    };
    let (left, right) = items.split_at_mut(middle);
    [left, right]
}

/// Sorts the lights into two halves, and tells how many there are in the left one.
fn split(items: &mut [Item], depth: u32) -> usize {
    let middles = Middles::of(items);
    let planes = (0..3).filter_map(|axis| middles.best_plane(items, axis));
    let best = planes.min_by(|a, b| a.cost.total_cmp(&b.cost));
    match best {
        Some(plane) if depth < DEEPEST => {
            let is_right = |item: &Item| middles.bin(item, plane.axis) >= plane.bin;
            items.sort_by_key(is_right);
            items.partition_point(|item| !is_right(item))
        }
        _ => items.len() / 2,
    }
}

/// A plane before a bin.
struct Plane {
    axis: usize,
    bin: usize,
    cost: f64,
}

/// The box about the middles of lights.
struct Middles {
    low: DVec3,
    extent: DVec3,
}

impl Middles {
    fn of(items: &[Item]) -> Self {
        let outside = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = items.iter().fold(outside, |(low, high), item| {
            let middle = item.bounds.center();
            (low.min(middle), high.max(middle))
        });
        Self {
            low,
            extent: high - low,
        }
    }

    fn bin(&self, item: &Item, axis: usize) -> usize {
        let along = (item.bounds.center()[axis] - self.low[axis]) / self.extent[axis];
        ((along * BINS as f64) as usize).min(BINS - 1)
    }

    /// The cheapest plane across an axis, if one parts the lights.
    fn best_plane(&self, items: &[Item], axis: usize) -> Option<Plane> {
        if self.extent[axis] <= 0.0 {
            return None;
        }
        let mut bins = [None; BINS];
        for item in items {
            let bin = &mut bins[self.bin(item, axis)];
            *bin = join(*bin, Some(item.bounds));
        }
        let mut costs = [0.0; BINS];
        let mut left = None;
        for bin in 1..BINS {
            left = join(left, bins[bin - 1]);
            costs[bin] = cost(left);
        }
        let mut right = None;
        for bin in (1..BINS).rev() {
            right = join(right, bins[bin]);
            costs[bin] += cost(right);
        }
        let k = self.extent.max_element() / self.extent[axis];
        let planes = (1..BINS).map(|bin| Plane {
            axis,
            bin,
            cost: k * costs[bin],
        });
        planes.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }
}

fn join(a: Option<Bounds>, b: Option<Bounds>) -> Option<Bounds> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.union(b)),
        (a, b) => a.or(b),
    }
}

/// I D² M; of no lights it is infinite, as such a plane parts nothing.
fn cost(bounds: Option<Bounds>) -> f64 {
    bounds.map_or(f64::INFINITY, |bounds| {
        bounds.intensity * bounds.extent().length_squared() * bounds.cone.measure()
    })
}
