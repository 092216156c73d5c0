//! Pictures: lines from what light meets to the eye.
//!
//! A path of flux Φ that meets a surface of model ρ adds to the picture
//!
//! V = Φ ρ(d_e, d_i) |cosθ_e| T N
//!
//! as an area dA has the radiance ρ dΦ/dA and fills N dA |cosθ_e| of the film, N being the [pixels per area](crate::sensor::Sight) at the point.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Φ | flux that the path stands for | W |
//! | V | radiance times pixels | W/(m² sr) |
//! | T | transmittance from the point to the eye | 1 |
//! | N | pixels per area that faces the eye | 1/m² |
//!
//! V is bounded by the distance of what is in view from the eye, but for finer normals at grazing light.

use std::ops::Range;

use glam::Vec3;

use super::{Arrival, Catch, Connection, Connections, Flock, LightTracer, Particle};
use crate::estimation::film::{CHANNELS, Splat};
use crate::geometry::Vector;
use crate::sampling::{block, warp};
use crate::sensor::{Camera, Sight};
use crate::spectrum::{WavelengthDensity, Wavelengths};
use crate::transport::channels;
use crate::transport::columns::BATCH;
use crate::transport::tables::Lanes4;

/// Scratch of a thread.
#[derive(Default)]
pub(in crate::transport) struct FilmBatch {
    flock: Flock,
    /// By slot.
    wavelengths: Vec<Wavelengths>,
    /// With their places on the film, in pixels.
    connections: Connections<[f64; 2]>,
}

/// Traces light to a camera.
pub(in crate::transport) struct FilmTracer<'a> {
    pub light: LightTracer<'a>,
    pub camera: Camera,
    /// Of wavelengths; none unless the run is spectral.
    pub density: Option<WavelengthDensity>,
    /// Channels of the film, of a spectral run.
    pub channels: [usize; 4],
}

impl FilmTracer<'_> {
    /// Adds what paths of these indices bring.
    pub fn trace(
        &self,
        indices: Range<u32>,
        key: u64,
        batch: &mut FilmBatch,
        out: &mut Vec<Splat>,
    ) {
        let FilmBatch {
            flock,
            wavelengths,
            connections,
        } = batch;
        let mut catch = OnFilm {
            tracer: self,
            connections,
            out,
        };
        let mut from = indices.start;
        while from < indices.end {
            let to = from.saturating_add(BATCH as u32).min(indices.end);
            wavelengths.clear();
            for index in from..to {
                let slot = wavelengths.len() as u32;
                let waves = self.wavelengths(key, index);
                self.light.launch((slot, key, index), None, &waves, flock);
                wavelengths.push(waves);
            }
            self.light.follow(flock, wavelengths, &mut catch);
            from = to;
        }
    }

    fn wavelengths(&self, key: u64, index: u32) -> Wavelengths {
        let density = self.density.as_ref();
        let drawn = density.map(|density| density.sample(block::sample(key, index, 0)[3]));
        drawn.unwrap_or_default()
    }

    /// Whether a place reaches a pixel.
    fn is_on_film(&self, place: &[f64; 2]) -> bool {
        let mut pairs = place.iter().zip(self.camera.resolution);
        pairs.all(|(place, size)| (-2.0..=f64::from(size) + 2.0).contains(place))
    }

    fn channels_of(&self, lanes: Lanes4, wavelengths: &Wavelengths) -> [f32; CHANNELS] {
        let tables = self.light.tables;
        if self.density.is_none() {
            return std::array::from_fn(|lane| {
                if lane < tables.lanes {
                    lanes[lane]
                } else {
                    0.0
                }
            });
        }
        self.channels.map(|channel| {
            channels::counted(&tables.responses[channel], wavelengths, |lane| lanes[lane])
        })
    }
}

/// What a film takes.
struct OnFilm<'t, 'a> {
    tracer: &'t FilmTracer<'a>,
    connections: &'t mut Connections<[f64; 2]>,
    out: &'t mut Vec<Splat>,
}

impl Catch for OnFilm<'_, '_> {
    fn segments(&self, _: u32) -> u32 {
        1
    }

    /// Draws a line to the eye, by way of a place of the lens.
    fn scatter(&mut self, particle: &Particle, arrival: &Arrival<'_>, lens: [f32; 2]) {
        let surfaces = self.tracer.light.tables.scene.surfaces();
        let point = arrival.hit.place.point.map(f64::from);
        let point = surfaces.origin() + Vector::from(point);
        let lens = warp::disc(lens[0], lens[1]).map(f64::from);
        if let Some(sight) = self.tracer.camera.sight(point, lens) {
            self.draw(particle, arrival, &sight);
        }
    }

    fn settle(&mut self, wavelengths: &[Wavelengths]) {
        let (tracer, out) = (self.tracer, &mut *self.out);
        let LightTracer { tables, set, .. } = tracer.light;
        let take = |connection: &Connection<_>, lanes: Lanes4| {
            let value = tracer.channels_of(lanes, &wavelengths[connection.slot as usize]);
            let place = connection.place;
            out.push(Splat { place, value });
        };
        self.connections.settle(tables, wavelengths, set, take);
    }
}

impl OnFilm<'_, '_> {
    /// Draws the line of sight for each place on the film that shows it.
    fn draw(&mut self, particle: &Particle, arrival: &Arrival<'_>, sight: &Sight) {
        let tracer = self.tracer;
        let places = || {
            tracer
                .camera
                .repeats(sight.film)
                .filter(|place| tracer.is_on_film(place))
        };
        if places().next().is_none() {
            return;
        }
        let place = &arrival.hit.place;
        let surfaces = tracer.light.tables.scene.surfaces();
        let eye = Vec3::from_array(surfaces.to_kernel(sight.from));
        let direction = (eye - Vec3::from_array(place.point)).normalize_or_zero();
        let Some(seen) = arrival.towards(direction) else {
            return;
        };
        let (start, flux) = (place.start(direction), particle.carried());
        let value = |lane: usize| flux[lane] * seen[lane] * sight.pixels_per_area as f32;
        for place in places() {
            self.connections.push(Connection {
                ray: (start.into(), (eye - start).into()),
                place,
                value: std::array::from_fn(value),
                slot: particle.identity.0,
            });
        }
    }
}
