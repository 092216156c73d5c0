//! Input at the edge of what makes sense.

use crate::random;
use steradian_kernel::{
    Accelerator, BuildError, Cap, Geometry, Hit, HitBatch, InstructionSet, MISS, Quadric, Ray,
    RayBatch,
};

const UPWARDS: Ray = Ray {
    origin: [0.25, 0.25, -1.0],
    direction: [0.0, 0.0, 1.0],
    t_max: f32::INFINITY,
};

fn triangle(corners: [[f32; 3]; 3]) -> Geometry {
    Geometry {
        positions: corners.to_vec(),
        triangles: vec![[0, 1, 2]],
        quadrics: vec![],
    }
}

fn unit_triangle() -> Geometry {
    triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
}

/// By every way to ask, which must agree.
fn hit(geometry: &Geometry, ray: Ray) -> Hit {
    let accelerator = Accelerator::build(geometry).unwrap();
    let mut rays = RayBatch::default();
    rays.push(ray.origin, ray.direction, ray.t_max);
    let (mut hits, mut occluded) = (HitBatch::default(), Vec::new());
    let expected = accelerator.closest_brute_force(&ray);
    assert_eq!(accelerator.closest_scalar(&ray), expected);
    for set in InstructionSet::available() {
        accelerator.closest(&rays, &mut hits, set);
        accelerator.occluded(&rays, &mut occluded, set);
        assert_eq!(hits.hit(0), expected);
        assert_eq!(
            occluded[0],
            expected.t < ray.t_max && expected.primitive != MISS
        );
    }
    expected
}

#[test]
fn an_empty_scene_is_never_hit_and_always_clear() {
    assert_eq!(hit(&Geometry::default(), UPWARDS), Hit::NONE);
    let accelerator = Accelerator::build(&Geometry::default()).unwrap();
    assert!(accelerator.region_is_clear(&[], &|_| false));
    assert_eq!(
        (
            accelerator.bounds(),
            accelerator.triangle_count(),
            accelerator.memory_bytes()
        ),
        (None, 0, 0)
    );
}

#[test]
fn no_rays_give_no_hits() {
    let accelerator = Accelerator::build(&unit_triangle()).unwrap();
    let mut hits = HitBatch::default();
    hits.resize(3);
    accelerator.closest(&RayBatch::default(), &mut hits, InstructionSet::detect());
    assert!(hits.is_empty());
}

#[test]
fn bad_geometry_is_refused_by_name() {
    let build = |geometry: &Geometry| Accelerator::build(geometry).map(|_| ()).unwrap_err();
    for bad in [f32::NAN, f32::INFINITY] {
        let error = build(&triangle([[0.0; 3], [1.0, bad, 0.0], [0.0; 3]]));
        assert!(
            matches!(error, BuildError::NonFiniteVertex { vertex: 1, .. }),
            "{error}"
        );
    }
    let error = build(&triangle([[0.0; 3], [1.0; 3], [0.0, 3e8, 0.0]]));
    assert!(
        matches!(error, BuildError::VertexTooFar { vertex: 2, .. }),
        "{error}"
    );
    let mut geometry = unit_triangle();
    geometry.triangles.push([0, 1, 3]);
    assert_eq!(
        build(&geometry),
        BuildError::IndexOutOfRange {
            triangle: 1,
            vertex: 3,
            vertices: 3
        }
    );
}

#[test]
fn bad_quadrics_are_refused() {
    let (center, normal) = ([0.0; 3], [0.0, 0.0, 1.0]);
    let sphere = |radius| Quadric::Sphere {
        center,
        radius,
        ports: vec![],
    };
    let port = |direction, cos_half_angle| Quadric::Sphere {
        center,
        radius: 1.0,
        ports: vec![Cap {
            direction,
            cos_half_angle,
        }],
    };
    let ring = |radius, inner_radius| Quadric::Disc {
        center,
        normal,
        radius,
        inner_radius,
    };
    let bad = [
        sphere(0.0),
        sphere(-1.0),
        sphere(f64::NAN),
        sphere(f64::INFINITY),
        Quadric::Sphere {
            center: [f64::NAN, 0.0, 0.0],
            radius: 1.0,
            ports: vec![],
        },
        port([0.0, 0.0, 2.0], 0.5),
        port([0.0, 0.0, 1.0], 1.5),
        ring(0.0, 0.0),
        ring(1.0, 1.0),
        ring(1.0, -0.5),
        ring(1.0, f64::NAN),
        Quadric::Disc {
            center,
            normal: [0.0; 3],
            radius: 1.0,
            inner_radius: 0.0,
        },
        Quadric::Plane {
            point: center,
            normal: [0.0, f64::NAN, 0.0],
        },
        Quadric::Plane {
            point: [1e30, 0.0, 0.0],
            normal,
        },
    ];
    for quadric in bad {
        let geometry = Geometry {
            quadrics: vec![sphere(1.0), quadric.clone()],
            ..unit_triangle()
        };
        let error = Accelerator::build(&geometry).map(|_| ()).unwrap_err();
        assert!(
            matches!(error, BuildError::InvalidQuadric { quadric: 1, .. }),
            "{quadric:?}"
        );
    }
}

