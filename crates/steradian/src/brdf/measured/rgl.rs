//! The tables of EPFL's Realistic Graphics Lab: reflection on warped half vectors, isotropic or not.
//!
//! With m = (d_e + d_i)/|d_e + d_i|, u = (√(2θ_m/π), (φ_m + π)/(2π)) and the map w of a density of visible facets,
//!
//! ρ cosθ_i = S(w⁻¹(u)) D(u)/(4 σ(d_e)),
//!
//! without D/(4σ) for tables that hold the product. All are bilinear on grids; S, w and the luminance, from which
//! directions are drawn before they are warped, are linear in φ_e and θ_e between their nodes. In isotropic tables φ_m is counted from φ_e.
//! The table's own incidence is d_e here, for which it has its densities: a surface does not care.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | D | density of facets, cosθ_m included as the file has it | 1/sr |
//! | σ | projected area of the visible facets | 1 |
//! | S | what is left of the reflection | 1 |
//!
//! The density is p(w⁻¹(u)) q(u)/(4 (d_e·m) 2π² u₁ sinθ_m), with the densities p of luminance and q of visible facets. The weight is
//! S/p D/(4σ)/q × the Jacobian: bounded as far as the luminance follows S, which it is made for. The albedo is the mean of 32 × 32 weights.
//! Source: J. Dupuy, W. Jakob, *An adaptive parameterization for efficient material acquisition and rendering* (SIGGRAPH Asia
//! 2018), eq. 12 and §5.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::MeasuredError;
use super::reading::Reading;
use super::warp::{Mixture, Sheets, Warp};
use crate::brdf::Scatter;
use crate::brdf::sampling::{above, mean_over_square};
use crate::geometry::{Direction, Vector};
use crate::quantity::Spectrum;

/// Points along either side of the square for the albedo.
const ALBEDO: u32 = 32;

/// What a file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct RglTables {
    /// Nodes of φ_e in rad, rising; one or two for isotropic surfaces.
    pub phi: Vec<f64>,
    /// Nodes of θ_e in rad, rising.
    pub theta: Vec<f64>,
    /// D, one sheet.
    pub facets: Sheets,
    /// σ, one sheet.
    pub projected_area: Sheets,
    /// Density of visible facets, a sheet for each node.
    pub visible_facets: Sheets,
    /// Luminance, a sheet for each node.
    pub luminance: Sheets,
    /// S of red, green and blue, three sheets for each node.
    pub colours: Sheets,
    /// S by wavelength in nm, as many sheets for each node.
    pub spectra: Option<(Vec<f64>, Sheets)>,
    /// Whether D/(4σ) is a factor.
    pub has_factor: bool,
}

/// A table of RGL.
#[derive(Clone, Debug, PartialEq)]
pub struct Rgl {
    tables: RglTables,
    visible_facets: Warp,
    luminance: Warp,
    /// Part of the full turn that φ_e covers: 1, 2 or 4, for mirrored halves or quarters.
    symmetry: u32,
}

/// What belongs to d_e.
struct View {
    /// d_e in the part of the turn that the table covers.
    wo: Vector,
    theta: f64,
    phi: f64,
    mixture: Mixture,
    /// Signs of x and y.
    mirror: [f64; 2],
}

impl Rgl {
    /// From the tables of a file.
    ///
    /// # Errors
    /// If nodes do not rise, or a table has too few or too many sheets for them.
    pub fn new(tables: RglTables) -> Result<Self, MeasuredError> {
        for nodes in [&tables.phi, &tables.theta] {
            check_nodes(nodes)?;
        }
        let nodes = tables.phi.len() * tables.theta.len();
        let mut needed = vec![
            (&tables.facets, 1),
            (&tables.projected_area, 1),
            (&tables.visible_facets, nodes),
            (&tables.luminance, nodes),
            (&tables.colours, 3 * nodes),
        ];
        if let Some((wavelengths, sheets)) = &tables.spectra {
            check_nodes(wavelengths)?;
            needed.push((sheets, wavelengths.len() * nodes));
        }
        for (sheets, needed) in needed {
            let found = sheets.slices();
            if found != needed {
                return Err(MeasuredError::Count { needed, found });
            }
        }
        let covered = tables.phi[tables.phi.len() - 1] - tables.phi[0];
        let symmetry = if tables.phi.len() <= 2 {
            1.0
        } else {
            (TAU / covered).round()
        };
        Ok(Self {
            visible_facets: Warp::new(tables.visible_facets.clone()),
            luminance: Warp::new(tables.luminance.clone()),
            symmetry: symmetry as u32,
            tables,
        })
    }

