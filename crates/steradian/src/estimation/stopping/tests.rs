use std::ops::ControlFlow;
use std::time::Duration;

use super::*;
use crate::estimation::{Progress, SampleBatch, Silent, Stopping, Tally, merge_shards};
use crate::sampling::block;
use crate::sampling::hash::key_of_name;

/// `streams` streams in two sensors; stream s is the mean of (s + 1)(u + v²) in the first column and of a rare event in the second.
struct Mixture {
    streams: usize,
    fault: fn(u32, u32) -> f64,
}

impl Mixture {
    fn new(streams: usize) -> Self {
        Self {
            streams,
            fault: |_, _| 0.0,
        }
    }

    fn truth(stream: usize) -> f64 {
        (stream + 1) as f64 * 5.0 / 6.0 + 0.5 * 0.01
    }
}

impl Integrand for Mixture {
    type Workspace = u64;

    fn streams(&self) -> usize {
        self.streams
    }

    fn columns(&self) -> usize {
        2
    }

    fn sensor_of(&self, stream: usize) -> usize {
        stream % 2
    }

    fn stream_key(&self, stream: usize) -> u64 {
        combine(key_of_name("mixture"), stream as u64)
    }

    fn weights(&self, _: usize) -> &[f64] {
        &[1.0, 0.5]
    }

    fn new_workspace(&self) -> u64 {
        0
    }

    fn sample(&self, batch: &SampleBatch<'_>, samples: &mut u64, tally: &mut Tally) {
        for (number, run) in batch.runs.iter().enumerate() {
            for index in run.first..run.first + run.count {
                let [u, v, x, y] = block::sample(run.key, index, 0).map(f64::from);
                let rare = f64::from(u8::from(x < 0.1 && y < 0.1));
                let value =
                    f64::from(run.stream + 1) * (u + v * v) + (self.fault)(run.stream, index);
                tally.sample(number, &[value, rare], self.weights(0));
                *samples += 1;
            }
        }
    }
}

fn with(stop: Stopping, threads: usize) -> Plan {
    Plan {
        stop,
        threads,
        seed: 5,
        ..Plan::default()
    }
}

fn run(plan: &Plan) -> Vec<Replicates> {
    estimate(&Mixture::new(5), plan, &mut Silent).unwrap()
}

#[test]
fn values_are_right_within_their_error() {
    let streams = run(&with(Stopping::at_samples(1 << 14), 2));
    for (stream, replicates) in streams.iter().enumerate() {
        let estimate = replicates.combine(&[1.0, 0.5]);
        assert!((estimate.value - Mixture::truth(stream)).abs() < 5.0 * estimate.std_error);
        assert!(estimate.converged && estimate.std_error < 1e-3 * Mixture::truth(stream));
        assert!(!replicates.flagged());
    }
}

#[test]
fn a_number_of_samples_is_rounded_up_to_the_replicates() {
    assert_eq!(
        run(&with(Stopping::at_samples(100), 1))[0].samples(),
        [7; 16]
    );
}

#[test]
fn bits_do_not_depend_on_threads() {
    for stop in [
        Stopping::at_samples(20_000),
        Stopping::at_rel_error(0.002),
        Stopping::at_rms_error(0.002),
    ] {
        let one = run(&with(stop, 1));
        assert_eq!(one, run(&with(stop, 2)));
        assert_eq!(one, run(&with(stop, 7)));
    }
}

#[test]
fn merged_shards_are_the_run_in_one_piece() {
    for stop in [Stopping::at_samples(5_000), Stopping::at_rel_error(0.002)] {
        let whole = run(&with(stop, 1));
        let shard = |k| {
            run(&Plan {
                shard: Some((k, 3)),
                ..with(stop, 1)
            })
        };
        let [first, second, third] = [1, 2, 3].map(shard);
        assert_eq!(
            merge_shards(vec![third.clone(), first.clone(), second.clone()]),
            Ok(whole)
        );
        assert!(
            matches!(
                merge_shards(vec![first.clone(), second.clone()]),
                Err(EstimationError::Shards(_))
            ),
            "a gap"
        );
        assert!(
            matches!(
                merge_shards(vec![first.clone(), first, second, third]),
                Err(EstimationError::Shards(_))
            ),
            "an overlap"
        );
    }
    assert!(merge_shards(Vec::new()).is_err());
}

#[test]
fn tolerances_are_met() {
    for stream in run(&with(Stopping::at_rel_error(0.001), 2)) {
        let estimate = stream.combine(&[1.0, 0.5]);
        let [low, high] = estimate.interval.unwrap();
        assert!(estimate.converged && high - low <= 2.0 * 0.001 * estimate.value);
    }
    let absolute = Stopping {
        abs_error: Some(0.01),
        ..Stopping::default()
    };
    for stream in run(&with(absolute, 2)) {
        let [low, high] = stream.combine(&[1.0, 0.5]).interval.unwrap();
        assert!(stream.converged() && high - low <= 0.02);
    }
}

#[test]
fn a_cap_on_samples_ends_unreachable_tolerances() {
    let plan = Plan {
        max_samples: 1 << 13,
        ..with(Stopping::at_rel_error(1e-9), 1)
    };
    for stream in run(&plan) {
        assert!(!stream.converged() && stream.total_samples() <= 1 << 13);
    }
}

