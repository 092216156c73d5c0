//! A pilot of a sensor: how many branches its paths have.

use super::super::branching::Branches;
use super::super::branching::pilot::{KEY, suited};
use super::super::columns::BATCH;
use super::{MeterWorkspace, Meters};
use crate::estimation::{Integrand, Run};
use crate::sampling::hash;

/// Points of a sensor that are asked, spread evenly.
pub(in super::super) const POINTS: usize = 32;
const NETS: usize = 8;
const SAMPLES_OF_A_NET: usize = 32;
/// Samples of a point in a replicate, as a rule.
const USUAL_NET: f64 = 256.0;
/// Stems of a point.
const STEMS_OF_A_POINT: usize = NETS * SAMPLES_OF_A_NET;
const STREAMS_OF_A_BATCH: usize = BATCH / STEMS_OF_A_POINT;

impl Meters<'_> {
    /// As many branches as suit these streams, the same for every seed.
    pub fn suited_branches(&self, threads: usize) -> Branches {
        let stems = self.streams.len() * STEMS_OF_A_POINT;
        let longer = USUAL_NET / SAMPLES_OF_A_NET as f64;
        suited(threads, (stems, NETS), longer, |branches| {
            let mut workspace = self.new_workspace();
            let first = (0..self.streams.len()).step_by(STREAMS_OF_A_BATCH);
            let nets = first.map(|first| self.nets(first));
            let means = nets.map(|runs| self.means(&runs, branches, &mut workspace));
            let means = means.collect::<Vec<_>>().concat();
            let rays = [workspace.paths.watch.times.rays, workspace.catching.rays()];
            (means, rays)
        })
    }

    /// The nets of the streams of a batch.
    fn nets(&self, first: usize) -> Vec<Run> {
        let last = (first + STREAMS_OF_A_BATCH).min(self.streams.len());
        let net = |stream: usize, net: usize| Run {
            stream: stream as u32,
            replicate: net as u32,
            first: 0,
            count: SAMPLES_OF_A_NET as u32,
            key: hash::combine(hash::combine(self.streams[stream].key, KEY), net as u64),
        };
        let nets = |stream: usize| (0..NETS).map(move |number| net(stream, number));
        (first..last).flat_map(nets).collect()
    }

    /// The scalar that tolerances are about, by net.
    fn means(&self, runs: &[Run], branches: Branches, workspace: &mut MeterWorkspace) -> Vec<f64> {
        let mut sums = vec![0.0; runs.len()];
        self.follow(runs, |_| branches, workspace);
        self.follow_light(runs, workspace);
        self.read(runs, workspace, |run, columns| {
            let weights = &self.weights[self.streams[runs[run].stream as usize].sensor];
            let weighted = columns.iter().zip(weights);
            sums[run] += weighted.map(|(value, w)| value * w).sum::<f64>();
        });
        sums
    }
}
