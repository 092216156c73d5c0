//! Surfaces of a scene: their area, uniform sampling of it, and what rays meet.
//!
//! Each [`Form`] is one shape of f64 coordinates; [`Surfaces`] holds all of them in the form the ray kernel wants and
//! knows which part of which shape a primitive belongs to. A planar shape enters the kernel as triangles and stays
//! one shape for area, emission and sampling.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | A = ∫ dA | area of a form | m² |
//! | p(x) = 1/A | density of uniform area sampling | 1/m² |

mod coordinates;
mod crossing;
mod disc;
mod enclosure;
mod form;
mod gradients;
pub mod health;
mod mesh;
mod parallelogram;
pub mod quadrature;
mod solid;
mod sphere;
mod surfaces;

pub use crossing::{Crossing, Ray};
pub use disc::Disc;
pub use enclosure::{Enclosure, Side};
pub use form::{AreaSample, Form};
pub use gradients::along_u;
pub use mesh::{Attributes, TriangleMesh};
pub use parallelogram::Parallelogram;
pub use solid::Solid;
pub use sphere::{Sphere, SpherePort};
pub(crate) use surfaces::clearance_in;
pub use surfaces::{PartId, Placed, QuadricRecord, ShapeId, Surfaces, TriangleRecord};
