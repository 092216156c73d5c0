//! A region that is called clear is clear.

use crate::random::{self, Random};
use proptest::prelude::*;
use steradian_kernel::{Accelerator, Cap, Geometry, Quadric, Ray};

type HalfSpace = [f64; 4];

/// An axis-parallel box as six half-spaces.
fn cuboid(lower: [f64; 3], upper: [f64; 3]) -> Vec<HalfSpace> {
    let side = |k: usize, sign: f64, d: f64| {
        let mut plane = [0.0, 0.0, 0.0, d];
        plane[k] = sign;
        plane
    };
    (0..3)
        .flat_map(|k| [side(k, 1.0, upper[k]), side(k, -1.0, -lower[k])])
        .collect()
}

fn contains(planes: &[HalfSpace], [x, y, z]: [f64; 3]) -> bool {
    planes
        .iter()
        .all(|[a, b, c, d]| a * x + b * y + c * z <= *d)
}

fn is_clear(geometry: &Geometry, planes: &[HalfSpace]) -> bool {
    Accelerator::build(geometry)
        .unwrap()
        .region_is_clear(planes, &|_| false)
}

fn only(quadric: Quadric) -> Geometry {
    Geometry {
        quadrics: vec![quadric],
        ..Geometry::default()
    }
}

#[test]
fn a_triangle_blocks_what_it_reaches_into() {
    let positions = vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let geometry = Geometry {
        positions,
        triangles: vec![[0, 1, 2]],
        quadrics: vec![],
    };
    assert!(!is_clear(
        &geometry,
        &cuboid([0.5, 0.5, -1.0], [1.0, 1.0, 1.0])
    ));
    assert!(is_clear(
        &geometry,
        &cuboid([0.5, 0.5, 0.1], [1.0, 1.0, 1.0])
    ));
    // Inside the triangle's box, but beyond its hypotenuse.
    assert!(is_clear(
        &geometry,
        &cuboid([2.1, 2.1, -1.0], [3.0, 3.0, 1.0])
    ));
    assert!(!is_clear(
        &geometry,
        &cuboid([1.9, 1.9, -1.0], [3.0, 3.0, 1.0])
    ));
    // Touching counts.
    assert!(!is_clear(
        &geometry,
        &cuboid([0.5, 0.5, 0.0], [1.0, 1.0, 1.0])
    ));
    let accelerator = Accelerator::build(&geometry).unwrap();
    assert!(accelerator.region_is_clear(
        &cuboid([0.5, 0.5, -1.0], [1.0, 1.0, 1.0]),
        &|primitive| primitive == 0
    ));
    assert!(!accelerator.region_is_clear(&[], &|_| false));
}

#[test]
fn an_infinite_plane_blocks_however_far_away() {
    let ground = only(Quadric::Plane {
        point: [3.0, 4.0, 0.0],
        normal: [0.0, 0.0, 5.0],
    });
    assert!(is_clear(
        &ground,
        &cuboid([-1.0, -1.0, 0.1], [1.0, 1.0, 2.0])
    ));
    assert!(!is_clear(
        &ground,
        &cuboid([-1.0, -1.0, -0.1], [1.0, 1.0, 2.0])
    ));
    assert!(!is_clear(
        &ground,
        &cuboid([1e7, -1e7, -0.1], [1.1e7, -0.9e7, 2.0])
    ));
    // A half-space that meets the ground only far away, and one parallel to it.
    assert!(!is_clear(&ground, &[[1e-6, 0.0, 1.0, -1.0]]));
    assert!(is_clear(&ground, &[[0.0, 0.0, 1.0, -1.0]]));
    // A wedge that narrows towards the ground and ends above it.
    assert!(is_clear(
        &ground,
        &[[1.0, 0.0, -1.0, -1.0], [-1.0, 0.0, -1.0, -1.0]]
    ));
}

#[test]
fn spheres_and_discs_block_by_their_outline() {
    let sphere = only(Quadric::Sphere {
        center: [0.0; 3],
        radius: 1.0,
        ports: vec![],
    });
    let diagonal = |d: f64| vec![[-1.0, -1.0, -1.0, -d]];
    assert!(is_clear(&sphere, &diagonal(1.8)));
    assert!(!is_clear(&sphere, &diagonal(1.7)));
    let disc = only(Quadric::Disc {
        center: [0.0; 3],
        normal: [1.0, 1.0, 1.0],
        radius: 1.0,
        inner_radius: 0.0,
    });
    assert!(is_clear(&disc, &diagonal(0.01)));
    assert!(!is_clear(&disc, &diagonal(-0.01)));
    assert!(!is_clear(&disc, &[[1.0, -1.0, 0.0, -1.4]]));
    assert!(is_clear(&disc, &[[1.0, -1.0, 0.0, -1.42]]));
}

