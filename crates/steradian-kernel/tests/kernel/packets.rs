//! Neighbouring rays that go together find, bit for bit, what each of them finds alone, and whether it finds anything before its end.

use crate::{meshes, random};
use steradian_kernel::{
    Accelerator, Geometry, HitBatch, InstructionSet, MISS, Quadric, Ray, RayBatch,
};

/// Every ray alone, by the single-ray path and in a batch of its own, is the judge.
fn assert_same_as_alone(geometry: &Geometry, rays: &RayBatch) {
    let accelerator = Accelerator::build(geometry).unwrap();
    let expected: Vec<_> = (0..rays.len())
        .map(|row| accelerator.closest_scalar(&rays.ray(row)))
        .collect();
    for set in InstructionSet::available() {
        let mut hits = HitBatch::default();
        accelerator.closest(rays, &mut hits, set);
        for (row, alone) in expected.iter().enumerate() {
            let together = hits.hit(row);
            let bits = |x: f32| x.to_bits();
            assert_eq!(
                [together.t, together.u, together.v].map(bits),
                [alone.t, alone.u, alone.v].map(bits),
                "{set:?}, row {row}, {:?}",
                rays.ray(row)
            );
            assert_eq!(together.primitive, alone.primitive, "{set:?}, row {row}");
        }
        let mut occluded = Vec::new();
        accelerator.occluded(rays, &mut occluded, set);
        for (row, alone) in expected.iter().enumerate() {
            let before_end = alone.primitive != MISS && alone.t < rays.t_max[row];
            assert_eq!(occluded[row], before_end, "{set:?}, {:?}", rays.ray(row));
        }
    }
    for row in (0..rays.len()).step_by(13) {
        let brute = accelerator.closest_brute_force(&rays.ray(row));
        assert_eq!(expected[row], brute, "row {row}");
    }
}

/// Rays of a picture of this many columns, row by row, whose sides are seen under the tangent 2·`slope`.
fn camera(origin: [f32; 3], axis: usize, sign: f32, slope: f32, columns: usize) -> RayBatch {
    let mut batch = RayBatch::default();
    for pixel in 0..columns * columns {
        let at = |k: usize| (2.0 * k as f32 / columns as f32 - 1.0) * slope;
        let mut direction = [0.0; 3];
        direction[axis] = sign;
        direction[(axis + 1) % 3] = at(pixel % columns);
        direction[(axis + 2) % 3] = at(pixel / columns);
        batch.push(origin, direction, f32::INFINITY);
    }
    batch
}

/// Bumps in a box, spheres and planes: leaves of triangles and of quadrics.
fn mixed_scene() -> Geometry {
    let mut geometry = meshes::cuboid([-3.0; 3], [3.0; 3]);
    meshes::append(&mut geometry, &meshes::bumpy_sphere(3));
    meshes::append(&mut geometry, &random::soup(200, 0.4, 11));
    let sphere = |k: u32| Quadric::Sphere {
        center: [1.5, 0.5 * f64::from(k) - 1.0, 1.2],
        radius: 0.2,
        ports: vec![],
    };
    geometry.quadrics = (0..5).map(sphere).collect();
    geometry
}

#[test]
fn pictures_along_every_axis_are_those_of_single_rays() {
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let mut origin = [0.1, -0.2, 0.3];
            origin[axis] -= 2.0 * sign;
            for slope in [0.01, 0.4, 1.0] {
                assert_same_as_alone(&mixed_scene(), &camera(origin, axis, sign, slope, 48));
            }
        }
    }
}

/// Zeros of both signs, rays within planes of triangles and along their edges, corners hit exactly, ties.
#[test]
fn rays_parallel_to_axes_and_through_edges_agree() {
    let mut geometry = meshes::cuboid([-1.0; 3], [1.0; 3]);
    for k in 0..8 {
        let at = k as f32 * 0.25 - 1.0;
        meshes::append(&mut geometry, &meshes::cuboid([at; 3], [at + 0.25; 3]));
    }
    for zeros in [[0.0, 0.0], [-0.0, -0.0], [0.0, -0.0]] {
        for axis in 0..3 {
            let mut rays = RayBatch::default();
            for row in 0..1024_usize {
                let mut origin = [0.0; 3];
                origin[axis] = 4.0;
                origin[(axis + 1) % 3] = (row / 16) as f32 / 32.0 - 1.0;
                origin[(axis + 2) % 3] = (row / 16) as f32 / 64.0 + (row % 16) as f32 / 1024.0;
                let mut direction = [zeros[0]; 3];
                direction[(axis + 1) % 3] = zeros[1];
                direction[axis] = -1.0;
                rays.push(origin, direction, f32::INFINITY);
            }
            assert_same_as_alone(&geometry, &rays);
        }
    }
}

