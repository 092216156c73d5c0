//! The luminous opening of a luminaire: where light leaves it.
//!
//! Lengths are in metres along the axes of the luminaire: +x is C0, +y is C90 and its light goes to −z. An opening is centred on
//! the luminaire's position and shines from all of its surface, a flat one to both sides.

/// A luminous opening; lengths in metres.
#[derive(Copy, Clone, Debug, Default, PartialEq)]
pub enum Opening {
    /// Smaller than the file says.
    #[default]
    Point,
    /// A box of light; a rectangle that faces down if it has no height.
    Box {
        /// Along C90.
        width: f64,
        /// Along C0.
        length: f64,
        /// Upwards.
        height: f64,
    },
    /// An upright cylinder; an ellipse that faces down if it has no height.
    Upright {
        /// Diameter along C90.
        width: f64,
        /// Diameter along C0.
        length: f64,
        /// Upwards.
        height: f64,
    },
    /// A lying cylinder.
    Lying {
        /// Whether its axis is along C0, not C90.
        along_c0: bool,
        /// Length of the axis.
        length: f64,
        /// Diameter of the ends.
        diameter: f64,
    },
    /// An ellipsoid.
    Ellipsoid {
        /// Diameters along C90, C0 and upwards.
        diameters: [f64; 3],
    },
}

impl Opening {
    /// Whether light can leave it towards below: what is but a line or an upright sheet has no surface that faces there.
    pub fn has_area(&self) -> bool {
        match *self {
            Self::Point => false,
            Self::Box { width, length, .. } | Self::Upright { width, length, .. } => {
                width > 0.0 && length > 0.0
            }
            Self::Lying {
                length, diameter, ..
            } => length > 0.0 && diameter > 0.0,
            Self::Ellipsoid { diameters } => diameters.iter().all(|diameter| *diameter > 0.0),
        }
    }

    /// Whether all lengths are finite and not negative.
    pub fn is_valid(&self) -> bool {
        let lengths = match *self {
            Self::Point => [0.0; 3],
            Self::Box {
                width,
                length,
                height,
            }
            | Self::Upright {
                width,
                length,
                height,
            } => [width, length, height],
            Self::Lying {
                length, diameter, ..
            } => [length, diameter, 0.0],
            Self::Ellipsoid { diameters } => diameters,
        };
        lengths
            .iter()
            .all(|length| length.is_finite() && *length >= 0.0)
    }
}
