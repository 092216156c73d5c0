//! Readers of other programs' files.

pub mod image;
pub mod obj;
pub mod points;
pub mod spectrum;
