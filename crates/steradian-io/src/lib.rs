//! Scene files in, reports out.

pub mod report;
