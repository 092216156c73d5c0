//! Readers of other programs' files.

pub mod obj;
pub mod points;
