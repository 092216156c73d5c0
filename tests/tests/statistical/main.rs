//! Laws that no table states: what must agree with what, whatever the scene.
//!
//! Every test has a fixed seed. A test that compares sampled numbers allows 4 standard errors with 63 degrees of
//! freedom: a false alarm of 1.7e-4 for each comparison, met or not met once and for all with the seed.

mod balance;
mod energy;
mod full_view;
mod furnaces;
mod lamps;
mod many_lights;
mod mirrors;
mod panes;
mod reflection;
mod relief;
mod reproducible;
mod rosters;
mod scattering;
mod spectral;
mod spectrum;
mod textures;
