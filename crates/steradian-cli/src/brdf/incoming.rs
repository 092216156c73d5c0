//! Light that arrives at a point, by direction.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use steradian::geometry::{Direction, Spherical};
use steradian::light::{Density, LightSample};
use steradian::material::Bitmap;
use steradian::quantity::{Angle, Irradiance, SolidAngle};
use steradian_io::import::image::{self, Encoding};

use crate::status::Failure;

/// Radiance or irradiance of each lane.
pub type Lanes = [f64; 4];

/// A light that is far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FarLight {
    /// Towards it.
    direction: Direction,
    /// On a plane that faces it.
    normal_irradiance: Irradiance,
}

impl FarLight {
    /// `THETA,PHI,IRRADIANCE`: `30deg,0deg,100 W/m2`.
    pub fn parse(text: &str) -> Result<Self, String> {
        let parts: Vec<&str> = text.split(',').map(str::trim).collect();
        let [theta, phi, irradiance] = parts[..] else {
            return Err("expected THETA,PHI,IRRADIANCE such as \"30deg,0deg,100 W/m2\"".to_owned());
        };
        let angle = |text: &str| text.parse::<Angle>().map_err(|error| error.to_string());
        let irradiance: Irradiance = irradiance.parse().map_err(|error| format!("{error}"))?;
        let watts = irradiance.to_watts_per_square_metre();
        if !watts.is_finite() || watts < 0.0 {
            return Err("an irradiance is not negative".to_owned());
        }
        Ok(Self {
            direction: Spherical::new(angle(theta)?, angle(phi)?).to_direction(),
            normal_irradiance: irradiance,
        })
    }
}

/// What arrives.
pub enum Incoming {
    /// The same radiance from everywhere.
    Constant(f64),
    /// Lights, and the half angle of the caps that they are to whom lights need an extent.
    Lights(Vec<FarLight>, Angle),
    /// A picture by latitude and longitude.
    Picture(Bitmap),
}

impl Incoming {
    /// A picture whose upper edge is at θ = 0, the lower at 180°, and whose columns run from φ = 0 to 360°.
    pub fn picture(path: &Path) -> Result<Self, Failure> {
        let fail = |reason: String| Failure::message(format!("{}: {reason}", path.display()));
        let bytes = std::fs::read(path).map_err(|error| fail(error.to_string()))?;
        let bitmap =
            image::read(&bytes, Encoding::Linear).map_err(|error| fail(error.to_string()))?;
        Ok(Self::Picture(bitmap))
    }

    /// L from a direction, in W/(m² sr).
    pub fn radiance(&self, wi: Direction) -> Lanes {
        match self {
            Self::Constant(radiance) => [*radiance; 4],
            Self::Lights(lights, half_angle) => {
                let cos = half_angle.cos();
                // E_n = ∫ L cos dω = L π sin² of the half angle on a plane that faces the cap.
                let projected = PI * (1.0 - cos * cos);
                let inside = lights.iter().filter(|light| light.direction.dot(wi) >= cos);
                [inside
                    .map(|light| light.normal_irradiance.to_watts_per_square_metre() / projected)
                    .sum(); 4]
            }
            Self::Picture(bitmap) => {
                let spherical = Spherical::from_direction(wi);
                let u = spherical.phi.to_radians() / TAU;
                // Texture coordinates run upwards.
                let v = 1.0 - spherical.theta.to_radians() / PI;
                let [r, g, b, _] = bitmap.at([u, v]).map(f64::from);
                [r, g, b, (r + g + b) / 3.0]
            }
        }
    }

    /// As lights without extent: the lights themselves, or `count` patches of equal solid angle along a spiral of Fibonacci.
    pub fn samples(&self, count: u32) -> Vec<LightSample> {
        if let Self::Lights(lights, _) = self {
            let lanes = |light: &FarLight| [light.normal_irradiance; 4];
            return lights
                .iter()
                .map(|light| sample(light.direction, lanes(light)))
                .collect();
        }
        let patch = SolidAngle::SPHERE.to_steradians() / f64::from(count);
        let turn = PI * (3.0 - 5.0_f64.sqrt());
        let along = |k: u32| {
            let cos = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(count);
            Spherical::new(
                Angle::from_radians(libm::acos(cos)),
                Angle::from_radians(turn * f64::from(k)),
            )
        };
        (0..count)
            .map(|k| {
                let wi = along(k).to_direction();
                let irradiance =
                    |radiance: f64| Irradiance::from_watts_per_square_metre(radiance * patch);
                sample(wi, self.radiance(wi).map(irradiance))
            })
            .collect()
    }
}

fn sample(direction: Direction, normal_irradiance: [Irradiance; 4]) -> LightSample {
    LightSample {
        direction,
        distance: f64::INFINITY,
        normal_irradiance,
        irradiance: normal_irradiance.map(|irradiance| irradiance * direction.z().max(0.0)),
        density: Density::Delta,
        group: 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_hold_the_irradiance_of_the_whole_sphere() {
        let sky = Incoming::Constant(2.0);
        let below = |sample: &LightSample| sample.irradiance[0].to_watts_per_square_metre();
        let total: f64 = sky.samples(4096).iter().map(below).sum();
        // H = π L.
        assert!((total / (2.0 * PI) - 1.0).abs() < 1e-3, "{total}");
    }

    #[test]
    fn a_light_is_read_with_its_units() {
        let light = FarLight::parse("60deg, 0deg, 100 W/m2").unwrap();
        assert!((light.direction.z() - 0.5).abs() < 1e-15);
        for text in [
            "60deg,0deg",
            "60,0,100 W/m2",
            "60deg,0deg,100 lm",
            "60deg,0deg,-1 W/m2",
        ] {
            assert!(FarLight::parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_cap_gives_the_irradiance_of_its_light() {
        let light = FarLight::parse("0deg,0deg,10 W/m2").unwrap();
        let sky = Incoming::Lights(vec![light], Angle::from_degrees(30.0));
        let [inside, outside] = [20.0, 40.0].map(|degrees: f64| {
            sky.radiance(Spherical::new(Angle::from_degrees(degrees), Angle::ZERO).to_direction())
                [0]
        });
        // L π sin²30° = 10.
        assert!((inside * PI * 0.25 - 10.0).abs() < 1e-12 && outside == 0.0);
    }
}
