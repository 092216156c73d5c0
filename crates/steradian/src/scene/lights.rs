//! Lights: emission of shapes and lights without a shape, in lanes.

use std::sync::Arc;

use super::curves::Curves;
use super::description::{
    EmissionAmount, EmissionDescription, EnvironmentAmount, EnvironmentDescription, LaneValues,
    LightDescription, LightKind, LuminaireDescription, PointPower, ShapeDescription, SpotBeam,
};
use super::forms::{Forms, copies};
use super::luminaires::{self, Mounting};
use super::{Fault, Part, Problem};
use crate::geometry::{Direction, Point, Vector};
use crate::light::{
    AreaLight, Beam, EnvironmentError, EnvironmentMap, Kind, Light, LightId, PointLight, SpotLight,
    horizontal,
};
use crate::quantity::{
    Amount, Angle, Area, Exitance, Flux, Intensity, Irradiance, Quantity, Radiance, SolidAngle,
};
use crate::shape::{Placed, ShapeId};
use crate::spectrum::{CurveId, LaneCurve, Lanes, MAX_LANES};
use crate::time::Schedule;

/// A spot of a smaller half angle, in degrees, would have no solid angle left beside the rounding of its cosine.
const NARROWEST_BEAM: f64 = 1e-4;

/// Collects lights and their groups.
pub(super) struct Builder<'a> {
    lanes: &'a Lanes,
    efficacy: f64,
    curves: &'a mut Curves,
    pub lights: Vec<Light>,
    pub groups: Vec<String>,
    /// The schedule of each group.
    pub schedules: Vec<Option<Schedule>>,
    pub any_photometric: bool,
    pub any_radiant: bool,
}

impl<'a> Builder<'a> {
    pub fn new(lanes: &'a Lanes, efficacy: f64, curves: &'a mut Curves) -> Self {
        Self {
            lanes,
            efficacy,
            curves,
            lights: vec![],
            groups: vec![],
            schedules: vec![],
            any_photometric: false,
            any_radiant: false,
        }
    }

    /// Lights of shapes with emission; marks their parts.
    pub fn add_emission(
        &mut self,
        shapes: &[ShapeDescription],
        forms: &mut Forms,
        placed: &[Placed],
        problems: &mut Vec<Problem>,
    ) {
        for (index, shape) in shapes.iter().enumerate() {
            let Some(emission) = &shape.emission else {
                continue;
            };
            for form in forms.of_description[index].clone() {
                if let Err(message) = self.emit(emission, form, forms, &placed[form]) {
                    problems.push(Problem::at(Part::Shape(index), "emission", message));
                    break;
                }
            }
        }
    }

    fn emit(
        &mut self,
        emission: &EmissionDescription,
        form: usize,
        forms: &mut Forms,
        placed: &Placed,
    ) -> Result<(), String> {
        let power = self.emission(emission, placed.form.area())?;
        let textures = super::materials::textures(&emission.textures, self.lanes, self.curves)?;
        let light = Kind::Area(AreaLight {
            shape: ShapeId(form as u32),
            radiance: power
                .lanes
                .map(Radiance::from_watts_per_square_metre_steradian),
            textures,
            two_sided: emission.two_sided,
        });
        let spectrum = self.curves.number(power.curve);
        let group = self.group(emission.group.as_deref(), emission.schedule.as_ref());
        let id = self.push(forms.names[form].clone(), group, spectrum, light);
        for part in &placed.parts {
            forms.parts[part.0 as usize].light = Some(id);
        }
        Ok(())
    }

    /// Lights without a shape.
    pub fn add_lights(
        &mut self,
        lights: &[LightDescription],
        mut mounting: Mounting<'_>,
        problems: &mut Vec<Problem>,
    ) {
        for (index, light) in lights.iter().enumerate() {
            let part = Part::Light(index);
            if light.repeat.is_some() && light.kind.is_infinitely_far() {
                let message = "a light infinitely far away cannot be repeated";
                problems.push(Problem::at(part, "repeat", message));
                continue;
            }
            let steps = copies(light.repeat.as_ref(), part, problems);
            if let Err((key, message)) = self.add_copies(light, index, &steps, &mut mounting) {
                problems.push(Problem::at(part, key, message));
            }
        }
    }

