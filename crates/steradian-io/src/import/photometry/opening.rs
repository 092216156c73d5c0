//! The luminous opening of a luminaire: where light leaves it.
//!
//! LM-63 codes its shape in the signs of three dimensions: width along C90, length along C0, height. A negative number is the
//! diameter of something round, zero is nothing. Source: ANSI/IES LM-63-02 and LM-63-19, table 1.
//!
//! | width | length | height | shape |
//! |---|---|---|---|
//! | 0 | 0 | 0 | point |
//! | + | + | 0, + | rectangle, box |
//! | − | 0, − | 0 | disc, ellipse |
//! | − | 0, − | + | upright cylinder |
//! | −, 0 | + | − | lying cylinder along C0 |
//! | + | −, 0 | − | lying cylinder along C90 |
//! | − | − | − | sphere or ellipsoid |

/// A luminous opening; lengths in metres.
#[derive(Copy, Clone, Debug, PartialEq)]
pub enum Opening {
    /// Smaller than the file says.
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
    /// From the three coded dimensions, scaled to metres; `None` for signs that mean nothing.
    pub(super) fn from_codes(codes: [f64; 3], metres: f64) -> Option<Self> {
        let [width, length, height] = codes.map(|code| code.abs() * metres);
        let signs = codes.map(|code: f64| i32::from(code > 0.0) - i32::from(code < 0.0));
        // A diameter that is given once holds across too.
        let other = |size: f64, instead: f64| if size == 0.0 { instead } else { size };
        Some(match signs {
            [0, 0, 0] => Self::Point,
            [0 | 1, 0 | 1, 0 | 1] => Self::Box {
                width,
                length,
                height,
            },
            [-1, 0 | -1, 0 | 1] => Self::Upright {
                width,
                length: other(length, width),
                height,
            },
            [0, -1, 0 | 1] => Self::Upright {
                width: length,
                length,
                height,
            },
            [0 | -1, 1, -1] => Self::Lying {
                along_c0: true,
                length,
                diameter: height,
            },
            [1, 0 | -1, -1] => Self::Lying {
                along_c0: false,
                length: width,
                diameter: height,
            },
            [-1, -1, -1] => Self::Ellipsoid {
                diameters: [width, length, height],
            },
            [-1, 0, -1] => Self::Ellipsoid {
                diameters: [width, width, height],
            },
            _ => return None,
        })
    }
}
