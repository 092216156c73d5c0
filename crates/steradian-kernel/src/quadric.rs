//! Intersection of rays with quadrics, in `f64`.

use crate::batch::Ray;
use crate::geometry::{Cap, Quadric};
use crate::node::Bounds;

type Vector = [f64; 3];

impl Quadric {
    /// The first `t` with `0 < t ≤ t_max` after rounding to `f32`.
    pub(crate) fn intersect(&self, ray: &Ray, t_max: f32) -> Option<f32> {
        let (origin, direction) = (ray.origin.map(f64::from), ray.direction.map(f64::from));
        let on_ray = |t: f64| {
            let rounded = t as f32;
            (rounded > 0.0 && rounded <= t_max).then_some(rounded)
        };
        match self {
            Self::Sphere {
                center,
                radius,
                ports,
            } => {
                let from_center = subtract(origin, *center);
                let roots = sphere_roots(from_center, direction, *radius)?;
                let solid = |t: f64| !in_port(ports, along(from_center, direction, t), *radius);
                roots.into_iter().filter(|&t| solid(t)).find_map(on_ray)
            }
            Self::Disc {
                center,
                normal,
                radius,
                inner_radius,
            } => {
                let t = plane_root(subtract(origin, *center), direction, *normal)?;
                let from_center = subtract(along(origin, direction, t), *center);
                let square = dot(from_center, from_center);
                (inner_radius * inner_radius..=radius * radius)
                    .contains(&square)
                    .then_some(t)
                    .and_then(on_ray)
            }
            Self::Plane { point, normal } => {
                plane_root(subtract(origin, *point), direction, *normal).and_then(on_ray)
            }
        }
    }

    /// A box around it, rounded outwards; nothing if it is unbounded.
    pub(crate) fn bounds(&self) -> Option<Bounds> {
        let (center, extent) = match self {
            Self::Sphere { center, radius, .. } => (center, [*radius; 3]),
            Self::Disc {
                center,
                normal,
                radius,
                ..
            } => (center, disc_extent(*normal, *radius)),
            Self::Plane { .. } => return None,
        };
        Some(Bounds {
            lower: [0, 1, 2].map(|k| ((center[k] - extent[k]) as f32).next_down()),
            upper: [0, 1, 2].map(|k| ((center[k] + extent[k]) as f32).next_up()),
        })
    }

    /// Whether all of it is certainly in `normal · x > offset`; the whole sphere or disc is meant, holes or not.
    pub(crate) fn is_beyond(&self, normal: Vector, offset: f64) -> bool {
        let (center, support) = match self {
            Self::Sphere { center, radius, .. } => (center, radius * dot(normal, normal).sqrt()),
            Self::Disc {
                center,
                normal: axis,
                radius,
                ..
            } => (center, radius * rejection(normal, *axis)),
            Self::Plane { .. } => return false,
        };
        let size = [0, 1, 2]
            .iter()
            .map(|&k| (normal[k] * center[k]).abs())
            .sum::<f64>()
            + support;
        dot(normal, *center) - support > offset + 1e-12 * (size + offset.abs())
    }
}

/// How far the disc reaches along each axis.
fn disc_extent(normal: Vector, radius: f64) -> Vector {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    axes.map(|axis| radius * (1.0 + 1e-12) * rejection(axis, normal))
}

/// Length of the part of `vector` that is perpendicular to `axis`.
fn rejection(vector: Vector, axis: Vector) -> f64 {
    let cross = [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        vector[i] * axis[j] - vector[j] * axis[i]
    });
    (dot(cross, cross) / dot(axis, axis)).sqrt()
}

/// The two crossings of a line with a sphere around 0, the smaller first.
///
/// The discriminant is taken from the distance vector between centre and line, which does not cancel for small or distant
/// spheres: E. Haines, J. Günther, T. Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing
/// Gems, 2019, chapter 7.
fn sphere_roots(origin: Vector, direction: Vector, radius: f64) -> Option<[f64; 2]> {
    let a = dot(direction, direction);
    let b = -dot(origin, direction);
    let from_line = along(origin, direction, b / a);
    let discriminant = radius * radius - dot(from_line, from_line);
    if discriminant < 0.0 {
        return None;
    }
    let distance = dot(origin, origin).sqrt();
    let c = (distance - radius) * (distance + radius);
    let q = b + (a * discriminant).sqrt().copysign(b);
    let (near, far) = if q == 0.0 { (0.0, 0.0) } else { (c / q, q / a) };
    Some([near.min(far), near.max(far)])
}

fn in_port(ports: &[Cap], from_center: Vector, radius: f64) -> bool {
    ports
        .iter()
        .any(|cap| dot(from_center, cap.direction) > cap.cos_half_angle * radius)
}

/// Where the line meets the plane through 0; nothing if it is parallel.
fn plane_root(origin: Vector, direction: Vector, normal: Vector) -> Option<f64> {
    let speed = dot(direction, normal);
    (speed != 0.0).then(|| -dot(origin, normal) / speed)
}

fn along(origin: Vector, direction: Vector, t: f64) -> Vector {
    [0, 1, 2].map(|k| origin[k] + t * direction[k])
}