    /// Whether the azimuth does not matter.
    pub fn is_isotropic(&self) -> bool {
        self.tables.phi.len() <= 2
    }

    /// The wavelengths in nm, if it has any.
    pub fn wavelengths(&self) -> Option<&[f64]> {
        self.tables
            .spectra
            .as_ref()
            .map(|(nodes, _)| nodes.as_slice())
    }

    pub(super) fn evaluate(&self, wo: Direction, wi: Direction, reading: Reading) -> Spectrum {
        if !above(wo, wi) {
            return Spectrum::ZERO;
        }
        let view = self.view(wo);
        let Some(place) = self.half_vector(&view, wi) else {
            return Spectrum::ZERO;
        };
        let factor = self.factor(&view, place) / wi.z();
        let warped = self.visible_facets.invert(&view.mixture, place);
        self.lanes(&view, warped, factor, reading)
    }

    pub(super) fn sample(&self, wo: Direction, u: [f64; 2], reading: Reading) -> Option<Scatter> {
        if wo.z() <= 0.0 {
            return None;
        }
        let view = self.view(wo);
        let warped = self.luminance.sample(&view.mixture, u);
        let place = self.visible_facets.sample(&view.mixture, warped);
        let wi = self.mirrored(&view, place).filter(|wi| wi.z() > 0.0)?;
        Scatter::finite(wi, self.evaluate(wo, wi, reading), self.pdf(wo, wi))
    }

