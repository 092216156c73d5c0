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

pub use steradian::light::Opening;

/// From the three coded dimensions, scaled to metres; `None` for signs that mean nothing.
pub(super) fn from_codes(codes: [f64; 3], metres: f64) -> Option<Opening> {
    let [width, length, height] = codes.map(|code| code.abs() * metres);
    let signs = codes.map(|code: f64| i32::from(code > 0.0) - i32::from(code < 0.0));
    // A diameter that is given once holds across too.
    let other = |size: f64, instead: f64| if size == 0.0 { instead } else { size };
    Some(match signs {
        [0, 0, 0] => Opening::Point,
        [0 | 1, 0 | 1, 0 | 1] => Opening::Box {
            width,
            length,
            height,
        },
        [-1, 0 | -1, 0 | 1] => Opening::Upright {
            width,
            length: other(length, width),
            height,
        },
        [0, -1, 0 | 1] => Opening::Upright {
            width: length,
            length,
            height,
        },
        [0 | -1, 1, -1] => Opening::Lying {
            along_c0: true,
            length,
            diameter: height,
        },
        [1, 0 | -1, -1] => Opening::Lying {
            along_c0: false,
            length: width,
            diameter: height,
        },
        [-1, -1, -1] => Opening::Ellipsoid {
            diameters: [width, length, height],
        },
        [-1, 0, -1] => Opening::Ellipsoid {
            diameters: [width, width, height],
        },
        _ => return None,
    })
}
