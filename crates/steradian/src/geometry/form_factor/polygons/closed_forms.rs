//! ∫ ∫ ln r over two straight edges in closed form.
//!
//! For parallel edges at the distance d, ln r is a function of x = s − t alone, and the integral is a second difference of K
//! with K″ = ½ ln(x² + d²).
//!
//! For skew lines let s and t count from the points where they come closest, with the distance h and the angle θ:
//! r² = h² + s² + t² − 2 s t cosθ. Since (s ∂ₛ + t ∂ₜ) ln r = 1 − h²/r², Gauss's theorem for the vector (s, t) ln r gives
//!
//! 2 ∫ ∫ ln r ds dt = s₂ U(s₂) − s₁ U(s₁) + t₂ V(t₂) − t₁ V(t₁) − ℓₐ ℓ_b + h² ∫ ∫ ds dt/r²
//!
//! with U(s) = ∫ ln r dt and V(t) = ∫ ln r ds, which are elementary. In coplanar lines the last term vanishes. Else the
//! substitution s sinθ = h sinh w, t sinθ = h sinh v separates it:
//!
//! ds dt/r² = ½ dv dw (1/(cosh(v − w) − cosθ) + 1/(cosh(v + w) + cosθ))
//!
//! and the second integral of 1/(cosh x − cosθ) is P(x; θ)/sinθ with P(x; θ) = (π − θ)|x| + 2 Im Li₂(e^(−|x|+iθ)).
//! P. Schröder & P. Hanrahan, "On the Form Factor between Two Polygons", SIGGRAPH 1993, were the first to give the integral in
//! closed form, by dilogarithms; the form here is short because of the substitution, and finite wherever lines touch.

use super::logarithm::along;
use super::outline::Edge;
use crate::geometry::dilogarithm::{self, Angle};

/// How many times larger than the product of the lengths the terms may be: more costs too many digits.
const LARGEST_CANCELLATION: f64 = 64.0;

/// Edges whose directions differ by less than this many rad are parallel.
const PARALLEL: f64 = 1e-14;

/// `None` for edges that are not parallel, and where the closed form loses too many digits.
pub(super) fn over_parallel_edges(a: &Edge, b: &Edge) -> Option<f64> {
    if sine(a, b) > PARALLEL {
        None
    } else if a.direction.dot(b.direction) > 0.0 {
        over_edges_along_each_other(a, b)
    } else {
        over_edges_along_each_other(a, &b.reversed())
    }
}

fn sine(a: &Edge, b: &Edge) -> f64 {
    a.direction.cross(b.direction).length()
}

fn over_edges_along_each_other(a: &Edge, b: &Edge) -> Option<f64> {
    let offset = a.middle() - b.middle();
    let along = offset.dot(b.direction);
    let distance = offset.cross(b.direction).length();
    let (half_sum, half_difference) = (0.5 * (a.length + b.length), 0.5 * (a.length - b.length));
    let reach = along.abs() + half_sum;
    (reach * reach + distance * distance < LARGEST_CANCELLATION * a.length * b.length)
        .then_some(())?;
    let term = |x: f64| twice_integrated_logarithm(x, distance);
    let outer = term(along + half_sum) + term(along - half_sum);
    Some(outer - term(along + half_difference) - term(along - half_difference))
}

/// K with K″ = ½ ln(x² + d²).
fn twice_integrated_logarithm(x: f64, d: f64) -> f64 {
    let square = x * x + d * d;
    if square == 0.0 {
        return 0.0;
    }
    0.25 * (x * x - d * d) * libm::log(square) + x * d * libm::atan2(x, d) - 0.75 * x * x
}

