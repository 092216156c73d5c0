//! Sensors: what is asked of a scene.
//!
//! | sensor | law | unit |
//! |---|---|---|
//! | irradiance | E = ∫ L cosθ dω over the hemisphere of the normal | W/m² or lx |
//! | flux | Φ = ∫ E dA over a surface | W or lm |
//! | radiance | L along a ray | W/(m² sr) or cd/m² |
//! | scalar irradiance | E₀ = ∫ L dω over the sphere | W/m² or lx |
//! | cylindrical irradiance | E_z = (1/π) ∫ L sinε dω, ε from the axis | W/m² or lx |
//! | semicylindrical irradiance | E_sc = (1/π) ∫ L sinε (1 + cosα) dω, α about the axis from where it faces | W/m² or lx |
//!
//! A sensor of any kind sees every light: lights without extent by the inverse-square law, all others by sampling.

mod balance;
mod camera;
mod layout;
mod places;
pub(crate) mod readout;

pub use balance::{Account, Entry, Term};
pub use camera::{Camera, Fisheye, Projection, Sight};
pub use layout::Layout;
pub(crate) use layout::greatest_spacing;
pub use places::Places;
pub use readout::{Bins, Readout, Response, readouts};

use serde::{Deserialize, Serialize};

use crate::geometry::{Direction, Point};
use crate::shape::{Form, ShapeId};

/// The surface a receiver lies on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SitsOn {
    /// Name (or kind and number) of the shape.
    pub shape: String,
    /// `front` or `back`.
    pub side: String,
}

/// A point with a normal.
#[derive(Clone, Debug, PartialEq)]
pub struct Receiver {
    /// Where.
    pub position: Point,
    /// Its normal.
    pub normal: Direction,
    /// The surface it lies on, if any.
    pub sits_on: Option<SitsOn>,
    /// Distance to keep from that surface so that rays do not meet it, in metres.
    pub clearance: f64,
}

/// A small upright cylinder, or the half of it that faces a direction; its ends do not count.
#[derive(Clone, Debug, PartialEq)]
pub struct Cylinder {
    /// Where.
    pub position: Point,
    /// Its axis.
    pub axis: Direction,
    /// What the half of it faces, across the axis; none for the whole cylinder.
    pub facing: Option<Direction>,
    /// Distance along the axis to keep from the surface that it stands on, in metres.
    pub clearance: f64,
}

/// Which flux is counted.
#[derive(Copy, Clone, Debug, Default, PartialEq, Eq)]
pub enum FluxOf {
    /// What arrives.
    #[default]
    Incident,
    /// What leaves: emitted and reflected (or, for a surface that does not block light, what passes the other way).
    Leaving,
    /// What arrives and is not reflected (shapes only).
    Absorbed,
    /// Incident minus leaving.
    Net,
    /// What the surface gives of its own (shapes only).
    Emitted,
}

/// The surface of a flux sensor.
#[derive(Clone, Debug)]
pub enum FluxSurface {
    /// A side of shapes of the scene (all copies of a repeat).
    Shapes {
        /// The shapes.
        shapes: Vec<ShapeId>,
        /// The front, or the back.
        front: bool,
    },
    /// A surface that does not block light, counted on its front.
    Virtual(Form),
}

/// A prepared sensor.
#[derive(Clone, Debug)]
pub struct Sensor {
    /// Its name.
    pub name: String,
    /// What it reports.
    pub readouts: Vec<Readout>,
    /// How its points lie side by side, if they are a grid.
    pub layout: Option<Layout>,
    /// What it measures.
    pub kind: Kind,
}

/// The closed set of sensors.
#[derive(Clone, Debug)]
pub enum Kind {
    /// Irradiance at points; the scene tells what they lie on.
    Irradiance(Places),
    /// Scalar irradiance at points.
    ScalarIrradiance(Vec<Point>),
    /// Cylindrical or semicylindrical irradiance at points.
    Cylindrical(Vec<Cylinder>),
    /// Radiance along rays.
    Radiance(Vec<(Point, Direction)>),
    /// Flux of a surface.
    Flux {
        /// The surface.
        surface: FluxSurface,
        /// Its area in m².
        area: f64,
        /// What is counted.
        of: FluxOf,
    },
    /// A picture.
    Camera(Camera),
    /// A side of the energy balance.
    Balance(Vec<Account>),
}
