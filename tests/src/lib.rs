//! What the tests of the whole share: running the program.

pub mod command;
