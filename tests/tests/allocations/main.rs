//! No allocation along a path: the memory of a run is asked for once, and used again for every batch.
//!
//! A run of 2n samples is compared with one of n, after a picture that has made the tables that all share. What may grow with the samples is the scratch of the
//! ray kernel, one block for each query of up to 1024 rays in scenes as small as these: a batch of 1024 samples, four branches of up to four segments each, has 26
//! queries, and up to three times as many where surfaces let light pass. One block for eight samples allows for 128 in a batch; a single one
//! for each path, vertex or light sample would be eight times as many and more.
//!
//! Left out are textured `principled` materials and mixtures with textures, which make their model at each vertex, in blocks of its own.

mod scenes;

use std::alloc::System;

use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use steradian::estimation::film::Filter;
use steradian::estimation::{Plan, Silent, Stopping};
use steradian::scene::Scene;
use steradian::transport::{MeasureOptions, RenderOptions, measure, render};
use steradian_tests::measuring::validated;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const MAX_DEPTH: u32 = 4;
/// Samples of a pixel, and their number in all pixels.
const OF_A_PIXEL: u64 = 8;
const OF_A_PICTURE: u64 = OF_A_PIXEL * 32 * 32;
/// Samples of a point.
const OF_A_POINT: u64 = 1 << 11;
/// Samples for each block that may be asked for.
const FOR_A_BLOCK: u64 = 8;

fn plan(samples: u64, replicates: u32) -> Plan {
    Plan {
        stop: Stopping::at_samples(samples),
        threads: 1,
        replicates,
        ..Plan::default()
    }
}

/// Blocks asked for, new or of another size, during a run.
fn asked_for(run: impl FnOnce()) -> u64 {
    let region = Region::new(ALLOCATOR);
    run();
    let change = region.change();
    (change.allocations + change.reallocations) as u64
}

/// Of a picture whose one tile is a batch.
fn rendering(scene: &Scene, samples: u64) -> u64 {
    let options = RenderOptions {
        plan: plan(samples, 2),
        filter: Filter::Box,
        max_depth: Some(MAX_DEPTH),
        ..RenderOptions::default()
    };
    asked_for(|| drop(render(scene, 0, &options, &mut Silent).expect("a picture")))
}

fn measuring(scene: &Scene, sensor: &str, samples: u64) -> u64 {
    let options = MeasureOptions {
        plan: plan(samples, 16),
        max_depth: Some(MAX_DEPTH),
        sensors: Some(vec![sensor.into()]),
        ..MeasureOptions::default()
    };
    asked_for(|| drop(measure(scene, &options, &mut Silent).expect("readings")))
}

/// Says so if twice the samples ask for too many more blocks.
fn excess(what: &str, samples: u64, run: impl FnMut(u64) -> u64) -> Option<String> {
    let [once, twice] = [samples, 2 * samples].map(run);
    let more = twice.saturating_sub(once);
    (more * FOR_A_BLOCK > samples).then(|| format!("{what}: {more} more for {samples} samples"))
}

/// One test, as others beside it would ask for memory, too.
#[test]
fn paths_do_not_allocate() {
    let mut wrong = vec![];
    for (name, description) in scenes::all() {
        let scene = validated(&description);
        let render = |n| rendering(&scene, OF_A_PIXEL * n / OF_A_PICTURE);
        render(OF_A_PICTURE);
        wrong.extend(excess(&format!("{name}, eye"), OF_A_PICTURE, render));
        for sensor in &description.sensors[1..] {
            let measure = |n| measuring(&scene, &sensor.name, n);
            let what = format!("{name}, {}", sensor.name);
            wrong.extend(excess(&what, OF_A_POINT, measure));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
