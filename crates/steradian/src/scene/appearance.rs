//! How a description states what varies over a surface: reflectance, opacity, emission.

use std::sync::Arc;

use crate::material::Bitmap;
use crate::spectrum::{Curve, LaneValues};

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

/// Absorption in 1/m of a medium that leaves this part of the light after a distance: −ln(c)/d. `None` if a value is not above 0
/// and at most 1, or the distance not above 0.
///
/// ```
/// # use steradian::scene::description::{LaneValues, absorption_of_attenuation};
/// let left = LaneValues::Rgb([1.0, 0.5, 0.25]);
/// let Some(LaneValues::Rgb([red, green, blue])) = absorption_of_attenuation(&left, 2.0) else { panic!() };
/// assert_eq!(red, 0.0);
/// assert!((green - 0.346_574).abs() < 1e-6 && (blue - 2.0 * green).abs() < 1e-15);
/// ```
pub fn absorption_of_attenuation(left: &LaneValues, distance: f64) -> Option<LaneValues> {
    let absorption = |value: f64| {
        let possible = value > 0.0 && value <= 1.0 && distance > 0.0;
        possible.then(|| (-libm::log(value) / distance).max(0.0))
    };
    Some(match left {
        LaneValues::Uniform(value) => LaneValues::Uniform(absorption(*value)?),
        LaneValues::Rgb([r, g, b]) => {
            LaneValues::Rgb([absorption(*r)?, absorption(*g)?, absorption(*b)?])
        }
        LaneValues::Bands(bands) => {
            let bands = bands.iter();
            let bands = bands.map(|(name, value)| Some((name.clone(), absorption(*value)?)));
            LaneValues::Bands(bands.collect::<Option<_>>()?)
        }
        LaneValues::Curve { curve, watts } => {
            let samples = curve.wavelengths().iter().zip(curve.values());
            let samples = samples.map(|(&nm, &value)| Some((nm, absorption(value)?)));
            let samples = samples.collect::<Option<Vec<_>>>()?;
            LaneValues::Curve {
                curve: Arc::new(Curve::new(samples, curve.beyond()).ok()?),
                watts: *watts,
            }
        }
    })
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