    fn add_copies(
        &mut self,
        light: &LightDescription,
        index: usize,
        steps: &[Vector],
        mounting: &mut Mounting<'_>,
    ) -> Result<(), Fault> {
        let own = light.name.clone();
        let name = own.unwrap_or_else(|| format!("light {index}"));
        let power = self.power(light)?;
        let spectrum = self.curves.number(power.curve);
        let group = self.group(light.group.as_deref(), light.schedule.as_ref());
        for (copy, step) in steps.iter().enumerate() {
            let name = match light.repeat {
                Some(_) => format!("{name}[{copy}]"),
                None => name.clone(),
            };
            let known = (LightId(self.lights.len() as u32), &name[..]);
            let kind = kind(&light.kind, *step, power.lanes, (mounting, known))?;
            self.push(name, group, spectrum, kind);
        }
        Ok(())
    }

    /// Number of the group of this name and schedule.
    fn group(&mut self, name: Option<&str>, schedule: Option<&Schedule>) -> u32 {
        let name = name.unwrap_or("default");
        let mut known = self.groups.iter().zip(&self.schedules);
        let number = known.position(|(known, its)| known == name && its.as_ref() == schedule);
        let number = number.unwrap_or_else(|| {
            self.groups.push(name.into());
            self.schedules.push(schedule.cloned());
            self.groups.len() - 1
        });
        number as u32
    }

    fn push(&mut self, name: String, group: u32, spectrum: Option<CurveId>, kind: Kind) -> LightId {
        self.lights.push(Light {
            name,
            group,
            spectrum,
            kind,
        });
        LightId(self.lights.len() as u32 - 1)
    }

    /// Lanes of an amount in SI units.
    fn amount<R: Quantity, P: Quantity>(
        &mut self,
        amount: Amount<R, P>,
        shape: Option<&LaneValues>,
    ) -> Result<LaneCurve, String> {
        let (value, lanes) = match amount {
            Amount::Radiant(value) => {
                self.any_radiant = true;
                (
                    value.to_si(),
                    self.lanes.radiant_power(value.to_si(), shape),
                )
            }
            Amount::Photometric(value) => {
                self.any_photometric = true;
                (
                    value.to_si(),
                    self.lanes
                        .luminous_power(value.to_si(), self.efficacy, shape),
                )
            }
        };
        if !(value >= 0.0 && value.is_finite()) {
            return Err(format!(
                "a light's power is finite and not negative, not {value}"
            ));
        }
        lanes.map_err(|error| error.to_string())
    }

    /// Radiance of each emitting side in SI units.
    fn emission(&mut self, emission: &EmissionDescription, area: f64) -> Result<LaneCurve, String> {
        let shape = emission.spectrum.as_ref();
        let of_exitance = |lane| {
            Radiance::from_lambertian_exitance(Exitance::from_watts_per_square_metre(lane))
                .to_watts_per_square_metre_steradian()
        };
        match emission.amount {
            EmissionAmount::Radiance(amount) => self.amount(amount, shape),
            EmissionAmount::Exitance(amount) => Ok(self.amount(amount, shape)?.map(of_exitance)),
            EmissionAmount::Flux(_) if area.is_infinite() => {
                Err("an infinite plane has no total flux: give radiance or exitance".into())
            }
            EmissionAmount::Flux(_) if !emission.textures.is_empty() => Err(
                "the flux of an emission with a texture is not known: give radiance or exitance where the texture is 1".into(),
            ),
            EmissionAmount::Flux(amount) => {
                let sides = if emission.two_sided { 2.0 } else { 1.0 };
                let area = Area::from_square_metres(area * sides);
                let exitance = |lane| {
                    Exitance::from_flux(Flux::from_watts(lane), area).to_watts_per_square_metre()
                };
                let flux = self.amount(amount, shape)?;
                Ok(flux.map(exitance).map(of_exitance))
            }
        }
    }

