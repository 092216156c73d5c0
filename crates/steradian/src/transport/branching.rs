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
//! numbers of index k·i + j, so that the branches of all samples of a pixel are one net; its numbers for the first light are those of the sample
//! moved round by half of their range, so that the four branches sample one light each quarter of it.
//!
//! Source: J. Arvo & D. Kirk, *Particle transport and image synthesis* (SIGGRAPH 1990), §4 (splitting).

use super::columns::{Luggage, Vertices, Workspace};
use super::path::Tracer;
use super::scattering::Encounter;

/// Paths from what a camera ray meets first.
///
/// In the Cornell box with 64 samples a pixel, 1/(relative mean square error · processor time) is 1.2 times that of one path with 2, 1.6
/// times with 4 and with 8.
pub(super) const BRANCHES: u32 = 4;

/// By how much the numbers of a branch for the first light are moved.
const MOVES: [[f32; 2]; BRANCHES as usize] = [[0.0, 0.0], [0.5, 0.5], [0.5, 0.0], [0.0, 0.5]];

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
    fn grow(&self, branch: u32, workspace: &mut Workspace) {
        for (to, from) in [
            (&mut workspace.vertices, &self.vertices),
            (&mut workspace.mirrors, &self.mirrors),
        ] {
            to.copy_from(from);
            to.identity
                .index
                .iter_mut()
                .for_each(|index| *index = index_of(*index, branch));
            let [u, v] = MOVES[branch as usize];
            to.light_u
                .iter_mut()
                .for_each(|number| *number = moved(*number, u));
            to.light_v
                .iter_mut()
                .for_each(|number| *number = moved(*number, v));
        }
        for (to, from) in workspace.viewer.iter_mut().zip(&self.viewer) {
            to.clone_from(from);
        }
        let encounters = self.encounters.iter().map(|encounter| {
            let (slot, key, index) = encounter.identity;
            let [u, v] = MOVES[branch as usize];
            let [light_u, light_v] = encounter.light;
            Encounter {
                identity: (slot, key, index_of(index, branch)),
                light: [moved(light_u, u), moved(light_v, v)],
                ..encounter.clone()
            }
        });
        workspace.encounters.clear();
        workspace.encounters.extend(encounters);
        workspace.luggage.fill(Luggage::NONE);
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
            stem.grow(branch, workspace);
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

/// A number of [0, 1) moved round by a part of it, exactly.
fn moved(number: f32, by: f32) -> f32 {
    let sum = number + by;
    if sum < 1.0 { sum } else { number - (1.0 - by) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_branches_of_a_light_number_fill_its_quarters() {
        for steps in [0, 1, (1 << 23) - 1, 1 << 23, (1 << 24) - 1] {
            let u = steps as f32 / (1 << 24) as f32;
            let mut quarters = MOVES.map(|[a, b]| {
                let (a, b) = (moved(u, a), moved(u, b));
                assert!((0.0..1.0).contains(&a) && (0.0..1.0).contains(&b));
                (a >= 0.5, b >= 0.5)
            });
            quarters.sort_unstable();
            let all = [(false, false), (false, true), (true, false), (true, true)];
            assert_eq!(quarters, all);
        }
    }

    #[test]
    fn branches_share_no_index() {
        let mut indices: Vec<u32> = (0..64)
            .flat_map(|i| (0..BRANCHES).map(move |j| index_of(i, j)))
            .collect();
        indices.sort_unstable();
        assert!(indices.into_iter().eq(0..64 * BRANCHES));
    }
}
