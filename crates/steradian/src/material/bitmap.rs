//! Pictures on surfaces: texels in linear light, looked up by texture coordinates.
//!
//! Texture coordinates (u, v) run from (0, 0) at the lower left corner of the picture to (1, 1) at the upper right one;
//! rows are stored from the top, as image files have them. Texel (i, j) covers [i, i + 1) / width × [j, j + 1) / height
//! from the top left. `Nearest` gives the texel that holds the place; `Bilinear` interpolates between texel centres, in
//! linear light.
//!
//! sRGB transfer function: IEC 61966-2-1:1999, equations 5 and 6.

use std::sync::LazyLock;

use steradian_kernel::prefetch;
use thiserror::Error;

/// Texels: red, green, blue, alpha. Alpha is linear in every encoding.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// 8 bits a channel, colour encoded by sRGB.
    Srgb8(Vec<[u8; 4]>),
    /// 8 bits a channel, linear.
    Linear8(Vec<[u8; 4]>),
    /// 16 bits a channel, colour encoded by sRGB.
    Srgb16(Vec<[u16; 4]>),
    /// 16 bits a channel, linear.
    Linear16(Vec<[u16; 4]>),
    /// Linear numbers.
    Float(Vec<[f32; 4]>),
}

impl Texels {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Srgb8(texels) | Self::Linear8(texels) => texels.len(),
            Self::Srgb16(texels) | Self::Linear16(texels) => texels.len(),
            Self::Float(texels) => texels.len(),
        }
    }

    /// Has a texel fetched that will be asked for soon.
    #[inline]
    fn fetch_ahead(&self, index: usize) {
        match self {
            Self::Srgb8(texels) | Self::Linear8(texels) => prefetch(&texels[index]),
            Self::Srgb16(texels) | Self::Linear16(texels) => prefetch(&texels[index]),
            Self::Float(texels) => prefetch(&texels[index]),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Linear red, green, blue, alpha of a texel.
    #[inline]
    pub fn at(&self, index: usize) -> [f32; 4] {
        match self {
            Self::Srgb8(texels) => {
                let [r, g, b, a] = texels[index];
                let [r, g, b] = [r, g, b].map(|code| SRGB[usize::from(code)]);
                [r, g, b, f32::from(a) / 255.0]
            }
            Self::Linear8(texels) => texels[index].map(|code| f32::from(code) / 255.0),
            Self::Srgb16(texels) => {
                let [r, g, b, a] = texels[index];
                let [r, g, b] = [r, g, b].map(|code| SRGB_16[usize::from(code)]);
                [r, g, b, (f64::from(a) / 65_535.0) as f32]
            }
            Self::Linear16(texels) => texels[index].map(|code| f32::from(code) / 65_535.0),
            Self::Float(texels) => texels[index],
        }
    }
}

/// Linear values of the 256 codes of sRGB.
static SRGB: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|code| linear_from_srgb(code as f64 / 255.0) as f32));

/// The same of the 65 536 codes of 16 bits.
static SRGB_16: LazyLock<Vec<f32>> = LazyLock::new(|| {
    let linear = |code: u16| linear_from_srgb(f64::from(code) / 65_535.0) as f32;
    (0..=u16::MAX).map(linear).collect()
});

/// The inverse of the sRGB transfer function, 0 to 1.
///
/// ```
/// # use steradian::material::linear_from_srgb;
/// assert_eq!(linear_from_srgb(1.0), 1.0);
/// assert!((linear_from_srgb(0.5) - 0.214_041_14).abs() < 1e-8);
/// ```
pub fn linear_from_srgb(encoded: f64) -> f64 {
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        libm::pow((encoded + 0.055) / 1.055, 2.4)
    }
}

/// How a picture continues beyond its edge.
#[derive(Copy, Clone, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// Again and again.
    #[default]
    Repeat,
    /// Every other time mirrored.
    Mirror,
    /// With the colour of the edge.
    Clamp,
}

