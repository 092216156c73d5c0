//! Tests of the ray kernel through its public interface.

#![allow(clippy::unwrap_used, reason = "a helper of a test may fail the test")]

mod agreement;
mod degenerate;
mod meshes;
mod packets;
mod quadrics;
mod random;
mod region;
mod reproducible;
mod watertight;
