//! glTF's material in scene files.

use steradian::quantity::{Angle, Length};
use steradian::scene::description::{
    LaneValues, PrincipledRecipe, Recipe, Scalar, Varying, absorption_of_attenuation,
};

use crate::scene_file::fields::Fields;

/// The model.
pub(super) fn read(fields: &Fields<'_>) -> Option<Recipe<Varying, Scalar>> {
    let color = |key| fields.get::<Varying>(key);
    let number = |key| fields.get::<Scalar>(key);
    let (base_color, specular_color, sheen_color) = (
        color("base_color"),
        color("specular_color"),
        color("sheen_color"),
    );
    let [metallic, roughness, specular, clearcoat] =
        ["metallic", "roughness", "specular", "clearcoat"].map(number);
    let [clearcoat_roughness, sheen_roughness, anisotropy] =
        ["clearcoat_roughness", "sheen_roughness", "anisotropy"].map(number);
    let rotation: Option<Angle> = fields.get("anisotropy_rotation");
    let (transmission, ior, thin) = (
        number("transmission"),
        fields.get("ior"),
        fields.get("thin"),
    );
    Some(Recipe::Principled(Box::new(PrincipledRecipe {
        base_color: base_color?,
        metallic: metallic?,
        roughness: roughness?,
        ior: ior?,
        specular: specular?,
        specular_color: specular_color?,
        transmission,
        thin: thin?,
        clearcoat: clearcoat?,
        clearcoat_roughness: clearcoat_roughness?,
        sheen_color: sheen_color?,
        sheen_roughness: sheen_roughness?,
        anisotropy: anisotropy?,
        anisotropy_rotation: rotation?.to_radians().into(),
    })))
}

/// What the inside of a solid absorbs.
pub(super) fn absorption(fields: &Fields<'_>) -> Option<LaneValues> {
    let (color, distance) = (
        fields.get::<LaneValues>("attenuation_color"),
        fields.get::<Length>("attenuation_distance"),
    );
    let found = absorption_of_attenuation(&color?, distance?.to_metres());
    if found.is_none() {
        let message = "expected values above 0 and up to 1, and a distance above 0";
        let span = fields.span_of("attenuation_color");
        fields.context().error(span, message, None);
    }
    found
}