fn subtract(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use crate::batch::Ray;
    use crate::geometry::{Cap, Quadric};

    fn ray(origin: [f32; 3], direction: [f32; 3]) -> Ray {
        Ray {
            origin,
            direction,
            t_max: f32::INFINITY,
        }
    }

    fn first(quadric: &Quadric, origin: [f32; 3], direction: [f32; 3]) -> Option<f32> {
        quadric.intersect(&ray(origin, direction), f32::MAX)
    }

    fn unit_sphere(ports: Vec<Cap>) -> Quadric {
        Quadric::Sphere {
            center: [0.0; 3],
            radius: 1.0,
            ports,
        }
    }

    #[test]
    fn a_sphere_is_met_from_outside_and_from_inside() {
        let sphere = unit_sphere(vec![]);
        assert_eq!(first(&sphere, [0.0, 0.0, -3.0], [0.0, 0.0, 0.5]), Some(4.0));
        assert_eq!(first(&sphere, [0.0, 0.0, 0.5], [0.0, 0.0, 1.0]), Some(0.5));
        assert_eq!(first(&sphere, [0.0, 0.0, 0.0], [0.0, 2.0, 0.0]), Some(0.5));
        assert_eq!(first(&sphere, [0.0, 0.0, 3.0], [0.0, 0.0, 1.0]), None);
        assert_eq!(first(&sphere, [0.0, 1.1, -3.0], [0.0, 0.0, 1.0]), None);
    }

    #[test]
    fn a_port_lets_rays_in_to_the_far_wall() {
        let port = Cap {
            direction: [0.0, 0.0, -1.0],
            cos_half_angle: 0.8,
        };
        let sphere = unit_sphere(vec![port]);
        assert_eq!(first(&sphere, [0.0, 0.0, -3.0], [0.0, 0.0, 1.0]), Some(4.0));
        assert_eq!(first(&sphere, [0.0, 0.0, 0.0], [0.0, 0.0, -1.0]), None);
        // The rim is at sin θ = 0.6.
        assert_eq!(
            first(&sphere, [0.59, 0.0, -3.0], [0.0, 0.0, 1.0]).map(|t| t > 3.0),
            Some(true)
        );
        assert_eq!(
            first(&sphere, [0.61, 0.0, -3.0], [0.0, 0.0, 1.0]).map(|t| t < 3.0),
            Some(true)
        );
    }

    #[test]
    fn a_distant_small_sphere_keeps_its_digits() {
        let sphere = Quadric::Sphere {
            center: [0.0, 0.0, 1e6],
            radius: 1e-3,
            ports: vec![],
        };
        let t = first(&sphere, [0.0, 9e-4, 0.0], [0.0, 0.0, 1.0]);
        let exact = 1e6 - (1e-6_f64 - f64::from(9e-4_f32).powi(2)).sqrt();
        assert_eq!(t, Some(exact as f32));
        assert_eq!(first(&sphere, [0.0, 1.1e-3, 0.0], [0.0, 0.0, 1.0]), None);
    }

    #[test]
    fn a_ring_has_a_hole() {
        let normal = [0.0, 0.0, -7.0];
        let ring = Quadric::Disc {
            center: [0.0, 0.0, 2.0],
            normal,
            radius: 1.0,
            inner_radius: 0.5,
        };
        let hit = |x: f32| first(&ring, [x, 0.0, 0.0], [0.0, 0.0, 1.0]);
        assert_eq!(
            [0.0, 0.49, 0.5, 0.7, 1.0, 1.01].map(hit),
            [None, None, Some(2.0), Some(2.0), Some(2.0), None]
        );
        assert_eq!(first(&ring, [-2.0, 0.0, 2.0], [1.0, 0.0, 0.0]), None);
    }

    #[test]
    fn a_plane_is_met_from_both_sides_only_ahead() {
        let plane = Quadric::Plane {
            point: [5.0, 5.0, 1.0],
            normal: [0.0, 0.0, 2.0],
        };
        assert_eq!(first(&plane, [0.0, 0.0, 0.0], [3.0, 0.0, 1.0]), Some(1.0));
        assert_eq!(first(&plane, [0.0, 0.0, 2.0], [0.0, 0.0, -0.25]), Some(4.0));
        assert_eq!(first(&plane, [0.0, 0.0, 2.0], [0.0, 0.0, 1.0]), None);
        assert_eq!(first(&plane, [0.0, 0.0, 2.0], [1.0, 0.0, 0.0]), None);
    }

    #[test]
    fn bounds_hold_the_disc_tightly() {
        let disc = Quadric::Disc {
            center: [1.0, 2.0, 3.0],
            normal: [1.0, 0.0, 0.0],
            radius: 2.0,
            inner_radius: 0.0,
        };
        let bounds = disc.bounds().unwrap();
        assert!(bounds.lower[0] < 1.0 && bounds.lower[0] > 1.0 - 1e-6);
        assert!(bounds.upper[1] > 4.0 && bounds.upper[1] < 4.0 + 1e-6);
    }
}
