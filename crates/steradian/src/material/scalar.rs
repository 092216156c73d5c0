//! Numbers that may vary over a surface, such as a roughness.

use std::sync::Arc;

use super::{Bitmap, Site};

/// A number at a point of a surface: `factor` times what the picture says there.
#[derive(Clone, Debug, PartialEq)]
pub struct Scalar {
    /// Where the picture is 1.
    pub factor: f64,
    /// None for a constant.
    pub picture: Option<Picture>,
}

/// One channel of a picture, laid on a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Of linear numbers.
    pub bitmap: Arc<Bitmap>,
    /// Row i gives coordinate i of the picture as row · (u, v, 1).
    pub placement: [[f64; 3]; 2],
    /// Red 0, green 1, blue 2, alpha 3.
    pub channel: usize,
}

impl From<f64> for Scalar {
    fn from(factor: f64) -> Self {
        Self {
            factor,
            picture: None,
        }
    }
}

impl Scalar {
    /// The number at a point.
    pub fn at(&self, site: &Site) -> f64 {
        let picture = self.picture.as_ref();
        self.factor * picture.map_or(1.0, |picture| picture.at(site))
    }
}

impl Picture {
    fn at(&self, site: &Site) -> f64 {
        f64::from(self.bitmap.at(self.place(site))[self.channel.min(3)])
    }

    fn place(&self, site: &Site) -> [f64; 2] {
        let [u, v] = site.coordinates.map(f64::from);
        self.placement.map(|[a, b, c]| a * u + b * v + c)
    }

    /// Has the texels fetched that will be asked for at a point.
    pub fn fetch_ahead(&self, site: &Site) {
        self.bitmap.fetch_ahead(self.place(site));
    }

    /// Whether it shows the same bitmap at the same places.
    pub fn is_laid_like(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.bitmap, &other.bitmap) && self.placement == other.placement
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Texels;

    #[test]
    fn a_channel_of_the_picture_multiplies_the_factor() {
        let bitmap = Bitmap::new(1, 1, Texels::Linear8(vec![[0, 51, 102, 255]])).unwrap();
        let picture = Picture {
            bitmap: Arc::new(bitmap),
            placement: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            channel: 1,
        };
        let roughness = Scalar {
            factor: 0.5,
            picture: Some(picture),
        };
        assert!((roughness.at(&Site::NOWHERE) - 0.1).abs() < 1e-8);
        assert_eq!(Scalar::from(0.7).at(&Site::NOWHERE), 0.7);
    }
}
