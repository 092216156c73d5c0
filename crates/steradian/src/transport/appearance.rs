//! What sides look like to a path: reflectance, emission and opacity at a point, at the path's wavelengths.

use std::borrow::Cow;

use glam::Vec3;

use super::interaction::Hit;
use super::tables::{Emitter, EmitterShape, Lanes4, Model, NO_TINT, Side, Tables, Tinted};
use super::towards::triangle_of;
use crate::brdf::Brdf;
use crate::geometry::{Direction, Frame, Point, Vector};
use crate::light::{EnvironmentMap, Kind};
use crate::material::Site;
use crate::shape::{Form, along_u};
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

    /// What the power of a directed emitter is multiplied with towards a direction away from it.
    #[inline(never)]
    pub fn factor(&self, emitter: &Emitter, away: Vec3) -> f32 {
        let light = &self.scene.lights()[emitter.light];
        let away = Vector::from(away.to_array().map(f64::from));
        Direction::new(away).map_or(0.0, |away| light.factor(away)) as f32
    }

    /// The same of a side that emits, towards a viewer.
    #[inline(always)]
    pub fn factor_of(&self, side: &Side, viewer: [f32; 3]) -> f32 {
        match self.emitters.get(side.emitter as usize) {
            Some(emitter) if emitter.is_directed => self.factor(emitter, Vec3::from_array(viewer)),
            _ => 1.0,
        }
    }

    /// The part of the light that a side stops; `None` for all of it.
    #[inline(always)]
    pub fn opacity(&self, side: &Side, site: impl FnOnce() -> Site) -> Option<f32> {
        let opacity = self.opacities.get(side.opacity as usize)?;
        Some(opacity.at(&site()))
    }

    /// The model of a side at a point; `None` where it is black.
    pub fn brdf(
        &self,
        side: &Side,
        site: &Site,
        wavelengths: &Wavelengths,
    ) -> Option<Cow<'_, Brdf>> {
        let material = self.scene.material(side.material);
        material.brdf(site, &self.colors, wavelengths)
    }

    /// The parts of the light that a pane reflects and lets straight through.
    pub fn pane(&self, side: &Side, hit: &Hit, wavelengths: &Wavelengths) -> [Lanes4; 2] {
        let brdf = self.brdf(side, &self.site(hit), wavelengths);
        let Some(Brdf::Pane(pane)) = brdf.as_deref() else {
            return [[0.0; 4]; 2];
        };
        // A shadow ray is no unit vector.
        let length = Vector::from(hit.viewer.map(f64::from)).length();
        let shares = pane.shares((f64::from(hit.cos_theta) / length).min(1.0));
        [
            shares.map(|(reflected, _)| reflected as f32),
            shares.map(|(_, passed)| passed as f32),
        ]
    }

    /// The part of the light that goes straight through a side, past what its opacity stops and through a pane.
    pub fn passing(&self, side: &Side, hit: &Hit, wavelengths: &Wavelengths) -> Lanes4 {
        let opacity = self.opacity(side, || self.site(hit)).unwrap_or(1.0);
        let through = match side.model {
            Model::Pane => self.pane(side, hit, wavelengths)[1],
            _ => [0.0; 4],
        };
        through.map(|share| (1.0 - opacity) + opacity * share)
    }

    /// Local axes at a point with this normal: the first is that of the shape, the first edge of a rectangle and the
    /// direction of the first texture coordinate of a mesh, where there is one.
    pub fn frame(&self, primitive: u32, normal: Direction) -> Frame {
        let (shape, face) = self.scene.surfaces().face_of(primitive);
        let tangent = match &self.scene.surfaces().shape(shape).form {
            Form::Parallelogram(form) => Some(form.edges[0]),
            Form::Mesh(mesh) => mesh.coordinate_gradients(face).map(along_u),
            _ => None,
        };
        let frame = tangent.and_then(|tangent| Frame::from_normal_and_tangent(normal, tangent));
        frame.unwrap_or_else(|| Frame::from_normal(normal))
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
        if let EmitterShape::Everywhere(map) = &emitter.shape {
            let sample = map.sample(u);
            return sample.map_or(Site::NOWHERE, |sample| in_picture(map, sample.texel));
        }
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

impl Tables<'_> {
    /// What a light from everywhere shows of a direction.
    pub fn site_of_everywhere(&self, emitter: &Emitter, direction: [f32; 3]) -> Site {
        match &self.scene.lights()[emitter.light].kind {
            Kind::EnvironmentMap { map, .. } => site_towards(map, direction),
            _ => Site::NOWHERE,
        }
    }
}

/// What a picture of all directions shows of a direction in which nothing is met.
pub(super) fn site_towards(map: &EnvironmentMap, direction: [f32; 3]) -> Site {
    let direction = Direction::new(Vector::from(direction.map(f64::from)));
    direction.map_or(Site::NOWHERE, |direction| {
        in_picture(map, map.texel(direction))
    })
}

fn in_picture(map: &EnvironmentMap, texel: [usize; 2]) -> Site {
    Site {
        coordinates: map.coordinates(texel),
        ..Site::NOWHERE
    }
}

fn site_of(form: &Form, face: usize, weights: [f32; 2], point: Point) -> Site {
    Site {
        coordinates: form.coordinates(face, weights, point),
        color: form.color(face, weights),
        normal: form.vertex_normal(face, weights),
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
