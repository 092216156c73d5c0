//! An author's numbers for the lanes.

/// A number for each lane, as an author writes it.
#[derive(Clone, Debug, PartialEq)]
pub enum LaneValues {
    /// The same in every lane.
    Uniform(f64),
    /// Linear Rec.709 (only in `rgb` mode).
    Rgb([f64; 3]),
    /// By band name (only in `broadband` mode).
    Bands(Vec<(String, f64)>),
}
