//! What traversal needs of a ray, computed once.
//!
//! Boxes are tested by slabs, plane by plane: `t = (plane − origin)·(1/direction)`. The triangle test shears in `f32`, so a
//! triangle that it hits may miss the exact ray by a few roundings of the largest distance involved. The origin is therefore
//! moved by a bound of that error, against the ray for the near planes and along it for the far ones. With `r` the largest
//! coordinate difference between origin and scene and ε = 2⁻²⁴, the shear errs by at most 6εr across the ray, and the three
//! roundings of a slab and the nine of the triangle's `t` by 12εr along it; the padding is 2⁻¹⁹r = 32εr, and 2⁻²²|origin|
//! for the rounding of the moved origin itself. So a box is never missed that holds a triangle which is hit.

use crate::batch::Ray;
use crate::geometry::COORDINATE_LIMIT;
use crate::node::{Bounds, Node};
use crate::simd::{Floats, Scalar};
use crate::triangle::{Shear, splat};

const PADDING: f32 = 1.0 / (1 << 19) as f32;
const ORIGIN_ROUNDING: f32 = 1.0 / (1 << 22) as f32;

/// Components below this part of the largest one are replaced by it, so that their reciprocals stay finite; over any length
/// inside the scene it changes the position by less than ε²r.
pub(crate) const FLATTEST: f32 = f32::from_bits((127 - 40) << 23);

/// The range of the direction's largest component, 2⁻²⁸ … 2²⁸.
pub(crate) const DIRECTION_RANGE: std::ops::RangeInclusive<f32> =
    1.0 / COORDINATE_LIMIT..=COORDINATE_LIMIT;

/// A valid ray and its shear.
#[derive(Copy, Clone)]
pub(crate) struct PreparedRay {
    /// `k_x`, `k_y`, `k_z`: the last is the axis of the direction's largest component.
    pub(crate) axes: [usize; 3],
    pub(crate) shear: Shear<f32>,
    /// The last `t`, finite.
    pub(crate) t_max: f32,
}

impl PreparedRay {
    /// Nothing if the ray is not valid.
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> Option<Self> {
        let main = main_axis(ray.direction);
        if !is_valid(ray, main) {
            return None;
        }
        let axes = axes_of(main);
        let shear = Shear::new(
            Scalar,
            permute(ray.origin, axes),
            permute(ray.direction, axes),
        );
        Some(Self {
            axes,
            shear,
            t_max: ray.t_max.min(f32::MAX),
        })
    }

    /// `bounds` holds everything that is to be tested.
    #[inline(always)]
    pub(crate) fn slabs(&self, ray: &Ray, bounds: &Bounds) -> SlabNumbers<f32> {
        let longest = ray.direction[self.axes[2]].abs();
        SlabNumbers::new(Scalar, ray.origin, ray.direction, longest, bounds)
    }
}

/// Components in the order of the shear.
#[inline(always)]
pub(crate) fn permute(vector: [f32; 3], [x, y, z]: [usize; 3]) -> [f32; 3] {
    [vector[x], vector[y], vector[z]]
}

/// The axes in the order of the shear.
#[inline(always)]
pub(crate) fn axes_of(main: usize) -> [usize; 3] {
    static AXES: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];
    AXES[main]
}

/// The axis of the largest component, the first of equal ones.
#[inline(always)]
pub(crate) fn main_axis(direction: [f32; 3]) -> usize {
    let [x, y, z] = direction.map(f32::abs);
    if x >= y && x >= z {
        0
    } else if y >= z {
        1
    } else {
        2
    }
}

/// [`Ray`] says what is valid. All comparisons fail on NaN.
#[inline(always)]
pub(crate) fn is_valid(ray: &Ray, main: usize) -> bool {
    let largest = ray.direction[main].abs();
    let [x, y, z] = ray.direction.map(|component| component.abs() <= largest);
    let [p, q, r] = ray
        .origin
        .map(|coordinate| coordinate.abs() <= COORDINATE_LIMIT);
    x & y & z & p & q & r & DIRECTION_RANGE.contains(&largest) & !ray.t_max.is_nan()
}

/// A ray as the box test sees it.
#[derive(Copy, Clone)]
pub(crate) struct Slabs<F> {
    near_origin: [F; 3],
    far_origin: [F; 3],
    reciprocal: [F; 3],
    /// Which plane of a box comes first on each axis: 0 the lower, 1 the upper.
    near_side: [usize; 3],
}

impl<F: Floats> Slabs<F> {
    /// Where the ray enters each child's box, and the children whose box it meets before or at `t_max`.
    #[inline(always)]
    pub(crate) fn test(&self, set: F::Set, node: &Node, t_max: F) -> (F, F::Mask) {
        let near = self.near(set, node, 0).maximum(self.near(set, node, 1));
        let entry = near.maximum(self.near(set, node, 2).maximum(F::splat(set, 0.0)));
        let far = self.far(set, node, 0).minimum(self.far(set, node, 1));
        let exit = far.minimum(self.far(set, node, 2).minimum(t_max));
        (entry, entry.less_equal(exit))
    }

