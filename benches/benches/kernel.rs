//! The ray kernel on meshes made here: rays per second of incoherent rays in batches of 1024, and build time.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use steradian_kernel::{Accelerator, Geometry, HitBatch, InstructionSet, RayBatch};

fn main() {
    divan::main();
}

const BATCH: usize = 1024;

#[derive(Copy, Clone, Debug)]
enum Scene {
    /// A Cornell box: 32 triangles.
    Cornell,
    /// A room with this many boxes.
    Room(u32),
}

const SCENES: [Scene; 3] = [Scene::Cornell, Scene::Room(800), Scene::Room(8_000)];

/// SplitMix64 as a stream of numbers in 0 .. 1.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ z >> 31) >> 40) as f32 / (1 << 24) as f32
    }

    fn point(&mut self) -> [f32; 3] {
        [self.unit(), self.unit(), self.unit()]
    }
}

/// A box, by its lower corner and size.
fn add_box(geometry: &mut Geometry, lower: [f32; 3], size: [f32; 3]) {
    let base = geometry.positions.len() as u32;
    geometry.positions.extend(
        (0..8)
            .map(|corner: usize| [0, 1, 2].map(|k| lower[k] + (corner >> k & 1) as f32 * size[k])),
    );
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = quads
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    geometry
        .triangles
        .extend(triangles.map(|triangle| triangle.map(|corner| base + corner)));
}

impl Scene {
    fn geometry(self) -> Geometry {
        let mut geometry = Geometry::default();
        add_box(&mut geometry, [0.0; 3], [1.0; 3]);
        match self {
            Self::Cornell => {
                geometry.triangles.truncate(10);
                add_box(&mut geometry, [0.15, 0.1, 0.0], [0.3, 0.3, 0.3]);
                add_box(&mut geometry, [0.5, 0.5, 0.0], [0.3, 0.3, 0.6]);
                geometry.triangles.truncate(32);
            }
            Self::Room(boxes) => {
                let mut random = Random(1);
                for _ in 0..boxes {
                    let size = 0.5 / f64::from(boxes).sqrt() as f32;
                    add_box(
                        &mut geometry,
                        random.point(),
                        random.point().map(|x| x * size),
                    );
                }
            }
        }
        geometry
    }

    fn accelerator(self) -> Accelerator {
        Accelerator::build(&self.geometry()).expect("the mesh is valid")
    }
}

/// Batches of rays between random points of the room, as bounce (endless) or shadow rays.
fn batches(is_shadow: bool) -> Vec<RayBatch> {
    let mut random = Random(2);
    let mut batches = vec![RayBatch::with_capacity(BATCH); 64];
    for batch in &mut batches {
        for _ in 0..BATCH {
            let (from, to) = (random.point(), random.point());
            let end = if is_shadow { 0.999 } else { f32::INFINITY };
            batch.push(from, [0, 1, 2].map(|k| to[k] - from[k]), end);
        }
    }
    batches
}

#[divan::bench(args = SCENES)]
fn closest(bencher: Bencher<'_, '_>, scene: Scene) {
    let (accelerator, batches) = (scene.accelerator(), batches(false));
    let (mut hits, mut next) = (HitBatch::default(), batches.iter().cycle());
    bencher.counter(ItemsCount::new(BATCH)).bench_local(|| {
        if let Some(batch) = next.next() {
            accelerator.closest(black_box(batch), &mut hits, InstructionSet::detect());
        }
        black_box(&hits);
    });
}

#[divan::bench(args = SCENES)]
fn occluded(bencher: Bencher<'_, '_>, scene: Scene) {
    let (accelerator, batches) = (scene.accelerator(), batches(true));
    let (mut occluded, mut next) = (Vec::new(), batches.iter().cycle());
    bencher.counter(ItemsCount::new(BATCH)).bench_local(|| {
        if let Some(batch) = next.next() {
            accelerator.occluded(black_box(batch), &mut occluded, InstructionSet::detect());
        }
        black_box(&occluded);
    });
}

#[divan::bench(args = SCENES, sample_count = 10)]
fn build(bencher: Bencher<'_, '_>, scene: Scene) {
    let geometry = scene.geometry();
    let triangles = ItemsCount::new(geometry.triangles.len());
    bencher
        .counter(triangles)
        .bench_local(|| Accelerator::build(black_box(&geometry)));
}
