//! Samples shared out: how many they are, and whether the intervals hold all the same.

use crate::estimation::cells::half_width_factor;
use crate::estimation::{
    Estimate, Integrand, Plan, Replicates, SampleBatch, Silent, Stopping, Tally, estimate,
};
use crate::sampling::block;
use crate::sampling::hash::{combine, key_of_name, mix_64};

fn within(rms_error: f64, seed: u64) -> Plan {
    Plan {
        stop: Stopping::at_rms_error(rms_error),
        threads: 1,
        seed,
        ..Plan::default()
    }
}

/// 64 streams of mean 1, one in eight of which is bright in every 25th sample only (r = 4.9), the others in half of them (r = 1).
struct Corners;

impl Corners {
    fn brightness(stream: u32) -> f64 {
        if stream.is_multiple_of(8) { 25.0 } else { 2.0 }
    }
}

impl Integrand for Corners {
    type Workspace = ();

    fn streams(&self) -> usize {
        64
    }

    fn columns(&self) -> usize {
        1
    }

    fn sensor_of(&self, _: usize) -> usize {
        0
    }

    fn stream_key(&self, stream: usize) -> u64 {
        combine(key_of_name("corners"), stream as u64)
    }

    fn weights(&self, _: usize) -> &[f64] {
        &[1.0]
    }

    fn new_workspace(&self) {}

    fn sample(&self, batch: &SampleBatch<'_>, _: &mut (), tally: &mut Tally) {
        for (number, run) in batch.runs.iter().enumerate() {
            let brightness = Self::brightness(run.stream);
            for index in run.first..run.first + run.count {
                let hashed = mix_64(run.key ^ mix_64(u64::from(index)));
                let u = (hashed >> 11) as f64 * 0.5_f64.powi(53);
                let value = if u * brightness < 1.0 {
                    brightness
                } else {
                    0.0
                };
                tally.sample(number, &[value], &[1.0]);
            }
        }
    }
}

/// r̄ = 1.49 and mean(r²) = 3.88: streams that share samples out need 1.75 times fewer than as many for each would be.
#[test]
fn a_root_mean_square_is_reached_with_samples_shared_out() {
    let wanted = 0.02;
    let plan = within(wanted, 5);
    let streams = estimate(&Corners, &plan, &mut Silent).unwrap();
    let estimates: Vec<_> = streams.iter().map(|s| s.combine(&[1.0])).collect();
    let factor = half_width_factor(&plan);
    let mean = |of: &dyn Fn(&Estimate) -> f64| {
        estimates.iter().map(of).sum::<f64>() / estimates.len() as f64
    };
    let stated = mean(&|e| (factor * e.std_error / e.value).powi(2)).sqrt();
    assert!(
        stated <= wanted && estimates.iter().all(|e| e.converged),
        "{stated}"
    );
    let drawn: u64 = streams.iter().flat_map(Replicates::samples).sum();
    let evenly = mean(&|_| 3.88 * (factor / wanted).powi(2)) * 64.0;
    assert!((drawn as f64) < 0.75 * evenly, "{drawn} of {evenly}");
    // Squares of Student's t with 15 degrees of freedom: mean 1.15, standard deviation 1.9, of 64 of them .24; beyond 4 of these once in 10⁴.
    let scores = mean(&|e| ((e.value - 1.0) / e.std_error).powi(2));
    assert!((0.3..2.1).contains(&scores), "{scores}");
}

/// The streams of a room: of mean 1; of a tenth of it, bright in every 25th sample only; and of 2/1000 like these, below the floor of the tolerance.
struct Room;

const KINDS: usize = 3;
const MEANS: [f64; KINDS] = [1.0, 0.1, 0.002];
const STREAMS: usize = 32;

impl Room {
    /// Two streams of eight are dark.
    fn kind(stream: usize) -> usize {
        match stream % 8 {
            0 => 1,
            1 => 2,
            _ => 0,
        }
    }

    /// Two numbers of different blocks, which no net integrates.
    fn value(stream: usize, key: u64, index: u32) -> f64 {
        let [a, b] = [0, 1].map(|number| f64::from(block::sample(key, index, number)[0]));
        let kind = Self::kind(stream);
        let bright = match kind {
            0 if a + b < 1.0 => 2.0,
            1 | 2 if a.max(b) < 0.2 => 25.0,
            _ => 0.0,
        };
        bright * MEANS[kind]
    }
}

impl Integrand for Room {
    type Workspace = ();

    fn streams(&self) -> usize {
        STREAMS
    }

    fn columns(&self) -> usize {
        1
    }

    fn sensor_of(&self, _: usize) -> usize {
        0
    }

    fn stream_key(&self, stream: usize) -> u64 {
        combine(key_of_name("room"), stream as u64)
    }

    fn weights(&self, _: usize) -> &[f64] {
        &[1.0]
    }

    fn new_workspace(&self) {}

    fn sample(&self, batch: &SampleBatch<'_>, _: &mut (), tally: &mut Tally) {
        for (number, run) in batch.runs.iter().enumerate() {
            for index in run.first..run.first + run.count {
                let value = Self::value(run.stream as usize, run.key, index);
                tally.sample(number, &[value], &[1.0]);
            }
        }
    }
}

/// Of 4800 intervals of lit streams that hold with probability .95, fewer than 4493 hold with probability 1e-5; of 800 of each kind of dark ones,
/// fewer than 731 (binomial law; seeds and streams are independent).
#[test]
fn intervals_of_lit_and_dark_streams_hold_the_mean() {
    let mut held = [0; KINDS];
    for seed in 0..200 {
        let streams = estimate(&Room, &within(0.1, seed), &mut Silent).unwrap();
        for (stream, replicates) in streams.iter().enumerate() {
            let kind = Room::kind(stream);
            let [low, high] = replicates.combine(&[1.0]).interval.unwrap();
            held[kind] += u32::from((low..=high).contains(&MEANS[kind]));
        }
    }
    let fewest = [4493, 731, 731];
    let enough = held
        .iter()
        .zip(fewest)
        .all(|(&held, fewest)| held >= fewest);
    assert!(enough, "{held:?} of at least {fewest:?}");
}
