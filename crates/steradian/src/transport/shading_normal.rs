//! The normal that a model reckons with: that of the vertices, turned by a relief.
//!
//! It stands for a surface that is finer or rounder than the triangles. Rays start from the triangles all the same, and light that
//! comes from before one of the two surfaces and from behind the other is not counted, so that no light leaks through. Where the
//! viewer is behind the finer surface, the true normal is used. Radiance followed from the sensor needs no other factor: ρ and cosθ_i are
//! those of the shading normal; who follows power from the lights multiplies by |cos θ_i' cos θ_e| / |cos θ_i cos θ_e'|, with ' for the
//! shading normal (E. Veach 1997, §5.3, eq. 5.19).
//!
//! Plain Lambertian surfaces and mirrors without a relief keep their true normals: their light is then that of the
//! triangles, with all of its energy.

use super::scattering::Encounter;
use super::tables::Tables;
use crate::geometry::{Direction, Vector};

impl Tables<'_> {
    /// The shading normal on the side that an encounter sees.
    pub fn shading_normal(&self, encounter: &Encounter) -> Option<Direction> {
        let facing = direction(encounter.place.normal)?;
        let front = if encounter.is_at_front() {
            facing
        } else {
            -facing
        };
        let finer = self.finer_normal(encounter, front);
        let finer = if encounter.is_at_front() {
            finer
        } else {
            -finer
        };
        let viewer = Vector::from(encounter.viewer.map(f64::from));
        Some(if finer.to_vector().dot(viewer) > 0.0 {
            finer
        } else {
            facing
        })
    }

    /// On the side of the front.
    fn finer_normal(&self, encounter: &Encounter, front: Direction) -> Direction {
        let rounded = direction(encounter.site.normal).filter(|normal| normal.dot(front) > 0.0);
        let plain = rounded.unwrap_or(front);
        let side = &self.sides[encounter.side as usize];
        let relief = self.scene.material(side.material).relief.as_ref();
        let turned = relief.and_then(|relief| {
            let surfaces = self.scene.surfaces();
            let (shape, face) = surfaces.face_of(encounter.primitive);
            let point = surfaces.origin() + Vector::from(encounter.place.point.map(f64::from));
            let gradients = surfaces
                .shape(shape)
                .form
                .coordinate_gradients(face, point)?;
            relief.normal(&encounter.site, plain, gradients)
        });
        turned
            .filter(|normal| normal.dot(front) > 0.0)
            .unwrap_or(plain)
    }
}

/// In double precision.
pub(super) fn direction(components: [f32; 3]) -> Option<Direction> {
    Direction::new(Vector::from(components.map(f64::from))).ok()
}
