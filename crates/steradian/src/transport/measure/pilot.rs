//! A pilot of a sensor: how many branches its paths have.

use super::super::branching::Branches;
use super::super::branching::pilot::Variances;
use super::super::columns::BATCH;
use super::{MeterWorkspace, Meters};
use crate::estimation::Run;
use crate::sampling::hash;

/// Points of a sensor that are asked, spread evenly.
pub(in super::super) const POINTS: usize = 32;
const NETS: usize = 8;
const SAMPLES_OF_A_NET: usize = 32;
/// Samples of a point in a replicate where that is not told.
const USUAL_NET: f64 = 256.0;
/// Stems of a pilot.
pub(in super::super) const SAMPLES: usize = POINTS * NETS * SAMPLES_OF_A_NET;
const STREAMS_OF_A_BATCH: usize = BATCH / (NETS * SAMPLES_OF_A_NET);
/// Tells the numbers of a pilot from those of the readings.
const KEY: u64 = 0x7069_6c6f_7421;

impl Meters<'_> {
    /// As many branches as suit these streams in nets of so many samples, the same for every seed.
    pub fn suited_branches(&self, net: Option<f64>) -> Branches {
        let mut workspace = MeterWorkspace {
            columns: vec![0.0; self.columns],
            ..MeterWorkspace::default()
        };
        let means = [0, 1, 2, 3].map(|number| {
            let first = (0..self.streams.len()).step_by(STREAMS_OF_A_BATCH);
            let nets = first.map(|first| self.nets(first));
            let branches = Branches::only(number);
            let means = nets.map(|runs| self.means(&runs, branches, &mut workspace));
            means.collect::<Vec<_>>().concat()
        });
        let stems = means.len() * self.streams.len() * NETS * SAMPLES_OF_A_NET;
        let rays = workspace.paths.watch.times.rays as f64 / stems as f64 - 1.0;
        let longer = net.unwrap_or(USUAL_NET) / SAMPLES_OF_A_NET as f64;
        Branches::all(Variances::of(&means, NETS).best(rays.max(0.0), longer))
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
        self.read(runs, workspace, |run, columns| {
            let weights = &self.weights[self.streams[runs[run].stream as usize].sensor];
            let weighted = columns.iter().zip(weights);
            sums[run] += weighted.map(|(value, w)| value * w).sum::<f64>();
        });
        sums
    }
}
