//! Where the paths of meters start.

use std::f32::consts::{FRAC_1_PI, PI};

use super::super::columns::{Flight, Workspace};
use super::super::flux::{FluxMeter, Looks};
use super::super::meters::Meter;
use super::super::scattering::Encounter;
use super::super::tables::Model;
use super::{DIRECTION_BLOCK, MeterWorkspace, Meters, WAVELENGTH_BLOCK};
use crate::estimation::Run;
use crate::sampling::{block, warp};

impl Meters<'_> {
    /// Puts the vertices of a run at its meter.
    pub(super) fn start(&self, slot: usize, run: &Run, workspace: &mut MeterWorkspace) {
        let stream = &self.streams[run.stream as usize];
        let paths = &mut workspace.paths;
        if let Some(density) = self.densities.get(stream.sensor) {
            for i in 0..run.count {
                let [w, ..] = block::sample(run.key, run.first + i, WAVELENGTH_BLOCK);
                paths.wavelengths[slot + i as usize] = density.sample(w);
            }
        }
        let first = (slot as u32, run.key, run.first);
        match &stream.meter {
            Meter::Irradiance { place, roster } => {
                paths.rosters.set(slot..slot + run.count as usize, roster);
                let response = [FRAC_1_PI; 4];
                paths.vertices.repeat(place, response, first, run.count);
            }
            Meter::Scalar { place, roster } => {
                paths.rosters.set(slot..slot + run.count as usize, roster);
                let response = [0.25 * FRAC_1_PI; 4];
                paths.vertices.repeat(place, response, first, run.count);
            }
            meter => {
                for i in 0..run.count {
                    let identity = (first.0 + i, run.key, run.first + i);
                    let u = block::sample(run.key, run.first + i, 0);
                    self.start_one(meter, u, identity, workspace);
                }
            }
        }
    }

    /// Starts a sample of a meter whose samples start differently.
    fn start_one(
        &self,
        meter: &Meter<'_>,
        u: [f32; 4],
        identity: (u32, u64, u32),
        workspace: &mut MeterWorkspace,
    ) {
        let (paths, light) = (&mut workspace.paths, [u[2], u[3]]);
        match meter {
            Meter::Irradiance { .. } | Meter::Scalar { .. } => {}
            Meter::Cylinder(cylinder) => {
                let response = [FRAC_1_PI; 4];
                let vertices = &mut paths.vertices;
                vertices.push(cylinder.place(u[0]), response, identity, light);
            }
            Meter::Surface(seen) => {
                let encounter = Encounter {
                    identity,
                    light,
                    ..seen.clone()
                };
                self.start_at_surface(paths, encounter);
            }
            Meter::Ray { origin, direction } => paths.flights.push(Flight {
                origin: *origin,
                direction: *direction,
                throughput: [1.0; 4],
                pdf: f32::INFINITY,
                identity,
                light,
            }),
            Meter::Flux(flux) => self.start_on_flux(flux, u, identity, workspace),
        }
    }

    fn start_at_surface(&self, paths: &mut Workspace, seen: Encounter) {
        let tables = self.tracer.tables;
        let side = &tables.sides[seen.side as usize];
        if side.model == Model::Any {
            paths.encounters.push(seen);
            return;
        }
        let wavelengths = paths.wavelengths[seen.identity.0 as usize];
        let reflectance = tables.lanes_at(&side.reflectance, &wavelengths, || seen.site);
        match side.model {
            Model::Lambertian => paths.vertices.push(
                seen.place,
                reflectance.map(|lane| lane * FRAC_1_PI),
                seen.identity,
                seen.light,
            ),
            Model::Mirror => {
                let mirrors = &mut paths.mirrors;
                mirrors.push(seen.place, reflectance, seen.identity, seen.light);
                let viewer = paths.viewer.iter_mut().zip(seen.viewer);
                viewer.for_each(|(column, axis)| column.push(axis));
            }
            // A pane is met by a ray.
            Model::Black | Model::Any | Model::Pane => {}
        }
    }

    fn start_on_flux(
        &self,
        flux: &FluxMeter,
        u: [f32; 4],
        identity: (u32, u64, u32),
        workspace: &mut MeterWorkspace,
    ) {
        let tables = self.tracer.tables;
        let Some(drawn) = flux.draw([f64::from(u[0]), f64::from(u[1])]) else {
            return;
        };
        let slot = identity.0 as usize;
        let wavelengths = &workspace.paths.wavelengths[slot];
        let start = match drawn.part {
            None => flux.on_virtual(identity),
            Some(part) if tables.is_any(part, flux.front) => {
                flux.on_model(tables, &drawn, part, wavelengths, identity)
            }
            Some(part) => flux.on_shape(tables, &drawn, part, wavelengths),
        };
        workspace.sign[slot] = start.sign;
        if let Some((group, radiance)) = start.emitted {
            let gathered = &mut workspace.paths.gathered;
            self.tracer
                .add(gathered, group, identity.0, |lane| radiance[lane]);
        }
        if start.weights == [0.0; 4] {
            return;
        }
        if let (Looks::AtModel { .. }, Some(part)) = (start.looks, drawn.part) {
            let [a, b, ..] = block::sample(identity.1, identity.2, DIRECTION_BLOCK);
            let light = [u[2], u[3]];
            workspace.paths.encounters.push(Encounter {
                identity,
                light,
                ..drawn.seen(tables, part, &start, [a, b])
            });
            return;
        }
        workspace.paths.vertices.push(
            drawn.place(tables, start.front),
            start.weights.map(|weight| weight * FRAC_1_PI),
            identity,
            [u[2], u[3]],
        );
    }
}

/// Sends a path out of every meter of scalar irradiance, uniformly over the sphere.
pub(super) fn leave_over_sphere(paths: &mut Workspace) {
    let vertices = &paths.vertices;
    paths.flights.clear();
    for i in 0..vertices.len() {
        let identity = &vertices.identity;
        paths.flights.push(Flight {
            origin: vertices.place(i).point,
            direction: warp::sphere(paths.uniforms[0][i], paths.uniforms[1][i]),
            throughput: std::array::from_fn(|lane| vertices.response[lane][i] * 4.0 * PI),
            pdf: 0.25 * FRAC_1_PI,
            identity: (identity.slot[i], identity.key[i], identity.index[i]),
            light: [paths.uniforms[2][i], paths.uniforms[3][i]],
        });
    }
}