    /// What a light is given by, in SI units: intensity, irradiance or radiance by kind.
    fn power(&mut self, light: &LightDescription) -> Result<LaneCurve, Fault> {
        let shape = light.spectrum.as_ref();
        match &light.kind {
            LightKind::Point { power, .. } => self.intensity(power, SolidAngle::SPHERE, shape),
            LightKind::Spot { power, beam, .. } => {
                self.intensity(power, beam_of(beam)?.solid_angle(), shape)
            }
            LightKind::Directional { irradiance, .. } => self
                .amount(*irradiance, shape)
                .map_err(|message| ("irradiance", message)),
            LightKind::Environment { radiance } => self
                .amount(*radiance, shape)
                .map_err(|message| ("radiance", message)),
            LightKind::EnvironmentMap(environment) => self.environment(environment, shape),
            LightKind::Luminaire(luminaire) => self.luminaire(luminaire, shape),
        }
    }

    /// What a 1 of a picture of all directions is.
    fn environment(
        &mut self,
        environment: &EnvironmentDescription,
        shape: Option<&LaneValues>,
    ) -> Result<LaneCurve, Fault> {
        super::materials::check_colours(&environment.picture, self.lanes)
            .map_err(|message| ("file", message))?;
        match environment.amount {
            EnvironmentAmount::Unit(amount) => self
                .amount(amount, shape)
                .map_err(|message| ("unit", message)),
            EnvironmentAmount::Irradiance(amount) => {
                let of_one = horizontal(&environment.picture);
                if of_one <= 0.0 {
                    let message = "nothing above the horizon of the picture gives light";
                    return Err(("irradiance", message.into()));
                }
                let lanes = self.amount(amount, shape);
                let lanes = lanes.map_err(|message| ("irradiance", message))?;
                Ok(lanes.map(|lane| lane / of_one))
            }
        }
    }

    /// What a 1 of a luminaire's table is in W/sr, with all factors.
    fn luminaire(
        &mut self,
        luminaire: &LuminaireDescription,
        shape: Option<&LaneValues>,
    ) -> Result<LaneCurve, Fault> {
        luminaires::check(luminaire)?;
        let (lanes, share) = match luminaire.flux {
            Some(flux) => {
                let flux = self
                    .amount(flux, shape)
                    .map_err(|message| ("flux", message));
                (flux?, 1.0 / luminaire.far_field.flux())
            }
            None => {
                let unit = self.amount(luminaire.unit, shape);
                (unit.map_err(|message| ("file", message))?, 1.0)
            }
        };
        let factor = share * luminaire.dimming * luminaire.maintenance_factor;
        Ok(lanes.map(|lane| lane * factor))
    }

    fn intensity(
        &mut self,
        power: &PointPower,
        beam: SolidAngle,
        shape: Option<&LaneValues>,
    ) -> Result<LaneCurve, Fault> {
        match *power {
            PointPower::Intensity(amount) => self
                .amount(amount, shape)
                .map_err(|message| ("intensity", message)),
            PointPower::Flux(amount) => {
                let flux = self
                    .amount(amount, shape)
                    .map_err(|message| ("flux", message))?;
                Ok(flux.map(|lane| (Flux::from_watts(lane) / beam).to_watts_per_steradian()))
            }
        }
    }
}

