//! The points of `measure --points`.

use std::path::Path;

use steradian::geometry::{Point, Vector};
use steradian_io::files::DiskFiles;
use steradian_io::import::points::read_points;

use crate::status::Failure;

/// Name of the sensor that the points make up.
pub const SENSOR: &str = "points";

/// Position and normal of each point of a CSV file.
pub fn read(path: &Path) -> Result<Vec<(Point, Vector)>, Failure> {
    read_points(path, &DiskFiles::default()).map_err(Failure::Input)
}