impl Wrap {
    /// The texel of a row of `count` that stands for a number outside it.
    #[inline]
    fn index(self, texel: i64, count: i64) -> usize {
        let index = match self {
            Self::Repeat => texel.rem_euclid(count),
            Self::Clamp => texel.clamp(0, count - 1),
            Self::Mirror => {
                let turn = texel.rem_euclid(2 * count);
                turn.min(2 * count - 1 - turn)
            }
        };
        index as usize
    }
}

/// How a picture is read between its texels.
#[derive(Copy, Clone, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// The texel that holds the place.
    Nearest,
    /// Weighted by the distance from the four nearest texel centres.
    #[default]
    Bilinear,
}

/// Why texels are no picture.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BitmapError {
    /// Another number of texels than the size says.
    #[error("a picture of {width} x {height} has {} texels, not {found}", u64::from(*width) * u64::from(*height))]
    Size {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// Texels that were given.
        found: usize,
    },
    /// Nothing to look up.
    #[error("a picture has one texel or more")]
    Empty,
    /// A number that is no colour.
    #[error("texel {0} is not finite or negative")]
    Texel(usize),
}

/// A picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Bitmap {
    width: u32,
    height: u32,
    texels: Texels,
    /// Along u, and along v.
    pub wrap: [Wrap; 2],
    /// Between texels.
    pub interpolation: Interpolation,
}

impl Bitmap {
    /// Rows from the top; repeated, and bilinear.
    ///
    /// # Errors
    /// If the texels do not fill the picture, or are not finite or negative.
    pub fn new(width: u32, height: u32, texels: Texels) -> Result<Self, BitmapError> {
        let found = texels.len();
        if found == 0 {
            return Err(BitmapError::Empty);
        }
        if u64::from(width) * u64::from(height) != found as u64 {
            return Err(BitmapError::Size {
                width,
                height,
                found,
            });
        }
        if let Texels::Float(floats) = &texels {
            let bad = |texel: &[f32; 4]| texel.iter().any(|x| !x.is_finite() || *x < 0.0);
            if let Some(index) = floats.iter().position(bad) {
                return Err(BitmapError::Texel(index));
            }
        }
        Ok(Self {
            width,
            height,
            texels,
            wrap: [Wrap::default(); 2],
            interpolation: Interpolation::default(),
        })
    }

    /// Columns and rows.
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// The texels, row by row from the top.
    pub fn texels(&self) -> &Texels {
        &self.texels
    }

    /// Linear red, green, blue, alpha at texture coordinates.
    pub fn at(&self, [u, v]: [f64; 2]) -> [f32; 4] {
        let x = u * f64::from(self.width);
        let y = (1.0 - v) * f64::from(self.height);
        match self.interpolation {
            Interpolation::Nearest => self.texel(x.floor() as i64, y.floor() as i64),
            Interpolation::Bilinear => self.between(x - 0.5, y - 0.5),
        }
    }

    /// Has the texels fetched that [`at`](Self::at) will ask for, in most places all of them.
    pub fn fetch_ahead(&self, [u, v]: [f64; 2]) {
        let x = (u * f64::from(self.width) - 0.5).floor() as i64;
        let y = ((1.0 - v) * f64::from(self.height) - 0.5).floor() as i64;
        for row in [y, y.saturating_add(1)] {
            self.texels.fetch_ahead(self.index(x, row));
        }
    }

