//! Flux meters before sampling, and the accounts of the energy balance.

use super::exact;
use super::flux::FluxMeter;
use super::meters::{Context, Meter, Prepared};
use crate::light::LightId;
use crate::quantity::{Area, Flux};
use crate::scene::Scene;
use crate::sensor::{Account, Entry, FluxOf, FluxSurface};
use crate::shape::Form;

impl<'a> Context<'_, 'a> {
    pub fn flux(&self, surface: &'a FluxSurface, of: FluxOf) -> Prepared<'a> {
        let mut exact = vec![0.0; self.columns()];
        let (mut forms, mut firsts) = (Vec::new(), Vec::new());
        let mut area = 0.0;
        let mut add = |form: &'a Form, parts| {
            area += form.sampling_area();
            forms.push((form, parts, area));
        };
        let front = match surface {
            FluxSurface::Virtual(form) => {
                add(form, None);
                true
            }
            FluxSurface::Shapes { shapes, front } => {
                for id in shapes {
                    let placed = self.scene.surfaces().shape(*id);
                    let first = self.scene.surfaces().first_primitive(*id);
                    firsts.push(first);
                    add(&placed.form, Some((&placed.parts[..], first)));
                    exact::emitted_flux(self.scene, placed, *front, of, &mut exact);
                }
                *front
            }
        };
        firsts.sort_unstable();
        let forms = forms
            .into_iter()
            .map(|(form, parts, sum)| (form, parts, sum / area))
            .collect();
        let meter = (self.max_depth >= 1).then_some(Meter::Flux(FluxMeter {
            forms,
            shapes: firsts,
            area,
            front,
            of,
        }));
        Prepared {
            meter,
            ..Prepared::closed_form(exact, self.dark.clone())
        }
    }

    /// The readings of one side of the energy balance.
    pub fn accounts(&self, accounts: &'a [Account]) -> Vec<Prepared<'a>> {
        let account = |(index, account): (usize, &'a Account)| {
            let reading = match &account.entry {
                Entry::Lights(lights) => {
                    let exact = emitted(self.scene, lights);
                    let closed = vec![true; exact.len()];
                    Prepared::closed_form(exact, closed)
                }
                Entry::Flux(surface, of) => self.flux(surface, *of),
            };
            Prepared {
                index,
                about: Some(account.about.clone()),
                ..reading
            }
        };
        accounts.iter().enumerate().map(account).collect()
    }
}

/// Flux of lights by column.
fn emitted(scene: &Scene, lights: &[LightId]) -> Vec<f64> {
    let count = scene.lanes().count();
    let mut columns = vec![0.0; scene.columns()];
    for id in lights {
        let light = &scene.lights()[id.0 as usize];
        let area = |shape| Area::from_square_metres(scene.surfaces().shape(shape).form.area());
        let Some(flux) = light.flux(area) else {
            continue;
        };
        let channels = scene.channels(light, flux.map(Flux::to_watts));
        let columns = &mut columns[light.group as usize * count..][..count];
        let parts = columns.iter_mut().zip(channels);
        parts.for_each(|(sum, channel)| *sum += channel);
    }
    columns
}