/// `None` for parallel edges, and where the closed form loses too many digits.
pub(super) fn over_skew_edges(a: &Edge, b: &Edge) -> Option<f64> {
    let sin = sine(a, b);
    let angle = (sin > PARALLEL).then(|| Angle::new(sin, a.direction.dot(b.direction)))?;
    let lines = Lines::new(a, b, angle)?;
    let ([s1, s2], [t1, t2]) = (lines.s, lines.t);
    let boundary = s2 * along(b, a.end) - s1 * along(b, a.start) + t2 * along(a, b.end)
        - t1 * along(a, b.start);
    Some(0.5 * (boundary - a.length * b.length + lines.inverse_square_term()))
}

/// Where two edges begin and end, measured along their lines from the points in which these come closest.
struct Lines {
    angle: Angle,
    distance: f64,
    s: [f64; 2],
    t: [f64; 2],
}

impl Lines {
    fn new(a: &Edge, b: &Edge, angle: Angle) -> Option<Self> {
        let normal = a.direction.cross(b.direction);
        let offset = b.start - a.start;
        let sin_square = angle.sin * angle.sin;
        let s1 = -offset.cross(b.direction).dot(normal) / sin_square;
        let t1 = -offset.cross(a.direction).dot(normal) / sin_square;
        let lines = Self {
            angle,
            distance: offset.dot(normal).abs() / angle.sin,
            s: [s1, s1 + a.length],
            t: [t1, t1 + b.length],
        };
        (lines.cancellation() < LARGEST_CANCELLATION).then_some(lines)
    }

    fn cancellation(&self) -> f64 {
        let reach = |[from, to]: [f64; 2]| from.abs().max(to.abs()) / (to - from);
        let lengths = (self.s[1] - self.s[0]) * (self.t[1] - self.t[0]);
        reach(self.s) + reach(self.t) + self.distance * self.distance / (self.angle.sin * lengths)
    }

    /// h² ∫ ∫ ds dt/r².
    fn inverse_square_term(&self) -> f64 {
        let stretch = self.angle.sin / self.distance;
        if !stretch.is_finite() || stretch > 1e18 {
            return 0.0;
        }
        let ([w1, w2], [v1, v2]) = (
            self.s.map(|s| Stretched::new(s * stretch)),
            self.t.map(|t| Stretched::new(t * stretch)),
        );
        let corners = [(&v2, &w2), (&v1, &w2), (&v2, &w1), (&v1, &w1)];
        let sums = potentials(&self.angle.supplement(), corners.map(|(v, w)| v.plus(w)));
        let differences = potentials(&self.angle, corners.map(|(v, w)| v.minus(w)));
        let signed = |k: usize| sums[k] - differences[k];
        let total = signed(0) - signed(1) - signed(2) + signed(3);
        0.5 * self.distance * self.distance / self.angle.sin * total
    }
}

/// A number x with e^|x|.
#[derive(Clone, Copy)]
struct Stretched {
    x: f64,
    growth: f64,
}

impl Stretched {
    /// arsinh.
    fn new(sinh: f64) -> Self {
        let size = sinh.abs();
        let growth = size + (1.0 + size * size).sqrt();
        Self {
            x: libm::log(growth).copysign(sinh),
            growth,
        }
    }

    fn plus(&self, other: &Self) -> Self {
        let x = self.x + other.x;
        if (self.x < 0.0) == (other.x < 0.0) {
            return Self {
                x,
                growth: self.growth * other.growth,
            };
        }
        let ratio = self.growth / other.growth;
        Self {
            x,
            growth: ratio.max(1.0 / ratio),
        }
    }

    fn minus(&self, other: &Self) -> Self {
        self.plus(&Self {
            x: -other.x,
            growth: other.growth,
        })
    }
}

/// P(x; θ) = (π − θ)|x| + 2 Im Li₂(e^(−|x|+iθ)).
fn potentials<const N: usize>(angle: &Angle, points: [Stretched; N]) -> [f64; N] {
    let sizes = points.map(|point| [point.x.abs(), 1.0 / point.growth]);
    let imaginary_parts = dilogarithm::imaginary_parts(angle, sizes);
    std::array::from_fn(|k| {
        (std::f64::consts::PI - angle.theta) * sizes[k][0] + 2.0 * imaginary_parts[k]
    })
}
