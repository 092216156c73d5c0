//! The watertight ray–triangle test.
//!
//! Translate the triangle by the ray's origin and shear it so that the ray becomes the +z axis. With `k_z` the axis of
//! the direction's largest component and `A`, `B`, `C` the translated vertices,
//!
//! ```text
//! S_x = d[k_x]/d[k_z]    S_y = d[k_y]/d[k_z]    S_z = 1/d[k_z]
//! A_x = A[k_x] − S_x·A[k_z]    A_y = A[k_y] − S_y·A[k_z]    A_z = S_z·A[k_z]      (B and C likewise)
//! U = C_x·B_y − C_y·B_x    V = A_x·C_y − A_y·C_x    W = B_x·A_y − B_y·A_x
//! t = (U·A_z + V·B_z + W·C_z)/(U + V + W)
//! ```
//!
//! The ray passes through the triangle where U, V, W have no two different signs. Rounding is monotone, so a sign of the
//! difference of two rounded products is right or the difference is 0; two triangles that share an edge compute the same
//! number up to its sign. Where an edge function is 0, or so small that its rounding may underflow, everything after the
//! shear is repeated in `f64`, in which the products are exact: no ray passes between two triangles.
//!
//! Source: S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", Journal of Computer Graphics Techniques
//! 2(1), 2013. Unlike there, `k_x` and `k_y` are not swapped for d[k_z] < 0: triangles have two sides here.

use crate::simd::{Floats, Mask};

/// Below this an edge function is recomputed in `f64`: 2⁻⁹⁰.
pub(crate) const SMALLEST_CERTAIN: f32 = f32::from_bits((127 - 90) << 23);

/// A point after the shear: (x, y) across the ray, z along it in units of the direction.
pub(crate) type Sheared<F> = [F; 3];

/// The map that makes a ray the +z axis; components in the order `k_x`, `k_y`, `k_z`.
#[derive(Copy, Clone)]
pub(crate) struct Shear<F> {
    pub(crate) origin: [F; 3],
    pub(crate) slope: [F; 3],
}

impl<F: Floats> Shear<F> {
    /// Of the ray with this origin and direction, both already permuted.
    #[inline(always)]
    pub(crate) fn new(set: F::Set, origin: [F; 3], direction: [F; 3]) -> Self {
        let [x, y, z] = direction;
        Self {
            origin,
            slope: [x / z, y / z, F::splat(set, 1.0) / z],
        }
    }

    #[inline(always)]
    pub(crate) fn apply(&self, vertex: [F; 3]) -> Sheared<F> {
        let x = vertex[0] - self.origin[0];
        let y = vertex[1] - self.origin[1];
        let z = vertex[2] - self.origin[2];
        [
            x - self.slope[0] * z,
            y - self.slope[1] * z,
            self.slope[2] * z,
        ]
    }
}

impl Shear<f32> {
    /// The same ray in every lane.
    #[inline(always)]
    pub(crate) fn splat<F: Floats>(&self, set: F::Set) -> Shear<F> {
        Shear {
            origin: splat(set, self.origin),
            slope: splat(set, self.slope),
        }
    }
}

/// The same point in every lane.
#[inline(always)]
pub(crate) fn splat<F: Floats>(set: F::Set, [x, y, z]: [f32; 3]) -> [F; 3] {
    [F::splat(set, x), F::splat(set, y), F::splat(set, z)]
}

/// The three edge functions, which are the unnormalised weights of the vertices.
#[derive(Copy, Clone)]
pub(crate) struct Edges<F> {
    u: F,
    v: F,
    w: F,
}

impl<F: Floats> Edges<F> {
    #[inline(always)]
    pub(crate) fn new(a: Sheared<F>, b: Sheared<F>, c: Sheared<F>) -> Self {
        Self {
            u: c[0] * b[1] - c[1] * b[0],
            v: a[0] * c[1] - a[1] * c[0],
            w: b[0] * a[1] - b[1] * a[0],
        }
    }

