//! Made-up measurements whose truth is known: one sensor `desk`, one lane, groups with given readings at each point.

use std::f64::consts::TAU;

use super::{LaneRecord, Measurements, PointRecord, SensorRecord};
use crate::sampling::hash;
use crate::sensor::Readout;

const REPLICATES: u64 = 16;

/// What each group adds to each point.
pub(crate) struct Synthetic<'a, const G: usize> {
    groups: &'a [&'a str; G],
    truth: &'a [[f64; G]],
}

impl<'a, const G: usize> Synthetic<'a, G> {
    pub fn new(groups: &'a [&'a str; G], truth: &'a [[f64; G]]) -> Self {
        Self { groups, truth }
    }

    /// Known exactly.
    pub fn closed(&self) -> Measurements {
        let point = |(index, truth): (usize, &[f64; G])| PointRecord {
            index,
            position: Some([index as f64, 0.0, 0.0]),
            normal: None,
            sits_on: None,
            about: None,
            exact: truth.to_vec(),
            closed: vec![true; G],
            replicates: None,
        };
        self.with(self.truth.iter().enumerate().map(point).collect())
    }

    /// Replicates off the truth by independent errors of this relative standard deviation.
    pub fn sampled(&self, seed: u64, relative: f64) -> Measurements {
        let mut measurements = self.closed();
        for point in &mut measurements.sensors[0].points {
            let sum = |replicate: u64, group: usize| {
                let key = hash::combine(hash::combine(seed, point.index as u64), replicate);
                let error = normal(hash::combine(key, group as u64));
                10.0 * self.truth[point.index][group] * (1.0 + relative * error)
            };
            let sums = (0..REPLICATES).flat_map(|r| (0..G).map(move |group| (r, group)));
            let sums: Vec<f64> = sums.map(|(r, group)| sum(r, group)).collect();
            let stored = serde_json::json!({
                "sensor": 0, "confidence": 0.95, "weights": vec![1.0; G], "sums": sums,
                "samples": vec![10; REPLICATES as usize], "largest": 1.0, "largest_of_sensor": 1.0, "converged": true,
            });
            point.replicates = Some(serde_json::from_value(stored).unwrap());
            (point.exact, point.closed) = (vec![0.0; G], vec![false; G]);
        }
        measurements
    }

    fn with(&self, points: Vec<PointRecord>) -> Measurements {
        let illuminance = Readout {
            name: "illuminance".into(),
            unit: "lx".into(),
            weights: vec![1.0],
            channel_factor: 1.0,
            photometric: true,
        };
        Measurements {
            scene_name: "made up".into(),
            seed: 0,
            confidence: 0.95,
            luminous_efficacy: None,
            max_depth: None,
            lanes: vec![LaneRecord {
                name: "total".into(),
            }],
            groups: self.groups.map(String::from).to_vec(),
            dimming: super::Dimming::default(),
            sensors: vec![SensorRecord {
                name: "desk".into(),
                quantities: vec![illuminance],
                layout: None,
                points,
            }],
            unsampled: vec![],
            warnings: vec![],
            shard: None,
        }
    }
}

/// A number with the standard normal distribution (Box & Muller 1958).
fn normal(key: u64) -> f64 {
    let uniform = |key: u64| ((hash::mix_64(key) >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0;
    let (u, v) = (uniform(key), uniform(key ^ 0x5851_f42d_4c95_7f2d));
    (-2.0 * libm::log(u)).sqrt() * libm::cos(TAU * v)
}
