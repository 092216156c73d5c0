//! The same bits from every instruction set.

use crate::{meshes, random};
use steradian_kernel::{Accelerator, Cap, Geometry, HitBatch, InstructionSet, MISS, Quadric};

fn mixed_scene(triangles: usize, spheres: usize) -> Geometry {
    let mut geometry = random::soup(triangles, 0.3, 21);
    meshes::append(&mut geometry, &meshes::cuboid([-1.1; 3], [1.1; 3]));
    let mut random = random::Random::new(22);
    for _ in 0..spheres {
        let ports = vec![Cap {
            direction: [0.6, 0.0, 0.8],
            cos_half_angle: 0.9,
        }];
        geometry.quadrics.push(Quadric::Sphere {
            center: random.point(1.0).map(f64::from),
            radius: 0.1,
            ports,
        });
    }
    let center = random.point(0.5).map(f64::from);
    geometry.quadrics.push(Quadric::Disc {
        center,
        normal: [1.0, 2.0, 3.0],
        radius: 0.6,
        inner_radius: 0.2,
    });
    geometry.quadrics.push(Quadric::Plane {
        point: [0.0, 0.0, -0.9],
        normal: [0.1, 0.0, 1.0],
    });
    geometry
}

/// FNV-1a over the bits of all columns.
fn hash(hits: &HitBatch, occluded: &[bool]) -> u64 {
    let floats = [&hits.t, &hits.u, &hits.v]
        .into_iter()
        .flatten()
        .map(|x| x.to_bits());
    let all = floats
        .chain(hits.primitive.iter().copied())
        .chain(occluded.iter().map(|&x| u32::from(x)));
    all.flat_map(u32::to_le_bytes)
        .fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
        })
}

fn assert_same_bits(geometry: &Geometry) {
    let accelerator = Accelerator::build(geometry).unwrap();
    let rays = random::rays(30_000, 1.3, 23);
    let hashes =
        InstructionSet::available().into_iter().map(|set| {
            let (mut hits, mut occluded) = (HitBatch::default(), Vec::new());
            accelerator.closest(&rays, &mut hits, set);
            accelerator.occluded(&rays, &mut occluded, set);
            assert!(hits.primitive.contains(&MISS));
            assert!(hits.primitive.iter().any(
                |&primitive| primitive != MISS && primitive as usize > geometry.triangles.len()
            ));
            hash(&hits, &occluded)
        });
    let hashes: Vec<u64> = hashes.collect();
    assert!(
        hashes.windows(2).all(|pair| pair[0] == pair[1]),
        "{hashes:x?}"
    );
}

#[test]
fn instruction_sets_agree_on_a_large_mixed_scene() {
    assert_same_bits(&mixed_scene(2_000, 100));
}

#[test]
fn instruction_sets_agree_on_a_small_mixed_scene() {
    assert_same_bits(&mixed_scene(20, 2));
}

#[test]
fn the_order_of_the_rays_does_not_matter() {
    for geometry in [mixed_scene(20, 2), mixed_scene(200, 20)] {
        let accelerator = Accelerator::build(&geometry).unwrap();
        let rays = random::rays(3_001, 1.3, 24);
        let mut reversed = rays.clone();
        let columns = [
            &mut reversed.origin_x,
            &mut reversed.origin_y,
            &mut reversed.origin_z,
            &mut reversed.direction_x,
            &mut reversed.direction_y,
            &mut reversed.direction_z,
            &mut reversed.t_max,
        ];
        columns.into_iter().for_each(|column| column.reverse());
        let (mut hits, mut backwards) = (HitBatch::default(), HitBatch::default());
        accelerator.closest(&rays, &mut hits, InstructionSet::detect());
        accelerator.closest(&reversed, &mut backwards, InstructionSet::detect());
        assert!((0..3_001).all(|row| hits.hit(row) == backwards.hit(3_000 - row)));
    }
}
