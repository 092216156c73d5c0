//! Pictures of a result: plans, lines of equal values, shares of light groups, and tables in colour.
//!
//! A [`Choice`] finds what is to be shown among the [`Subject`]s of a result; here they become what [`super::plot`] draws.
//!
//! | picture | of | shows |
//! |---|---|---|
//! | [`plan`] | the points of a sensor | where they are, at true scale, and their values by colour and number |
//! | [`isolines`] | a sensor whose points are a grid | lines of equal values, and the bands in which they may lie |
//! | [`shares`] | sensors, or the points of one | how much of each value each light group gives |
//! | [`matrix`] | the same | what each light group gives, by colour |

mod choice;
mod groups;
mod map;
mod view;

pub use choice::{Choice, ChoiceError, Need, Subject};
pub use groups::{matrix, shares};
pub use map::{isolines, plan};
