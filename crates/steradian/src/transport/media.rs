//! Media: what absorbs light on its way between surfaces.
//!
//! L(s) = L(0) exp(−a s), the law of Bouguer, for each lane.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | a | absorption coefficient | 1/m |
//! | s | way through the medium | m |
//!
//! A path knows the medium that it is in: air, which absorbs nothing, where it leaves a sensor; behind an interface that
//! it crosses what the interface's material names for that side. Reflection, masks and panes leave the medium as it is,
//! and so do materials that name none. A sensor inside a medium takes it for air until the first interface, the last way to a point or a camera of
//! light that is [traced from its source](super::light_tracing) included; what such light loses before it lands on a flux surface, or passes one, is
//! absorbed if it has come through an interface. Ways begin where rays do, a few millionths of the size of a surface off it.
//!
//! Source: P. Bouguer, *Essai d'optique* (1729); S. Chandrasekhar, *Radiative Transfer* (1960), §7.

use super::tables::{Lanes4, Tables};
use crate::material::{Hue, Media};
use crate::spectrum::Wavelengths;

/// The number of the medium that absorbs nothing.
pub(super) const AIR: u32 = u32::MAX;

/// Numbers of the media behind and before a side's surface.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) struct Beside {
    inside: u32,
    outside: u32,
}

impl Beside {
    /// Numbers for the media of a material, which are added to `all`; `None` if it names none.
    pub fn number(media: &Media<Hue>, all: &mut Vec<Hue>) -> Option<Self> {
        let mut number = |hue: &Option<Hue>| {
            hue.as_ref().map_or(AIR, |hue| {
                all.push(hue.clone());
                all.len() as u32 - 1
            })
        };
        (!media.is_clear()).then(|| Self {
            inside: number(&media.inside),
            outside: number(&media.outside),
        })
    }

    /// The medium of the side that the normal of the front points to, or of the other one.
    pub fn before(self, front: bool) -> u32 {
        if front { self.outside } else { self.inside }
    }
}

impl Tables<'_> {
    /// What part of the light gets along a way through a medium.
    pub fn attenuation(&self, medium: u32, way: f32, wavelengths: &Wavelengths) -> Lanes4 {
        let Some(hue) = self.media.get(medium as usize) else {
            return [1.0; 4];
        };
        let coefficient = self.colors.hue(hue, wavelengths);
        coefficient.map(|a| if a > 0.0 { libm::expf(-a * way) } else { 1.0 })
    }
}
