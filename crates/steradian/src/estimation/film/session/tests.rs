use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use super::*;
use crate::estimation::film::{Filter, PASSES, PixelBatch, Splat, merge_exposures};
use crate::estimation::student::two_sided_quantile;
use crate::estimation::{Progress, Silent, Stopping};
use crate::sampling::block;
use crate::sampling::hash::mix_64;

const FILTERS: [Filter; 3] = [Filter::Gaussian, Filter::Box, Filter::BlackmanHarris];

/// A ramp with noise: x + 2y in the first channel, the same plus noise of mean 0 in the second, 1 in the third.
struct Ramp;

impl PixelSampler for Ramp {
    type Workspace = ();

    fn new_workspace(&self) {}

    fn sample(&self, batch: &PixelBatch<'_>, _workspace: &mut (), out: &mut [[f32; CHANNELS]]) {
        for (i, out) in out.iter_mut().enumerate() {
            let ramp = batch.x[i] + 2.0 * batch.y[i];
            let [noise, ..] = block::sample(batch.keys[i], batch.indices[i], 1);
            *out = [ramp, ramp + 40.0 * (noise - 0.5), 1.0, batch.lens[0][i]];
        }
    }
}

fn film(filter: Filter) -> Film {
    Film {
        width: 70,
        height: 45,
        filter,
        key: 9,
        weights: [0.0, 1.0, 0.0, 0.0],
    }
}

fn plan(stop: Stopping) -> Plan {
    Plan {
        stop,
        replicates: PASSES,
        threads: 2,
        seed: 3,
        ..Plan::default()
    }
}

fn image(filter: Filter, plan: &Plan) -> Exposure {
    expose(&Ramp, &film(filter), plan, &mut Silent).unwrap()
}

/// A linear function through a symmetric filter of integral one is its value at the centre of the pixel.
#[test]
fn every_pixel_is_unbiased_up_to_the_border() {
    for filter in FILTERS {
        let image = image(filter, &plan(Stopping::at_samples(64)));
        let centres = (0..45)
            .flat_map(|y| (0..70).map(move |x| f64::from(x) + 0.5 + 2.0 * (f64::from(y) + 0.5)));
        let (mut sum, mut squares, mut covered) = (0.0, 0.0, 0.0);
        for ((value, error), exact) in image.values().iter().zip(image.std_errors()).zip(centres) {
            // With the box a constant is one but for rounding; with the others its weights are sampled, about 8e-4 off.
            let tolerance = if filter == Filter::Box { 1e-6 } else { 0.02 };
            assert!(
                (value[2] - 1.0).abs() < tolerance,
                "{filter:?}: {}",
                value[2]
            );
            sum += value[1] - exact;
            squares += error[1] * error[1];
            covered += f64::from(u8::from((value[1] - exact).abs() <= 3.182 * error[1]));
        }
        // Neighbours share samples, each spread over 16 pixels with total weight 1: variances of sums grow at most 16-fold.
        let pixels = 70.0 * 45.0;
        assert!(
            sum.abs() < 5.0 * (16.0 * squares).sqrt(),
            "{filter:?}: {sum}"
        );
        // t with 3 degrees of freedom covers 95 %: 5 σ, false alarm below 1e-6.
        let sigma = (16.0_f64 * 0.95 * 0.05 / pixels).sqrt();
        assert!(
            (covered / pixels - 0.95).abs() < 5.0 * sigma,
            "{filter:?}: {covered}"
        );
    }
}

/// How many of the intervals of 6 tiles × 100 seeds hold the exact mean.
fn held_by_tiles(stop: Stopping) -> u32 {
    let mut held = 0;
    for seed in 0..100 {
        let plan = Plan { seed, ..plan(stop) };
        let image = image(Filter::Gaussian, &plan);
        assert_eq!(image.tile_counts(), [3, 2]);
        for (column, row) in [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)] {
            let middle = |number: u32, size: u32| {
                f64::from(32 * number + (32 * number + 32).min(size)) / 2.0
            };
            let exact = middle(column, 70) + 2.0 * middle(row, 45);
            let [low, high] = image
                .tile(column, row, &[0.0, 1.0, 0.0, 0.0], 0.95)
                .interval
                .unwrap();
            held += u32::from((low..=high).contains(&exact));
        }
    }
    held
}

