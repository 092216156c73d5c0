//! Configuration factors in closed form.
//!
//! The configuration factor of an object, seen from a surface element, is the fraction of the element's diffuse
//! radiation that reaches the object; it is the object's projected solid angle over π,
//!
//! F = (1/π) ∫ cosθ dω
//!
//! so that an object of uniform radiance L gives the element the irradiance E = π L F. By Stokes's theorem it is an integral
//! along the object's outline r relative to the element of normal n (E. M. Sparrow, J. Heat Transfer 85 (2), 1963, eq. 8),
//!
//! F = (1/2π) | ∮ n · (r × dr)/r² |
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | F | configuration factor, 0 … 1 | – |
//! | θ | angle from the element's normal | rad |
//! | r | from the element to the outline | m |
//!
//! What lies below the element's horizon is clipped away first. Which side of a flat object faces the element does not
//! matter. An element in the plane of such an object sees nothing of it unless it lies inside, where the limit from above the
//! element's normal is 1; on the outline the factor has no limit, and a value between 0 and 1 is returned.
//!
//! Precision: absolute errors of some 2⁻⁵² for each edge, also upwards of 1.
//!
//! ```
//! use steradian::geometry::{configuration_factor, Direction, Point};
//! // A square of 2 m × 2 m, one metre above the element: F = (4/π) (1/√2) atan(1/√2).
//! let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Point::new(x, y, 1.0));
//! let found = configuration_factor::of_polygon(Point::ORIGIN, Direction::Z, &square);
//! assert!((found - 0.5541264239796).abs() < 1e-12);
//! ```

mod contour;
mod cylinder;
mod disc;
mod ellipse;
mod patch;
mod polygon;
mod sphere;
mod spherical_polygon;
mod strip;

pub use cylinder::of_cylinder;
pub use disc::of_disc;
pub use ellipse::of_ellipse;
pub use patch::{of_cap, of_patch};
pub(super) use polygon::above_horizon;
pub use polygon::{of_polygon, projected_solid_angle_of_polygon};
pub use sphere::of_sphere;
pub use spherical_polygon::of_spherical_polygon;
pub use strip::of_strip;
