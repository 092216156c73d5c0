//! Batched ray queries against triangles and quadrics.
//!
//! This crate answers three questions about a fixed set of primitives: which one does a ray meet first
//! ([`Accelerator::closest`]), does a segment meet any ([`Accelerator::occluded`]), and is a convex region free of them
//! ([`Accelerator::region_is_clear`]). It knows lengths but no units, and nothing of materials or light.
//!
//! **A hit is a function of the ray and of the primitive, and of nothing else.** Triangles are tested in `f32` with the
//! watertight test of Woop, Benthin & Wald (2013); the operations and their order are the same in every code path, no
//! multiply-add is fused, and the closest hit is the smallest `(t, primitive)`. Builder, traversal order, vector width
//! and instruction set therefore change the speed and never a bit of the result. Quadrics are intersected in `f64`.
//!
//! All unsafe code of the project lives here, in the modules `instruction_set` and `simd`: calling a function
//! compiled for an instruction set that was detected at run time, and the loads and stores of its registers; and in
//! `huge_pages`, one call of the operating system.
//!
//! ```
//! use steradian_kernel::{Accelerator, Geometry, HitBatch, InstructionSet, MISS, RayBatch};
//!
//! let geometry = Geometry {
//!     positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
//!     triangles: vec![[0, 1, 2]],
//!     quadrics: vec![],
//! };
//! let accelerator = Accelerator::build(&geometry)?;
//! let mut rays = RayBatch::default();
//! rays.push([0.25, 0.5, 2.0], [0.0, 0.0, -1.0], f32::INFINITY);
//! rays.push([2.0, 2.0, 2.0], [0.0, 0.0, -1.0], f32::INFINITY);
//! let mut hits = HitBatch::default();
//! accelerator.closest(&rays, &mut hits, InstructionSet::detect());
//! assert_eq!((hits.t[0], hits.u[0], hits.v[0], hits.primitive[0]), (2.0, 0.25, 0.5, 0));
//! assert_eq!(hits.primitive[1], MISS);
//! # Ok::<(), steradian_kernel::BuildError>(())
//! ```

mod accelerator;
mod batch;
mod binary_tree;
mod collapse;
mod geometry;
mod huge_pages;
mod in_order;
mod instruction_set;
mod node;
mod open_leaves;
mod packet;
mod parts;
mod prefetch;
mod prepared_ray;
mod quadric;
mod region;
mod side_by_side;
mod simd;
mod small_scene;
mod traversal;
mod triangle;
mod turns;
mod wide_tree;

pub use accelerator::Accelerator;
pub use batch::{Hit, HitBatch, MISS, Ray, RayBatch};
pub use geometry::{BuildError, COORDINATE_LIMIT, Cap, Geometry, Quadric};
pub use instruction_set::{InstructionSet, Work};
pub use prefetch::prefetch;
pub use region::{Obstacle, Regions};
