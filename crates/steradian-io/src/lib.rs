//! Scene files in, reports out.

pub mod diagnostic;
pub mod files;
pub mod report;
