//! Branching: several paths from what a ray of a sensor meets first.
//!
//! With V_c the variance that comes of where such a stem goes, V_p that of a path from there, C_c and C_p what they cost, k paths to a
//! stem have the efficiency
//!
//! 1 / ((V_c + V_p/k) (C_c + k C_p)),
//!
//! which is greatest at k = √(V_p C_c / (V_c C_p)). Places on the film and directions at meters are stratified well, so that V_c is small: in the Cornell
//! box a fiftieth of V_p, while a camera ray with its splats costs about as much as a path. Where pixels see patterns finer than themselves, V_c is
//! great. A [`pilot`] finds both and decides, alike for every seed, stopping rule and length of a run: else a run that ends by the clock could not be repeated by its number of samples. Everything after the first meeting branches, light samples too.
//!
//! The mean over the branches is unbiased, and each of them is a path of its own as far as roulette is concerned. Branch j of sample i draws the
//! numbers of index k·i + j, those for its first light too, so that the branches of all samples of a stream are one net; beyond 2³⁰ samples of a replicate the numbers begin again.
//!
//! Source: J. Arvo & D. Kirk, *Particle transport and image synthesis* (SIGGRAPH 1990), §4 (splitting).

pub(super) mod pilot;

use super::columns::{Luggage, Vertices, Workspace};
use super::path::Tracer;
use super::scatter;
use super::scattering::Encounter;
use super::tables::Candidates;
use crate::sampling::block;

/// The most paths from what a stem meets first.
///
/// In the Cornell box with 64 samples a pixel, 1/(relative mean square error · processor time) is 1.3 times that of one path with 2, 1.6
/// times with 4 and with 8; on its floor 1.3, 1.6 and 1.6 times.
pub(super) const BRANCHES: u32 = 4;

/// Block of the numbers for the first light, out of the way of the blocks of a path's segments.
pub(super) const LIGHT_BLOCK: u32 = (1 << 30) + 2;

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
    fn grow(&self, branch: Branch, tracer: &Tracer, workspace: &mut Workspace) {
        for (to, from) in [
            (&mut workspace.vertices, &self.vertices),
            (&mut workspace.mirrors, &self.mirrors),
        ] {
            to.copy_from(from);
            for index in &mut to.identity.index {
                *index = branch.index_of(*index);
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

fn of_branch(encounter: &Encounter, branch: Branch) -> Encounter {
    let (slot, key, index) = encounter.identity;
    let index = branch.index_of(index);
    let [u, v, ..] = block::sample(key, index, LIGHT_BLOCK);
    Encounter {
        identity: (slot, key, index),
        light: [u, v],
        ..encounter.clone()
    }
}

impl Tracer<'_> {
    /// Follows stems to what they meet first, and branches from there; what is gathered is the mean of these.
    pub fn follow_branches(
        &self,
        workspace: &mut Workspace,
        candidates: Candidates,
        branches: Branches,
    ) {
        if branches == Branches::ONE {
            self.follow(workspace, 0, candidates);
            return;
        }
        if self.max_depth == 0 {
            return;
        }
        self.advance(workspace, candidates);
        if self.max_depth == 1 {
            return;
        }
        let mut stem = std::mem::take(&mut workspace.stem);
        stem.take(workspace);
        let followed = branches.count() as f32;
        scale(&mut workspace.gathered, followed);
        for number in branches.first..branches.end {
            let of = branches.of;
            stem.grow(Branch { number, of }, self, workspace);
            self.reflect(workspace, 1);
            self.follow(workspace, 1, self.tables.for_surfaces());
        }
        scale(&mut workspace.gathered, 1.0 / followed);
        workspace.stem = stem;
    }
}

/// Which branches are followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Branches {
    first: u32,
    end: u32,
    of: u32,
}

impl Branches {
    /// A path that does not branch.
    pub const ONE: Self = Self::all(1);

    /// So many, a power of two.
    pub const fn all(of: u32) -> Self {
        let (first, end) = (0, of);
        Self { first, end, of }
    }

    /// One of [`BRANCHES`].
    pub const fn only(number: u32) -> Self {
        let (first, end, of) = (number, number + 1, BRANCHES);
        Self { first, end, of }
    }

    pub const fn count(self) -> u32 {
        self.end - self.first
    }
}

/// One of several branches.
#[derive(Copy, Clone)]
struct Branch {
    number: u32,
    of: u32,
}

impl Branch {
    /// The index of its numbers.
    fn index_of(self, sample: u32) -> u32 {
        sample.wrapping_mul(self.of) + self.number
    }
}

fn scale(gathered: &mut [f32], factor: f32) {
    gathered.iter_mut().for_each(|light| *light *= factor);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn branches_of_a_replicate_share_no_index() {
        let mut indices: Vec<u32> = (0..64)
            .flat_map(|i| {
                (0..BRANCHES).map(move |number| {
                    Branch {
                        number,
                        of: BRANCHES,
                    }
                    .index_of(i)
                })
            })
            .collect();
        indices.sort_unstable();
        assert!(indices.into_iter().eq(0..64 * BRANCHES));
    }
}
