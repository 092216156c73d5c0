//! Which extensions are read, which approximated, and which stand in the way.

use super::error::GltfError;
use super::notes::Notes;
use super::schema::Root;

/// Read as they are meant, or told of where they are met.
const READ: [&str; 14] = [
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// Finer points of reflection that are left out.
const REFLECTION: [&str; 3] = [
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_iridescence",
];

/// Nothing to do with light.
const WITHOUT_LIGHT: [&str; 4] = [
    "KHR_animation_pointer",
    "KHR_materials_variants",
    "KHR_xmp",
    "KHR_xmp_json_ld",
];

/// Refuses a file that cannot be read without an extension, and tells of those that are passed over.
pub(super) fn check(root: &Root, notes: &mut Notes) -> Result<(), GltfError> {
    let is = |list: &[&str], name: &String| list.contains(&name.as_str());
    let known =
        |name: &String| is(&READ, name) || is(&REFLECTION, name) || is(&WITHOUT_LIGHT, name);
    if let Some(name) = root.extensions_required.iter().find(|name| !known(name)) {
        return Err(GltfError::Extension(name.clone()));
    }
    let used = root.extensions_used.iter().chain(&root.extensions_required);
    for name in used {
        if is(&REFLECTION, name) {
            notes.tell(format!(
                "{name} is left out: its surfaces reflect without it"
            ));
        } else if !known(name) {
            notes.tell(format!("{name} is not read"));
        }
    }
    Ok(())
}