    /// Those of the triangle (a, c, d), if these are of (a, b, c): the edge between them is the same number with the other sign.
    #[inline(always)]
    pub(crate) fn of_neighbour(
        &self,
        set: F::Set,
        a: Sheared<F>,
        c: Sheared<F>,
        d: Sheared<F>,
    ) -> Self {
        Self {
            u: d[0] * c[1] - d[1] * c[0],
            v: a[0] * d[1] - a[1] * d[0],
            w: F::splat(set, 0.0) - self.v,
        }
    }

    #[inline(always)]
    pub(crate) fn select(mask: F::Mask, yes: Self, no: Self) -> Self {
        Self {
            u: F::select(mask, yes.u, no.u),
            v: F::select(mask, yes.v, no.v),
            w: F::select(mask, yes.w, no.w),
        }
    }

    /// Where the ray passes through the triangle or its border.
    #[inline(always)]
    pub(crate) fn inside(&self, set: F::Set) -> F::Mask {
        let zero = F::splat(set, 0.0);
        zero.less_equal(self.smallest()) | self.largest().less_equal(zero)
    }

    /// Where it passes through the triangle so far from the border that `f32` decides.
    #[inline(always)]
    pub(crate) fn certainly_inside(&self, set: F::Set) -> F::Mask {
        let positive = F::splat(set, SMALLEST_CERTAIN).less(self.smallest());
        positive | self.largest().less(F::splat(set, -SMALLEST_CERTAIN))
    }

    /// How far inside the triangle the ray passes: negative outside, 0 on the border, and f32 decides where it is above
    /// [`SMALLEST_CERTAIN`].
    #[inline(always)]
    pub(crate) fn margin(&self, set: F::Set) -> F {
        self.smallest().maximum(F::splat(set, 0.0) - self.largest())
    }

    /// `t` and what it was divided by.
    #[inline(always)]
    pub(crate) fn intersection(&self, depths: [F; 3]) -> Intersection<F> {
        let determinant = self.u + self.v + self.w;
        let numerator = self.u * depths[0] + self.v * depths[1] + self.w * depths[2];
        Intersection {
            t: numerator / determinant,
            v: self.v,
            w: self.w,
            determinant,
        }
    }

    #[inline(always)]
    fn smallest(&self) -> F {
        self.u.minimum(self.v).minimum(self.w)
    }

    #[inline(always)]
    fn largest(&self) -> F {
        self.u.maximum(self.v).maximum(self.w)
    }
}

/// Where the ray meets the triangle's plane.
#[derive(Copy, Clone)]
pub(crate) struct Intersection<F> {
    pub(crate) t: F,
    /// Weight of vertex 1, times the determinant.
    pub(crate) v: F,
    /// Weight of vertex 2, times the determinant.
    pub(crate) w: F,
    pub(crate) determinant: F,
}

impl Intersection<f32> {
    /// The weights of vertices 1 and 2.
    #[inline(always)]
    pub(crate) fn weights(&self) -> [f32; 2] {
        [self.v / self.determinant, self.w / self.determinant]
    }
}

/// The test in `f64` after the shear in `f32`; nothing if the triangle is seen edge-on.
#[cold]
pub(crate) fn exact_intersection(
    a: Sheared<f32>,
    b: Sheared<f32>,
    c: Sheared<f32>,
) -> Option<[f32; 3]> {
    let [a, b, c] = [a, b, c].map(|vertex| vertex.map(f64::from));
    let u = c[0] * b[1] - c[1] * b[0];
    let v = a[0] * c[1] - a[1] * c[0];
    let w = b[0] * a[1] - b[1] * a[0];
    let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    let determinant = u + v + w;
    let t = (u * a[2] + v * b[2] + w * c[2]) / determinant;
    (inside && determinant != 0.0).then_some([
        t as f32,
        (v / determinant) as f32,
        (w / determinant) as f32,
    ])
}

/// The whole test for one triangle, its corners permuted like the shear: `[t, weight 1, weight 2]` for any `t`.
pub(crate) fn intersect(shear: &Shear<f32>, corners: [[f32; 3]; 3]) -> Option<[f32; 3]> {
    let [a, b, c] = corners.map(|corner| shear.apply(corner));
    intersect_sheared(a, b, c)
}