    pub(super) fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        if !above(wo, wi) {
            return 0.0;
        }
        let view = self.view(wo);
        let Some(place) = self.half_vector(&view, wi) else {
            return 0.0;
        };
        let warped = self.visible_facets.invert(&view.mixture, place);
        let density = self.visible_facets.density(&view.mixture, place)
            * self.luminance.density(&view.mixture, warped);
        let half_length = 0.5 * (wo.to_vector() + wi.to_vector()).length();
        let stretch = 2.0 * PI * PI * place[0] * libm::sin(angle(place[0])) * 4.0 * half_length;
        if stretch > 0.0 {
            density / stretch
        } else {
            0.0
        }
    }

    pub(super) fn albedo(&self, wo: Direction, reading: Reading) -> Spectrum {
        let lanes = mean_over_square(ALBEDO, |u| {
            let weight = self.sample(wo, u, reading).map(|scatter| scatter.weight());
            weight.unwrap_or(Spectrum::ZERO).to_lanes().map(f64::from)
        });
        Spectrum::from_lanes(lanes.map(|lane| lane as f32))
    }

    fn view(&self, wo: Direction) -> View {
        let toward_negative = |x: f64| if x > 0.0 { -1.0 } else { 1.0 };
        let mirror = match self.symmetry {
            0 | 1 => [1.0; 2],
            4 => [toward_negative(wo.x()), toward_negative(wo.y())],
            _ => [toward_negative(wo.y()); 2],
        };
        let wo = Vector::new(wo.x() * mirror[0], wo.y() * mirror[1], wo.z());
        let across = (wo.x * wo.x + wo.y * wo.y).sqrt();
        let (theta, phi) = (libm::atan2(across, wo.z), libm::atan2(wo.y, wo.x));
        let mixture = match self.is_isotropic() {
            true => mixture((0, 0.0), interval(&self.tables.theta, theta), 0),
            false => mixture(
                interval(&self.tables.phi, phi),
                interval(&self.tables.theta, theta),
                self.tables.theta.len(),
            ),
        };
        View {
            wo,
            theta,
            phi,
            mixture,
            mirror,
        }
    }

    /// The place of the half vector in the unit square.
    fn half_vector(&self, view: &View, wi: Direction) -> Option<[f64; 2]> {
        let wi = Vector::new(wi.x() * view.mirror[0], wi.y() * view.mirror[1], wi.z());
        let sum = view.wo + wi;
        let across = (sum.x * sum.x + sum.y * sum.y).sqrt();
        let theta = libm::atan2(across, sum.z);
        let from = if self.is_isotropic() { view.phi } else { 0.0 };
        let turn = (libm::atan2(sum.y, sum.x) - from + PI) / TAU;
        (sum.z > 0.0).then(|| [(theta / FRAC_PI_2).sqrt(), turn - turn.floor()])
    }

    fn mirrored(&self, view: &View, place: [f64; 2]) -> Option<Direction> {
        let theta = angle(place[0]);
        let from = if self.is_isotropic() { view.phi } else { 0.0 };
        let phi = (2.0 * place[1] - 1.0) * PI + from;
        let half = Direction::from_polar(libm::sin(theta), libm::cos(theta), phi);
        let cos = half.dot(view.wo);
        let wi = half.to_vector() * (2.0 * cos) - view.wo;
        let turned = Vector::new(wi.x * view.mirror[0], wi.y * view.mirror[1], wi.z);
        Direction::new(turned).ok().filter(|_| cos > 0.0)
    }

    /// D/(4σ), or 1.
    fn factor(&self, view: &View, place: [f64; 2]) -> f64 {
        if !self.tables.has_factor {
            return 1.0;
        }
        let only: Mixture = [(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)];
        let towards = [(view.theta / FRAC_PI_2).sqrt(), (view.phi + PI) / TAU];
        let area = self.tables.projected_area.at(&only, towards);
        match area > 0.0 {
            true => self.tables.facets.at(&only, place) / (4.0 * area),
            false => 0.0,
        }
    }

    /// S times a factor, in lanes.
    fn lanes(&self, view: &View, place: [f64; 2], factor: f64, reading: Reading) -> Spectrum {
        match (reading, &self.tables.spectra) {
            (Reading::Wavelengths(wavelengths), Some((nodes, sheets))) => {
                let lane = |wavelength: f64| {
                    let (low, part) = interval(nodes, wavelength);
                    let high = (low + 1).min(nodes.len() - 1);
                    let [a, b] = [low, high].map(|channel| {
                        sheets.at(&channels(&view.mixture, channel, nodes.len()), place)
                    });
                    (factor * (a + part * (b - a))) as f32
                };
                Spectrum::from_lanes(wavelengths.map(lane))
            }
            _ => reading.of_colour([0, 1, 2].map(|channel| {
                let sheets = &self.tables.colours;
                factor * sheets.at(&channels(&view.mixture, channel, 3), place)
            })),
        }
    }
}

/// The sheets of a channel in a table that has several for each node.
fn channels(mixture: &Mixture, channel: usize, count: usize) -> Mixture {
    mixture.map(|(node, weight)| (node * count + channel, weight))
}

fn mixture((p, s): (usize, f64), (t, r): (usize, f64), width: usize) -> Mixture {
    let node = |p: usize, t: usize| p * width + t;
    let next = |at: usize, part: f64| if part > 0.0 { at + 1 } else { at };
    [
        (node(p, t), (1.0 - s) * (1.0 - r)),
        (node(next(p, s), t), s * (1.0 - r)),
        (node(p, next(t, r)), (1.0 - s) * r),
        (node(next(p, s), next(t, r)), s * r),
    ]
}

/// The node before, and the part of the way to the next one; ends are held.
fn interval(nodes: &[f64], at: f64) -> (usize, f64) {
    let last = nodes.len() - 1;
    let low = nodes.partition_point(|node| *node <= at).saturating_sub(1);
    if low == last || at <= nodes[low] {
        return (low, 0.0);
    }
    (low, (at - nodes[low]) / (nodes[low + 1] - nodes[low]))
}

fn check_nodes(nodes: &[f64]) -> Result<(), MeasuredError> {
    let rise = nodes.windows(2).all(|pair| pair[0] < pair[1]);
    match rise && !nodes.is_empty() && nodes.iter().all(|node| node.is_finite()) {
        true => Ok(()),
        false => Err(MeasuredError::Nodes),
    }
}

/// θ_m of the first coordinate.
fn angle(u: f64) -> f64 {
    u * u * FRAC_PI_2
}
