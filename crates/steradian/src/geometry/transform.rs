//! Affine transforms: translation, rotation, scaling, and what they do to points, vectors and normals.
//!
//! A transform maps a point to x′ = M x + t, a vector to v′ = M v, and the normal of a surface to
//! n′ ∝ M⁻ᵀ n, so that the image of the front side is again the front side. Transforms are put together in the
//! order in which they are applied: `a.then(b)` does a first. One that mirrors (det M < 0) turns the order of a
//! polygon's vertices round: counter-clockwise becomes clockwise as seen from the front.
//!
//! ```
//! use steradian::geometry::{Direction, Point, Transform, Vector};
//! use steradian::quantity::Angle;
//! let quarter_turn = Transform::rotate(Direction::Z, Angle::from_degrees(90.0), Point::new(1.0, 0.0, 0.0));
//! let moved = quarter_turn.then(Transform::translate(Vector::new(0.0, 0.0, 5.0)));
//! let image = moved.point(Point::new(2.0, 0.0, 0.0)); // one east of the pivot → one north of it
//! assert!(image.distance(Point::new(1.0, 1.0, 5.0)).to_metres() < 1e-15);
//! ```

use super::direction::{Direction, NoDirection};
use super::point::{Point, Vector};
use crate::quantity::Angle;

/// An affine transform of space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// The images of the three axes: the columns of M.
    columns: [Vector; 3],
    translation: Vector,
}

impl Transform {
    /// Leaves everything where it is.
    pub const IDENTITY: Self = Self::scale(1.0);

    /// Takes the three axes to these vectors: the columns of M.
    pub const fn from_axes(images: [Vector; 3]) -> Self {
        Self {
            columns: images,
            translation: Vector::ZERO,
        }
    }

    /// Moves by `step`.
    pub const fn translate(step: Vector) -> Self {
        Self {
            translation: step,
            ..Self::IDENTITY
        }
    }

