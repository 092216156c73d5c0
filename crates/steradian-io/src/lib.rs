//! Scene files in, reports out.
