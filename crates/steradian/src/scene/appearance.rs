//! How a description states what varies over a surface: reflectance, opacity, emission.

use std::sync::Arc;

use crate::material::Bitmap;
use crate::spectrum::LaneValues;

/// Lanes at a point of a surface: `factor` times what every texture says there.
#[derive(Clone, Debug, PartialEq)]
pub struct Varying {
    /// Where all textures are 1.
    pub factor: LaneValues,
    /// Multiplied together; none for a constant.
    pub textures: Vec<Texture>,
}

impl From<LaneValues> for Varying {
    fn from(factor: LaneValues) -> Self {
        Self {
            factor,
            textures: vec![],
        }
    }
}

/// A pattern laid on a surface by its texture coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// What is laid.
    pub pattern: Pattern,
    /// Coordinates of the pattern for the texture coordinates (u, v) of the surface.
    pub placement: Placement,
}

/// What a texture shows. Its alpha is 1 unless stated.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// A picture with its alpha; shared where several textures use it.
    Bitmap(Arc<Bitmap>),
    /// Squares of one unit: the first where ⌊u⌋ + ⌊v⌋ is even.
    Checkerboard([LaneValues; 2]),
    /// Linear Rec.709 and alpha of the mesh's vertices, interpolated.
    VertexColor,
}

/// An affine map of texture coordinates: row i gives coordinate i as row · (u, v, 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement(pub [[f64; 3]; 2]);

impl Default for Placement {
    fn default() -> Self {
        Self([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    }
}

impl Placement {
    /// The pattern's coordinates.
    ///
    /// ```
    /// # use steradian::scene::description::Placement;
    /// let twice = Placement([[2.0, 0.0, 0.0], [0.0, 2.0, 0.5]]);
    /// assert_eq!(twice.at([0.5, 0.25]), [1.0, 1.0]);
    /// ```
    pub fn at(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        self.0.map(|[a, b, c]| a * u + b * v + c)
    }
}

/// The part of the light that a surface stops; the rest passes straight through.
#[derive(Clone, Debug, PartialEq)]
pub struct Opacity {
    /// Opacity where all textures have alpha 1, 0 to 1.
    pub factor: f64,
    /// Their alphas are multiplied.
    pub textures: Vec<Texture>,
    /// Opaque from this alpha on and absent below, instead of partly so.
    pub cutoff: Option<f64>,
}
