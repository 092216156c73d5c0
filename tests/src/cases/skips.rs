//! Cases that are not run, each with its reason.

/// Cases whose id begins with `prefix` are not run.
pub struct Skip {
    /// Beginning of the id.
    pub prefix: &'static str,
    /// Why.
    pub reason: &'static str,
    /// How many cases of the tables this is.
    pub count: usize,
}

const fn skip(prefix: &'static str, count: usize, reason: &'static str) -> Skip {
    Skip {
        prefix,
        reason,
        count,
    }
}

const DIRECTIONAL: &str = "needs an environment whose radiance depends on the direction";
const SUN: &str = "needs the sun";
const SKY: &str = "needs a sky whose luminance depends on the direction";
const PATCHES: &str = "expects radiosities that are constant on each face, which is not the solution of the integral equation; the continuous cases of the same boxes are run";
const TIME: &str = "is about the time light stays in a sphere, not about steady light";
const GLASS: &str = "needs a pane of glass";

/// All of them.
pub const SKIPS: &[Skip] = &[
    skip("irradiance/sun_", 6, SUN),
    skip("irradiance/cie_overcast_tilted", 5, SKY),
    skip("irradiance/environment_linear/e2", 1, DIRECTIONAL),
    skip("irradiance/environment_linear/e3", 1, DIRECTIONAL),
    skip("irradiance/environment_power_cosine", 2, DIRECTIONAL),
    skip(
        "closed_environment/integrating_sphere_time_constant",
        2,
        TIME,
    ),
    skip(
        "closed_environment/box_radiosity_constant_faces/cube_ceiling",
        1,
        PATCHES,
    ),
    skip(
        "closed_environment/box_radiosity_constant_faces/cube_wall",
        1,
        PATCHES,
    ),
    skip(
        "closed_environment/box_radiosity_constant_faces/room",
        1,
        PATCHES,
    ),
    skip("cie171_like/sky_component_roof_opening/1x1_type1", 2, SKY),
    skip("cie171_like/sky_component_roof_opening/1x1_type3", 1, SKY),
    skip("cie171_like/sky_component_roof_opening/1x1_type8", 1, SKY),
    skip("cie171_like/sky_component_roof_opening/4x4_type1", 3, SKY),
    skip("cie171_like/sky_component_roof_opening/4x4_type3", 1, SKY),
    skip("cie171_like/sky_component_roof_glazed", 3, GLASS),
    skip("cie171_like/sc_erc_facade_opening/2x1_type1", 2, SKY),
    skip("cie171_like/sc_erc_facade_opening/2x1_type3", 1, SKY),
    skip("cie171_like/sc_erc_facade_opening/4x3_type1", 2, SKY),
    skip("cie171_like/sc_erc_facade_opening/4x3_type3", 1, SKY),
];

const MOVING: &str = "needs a light that moves";
const LIGHT_TIME: &str = "is about the time that light takes, not about steady light";

/// Those of the table of what happens in time.
pub const TIME_SKIPS: &[Skip] = &[
    skip("time/moving_point_source", 1, MOVING),
    skip("time/daily_", 6, SUN),
    skip("time/annual_", 5, SUN),
    skip("time/sphere_pulse_tail", 1, LIGHT_TIME),
    skip("time/time_of_flight", 2, LIGHT_TIME),
];

/// Why this case is not run, if it is not.
pub fn skip_of(id: &str) -> Option<&'static Skip> {
    SKIPS.iter().find(|skip| id.starts_with(skip.prefix))
}