    fn between(&self, x: f64, y: f64) -> [f32; 4] {
        let (left, top) = (x.floor(), y.floor());
        let (s, t) = ((x - left) as f32, (y - top) as f32);
        let (i, j) = (left as i64, top as i64);
        let corner = |di: i64, dj: i64| self.texel(i.saturating_add(di), j.saturating_add(dj));
        let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)];
        std::array::from_fn(|k| {
            let (upper, lower) = (a[k] + (b[k] - a[k]) * s, c[k] + (d[k] - c[k]) * s);
            upper + (lower - upper) * t
        })
    }

    fn texel(&self, i: i64, j: i64) -> [f32; 4] {
        self.texels.at(self.index(i, j))
    }

    fn index(&self, i: i64, j: i64) -> usize {
        let column = self.wrap[0].index(i, i64::from(self.width));
        let row = self.wrap[1].index(j, i64::from(self.height));
        row * self.width as usize + column
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two columns, two rows: 1 2 / 3 4 from the top.
    fn square(wrap: Wrap, interpolation: Interpolation) -> Bitmap {
        let texels = [1.0, 2.0, 3.0, 4.0].map(|x| [x, 0.0, 0.0, 1.0]);
        let bitmap = Bitmap::new(2, 2, Texels::Float(texels.to_vec())).unwrap();
        Bitmap {
            wrap: [wrap; 2],
            interpolation,
            ..bitmap
        }
    }

    #[test]
    fn rows_run_from_the_top_and_v_from_the_bottom() {
        let bitmap = square(Wrap::Repeat, Interpolation::Nearest);
        let red = |u, v| bitmap.at([u, v])[0];
        assert_eq!([red(0.25, 0.75), red(0.75, 0.75)], [1.0, 2.0]);
        assert_eq!([red(0.25, 0.25), red(0.75, 0.25)], [3.0, 4.0]);
        assert_eq!([red(1.25, 1.75), red(-0.25, -0.75)], [1.0, 4.0]);
    }

    #[test]
    fn edges_repeat_mirror_or_stay() {
        let red = |wrap, u| square(wrap, Interpolation::Nearest).at([u, 0.75])[0];
        assert_eq!(
            [red(Wrap::Mirror, 1.25), red(Wrap::Mirror, 1.75)],
            [2.0, 1.0]
        );
        assert_eq!([red(Wrap::Clamp, 7.0), red(Wrap::Clamp, -7.0)], [2.0, 1.0]);
        assert_eq!(red(Wrap::Mirror, -0.25), 1.0);
    }

    #[test]
    fn bilinear_meets_the_centres_and_is_linear_between() {
        let bitmap = square(Wrap::Clamp, Interpolation::Bilinear);
        assert_eq!(bitmap.at([0.25, 0.75]), [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(bitmap.at([0.5, 0.5])[0], 2.5);
        assert_eq!(bitmap.at([0.5, 0.75])[0], 1.5);
    }

    #[test]
    fn encodings_are_made_linear() {
        let one = |texels| Bitmap::new(1, 1, texels).unwrap().at([0.5, 0.5]);
        let eight = one(Texels::Srgb8(vec![[188, 0, 255, 128]]));
        // 188/255 encodes ((.737255 + .055)/1.055)^2.4 = .502886.
        assert!((eight[0] - 0.502_886).abs() < 1e-6 && eight[2] == 1.0);
        assert!((eight[3] - 128.0 / 255.0).abs() < 1e-7);
        let sixteen = one(Texels::Srgb16(vec![[188 * 257, 0, 65_535, 128 * 257]]));
        assert!(eight.iter().zip(sixteen).all(|(a, b)| (a - b).abs() < 1e-6));
        assert_eq!(one(Texels::Linear8(vec![[51, 0, 255, 255]]))[0], 0.2);
        assert_eq!(
            one(Texels::Linear16(vec![[0, 65_535, 0, 0]])),
            [0.0, 1.0, 0.0, 0.0]
        );
    }

    #[test]
    fn texels_fill_the_picture_and_are_numbers() {
        let new = |width, height, texels| Bitmap::new(width, height, texels).unwrap_err();
        let size = new(2, 3, Texels::Linear8(vec![[0; 4]; 5]));
        assert_eq!(size.to_string(), "a picture of 2 x 3 has 6 texels, not 5");
        assert_eq!(new(0, 7, Texels::Linear8(vec![])), BitmapError::Empty);
        let nan = vec![[0.0; 4], [0.0, f32::NAN, 0.0, 1.0]];
        assert_eq!(new(2, 1, Texels::Float(nan)), BitmapError::Texel(1));
    }
}
