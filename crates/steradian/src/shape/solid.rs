//! Solids: forms that enclose a volume with their front outside, and what lies within.
//!
//! The winding number of a closed mesh around a point x,
//!
//! w(x) = (1/4π) Σ ωₖ(x)
//!
//! is 1 inside and 0 outside, with ωₖ the signed solid angle of triangle k.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | w | winding number | 1 |
//! | ωₖ | solid angle of a triangle, positive if x sees its back | sr |
//!
//! Sources: A. Van Oosterom & J. Strackee, IEEE Trans. Biomed. Eng. 30 (2), 1983, eq. 8 (a triangle); A. Jacobson, L. Kavan &
//! O. Sorkine-Hornung, SIGGRAPH 2013, eq. 6 (their sum).

use std::f64::consts::PI;

use crate::geometry::{Point, Vector};

use super::{Form, Sphere, TriangleMesh};

/// The outer surface of a solid.
#[derive(Copy, Clone, Debug)]
pub enum Solid<'a> {
    /// A sphere without ports.
    Ball(&'a Sphere),
    /// A closed mesh.
    Mesh(&'a TriangleMesh),
}

impl<'a> Solid<'a> {
    /// The solid of which this is the outer surface; `None` for an open form and for one that faces inwards.
    pub fn of(form: &'a Form) -> Option<Self> {
        match form {
            Form::Sphere(sphere) => {
                (!sphere.inside && sphere.ports.is_empty()).then_some(Self::Ball(sphere))
            }
            Form::Mesh(mesh) => {
                (mesh.signed_volume() > 0.0 && mesh.is_closed()).then_some(Self::Mesh(mesh))
            }
            Form::Parallelogram(_) | Form::Disc(_) | Form::Plane { .. } => None,
        }
    }

    /// Whether `point` lies within, at least `margin` metres below the surface.
    pub fn encloses(&self, point: Point, margin: f64) -> bool {
        match self {
            Self::Ball(sphere) => (point - sphere.center).length() < sphere.radius - margin,
            Self::Mesh(mesh) => {
                let around = octahedron(margin).into_iter();
                std::iter::once(Vector::ZERO)
                    .chain(around)
                    .all(|step| winding_number(mesh, point + step) > 0.9)
            }
        }
    }
}

/// Corners of the octahedron around the ball of this radius.
pub(super) fn octahedron(radius: f64) -> [Vector; 6] {
    let reach = radius * 3.0_f64.sqrt();
    let axes = [
        Vector::new(reach, 0.0, 0.0),
        Vector::new(0.0, reach, 0.0),
        Vector::new(0.0, 0.0, reach),
    ];
    let [x, y, z] = axes;
    [x, -x, y, -y, z, -z]
}

/// w(x).
pub(super) fn winding_number(mesh: &TriangleMesh, point: Point) -> f64 {
    let solid_angles = (0..mesh.triangles.len()).map(|index| {
        let [a, b, c] = mesh.corners(index).map(|corner| corner - point);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let triple = a.dot(b.cross(c));
        let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * libm::atan2(triple, denominator)
    });
    solid_angles.sum::<f64>() / (4.0 * PI)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Bounds, Direction};
    use crate::shape::SpherePort;

    /// The unit cube; with `inside` it faces inwards.
    fn cube(inside: bool) -> Form {
        let corners = Bounds::around([Point::ORIGIN, Point::new(1.0, 1.0, 1.0)]).corners();
        let faces = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        let halves = faces
            .into_iter()
            .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
        let turned = halves.map(|[a, b, c]| if inside { [a, c, b] } else { [a, b, c] });
        Form::Mesh(TriangleMesh::new(corners.to_vec(), turned.collect()))
    }

    fn sphere(inside: bool, ports: Vec<SpherePort>) -> Form {
        Form::Sphere(Sphere {
            center: Point::ORIGIN,
            radius: 1.0,
            inside,
            ports,
        })
    }

    #[test]
    fn a_cube_encloses_what_lies_deeper_than_the_margin() {
        let cube = cube(false);
        let solid = Solid::of(&cube).unwrap();
        let at = |z| Point::new(0.3, 0.4, z);
        for (z, enclosed) in [
            (0.5, true),
            (0.99, true),
            (1.0, false),
            (1.01, false),
            (-3.0, false),
        ] {
            assert_eq!(solid.encloses(at(z), 1e-3), enclosed, "{z}");
        }
        assert!(!solid.encloses(at(1.0 - 1e-9), 1e-6));
        assert!(solid.encloses(at(1.0 - 1e-5), 1e-6));
    }

    #[test]
    fn a_ball_encloses_what_lies_deeper_than_the_margin() {
        let ball = sphere(false, vec![]);
        let solid = Solid::of(&ball).unwrap();
        let at = |x| Point::new(x, 0.0, 0.0);
        assert!(solid.encloses(at(0.98), 0.01) && !solid.encloses(at(0.995), 0.01));
        assert!(!solid.encloses(at(1.5), 0.01));
    }

    #[test]
    fn rooms_and_open_forms_are_no_solids() {
        let port = SpherePort {
            direction: Direction::Z,
            cos_half_angle: 0.9,
        };
        let plane = Form::Plane {
            point: Point::ORIGIN,
            normal: Direction::Z,
        };
        let mut open = cube(false);
        if let Form::Mesh(mesh) = &mut open {
            mesh.triangles.pop();
        }
        for form in [
            cube(true),
            sphere(true, vec![]),
            sphere(false, vec![port]),
            plane,
            open,
        ] {
            assert!(Solid::of(&form).is_none(), "{form:?}");
        }
    }
}
