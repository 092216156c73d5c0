//! Solid angles in closed form.
//!
//! The solid angle of an object is the area of its projection onto the unit sphere around the observer,
//! ω = ∫ cosθ dA / r².
//!
//! | object | ω | source |
//! |---|---|---|
//! | cap of half angle α | 4π sin²(α/2) = 2π (1 − cosα) | |
//! | sphere, radius R at distance d | the cap with sinα = R/d | |
//! | disc, ellipse | a complete elliptic integral of the cone they span | Paxton 1959; see [`of_ellipse`] |
//! | triangle, plane polygon | signed sum over a fan of triangles | Van Oosterom & Strackee 1983, eq. 8 |
//! | polygon on the sphere | 2π − Σ turns | Gauss & Bonnet; see [`of_spherical_polygon`] |
//! | box, convex mesh | sums over faces; see [`of_box`], [`of_convex_mesh`] | |
//!
//! The patch of latitude and longitude is [`SphericalPatch`](super::SphericalPatch), the small patch
//! [`SolidAngle::of_patch`](crate::quantity::SolidAngle::of_patch).
//!
//! Flat objects have the same solid angle from both sides. As the observer comes to the plane, it tends to 0 outside the
//! outline and to 2π inside. In the plane itself an object is edge-on and fills 0.
//!
//! Precision: relative errors are some 2⁻⁵² for objects of any smallness seen face on, because the triple product is
//! formed from the edges. Close to the plane the absolute error grows as 2⁻⁵² size/height, because each triangle of a
//! fan reacts that much to a shift of an edge right below the observer.
//!
//! ```
//! use steradian::geometry::{solid_angle, Point};
//!

mod ellipse;
mod jacobi;
mod polygon;
mod round;
mod solid;
mod spherical_polygon;

pub(super) use ellipse::semi_axes;
pub use ellipse::{of_disc, of_ellipse};
pub use polygon::{of_polygon, of_polygon_above_horizon, of_triangle};
pub use round::{of_cap, of_sphere};
pub use solid::{of_box, of_convex_mesh, winding_number};
pub use spherical_polygon::{SphericalPolygonError, of_spherical_polygon};
