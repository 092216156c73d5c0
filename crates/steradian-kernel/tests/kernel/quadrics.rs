//! Spheres, discs and planes among triangles.

use crate::random::{self, Random};
use steradian_kernel::{
    Accelerator, Cap, Geometry, HitBatch, InstructionSet, MISS, Quadric, RayBatch,
};

fn random_quadrics(count: usize, size: f64, seed: u64) -> Vec<Quadric> {
    let mut random = Random::new(seed);
    let mut quadric = |kind: usize| {
        let center = random.point(1.0).map(f64::from);
        let normal = random.point(1.0).map(f64::from);
        let radius = size * (0.1 + random.unit());
        match kind {
            0 => Quadric::Sphere {
                center,
                radius,
                ports: vec![],
            },
            1 => {
                let ports = vec![Cap {
                    direction: [0.0, 0.6, -0.8],
                    cos_half_angle: random.unit(),
                }];
                Quadric::Sphere {
                    center,
                    radius,
                    ports,
                }
            }
            2 => Quadric::Disc {
                center,
                normal,
                radius,
                inner_radius: 0.0,
            },
            _ => Quadric::Disc {
                center,
                normal,
                radius,
                inner_radius: 0.5 * radius,
            },
        }
    };
    (0..count).map(|k| quadric(k % 4)).collect()
}

#[test]
fn trees_of_quadrics_agree_with_brute_force() {
    for (triangles, quadrics, size) in [
        (0, 3, 0.6),
        (10, 4, 0.4),
        (0, 200, 0.1),
        (300, 200, 0.1),
        (5, 40, 0.5),
    ] {
        let mut geometry = random::soup(triangles, 0.2, 31);
        geometry.quadrics = random_quadrics(quadrics, size, 32);
        let accelerator = Accelerator::build(&geometry).unwrap();
        let rays = random::rays(3_000, 1.4, 33);
        let (mut hits, mut occluded) = (HitBatch::default(), Vec::new());
        for set in InstructionSet::available() {
            accelerator.closest(&rays, &mut hits, set);
            accelerator.occluded(&rays, &mut occluded, set);
            for (row, &occluded) in occluded.iter().enumerate() {
                let ray = rays.ray(row);
                assert_eq!(
                    hits.hit(row),
                    accelerator.closest_brute_force(&ray),
                    "{set:?} {ray:?}"
                );
                assert_eq!(
                    occluded,
                    hits.primitive[row] != MISS && hits.t[row] < ray.t_max
                );
            }
        }
    }
}

#[test]
fn hits_lie_on_the_sphere() {
    let (center, radius) = ([0.3, -0.2, 0.5], 0.75);
    let quadrics = vec![Quadric::Sphere {
        center,
        radius,
        ports: vec![],
    }];
    let accelerator = Accelerator::build(&Geometry {
        quadrics,
        ..Geometry::default()
    })
    .unwrap();
    let rays = random::rays(2_000, 1.2, 34);
    let mut hits = HitBatch::default();
    accelerator.closest(&rays, &mut hits, InstructionSet::detect());
    let mut inside = 0;
    for row in (0..rays.len()).filter(|&row| hits.primitive[row] == 0) {
        let ray = rays.ray(row);
        let square = |t: f64| {
            let offset = [0, 1, 2]
                .map(|k| f64::from(ray.origin[k]) + t * f64::from(ray.direction[k]) - center[k]);
            offset.iter().map(|x| x * x).sum::<f64>()
        };
        // t is rounded to f32: the point moves by at most 2^-24 of the way, here below 5.
        assert!((square(f64::from(hits.t[row])).sqrt() - radius).abs() < 5.0 * libm::exp2(-24.0));
        inside += usize::from(square(0.0) < radius * radius);
    }
    assert!(inside > 100);
}

#[test]
fn every_ray_from_inside_a_sphere_hits_it_but_through_a_port() {
    let cap = Cap {
        direction: [0.0, 0.0, 1.0],
        cos_half_angle: 0.5,
    };
    let quadrics = vec![Quadric::Sphere {
        center: [0.0; 3],
        radius: 1.0,
        ports: vec![cap],
    }];
    let accelerator = Accelerator::build(&Geometry {
        quadrics,
        ..Geometry::default()
    })
    .unwrap();
    let mut random = Random::new(35);
    let mut rays = RayBatch::default();
    for _ in 0..4_000 {
        rays.push([0.0; 3], random.point(1.0), f32::INFINITY);
    }
    let mut hits = HitBatch::default();
    accelerator.closest(&rays, &mut hits, InstructionSet::detect());
    for row in 0..rays.len() {
        let [x, y, z] = rays.ray(row).direction.map(f64::from);
        let cosine = z / (x * x + y * y + z * z).sqrt();
        assert_eq!(hits.primitive[row] == MISS, cosine > 0.5, "{cosine}");
    }
}

#[test]
fn a_plane_is_hit_from_any_distance() {
    let quadrics = vec![Quadric::Plane {
        point: [0.0, 0.0, -1.0],
        normal: [0.0, 0.0, 1.0],
    }];
    let accelerator = Accelerator::build(&Geometry {
        quadrics,
        ..Geometry::default()
    })
    .unwrap();
    assert_eq!(accelerator.bounds(), None);
    let mut rays = RayBatch::default();
    rays.push([1e6, 1e6, 1.0], [1e6, 0.0, -1.0], f32::INFINITY);
    rays.push([0.0, 0.0, 1.0], [1e6, 0.0, 1.0], f32::INFINITY);
    let mut hits = HitBatch::default();
    accelerator.closest(&rays, &mut hits, InstructionSet::detect());
    assert_eq!(
        (hits.primitive[0], hits.t[0], hits.primitive[1]),
        (0, 2.0, MISS)
    );
}
