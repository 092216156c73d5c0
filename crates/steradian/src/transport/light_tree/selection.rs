//! One of many emitters: out of the tree, or of those beside it whose light comes from everywhere or infinitely far away.
//!
//! With probability q one beside the tree is chosen, by power whatever the place; else one of the tree by its importance there. q is the
//! share that those beside have of all power, at most ½.

use super::emitters::{Beams, bounds};
use super::{LightTree, Receiving};
use crate::scene::Scene;
use crate::transport::tables::Emitter;

/// How one of the first emitters of the tables is chosen.
pub(in crate::transport) struct Selection {
    tree: Option<LightTree>,
    /// Emitters by light of the tree.
    lights: Vec<u32>,
    /// By emitter.
    places: Vec<At>,
    /// Emitters beside the tree, and the sum of the probabilities up to and including each.
    beside: Vec<(u32, f64)>,
}

/// Where an emitter is.
#[derive(Copy, Clone, Debug)]
enum At {
    /// In the tree, by this number.
    Tree(usize),
    /// Beside it, with this probability.
    Beside(f64),
}

/// A chosen emitter.
#[derive(Copy, Clone, Debug)]
pub(in crate::transport) struct Chosen {
    pub emitter: usize,
    pub probability: f32,
    /// What is left of the number.
    pub u: f32,
}

impl Selection {
    /// Of emitters whose probabilities by power are set; `strengths` are their radiances, intensities or irradiances in watts.
    pub fn new(scene: &Scene, emitters: &[Emitter], strengths: &[f64]) -> Self {
        let (mut lights, mut of_lights, mut beside) = (vec![], vec![], vec![]);
        let all: f64 = emitters
            .iter()
            .map(|emitter| f64::from(emitter.probability))
            .sum();
        let (mut sum, mut beams) = (0.0, Beams::default());
        let mut place = |(number, (emitter, strength)): (usize, (&Emitter, &f64))| match bounds(
            scene, emitter, *strength, &mut beams,
        ) {
            Some(of_emitter) => {
                lights.push(number as u32);
                of_lights.push(of_emitter);
                At::Tree(lights.len() - 1)
            }
            None => {
                let probability = f64::from(emitter.probability) / all;
                sum += probability;
                beside.push((number as u32, sum));
                At::Beside(probability)
            }
        };
        let pairs = emitters.iter().zip(strengths);
        let mut places: Vec<At> = pairs.enumerate().map(&mut place).collect();
        let tree = LightTree::new(of_lights);
        let scale = match tree {
            Some(_) => (0.5 / sum).min(1.0),
            None => 1.0 / sum,
        };
        for place in &mut places {
            if let At::Beside(probability) = place {
                *probability *= scale;
            }
        }
        beside.iter_mut().for_each(|(_, sum)| *sum *= scale);
        Self {
            tree,
            lights,
            places,
            beside,
        }
    }

    /// An emitter by its importance at a place, if one may contribute there.
    pub fn choose(&self, at: &Receiving, u: f64) -> Option<Chosen> {
        let share = self.share_beside();
        if u < share {
            return self.choose_beside(u);
        }
        let drawn = self.tree.as_ref()?.draw(at, (u - share) / (1.0 - share))?;
        Some(Chosen {
            emitter: self.lights[drawn.light] as usize,
            probability: ((1.0 - share) * drawn.probability) as f32,
            u: single(drawn.u),
        })
    }

    fn choose_beside(&self, u: f64) -> Option<Chosen> {
        let index = self.beside.partition_point(|(_, sum)| *sum <= u);
        let (emitter, sum) = *self.beside.get(index)?;
        let before = index.checked_sub(1).map_or(0.0, |last| self.beside[last].1);
        Some(Chosen {
            emitter: emitter as usize,
            probability: self.probability_beside(emitter as usize),
            u: single((u - before) / (sum - before)),
        })
    }

    /// Probability with which [`choose`](Self::choose) chooses an emitter at a place.
    pub fn probability(&self, at: &Receiving, emitter: usize) -> f32 {
        match (self.places[emitter], &self.tree) {
            (At::Tree(light), Some(tree)) => {
                ((1.0 - self.share_beside()) * tree.probability(at, light)) as f32
            }
            _ => self.probability_beside(emitter),
        }
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

/// In [0, 1).
fn single(u: f64) -> f32 {
    (u as f32).clamp(0.0, 1.0 - 0.5 * f32::EPSILON)
}
