use serde_json::{Value, json};
use steradian::quantity::{Amount, Luminance};
use steradian::scene::description::{
    Bitmap, EmissionAmount, Interpolation, LaneValues, MaterialDescription, MaterialModel, Pattern,
    PrincipledRecipe, Recipe, Relief, Scalar, SceneDescription, Texture, Varying, Wrap,
};

use crate::building::{Buffer, mesh, refusal, scene};

/// A square of this material, in a file with one picture of a texel.
fn with(material: Value) -> SceneDescription {
    let (entries, buffer) = file(material);
    scene(entries, &buffer)
}

fn file(material: Value) -> (Value, Buffer) {
    let mut buffer = Buffer::default();
    let mut square = buffer.square();
    square["material"] = json!(0);
    let picture = buffer.view(b"#?RADIANCE\n\n-Y 1 +X 1\n\x80\x80\x80\x81");
    let entries = json!({
        "meshes": [{ "primitives": [square] }], "nodes": [{ "mesh": 0 }],
        "materials": [material],
        "images": [{ "bufferView": picture }],
        "samplers": [{ "wrapS": 33_071, "wrapT": 33_648, "magFilter": 9728 }],
        "textures": [{ "source": 0, "sampler": 0 }, { "source": 0 }],
    });
    (entries, buffer)
}

fn reflectance(material: &MaterialDescription) -> &Varying {
    match &material.model {
        MaterialModel::Lambertian { reflectance } => reflectance,
        MaterialModel::Recipe(Recipe::Principled(recipe)) => &recipe.base_color,
        other => panic!("{other:?}"),
    }
}

fn principled(material: Value) -> PrincipledRecipe<Varying, Scalar> {
    match &with(material).materials[0].model {
        MaterialModel::Recipe(Recipe::Principled(recipe)) => PrincipledRecipe::clone(recipe),
        other => panic!("{other:?}"),
    }
}

/// Factor and channel of a picture.
fn pictured(number: &Scalar) -> (f64, Option<usize>) {
    let picture = number.picture.as_ref();
    (number.factor, picture.map(|picture| picture.channel))
}

fn bitmap(texture: &Texture) -> &Bitmap {
    match &texture.pattern {
        Pattern::Bitmap(bitmap) => bitmap,
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_base_colour_is_the_reflectance() {
    let scene = with(json!({
        "name": "red",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 0.25, 0.125, 1], "baseColorTexture": { "index": 0 }, "metallicFactor": 1,
        },
    }));
    let material = &scene.materials[0];
    assert_eq!(material.name, "red");
    assert_eq!(
        reflectance(material).factor,
        LaneValues::Rgb([0.5, 0.25, 0.125])
    );
    let bitmap = bitmap(&reflectance(material).textures[0]);
    assert_eq!(bitmap.wrap, [Wrap::Clamp, Wrap::Mirror]);
    assert_eq!(bitmap.interpolation, Interpolation::Nearest);
    assert!(material.opacity.is_none());
}

#[test]
fn metal_and_roughness_are_factors_times_channels() {
    let model = json!({
        "metallicFactor": 0.75, "roughnessFactor": 0.5, "metallicRoughnessTexture": { "index": 1 },
    });
    let recipe = principled(json!({ "pbrMetallicRoughness": model }));
    assert_eq!(pictured(&recipe.metallic), (0.75, Some(2)));
    assert_eq!(pictured(&recipe.roughness), (0.5, Some(1)));
    let plain = principled(json!({}));
    assert_eq!(pictured(&plain.metallic), (1.0, None));
    assert_eq!((pictured(&plain.roughness), plain.ior), ((1.0, None), 1.5));
    assert!(plain.thin && plain.transmission.is_none());
}

#[test]
fn extensions_become_parameters() {
    let texture = json!({ "index": 1 });
    let recipe = principled(json!({ "extensions": {
        "KHR_materials_ior": { "ior": 1.33 },
        "KHR_materials_specular": {
            "specularFactor": 0.5, "specularTexture": texture, "specularColorFactor": [2, 1, 0.5],
        },
        "KHR_materials_transmission": { "transmissionFactor": 0.75, "transmissionTexture": texture },
        "KHR_materials_clearcoat": {
            "clearcoatFactor": 0.25, "clearcoatTexture": texture,
            "clearcoatRoughnessFactor": 0.125, "clearcoatRoughnessTexture": texture,
        },
        "KHR_materials_sheen": {
            "sheenColorFactor": [0.5, 0.25, 0], "sheenColorTexture": texture,
            "sheenRoughnessFactor": 0.625, "sheenRoughnessTexture": texture,
        },
        "KHR_materials_anisotropy": {
            "anisotropyStrength": 0.5, "anisotropyRotation": 0.25, "anisotropyTexture": texture,
        },
    }}));
    assert_eq!(recipe.ior, 1.33);
    assert_eq!(pictured(&recipe.specular), (0.5, Some(3)));
    assert_eq!(
        recipe.specular_color.factor,
        LaneValues::Rgb([2.0, 1.0, 0.5])
    );
    assert_eq!(pictured(&recipe.transmission.unwrap()), (0.75, Some(0)));
    assert_eq!(pictured(&recipe.clearcoat), (0.25, Some(0)));
    assert_eq!(pictured(&recipe.clearcoat_roughness), (0.125, Some(1)));
    assert_eq!(recipe.sheen_color.factor, LaneValues::Rgb([0.5, 0.25, 0.0]));
    assert_eq!(recipe.sheen_color.textures.len(), 1);
    assert_eq!(pictured(&recipe.sheen_roughness), (0.625, Some(3)));
    assert_eq!(pictured(&recipe.anisotropy), (0.5, None));
    assert_eq!(pictured(&recipe.anisotropy_rotation), (0.25, None));
}

