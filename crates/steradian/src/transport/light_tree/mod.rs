//! Choosing one of many lights by what it may send to a place: a tree of bounds with four branches a node.
//!
//! From the root down, each step goes along a branch in proportion to its [importance](node) at the receiver. A light is chosen with the
//! product of the steps' probabilities,
//!
//! p = Π I_k/ΣI,
//!
//! so that E_n cosθ/p varies little between lights. A step uses one number u in [0, 1) and stretches what is left of it over [0, 1)
//! again, so that strata of u remain strata of lights. Where no branch can contribute, nothing is chosen.
//!
//! Which way leads to a light is kept as the digits of a number, its trail. To ask for p of a light means to take its trail through the same
//! steps, so that a light's p is the same to the last bit whether it was drawn or is asked for.
//!
//! | | bytes a light | |
//! |---|---|---|
//! | nodes | 70 to 104 | 208 each, n/3 to n/2 of them; mostly near n/2 |
//! | trails | 8 | |
//!
//! 100 000 lights take .6 s to build.
//!
//! Source: A. Conty Estevez, C. Kulla, *Importance sampling of many lights with adaptive tree splitting* (PACMCGIT 1(2), 2018), which also
//! splits at nodes of doubtful importance; here meters sample several strata of u instead.

mod bounds;
mod build;
mod emitters;
mod highlight;
mod node;
mod number;
mod selection;

use bounds::Bounds;
use build::Builder;
pub(super) use highlight::Highlight;
pub(super) use node::{Ball, Receiving};
use node::{Below, Node, WIDTH};
pub(super) use selection::Selection;

/// The greatest number below 1.
const BELOW_ONE: f64 = 1.0 - 0.5 * f64::EPSILON;

/// Nodes of a tree whose balls are all weighed at once at many places, rather than those on the way to a light at each: a root and what is
/// below it, mostly of no more than sixteen lights.
pub(super) const FEW: usize = 5;

/// A light to be put into a tree.
#[derive(Copy, Clone, Debug)]
struct Item {
    bounds: Bounds,
    number: usize,
}

/// Bounds of lights, from all of them down to each.
#[derive(Debug, PartialEq)]
pub(super) struct LightTree {
    nodes: Vec<Node>,
    /// By light: digit k to the base 4 is the branch that step k from the root takes.
    trails: Vec<u64>,
    /// The balls of each node, if these are no more than [`FEW`].
    few: Vec<[Ball<f32>; WIDTH]>,
}

/// A light that was drawn.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(super) struct Drawn {
    pub light: usize,
    pub probability: f64,
    /// What is left of the number.
    pub u: f64,
}

impl LightTree {
    /// Of lights with these bounds; none without lights.
    pub fn new(bounds: impl IntoIterator<Item = Bounds>) -> Option<Self> {
        let number = |(number, bounds)| Item { bounds, number };
        let mut items: Vec<_> = bounds.into_iter().enumerate().map(number).collect();
        (!items.is_empty()).then(|| {
            let Builder { nodes, trails, .. } = Builder::new(&mut items);
            let of_node = |node: &Node| std::array::from_fn(|k| node.ball(k));
            let few = match nodes.len() <= FEW {
                true => nodes.iter().map(of_node).collect(),
                false => vec![],
            };
            Self { nodes, trails, few }
        })
    }

    /// A light by its importance at a place, if one may contribute there.
    pub fn draw(&self, at: &Receiving, u: f64) -> Option<Drawn> {
        self.draw_by(|number| self.nodes[number].importance(at), u)
    }

    /// The same from the importances of each node's balls there.
    pub fn draw_by(&self, of_node: impl Fn(usize) -> [f32; WIDTH], mut u: f64) -> Option<Drawn> {
        let (light, probability) = self.descend(of_node, |importances, sum| {
            let wanted = u * sum;
            let (mut k, mut before) = (0, 0.0);
            while k < WIDTH - 1 && wanted >= before + importances[k] {
                before += importances[k];
                k += 1;
            }
            u = ((wanted - before) / importances[k]).clamp(0.0, BELOW_ONE);
            k
        })?;
        Some(Drawn {
            light,
            probability,
            u,
        })
    }

    /// Probability with which [`draw`](Self::draw) draws a light at a place.
    pub fn probability(&self, at: &Receiving, light: usize) -> f64 {
        let mut trail = self.trails[light];
        let of_node = |number: usize| self.nodes[number].importance(at);
        let found = self.descend(of_node, |_, _| {
            let step = trail as usize % WIDTH;
            trail /= WIDTH as u64;
            step
        });
        found.map_or(0.0, |(_, probability)| probability)
    }

    /// Goes down to a light; `step` is told the importances below a node and their sum.
    #[inline(always)]
    fn descend(
        &self,
        of_node: impl Fn(usize) -> [f32; WIDTH],
        mut step: impl FnMut([f64; WIDTH], f64) -> usize,
    ) -> Option<(usize, f64)> {
        let (mut number, mut probability) = (0, 1.0);
        loop {
            let importances = of_node(number).map(f64::from);
            let [a, b, c, d] = importances;
            let sum = (a + b) + (c + d);
            if sum <= 0.0 {
                return None;
            }
            let k = step(importances, sum);
            probability *= importances[k] / sum;
            match self.nodes[number].below(k) {
                Below::Light(light) => return (probability > 0.0).then_some((light, probability)),
                Below::Node(next) => number = next,
            }
        }
    }
}

#[cfg(test)]
mod tests;
