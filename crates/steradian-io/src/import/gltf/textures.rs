//! Textures: pictures with the way they are laid on surfaces.
//!
//! glTF counts v from the top of a picture, Steradian from the bottom: v = 1 − v_glTF, for the coordinates of vertices
//! and for those in the picture. `KHR_texture_transform` takes coordinates of vertices to those in the picture by
//!
//! u′ = o_u + s_u cosα u + s_v sinα v, v′ = o_v − s_u sinα u + s_v cosα v (v from the top)
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | o_u, o_v | offset | 1 |
//! | s_u, s_v | scale | 1 |
//! | α | rotation, counter-clockwise as seen on the picture | rad |
//!
//! which is what the text of the extension and the exporter of Khronos for Blender say; the shader printed with the
//! extension turns the other way.
//!
//! Pictures of colours are in sRGB, those of numbers are linear. `minFilter` has no meaning for rays.

use std::collections::HashMap;
use std::sync::Arc;

use steradian::material::{Bitmap, Interpolation, Wrap};
use steradian::scene::description::{Pattern, Picture, Placement, Texture};

use super::document::{Document, part};
use super::error::GltfError;
use super::schema::{self, TextureInfo, TextureTransform};
use super::uri::Resources;
use crate::import::image::{self, Encoding};

const NEAREST: u32 = 9728;
const CLAMP_TO_EDGE: u32 = 33_071;
const MIRRORED_REPEAT: u32 = 33_648;

/// More texels than this, in all pictures together, are refused.
const MOST_TEXELS: usize = 1 << 31;

/// Picture, how it is encoded, whether it is read between texels, and how it continues along u and v.
type Key = (usize, Encoding, bool, [u32; 2]);

/// The textures of a file, read when first used.
pub(super) struct Textures<'d> {
    document: &'d Document<'d>,
    resources: &'d Resources<'d>,
    bitmaps: HashMap<Key, Arc<Bitmap>>,
    texels: usize,
}

/// The set of texture coordinates that a texture is laid by.
pub(super) fn coordinate_set(info: &TextureInfo) -> usize {
    let transform = info.extensions.transform.as_ref();
    let overridden = transform.and_then(|transform| transform.tex_coord);
    overridden.unwrap_or(info.tex_coord)
}

impl<'d> Textures<'d> {
    pub fn new(document: &'d Document<'d>, resources: &'d Resources<'d>) -> Self {
        Self {
            document,
            resources,
            bitmaps: HashMap::new(),
            texels: 0,
        }
    }

    /// The texture that `place` names.
    pub fn texture(
        &mut self,
        info: &TextureInfo,
        encoding: Encoding,
        place: &str,
    ) -> Result<Texture, GltfError> {
        Ok(Texture {
            placement: placed(info, place)?,
            pattern: Pattern::Bitmap(self.bitmap(info.index, encoding, place)?),
        })
    }

    /// The channel of a picture of numbers that `place` names.
    pub fn channel(
        &mut self,
        info: &TextureInfo,
        channel: usize,
        place: &str,
    ) -> Result<Picture, GltfError> {
        Ok(Picture {
            placement: placed(info, place)?.0,
            bitmap: self.bitmap(info.index, Encoding::Linear, place)?,
            channel,
        })
    }

    fn bitmap(
        &mut self,
        index: usize,
        encoding: Encoding,
        place: &str,
    ) -> Result<Arc<Bitmap>, GltfError> {
        let root = &self.document.root;
        let texture = part(&root.textures, index, "texture", place)?;
        let place = format!("textures[{index}]");
        let source = texture.source.ok_or_else(|| {
            GltfError::at(
                &place,
                "it names no picture in a format that is read (PNG, JPEG)",
            )
        })?;
        let sampler = texture.sampler;
        let sampler = sampler.map(|sampler| part(&root.samplers, sampler, "sampler", &place));
        let key = key(source, encoding, sampler.transpose()?);
        if let Some(bitmap) = self.bitmaps.get(&key) {
            return Ok(Arc::clone(bitmap));
        }
        let mut bitmap = self.picture(source, encoding, &place)?;
        self.texels += bitmap.texels().len();
        if self.texels > MOST_TEXELS {
            let (what, limit) = ("texels", MOST_TEXELS);
            return Err(GltfError::TooLarge { what, limit });
        }
        bitmap.wrap = key.3.map(wrap);
        bitmap.interpolation = if key.2 {
            Interpolation::Bilinear
        } else {
            Interpolation::Nearest
        };
        let bitmap = Arc::new(bitmap);
        self.bitmaps.insert(key, Arc::clone(&bitmap));
        Ok(bitmap)
    }

