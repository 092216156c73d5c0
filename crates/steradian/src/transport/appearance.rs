//! What sides look like to a path: reflectance, emission and opacity at a point, at the path's wavelengths.

use super::interaction::Hit;
use super::tables::{Emitter, EmitterShape, Lanes4, NO_TINT, Side, Tables, Tinted};
use super::towards::triangle_of;
use crate::geometry::{Point, Vector};
use crate::material::Site;
use crate::shape::Form;
use crate::spectrum::Wavelengths;

impl Tables<'_> {
    /// Lanes at a point, which is asked for only where they vary over the surface.
    #[inline(always)]
    pub fn lanes_at(
        &self,
        tinted: &Tinted,
        wavelengths: &Wavelengths,
        site: impl FnOnce() -> Site,
    ) -> Lanes4 {
        if tinted.tint == NO_TINT {
            return tinted.lanes;
        }
        let tint = &self.tints[tinted.tint as usize];
        if tint.textures.is_empty() {
            return self.colors.hue(&tint.hue, wavelengths);
        }
        self.colors.tint(tint, &site(), wavelengths)
    }

    /// The part of the light that a side stops; `None` for all of it.
    #[inline(always)]
    pub fn opacity(&self, side: &Side, site: impl FnOnce() -> Site) -> Option<f32> {
        let opacity = self.opacities.get(side.opacity as usize)?;
        Some(opacity.at(&site()))
    }

    /// What a surface knows of a point that a ray met.
    #[inline(always)]
    pub fn site(&self, hit: &Hit) -> Site {
        self.site_on(hit.primitive, hit.weights, hit.place.point)
    }

    /// The numbers come one by one, so that a hit need not leave the registers for the few surfaces that ask.
    #[inline(never)]
    fn site_on(&self, primitive: u32, weights: [f32; 2], point: [f32; 3]) -> Site {
        let surfaces = self.scene.surfaces();
        let (shape, face) = surfaces.face_of(primitive);
        let point = surfaces.origin() + Vector::from(point.map(f64::from));
        site_of(&surfaces.shape(shape).form, face, weights, point)
    }

    /// The same for the point of an emitter that these numbers chose; `end` is near it.
    pub fn site_of_sample(&self, emitter: &Emitter, u: [f32; 2], end: [f32; 3]) -> Site {
        let surfaces = self.scene.surfaces();
        let Some(shape) = emitter.surface else {
            return Site::NOWHERE;
        };
        let form = &surfaces.shape(shape).form;
        let point = surfaces.origin() + Vector::from(end.map(f64::from));
        match &emitter.shape {
            EmitterShape::Triangles { cumulative, .. } => {
                let (face, within) = triangle_of(cumulative, u[0]);
                let root = within.sqrt();
                site_of(form, face, [1.0 - root, u[1] * root], point)
            }
            // Weights of the first triangle, which continue over the second.
            EmitterShape::Parallelogram { .. } => site_of(form, 0, [u[0] - u[1], u[1]], point),
            _ => site_of(form, 0, [0.0; 2], point),
        }
    }
}

fn site_of(form: &Form, face: usize, weights: [f32; 2], point: Point) -> Site {
    Site {
        coordinates: form.coordinates(face, weights, point),
        color: form.color(face, weights),
    }
}

/// What a form knows of a point on one of its faces.
pub(super) fn site_at(form: &Form, face: usize, point: Point) -> Site {
    let weights = match form {
        Form::Mesh(mesh) => {
            let [a, b, c] = mesh.corners(face);
            weights_in([b - a, c - a], point - a)
        }
        // The first triangle is spanned by the first edge and the diagonal.
        Form::Parallelogram(form) => {
            let [first, second] = form.edges;
            weights_in([first, first + second], point - form.origin)
        }
        _ => [0.0; 2],
    };
    site_of(form, face, weights, point)
}

/// s and t of the vector s·a + t·b nearest to `p`.
fn weights_in([a, b]: [Vector; 2], p: Vector) -> [f32; 2] {
    let (aa, ab, bb) = (a.dot(a), a.dot(b), b.dot(b));
    let (pa, pb) = (p.dot(a), p.dot(b));
    let determinant = aa * bb - ab * ab;
    let (s, t) = (pa * bb - pb * ab, pb * aa - pa * ab);
    [(s / determinant) as f32, (t / determinant) as f32]
}