    /// Turns by `angle` around the line through `about` along `axis`, counter-clockwise as seen against the axis.
    ///
    /// By Rodrigues' formula, v′ = v cosα + (a × v) sinα + a (a·v)(1 − cosα), with 1 − cosα = 2 sin²½α.
    pub fn rotate(axis: Direction, angle: Angle, about: Point) -> Self {
        let (sin, cos) = libm::sincos(angle.to_radians());
        let half = libm::sin(angle.to_radians() / 2.0);
        let versine = 2.0 * half * half;
        let turn = |v: Direction| v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * versine);
        let turned = Self {
            columns: [turn(Direction::X), turn(Direction::Y), turn(Direction::Z)],
            translation: Vector::ZERO,
        };
        turned.keeping(about)
    }

    /// Enlarges by `factor` from the origin. A negative factor mirrors; 0 has no inverse.
    pub const fn scale(factor: f64) -> Self {
        Self::scale_axes([factor; 3])
    }

    /// Stretches each axis by its own factor from the origin.
    pub const fn scale_axes([x, y, z]: [f64; 3]) -> Self {
        Self {
            columns: [
                Vector::new(x, 0.0, 0.0),
                Vector::new(0.0, y, 0.0),
                Vector::new(0.0, 0.0, z),
            ],
            translation: Vector::ZERO,
        }
    }

    /// The same M with the translation that leaves `point` in place.
    fn keeping(self, point: Point) -> Self {
        Self {
            translation: point.to_vector() - self.vector(point.to_vector()),
            ..self
        }
    }

    /// This transform, then `next`.
    pub fn then(self, next: Self) -> Self {
        Self {
            columns: self.columns.map(|column| next.vector(column)),
            translation: next.vector(self.translation) + next.translation,
        }
    }

    /// The image of a point, M x + t.
    #[inline]
    pub fn point(&self, point: Point) -> Point {
        Point::ORIGIN + (self.vector(point.to_vector()) + self.translation)
    }

    /// The image of a vector, M v.
    #[inline]
    pub fn vector(&self, vector: Vector) -> Vector {
        let [x, y, z] = self.columns;
        x * vector.x + y * vector.y + z * vector.z
    }

    /// The direction of the image of a vector along `direction`.
    ///
    /// # Errors
    /// If the transform flattens it to nothing, or is not finite.
    pub fn direction(&self, direction: Direction) -> Result<Direction, NoDirection> {
        Direction::new(self.vector(direction.into()))
    }

    /// The normal of the image of a surface with this normal, on the image of the same side.
    ///
    /// # Errors
    /// If the transform flattens that surface, or is not finite.
    pub fn normal(&self, normal: Direction) -> Result<Direction, NoDirection> {
        let [x, y, z] = self.cofactors();
        let side = 1.0_f64.copysign(self.determinant());
        Direction::new((x * normal.x() + y * normal.y() + z * normal.z()) * side)
    }

    /// det M: the factor by which volumes grow, negative if the transform mirrors.
    pub const fn determinant(&self) -> f64 {
        let [x, y, z] = self.columns;
        x.dot(y.cross(z))
    }

    /// Whether it turns right hands into left hands.
    pub const fn is_mirroring(&self) -> bool {
        self.determinant() < 0.0
    }

    /// Whether no coefficient is infinite or NaN.
    pub fn is_finite(&self) -> bool {
        self.columns.iter().all(|column| column.is_finite()) && self.translation.is_finite()
    }

    /// The inverse, or `None` if space is flattened: if |det M| is within rounding, 8·2⁻⁵², of 0 beside the product of
    /// the lengths of the axes' images.
    pub fn inverse(&self) -> Option<Self> {
        let determinant = self.determinant();
        let size: f64 = self.columns.iter().map(|column| column.length()).product();
        if !(determinant.abs() > 8.0 * f64::EPSILON * size && self.is_finite()) {
            return None;
        }
        let [x, y, z] = self.cofactors().map(|row| row / determinant);
        let inverse = Self {
            columns: [
                Vector::new(x.x, y.x, z.x),
                Vector::new(x.y, y.y, z.y),
                Vector::new(x.z, y.z, z.z),
            ],
            translation: Vector::ZERO,
        };
        Some(Self {
            translation: -inverse.vector(self.translation),
            ..inverse
        })
    }

    /// The factor by which all lengths grow, if it is the same in every direction to within 10⁻¹²: then spheres stay
    /// spheres and discs stay discs.
    ///
    /// ```
    /// use steradian::geometry::Transform;
    /// assert_eq!(Transform::scale(-2.0).similarity_scale(), Some(2.0));
    /// assert_eq!(Transform::scale_axes([1.0, 1.0, 2.0]).similarity_scale(), None);
    /// ```
    pub fn similarity_scale(&self) -> Option<f64> {
        let [x, y, z] = self.columns;
        let square = (x.length_squared() + y.length_squared() + z.length_squared()) / 3.0;
        let tolerance = 1e-12 * square;
        let equal = self
            .columns
            .iter()
            .all(|c| (c.length_squared() - square).abs() <= tolerance);
        let perpendicular = [x.dot(y), y.dot(z), z.dot(x)]
            .iter()
            .all(|dot| dot.abs() <= tolerance);
        (square > 0.0 && equal && perpendicular).then(|| square.sqrt())
    }

    /// The columns of the cofactor matrix det(M) M⁻ᵀ.
    const fn cofactors(&self) -> [Vector; 3] {
        let [x, y, z] = self.columns;
        [y.cross(z), z.cross(x), x.cross(y)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::{any_direction, any_vector, close};
    use proptest::prelude::*;

    fn any_transform() -> impl Strategy<Value = Transform> {
        let factor = prop_oneof![-3.0..-0.3_f64, 0.3..3.0_f64];
        let rotation = (any_direction(), -400.0..400.0_f64, any_vector(5.0));
        (prop::array::uniform3(factor), rotation, any_vector(5.0)).prop_map(
            |(factors, (axis, angle, about), step)| {
                Transform::scale_axes(factors)
                    .then(Transform::rotate(
                        axis,
                        Angle::from_degrees(angle),
                        Point::ORIGIN + about,
                    ))
                    .then(Transform::translate(step))
            },
        )
    }

    #[test]
    fn a_rotation_by_a_third_around_the_diagonal_permutes_the_axes() {
        let diagonal = Direction::new(Vector::new(1.0, 1.0, 1.0)).unwrap();
        let turn = Transform::rotate(diagonal, Angle::from_degrees(120.0), Point::ORIGIN);
        for (from, to) in [
            (Direction::X, Direction::Y),
            (Direction::Y, Direction::Z),
            (Direction::Z, Direction::X),
        ] {
            assert!((turn.vector(from.into()) - to.to_vector()).length() < 4.0 * f64::EPSILON);
        }
    }

    #[test]
    fn the_images_of_the_axes_define_a_transform() {
        let images = [Direction::Y, Direction::Z, Direction::X].map(Vector::from);
        let cycle = Transform::from_axes(images);
        assert_eq!(
            cycle.point(Point::new(1.0, 2.0, 3.0)),
            Point::new(3.0, 1.0, 2.0)
        );
    }

    #[test]
    fn flat_transforms_have_no_inverse() {
        assert_eq!(Transform::scale(0.0).inverse(), None);
        assert_eq!(Transform::scale_axes([1.0, 1.0, 0.0]).inverse(), None);
        assert_eq!(Transform::scale(f64::NAN).inverse(), None);
        assert!(Transform::scale(1e-30).inverse().is_some());
        assert_eq!(Transform::scale(0.0).similarity_scale(), None);
        assert!(Transform::scale(0.0).normal(Direction::Z).is_err());
    }

    #[test]
    fn a_normal_keeps_its_side_when_mirrored() {
        let mirror = Transform::scale_axes([-1.0, 1.0, 1.0]);
        assert!(mirror.is_mirroring());
        assert_eq!(mirror.normal(Direction::Z), Ok(Direction::Z));
        assert_eq!(mirror.normal(Direction::X), Ok(-Direction::X));
    }

    proptest! {
        #[test]
        fn the_inverse_undoes(transform in any_transform(), v in any_vector(10.0)) {
            let point = Point::ORIGIN + v;
            let back = transform.inverse().unwrap().point(transform.point(point));
            // Condition number ≤ 10, coordinates ≤ 100.
            prop_assert!(back.distance(point).to_metres() < 1e-12);
        }

        #[test]
        fn composition_applies_in_order(a in any_transform(), b in any_transform(), v in any_vector(10.0)) {
            let point = Point::ORIGIN + v;
            prop_assert!(a.then(b).point(point).distance(b.point(a.point(point))).to_metres() < 1e-12);
            let product = a.determinant() * b.determinant();
            prop_assert!(close(a.then(b).determinant() / product, 1.0, 1e-12));
        }

        #[test]
        fn normals_stay_perpendicular_and_on_their_side(
            transform in any_transform(), normal in any_direction(), other in any_direction()
        ) {
            let in_surface = normal.cross(other);
            let image = transform.normal(normal).unwrap();
            prop_assert!(image.dot(transform.vector(in_surface)).abs() < 1e-14);
            prop_assert!(image.dot(transform.vector(normal.into())) > 0.0);
        }

        #[test]
        fn rotations_and_uniform_scales_are_similarities(
            axis in any_direction(), angle in -400.0..400.0_f64, factor in 0.1..10.0_f64
        ) {
            let turn = Transform::rotate(axis, Angle::from_degrees(angle), Point::new(1.0, 2.0, 3.0));
            let scale = turn.then(Transform::scale(factor)).similarity_scale();
            prop_assert!(scale.is_some_and(|scale| close(scale / factor, 1.0, 1e-14)));
            prop_assert_eq!(turn.then(Transform::scale_axes([1.0, 1.0, 1.001])).similarity_scale(), None);
        }
    }
}