    fn picture(&self, index: usize, encoding: Encoding, place: &str) -> Result<Bitmap, GltfError> {
        let named = part(&self.document.root.images, index, "image", place)?;
        let place = format!("images[{index}]");
        let read = |bytes: &[u8]| image::read(bytes, encoding);
        let bitmap = match (&named.uri, named.buffer_view) {
            (_, Some(view)) => read(self.document.view(view, &place)?),
            (Some(uri), None) => read(&self.resources.read(uri, &place)?),
            (None, None) => return Err(GltfError::at(place, "it names no bytes")),
        };
        bitmap.map_err(|source| GltfError::Image { place, source })
    }
}

/// How a texture is laid.
fn placed(info: &TextureInfo, place: &str) -> Result<Placement, GltfError> {
    let transform = info.extensions.transform.as_ref();
    let placement = transform.map(placement).unwrap_or_default();
    let mut entries = placement.0.as_flattened().iter();
    if !entries.all(|entry| entry.is_finite()) {
        let fault = "its KHR_texture_transform is not finite";
        return Err(GltfError::at(place, fault));
    }
    Ok(placement)
}

fn key(image: usize, encoding: Encoding, sampler: Option<&schema::Sampler>) -> Key {
    let Some(sampler) = sampler else {
        return (image, encoding, true, [0; 2]);
    };
    let known = |code: Option<u32>| {
        code.filter(|code| [CLAMP_TO_EDGE, MIRRORED_REPEAT].contains(code))
            .unwrap_or(0)
    };
    let wraps = [sampler.wrap_s, sampler.wrap_t].map(known);
    let between = sampler.mag_filter != Some(NEAREST);
    (image, encoding, between, wraps)
}

fn wrap(code: u32) -> Wrap {
    match code {
        CLAMP_TO_EDGE => Wrap::Clamp,
        MIRRORED_REPEAT => Wrap::Mirror,
        _ => Wrap::Repeat,
    }
}

/// The transform for v from the bottom, before and after.
fn placement(transform: &TextureTransform) -> Placement {
    let [offset_u, offset_v] = transform.offset;
    let [scale_u, scale_v] = transform.scale.unwrap_or([1.0; 2]);
    let (sin, cos) = libm::sincos(transform.rotation);
    Placement([
        [scale_u * cos, -scale_v * sin, offset_u + scale_v * sin],
        [scale_u * sin, scale_v * cos, 1.0 - offset_v - scale_v * cos],
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_turned_transform_is_that_of_the_format(
            offset in prop::array::uniform2(-2.0..2.0_f64), scale in prop::array::uniform2(-2.0..2.0_f64),
            rotation in -4.0..4.0_f64, (u, v) in (-2.0..2.0_f64, -2.0..2.0_f64),
        ) {
            let transform = TextureTransform { offset, rotation, scale: Some(scale), tex_coord: None };
            let [found_u, found_v] = placement(&transform).at([u, 1.0 - v]);
            let (sin, cos) = libm::sincos(rotation);
            let (x, y) = (scale[0] * u, scale[1] * v);
            prop_assert!((found_u - (offset[0] + cos * x + sin * y)).abs() < 1e-13);
            prop_assert!((1.0 - found_v - (offset[1] - sin * x + cos * y)).abs() < 1e-13);
        }
    }
}
