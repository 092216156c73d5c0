//! Light in SI units: radiance, irradiance and flux in a scene, each number with its unit and an error bar.
//!
//! Each module uses only the modules above it in this list.
#![forbid(unsafe_code)]

pub mod quantity;
pub mod geometry;
pub mod sampling;
pub mod estimation;
pub mod time;
pub mod spectrum;
pub mod shape;
pub mod brdf;
pub mod material;
pub mod light;
pub mod sensor;
pub mod scene;
pub mod measurement;
pub mod transport;
pub mod exchange;
pub mod glare;
