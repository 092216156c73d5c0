//! The input: triangles and quadrics, and what can be wrong with them.

use thiserror::Error;

/// Coordinates beyond ±2²⁸ are refused: up to there no intermediate of the `f32` triangle test overflows.
pub const COORDINATE_LIMIT: f32 = 268_435_456.0;

/// Primitive numbers must leave two bits of a `u32` to the tree.
const PRIMITIVE_LIMIT: usize = 1 << 30;

/// A hole in a sphere: the points whose direction from the centre is within an angle of the axis.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Cap {
    /// The axis, a unit vector from the centre.
    pub direction: [f64; 3],
    /// Cosine of the half angle.
    pub cos_half_angle: f64,
}

/// A curved or unbounded surface, intersected in `f64`.
#[derive(Clone, Debug, PartialEq)]
pub enum Quadric {
    /// A sphere, seen from outside and from inside, without its ports.
    Sphere {
        /// The centre.
        center: [f64; 3],
        /// The radius, positive.
        radius: f64,
        /// Holes.
        ports: Vec<Cap>,
    },
    /// A flat disc or ring.
    Disc {
        /// The centre.
        center: [f64; 3],
        /// Perpendicular to the disc, of any length but zero.
        normal: [f64; 3],
        /// The outer radius, positive.
        radius: f64,
        /// The radius of the hole: at least 0, below `radius`.
        inner_radius: f64,
    },
    /// An infinite plane.
    Plane {
        /// A point of the plane.
        point: [f64; 3],
        /// Perpendicular to the plane, of any length but zero.
        normal: [f64; 3],
    },
}

/// All primitives of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    /// Vertices.
    pub positions: Vec<[f32; 3]>,
    /// Three indices into `positions` each.
    pub triangles: Vec<[u32; 3]>,
    /// Quadrics; the first one is primitive `triangles.len()`.
    pub quadrics: Vec<Quadric>,
}

/// Why a [`Geometry`] is refused.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BuildError {
    /// A vertex is infinite or not a number.
    #[error("vertex {vertex} is not finite: {position:?}")]
    NonFiniteVertex {
        /// Index into `positions`.
        vertex: usize,
        /// Its coordinates.
        position: [f32; 3],
    },
    /// A vertex is too far from the origin.
    #[error("vertex {vertex} lies beyond 2^28 from the origin: {position:?}")]
    VertexTooFar {
        /// Index into `positions`.
        vertex: usize,
        /// Its coordinates.
        position: [f32; 3],
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {vertex}, but there are {vertices}")]
    IndexOutOfRange {
        /// Index into `triangles`.
        triangle: usize,
        /// The vertex it names.
        vertex: u32,
        /// The number of vertices.
        vertices: usize,
    },
    /// A quadric has an unusable parameter.
    #[error("quadric {quadric}: {fault}")]
    InvalidQuadric {
        /// Index into `quadrics`.
        quadric: usize,
        /// What is wrong.
        fault: &'static str,
    },
    /// More than 2³⁰ primitives.
    #[error("{primitives} primitives, at most 2^30 are possible")]
    TooManyPrimitives {
        /// Triangles and quadrics together.
        primitives: usize,
    },
}

impl Geometry {
    /// The first thing that is wrong, if any.
    pub(crate) fn validate(&self) -> Result<(), BuildError> {
        let primitives = self.triangles.len().saturating_add(self.quadrics.len());
        if primitives > PRIMITIVE_LIMIT {
            return Err(BuildError::TooManyPrimitives { primitives });
        }
        self.validate_positions()?;
        self.validate_triangles()?;
        for (quadric, shape) in self.quadrics.iter().enumerate() {
            shape
                .validate()
                .map_err(|fault| BuildError::InvalidQuadric { quadric, fault })?;
        }
        Ok(())
    }

    fn validate_positions(&self) -> Result<(), BuildError> {
        for (vertex, &position) in self.positions.iter().enumerate() {
            if !position.iter().all(|x| x.is_finite()) {
                return Err(BuildError::NonFiniteVertex { vertex, position });
            }
            if position.iter().any(|x| x.abs() > COORDINATE_LIMIT) {
                return Err(BuildError::VertexTooFar { vertex, position });
            }
        }
        Ok(())
    }

    fn validate_triangles(&self) -> Result<(), BuildError> {
        let vertices = self.positions.len();
        for (triangle, indices) in self.triangles.iter().enumerate() {
            if let Some(&vertex) = indices.iter().find(|&&index| index as usize >= vertices) {
                return Err(BuildError::IndexOutOfRange {
                    triangle,
                    vertex,
                    vertices,
                });
            }
        }
        Ok(())
    }

    /// The corners of a triangle.
    pub(crate) fn corners(&self, triangle: usize) -> [[f32; 3]; 3] {
        self.triangles[triangle].map(|vertex| self.positions[vertex as usize])
    }
}

impl Quadric {
    fn validate(&self) -> Result<(), &'static str> {
        match self {
            Self::Sphere {
                center,
                radius,
                ports,
            } => {
                require(is_near(center), "the centre must be finite and within 2^28")?;
                require(
                    is_length(*radius),
                    "the radius must be positive and at most 2^28",
                )?;
                require(
                    ports.iter().all(Cap::is_valid),
                    "a port needs a unit direction and a cosine in -1..=1",
                )
            }
            Self::Disc {
                center,
                normal,
                radius,
                inner_radius,
            } => {
                require(is_near(center), "the centre must be finite and within 2^28")?;
                require(
                    is_direction(normal),
                    "the normal must be finite and not zero",
                )?;
                require(
                    is_length(*radius),
                    "the radius must be positive and at most 2^28",
                )?;
                require(
                    (0.0..*radius).contains(inner_radius),
                    "the inner radius must be at least 0 and below the outer one",
                )
            }
            Self::Plane { point, normal } => {
                require(is_near(point), "the point must be finite and within 2^28")?;
                require(
                    is_direction(normal),
                    "the normal must be finite and not zero",
                )
            }
        }
    }
}

impl Cap {
    fn is_valid(&self) -> bool {
        let length_squared: f64 = self.direction.iter().map(|x| x * x).sum();
        (length_squared - 1.0).abs() < 1e-6 && (-1.0..=1.0).contains(&self.cos_half_angle)
    }
}

fn require(condition: bool, fault: &'static str) -> Result<(), &'static str> {
    if condition { Ok(()) } else { Err(fault) }
}

/// False for NaN too.
fn is_near(point: &[f64; 3]) -> bool {
    point.iter().all(|x| x.abs() <= f64::from(COORDINATE_LIMIT))
}

fn is_length(length: f64) -> bool {
    length > 0.0 && length <= f64::from(COORDINATE_LIMIT)
}

/// Its square neither vanishes nor overflows.
fn is_direction(vector: &[f64; 3]) -> bool {
    let length_squared: f64 = vector.iter().map(|x| x * x).sum();
    length_squared.is_normal()
}
