//! Lights: emission of shapes and lights without a shape, in lanes.

use super::description::{
    EmissionAmount, EmissionDescription, LaneValues, LightDescription, LightKind, PointPower,
    ShapeDescription, SpotBeam,
};
use super::forms::{Forms, copies};
use super::{Part, Problem};
use crate::geometry::{Direction, Vector};
use crate::light::{AreaLight, Beam, Kind, Light, LightId, PointLight, SpotLight};
use crate::quantity::{
    Amount, Area, Exitance, Flux, Intensity, Irradiance, Quantity, Radiance, SolidAngle,
};
use crate::shape::{Placed, ShapeId};
use crate::spectrum::{Lanes, MAX_LANES};

/// Collects lights and their groups.
pub(super) struct Builder<'a> {
    lanes: &'a Lanes,
    efficacy: f64,
    pub lights: Vec<Light>,
    pub groups: Vec<String>,
    pub any_photometric: bool,
    pub any_radiant: bool,
}

impl<'a> Builder<'a> {
    pub fn new(lanes: &'a Lanes, efficacy: f64) -> Self {
        Self {
            lanes,
            efficacy,
            lights: vec![],
            groups: vec![],
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
                let radiance = match self.radiance(emission, placed[form].form.area()) {
                    Ok(radiance) => radiance,
                    Err(message) => {
                        problems.push(Problem::at(Part::Shape(index), "emission", message));
                        break;
                    }
                };
                let light = AreaLight {
                    shape: ShapeId(form as u32),
                    radiance,
                    two_sided: emission.two_sided,
                };
                let id = self.push(
                    forms.names[form].clone(),
                    emission.group.as_deref(),
                    Kind::Area(light),
                );
                for part in &placed[form].parts {
                    forms.parts[part.0 as usize].light = Some(id);
                }
            }
        }
    }

    /// Lights without a shape.
    pub fn add_lights(&mut self, lights: &[LightDescription], problems: &mut Vec<Problem>) {
        for (index, light) in lights.iter().enumerate() {
            let part = Part::Light(index);
            if light.repeat.is_some()
                && matches!(
                    light.kind,
                    LightKind::Directional { .. } | LightKind::Environment { .. }
                )
            {
                problems.push(Problem::at(
                    part,
                    "repeat",
                    "a light infinitely far away cannot be repeated",
                ));
            }
            let name = light
                .name
                .clone()
                .unwrap_or_else(|| format!("light {index}"));
            for (copy, step) in copies(light.repeat.as_ref(), part, problems)
                .into_iter()
                .enumerate()
            {
                match self.kind(light, step) {
                    Ok(kind) => {
                        let name = if light.repeat.is_some() {
                            format!("{name}[{copy}]")
                        } else {
                            name.clone()
                        };
                        self.push(name, light.group.as_deref(), kind);
                    }
                    Err((key, message)) => {
                        problems.push(Problem::at(part, key, message));
                        break;
                    }
                }
            }
        }
    }

    fn push(&mut self, name: String, group: Option<&str>, kind: Kind) -> LightId {
        let group = group.unwrap_or("default");
        let known = self.groups.iter().position(|known| known == group);
        let group = known.unwrap_or_else(|| {
            self.groups.push(group.into());
            self.groups.len() - 1
        });
        self.lights.push(Light {
            name,
            group: group as u32,
            kind,
        });
        LightId(self.lights.len() as u32 - 1)
    }

    /// Lanes of an amount in SI units.
    fn amount<R: Quantity, P: Quantity>(
        &mut self,
        amount: Amount<R, P>,
        shape: Option<&LaneValues>,
    ) -> Result<[f64; MAX_LANES], String> {
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

    fn radiance(
        &mut self,
        emission: &EmissionDescription,
        area: f64,
    ) -> Result<[Radiance; MAX_LANES], String> {
        let shape = emission.spectrum.as_ref();
        let of_exitance =
            |lane| Radiance::from_lambertian_exitance(Exitance::from_watts_per_square_metre(lane));
        match emission.amount {
            EmissionAmount::Radiance(amount) => Ok(self
                .amount(amount, shape)?
                .map(Radiance::from_watts_per_square_metre_steradian)),
            EmissionAmount::Exitance(amount) => Ok(self.amount(amount, shape)?.map(of_exitance)),
            EmissionAmount::Flux(_) if area.is_infinite() => {
                Err("an infinite plane has no total flux: give radiance or exitance".into())
            }
            EmissionAmount::Flux(amount) => {
                let sides = if emission.two_sided { 2.0 } else { 1.0 };
                let area = Area::from_square_metres(area * sides);
                let radiance = |lane| {
                    Radiance::from_lambertian_exitance(Exitance::from_flux(
                        Flux::from_watts(lane),
                        area,
                    ))
                };
                Ok(self.amount(amount, shape)?.map(radiance))
            }
        }
    }

    fn kind(
        &mut self,
        light: &LightDescription,
        step: Vector,
    ) -> Result<Kind, (&'static str, String)> {
        let shape = light.spectrum.as_ref();
        Ok(match &light.kind {
            LightKind::Point { position, power } => {
                let intensity = self.intensity(power, SolidAngle::SPHERE, shape)?;
                Kind::Point(PointLight {
                    position: *position + step,
                    intensity,
                })
            }
            LightKind::Spot {
                position,
                direction,
                beam,
                power,
            } => {
                let axis = direction_of(*direction)?;
                let beam = beam_of(beam)?;
                let peak_intensity = self.intensity(power, beam.solid_angle(), shape)?;
                Kind::Spot(SpotLight {
                    position: *position + step,
                    axis,
                    beam,
                    peak_intensity,
                })
            }
            LightKind::Directional {
                direction,
                irradiance,
            } => {
                let irradiance = self
                    .amount(*irradiance, shape)
                    .map_err(|message| ("irradiance", message))?;
                Kind::Directional {
                    direction: direction_of(*direction)?,
                    irradiance: irradiance.map(Irradiance::from_watts_per_square_metre),
                }
            }
            LightKind::Environment { radiance } => {
                let radiance = self
                    .amount(*radiance, shape)
                    .map_err(|message| ("radiance", message))?;
                Kind::Environment {
                    radiance: radiance.map(Radiance::from_watts_per_square_metre_steradian),
                }
            }
        })
    }

    fn intensity(
        &mut self,
        power: &PointPower,
        beam: SolidAngle,
        shape: Option<&LaneValues>,
    ) -> Result<[Intensity; MAX_LANES], (&'static str, String)> {
        match *power {
            PointPower::Intensity(amount) => {
                let lanes = self
                    .amount(amount, shape)
                    .map_err(|message| ("intensity", message))?;
                Ok(lanes.map(Intensity::from_watts_per_steradian))
            }
            PointPower::Flux(amount) => {
                let lanes = self
                    .amount(amount, shape)
                    .map_err(|message| ("flux", message))?;
                Ok(lanes.map(|lane| Flux::from_watts(lane) / beam))
            }
        }
    }
}

