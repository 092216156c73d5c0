//! Surfaces with pictures: what they show is looked up after all paths of a batch have arrived.
//!
//! A path may meet any texel of pictures that are larger than the caches, and would wait for it a hundred nanoseconds and more. So texels are
//! asked for as hits are found and read after the last of them: many are on their way at once.

use std::f32::consts::FRAC_1_PI;

use super::columns::{Place, Workspace};
use super::path::{Tracer, push};
use super::tables::{Side, Tables};
use crate::material::Site;

/// A flight that met a diffuse surface with textures.
pub(super) struct Patterned {
    /// Of the flight.
    pub row: u32,
    /// Number of the side.
    pub side: u32,
    pub place: Place,
    pub site: Site,
}

impl Tables<'_> {
    /// Has the texels fetched that the material of a side will ask for.
    pub fn fetch_ahead(&self, side: &Side, site: &Site) {
        for picture in &self.pictures[side.material.0 as usize] {
            picture.fetch_ahead(site);
        }
    }
}

impl Tracer<'_> {
    /// Collects the vertices of surfaces with textures.
    pub fn arrive_at_patterned(&self, workspace: &mut Workspace) {
        let (flights, vertices) = (&workspace.flights, &mut workspace.vertices);
        for met in &workspace.patterned {
            let row = met.row as usize;
            let wavelengths = &workspace.wavelengths[flights.identity.slot[row] as usize];
            let side = &self.tables.sides[met.side as usize];
            let looks = self
                .tables
                .lanes_at(&side.reflectance, wavelengths, || met.site);
            push(vertices, flights, row, met.place, &looks, FRAC_1_PI);
        }
    }
}