    #[inline(always)]
    fn near(&self, set: F::Set, node: &Node, axis: usize) -> F {
        let planes = F::load(set, &node.planes[axis][self.near_side[axis] & 1]);
        (planes - self.near_origin[axis]) * self.reciprocal[axis]
    }

    #[inline(always)]
    fn far(&self, set: F::Set, node: &Node, axis: usize) -> F {
        let planes = F::load(set, &node.planes[axis][self.near_side[axis] & 1 ^ 1]);
        (planes - self.far_origin[axis]) * self.reciprocal[axis]
    }
}

/// The largest coordinate difference between an origin and the scene.
#[inline(always)]
pub(crate) fn reach<F: Floats>(set: F::Set, bounds: &Bounds, origin: [F; 3]) -> F {
    let mut reach = F::splat(set, 0.0);
    for k in 0..3 {
        let below = (F::splat(set, bounds.lower[k]) - origin[k]).absolute(set);
        let above = (F::splat(set, bounds.upper[k]) - origin[k]).absolute(set);
        reach = reach.maximum(below).maximum(above);
    }
    reach
}

/// How far an origin is moved along an axis.
#[inline(always)]
pub(crate) fn shift<F: Floats>(set: F::Set, reach: F, coordinate: F) -> F {
    F::splat(set, PADDING) * reach + F::splat(set, ORIGIN_ROUNDING) * coordinate
}

/// [`Slabs`] before they are copied to the lanes of boxes; of one ray, or of one in each lane.
#[derive(Copy, Clone)]
pub(crate) struct SlabNumbers<F> {
    pub(crate) near_origin: [F; 3],
    pub(crate) far_origin: [F; 3],
    pub(crate) reciprocal: [F; 3],
}

impl<F: Floats> SlabNumbers<F> {
    /// `longest` is the largest component of the direction, `bounds` holds everything that is to be tested.
    #[inline(always)]
    pub(crate) fn new(
        set: F::Set,
        origin: [F; 3],
        direction: [F; 3],
        longest: F,
        bounds: &Bounds,
    ) -> Self {
        let (zero, one) = (F::splat(set, 0.0), F::splat(set, 1.0));
        let flattest = longest * F::splat(set, FLATTEST);
        let reach = reach(set, bounds, origin);
        let mut slabs = Self {
            near_origin: [zero; 3],
            far_origin: [zero; 3],
            reciprocal: [zero; 3],
        };
        for k in 0..3 {
            let sign = F::select(direction[k].less(zero), zero - one, one);
            let shift = shift(set, reach, origin[k].absolute(set)) * sign;
            slabs.near_origin[k] = origin[k] + shift;
            slabs.far_origin[k] = origin[k] - shift;
            slabs.reciprocal[k] = sign / direction[k].absolute(set).maximum(flattest);
        }
        slabs
    }
}

impl SlabNumbers<f32> {
    /// The same ray in every lane.
    #[inline(always)]
    pub(crate) fn splat<F: Floats>(&self, set: F::Set) -> Slabs<F> {
        Slabs {
            near_origin: splat(set, self.near_origin),
            far_origin: splat(set, self.far_origin),
            reciprocal: splat(set, self.reciprocal),
            near_side: self.reciprocal.map(|r| usize::from(r.is_sign_negative())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{PreparedRay, main_axis};
    use crate::batch::Ray;

    const RAY: Ray = Ray {
        origin: [0.0; 3],
        direction: [0.0, 0.0, 1.0],
        t_max: f32::INFINITY,
    };

    #[test]
    fn the_first_of_equal_components_is_the_main_axis() {
        assert_eq!(main_axis([1.0, -1.0, 1.0]), 0);
        assert_eq!(main_axis([0.5, -1.0, 1.0]), 1);
        assert_eq!(main_axis([0.5, -1.0, -2.0]), 2);
    }

    #[test]
    fn invalid_rays_are_recognised() {
        assert!(PreparedRay::new(&RAY).is_some());
        let directions = [
            [0.0; 3],
            [f32::NAN, 1.0, 0.0],
            [0.0, 0.0, f32::INFINITY],
            [1e-9, 0.0, 0.0],
            [0.0, 1e9, 0.0],
        ];
        for direction in directions {
            assert!(
                PreparedRay::new(&Ray { direction, ..RAY }).is_none(),
                "{direction:?}"
            );
        }
        for coordinate in [f32::NAN, f32::INFINITY, 1e9] {
            assert!(
                PreparedRay::new(&Ray {
                    origin: [0.0, coordinate, 0.0],
                    ..RAY
                })
                .is_none()
            );
        }
        assert!(
            PreparedRay::new(&Ray {
                t_max: f32::NAN,
                ..RAY
            })
            .is_none()
        );
    }
}
