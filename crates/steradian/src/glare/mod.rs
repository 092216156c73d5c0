//! Discomfort glare: how much bright sources trouble who looks past them.
//!
//! | measure | law | where |
//! |---|---|---|
//! | position index p | how much less a source troubles away from the line of sight | [`Gaze`] |
//! | unified glare rating | UGR = 8 log₁₀(¼/L_b Σ L²ω/p²) | [`unified_glare_rating`] |
//! | UGR table of a luminaire | UGR in 19 rooms with a regular array of luminaires | [`UgrTable`] |
//! | daylight glare probability | DGP = 5.87·10⁻⁵ E_v + 0.0918 log₁₀(1 + Σ L²ω/(E_v^1.87 p²)) + 0.16 | [`daylight_glare_probability`] |
//! | daylight glare index | DGI = 10 log₁₀ Σ 0.478 L^1.6 (ω/p²)^0.8/(L_b + 0.07 ω^½ L) | [`daylight_glare_index`] |
//!
//! All are sums over sources, each a [`GlareSource`] of one luminance. They are given, or found in a picture of what an observer sees, a
//! [`FieldOfView`], or the lights of a scene, [`SeenLights`].

mod assessment;
mod cluster;
mod daylight;
mod direct_share;
mod field_of_view;
mod observer;
mod position_index;
mod standard_room;
mod ugr_table;
mod unified;

pub use assessment::{Assessment, Figure};
pub use daylight::{daylight_glare_index, daylight_glare_probability, low_light_factor};
pub use field_of_view::{Detection, FieldOfView, FieldOfViewError, FoundSource, Threshold};
pub use observer::{SeenLight, SeenLights};
pub use position_index::{GREATEST_POSITION_INDEX, Gaze};
pub use standard_room::{Reflectances, Room};
pub use ugr_table::{UgrRow, UgrTable, UgrTableError};
pub use unified::{GlareSource, unified_glare_rating};
