//! Solids: boxes and closed meshes.
//!
//! A closed mesh covers each direction as often as its triangles lie one behind the other, so the solid angles of its
//! triangles do not simply add up. Three sums mean something:
//!
//! | sum over the triangles | what it is |
//! |---|---|
//! | Σ ωᵢ, each positive if its back shows | 4π times the winding number: 4π inside, 0 outside |
//! | ½ (Σ \|ωᵢ\| + \|Σ ωᵢ\|) | the solid angle of a convex mesh from anywhere: each direction that meets it from outside is met twice |
//! | the same of any closed mesh | an upper bound of the solid angle it fills |
//!
//! The first is the sum of Van Oosterom & Strackee 1983; that it counts windings is Gauss's law. What a mesh that is not convex
//! fills has no such sum and is estimated with rays.

use std::f64::consts::PI;

use super::super::bounds::Bounds;
use super::super::point::Point;
use super::polygon::signed;
use crate::quantity::SolidAngle;

/// The solid angle of an axis-aligned box: the sum over the faces turned to the observer.
///
/// From inside it is 4π; on a face 2π, on an edge π, in a corner π/2: the part of all directions that leads inside. An empty
/// box fills nothing, and a flat one what its rectangle fills.
///
/// ```
/// use steradian::geometry::{Bounds, Point, solid_angle};
/// // A unit cube seen from 1 m before its face of area 1: the pyramid over the half side ½ and the height 1.
/// let cube = Bounds::around([Point::new(1.0, -0.5, -0.5), Point::new(2.0, 0.5, 0.5)]);
/// let found = solid_angle::of_box(Point::ORIGIN, &cube).to_steradians();
/// assert!((found - 4.0 * 0.2_f64.asin()).abs() < 1e-15);
/// ```
pub fn of_box(observer: Point, bounds: &Bounds) -> SolidAngle {
    let (eye, min, max) = (
        observer.to_array(),
        bounds.min().to_array(),
        bounds.max().to_array(),
    );
    if bounds.is_empty() {
        return SolidAngle::ZERO;
    }
    let is_solid = (0..3).all(|axis| min[axis] < max[axis]);
    if is_solid && bounds.contains(observer) {
        let on = (0..3).filter(|&axis| eye[axis] == min[axis] || eye[axis] == max[axis]);
        return SolidAngle::SPHERE * on.fold(1.0, |part, _| part / 2.0);
    }
    let turned_to_observer = (0..3).filter_map(|axis| {
        let level = if eye[axis] < min[axis] {
            min[axis]
        } else {
            max[axis]
        };
        (eye[axis] < min[axis] || eye[axis] > max[axis]).then(|| face(&min, &max, axis, level))
    });
    turned_to_observer
        .map(|face| super::of_polygon(observer, &face))
        .sum()
}

/// The rectangle of a box across an axis at this level.
fn face(min: &[f64; 3], max: &[f64; 3], axis: usize, level: f64) -> [Point; 4] {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    [[min, min], [max, min], [max, max], [min, max]].map(|[at_u, at_v]| {
        let mut corner = [level; 3];
        (corner[u], corner[v]) = (at_u[u], at_v[v]);
        corner.into()
    })
}

/// How often a closed mesh goes around the observer: 1 inside one whose triangles run counter-clockwise seen from outside, 0
/// outside, ½ on a face. Of an open mesh it is the signed solid angle over 4π.
pub fn winding_number(observer: Point, triangles: impl IntoIterator<Item = [Point; 3]>) -> f64 {
    let sum: f64 = triangles
        .into_iter()
        .map(|corners| signed(observer, corners))
        .sum();
    sum / (4.0 * PI)
}

