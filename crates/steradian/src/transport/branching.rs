//! Branching: several paths from what a camera ray meets first.
//!
//! With V_c the variance that comes of where a camera ray goes, V_p that of a path from there, C_c and C_p what they cost, k paths to a camera
//! ray have the efficiency
//!
//! 1 / ((V_c + V_p/k) (C_c + k C_p)),
//!
//! which is greatest at k = √(V_p C_c / (V_c C_p)). Places on the film are stratified well, so that V_c is small: in the Cornell box a fiftieth
//! of V_p, while a camera ray with its splats costs about as much as a path. Everything after the first meeting branches, light samples too, so
//! that no scene has all its variance in what the branches share but one that is seen through a pattern finer than its pixels.
//!
//! The mean over the branches is unbiased, and each of them is a path of its own as far as roulette is concerned. Branch j of sample i draws the
//! numbers of index k·i + j, those for its first light too, so that the branches of all samples of a pixel are one net.
//!
//! Source: J. Arvo & D. Kirk, *Particle transport and image synthesis* (SIGGRAPH 1990), §4 (splitting).

use super::columns::{Luggage, Vertices, Workspace};
use super::path::Tracer;
use super::scatter;
use super::scattering::Encounter;
use crate::sampling::block;

/// Paths from what a camera ray meets first.
///
/// In the Cornell box with 64 samples a pixel, 1/(relative mean square error · processor time) is 1.3 times that of one path with 2, 1.6
/// times with 4 and with 8.
pub(super) const BRANCHES: u32 = 4;

/// Block of the numbers for the first light, out of the way of the blocks of a path's segments.
pub(super) const LIGHT_BLOCK: u32 = 1 << 30;

/// What the branches begin with.
#[derive(Default)]
pub(super) struct Stem {
    vertices: Vertices,
    mirrors: Vertices,
    viewer: [Vec<f32>; 3],
    encounters: Vec<Encounter>,
}

impl Stem {
    /// Takes what the camera rays have met.
    fn take(&mut self, workspace: &mut Workspace) {
        std::mem::swap(&mut self.vertices, &mut workspace.vertices);
        std::mem::swap(&mut self.mirrors, &mut workspace.mirrors);
        std::mem::swap(&mut self.viewer, &mut workspace.viewer);
        std::mem::swap(&mut self.encounters, &mut workspace.encounters);
    }

    /// Puts it back as a branch begins.
    fn grow(&self, branch: u32, tracer: &Tracer, workspace: &mut Workspace) {
        for (to, from) in [
            (&mut workspace.vertices, &self.vertices),
            (&mut workspace.mirrors, &self.mirrors),
        ] {
            to.copy_from(from);
            for index in &mut to.identity.index {
                *index = index_of(*index, branch);
            }
            scatter::fill(tracer, &to.identity, LIGHT_BLOCK, &mut workspace.uniforms);
            let [u, v, ..] = &mut workspace.uniforms;
            std::mem::swap(&mut to.light_u, u);
            std::mem::swap(&mut to.light_v, v);
        }
        for (to, from) in workspace.viewer.iter_mut().zip(&self.viewer) {
            to.clone_from(from);
        }
        let encounters = self.encounters.iter();
        let encounters = encounters.map(|encounter| of_branch(encounter, branch));
        workspace.encounters.clear();
        workspace.encounters.extend(encounters);
        workspace.luggage.fill(Luggage::NONE);
    }
}

fn of_branch(encounter: &Encounter, branch: u32) -> Encounter {
    let (slot, key, index) = encounter.identity;
    let index = index_of(index, branch);
    let [u, v, ..] = block::sample(key, index, LIGHT_BLOCK);
    Encounter {
        identity: (slot, key, index),
        light: [u, v],
        ..encounter.clone()
    }
}

impl Tracer<'_> {
    /// Follows camera rays to what they meet first, and [`BRANCHES`] paths from there; what is gathered is their mean.
    pub fn follow_branches(&self, workspace: &mut Workspace) {
        if self.max_depth == 0 {
            return;
        }
        let candidates = self.tables.for_surfaces();
        self.advance(workspace, candidates);
        if self.max_depth == 1 {
            return;
        }
        let mut stem = std::mem::take(&mut workspace.stem);
        stem.take(workspace);
        scale(&mut workspace.gathered, BRANCHES as f32);
        for branch in 0..BRANCHES {
            stem.grow(branch, self, workspace);
            self.reflect(workspace, 1);
            self.follow(workspace, 1, candidates);
        }
        scale(&mut workspace.gathered, 1.0 / BRANCHES as f32);
        workspace.stem = stem;
    }
}

fn scale(gathered: &mut [f32], factor: f32) {
    gathered.iter_mut().for_each(|light| *light *= factor);
}

fn index_of(sample: u32, branch: u32) -> u32 {
    sample.wrapping_mul(BRANCHES) + branch
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn branches_share_no_index() {
        let mut indices: Vec<u32> = (0..64)
            .flat_map(|i| (0..BRANCHES).map(move |j| index_of(i, j)))
            .collect();
        indices.sort_unstable();
        assert!(indices.into_iter().eq(0..64 * BRANCHES));
    }
}
