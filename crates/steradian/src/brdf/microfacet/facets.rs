//! The statistics of a rough surface: how its facets are turned, and which of them are seen.
//!
//! GGX: D(m) = 1/(π α_x α_y q²), q = (m_x/α_x)² + (m_y/α_y)² + m_z²; Λ(ω) = (√(1 + a²) − 1)/2.
//!
//! Beckmann: D(m) = exp(−(m_x²/α_x² + m_y²/α_y²)/m_z²)/(π α_x α_y m_z⁴); Λ(ω) = (exp(−1/a²) a/√π − erfc(1/a))/2.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | D | area of facets of normal m, by solid angle of m and area of the surface: ∫ D m_z dω = 1 | 1/sr |
//! | α_x, α_y | width along x and y | 1 |
//! | a | √((α_x ω_x)² + (α_y ω_y)²)/\|ω_z\| | 1 |
//! | G₁ | 1/(1 + Λ): share of the facets turned to ω that is seen from ω | 1 |
//! | G₂ | 1/(1 + Λ_e + Λ_i), or G₁(d_e) G₁(d_i): share seen from both directions | 1 |
//!
//! Normals are drawn as they are seen from d_e, with density G₁ D max(0, d_e·m)/d_e,z. For GGX the mirrored direction of
//! a seen facet is even on a spherical cap in a stretched space; the cap is cut where the mirrored direction must lie
//! below the surface. For Beckmann the slope towards d_e is found by Newton's method from its distribution function.
//!
//! Source: B. Walter et al., EGSR 2007, eq. 25–34; E. Heitz, JCGT 3 (2014), §5, eq. 99 for G₂;
//! J. Dupuy and A. Benyoub, HPG 2023; K. Eto and Y. Tokuyoshi, SIGGRAPH Asia 2023 (bounded caps). Valid for facets
//! that are large against the wavelength.
//!
//! ```
//! use steradian::brdf::{Facets, Slopes};
//! use steradian::geometry::Direction;
//! // D(n) = 1/(π α²) for both: .25⁻²/π = 16/π.
//! let facets = Facets::isotropic(Slopes::Ggx, 0.25)?;
//! assert!((facets.density(Direction::Z) - 16.0 / std::f64::consts::PI).abs() < 1e-12);
//! # Ok::<(), steradian::brdf::ModelError>(())
//! ```

use std::f64::consts::{FRAC_2_SQRT_PI, PI, TAU};

use crate::brdf::ModelError;
use crate::brdf::error::in_range;
use crate::geometry::{Direction, Vector};

/// The distribution of slopes.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub enum Slopes {
    /// Of Trowbridge and Reitz, with long tails.
    Ggx,
    /// Gaussian.
    Beckmann,
}

/// Whether facets that hide from one direction tend to hide from the other.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub enum Shadowing {
    /// High facets are seen from everywhere: G₂ = 1/(1 + Λ_e + Λ_i).
    HeightCorrelated,
    /// Independent: G₂ = G₁(d_e) G₁(d_i).
    Separable,
}

/// A rough surface.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Facets {
    slopes: Slopes,
    alpha: [f64; 2],
    shadowing: Shadowing,
}

impl Facets {
    /// As rough along x as along y.
    ///
    /// # Errors
    /// If `alpha` lies outside .001 … 1.
    pub fn isotropic(slopes: Slopes, alpha: f64) -> Result<Self, ModelError> {
        Self::anisotropic(slopes, [alpha; 2])
    }

    /// From the widths along x and y.
    ///
    /// # Errors
    /// If a width lies outside .001 … 1.
    pub fn anisotropic(slopes: Slopes, alpha: [f64; 2]) -> Result<Self, ModelError> {
        for width in alpha {
            in_range("alpha", width, [0.001, 1.0])?;
        }
        Ok(Self {
            slopes,
            alpha,
            shadowing: Shadowing::HeightCorrelated,
        })
    }

    /// The same facets with this shadowing of reflected light.
    pub const fn with_shadowing(mut self, shadowing: Shadowing) -> Self {
        self.shadowing = shadowing;
        self
    }

    /// Whether both widths are the same.
    pub fn is_isotropic(&self) -> bool {
        self.alpha[0] == self.alpha[1]
    }

