//! The command line: what it prints, how it ends, and that it gives the same bytes every time.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on says where")]

mod balance;
mod brdf;
mod classroom;
mod course;
mod energy;
mod errors;
mod form_factor;
mod form_factor_scene;
mod glare;
mod help;
mod inspect;
mod instruments;
mod interruption;
mod light_groups;
mod parquet;
mod pictures;
mod plots;
mod results;
mod schedules;
mod same_bytes;
mod sensors;
mod solid_angle;
mod stored_results;
