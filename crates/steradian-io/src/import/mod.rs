//! Readers of other programs' files.

pub mod gltf;
pub mod image;
pub mod obj;
pub mod points;
pub mod spectrum;