/// A light, moved by `step`, with its power in SI units.
fn kind(
    light: &LightKind,
    step: Vector,
    power: [f64; MAX_LANES],
    (mounting, known): (&mut Mounting<'_>, (LightId, &str)),
) -> Result<Kind, Fault> {
    Ok(match light {
        LightKind::Point { position, .. } => Kind::Point(PointLight {
            position: position_of(*position + step)?,
            intensity: power.map(Intensity::from_watts_per_steradian),
        }),
        LightKind::Spot {
            position,
            direction,
            beam,
            ..
        } => Kind::Spot(SpotLight {
            position: position_of(*position + step)?,
            axis: direction_of(*direction)?,
            beam: beam_of(beam)?,
            peak_intensity: power.map(Intensity::from_watts_per_steradian),
        }),
        LightKind::Directional { direction, .. } => Kind::Directional {
            direction: direction_of(*direction)?,
            irradiance: power.map(Irradiance::from_watts_per_square_metre),
        },
        LightKind::Environment { .. } => Kind::Environment {
            radiance: power.map(Radiance::from_watts_per_square_metre_steradian),
        },
        LightKind::EnvironmentMap(environment) => Kind::EnvironmentMap {
            radiance: power.map(Radiance::from_watts_per_square_metre_steradian),
            map: map_of(environment)?,
        },
        LightKind::Luminaire(luminaire) => Kind::Luminaire(luminaires::luminaire(
            luminaire, step, power, mounting, known,
        )?),
    })
}

impl LightKind {
    fn is_infinitely_far(&self) -> bool {
        matches!(
            self,
            Self::Directional { .. } | Self::Environment { .. } | Self::EnvironmentMap(_)
        )
    }
}

fn map_of(environment: &EnvironmentDescription) -> Result<Arc<EnvironmentMap>, Fault> {
    let map = EnvironmentMap::new(&environment.picture, environment.middle);
    map.map(Arc::new).map_err(|error| {
        let key = match error {
            EnvironmentError::Upright => "middle",
            _ => "file",
        };
        (key, error.to_string())
    })
}

pub(super) fn position_of(position: Point) -> Result<Point, Fault> {
    let message = || {
        format!(
            "a light's position is finite, not {:?}",
            position.to_array()
        )
    };
    position
        .is_finite()
        .then_some(position)
        .ok_or_else(|| ("position", message()))
}

fn direction_of(direction: Vector) -> Result<Direction, Fault> {
    let message = "a direction is finite and not zero";
    Direction::new(direction).map_err(|_| ("direction", message.into()))
}

fn beam_of(beam: &SpotBeam) -> Result<Beam, Fault> {
    let cutoff = match *beam {
        SpotBeam::Uniform { cutoff }
        | SpotBeam::CosinePower { cutoff, .. }
        | SpotBeam::Smooth { cutoff, .. } => cutoff,
    };
    let degrees = cutoff.to_degrees();
    if !(degrees > NARROWEST_BEAM && degrees <= 180.0) {
        let message = format!(
            "a spot's cutoff lies above {NARROWEST_BEAM} deg and at most at 180 deg, not {degrees} deg"
        );
        return Err(("cutoff", message));
    }
    falloff_of(beam, cutoff).ok_or_else(|| {
        let message = match beam {
            SpotBeam::Smooth { .. } => "the inner half angle lies between 0 and the cutoff",
            _ => "a power falloff has a positive exponent and a cutoff of at most 90 deg",
        };
        ("falloff", message.into())
    })
}

/// `None` where the beam's parameters do not fit its cutoff.
fn falloff_of(beam: &SpotBeam, cutoff: Angle) -> Option<Beam> {
    let cos_cutoff = cutoff.cos();
    match *beam {
        SpotBeam::Uniform { .. } => Some(Beam::Uniform { cos_cutoff }),
        SpotBeam::CosinePower { exponent, .. } => {
            let fits = exponent > 0.0 && exponent.is_finite() && cutoff.to_degrees() <= 90.0;
            fits.then_some(Beam::CosinePower {
                exponent,
                cos_cutoff: cos_cutoff.max(0.0),
            })
        }
        SpotBeam::Smooth { inner, .. } => {
            let cos_inner = inner.cos();
            let fits = inner.to_degrees() >= 0.0 && inner < cutoff && cos_inner > cos_cutoff;
            fits.then_some(Beam::Smooth {
                cos_inner,
                cos_cutoff,
            })
        }
    }
}
