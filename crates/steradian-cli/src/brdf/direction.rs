//! Directions by their angles.

use clap::Args;
use steradian::geometry::{Direction, Spherical};
use steradian::quantity::Angle;

/// Towards the light.
#[derive(Args, Clone, Copy, Debug)]
pub struct Incident {
    /// Angle of d_i, towards the light, to the normal, with its unit; beyond 90deg on the inside
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "0 deg",
        allow_hyphen_values = true
    )]
    pub theta_i: Angle,
    /// Azimuth of d_i
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "0 deg",
        allow_hyphen_values = true
    )]
    pub phi_i: Angle,
}

/// Towards the viewer.
#[derive(Args, Clone, Copy, Debug)]
pub struct Viewer {
    /// Angle of d_e, towards the viewer, to the normal, with its unit; beyond 90deg on the inside
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "0 deg",
        allow_hyphen_values = true
    )]
    pub theta_o: Angle,
    /// Azimuth of d_e; 180deg faces a light of azimuth 0
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "180 deg",
        allow_hyphen_values = true
    )]
    pub phi_o: Angle,
}

impl Incident {
    /// d_i.
    pub fn direction(&self) -> Direction {
        Spherical::new(self.theta_i, self.phi_i).to_direction()
    }
}

impl Viewer {
    /// d_e.
    pub fn direction(&self) -> Direction {
        Spherical::new(self.theta_o, self.phi_o).to_direction()
    }
}
