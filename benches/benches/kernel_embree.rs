//! Rays per second on meshes and rays that a peer program has written; `benchmarks/embree/README.md` says how to use it.
//!
//! Arguments: a directory, then names of meshes (all in the directory if none is given); `--build-only` leaves the rays out.
//! Figures are those of the fastest tenth of a second among passes that fill half a second of processor time, in batches of 1024 rays, one thread.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program that reports figures"
)]

use std::error::Error;
use std::path::Path;
use steradian_kernel::{
    Accelerator, BuildError, Geometry, HitBatch, InstructionSet, MISS, RayBatch,
};

const BATCH: usize = 1024;

fn main() -> Result<(), Box<dyn Error>> {
    let (flags, arguments): (Vec<String>, Vec<String>) = std::env::args()
        .skip(1)
        .partition(|argument| argument.starts_with("--"));
    let [directory, meshes @ ..] = arguments.as_slice() else {
        eprintln!("arguments: DIRECTORY [MESH ...] [--build-only]");
        return Ok(());
    };
    let build_only = flags.iter().any(|flag| flag == "--build-only");
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
        compare(Path::new(directory), &mesh, build_only)?;
    }
    Ok(())
}

fn compare(directory: &Path, mesh: &str, build_only: bool) -> Result<(), Box<dyn Error>> {
    let read = |suffix: &str| std::fs::read(directory.join(format!("{mesh}.{suffix}")));
    let geometry = Geometry {
        positions: words(&read("verts.f32")?)
            .map(|word| word.map(f32::from_bits))
            .collect(),
        triangles: words(&read("tris.u32")?).collect(),
        quadrics: vec![],
    };
    let (accelerator, seconds) = build(&geometry)?;
    println!("{mesh} build_s: {seconds:.5}");
    let bytes = accelerator.memory_bytes() as f64 / geometry.triangles.len() as f64;
    println!("{mesh} bytes_per_triangle: {bytes:.1}");
    if build_only {
        return Ok(());
    }
    let set = instruction_set();
    for (kind, is_closest) in [("primary", true), ("diffuse", true), ("shadow", false)] {
        let batches = batches(&read(&format!("{kind}.rays"))?);
        let name = if is_closest { "closest" } else { "anyhit" };
        let Repeated {
            result: hits,
            seconds,
        } = repeat(|| pass(&accelerator, &batches, is_closest, set));
        let rays: usize = batches.iter().map(RayBatch::len).sum();
        let (speed, share) = (rays as f64 / seconds * 1e-6, hits as f64 / rays as f64);
        println!("{mesh} {kind} {name}_single Mrays_per_s: {speed:.3}  hit_fraction: {share:.6}");
    }
    Ok(())
}

/// Also the processor seconds of a build.
fn build(geometry: &Geometry) -> Result<(Accelerator, f64), BuildError> {
    let Repeated { result, seconds } = repeat(|| Accelerator::build_on_threads(geometry, 1));
    Ok((result?, seconds))
}

struct Repeated<T> {
    result: T,
    /// Processor seconds of one repetition.
    seconds: f64,
}

/// Repeats a task until half a second is full; the fastest tenth of it counts, for others may have been at work beside the rest.
fn repeat<T>(task: impl Fn() -> T) -> Repeated<T> {
    let start = processor_seconds();
    let mut fastest = tenth(&task);
    while processor_seconds() - start < 0.5 {
        let next = tenth(&task);
        if next.seconds < fastest.seconds {
            fastest = next;
        }
    }
    fastest
}

/// Repeats a task until a tenth of a second is full, for the clock advances by milliseconds: seconds are a mean.
fn tenth<T>(task: impl Fn() -> T) -> Repeated<T> {
    let (start, mut times) = (processor_seconds(), 0.0);
    loop {
        let result = task();
        let seconds = processor_seconds() - start;
        times += 1.0;
        if seconds > 0.1 {
            return Repeated {
                result,
                seconds: seconds / times,
            };
        }
    }
}

/// The best one, or the one that the variable `INSTRUCTION_SET` names.
fn instruction_set() -> InstructionSet {
    match std::env::var("INSTRUCTION_SET").as_deref() {
        Ok("scalar") => InstructionSet::Scalar,
        Ok("avx2") => InstructionSet::Avx2,
        _ => InstructionSet::detect(),
    }
}

/// The number of hits of one pass.
fn pass(
    accelerator: &Accelerator,
    batches: &[RayBatch],
    is_closest: bool,
    set: InstructionSet,
) -> usize {
    let (mut hits, mut occluded) = (HitBatch::default(), Vec::new());
    let mut count = 0;
    for batch in batches {
        if is_closest {
            accelerator.closest(batch, &mut hits, set);
            count += hits.primitive.iter().filter(|&&hit| hit != MISS).count();
        } else {
            accelerator.occluded(batch, &mut occluded, set);
            count += occluded.iter().filter(|&&occluded| occluded).count();
        }
    }
    count
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
