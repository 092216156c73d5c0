//! Tree, small-scene path and brute force find the same hits.

use crate::{meshes, random};
use proptest::prelude::*;
use steradian_kernel::{
    Accelerator, Geometry, HitBatch, InstructionSet, MISS, Quadric, Ray, RayBatch,
};

/// Out of everybody's way, but so many that the tree is used.
fn with_far_spheres(mut geometry: Geometry) -> Geometry {
    geometry.quadrics = (0..5)
        .map(|k| Quadric::Sphere {
            center: [1.1e4 + f64::from(k), 1.7e4, -3.3e4],
            radius: 1e-3,
            ports: vec![],
        })
        .collect();
    geometry
}

fn closest(accelerator: &Accelerator, rays: &RayBatch, set: InstructionSet) -> HitBatch {
    let mut hits = HitBatch::default();
    accelerator.closest(rays, &mut hits, set);
    hits
}

/// All ways to ask give the answer of the brute force, and so does the occlusion of the same rays.
fn assert_agreement(geometry: &Geometry, rays: &RayBatch) {
    let accelerators = [geometry.clone(), with_far_spheres(geometry.clone())]
        .map(|geometry| Accelerator::build(&geometry).unwrap());
    let expected: Vec<_> = (0..rays.len())
        .map(|row| accelerators[0].closest_brute_force(&rays.ray(row)))
        .collect();
    for accelerator in &accelerators {
        for set in InstructionSet::available() {
            let hits = closest(accelerator, rays, set);
            let mut occluded = Vec::new();
            accelerator.occluded(rays, &mut occluded, set);
            for (row, expected) in expected.iter().enumerate() {
                assert_eq!(hits.hit(row), *expected, "{set:?}, {:?}", rays.ray(row));
                let before_end = expected.primitive != MISS && expected.t < rays.t_max[row];
                assert_eq!(occluded[row], before_end, "{set:?}, {:?}", rays.ray(row));
            }
        }
        for (row, expected) in expected.iter().enumerate() {
            assert_eq!(accelerator.closest_scalar(&rays.ray(row)), *expected);
        }
    }
}

/// Few different coordinates: shared vertices, coplanar and axis-parallel rays, ties.
fn grid_point() -> impl Strategy<Value = [f32; 3]> {
    let coordinate = prop_oneof![3 => (-2_i8..=2).prop_map(f32::from), 1 => -2.0_f32..2.0];
    [coordinate.clone(), coordinate.clone(), coordinate]
}

fn triangles(count: impl Into<prop::collection::SizeRange>) -> impl Strategy<Value = Geometry> {
    prop::collection::vec([grid_point(), grid_point(), grid_point()], count).prop_map(|corners| {
        Geometry {
            positions: corners.iter().flatten().copied().collect(),
            triangles: (0..corners.len() as u32)
                .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
                .collect(),
            quadrics: vec![],
        }
    })
}

fn batch() -> impl Strategy<Value = RayBatch> {
    let length = prop_oneof![Just(f32::INFINITY), Just(1.0), 0.0_f32..4.0];
    prop::collection::vec((grid_point(), grid_point(), length), 1..40).prop_map(|rays| {
        let mut batch = RayBatch::default();
        rays.into_iter()
            .for_each(|(origin, direction, t_max)| batch.push(origin, direction, t_max));
        batch
    })
}

/// Pairs of triangles with a common edge, most of them folded.
fn hinges() -> impl Strategy<Value = Geometry> {
    let corners = [grid_point(), grid_point(), grid_point(), grid_point()];
    prop::collection::vec(corners, 1..6).prop_map(|hinges| Geometry {
        positions: hinges.iter().flatten().copied().collect(),
        triangles: (0..hinges.len() as u32)
            .map(|k| 4 * k)
            .flat_map(|a| [[a, a + 1, a + 2], [a, a + 2, a + 3]])
            .collect(),
        quadrics: vec![],
    })
}

/// The cube from −1 to 1, whose faces are those of its bounds, and a triangle in it.
fn room() -> Geometry {
    let mut room = meshes::cuboid([-1.0; 3], [1.0; 3]);
    let inside = Geometry {
        positions: vec![[-0.5, 0.1, 0.2], [0.9, -0.3, 0.4], [0.1, 0.2, -0.8]],
        triangles: vec![[0, 1, 2]],
        quadrics: vec![],
    };
    meshes::append(&mut room, &inside);
    room
}

/// Segments within the room, some of them to its very walls, out of it, and past it.
#[test]
fn walls_stop_what_leaves_the_room_and_nothing_else() {
    let mut random = random::Random::new(7);
    for reach in [0.999, 1.0, 1.001, 3.0] {
        let mut batch = RayBatch::default();
        for _ in 0..4096 {
            let (from, to) = (random.point(reach), random.point(reach));
            batch.push(from, [0, 1, 2].map(|k| to[k] - from[k]), 1.0);
        }
        assert_agreement(&room(), &batch);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn hinges_agree(geometry in hinges(), rays in batch()) {
        assert_agreement(&geometry, &rays);
    }

    #[test]
    fn few_triangles(geometry in triangles(0..30), rays in batch()) {
        assert_agreement(&geometry, &rays);
    }

    #[test]
    fn many_triangles(geometry in triangles(65..300), rays in batch()) {
        assert_agreement(&geometry, &rays);
    }
}

#[test]
fn soups_of_any_density() {
    for (seed, count, size) in [
        (1, 40, 0.5),
        (2, 1_000, 0.3),
        (3, 3_000, 0.03),
        (4, 500, 2.0),
    ] {
        assert_agreement(
            &random::soup(count, size, seed),
            &random::rays(1_500, 1.5, seed),
        );
    }
}

#[test]
fn scenes_far_from_the_origin_and_of_any_size() {
    for (scale, shift) in [
        (1e-6, 0.0),
        (1e-18, 0.0),
        (1e6, 0.0),
        (1.0, 1e3),
        (100.0, 1e6),
        (1e7, 1e8),
    ] {
        let place = |point: [f32; 3]| point.map(|x| x * scale + shift);
        let mut geometry = random::soup(300, 0.3, 5);
        geometry
            .positions
            .iter_mut()
            .for_each(|point| *point = place(*point));
        let unplaced = random::rays(1_000, 1.5, 6);
        let mut rays = RayBatch::default();
        for row in 0..unplaced.len() {
            let Ray {
                origin,
                direction,
                t_max,
            } = unplaced.ray(row);
            rays.push(place(origin), direction, t_max * scale);
        }
        assert_agreement(&geometry, &rays);
    }
}

#[test]
fn a_million_rays_hit_the_same_by_tree_and_by_trying_all() {
    let mut geometry = meshes::cuboid([-1.2; 3], [1.2; 3]);
    meshes::append(&mut geometry, &meshes::sphere(1, |_| 0.7));
    let small = Accelerator::build(&geometry).unwrap();
    let tree = Accelerator::build(&with_far_spheres(geometry)).unwrap();
    for seed in 0..10 {
        let rays = random::rays(100_000, 1.3, seed);
        let set = InstructionSet::detect();
        let expected = closest(&small, &rays, set);
        assert_eq!(closest(&tree, &rays, set), expected);
        for row in (0..rays.len()).step_by(50) {
            assert_eq!(small.closest_brute_force(&rays.ray(row)), expected.hit(row));
        }
        let share = expected
            .primitive
            .iter()
            .filter(|&&primitive| primitive != MISS)
            .count() as f64
            / 1e5;
        assert!((0.5..0.95).contains(&share), "{share}");
    }
}
