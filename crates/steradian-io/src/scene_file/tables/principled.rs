//! Keys of glTF's material.

use steradian::quantity::{Angle, Length, Quantity};

use super::materials::OPACITY_KEY;
use super::{NUMBER, VARYING};
use crate::scene_file::keys::{Key, Kind, Value};
use crate::scene_file::value::Read;

pub const PRINCIPLED: Kind = Kind::new(
    "principled",
    "The metallic-roughness material of glTF with its extensions",
    &[
        Key::required(
            "base_color",
            VARYING,
            "Reflectance below the gloss, highlights of a metal, tint of transmission, 0 to 1",
        ),
        Key::default("metallic", NUMBER, "0", "Share of metal, 0 to 1"),
        Key::default(
            "roughness",
            NUMBER,
            "1",
            "Root of the width of the facets' slopes, 0 to 1",
        ),
        Key::default("ior", Value::Number, "1.5", "Index of refraction, 1 to 10"),
        Key::default(
            "specular",
            NUMBER,
            "1",
            "Strength of a dielectric's highlights, 0 to 1",
        ),
        Key::default(
            "specular_color",
            VARYING,
            "1",
            "Their colour along the normal, 0 or more",
        ),
        Key::optional(
            "transmission",
            NUMBER,
            "Share of the dielectric that lets light through instead of scattering it, 0 to 1",
        ),
        Key::default(
            "thin",
            Value::Flag,
            "true",
            "Whether it is a sheet without inside; false for the surface of a solid",
        ),
        Key::optional(
            "attenuation_color",
            Value::Lanes,
            "What is left of white light after `attenuation_distance` inside a solid, above 0 to 1",
        ),
        Key::required(
            "attenuation_distance",
            Length::VALUE,
            "The distance at which `attenuation_color` is left",
        )
        .beside("attenuation_color"),
        Key::default("clearcoat", NUMBER, "0", "Strength of a clear coat, 0 to 1"),
        Key::default("clearcoat_roughness", NUMBER, "0", "Its roughness, 0 to 1"),
        Key::default("sheen_color", VARYING, "0", "Colour of a sheen, 0 to 1"),
        Key::default("sheen_roughness", NUMBER, "0", "Its roughness, 0 to 1"),
        Key::default(
            "anisotropy",
            NUMBER,
            "0",
            "How much wider the slopes are along the tangent, 0 to 1",
        ),
        Key::default(
            "anisotropy_rotation",
            Value::Quantity(&[Angle::TABLE]),
            "\"0 deg\"",
            "From the first tangent to that one",
        ),
        OPACITY_KEY,
    ],
);