#[test]
fn a_thickness_makes_a_solid_that_absorbs() {
    let glass = |thickness: f64| {
        json!({ "extensions": {
            "KHR_materials_transmission": { "transmissionFactor": 1 },
            "KHR_materials_volume": {
                "thicknessFactor": thickness, "attenuationDistance": 0.5, "attenuationColor": [1, 0.5, 0.25],
            },
        }})
    };
    assert!(principled(glass(0.0)).thin && !principled(glass(0.01)).thin);
    assert!(with(glass(0.0)).materials[0].media.is_clear());
    let scene = with(glass(0.01));
    let Some(LaneValues::Rgb([red, green, blue])) = scene.materials[0].media.inside else {
        panic!("{:?}", scene.materials[0].media)
    };
    // −ln .5/.5 m.
    assert!(red == 0.0 && (green - 1.386_294).abs() < 1e-6 && (blue - 2.0 * green).abs() < 1e-12);
}

#[test]
fn what_is_not_read_is_told() {
    let told = |material: Value| with(material).warnings.join("\n");
    let anisotropy = json!({ "anisotropyStrength": 1, "anisotropyTexture": { "index": 1 } });
    let told_of = told(json!({ "extensions": { "KHR_materials_anisotropy": anisotropy } }));
    assert!(
        told_of.contains("textures of anisotropy are left out"),
        "{told_of}"
    );
    let index = told(json!({ "extensions": { "KHR_materials_ior": { "ior": 0 } } }));
    assert!(index.contains("beyond 1 to 10"), "{index}");
}

#[test]
fn normal_textures_are_linear_numbers() {
    let found = with(json!({ "normalTexture": { "index": 0, "scale": 0.5 } }));
    let Some(Relief::Normals { picture, scale }) = &found.materials[0].relief else {
        panic!("{:?}", found.materials[0].relief)
    };
    assert_eq!(
        (*scale, bitmap(picture).wrap),
        (0.5, [Wrap::Clamp, Wrap::Mirror])
    );
    // (128 + ½)/256 · 2.
    assert_eq!(
        bitmap(picture).at([0.5, 0.5]),
        [257.0 / 256.0, 257.0 / 256.0, 257.0 / 256.0, 1.0]
    );
    assert_eq!(mesh(&found.shapes[0]).texture_coordinates.len(), 4);
}

#[test]
fn normal_textures_of_other_coordinates_are_told() {
    let material = |set: usize| {
        json!({
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 1 } },
            "normalTexture": { "index": 0, "texCoord": set },
        })
    };
    let told =
        "glTF: normal textures are laid by the coordinates of the base colour's (materials: 1)";
    for (set, is_told) in [(0, false), (1, true)] {
        let found = with(material(set));
        assert!(found.materials[0].relief.is_some());
        assert_eq!(
            found.warnings.iter().any(|warning| warning == told),
            is_told
        );
    }
}

#[test]
fn coordinates_are_turned_upside_down_as_pictures_are() {
    let scene = with(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 1 } } }));
    // The upper left of the picture, (0, 0) in glTF, is at the vertex (0, 0, 0).
    let mesh = mesh(&scene.shapes[0]);
    assert_eq!(
        mesh.texture_coordinates,
        [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]
    );
}

#[test]
fn texture_transforms_scale_turn_and_move() {
    let transform =
        json!({ "offset": [0.25, 0.5], "rotation": std::f64::consts::FRAC_PI_2, "scale": [2, 4] });
    let texture = json!({ "index": 1, "extensions": { "KHR_texture_transform": transform } });
    let scene = with(json!({ "pbrMetallicRoughness": { "baseColorTexture": texture } }));
    let placement = reflectance(&scene.materials[0]).textures[0].placement;
    // (u, v) of glTF = (0.1, 0.2) → scaled (0.2, 0.8) → turned (0.8, −0.2) → moved (1.05, 0.3).
    let [u, v] = placement.at([0.1, 1.0 - 0.2]);
    assert!(
        (u - 1.05).abs() < 1e-12 && (1.0 - v - 0.3).abs() < 1e-12,
        "{u} {v}"
    );
}

