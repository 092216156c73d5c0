//! Where a ray passes through a form.

use super::{Form, Parallelogram, Sphere, TriangleMesh};
use crate::geometry::{Direction, Point, Vector};

/// A ray p + t d.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// p.
    pub origin: Point,
    /// d.
    pub direction: Direction,
    /// The greatest t in metres.
    pub reach: f64,
    /// So many metres before it, on the side that the ray comes from, a form is passed through.
    pub clearance: f64,
}

/// A point at which a ray passes through a form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// t in metres.
    pub distance: f64,
    /// Whether the ray comes from the front.
    pub from_front: bool,
}

impl Form {
    /// Tells each point at which a ray passes through, in no particular order.
    pub fn crossings(&self, ray: &Ray, tell: impl FnMut(Crossing)) {
        match self {
            Self::Parallelogram(form) => {
                let plane = (form.origin, form.normal);
                ray.through(plane, |at| form.covers(at)).for_each(tell);
            }
            Self::Disc(disc) => {
                let radii = disc.inner_radius..=disc.radius;
                let covers = |at: Point| radii.contains(&(at - disc.center).length());
                ray.through((disc.center, disc.normal), covers)
                    .for_each(tell);
            }
            Self::Plane { point, normal } => {
                ray.through((*point, *normal), |_| true).for_each(tell);
            }
            Self::Sphere(sphere) => sphere.crossings(ray).for_each(tell),
            Self::Mesh(mesh) => mesh.crossings(ray).for_each(tell),
        }
    }
}

impl Ray {
    fn at(&self, distance: f64) -> Point {
        self.origin + self.direction * distance
    }

    /// That of a surface at this distance, whose normal has this cosine with the direction.
    fn crossing(&self, distance: f64, cosine: f64) -> Option<Crossing> {
        let distance = distance - self.clearance / cosine.abs();
        (0.0..=self.reach).contains(&distance).then_some(Crossing {
            distance,
            from_front: cosine < 0.0,
        })
    }

    /// Where it passes through what covers a part of a plane.
    fn through(
        &self,
        (point, normal): (Point, Direction),
        covers: impl Fn(Point) -> bool,
    ) -> impl Iterator<Item = Crossing> {
        let cosine = self.direction.dot(normal);
        let distance = (point - self.origin).dot(normal.to_vector()) / cosine;
        let is_met = cosine != 0.0 && covers(self.at(distance));
        let crossing = self.crossing(distance, cosine);
        crossing.filter(|_| is_met).into_iter()
    }
}

impl Parallelogram {
    /// Whether a point of its plane belongs to it.
    fn covers(&self, point: Point) -> bool {
        let [a, b] = self.edges;
        let (normal, way) = (a.cross(b), point - self.origin);
        let whole = normal.dot(normal);
        let shares = [way.cross(b).dot(normal), a.cross(way).dot(normal)];
        shares.iter().all(|share| (0.0..=whole).contains(share))
    }
}

impl Sphere {
    /// |p + t d − c| = R.
    fn crossings(&self, ray: &Ray) -> impl Iterator<Item = Crossing> {
        let way = self.center - ray.origin;
        let along = way.dot(ray.direction.to_vector());
        let aside = way - ray.direction * along;
        let half_chord = (self.radius * self.radius - aside.dot(aside)).sqrt();
        let crossing = move |distance: f64| {
            let outwards = Direction::new(ray.at(distance) - self.center).ok()?;
            let facing = if self.inside { -outwards } else { outwards };
            let crossing = ray.crossing(distance, ray.direction.dot(facing));
            crossing.filter(|_| !self.in_port(outwards))
        };
        let ends = [along - half_chord, along + half_chord];
        ends.into_iter().filter_map(crossing)
    }
}

impl TriangleMesh {
    fn crossings(&self, ray: &Ray) -> impl Iterator<Item = Crossing> {
        (0..self.triangles.len()).filter_map(|number| triangle(self.corners(number), ray))
    }
}

/// By the volumes that the ray spans with the edges.
///
/// Source: T. Möller & B. Trumbore, *Fast, minimum storage ray/triangle intersection* (Journal of Graphics Tools 2, 1997).
fn triangle(corners: [Point; 3], ray: &Ray) -> Option<Crossing> {
    let [a, b, c] = corners.map(|corner| corner - ray.origin);
    let d = ray.direction.to_vector();
    let volume = |p: Vector, q: Vector| d.dot(q.cross(p));
    let shares = [volume(b, c), volume(c, a), volume(a, b)];
    let whole: f64 = shares.iter().sum();
    let is_met = shares.iter().all(|share| share * whole >= 0.0);
    let normal = Direction::new((b - a).cross(c - a)).ok()?;
    let cosine = ray.direction.dot(normal);
    let distance = a.dot(normal.to_vector()) / cosine;
    let crossing = ray.crossing(distance, cosine);
    crossing.filter(|_| is_met && whole != 0.0)
}

#[cfg(test)]
mod tests {
    use super::super::{Disc, SpherePort};
    use super::*;

    const Z: Direction = Direction::Z;

    fn direction(x: f64, y: f64, z: f64) -> Direction {
        Direction::new(Vector::new(x, y, z)).unwrap()
    }