fn direction_of(direction: Vector) -> Result<Direction, (&'static str, String)> {
    Direction::new(direction)
        .map_err(|_| ("direction", "a direction is finite and not zero".into()))
}

fn beam_of(beam: &SpotBeam) -> Result<Beam, (&'static str, String)> {
    let cutoff = match *beam {
        SpotBeam::Uniform { cutoff }
        | SpotBeam::CosinePower { cutoff, .. }
        | SpotBeam::Smooth { cutoff, .. } => cutoff,
    };
    let degrees = cutoff.to_degrees();
    if !(degrees > 0.0 && degrees <= 180.0) {
        return Err((
            "cutoff",
            format!("a spot's cutoff lies above 0 and at most at 180 deg, not {degrees} deg"),
        ));
    }
    let cos_cutoff = cutoff.cos();
    match *beam {
        SpotBeam::Uniform { .. } => Ok(Beam::Uniform { cos_cutoff }),
        SpotBeam::CosinePower { exponent, .. }
            if exponent > 0.0 && exponent.is_finite() && degrees <= 90.0 =>
        {
            Ok(Beam::CosinePower {
                exponent,
                cos_cutoff: cos_cutoff.max(0.0),
            })
        }
        SpotBeam::CosinePower { .. } => Err((
            "falloff",
            "a power falloff has a positive exponent and a cutoff of at most 90 deg".into(),
        )),
        SpotBeam::Smooth { inner, .. }
            if inner.to_degrees() >= 0.0 && inner.to_degrees() < degrees =>
        {
            Ok(Beam::Smooth {
                cos_inner: inner.cos(),
                cos_cutoff,
            })
        }
        SpotBeam::Smooth { .. } => Err((
            "falloff",
            "the inner half angle lies between 0 and the cutoff".into(),
        )),
    }
}