    /// The distribution of slopes.
    pub const fn slopes(&self) -> Slopes {
        self.slopes
    }

    /// The widths along x and y.
    pub const fn widths(&self) -> [f64; 2] {
        self.alpha
    }

    /// Whether masking and shadowing are correlated.
    pub const fn visibility(&self) -> Shadowing {
        self.shadowing
    }

    /// As rough along x as along y, by this width.
    pub(super) const fn with_width(self, alpha: f64) -> Self {
        Self {
            alpha: [alpha; 2],
            ..self
        }
    }

    /// α along a tangential direction of length 1, and α²/(α_x α_y).
    pub(super) fn width_along(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        let [p, q] = [x / self.alpha[0], y / self.alpha[1]];
        let square = 1.0 / (p * p + q * q);
        (square.sqrt(), square / (self.alpha[0] * self.alpha[1]))
    }

    /// √(α_y/α_x), if the surface is anisotropic.
    pub(super) fn stretch(&self) -> Option<f64> {
        (!self.is_isotropic()).then(|| (self.alpha[1] / self.alpha[0]).sqrt())
    }

    /// How many times as many azimuths as an isotropic surface it takes to see these facets all around.
    pub(super) fn azimuths(&self) -> usize {
        let ratio = self.alpha[0].max(self.alpha[1]) / self.alpha[0].min(self.alpha[1]);
        (ratio.ceil() as usize).min(12)
    }

    /// D(m).
    pub fn density(&self, m: Direction) -> f64 {
        let [x, y] = [m.x() / self.alpha[0], m.y() / self.alpha[1]];
        let (squares, z_squared) = (x * x + y * y, m.z() * m.z());
        let scale = PI * self.alpha[0] * self.alpha[1];
        match self.slopes {
            _ if m.z() <= 0.0 => 0.0,
            Slopes::Ggx => {
                let q = squares + z_squared;
                1.0 / (scale * q * q)
            }
            Slopes::Beckmann => libm::exp(-squares / z_squared) / (scale * z_squared * z_squared),
        }
    }

    /// G₁(ω).
    pub fn masking(&self, direction: Direction) -> f64 {
        1.0 / (1.0 + self.lambda(direction))
    }

    /// G₂ for two directions on the same side.
    pub fn shadowing(&self, wo: Direction, wi: Direction) -> f64 {
        match self.shadowing {
            Shadowing::HeightCorrelated => 1.0 / (1.0 + self.lambda(wo) + self.lambda(wi)),
            Shadowing::Separable => self.masking(wo) * self.masking(wi),
        }
    }

    /// Λ(ω).
    fn lambda(&self, direction: Direction) -> f64 {
        let [x, y] = [self.alpha[0] * direction.x(), self.alpha[1] * direction.y()];
        let squares = x * x + y * y;
        if squares == 0.0 {
            return 0.0;
        }
        let a = squares.sqrt() / direction.z().abs().max(f64::MIN_POSITIVE);
        match self.slopes {
            Slopes::Ggx => 0.5 * ((1.0 + a * a).sqrt() - 1.0),
            Slopes::Beckmann => {
                let inverse = 1.0 / a;
                let gauss = libm::exp(-inverse * inverse) * a * 0.5 * FRAC_2_SQRT_PI;
                0.5 * (gauss - libm::erfc(inverse)).max(0.0)
            }
        }
    }

    /// Density of the normals seen from `wo`, which lies above the surface.
    pub fn visible_density(&self, wo: Direction, m: Direction) -> f64 {
        self.masking(wo) * self.density(m) * wo.dot(m).max(0.0) / wo.z()
    }

    /// A normal of that density.
    pub(super) fn sample_visible(&self, wo: Direction, u: [f64; 2]) -> Option<Direction> {
        let stretched = self.stretched(wo)?;
        let normal = match self.slopes {
            Slopes::Ggx => cap_direction(stretched.z(), u) + stretched.to_vector(),
            Slopes::Beckmann => gaussian_facet(stretched, u),
        };
        self.unstretched(normal)
    }

