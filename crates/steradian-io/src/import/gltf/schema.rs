//! The JSON of glTF 2.0 as far as it is read. Names are those of the specification; indices are not checked yet.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::IgnoredAny;

/// Declares objects whose absent entries have defaults.
macro_rules! objects {
    ($($(#[$doc:meta])* $name:ident { $($field:ident: $type:ty,)* })*) => {
        $(
            $(#[$doc])*
            #[derive(Debug, Default, Deserialize)]
            #[serde(default, rename_all = "camelCase")]
            pub(super) struct $name {
                $(pub $field: $type,)*
            }
        )*
    };
}

objects! {
    Root {
        asset: Asset,
        scene: Option<usize>,
        scenes: Vec<Scene>,
        nodes: Vec<Node>,
        meshes: Vec<Mesh>,
        accessors: Vec<Accessor>,
        buffer_views: Vec<BufferView>,
        buffers: Vec<Buffer>,
        materials: Vec<Material>,
        textures: Vec<Texture>,
        images: Vec<Image>,
        samplers: Vec<Sampler>,
        cameras: Vec<Camera>,
        animations: Vec<IgnoredAny>,
        extensions_used: Vec<String>,
        extensions_required: Vec<String>,
        extensions: RootExtensions,
    }

    Asset { version: String, }

    Scene { name: Option<String>, nodes: Vec<usize>, }

    Node {
        name: Option<String>,
        children: Vec<usize>,
        mesh: Option<usize>,
        camera: Option<usize>,
        skin: Option<usize>,
        matrix: Option<[f64; 16]>,
        translation: Option<[f64; 3]>,
        rotation: Option<[f64; 4]>,
        scale: Option<[f64; 3]>,
        extensions: NodeExtensions,
    }

    Mesh { name: Option<String>, primitives: Vec<Primitive>, }

    Primitive {
        attributes: BTreeMap<String, usize>,
        indices: Option<usize>,
        material: Option<usize>,
        mode: Option<u32>,
        targets: Vec<IgnoredAny>,
    }

    Accessor {
        buffer_view: Option<usize>,
        byte_offset: usize,
        component_type: u32,
        normalized: bool,
        count: usize,
        r#type: String,
        sparse: Option<Sparse>,
    }

    Sparse { count: usize, indices: SparseIndices, values: SparseValues, }

    SparseIndices { buffer_view: usize, byte_offset: usize, component_type: u32, }

    SparseValues { buffer_view: usize, byte_offset: usize, }

    BufferView {
        buffer: usize,
        byte_offset: usize,
        byte_length: usize,
        byte_stride: Option<usize>,
    }

    Buffer { uri: Option<String>, byte_length: usize, }

    Image { uri: Option<String>, buffer_view: Option<usize>, }

    Sampler {
        mag_filter: Option<u32>,
        wrap_s: Option<u32>,
        wrap_t: Option<u32>,
    }

    Texture { sampler: Option<usize>, source: Option<usize>, }

    /// The scale is that of a normal texture.
    TextureInfo {
        index: usize,
        tex_coord: usize,
        scale: Option<f64>,
        extensions: TextureExtensions,
    }

    Material {
        name: Option<String>,
        pbr_metallic_roughness: MetallicRoughness,
        normal_texture: Option<TextureInfo>,
        emissive_factor: [f64; 3],
        emissive_texture: Option<TextureInfo>,
        alpha_mode: Option<String>,
        alpha_cutoff: Option<f64>,
        double_sided: bool,
        extensions: MaterialExtensions,
    }

    MetallicRoughness {
        base_color_factor: Option<[f64; 4]>,
        base_color_texture: Option<TextureInfo>,
        metallic_factor: Option<f64>,
        roughness_factor: Option<f64>,
        metallic_roughness_texture: Option<TextureInfo>,
    }

    EmissiveStrength { emissive_strength: Option<f64>, }

    SpecularGlossiness {
        diffuse_factor: Option<[f64; 4]>,
        diffuse_texture: Option<TextureInfo>,
        specular_factor: Option<[f64; 3]>,
    }

    Transmission { transmission_factor: f64, transmission_texture: Option<TextureInfo>, }

    Volume {
        thickness_factor: f64,
        attenuation_distance: Option<f64>,
        attenuation_color: Option<[f64; 3]>,
    }

    Ior { ior: Option<f64>, }

    Specular {
        specular_factor: Option<f64>,
        specular_texture: Option<TextureInfo>,
        specular_color_factor: Option<[f64; 3]>,
        specular_color_texture: Option<TextureInfo>,
    }

    Clearcoat {
        clearcoat_factor: f64,
        clearcoat_texture: Option<TextureInfo>,
        clearcoat_roughness_factor: f64,
        clearcoat_roughness_texture: Option<TextureInfo>,
    }

    Sheen {
        sheen_color_factor: [f64; 3],
        sheen_color_texture: Option<TextureInfo>,
        sheen_roughness_factor: f64,
        sheen_roughness_texture: Option<TextureInfo>,
    }

    Anisotropy {
        anisotropy_strength: f64,
        anisotropy_rotation: f64,
        anisotropy_texture: Option<TextureInfo>,
    }

    TextureTransform {
        offset: [f64; 2],
        rotation: f64,
        scale: Option<[f64; 2]>,
        tex_coord: Option<usize>,
    }

    Instancing { attributes: BTreeMap<String, usize>, }

    Lights { lights: Vec<Light>, }

    LightReference { light: usize, }

    Light {
        name: Option<String>,
        color: Option<[f64; 3]>,
        intensity: Option<f64>,
        r#type: String,
        range: Option<f64>,
        spot: Spot,
    }

    Spot { inner_cone_angle: f64, outer_cone_angle: Option<f64>, }

    Camera {
        name: Option<String>,
        perspective: Option<Perspective>,
        orthographic: Option<Orthographic>,
    }

    Perspective { aspect_ratio: Option<f64>, yfov: f64, }

    Orthographic { xmag: f64, ymag: f64, }
}

/// Declares the extensions of an object that are read.
macro_rules! extensions {
    ($($name:ident { $($field:ident: $type:ty = $key:literal,)* })*) => {
        $(
            #[derive(Debug, Default, Deserialize)]
            #[serde(default)]
            pub(super) struct $name {
                $(#[serde(rename = $key)] pub $field: Option<$type>,)*
            }
        )*
    };
}

extensions! {
    RootExtensions { lights: Lights = "KHR_lights_punctual", }

    NodeExtensions {
        light: LightReference = "KHR_lights_punctual",
        instancing: Instancing = "EXT_mesh_gpu_instancing",
    }

    TextureExtensions { transform: TextureTransform = "KHR_texture_transform", }

    MaterialExtensions {
        unlit: IgnoredAny = "KHR_materials_unlit",
        emissive_strength: EmissiveStrength = "KHR_materials_emissive_strength",
        specular_glossiness: SpecularGlossiness = "KHR_materials_pbrSpecularGlossiness",
        transmission: Transmission = "KHR_materials_transmission",
        volume: Volume = "KHR_materials_volume",
        ior: Ior = "KHR_materials_ior",
        specular: Specular = "KHR_materials_specular",
        clearcoat: Clearcoat = "KHR_materials_clearcoat",
        sheen: Sheen = "KHR_materials_sheen",
        anisotropy: Anisotropy = "KHR_materials_anisotropy",
    }
}
