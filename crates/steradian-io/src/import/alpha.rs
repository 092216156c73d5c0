//! Opacity from pictures, which hold it as alpha or as grey.

use steradian::material::{Bitmap, BitmapError, Texels};

/// The picture as one of opacity: where its alpha is 1 throughout, the mean of red, green and blue becomes its alpha.
///
/// # Errors
/// None that a picture's own texels could cause.
pub fn as_opacity(picture: Bitmap) -> Result<Bitmap, BitmapError> {
    let texels = match picture.texels() {
        Texels::Srgb8(texels) | Texels::Linear8(texels) => {
            from_grey(texels, u8::MAX, mean_8).map(Texels::Linear8)
        }
        Texels::Srgb16(texels) | Texels::Linear16(texels) => {
            from_grey(texels, u16::MAX, mean_16).map(Texels::Linear16)
        }
        Texels::Float(texels) => from_grey(texels, 1.0, mean).map(Texels::Float),
    };
    let Some(texels) = texels else {
        return Ok(picture);
    };
    let [width, height] = picture.size();
    let mut opacity = Bitmap::new(width, height, texels)?;
    opacity.wrap = picture.wrap;
    opacity.interpolation = picture.interpolation;
    Ok(opacity)
}

/// White texels with the mean as their alpha; `None` if there is alpha already.
fn from_grey<C: Copy + PartialEq>(
    texels: &[[C; 4]],
    opaque: C,
    mean: impl Fn([C; 3]) -> C,
) -> Option<Vec<[C; 4]>> {
    let is_opaque = texels.iter().all(|texel| texel[3] == opaque);
    let white = |[red, green, blue, _]: &[C; 4]| {
        let alpha = mean([*red, *green, *blue]);
        [opaque, opaque, opaque, alpha]
    };
    is_opaque.then(|| texels.iter().map(white).collect())
}

fn mean_8(codes: [u8; 3]) -> u8 {
    (codes.map(u16::from).iter().sum::<u16>() / 3) as u8
}

fn mean_16(codes: [u16; 3]) -> u16 {
    (codes.map(u32::from).iter().sum::<u32>() / 3) as u16
}

/// Opacity is at most 1.
fn mean([red, green, blue]: [f32; 3]) -> f32 {
    ((red + green + blue) / 3.0).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn alphas(texels: Texels) -> [f32; 2] {
        let picture = as_opacity(Bitmap::new(2, 1, texels).unwrap()).unwrap();
        [0, 1].map(|index| picture.texels().at(index)[3])
    }

    #[test]
    fn alpha_counts_where_there_is_one_and_grey_else() {
        assert_eq!(
            alphas(Texels::Srgb8(vec![[9, 9, 9, 255], [0, 0, 0, 51]])),
            [1.0, 0.2]
        );
        assert_eq!(
            alphas(Texels::Srgb8(vec![[51, 51, 51, 255], [255, 0, 0, 255]])),
            [0.2, 1.0 / 3.0]
        );
        assert_eq!(
            alphas(Texels::Linear16(vec![[65_535; 4], [0, 0, 0, 65_535]])),
            [1.0, 0.0]
        );
        assert_eq!(
            alphas(Texels::Float(vec![
                [0.5, 0.5, 0.5, 1.0],
                [7.0, 7.0, 7.0, 1.0]
            ])),
            [0.5, 1.0]
        );
    }
}