/// Of 600 nearly independent intervals of probability .95 (tiles share the samples of a 32nd of their pixels with a neighbour) fewer than 544 or
/// more than 596 hold with probability 4e-6, by the binomial law. With the tolerance, tiles have numbers of their own, found by a pilot.
#[test]
fn intervals_of_tiles_hold_the_exact_mean() {
    for stop in [Stopping::at_samples(16), Stopping::at_rel_error(0.1)] {
        let held = held_by_tiles(stop);
        assert!((544..=596).contains(&held), "{stop:?}: {held}");
    }
}

#[test]
fn bits_do_not_depend_on_threads_or_shards() {
    for filter in FILTERS {
        let plan = plan(Stopping::at_samples(300));
        let whole = image(filter, &plan);
        assert_eq!(
            whole,
            image(
                filter,
                &Plan {
                    threads: 1,
                    ..plan.clone()
                }
            )
        );
        assert_eq!(
            whole,
            image(
                filter,
                &Plan {
                    threads: 7,
                    ..plan.clone()
                }
            )
        );
        let shards = [3, 1, 2].map(|k| {
            image(
                filter,
                &Plan {
                    shard: Some((k, 3)),
                    ..plan.clone()
                },
            )
        });
        assert_eq!(merge_exposures(shards.to_vec()), Ok(whole));
        assert!(merge_exposures(shards[1..].to_vec()).is_err());
        assert!(merge_exposures(Vec::new()).is_err());
    }
}

/// The [`Ramp`], and the most samples that a pixel has had in one pass.
#[derive(Default)]
struct Watched(AtomicU32);

impl PixelSampler for Watched {
    type Workspace = ();

    fn new_workspace(&self) {}

    fn sample(&self, batch: &PixelBatch<'_>, workspace: &mut (), out: &mut [[f32; CHANNELS]]) {
        let longest = batch.indices.iter().max().map_or(0, |index| index + 1);
        self.0.fetch_max(longest, Ordering::Relaxed);
        Ramp.sample(batch, workspace, out);
    }
}

/// Even samples would be as many everywhere as in the tile with the dark corner. Noise that is the same everywhere would need .43 of them; the filter's weights add
/// some that grows with the value, numbers are rounded up by at most an eighth, and tiles have margins beyond the film.
#[test]
fn a_tolerance_is_met_by_the_tiles_that_need_it() {
    let plan = plan(Stopping::at_rel_error(0.05));
    let sampler = Watched::default();
    let image = expose(&sampler, &film(Filter::Gaussian), &plan, &mut Silent).unwrap();
    assert!(image.converged() && image.passes() == PASSES);
    let evenly = 74 * 49 * u64::from(PASSES * sampler.0.into_inner());
    let part = image.samples() as f64 / evenly as f64;
    assert!(part < 0.7, "{part}");
}

#[test]
fn shards_of_a_tolerance_are_refused() {
    let plan = Plan {
        shard: Some((1, 2)),
        ..plan(Stopping::at_rel_error(0.05))
    };
    assert!(expose(&Ramp, &film(Filter::Box), &plan, &mut Silent).is_err());
}

#[test]
fn a_timed_image_ends_in_time_and_is_complete() {
    let image = image(
        Filter::Gaussian,
        &plan(Stopping::at_time(Duration::from_millis(100))),
    );
    assert!(image.converged() && image.samples() >= 74 * 49 * 4);
}

#[test]
fn values_that_are_not_finite_are_an_error() {
    struct Broken;
    impl PixelSampler for Broken {
        type Workspace = ();
        fn new_workspace(&self) {}
        fn sample(&self, batch: &PixelBatch<'_>, _workspace: &mut (), out: &mut [[f32; CHANNELS]]) {
            for (x, out) in batch.x.iter().zip(out) {
                *out = [
                    0.0,
                    0.0,
                    if (50.0..51.0).contains(x) {
                        f32::NAN
                    } else {
                        0.0
                    },
                    0.0,
                ];
            }
        }
    }
    let result = expose(
        &Broken,
        &film(Filter::Gaussian),
        &plan(Stopping::at_samples(4)),
        &mut Silent,
    );
    assert!(
        matches!(result, Err(EstimationError::NonFinitePixel { x, .. }) if (50.0..51.0).contains(&x))
    );
}