/// Ends before, at and behind the hits; rays that are not valid; neighbours that look elsewhere; batches of every length.
#[test]
fn mixed_groups_and_tails_agree() {
    let geometry = mixed_scene();
    let accelerator = Accelerator::build(&geometry).unwrap();
    let picture = camera([0.0, 0.0, -2.0], 2, 1.0, 0.3, 64);
    let mut random = random::Random::new(3);
    for length in [1, 7, 8, 15, 16, 17, 31, 40, 2000] {
        let mut rays = RayBatch::default();
        for row in 0..length {
            let Ray {
                mut origin,
                mut direction,
                mut t_max,
            } = picture.ray(row);
            let hit = accelerator.closest_scalar(&picture.ray(row));
            match random.index(60) {
                0 => direction = random.point(1.0),
                1 => origin = random.point(1.0),
                2 => direction[random.index(3)] = f32::NAN,
                3 => origin[random.index(3)] = f32::INFINITY,
                4 => t_max = f32::NAN,
                5 => direction = [0.0; 3],
                6..16 => t_max = hit.t,
                16..26 => t_max = hit.t.next_down(),
                26..30 => t_max = hit.t * 0.5,
                30 => t_max = -1.0,
                _ => {}
            }
            rays.push(origin, direction, t_max);
        }
        assert_same_as_alone(&geometry, &rays);
    }
}

/// Origins spread as over a lens, directions of any length, far from the origin and close.
#[test]
fn bundles_of_any_place_and_scale_agree() {
    let mut random = random::Random::new(5);
    for (scale, shift) in [
        (1.0, 0.0),
        (1e-6, 0.0),
        (1e6, 1e6),
        (1.0, 1e3),
        (1e-18, 0.0),
    ] {
        let mut geometry = random::soup(600, 0.2, 9);
        let place = |point: [f32; 3]| point.map(|x| x * scale + shift);
        for point in &mut geometry.positions {
            *point = place(*point);
        }
        let mut rays = RayBatch::default();
        for _ in 0..100 {
            let (origin, towards) = (random.point(1.5), random.point(1.0));
            for _ in 0..16 {
                let (lens, turn) = (random.point(0.01), random.point(0.03));
                let length = 1.0 + random.unit() as f32;
                let start = place([0, 1, 2].map(|k| origin[k] + lens[k]));
                let direction = [0, 1, 2].map(|k| (towards[k] + turn[k]) * length);
                rays.push(start, direction, f32::INFINITY);
            }
        }
        assert_same_as_alone(&geometry, &rays);
    }
}

/// Segments from neighbouring points to a lamp: in the open, behind things, through spheres, to the very surface of what they end on; and
/// through so much that packets are given up.
#[test]
fn shadow_rays_to_a_lamp_agree() {
    for geometry in [mixed_scene(), random::soup(2000, 0.1, 12)] {
        assert_same_to_a_lamp(&geometry);
    }
}

fn assert_same_to_a_lamp(geometry: &Geometry) {
    let mut random = random::Random::new(8);
    for size in [0.0, 0.02, 0.3, 0.8] {
        let mut rays = RayBatch::default();
        for _ in 0..100 {
            let (place, lamp) = (random.point(2.9), random.point(2.0));
            for k in 0..16 {
                let from = [place[0] + 0.003 * k as f32, place[1], place[2]];
                let on_lamp = random.point(size);
                let direction = [0, 1, 2].map(|k| lamp[k] + on_lamp[k] - from[k]);
                rays.push(from, direction, [1.0, 0.999, 2.0][k % 3]);
            }
        }
        assert_same_as_alone(geometry, &rays);
    }
}