/// The same after the shear.
#[inline(always)]
pub(crate) fn intersect_sheared(
    a: Sheared<f32>,
    b: Sheared<f32>,
    c: Sheared<f32>,
) -> Option<[f32; 3]> {
    let set = crate::simd::Scalar;
    let edges = Edges::new(a, b, c);
    if edges.certainly_inside(set).bits() != 0 {
        let intersection = edges.intersection([a[2], b[2], c[2]]);
        let [u, v] = intersection.weights();
        Some([intersection.t, u, v])
    } else if edges.inside(set).bits() != 0 {
        exact_intersection(a, b, c)
    } else {
        None
    }
}

/// Whether the corners lie on a line; the differences and products are exact but for extreme ratios of size.
pub(crate) fn is_degenerate(corners: [[f32; 3]; 3]) -> bool {
    let [a, b, c] = corners.map(|corner| corner.map(f64::from));
    let (e, f) = (
        [0, 1, 2].map(|k| b[k] - a[k]),
        [0, 1, 2].map(|k| c[k] - a[k]),
    );
    [(1, 2), (2, 0), (0, 1)]
        .iter()
        .all(|&(i, j)| e[i] * f[j] == e[j] * f[i])
}

#[cfg(test)]
mod tests {
    use super::{Shear, intersect, is_degenerate};
    use crate::simd::Scalar;

    fn along_z(origin: [f32; 3]) -> Shear<f32> {
        Shear::new(Scalar, origin, [0.0, 0.0, 1.0])
    }

    const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 3.0], [4.0, 0.0, 3.0], [0.0, 2.0, 3.0]];

    #[test]
    fn weights_are_barycentric() {
        assert_eq!(
            intersect(&along_z([1.0, 0.5, 1.0]), CORNERS),
            Some([2.0, 0.25, 0.25])
        );
        assert_eq!(
            intersect(&along_z([1.0, 0.5, 4.0]), CORNERS),
            Some([-1.0, 0.25, 0.25])
        );
    }

    #[test]
    fn corners_and_edges_belong_to_the_triangle() {
        assert_eq!(
            intersect(&along_z([0.0, 0.0, 0.0]), CORNERS),
            Some([3.0, 0.0, 0.0])
        );
        assert_eq!(
            intersect(&along_z([4.0, 0.0, 0.0]), CORNERS),
            Some([3.0, 1.0, 0.0])
        );
        assert_eq!(
            intersect(&along_z([2.0, 1.0, 0.0]), CORNERS),
            Some([3.0, 0.5, 0.5])
        );
        assert_eq!(intersect(&along_z([2.0, 1.0 + 1e-6, 0.0]), CORNERS), None);
    }

    #[test]
    fn the_exact_test_decides_what_rounds_to_zero() {
        // (1 + ε)(1 − ε) rounds to 1: the edge from b to c seems to contain the ray, but passes it at distance ε²/2.
        let (b, c) = (
            [1.0, 1.0 - f32::EPSILON, 1.0],
            [-1.0 - f32::EPSILON, -1.0, 1.0],
        );
        assert_eq!(c[0] * b[1] - c[1] * b[0], 0.0);
        assert_eq!(
            intersect(&along_z([0.0; 3]), [[1.0, -1.0, 1.0], b, c]),
            None
        );
        assert!(intersect(&along_z([0.0; 3]), [[-1.0, 1.0, 1.0], b, c]).is_some());
    }

    #[test]
    fn only_collinear_corners_are_degenerate() {
        assert!(is_degenerate([[0.1, 0.2, 0.3]; 3]));
        assert!(is_degenerate([
            [0.0, 0.0, 0.0],
            [1.0, 2.0, 3.0],
            [2.0, 4.0, 6.0]
        ]));
        assert!(!is_degenerate([
            [0.0, 0.0, 0.0],
            [1.0, 2.0, 3.0],
            [2.0, 4.0, 6.000_001]
        ]));
        assert!(!is_degenerate([
            [0.0, 0.0, 0.0],
            [1e-30, 0.0, 0.0],
            [0.0, 1e-30, 0.0]
        ]));
    }
}