/// ½ (Σ |ωᵢ| + |Σ ωᵢ|): the solid angle of a closed convex mesh from anywhere, 4π inside; for other closed meshes an
/// upper bound of it. The triangles must all run the same way round.
///
/// ```
/// use steradian::geometry::{Point, solid_angle};
/// use steradian::quantity::SolidAngle;
/// let [o, x, y, z] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Point::from);
/// let tetrahedron = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
/// let from = |x: f64| solid_angle::of_convex_mesh(Point::new(x, x, x), tetrahedron);
/// assert!((from(0.1) / SolidAngle::SPHERE - 1.0).abs() < 1e-15);
/// assert!((from(-1e9).to_steradians() / (0.5 / 3e18 * 3.0_f64.sqrt()) - 1.0).abs() < 1e-8); // its shadow is √3/2 m²
/// ```
pub fn of_convex_mesh(
    observer: Point,
    triangles: impl IntoIterator<Item = [Point; 3]>,
) -> SolidAngle {
    let parts = triangles
        .into_iter()
        .map(|corners| signed(observer, corners));
    let (sum, magnitudes) = parts.fold((0.0, 0.0), |(sum, all), part| {
        (sum + part, all + part.abs())
    });
    SolidAngle::from_steradians((magnitudes + f64::abs(sum)) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::{any_vector, close};
    use proptest::prelude::*;

    fn cube() -> Bounds {
        Bounds::around([Point::new(-1.0, -1.0, -1.0), Point::new(1.0, 1.0, 1.0)])
    }

    /// Two triangles a face, counter-clockwise seen from outside.
    fn triangles(bounds: &Bounds) -> Vec<[Point; 3]> {
        let (min, max) = (bounds.min().to_array(), bounds.max().to_array());
        let mut all = Vec::new();
        for axis in 0..3 {
            let [a, b, c, d] = face(&min, &max, axis, max[axis]);
            all.extend([[a, b, c], [a, c, d]]);
            let [a, b, c, d] = face(&min, &max, axis, min[axis]);
            all.extend([[a, c, b], [a, d, c]]);
        }
        all
    }

    #[test]
    fn a_box_from_inside_and_on_its_surface() {
        let part = |x, y, z| of_box(Point::new(x, y, z), &cube()) / SolidAngle::SPHERE;
        assert_eq!([part(0.0, 0.0, 0.0), part(0.999, 0.0, 0.0)], [1.0; 2]);
        assert_eq!(
            [
                part(1.0, 0.0, 0.0),
                part(1.0, 0.3, -1.0),
                part(1.0, 1.0, -1.0)
            ],
            [0.5, 0.25, 0.125]
        );
        assert!(close(part(1.0 + 1e-9, 0.3, 0.1), 0.5, 1e-8));
        assert_eq!(of_box(Point::ORIGIN, &Bounds::EMPTY), SolidAngle::ZERO);
    }

    #[test]
    fn a_flat_box_is_its_rectangle() {
        let flat = Bounds::around([Point::new(-1.0, -1.0, 1.0), Point::new(1.0, 1.0, 1.0)]);
        assert!(close(
            of_box(Point::ORIGIN, &flat) / SolidAngle::SPHERE,
            1.0 / 6.0,
            1e-15
        ));
        assert_eq!(of_box(Point::new(0.0, 0.0, 1.0), &flat), SolidAngle::ZERO);
    }

    #[test]
    fn windings_add_up() {
        let twice = [triangles(&cube()), triangles(&cube())].concat();
        assert!(close(
            winding_number(Point::ORIGIN, twice.clone()),
            2.0,
            1e-15
        ));
        let reversed = twice.iter().map(|&[a, b, c]| [a, c, b]);
        assert!(close(winding_number(Point::ORIGIN, reversed), -2.0, 1e-15));
        assert!(close(
            winding_number(Point::new(1.0, 0.2, 0.0), triangles(&cube())),
            0.5,
            1e-15
        ));
    }

    #[test]
    fn a_mesh_that_is_not_convex_fills_less_than_the_bound() {
        // Two cubes one behind the other: the farther one is hidden.
        let far = Bounds::around([Point::new(2.0, -0.5, -0.5), Point::new(3.0, 0.5, 0.5)]);
        let eye = Point::new(-3.0, 0.0, 0.0);
        let both = of_convex_mesh(eye, [triangles(&cube()), triangles(&far)].concat());
        assert!(close(
            both / (of_box(eye, &cube()) + of_box(eye, &far)),
            1.0,
            1e-14
        ));
    }

    proptest! {
        #[test]
        fn a_box_is_a_convex_mesh(eye in any_vector(3.0)) {
            let eye = Point::ORIGIN + eye;
            let mesh = of_convex_mesh(eye, triangles(&cube()));
            prop_assert!(close(of_box(eye, &cube()).to_steradians(), mesh.to_steradians(), 1e-13));
            let inside = cube().contains(eye);
            prop_assert!(close(winding_number(eye, triangles(&cube())), f64::from(u8::from(inside)), 1e-13));
        }

        #[test]
        fn parts_of_a_box_fill_what_it_fills_if_none_hides_another(y in -5.0..5.0_f64, cut in -0.9..0.9_f64) {
            // Seen from the plane of the cut, both parts lie side by side.
            let eye = Point::new(-4.0, y, cut);
            let [lower, upper] = [[-1.0, cut], [cut, 1.0]]
                .map(|[from, to]| Bounds::around([Point::new(-1.0, -1.0, from), Point::new(1.0, 1.0, to)]));
            let parts = of_box(eye, &lower) + of_box(eye, &upper);
            prop_assert!(close(parts / of_box(eye, &cube()), 1.0, 1e-13));
        }
    }
}
