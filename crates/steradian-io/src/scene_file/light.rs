//! `[[lights]]`: lights without a surface.

use steradian::geometry::Vector;
use steradian::quantity::Angle;
use steradian::scene::description::{
    EnvironmentAmount, EnvironmentDescription, LightDescription, LightKind, PointPower, SpotBeam,
};

use super::fields::Fields;
use super::keys::Value;
use super::luminaire;
use super::node::Node;
use super::placement;
use super::spectrum::LightSpectrum;
use super::tables::{FALLOFF, FALLOFF_NAMES, FALLOFF_VALUE, LIGHTS};
use super::texture;
use super::value::{Read, choice};

/// Where the middle of a picture of all directions is seen.
const NORTH: Vector = Vector::new(0.0, 1.0, 0.0);

/// Reads one light.
pub(super) fn read(node: Node<'_>) -> Option<LightDescription> {
    let (kind, fields) = node.kind(&LIGHTS)?;
    let kind = match kind {
        "point" => point(&fields),
        "spot" => spot(&fields),
        "directional" => directional(&fields),
        "luminaire" => luminaire::read(&fields),
        _ => environment(&fields),
    };
    let (name, group) = (fields.get("name"), fields.get("group"));
    let (spectrum, repeat) = (fields.get("spectrum"), placement::repeat(&fields));
    let spectrum = spectrum.map(|LightSpectrum(spectrum)| spectrum);
    let schedule = fields.get("schedule");
    Some(LightDescription {
        name,
        group,
        spectrum,
        schedule,
        repeat,
        kind: kind?,
    })
}

fn point(fields: &Fields<'_>) -> Option<LightKind> {
    let (position, power) = (placement::point(fields, "position"), power(fields));
    Some(LightKind::Point {
        position: position?,
        power: power?,
    })
}

fn spot(fields: &Fields<'_>) -> Option<LightKind> {
    let (position, direction) = (
        placement::point(fields, "position"),
        placement::direction(fields, "direction"),
    );
    let (beam, power) = (beam(fields), power(fields));
    Some(LightKind::Spot {
        position: position?,
        direction: direction?,
        beam: beam?,
        power: power?,
    })
}

fn directional(fields: &Fields<'_>) -> Option<LightKind> {
    let (direction, irradiance) = (
        placement::direction(fields, "direction"),
        fields.get("irradiance"),
    );
    Some(LightKind::Directional {
        direction: direction?,
        irradiance: irradiance?,
    })
}

fn environment(fields: &Fields<'_>) -> Option<LightKind> {
    if !fields.has("file") {
        let radiance = fields.get("radiance");
        return radiance.map(|radiance| LightKind::Environment { radiance });
    }
    let middle = match fields.has("middle") {
        true => placement::direction(fields, "middle"),
        false => Some(NORTH),
    };
    let (amount, picture) = (picture_amount(fields), texture::of_directions(fields));
    Some(LightKind::EnvironmentMap(EnvironmentDescription {
        picture: picture?,
        middle: middle?,
        amount: amount?,
    }))
}

fn picture_amount(fields: &Fields<'_>) -> Option<EnvironmentAmount> {
    let unit = fields.get("unit").map(EnvironmentAmount::Unit);
    if !fields.has("irradiance") {
        return unit;
    }
    if fields.has("unit") {
        let message = "keys `unit` and `irradiance` of the environment light exclude each other";
        let span = fields.span_of("irradiance");
        fields.context().error(span, message, None);
    }
    fields.get("irradiance").map(EnvironmentAmount::Irradiance)
}

fn power(fields: &Fields<'_>) -> Option<PointPower> {
    let intensity = fields.get("intensity").map(PointPower::Intensity);
    intensity.or(fields.get("flux").map(PointPower::Flux))
}

/// `cutoff` and `falloff`, or `beam_angle`.
fn beam(fields: &Fields<'_>) -> Option<SpotBeam> {
    if fields.has("beam_angle") {
        return half_peak_beam(fields);
    }
    let (cutoff, falloff) = (fields.get("cutoff"), fields.get("falloff"));
    let cutoff: Angle = cutoff?;
    Some(match falloff? {
        Falloff::Uniform => SpotBeam::Uniform { cutoff },
        Falloff::Power(exponent) => SpotBeam::CosinePower { exponent, cutoff },
        Falloff::Inner(inner) => SpotBeam::Smooth { inner, cutoff },
    })
}

/// The beam cosⁿθ over the half-space that has half its peak at half the beam angle: n = ln ½ / ln cos(beam/2).
fn half_peak_beam(fields: &Fields<'_>) -> Option<SpotBeam> {
    let beam: Angle = fields.get("beam_angle")?;
    let half = beam.to_radians() / 2.0;
    if !(half > 0.0 && half < Angle::QUARTER_TURN.to_radians()) {
        let message = format!(
            "a beam angle lies between 0 and 180 deg, not {} deg",
            beam.to_degrees()
        );
        fields
            .context()
            .error(fields.span_of("beam_angle"), message, None);
        return None;
    }
    let exponent = libm::log(0.5) / libm::log(libm::cos(half));
    Some(SpotBeam::CosinePower {
        exponent,
        cutoff: Angle::QUARTER_TURN,
    })
}

/// How the intensity of a spot falls off towards its cutoff.
enum Falloff {
    Uniform,
    Power(f64),
    Inner(Angle),
}

impl Read for Falloff {
    const VALUE: Value = FALLOFF_VALUE;

    fn read(node: Node<'_>) -> Option<Self> {
        if !node.toml.is_table() {
            return choice(node, FALLOFF_NAMES).map(|_| Self::Uniform);
        }
        let fields = node.record(&FALLOFF)?;
        fields
            .get("power")
            .map(Self::Power)
            .or(fields.get("inner").map(Self::Inner))
    }
}
