//! Light transport: from a scene and a plan to measurements and pictures.
//!
//! [`measure`] reads every sensor but cameras, [`render`] a camera. Both run the [`path`](self) estimator under the
//! engine of [`estimation`](crate::estimation), which decides how many samples are taken and how large the error is.

mod aim;
mod appearance;
mod blocks;
mod branching;
mod camera;
mod channels;
mod choice;
mod columns;
mod cylinder;
mod exact;
mod flux;
mod fluxes;
mod interaction;
mod kept_aims;
mod light_samples;
mod light_tracing;
mod light_tree;
mod measure;
mod media;
mod merge;
mod meters;
mod next_event;
mod panel;
mod path;
mod patterned;
mod plain;
mod portals;
mod profile;
pub mod reflection;
mod roster;
mod run;
mod scatter;
mod scattering;
mod shading_normal;
mod shaft;
mod tables;
mod thrown;
mod towards;
mod transmittance;
mod unsampled;
mod wide;

pub use blocks::{Ended, POINTS_OF_A_BLOCK, measure, measure_in_blocks};
pub use profile::{Stage, StageTimes, profile};
pub use run::{Branching, MeasureOptions, Picture, RenderOptions, SimulationError, render};
pub use unsampled::unsampled_by_any;
