//! Lights: emission of shapes and lights without a shape, in lanes.

use super::description::{
    EmissionAmount, EmissionDescription, LaneValues, LightDescription, LightKind, PointPower,
    ShapeDescription, SpotBeam,
};
use super::forms::{Forms, copies};
use super::{Fault, Part, Problem};
use crate::geometry::{Direction, Point, Vector};
use crate::light::{AreaLight, Beam, Kind, Light, LightId, PointLight, SpotLight};
use crate::quantity::{
    Amount, Angle, Area, Exitance, Flux, Intensity, Irradiance, Quantity, Radiance, SolidAngle,
};
use crate::shape::{Placed, ShapeId};
use crate::spectrum::{Lanes, MAX_LANES};

/// A spot of a smaller half angle, in degrees, would have no solid angle left beside the rounding of its cosine.
const NARROWEST_BEAM: f64 = 1e-4;

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
        let light = Kind::Area(AreaLight {
            shape: ShapeId(form as u32),
            radiance: self.radiance(emission, placed.form.area())?,
            two_sided: emission.two_sided,
        });
        let id = self.push(forms.names[form].clone(), emission.group.as_deref(), light);
        for part in &placed.parts {
            forms.parts[part.0 as usize].light = Some(id);
        }
        Ok(())
    }

    /// Lights without a shape.
    pub fn add_lights(&mut self, lights: &[LightDescription], problems: &mut Vec<Problem>) {
        for (index, light) in lights.iter().enumerate() {
            let part = Part::Light(index);
            if light.repeat.is_some() && light.kind.is_infinitely_far() {
                let message = "a light infinitely far away cannot be repeated";
                problems.push(Problem::at(part, "repeat", message));
                continue;
            }
            let steps = copies(light.repeat.as_ref(), part, problems);
            if let Err((key, message)) = self.add_copies(light, index, &steps) {
                problems.push(Problem::at(part, key, message));
            }
        }
    }

    fn add_copies(
        &mut self,
        light: &LightDescription,
        index: usize,
        steps: &[Vector],
    ) -> Result<(), Fault> {
        let own = light.name.clone();
        let name = own.unwrap_or_else(|| format!("light {index}"));
        for (copy, step) in steps.iter().enumerate() {
            let kind = self.kind(light, *step)?;
            let name = match light.repeat {
                Some(_) => format!("{name}[{copy}]"),
                None => name.clone(),
            };
            self.push(name, light.group.as_deref(), kind);
        }
        Ok(())
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

    fn kind(&mut self, light: &LightDescription, step: Vector) -> Result<Kind, Fault> {
        let shape = light.spectrum.as_ref();
        match &light.kind {
            LightKind::Point { position, power } => Ok(Kind::Point(PointLight {
                position: position_of(*position + step)?,
                intensity: self.intensity(power, SolidAngle::SPHERE, shape)?,
            })),
            LightKind::Spot {
                position,
                direction,
                beam,
                power,
            } => {
                let beam = beam_of(beam)?;
                Ok(Kind::Spot(SpotLight {
                    position: position_of(*position + step)?,
                    axis: direction_of(*direction)?,
                    beam,
                    peak_intensity: self.intensity(power, beam.solid_angle(), shape)?,
                }))
            }
            LightKind::Directional {
                direction,
                irradiance,
            } => Ok(Kind::Directional {
                direction: direction_of(*direction)?,
                irradiance: self
                    .amount(*irradiance, shape)
                    .map_err(|message| ("irradiance", message))?
                    .map(Irradiance::from_watts_per_square_metre),
            }),
            LightKind::Environment { radiance } => Ok(Kind::Environment {
                radiance: self
                    .amount(*radiance, shape)
                    .map_err(|message| ("radiance", message))?
                    .map(Radiance::from_watts_per_square_metre_steradian),
            }),
        }
    }

    fn intensity(
        &mut self,
        power: &PointPower,
        beam: SolidAngle,
        shape: Option<&LaneValues>,
    ) -> Result<[Intensity; MAX_LANES], Fault> {
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

impl LightKind {
    fn is_infinitely_far(&self) -> bool {
        matches!(self, Self::Directional { .. } | Self::Environment { .. })
    }
}

fn position_of(position: Point) -> Result<Point, Fault> {
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