#[test]
fn alpha_is_opacity_where_its_mode_says_so() {
    let opacity = |material: Value| with(material).materials[0].opacity.clone();
    let base = json!({ "baseColorFactor": [1, 1, 1, 0.5], "baseColorTexture": { "index": 0 } });
    assert!(opacity(json!({ "pbrMetallicRoughness": base })).is_none());
    let mask = opacity(json!({ "pbrMetallicRoughness": base, "alphaMode": "MASK" })).unwrap();
    assert_eq!(
        (mask.factor, mask.cutoff, mask.textures.len()),
        (0.5, Some(0.5), 1)
    );
    let blend = opacity(json!({ "pbrMetallicRoughness": base, "alphaMode": "BLEND" })).unwrap();
    assert_eq!(
        (blend.factor, blend.cutoff, blend.textures.len()),
        (0.5, None, 1)
    );
    let glass =
        json!({ "extensions": { "KHR_materials_transmission": { "transmissionFactor": 0.75 } } });
    assert!(opacity(glass).is_none());
    let (entries, buffer) = file(json!({ "alphaMode": "SCREEN" }));
    assert!(refusal(entries, &buffer).contains("materials[0]: there is no alpha mode \"SCREEN\""));
}

#[test]
fn emission_is_a_luminance_of_the_factors_colour() {
    let scene = with(json!({
        "emissiveFactor": [1, 0.5, 0], "emissiveTexture": { "index": 1 }, "doubleSided": true,
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 1000 } },
    }));
    let emission = scene.shapes[0].emission.as_ref().unwrap();
    let expected = Luminance::from_candelas_per_square_metre(1000.0 * (0.2126 + 0.5 * 0.7152));
    assert_eq!(
        emission.amount,
        EmissionAmount::Radiance(Amount::Photometric(expected))
    );
    assert_eq!(emission.spectrum, Some(LaneValues::Rgb([1.0, 0.5, 0.0])));
    assert_eq!((emission.textures.len(), emission.two_sided), (1, true));
    assert_eq!(scene.lights.len(), 0);
}

#[test]
fn specular_glossiness_keeps_its_reflectance() {
    let model = json!({ "diffuseFactor": [0.5, 0.5, 0, 1], "specularFactor": [0.25, 0.5, 0.5] });
    let scene = with(json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": model } }));
    // 0.5 (1 − 0.5) + 0.25, …
    assert_eq!(
        reflectance(&scene.materials[0]).factor,
        LaneValues::Rgb([0.5, 0.75, 0.5])
    );
}

#[test]
fn vertices_colour_their_own_copy_of_a_material() {
    let (mut entries, mut buffer) = file(json!({ "name": "paint" }));
    let plain = entries["meshes"][0]["primitives"][0].clone();
    let mut painted = plain.clone();
    let colors = buffer.floats(&[[0.5, 0.25, 2.0, 0.5]; 4]);
    painted["attributes"]["COLOR_0"] = json!(colors);
    entries["meshes"][0]["primitives"] = json!([plain, painted]);
    let scene = scene(entries, &buffer);
    let names: Vec<_> = scene
        .materials
        .iter()
        .map(|material| material.name.as_str())
        .collect();
    assert_eq!(names, ["paint", "paint (2)"]);
    let textures = &reflectance(&scene.materials[1]).textures;
    assert_eq!(textures[0].pattern, Pattern::VertexColor);
    assert_eq!(mesh(&scene.shapes[1]).colors[0], [0.5, 0.25, 1.0, 0.5]);
}

#[test]
fn extensions_that_are_needed_are_known() {
    let (mut entries, buffer) = file(json!({}));
    entries["extensionsRequired"] = json!(["KHR_materials_iridescence"]);
    let told = scene(entries.clone(), &buffer).warnings;
    assert!(
        told.iter()
            .any(|warning| warning.contains("KHR_materials_iridescence is left out"))
    );
    entries["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    let says = "the file needs the extension KHR_draco_mesh_compression, which is not supported";
    assert_eq!(refusal(entries, &buffer), says);
}

#[test]
fn pictures_that_cannot_be_read_are_named() {
    let material = json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } });
    let (mut entries, buffer) = file(material);
    for (image, says) in [
        (
            json!({ "bufferView": 0 }),
            "images[0]: expected a PNG, JPEG, OpenEXR or Radiance HDR picture",
        ),
        (
            json!({ "uri": "wood%20floor.png" }),
            "cannot read wood floor.png: no such file",
        ),
        (
            json!({ "uri": "https://example.org/a.png" }),
            "is not a file beside this one",
        ),
        (json!({}), "images[0]: it names no bytes"),
    ] {
        entries["images"] = json!([image]);
        let found = refusal(entries.clone(), &buffer);
        assert!(found.contains(says), "{found}");
    }
}
