//! What is wrong with a table.

/// A table that describes no surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeasuredError {
    /// Rings that do not rise from the normal, without patches, or too many.
    #[error(
        "a ring up to {degrees}° with {patches} patches: bounds rise from 0 to 90° and every ring has patches, {} in all at most",
        super::AngleBasis::MOST_PATCHES
    )]
    Ring {
        /// The upper bound.
        degrees: f64,
        /// The number of patches.
        patches: usize,
    },
    /// Nothing in it.
    #[error("a table without values")]
    Empty,
    /// Too few or too many values.
    #[error("{needed} values are needed, {found} were found")]
    Count {
        /// How many it takes.
        needed: usize,
        /// How many there are.
        found: usize,
    },
    /// A value that is negative or not finite.
    #[error("value {} is {found} 1/sr: values are finite and not negative", .index + 1)]
    Value {
        /// Which one, from 0.
        index: usize,
        /// What it is.
        found: f32,
    },
    /// Nodes that do not rise.
    #[error("nodes are not finite, or do not rise from one to the next")]
    Nodes,
    /// A grid of a tree that is no cube.
    #[error("a grid of {found} values is no cube of 1, 2, 4 … along every axis")]
    Grid {
        /// How many values there are.
        found: usize,
    },
    /// More parts than a tree has.
    #[error("the tree is complete, but more follows")]
    TreeComplete,
    /// Fewer parts than a tree has.
    #[error("the tree ends before all its parts are there")]
    TreeIncomplete,
    /// Too many halvings.
    #[error("the tree is halved more than {most} times")]
    TreeDepth {
        /// How many there may be.
        most: usize,
    },
}
