//! Opacity from pictures, which hold it as alpha or as grey.

use steradian::material::{Bitmap, BitmapError, Texels};

/// The picture as one of opacity: unless its alpha varies or is below 1, the mean of red, green and blue is its alpha.
///
/// # Errors
/// None that a picture's own texels could cause.
pub fn as_opacity(picture: Bitmap) -> Result<Bitmap, BitmapError> {
    let has_alpha = match picture.texels() {
        Texels::Srgb8(texels) | Texels::Linear8(texels) => {
            texels.iter().any(|texel| texel[3] != u8::MAX)
        }
        Texels::Srgb16(texels) | Texels::Linear16(texels) => {
            texels.iter().any(|texel| texel[3] != u16::MAX)
        }
        Texels::Float(texels) => texels.iter().any(|texel| texel[3] != 1.0),
    };
    if has_alpha {
        return Ok(picture);
    }
    let texels = match picture.texels() {
        Texels::Srgb8(texels) | Texels::Linear8(texels) => Texels::Linear8(
            texels
                .iter()
                .map(|texel| {
                    let sum: u16 = texel[..3].iter().map(|code| u16::from(*code)).sum();
                    [u8::MAX, u8::MAX, u8::MAX, (sum / 3) as u8]
                })
                .collect(),
        ),
        Texels::Srgb16(texels) | Texels::Linear16(texels) => Texels::Linear16(
            texels
                .iter()
                .map(|texel| {
                    let sum: u32 = texel[..3].iter().map(|code| u32::from(*code)).sum();
                    [u16::MAX, u16::MAX, u16::MAX, (sum / 3) as u16]
                })
                .collect(),
        ),
        Texels::Float(texels) => Texels::Float(
            texels
                .iter()
                .map(|[red, green, blue, _]| [1.0, 1.0, 1.0, ((red + green + blue) / 3.0).min(1.0)])
                .collect(),
        ),
    };
    let [width, height] = picture.size();
    let mut opacity = Bitmap::new(width, height, texels)?;
    opacity.wrap = picture.wrap;
    opacity.interpolation = picture.interpolation;
    Ok(opacity)
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
