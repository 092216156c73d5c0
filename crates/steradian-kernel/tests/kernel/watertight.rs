//! No ray gets out of a closed mesh, not even between two triangles.

use crate::meshes;
use crate::random::Random;
use steradian_kernel::{Accelerator, Geometry, HitBatch, InstructionSet, MISS, RayBatch};

const RAYS: usize = 262_144;

/// Rays from near the centre exactly at vertices, at points of edges, and one unit in the last place beside.
fn adversarial_rays(geometry: &Geometry, size: f64, seed: u64) -> RayBatch {
    let mut random = Random::new(seed);
    let mut rays = RayBatch::with_capacity(RAYS);
    for row in 0..RAYS {
        let triangle = geometry.triangles[random.index(geometry.triangles.len())];
        let first = random.index(3);
        let [a, b] =
            [first, (first + 1) % 3].map(|corner| geometry.positions[triangle[corner] as usize]);
        let s = if row % 2 == 0 {
            0.0
        } else {
            random.unit() as f32
        };
        let origin = if row % 16 == 0 {
            [0.0; 3]
        } else {
            random.point(size)
        };
        let mut direction = [0, 1, 2].map(|k| a[k] + s * (b[k] - a[k]) - origin[k]);
        if row % 4 >= 2 {
            let axis = random.index(3);
            direction[axis] = if row % 8 >= 4 {
                direction[axis].next_up()
            } else {
                direction[axis].next_down()
            };
        }
        rays.push(origin, direction, f32::INFINITY);
    }
    rays
}

fn leaks(geometry: &Geometry, size: f64) -> usize {
    let accelerator = Accelerator::build(geometry).unwrap();
    let rays = adversarial_rays(geometry, size, 11);
    let (mut hits, mut occluded) = (HitBatch::default(), Vec::new());
    accelerator.closest(&rays, &mut hits, InstructionSet::detect());
    accelerator.occluded(&rays, &mut occluded, InstructionSet::detect());
    let misses = hits
        .primitive
        .iter()
        .filter(|&&primitive| primitive == MISS)
        .count();
    misses + occluded.iter().filter(|&&occluded| !occluded).count()
}

#[test]
fn a_bumpy_sphere_does_not_leak() {
    assert_eq!(leaks(&meshes::bumpy_sphere(5), 0.5), 0);
    assert_eq!(leaks(&meshes::bumpy_sphere(7), 0.5), 0);
}

#[test]
fn a_box_does_not_leak() {
    assert_eq!(
        leaks(&meshes::cuboid([-1.0, -2.0, -1.5], [1.0, 1.0, 1.25]), 0.9),
        0
    );
}

#[test]
fn a_cluttered_box_does_not_leak() {
    let mut geometry = meshes::cuboid([-2.0; 3], [2.0; 3]);
    for (k, mesh) in (0_u8..).zip([
        meshes::sphere(2, |_| 0.3),
        meshes::cuboid([-0.3; 3], [0.3, 0.2, 0.1]),
    ]) {
        let mut moved = mesh;
        moved
            .positions
            .iter_mut()
            .for_each(|point| point[usize::from(k)] += 1.3);
        meshes::append(&mut geometry, &moved);
    }
    assert_eq!(leaks(&geometry, 0.7), 0);
}

#[test]
fn a_distant_sphere_does_not_leak() {
    let mut geometry = meshes::sphere(4, |_| 1.0);
    let shift = [1024.0, -512.0, 2048.0];
    geometry
        .positions
        .iter_mut()
        .for_each(|point| *point = [0, 1, 2].map(|k| point[k] + shift[k]));
    let accelerator = Accelerator::build(&geometry).unwrap();
    let mut rays = RayBatch::default();
    for position in &geometry.positions {
        rays.push(
            shift,
            [0, 1, 2].map(|k| position[k] - shift[k]),
            f32::INFINITY,
        );
    }
    let mut hits = HitBatch::default();
    accelerator.closest(&rays, &mut hits, InstructionSet::detect());
    assert!(!hits.primitive.contains(&MISS));
}