#[test]
fn invalid_rays_miss() {
    let directions = [
        [0.0; 3],
        [f32::NAN, 0.0, 1.0],
        [0.0, 0.0, f32::NAN],
        [0.0, 0.0, f32::INFINITY],
    ];
    for direction in directions {
        assert_eq!(
            hit(
                &unit_triangle(),
                Ray {
                    direction,
                    ..UPWARDS
                }
            ),
            Hit::NONE
        );
    }
    assert_eq!(
        hit(
            &unit_triangle(),
            Ray {
                origin: [f32::NAN, 0.25, -1.0],
                ..UPWARDS
            }
        ),
        Hit::NONE
    );
    for t_max in [f32::NAN, 0.0, -1.0, f32::NEG_INFINITY, 0.999] {
        assert_eq!(hit(&unit_triangle(), Ray { t_max, ..UPWARDS }), Hit::NONE);
    }
}

#[test]
fn the_last_t_belongs_to_closest_but_not_to_occluded() {
    let ray = Ray {
        t_max: 1.0,
        ..UPWARDS
    };
    assert_eq!(hit(&unit_triangle(), ray).t, 1.0);
    assert_eq!(
        hit(
            &unit_triangle(),
            Ray {
                origin: [0.25, 0.25, 0.0],
                ..UPWARDS
            }
        ),
        Hit::NONE
    );
}

#[test]
fn degenerate_triangles_are_never_hit() {
    let collinear = triangle([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.5, 0.5, 0.0]]);
    assert_eq!(hit(&collinear, UPWARDS), Hit::NONE);
    assert_eq!(hit(&triangle([[0.25, 0.25, 0.0]; 3]), UPWARDS), Hit::NONE);
    let mut mixed = unit_triangle();
    mixed.triangles = vec![[0, 0, 1], [1, 1, 1], [0, 1, 2], [2, 0, 2]];
    assert_eq!(
        hit(&mixed, UPWARDS),
        Hit {
            t: 1.0,
            u: 0.25,
            v: 0.25,
            primitive: 2
        }
    );
}

#[test]
fn a_ray_in_the_plane_of_a_triangle_misses() {
    for origin in [[-1.0, 0.25, 0.0], [0.25, -1.0, 0.0], [-1.0, 0.0, 0.0]] {
        for direction in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]] {
            assert_eq!(
                hit(
                    &unit_triangle(),
                    Ray {
                        origin,
                        direction,
                        t_max: f32::INFINITY
                    }
                ),
                Hit::NONE
            );
        }
    }
}

#[test]
fn axis_parallel_rays_hit_like_all_others() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for turn in 0..3 {
        let rotate = |p: [f32; 3]| -> [f32; 3] { std::array::from_fn(|k| p[(k + turn) % 3]) };
        let geometry = triangle(corners.map(rotate));
        for sign in [-1.0, 1.0] {
            let (origin, direction) = (
                rotate([0.25, 0.5, -2.0 * sign]),
                rotate([0.0, -0.0, 0.5 * sign]),
            );
            let found = hit(
                &geometry,
                Ray {
                    origin,
                    direction,
                    t_max: f32::INFINITY,
                },
            );
            assert_eq!(
                found,
                Hit {
                    t: 4.0,
                    u: 0.25,
                    v: 0.5,
                    primitive: 0
                }
            );
        }
    }
}

#[test]
fn the_first_of_equal_triangles_wins() {
    let mut geometry = unit_triangle();
    for copies in [2, 9, 40, 200] {
        geometry.triangles = vec![[0, 1, 2]; copies];
        assert_eq!(hit(&geometry, UPWARDS).primitive, 0);
        geometry.triangles[0] = [0, 0, 0];
        assert_eq!(hit(&geometry, UPWARDS).primitive, 1);
    }
}

#[test]
fn a_triangle_wins_over_a_quadric_at_the_same_place() {
    let plane = Quadric::Plane {
        point: [0.0; 3],
        normal: [0.0, 0.0, 1.0],
    };
    let disc = Quadric::Disc {
        center: [0.0; 3],
        normal: [0.0, 0.0, 1.0],
        radius: 3.0,
        inner_radius: 0.0,
    };
    for quadrics in [
        vec![plane.clone(), disc.clone()],
        vec![disc.clone(), plane.clone()],
        vec![disc; 9],
    ] {
        let geometry = Geometry {
            quadrics,
            ..unit_triangle()
        };
        assert_eq!(
            hit(&geometry, UPWARDS),
            Hit {
                t: 1.0,
                u: 0.25,
                v: 0.25,
                primitive: 0
            }
        );
        assert_eq!(
            hit(
                &geometry,
                Ray {
                    origin: [0.9, 0.9, -1.0],
                    ..UPWARDS
                }
            )
            .primitive,
            1
        );
    }
}

#[test]
fn a_deep_tree_does_not_overflow_the_stack() {
    let mut geometry = Geometry::default();
    for k in 0..900_u32 {
        let size = libm::exp2f(k as f32 / 20.0 - 30.0);
        geometry
            .positions
            .extend([[0.0, 0.0, size], [size, 0.0, size], [0.0, size, size]]);
        geometry.triangles.push([3 * k, 3 * k + 1, 3 * k + 2]);
    }
    let first = hit(
        &geometry,
        Ray {
            origin: [1e-12, 1e-12, 0.0],
            ..UPWARDS
        },
    );
    assert_eq!(first.primitive, 0);
    let accelerator = Accelerator::build(&geometry).unwrap();
    let rays = random::rays(500, 1.0, 3);
    let mut hits = HitBatch::default();
    accelerator.closest(&rays, &mut hits, InstructionSet::detect());
    for row in 0..rays.len() {
        assert_eq!(
            hits.hit(row),
            accelerator.closest_brute_force(&rays.ray(row))
        );
    }
}
