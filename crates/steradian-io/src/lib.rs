//! Scene files in, reports out.

pub mod diagnostic;
pub mod files;
pub mod import;
pub mod nearest;
pub mod report;
pub mod scene_file;
