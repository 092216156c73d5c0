//! A luminaire: the intensity of a measured table, from a point or from a luminous opening.
//!
//! | emission | law |
//! |---|---|
//! | from a point | E_n = k I(d)/r² |
//! | from an opening | L(d) = k I(d)/A_p(d), the same from every point of the opening that d sees |
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | d | direction away from the luminaire, in its axes: C0 is +x, C90 is +y, its light goes to −z | |
//! | I | intensity of the table | that of the table |
//! | k | what a 1 of the table stands for, with dimming, maintenance and a stated flux | W/sr per lane |
//! | A_p | area of the opening projected along d | m² |
//! | Φ = k ∫ I dω | flux, the same for both | W |
//!
//! An opening is a convex body that shines from all of its surface, so that ∫ L cosθ dA over what d sees is I(d): seen from afar, and
//! in total, both are the same. Close to an opening the laboratory's table does not say how the light is spread over it; even
//! luminance is an assumption. A flat opening that shines along its own plane, which no flat opening does, has no finite radiance there;
//! its irradiance is finite all the same.
//!
//! A luminaire is often recessed, so that its opening lies in the very plane of a ceiling. It is moved by a
//! [clearance](crate::shape::Surfaces::clearance) along its aim, 4·10⁻⁶ of the scene's diagonal, so that rays meet it before they meet
//! the ceiling. Rays to a point end there, too.
//!
//! Source: CIE S 017:2020, 17-21-045 (intensity) and 17-25-001 (luminaire); ANSI/IES LM-63-19, §5.9 (luminous openings); EN
//! 13032-1:2004, §4.3 (planes).

mod body;
mod opening;

use std::sync::Arc;

pub use body::{Body, Extent};
pub use opening::Opening;

use super::area::towards_area;
use super::{Density, FarField, Incident};
use crate::geometry::{Direction, Frame, Point};
use crate::quantity::{Flux, Intensity, Length, SolidAngle};
use crate::shape::{Form, ShapeId};
use crate::spectrum::MAX_LANES;

/// A luminaire.
#[derive(Clone, Debug)]
pub struct LuminaireLight {
    /// The middle of its opening.
    pub position: Point,
    /// Its axes: C0, C90, and against its aim.
    pub frame: Frame,
    /// I by direction in these axes.
    pub far_field: Arc<FarField>,
    /// k: what a 1 of the table is in each lane.
    pub unit: [Intensity; MAX_LANES],
    /// As its file says; a point where it emits as one.
    pub opening: Opening,
    /// How it shines.
    pub outlet: Outlet,
}

/// How a luminaire shines.
#[derive(Clone, Debug)]
pub enum Outlet {
    /// As a point.
    Point {
        /// Where rays to it end: off the surface that it may be mounted in.
        end: Point,
    },
    /// From an opening.
    Surface {
        /// The shape that it is.
        shape: ShapeId,
        /// Both sides shine.
        two_sided: bool,
        /// How large it looks.
        extent: Extent,
    },
}

impl LuminaireLight {
    /// Φ = k ∫ I dω of each lane.
    pub fn flux(&self) -> [Flux; MAX_LANES] {
        let integral = SolidAngle::from_steradians(self.far_field.flux());
        self.unit.map(|unit| unit * integral)
    }

    /// The way its light goes: γ = 0.
    pub fn aim(&self) -> Direction {
        -self.frame.normal()
    }

    /// I of each lane towards a direction away from it.
    pub fn intensity(&self, away: Direction) -> [Intensity; MAX_LANES] {
        let intensity = self.far_field.intensity(self.frame.to_local(away));
        self.unit.map(|unit| unit * intensity)
    }

    /// The shape that its opening is, and whether both of its sides shine.
    pub fn surface(&self) -> Option<(ShapeId, bool)> {
        match self.outlet {
            Outlet::Point { .. } => None,
            Outlet::Surface {
                shape, two_sided, ..
            } => Some((shape, two_sided)),
        }
    }

    /// What [`unit`](Self::unit) is multiplied with to be the intensity of a point or the radiance of an opening: I, or I/A_p.
    pub fn factor(&self, away: Direction) -> f64 {
        let local = self.frame.to_local(away);
        let intensity = self.far_field.intensity(local);
        match &self.outlet {
            Outlet::Point { .. } => intensity,
            Outlet::Surface { extent, .. } => match extent.projected_area(local) {
                area if area > 0.0 => intensity / area,
                _ => 0.0,
            },
        }
    }

    pub(crate) fn incident<'a>(
        &self,
        point: Point,
        u: [f64; 2],
        form: impl Fn(ShapeId) -> &'a Form,
    ) -> Option<Incident> {
        let (direction, distance, density) = match self.outlet {
            Outlet::Point { .. } => {
                let towards = self.position - point;
                let direction = Direction::new(towards).ok()?;
                (direction, towards.length(), Density::Delta)
            }
            Outlet::Surface {
                shape, two_sided, ..
            } => {
                let (direction, distance, pdf) = towards_area(form(shape), two_sided, point, u)?;
                (direction, distance, Density::SolidAngle(pdf))
            }
        };
        let per_unit = match density {
            Density::Delta => Intensity::from_watts_per_steradian(self.factor(-direction))
                .normal_irradiance_at(Length::from_metres(distance))
                .to_watts_per_square_metre(),
            Density::SolidAngle(pdf) => self.factor(-direction) / pdf,
        };
        (per_unit > 0.0).then(|| Incident {
            direction,
            distance,
            normal_irradiance: self.unit.map(|unit| {
                crate::quantity::Irradiance::from_watts_per_square_metre(
                    unit.to_watts_per_steradian() * per_unit,
                )
            }),
            density,
        })
    }
}

#[cfg(test)]
mod tests;
