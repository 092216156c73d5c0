//! Lanes that vary over a surface and with the wavelength.
//!
//! A [`Tint`] at a point is factor × curve(λ) × Π textures. What a texture shows is an RGB colour; [`ColorLanes`] says
//! what that is in the lanes of the run: itself in `rgb`, the grey value in `broadband`, and in `spectral` the smooth
//! reflectance of that colour (Jakob & Hanika 2019) at the path's wavelengths.

use std::sync::Arc;

use super::{Bitmap, Picture};
use crate::spectrum::{
    BakedCurve, Curve, CurveId, Grid, Lanes, MAX_LANES, UpsamplingTable, Wavelengths, sigmoid_at,
};

/// Lanes that do not vary over the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Hue {
    /// Where the curve is 1.
    pub lanes: [f32; MAX_LANES],
    /// Multiplied at the path's wavelengths.
    pub curve: Option<CurveId>,
}

/// Lanes at a point of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Tint {
    /// Where all textures are 1.
    pub hue: Hue,
    /// Multiplied together.
    pub textures: Vec<Texture>,
}

impl Tint {
    /// Whether it is the same everywhere and at every wavelength.
    pub fn is_constant(&self) -> bool {
        self.hue.curve.is_none() && self.textures.is_empty()
    }
}

/// A pattern laid on a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// What is laid.
    pub pattern: Pattern,
    /// Row i gives coordinate i of the pattern as row · (u, v, 1).
    pub placement: [[f64; 3]; 2],
}

/// What a texture shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// A picture.
    Bitmap(Arc<Bitmap>),
    /// Squares of one unit: the first where ⌊u⌋ + ⌊v⌋ is even.
    Checkerboard([Hue; 2]),
    /// Colour and alpha of the mesh's vertices.
    VertexColor,
}

/// What a surface knows of a point on it.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Site {
    /// Texture coordinates.
    pub coordinates: [f32; 2],
    /// Linear Rec.709 and alpha of the vertices.
    pub color: [f32; 4],
    /// The normal of the vertices on the side of the front, not of unit length; zero if they have none.
    pub normal: [f32; 3],
}

impl Site {
    /// Of what has no surface, and so no texture.
    pub const NOWHERE: Self = Self {
        coordinates: [0.0; 2],
        color: [1.0; 4],
        normal: [0.0; 3],
    };
}

impl Texture {
    /// A picture over the unit square.
    pub fn whole(picture: &Arc<Bitmap>) -> Self {
        Self {
            pattern: Pattern::Bitmap(Arc::clone(picture)),
            placement: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        }
    }

    /// Its picture, if it is one.
    pub fn picture(&self) -> Option<Picture> {
        match &self.pattern {
            Pattern::Bitmap(bitmap) => Some(Picture {
                bitmap: Arc::clone(bitmap),
                placement: self.placement,
                channel: 0,
            }),
            Pattern::Checkerboard(_) | Pattern::VertexColor => None,
        }
    }

    fn place(&self, site: &Site) -> [f64; 2] {
        let [u, v] = site.coordinates.map(f64::from);
        self.placement.map(|[a, b, c]| a * u + b * v + c)
    }

    /// Alpha at a point.
    pub fn alpha(&self, site: &Site) -> f32 {
        match &self.pattern {
            Pattern::Bitmap(bitmap) => bitmap.at(self.place(site))[3],
            Pattern::Checkerboard(_) => 1.0,
            Pattern::VertexColor => site.color[3],
        }
    }

    fn shows<'a>(&'a self, site: &Site) -> Shown<'a> {
        match &self.pattern {
            Pattern::Bitmap(bitmap) => {
                let [r, g, b, _] = bitmap.at(self.place(site));
                Shown::Rgb([r, g, b])
            }
            Pattern::Checkerboard(hues) => {
                let [u, v] = self.place(site);
                let odd = (u.floor() + v.floor()).rem_euclid(2.0) >= 1.0;
                Shown::Hue(&hues[usize::from(odd)])
            }
            Pattern::VertexColor => {
                let [r, g, b, _] = site.color;
                Shown::Rgb([r, g, b])
            }
        }
    }
}

enum Shown<'a> {
    Rgb([f32; 3]),
    Hue(&'a Hue),
}

/// What colours and curves are in the lanes of a run.
pub enum ColorLanes {
    /// Themselves.
    Rgb,
    /// The grey value in every band.
    Grey,
    /// Smooth reflectances and curves at a path's wavelengths.
    Spectral {
        /// Curves by number.
        curves: Vec<BakedCurve>,
        /// Wavelengths of the run.
        grid: Grid,
    },
}

impl ColorLanes {
    /// For these lanes, with curves by number.
    pub fn new(lanes: &Lanes, curves: &[Arc<Curve>]) -> Self {
        match lanes.grid() {
            Some(grid) => Self::Spectral {
                curves: curves.iter().map(|curve| grid.bake(curve)).collect(),
                grid: *grid,
            },
            None if lanes.is_rgb() => Self::Rgb,
            None => Self::Grey,
        }
    }

    /// The tint at a point for a path of these wavelengths.
    pub fn tint(&self, tint: &Tint, site: &Site, wavelengths: &Wavelengths) -> [f32; MAX_LANES] {
        let start = self.hue(&tint.hue, wavelengths);
        tint.textures.iter().fold(start, |product, texture| {
            let lanes = match texture.shows(site) {
                Shown::Rgb(rgb) => self.rgb(rgb, wavelengths),
                Shown::Hue(hue) => self.hue(hue, wavelengths),
            };
            std::array::from_fn(|lane| product[lane] * lanes[lane])
        })
    }

    /// A hue at these wavelengths.
    #[inline]
    pub fn hue(&self, hue: &Hue, wavelengths: &Wavelengths) -> [f32; MAX_LANES] {
        match (self, hue.curve) {
            (Self::Spectral { curves, .. }, Some(curve)) => {
                let curve = &curves[curve.0 as usize];
                std::array::from_fn(|lane| hue.lanes[lane] * curve.at(wavelengths.places[lane]))
            }
            _ => hue.lanes,
        }
    }

    fn rgb(&self, [r, g, b]: [f32; 3], wavelengths: &Wavelengths) -> [f32; MAX_LANES] {
        match self {
            Self::Rgb => [r, g, b, 0.0],
            Self::Grey => [r; MAX_LANES],
            Self::Spectral { grid, .. } => {
                // Emission may exceed 1, which no reflectance does.
                let greatest = r.max(g).max(b).max(1.0);
                let table = UpsamplingTable::shared();
                let coefficients = table.coefficients([r, g, b].map(|x| x / greatest));
                wavelengths.places.map(|place| {
                    greatest * sigmoid_at(coefficients, grid.wavelength(f64::from(place)) as f32)
                })
            }
        }
    }
}