#[test]
fn a_timed_run_is_repeated_by_its_number_of_samples() {
    let timed = run(&with(Stopping::at_time(Duration::from_millis(30)), 2));
    let samples = timed[0].total_samples();
    assert!(
        samples >= 1024
            && timed
                .iter()
                .all(|stream| stream.total_samples() == samples && stream.converged())
    );
    assert_eq!(run(&with(Stopping::at_samples(samples), 1)), timed);
}

#[test]
fn an_exact_part_widens_the_tolerance() {
    struct Lifted(Mixture);
    impl Integrand for Lifted {
        type Workspace = u64;
        fn streams(&self) -> usize {
            self.0.streams()
        }
        fn columns(&self) -> usize {
            self.0.columns()
        }
        fn sensor_of(&self, stream: usize) -> usize {
            self.0.sensor_of(stream)
        }
        fn stream_key(&self, stream: usize) -> u64 {
            self.0.stream_key(stream)
        }
        fn weights(&self, _: usize) -> &[f64] {
            self.0.weights(0)
        }
        fn offset(&self, _stream: usize) -> f64 {
            1e4
        }
        fn new_workspace(&self) -> u64 {
            0
        }
        fn sample(&self, batch: &SampleBatch<'_>, workspace: &mut u64, tally: &mut Tally) {
            self.0.sample(batch, workspace, tally);
        }
    }
    let plan = with(Stopping::at_rel_error(1e-4), 1);
    let lifted = estimate(&Lifted(Mixture::new(1)), &plan, &mut Silent).unwrap();
    let plain = estimate(&Mixture::new(1), &plan, &mut Silent).unwrap();
    assert!(lifted[0].converged() && lifted[0].total_samples() * 4 < plain[0].total_samples());
}

#[test]
fn darkness_ends_and_is_not_converged() {
    struct Dark;
    impl Integrand for Dark {
        type Workspace = ();
        fn streams(&self) -> usize {
            2
        }
        fn columns(&self) -> usize {
            1
        }
        fn sensor_of(&self, _stream: usize) -> usize {
            0
        }
        fn stream_key(&self, stream: usize) -> u64 {
            stream as u64
        }
        fn weights(&self, _: usize) -> &[f64] {
            &[1.0]
        }
        fn new_workspace(&self) {}
        fn sample(&self, batch: &SampleBatch<'_>, _workspace: &mut (), tally: &mut Tally) {
            for (number, run) in batch
                .runs
                .iter()
                .enumerate()
                .filter(|(_, run)| run.stream == 1)
            {
                (0..run.count).for_each(|_| tally.sample(number, &[2.0], self.weights(0)));
            }
        }
    }
    let streams = estimate(&Dark, &with(Stopping::at_rel_error(0.01), 1), &mut Silent).unwrap();
    let [dark, lit] = [&streams[0], &streams[1]].map(|stream| stream.combine(&[1.0]));
    assert_eq!(
        (dark.value, dark.interval, dark.converged),
        (0.0, None, false)
    );
    assert!((0.0..2e-3).contains(&dark.upper_bound.unwrap()));
    assert_eq!((lit.value, lit.std_error, lit.converged), (2.0, 0.0, true));
}

#[test]
fn values_that_are_not_finite_are_an_error() {
    let fault = |stream: u32, index: u32| {
        if stream == 3 && index == 70 {
            f64::NAN
        } else {
            0.0
        }
    };
    let result = estimate(
        &Mixture { streams: 5, fault },
        &with(Stopping::at_samples(5000), 2),
        &mut Silent,
    );
    assert!(
        matches!(
            result,
            Err(EstimationError::NonFinite {
                stream: 3,
                count: 1,
                ..
            })
        ),
        "{result:?}"
    );
}

#[test]
fn a_panicking_worker_ends_the_run() {
    let fault = |stream: u32, _| {
        if stream == 2 {
            panic!("no such stream")
        } else {
            0.0
        }
    };
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| ()));
    let result = estimate(
        &Mixture { streams: 5, fault },
        &with(Stopping::at_samples(1 << 20), 3),
        &mut Silent,
    );
    std::panic::set_hook(hook);
    assert_eq!(
        result,
        Err(EstimationError::Panicked("no such stream".to_owned()))
    );
}

#[test]
fn an_observer_sees_progress_and_can_end_it() {
    let mut seen: Vec<Progress> = Vec::new();
    let mut observer = |progress: &Progress| {
        seen.push(*progress);
        if seen.len() == 2 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let streams = estimate(
        &Mixture::new(5),
        &with(Stopping::at_samples(1 << 36), 2),
        &mut observer,
    )
    .unwrap();
    assert!(
        streams
            .iter()
            .all(|stream| !stream.converged() && stream.total_samples() > 0)
    );
    assert_eq!(seen.len(), 2);
    let last = seen[1];
    assert!(last.samples > seen[0].samples && last.planned == 5 << 36);
    assert!(last.remaining.unwrap() > Duration::from_secs(1) && last.relative_error.unwrap() < 0.1);
}