    /// Down along z from (x, y, 3).
    fn found(form: &Form, [x, y]: [f64; 2], reach: f64) -> Vec<(f64, bool)> {
        let ray = Ray {
            origin: Point::new(x, y, 3.0),
            direction: -Z,
            reach,
            clearance: 0.0,
        };
        let mut found = vec![];
        form.crossings(&ray, |crossing| {
            found.push((crossing.distance, crossing.from_front));
        });
        found
    }

    #[test]
    fn a_parallelogram_is_met_between_its_edges() {
        let edges = [Vector::new(2.0, 0.0, 0.0), Vector::new(1.0, 1.0, 0.0)];
        let form = Form::Parallelogram(Parallelogram::new(Point::ORIGIN, edges).unwrap());
        assert_eq!(found(&form, [1.5, 0.5], 9.0), [(3.0, true)]);
        assert_eq!(found(&form, [1.5, 0.5], 2.9), []);
        assert_eq!(found(&form, [0.4, 0.5], 9.0), []);
        assert_eq!(found(&form, [2.6, 0.5], 9.0), []);
        assert_eq!(found(&form, [1.5, 1.1], 9.0), []);
    }

    #[test]
    fn a_ring_is_met_between_its_radii() {
        let form = Form::Disc(Disc {
            center: Point::ORIGIN,
            normal: -Z,
            radius: 2.0,
            inner_radius: 1.0,
        });
        assert_eq!(found(&form, [1.5, 0.0], 9.0), [(3.0, false)]);
        assert_eq!(found(&form, [0.5, 0.0], 9.0), []);
        assert_eq!(found(&form, [1.5, 1.5], 9.0), []);
    }

    #[test]
    fn a_sphere_is_met_twice_but_in_ports() {
        let port = SpherePort {
            direction: Z,
            cos_half_angle: 0.9,
        };
        let sphere = |inside, ports| {
            Form::Sphere(Sphere {
                center: Point::ORIGIN,
                radius: 1.0,
                inside,
                ports,
            })
        };
        let both = [(2.0, true), (4.0, false)];
        assert_eq!(found(&sphere(false, vec![]), [0.0, 0.0], 9.0), both);
        assert_eq!(found(&sphere(false, vec![]), [0.0, 0.0], 3.0), both[..1]);
        assert_eq!(
            found(&sphere(true, vec![port]), [0.0, 0.0], 9.0),
            [(4.0, true)]
        );
        assert_eq!(found(&sphere(false, vec![]), [1.1, 0.0], 9.0), []);
    }

    /// What ends on a plane, or begins there, has passed through it on the way there, and not on the way back.
    #[test]
    fn a_surface_is_passed_before_it_is_reached() {
        let plane = Form::Plane {
            point: Point::ORIGIN,
            normal: Z,
        };
        let along = |direction: Direction, height: f64, reach: f64| {
            let ray = Ray {
                origin: Point::new(0.0, 0.0, height),
                direction,
                reach,
                clearance: 1e-3,
            };
            let mut found = vec![];
            plane.crossings(&ray, |crossing| found.push(crossing.from_front));
            found
        };
        for error in [-1e-6, 0.0, 1e-6] {
            let slanting = direction(0.8, 0.0, -0.6);
            assert_eq!(along(slanting, 0.6, 1.0 + error), [true]);
            assert!(along(direction(0.8, 0.0, 0.6), error, 1.0).is_empty());
            assert!(along(slanting, error, 1.0).is_empty());
            assert_eq!(along(direction(0.8, 0.0, 0.6), -0.6, 1.0 + error), [false]);
        }
        assert!(along(direction(1.0, 0.0, 0.0), 0.5, 9.0).is_empty());
    }

    /// A square of two triangles is met once, and from where the parallelogram of the same corners is met.
    #[test]
    fn a_mesh_is_met_like_the_parallelogram_that_it_fills() {
        let edges = [Vector::new(2.0, 0.3, 0.1), Vector::new(-0.4, 1.0, 0.5)];
        let plain = Parallelogram::new(Point::ORIGIN, edges).unwrap();
        let corners = plain.corners().to_vec();
        let mesh = TriangleMesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]);
        let (plain, mesh) = (Form::Parallelogram(plain), Form::Mesh(mesh));
        let mut met = 0;
        for step in 0..400 {
            let (column, row) = (f64::from(step % 20), f64::from(step / 20));
            let ray = Ray {
                origin: Point::new(0.15 * column - 0.7, 0.11 * row - 0.4, 3.0),
                direction: direction(0.1, -0.05, -1.0),
                reach: 9.0,
                clearance: 0.0,
            };
            let mut both = [vec![], vec![]];
            for (form, found) in [&plain, &mesh].into_iter().zip(&mut both) {
                form.crossings(&ray, |crossing| found.push(crossing));
            }
            let [expected, found] = both;
            assert_eq!(expected.len(), found.len());
            for (a, b) in expected.iter().zip(&found) {
                assert!((a.distance - b.distance).abs() < 1e-12 && a.from_front == b.from_front);
            }
            met += found.len();
        }
        assert!(met > 50, "{met}");
    }
}