    /// A mirrored direction, that may lie below the surface; of density [`reflection_density`](Self::reflection_density).
    pub(super) fn sample_reflection(&self, wo: Direction, u: [f64; 2]) -> Option<Direction> {
        let normal = match self.slopes {
            Slopes::Ggx => {
                let stretched = self.stretched(wo)?;
                let cap = cap_direction(self.bound(wo) * stretched.z(), u);
                self.unstretched(cap + stretched.to_vector())?
            }
            Slopes::Beckmann => self.sample_visible(wo, u)?,
        };
        Some(normal.mirror(wo))
    }

    /// Density of the mirrored direction whose facet's normal is `m`.
    pub(super) fn reflection_density(&self, wo: Direction, m: Direction) -> f64 {
        match self.slopes {
            Slopes::Ggx => {
                let [x, y] = [self.alpha[0] * wo.x(), self.alpha[1] * wo.y()];
                let length = (x * x + y * y + wo.z() * wo.z()).sqrt();
                self.density(m) / (2.0 * (self.bound(wo) * wo.z() + length))
            }
            Slopes::Beckmann => self.visible_density(wo, m) / (4.0 * wo.dot(m)),
        }
    }

    /// How far below the horizon the cap of mirrored directions reaches, of the unbounded cap.
    fn bound(&self, wo: Direction) -> f64 {
        let a = self.alpha[0].min(self.alpha[1]);
        let s = 1.0 + (wo.x() * wo.x() + wo.y() * wo.y()).sqrt();
        let (a2, s2) = (a * a, s * s);
        (1.0 - a2) * s2 / (s2 + a2 * wo.z() * wo.z())
    }

    /// To the space in which the surface has widths 1.
    fn stretched(&self, wo: Direction) -> Option<Direction> {
        Direction::new(Vector::new(
            self.alpha[0] * wo.x(),
            self.alpha[1] * wo.y(),
            wo.z(),
        ))
        .ok()
    }

    fn unstretched(&self, normal: Vector) -> Option<Direction> {
        Direction::new(Vector::new(
            self.alpha[0] * normal.x,
            self.alpha[1] * normal.y,
            normal.z.max(0.0),
        ))
        .ok()
    }
}

/// Even on the part of the sphere above z = −`depth`.
fn cap_direction(depth: f64, u: [f64; 2]) -> Vector {
    let z = (1.0 - u[0]) * (1.0 + depth) - depth;
    let sin = (1.0 - z * z).max(0.0).sqrt();
    let (y, x) = libm::sincos(TAU * u[1]);
    Vector::new(sin * x, sin * y, z)
}

/// A normal of Gaussian slopes of width 1 as seen from `wo`: slopes (p, q) in the frame of `wo`'s azimuth, normal
/// (−p, −q, 1).
fn gaussian_facet(wo: Direction, u: [f64; 2]) -> Vector {
    let sin = (wo.x() * wo.x() + wo.y() * wo.y()).sqrt();
    let (cos_phi, sin_phi) = if sin > 0.0 {
        (wo.x() / sin, wo.y() / sin)
    } else {
        (1.0, 0.0)
    };
    let p = visible_slope(wo.z(), sin, u[0]);
    let q = visible_slope(1.0, 0.0, u[1]);
    Vector::new(
        -(cos_phi * p - sin_phi * q),
        -(sin_phi * p + cos_phi * q),
        1.0,
    )
}

/// The slope p below which lies the share `u` of ∫ (cosθ − p sinθ)⁺ exp(−p²)/√π dp.
///
/// Newton's method inside a bracket that is halved when it leaves it; slopes beyond ±6 have a probability below 1e-16.
fn visible_slope(cos: f64, sin: f64, u: f64) -> f64 {
    let below =
        |p: f64| 0.5 * cos * libm::erfc(-p) + 0.25 * FRAC_2_SQRT_PI * sin * libm::exp(-p * p);
    let (mut low, mut high) = (-6.0, if cos < 6.0 * sin { cos / sin } else { 6.0 });
    let target = u * below(high);
    let mut p = 0.5 * (low + high);
    for _ in 0..64 {
        let excess = below(p) - target;
        if excess > 0.0 {
            high = p;
        } else {
            low = p;
        }
        let slope = 0.5 * FRAC_2_SQRT_PI * (cos - p * sin) * libm::exp(-p * p);
        let newton = p - excess / slope;
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        if (next - p).abs() < 1e-13 {
            return next;
        }
        p = next;
    }
    p
}