#[test]
fn breaking_leaves_complete_passes() {
    let mut calls = 0;
    let mut observer = |progress: &Progress| {
        calls += 1;
        assert!(progress.samples < progress.planned && progress.phase == Phase::Final);
        ControlFlow::Break(())
    };
    let image = expose(
        &Ramp,
        &film(Filter::Gaussian),
        &plan(Stopping::at_samples(1 << 30)),
        &mut observer,
    )
    .unwrap();
    assert_eq!((image.converged(), image.passes(), calls), (false, 0, 1));
    assert!(image.std_errors().all(|error| error[0].is_infinite()));
}

/// Nothing but splats, all over the film and its margin: the ramp of [`Ramp`], and 0 or 2 by chance.
struct Drizzle;

impl PixelSampler for Drizzle {
    type Workspace = ();

    fn new_workspace(&self) {}

    fn sample(&self, _: &PixelBatch<'_>, _: &mut (), out: &mut [[f32; CHANNELS]]) {
        out.fill([0.0; CHANNELS]);
    }

    fn has_splats(&self) -> bool {
        true
    }

    fn splat(&self, indices: Range<u32>, key: u64, _: &mut (), out: &mut Vec<Splat>) {
        let size = [74.0, 49.0];
        for index in indices {
            let [u, v, ..] = block::sample(key, index, 0).map(f64::from);
            let [x, y] = [u * size[0] - 2.0, v * size[1] - 2.0];
            let chance = mix_64(key ^ u64::from(index)) >> 63;
            let value = [x + 2.0 * y, 2.0 * chance as f64, 0.0, 0.0];
            let value = value.map(|value| (value * size[0] * size[1]) as f32);
            out.push(Splat {
                place: [x, y],
                value,
            });
        }
    }
}

/// Splats through a symmetric filter of integral one give a linear function at the centres of the pixels, up to the border. Of the means
/// over 6 tiles and 3 filters one is off by more than 5 standard errors of 16 passes with probability 3e-3; the seed is fixed.
#[test]
fn splats_are_unbiased_up_to_the_border() {
    for filter in FILTERS {
        let plan = Plan {
            replicates: 16,
            ..plan(Stopping::at_samples(64))
        };
        let image = expose(&Drizzle, &film(filter), &plan, &mut Silent).unwrap();
        for (column, row) in (0..3).flat_map(|column| (0..2).map(move |row| (column, row))) {
            let middle = |number: u32, size: u32| {
                f64::midpoint(
                    f64::from(32 * number),
                    f64::from((32 * number + 32).min(size)),
                )
            };
            let (x, y) = (middle(column, 70), middle(row, 45));
            for (channel, exact) in [x + 2.0 * y, 1.0].into_iter().enumerate() {
                let weights = std::array::from_fn(|other| f64::from(u8::from(other == channel)));
                let found = image.tile(column, row, &weights, 0.95);
                let off = (found.value - exact).abs();
                assert!(off < 5.0 * found.std_error, "{filter:?} {x} {y}: {found:?}");
                assert!(found.std_error < 0.03 * exact, "{filter:?}: {found:?}");
            }
        }
    }
}

/// Where all noise is that of splats, there are as many as the tolerance needs, and of other samples no more than the fewest.
#[test]
fn a_tolerance_is_met_by_splats_alone() {
    let tolerance = plan(Stopping::at_rel_error(0.02));
    let image = expose(&Drizzle, &film(Filter::Gaussian), &tolerance, &mut Silent).unwrap();
    assert!(image.converged());
    let pixels = 74 * 49;
    assert_eq!(image.samples(), u64::from(PASSES) * pixels);
    let quantile = two_sided_quantile(0.95, PASSES - 1);
    let errors: f64 = image.std_errors().map(|error| error[1]).sum();
    let half_width = quantile * errors / (70.0 * 45.0);
    assert!((0.005..0.02).contains(&half_width), "{half_width}");
}
