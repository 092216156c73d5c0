//! Rays per second on meshes and rays that a peer program has written; `benchmarks/embree/README.md` says how to use it.
//!
//! Arguments: a directory, the number of passes, then names of meshes (all in the directory if none is given). Figures are
//! of the fastest pass, in batches of 1024 rays, one thread.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program that reports figures"
)]

use std::error::Error;
use std::path::Path;
use std::time::Instant;
use steradian_kernel::{Accelerator, Geometry, HitBatch, InstructionSet, MISS, RayBatch};

const BATCH: usize = 1024;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|argument| !argument.starts_with("--"))
        .collect();
    let [directory, passes, meshes @ ..] = arguments.as_slice() else {
        eprintln!("arguments: DIRECTORY PASSES [MESH ...]");
        return Ok(());
    };
    let all = [
        "sphere10k",
        "sphere100k",
        "sphere1M",
        "room10k",
        "room100k",
        "room1M",
    ];
    let meshes = if meshes.is_empty() {
        all.map(String::from).to_vec()
    } else {
        meshes.to_vec()
    };
    for mesh in meshes {
        compare(Path::new(directory), &mesh, passes.parse()?)?;
    }
    Ok(())
}

fn compare(directory: &Path, mesh: &str, passes: usize) -> Result<(), Box<dyn Error>> {
    let read = |suffix: &str| std::fs::read(directory.join(format!("{mesh}.{suffix}")));
    let geometry = Geometry {
        positions: words(&read("verts.f32")?)
            .map(|word| word.map(f32::from_bits))
            .collect(),
        triangles: words(&read("tris.u32")?).collect(),
        quadrics: vec![],
    };
    let start = Instant::now();
    let accelerator = Accelerator::build(&geometry)?;
    println!("{mesh} build_s: {:.4}", start.elapsed().as_secs_f64());
    let bytes = accelerator.memory_bytes() as f64 / geometry.triangles.len() as f64;
    println!("{mesh} bytes_per_triangle: {bytes:.1}");
    let set = instruction_set();
    for (kind, is_closest) in [
        ("primary", true),
        ("diffuse", true),
        ("diffuse", false),
        ("shadow", false),
    ] {
        let batches = batches(&read(&format!("{kind}.rays"))?);
        let name = if is_closest { "closest" } else { "anyhit" };
        let (seconds, hits) = (0..passes)
            .map(|_| pass(&accelerator, &batches, is_closest, set))
            .fold((f64::INFINITY, 0), |best, pass| {
                (best.0.min(pass.0), pass.1)
            });
        let rays: usize = batches.iter().map(RayBatch::len).sum();
        let (speed, share) = (rays as f64 / seconds * 1e-6, hits as f64 / rays as f64);
        println!("{mesh} {kind} {name}_single Mrays_per_s: {speed:.3}  hit_fraction: {share:.6}");
    }
    Ok(())
}

/// The best one, or the one that the variable `INSTRUCTION_SET` names.
fn instruction_set() -> InstructionSet {
    match std::env::var("INSTRUCTION_SET").as_deref() {
        Ok("scalar") => InstructionSet::Scalar,
        Ok("avx2") => InstructionSet::Avx2,
        _ => InstructionSet::detect(),
    }
}

/// Seconds and hits of one pass.
fn pass(
    accelerator: &Accelerator,
    batches: &[RayBatch],
    is_closest: bool,
    set: InstructionSet,
) -> (f64, usize) {
    let (mut hits, mut occluded) = (HitBatch::default(), Vec::new());
    let mut count = 0;
    let start = processor_seconds();
    for batch in batches {
        if is_closest {
            accelerator.closest(batch, &mut hits, set);
            count += hits.primitive.iter().filter(|&&hit| hit != MISS).count();
        } else {
            accelerator.occluded(batch, &mut occluded, set);
            count += occluded.iter().filter(|&&occluded| occluded).count();
        }
    }
    (processor_seconds() - start, count)
}

/// What this thread has computed so far, as Linux counts it; elsewhere the time of day.
fn processor_seconds() -> f64 {
    let statistics = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = statistics
        .split(' ')
        .next()
        .and_then(|word| word.parse::<f64>().ok());
    nanoseconds.map_or_else(time_of_day, |nanoseconds| nanoseconds * 1e-9)
}

fn time_of_day() -> f64 {
    std::time::SystemTime::now()
        .duration_since(std::time::UNIX_EPOCH)
        .map_or(0.0, |time| time.as_secs_f64())
}

/// Little-endian words, three at a time.
fn words(bytes: &[u8]) -> impl Iterator<Item = [u32; 3]> {
    bytes
        .as_chunks::<4>()
        .0
        .as_chunks::<3>()
        .0
        .iter()
        .map(|triple| triple.map(u32::from_le_bytes))
}

/// Records of origin, start, direction, end.
fn batches(bytes: &[u8]) -> Vec<RayBatch> {
    let records: Vec<[f32; 8]> = bytes
        .as_chunks::<4>()
        .0
        .as_chunks::<8>()
        .0
        .iter()
        .map(|record| record.map(f32::from_le_bytes))
        .collect();
    let batch = |records: &[[f32; 8]]| {
        let mut batch = RayBatch::with_capacity(BATCH);
        for &[ox, oy, oz, _, dx, dy, dz, t_max] in records {
            batch.push([ox, oy, oz], [dx, dy, dz], t_max);
        }
        batch
    };
    records.chunks(BATCH).map(batch).collect()
}
