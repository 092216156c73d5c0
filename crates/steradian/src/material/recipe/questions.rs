//! What is known of a model before its numbers are.

use super::{RadianceKind, Recipe};

impl<L, N> Recipe<L, N> {
    /// Whether light goes through the surface.
    pub fn transmits(&self) -> bool {
        match self {
            Self::DiffuseTransmission { .. }
            | Self::Dielectric { .. }
            | Self::Pane { .. }
            | Self::Measured(_) => true,
            Self::Radiance { kind, .. } => matches!(kind, RadianceKind::Trans { .. }),
            Self::Mixture { parts, .. } => parts.iter().any(Self::transmits),
            Self::Principled(recipe) => recipe.transmission.is_some(),
            _ => false,
        }
    }

    /// Whether a measured surface is read at the wavelengths of each path.
    pub fn follows_wavelengths(&self) -> bool {
        match self {
            Self::Measured(table) => table.is_at_wavelengths(),
            Self::Mixture { parts, .. } => parts.iter().any(Self::follows_wavelengths),
            _ => false,
        }
    }

    /// Whether single directions are all that it couples.
    pub fn is_specular(&self) -> bool {
        match self {
            Self::Mixture { parts, .. } => parts.iter().all(Self::is_specular),
            Self::Conductor { roughness, .. } | Self::Dielectric { roughness, .. } => {
                roughness.is_none()
            }
            Self::Mirror { .. } | Self::Pane { .. } => true,
            _ => false,
        }
    }

    /// The key, in a scene file, of a model's parameter for which this was found.
    pub fn key(&self, parameter: &'static str, found: f64) -> &'static str {
        match parameter {
            "alpha" if matches!(self, Self::Radiance { .. }) => "roughness",
            "alpha" => self.key_of_alpha(found),
            "weight" | "weights" => "weights",
            "transmitted specularity" => "transmitted_specularity",
            "clearcoat roughness" => "clearcoat_roughness",
            "sheen roughness" => "sheen_roughness",
            "anisotropy rotation" => "anisotropy_rotation",
            "base color" => "base_color",
            "sheen color" => "sheen_color",
            "specular color" => "specular_color",
            "diffuse and glossy reflectance" if matches!(self, Self::Radiance { .. }) => {
                "specularity"
            }
            "glossy reflectance" if matches!(self, Self::Ward { .. }) => "specular",
            "eta" if !matches!(self, Self::Conductor { .. }) => "ior",
            "kappa" => "k",
            "eta + kappa" => "eta",
            "internal transmittance" => "transmittance",
            "diffuse reflectance" | "diffuse and glossy reflectance" => "diffuse",
            "glossy reflectance" => "glossy",
            "reflectance and transmittance" => "reflectance",
            known => known,
        }
    }

    fn key_of_alpha(&self, found: f64) -> &'static str {
        let alpha = match self {
            Self::Conductor { roughness, .. }
            | Self::Dielectric { roughness, .. }
            | Self::Plastic { roughness, .. } => roughness.map(|roughness| roughness.alpha),
            Self::Ward { alpha, .. } => Some(*alpha),
            _ => None,
        };
        match alpha {
            Some([x, y]) if x != y && x == found => "alpha_x",
            Some([x, y]) if x != y => "alpha_y",
            _ => "alpha",
        }
    }
}
