//! The energy balance of a scene: which lights, surfaces and sphere its accounts are about.

use super::Fault;
use super::description::{
    FluxOf, GeometryDescription, SceneDescription, SensorDescription, SensorKind,
};
use super::forms::base_name;
use super::geometry::virtual_form;
use super::sensors::Context;
use crate::geometry::{Bounds, Point, Transform};
use crate::light::{AreaLight, Kind, Light, LightId};
use crate::sensor::{Account, Entry, FluxSurface, Term};
use crate::shape::ShapeId;

/// How much the sphere around a scene is larger than the sphere around its bounds.
const ROOM: f64 = 1.01;

/// The three sensors that read the energy balance of a scene, in place of other ones.
///
/// Their readings are fluxes: of each light, of each side of each shape, and of what goes away. Light that comes from infinitely
/// far is counted where it enters a sphere around the scene. A scene with an infinite plane or with media that absorb
/// has no such balance, and [`Scene::new`](super::Scene::new) says so.
#[must_use]
pub fn energy_balance() -> Vec<SensorDescription> {
    let sensor = |term: Term| SensorDescription {
        name: term.name().into(),
        response: None,
        bins: None,
        kind: SensorKind::Balance(term),
    };
    Term::ALL.map(sensor).into()
}

impl Context<'_> {
    /// The accounts of one side of the balance.
    pub(super) fn accounts(&self, term: Term) -> Result<Vec<Account>, Fault> {
        let sphere = |of| Ok(Entry::Flux(FluxSurface::Virtual(self.sphere_around()?), of));
        match term {
            Term::Emitted => {
                let mut accounts = self.emitted();
                if self.lights.lights.iter().any(Light::is_infinitely_far) {
                    accounts.push(account("from outside", sphere(FluxOf::Incident)?));
                }
                Ok(accounts)
            }
            Term::Absorbed => {
                check_media(self.description)?;
                self.absorbed()
            }
            Term::Escaped => Ok(vec![account("to outside", sphere(FluxOf::Leaving)?)]),
        }
    }

    /// The lights that are somewhere, copies of a repeat together.
    fn emitted(&self) -> Vec<Account> {
        let (mut even, mut varying) = (Vec::<(&str, Vec<LightId>)>::new(), Vec::new());
        let lights = self.lights.lights.iter().enumerate();
        for (number, light) in lights.filter(|(_, light)| !light.is_infinitely_far()) {
            let (name, id) = (without_copy(&light.name), LightId(number as u32));
            match (&light.kind, even.last_mut()) {
                (Kind::Area(area), _) if !area.textures.is_empty() => {
                    varying.extend(sampled(&light.name, area));
                }
                (_, Some((known, ids))) if *known == name => ids.push(id),
                _ => even.push((name, vec![id])),
            }
        }
        let even = even.into_iter();
        let exact = even.map(|(name, ids)| account(name, Entry::Lights(ids)));
        exact.chain(varying).collect()
    }

    /// Both sides of all shapes, copies of a repeat together, and of the openings of luminaires.
    fn absorbed(&self) -> Result<Vec<Account>, Fault> {
        let mut accounts = Vec::new();
        let mut both = |name: &str, forms: std::ops::Range<usize>| {
            let ids: Vec<_> = forms.map(|form| ShapeId(form as u32)).collect();
            for front in [true, false] {
                accounts.push(side(name, ids.clone(), front, FluxOf::Absorbed));
            }
        };
        let shapes = self.description.shapes.iter().enumerate();
        for ((index, shape), forms) in shapes.zip(&self.forms.of_description) {
            let name = base_name(shape, index);
            if let GeometryDescription::Ground { .. } = shape.geometry {
                let message = format!(
                    "`{name}` is an infinite plane, and absorbs without end: use a finite surface"
                );
                return Err(("kind", message));
            }
            both(&name, forms.clone());
        }
        let described = self.forms.of_description.last().map_or(0, |last| last.end);
        if described < self.forms.names.len() {
            both("openings of luminaires", described..self.forms.names.len());
        }
        Ok(accounts)
    }

    /// A sphere around all shapes and all lights that are somewhere.
    fn sphere_around(&self) -> Result<crate::shape::Form, Fault> {
        let shapes = self.surfaces.bounds().unwrap_or(Bounds::EMPTY);
        let positions = self.lights.lights.iter().filter_map(position);
        let bounds = positions.fold(shapes, Bounds::including);
        let radius = 0.5 * bounds.diagonal().to_metres() * ROOM;
        let sphere = GeometryDescription::Sphere {
            center: bounds.center().unwrap_or(Point::ORIGIN),
            radius: if radius > 0.0 { radius } else { 1.0 },
            inside: false,
            ports: vec![],
        };
        virtual_form(&sphere, &Transform::IDENTITY).map_err(|message| ("kind", message))
    }
}

fn account(about: impl Into<String>, entry: Entry) -> Account {
    let about = about.into();
    Account { about, entry }
}

fn side(name: &str, shapes: Vec<ShapeId>, front: bool, of: FluxOf) -> Account {
    let about = format!("{name}, {}", if front { "front" } else { "back" });
    account(
        about,
        Entry::Flux(FluxSurface::Shapes { shapes, front }, of),
    )
}

/// The sides of a light whose emission varies.
fn sampled(name: &str, area: &AreaLight) -> impl Iterator<Item = Account> {
    let fronts = [true, false].into_iter();
    let emit = fronts.filter(|front| *front || area.two_sided);
    emit.map(|front| side(name, vec![area.shape], front, FluxOf::Emitted))
}

/// `lamp` of `lamp[3]`.
fn without_copy(name: &str) -> &str {
    let copied = name
        .strip_suffix(']')
        .and_then(|name| name.rsplit_once('['));
    let copied = copied.filter(|(_, copy)| copy.bytes().all(|byte| byte.is_ascii_digit()));
    copied.map_or(name, |(name, _)| name)
}

fn position(light: &Light) -> Option<Point> {
    match &light.kind {
        Kind::Point(light) => Some(light.position),
        Kind::Spot(light) => Some(light.position),
        Kind::Luminaire(light) => Some(light.position),
        _ => None,
    }
}

fn check_media(description: &SceneDescription) -> Result<(), Fault> {
    let mut materials = description.materials.iter();
    match materials.find(|material| !material.media.is_clear()) {
        None => Ok(()),
        Some(material) => {
            let name = &material.name;
            let message = format!(
                "what the medium of material `{name}` absorbs has no account: leave its absorption out"
            );
            Err(("kind", message))
        }
    }
}
