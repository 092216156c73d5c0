//! One of many emitters, or one triangle of a large mesh: out of the tree, or of those beside it whose light comes from infinitely far away.
//!
//! With probability q an emitter beside the tree is chosen, by power whatever the place; else a leaf of the tree by its importance there.
//! q is the share that those beside have of all power, at most ½.
//!
//! A triangle that was chosen with probability p is sampled with the density p r²/(a cosθ_l), where a is its area. Here p A/a, with the area
//! A of the whole mesh, is called the probability, so that the density of a sample is that of the mesh, r²/(A cosθ_l), times it.

use super::emitters::{Beams, Leaf, leaves};
use super::node::{Ball, WIDTH};
use super::{Drawn, LightTree, Receiving};
use crate::scene::Scene;
use crate::transport::tables::Emitter;

/// How one of the first emitters of the tables is chosen.
pub(in crate::transport) struct Selection {
    tree: Option<LightTree>,
    leaves: Vec<Leaf>,
    /// By emitter.
    places: Vec<At>,
    /// Emitters beside the tree, and the sum of the probabilities up to and including each.
    beside: Vec<(u32, f64)>,
}

/// Where an emitter is.
#[derive(Copy, Clone, Debug)]
enum At {
    /// In the tree, from this leaf on.
    Tree(usize),
    /// Beside it, with this probability.
    Beside(f64),
}

/// A chosen emitter.
#[derive(Copy, Clone, Debug)]
pub(in crate::transport) struct Chosen {
    pub emitter: usize,
    /// Which of its triangles, where they are leaves of their own.
    pub triangle: Option<u32>,
    pub probability: f32,
    /// What is left of the number.
    pub u: f32,
}

impl Selection {
    /// Of emitters whose probabilities by power are set; `strengths` are their radiances, intensities or irradiances in watts.
    pub fn new(scene: &Scene, emitters: &[Emitter], strengths: &[f64]) -> Self {
        let (mut all, mut places, mut beams) = (vec![], vec![], Beams::default());
        for (number, (emitter, strength)) in emitters.iter().zip(strengths).enumerate() {
            let first = all.len();
            all.extend(leaves(scene, (number, emitter), *strength, &mut beams));
            places.push(match all.len() > first {
                true => At::Tree(first),
                false => At::Beside(f64::from(emitter.probability)),
            });
        }
        let power: f64 = emitters
            .iter()
            .map(|emitter| f64::from(emitter.probability))
            .sum();
        let beside = beside(&mut places, power, all.is_empty());
        Self {
            tree: LightTree::new(all.iter().map(|(_, bounds)| *bounds)),
            leaves: all.into_iter().map(|(leaf, _)| leaf).collect(),
            places,
            beside,
        }
    }

    /// Whether there is more than one emitter or triangle.
    pub fn has_choice(&self) -> bool {
        self.leaves.len() + self.beside.len() > 1
    }

    /// Of a tree of few nodes, their balls.
    pub fn few_balls(&self) -> &[[Ball<f32>; WIDTH]] {
        self.tree.as_ref().map_or(&[], |tree| &tree.few)
    }

    /// An emitter by its importance at a place, if one may contribute there, as it is drawn from the tree.
    #[inline(always)]
    pub fn choose_by(
        &self,
        u: f64,
        draw: impl FnOnce(&LightTree, f64) -> Option<Drawn>,
    ) -> Option<Chosen> {
        let share = self.share_beside();
        if u < share {
            return self.choose_beside(u);
        }
        let drawn = draw(self.tree.as_ref()?, (u - share) / (1.0 - share))?;
        let leaf = &self.leaves[drawn.light];
        Some(Chosen {
            emitter: leaf.emitter as usize,
            triangle: leaf.triangle,
            probability: self.per_share(leaf, drawn.probability),
            u: single(drawn.u),
        })
    }

    fn choose_beside(&self, u: f64) -> Option<Chosen> {
        let index = self.beside.partition_point(|(_, sum)| *sum <= u);
        let (emitter, sum) = *self.beside.get(index)?;
        let before = index.checked_sub(1).map_or(0.0, |last| self.beside[last].1);
        Some(Chosen {
            emitter: emitter as usize,
            triangle: None,
            probability: self.probability_beside(emitter as usize),
            u: single((u - before) / (sum - before)),
        })
    }

    /// Probability with which [`choose_by`](Self::choose_by) chooses an emitter at a place; of a mesh, for a point of this triangle.
    pub fn probability(&self, at: &Receiving, emitter: usize, triangle: u32) -> f32 {
        let (At::Tree(first), Some(tree)) = (self.places[emitter], &self.tree) else {
            return self.probability_beside(emitter);
        };
        let number = match self.leaves[first].triangle {
            Some(_) => first + triangle as usize,
            None => first,
        };
        self.per_share(&self.leaves[number], tree.probability(at, number))
    }

    /// (1 − q) p, for triangles divided by a/A.
    fn per_share(&self, leaf: &Leaf, probability: f64) -> f32 {
        ((1.0 - self.share_beside()) * probability / leaf.share) as f32
    }

    fn probability_beside(&self, emitter: usize) -> f32 {
        match self.places[emitter] {
            At::Beside(probability) => probability as f32,
            At::Tree(_) => 0.0,
        }
    }

    /// q.
    fn share_beside(&self) -> f64 {
        self.beside.last().map_or(0.0, |(_, sum)| *sum)
    }
}

/// Turns what the emitters beside the tree have of all `power` into probabilities; returns the cumulative ones.
fn beside(places: &mut [At], power: f64, are_all: bool) -> Vec<(u32, f64)> {
    let of_place = |place: &At| match place {
        At::Beside(part) => *part,
        At::Tree(_) => 0.0,
    };
    let sum: f64 = places.iter().map(of_place).sum();
    let share = match are_all {
        true => 1.0,
        false => (sum / power).min(0.5),
    };
    let mut cumulative = vec![];
    let mut so_far = 0.0;
    for (number, place) in places.iter_mut().enumerate() {
        if let At::Beside(part) = place {
            *part *= share / sum;
            so_far += *part;
            cumulative.push((number as u32, so_far));
        }
    }
    cumulative
}

/// In [0, 1).
fn single(u: f64) -> f32 {
    (u as f32).clamp(0.0, 1.0 - 0.5 * f32::EPSILON)
}
