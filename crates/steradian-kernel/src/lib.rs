//! Batched ray queries.
