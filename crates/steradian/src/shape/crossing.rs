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
    pub fn crossings(&self, ray: &Ray, mut tell: impl FnMut(Crossing)) {
        match self {
            Self::Parallelogram(form) => {
                let crossing = ray.through(form.origin, form.normal);
                tell_if(crossing, |at| form.covers(at), ray, tell);
            }
            Self::Disc(disc) => {
                let crossing = ray.through(disc.center, disc.normal);
                let radii = disc.inner_radius..=disc.radius;
                let covers = |at: Point| radii.contains(&(at - disc.center).length());
                tell_if(crossing, covers, ray, tell);
            }
            Self::Plane { point, normal } => {
                tell_if(ray.through(*point, *normal), |_| true, ray, tell);
            }
            Self::Sphere(sphere) => sphere.crossings(ray).for_each(tell),
            Self::Mesh(mesh) => mesh.crossings(ray).for_each(&mut tell),
        }
    }
}

impl Ray {
    fn at(&self, distance: f64) -> Point {
        self.origin + self.direction * distance
    }

    fn goes_to(&self, distance: f64) -> bool {
        (0.0..=self.reach).contains(&distance)
    }

    /// Where it passes through a plane; `None` if it is along it.
    fn through(&self, point: Point, normal: Direction) -> Option<Crossing> {
        let slope = self.direction.dot(normal);
        let distance = (point - self.origin).dot(normal.to_vector()) / slope;
        let from_front = slope < 0.0;
        (slope != 0.0 && self.goes_to(distance)).then_some(Crossing {
            distance,
            from_front,
        })
    }
}

fn tell_if(
    crossing: Option<Crossing>,
    covers: impl Fn(Point) -> bool,
    ray: &Ray,
    tell: impl FnMut(Crossing),
) {
    let is_within = |crossing: &Crossing| covers(ray.at(crossing.distance));
    crossing.filter(is_within).into_iter().for_each(tell);
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
        let crossing = move |distance: f64, enters: bool| {
            let outwards = Direction::new(ray.at(distance) - self.center).ok()?;
            let is_there = ray.goes_to(distance) && !self.in_port(outwards);
            is_there.then_some(Crossing {
                distance,
                from_front: enters != self.inside,
            })
        };
        let ends = [(along - half_chord, true), (along + half_chord, false)];
        ends.into_iter()
            .filter_map(move |(t, enters)| crossing(t, enters))
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
    let normal = (b - a).cross(c - a);
    let slope = d.dot(normal);
    let distance = a.dot(normal) / slope;
    (is_met && whole != 0.0 && ray.goes_to(distance)).then_some(Crossing {
        distance,
        from_front: slope < 0.0,
    })
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