fn scene(seed: u64) -> Geometry {
    let mut geometry = random::soup(4 + (seed % 90) as usize, 0.2, seed);
    let mut random = Random::new(seed ^ 0xABCD);
    if seed.is_multiple_of(3) {
        let (center, normal) = (
            random.point(1.0).map(f64::from),
            random.point(1.0).map(f64::from),
        );
        let ports = vec![Cap {
            direction: [1.0, 0.0, 0.0],
            cos_half_angle: 0.3,
        }];
        geometry.quadrics.push(Quadric::Sphere {
            center,
            radius: 0.2,
            ports,
        });
        geometry.quadrics.push(Quadric::Disc {
            center,
            normal,
            radius: 0.5,
            inner_radius: 0.1,
        });
    }
    if seed.is_multiple_of(7) {
        geometry.quadrics.push(Quadric::Plane {
            point: [0.0, 0.0, -0.8],
            normal: [0.2, 0.1, 1.0],
        });
    }
    geometry
}

/// A random convex region around a point: slanted half-spaces and a box that bounds it.
fn random_region(random: &mut Random) -> ([f64; 3], Vec<HalfSpace>) {
    let center = random.point(1.0).map(f64::from);
    let size = 0.05 + 0.3 * random.unit();
    let mut planes = cuboid(center.map(|x| x - size), center.map(|x| x + size));
    for _ in 0..3 {
        let [a, b, c] = random.point(1.0).map(f64::from);
        let d = a * center[0] + b * center[1] + c * center[2] + size * random.unit();
        planes.push([a, b, c, d]);
    }
    (center, planes)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn no_segment_inside_a_clear_region_is_blocked(seed in 0_u64..100_000) {
        let accelerator = Accelerator::build(&scene(seed)).unwrap();
        let mut random = Random::new(seed);
        for _ in 0..10 {
            let (center, planes) = random_region(&mut random);
            if !accelerator.region_is_clear(&planes, &|_| false) {
                continue;
            }
            let mut inside = Vec::new();
            while inside.len() < 20 {
                let offset = random.point(0.35);
                let point = [0, 1, 2].map(|k| (center[k] as f32) + offset[k]);
                if contains(&planes, point.map(f64::from)) {
                    inside.push(point);
                }
            }
            for pair in inside.windows(2) {
                let direction = [0, 1, 2].map(|k| pair[1][k] - pair[0][k]);
                // The rounded end may be outside by 2^-24 of the coordinates.
                let hit = accelerator.closest_brute_force(&Ray { origin: pair[0], direction, t_max: 0.999 });
                prop_assert_eq!(hit.primitive, steradian_kernel::MISS);
            }
        }
    }
}

#[test]
fn clear_regions_are_usually_recognised() {
    let (mut called_clear, mut really_clear) = (0, 0);
    for seed in 0..200 {
        let accelerator = Accelerator::build(&scene(seed)).unwrap();
        let mut random = Random::new(seed);
        let (center, planes) = random_region(&mut random);
        let clear = accelerator.region_is_clear(&planes, &|_| false);
        let mut met = false;
        for _ in 0..500 {
            let direction = random.point(1.0);
            let origin = [0, 1, 2].map(|k| (center[k] as f32) + 0.1 * random.point(1.0)[k]);
            let hit = accelerator.closest_brute_force(&Ray {
                origin,
                direction,
                t_max: 10.0,
            });
            let point = [0, 1, 2]
                .map(|k| f64::from(origin[k]) + f64::from(hit.t) * f64::from(direction[k]));
            met |= hit.primitive != steradian_kernel::MISS && contains(&planes, point);
        }
        called_clear += usize::from(clear);
        really_clear += usize::from(!met);
        assert!(!(clear && met));
    }
    assert!(
        called_clear >= 15 && 2 * called_clear > really_clear,
        "{called_clear} of {really_clear}"
    );
}
