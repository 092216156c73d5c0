//! ∫ n · (r × dr)/r² along closed contours of lines and arcs, of what lies above the horizon.
//!
//! On a circle of radius ϱ in the plane with normal w, at the height h over the element and with its centre p aside, let u
//! point from the element's foot to the centre, v = w × u, and φ count from u. Then r² = A + B cosφ with A = p² + h² + ϱ²
//! and B = 2ϱp, and
//!
//! n · (r × dr) = (N₀ + N₁ cosφ − ϱ h (n·v) sinφ) dφ, N₀ = ϱ² n·w, N₁ = ϱ (p n·w − h n·u)
//!
//! All three integrals are elementary. With S = √(A² − B²), k = √((A − B)/(A + B)) and the angle D, whose tangent is
//! (1 − k) sin ½φ cos ½φ/(cos² ½φ + k sin² ½φ), that of N₀ + N₁ cosφ is
//!
//! (φ − 2D) ϱ² (n·w (S + h² + ϱ² − p²) + 2 p h n·u)/(S (S + A)) + 2 N₁ D/B
//!
//! in which nothing cancels, be the element on the axis (B = 0, D/B stays finite) or near the circle (S = 0).
//!
//! Where the contour dips below the horizon it is closed along the horizon, by the angle from the point where it leaves
//! to the one where it comes back.

use std::f64::consts::TAU;

use super::polygon::edge_term;
use crate::geometry::{Direction, Vector};

/// A part of a contour, relative to the element.
#[derive(Clone, Copy, Debug)]
pub(super) enum Piece {
    /// A straight line.
    Line([Vector; 2]),
    /// Part of a circle between two angles, run through upwards or downwards.
    Arc(Circle, [f64; 2]),
}

/// A circle and its frame; see the module.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circle {
    center: Vector,
    radius: f64,
    u: Vector,
    v: Vector,
    w: Direction,
}

/// Part of a contour above the horizon: where it begins, where it ends, and its integral.
struct Visible {
    ends: [Vector; 2],
    integral: f64,
}

/// The configuration factor of what the closed contour encloses.
pub(super) fn factor(normal: Direction, contour: &[Piece]) -> f64 {
    let visible: Vec<Visible> = contour
        .iter()
        .flat_map(|piece| piece.visible(normal))
        .collect();
    let next = visible.iter().cycle().skip(1);
    let along_horizon =
        |(part, next): (&Visible, &Visible)| edge_term(normal, part.ends[1], next.ends[0]);
    let sum: f64 = visible.iter().map(|part| part.integral).sum();
    let closing: f64 = visible.iter().zip(next).map(along_horizon).sum();
    (sum + closing).abs() / TAU
}

impl Piece {
    fn visible(&self, normal: Direction) -> Vec<Visible> {
        match *self {
            Self::Line(ends) => visible_line(normal, ends).into_iter().collect(),
            Self::Arc(circle, [from, to]) if from <= to => circle.visible(normal, [from, to]),
            Self::Arc(circle, [from, to]) => {
                let turned = |Visible {
                                  ends: [a, b],
                                  integral,
                              }| Visible {
                    ends: [b, a],
                    integral: -integral,
                };
                circle
                    .visible(normal, [to, from])
                    .into_iter()
                    .rev()
                    .map(turned)
                    .collect()
            }
        }
    }
}

fn visible_line(normal: Direction, [from, to]: [Vector; 2]) -> Option<Visible> {
    let [height_from, height_to] = [normal.dot(from), normal.dot(to)];
    let crossing = || (from * height_to - to * height_from) / (height_to - height_from);
    let ends = match (height_from >= 0.0, height_to >= 0.0) {
        (true, true) => [from, to],
        (true, false) => [from, crossing()],
        (false, true) => [crossing(), to],
        (false, false) => return None,
    };
    Some(Visible {
        ends,
        integral: edge_term(normal, ends[0], ends[1]),
    })
}

impl Circle {
    /// The circle of this radius around `center` in the plane perpendicular to `w`.
    pub(super) fn new(center: Vector, w: Direction, radius: f64) -> Self {
        let aside = center - w * w.dot(center);
        let u = Direction::new(aside)
            .unwrap_or_else(|_| crate::geometry::Frame::from_normal(w).tangent());
        // Once more, for `aside` may be a rest of rounding.
        let u = Direction::new(u.to_vector() - w * w.dot(u)).unwrap_or(u);
        Self {
            center,
            radius,
            u: u.to_vector(),
            v: w.cross(u),
            w,
        }
    }

    /// The directions at the angle `theta` from the Z axis; azimuths count from X.
    pub(super) fn of_latitude(theta: crate::quantity::Angle) -> Self {
        Self {
            center: Direction::Z * theta.cos(),
            radius: theta.sin(),
            u: Direction::X.to_vector(),
            v: Direction::Y.to_vector(),
            w: Direction::Z,
        }
    }

    /// Whether it is as small as rounding on the unit sphere.
    pub(super) fn is_point(&self) -> bool {
        self.radius < f64::EPSILON
    }

    /// The whole circle, beginning at its lowest point.
    pub(super) fn whole(self, normal: Direction) -> Piece {
        let top = self.top(normal);
        Piece::Arc(self, [top - 0.5 * TAU, top + 0.5 * TAU])
    }

    /// The angle of the highest point.
    fn top(&self, normal: Direction) -> f64 {
        libm::atan2(normal.dot(self.v), normal.dot(self.u))
    }

    pub(super) fn at(&self, angle: f64) -> Vector {
        let (sin, cos) = libm::sincos(angle);
        self.center + (self.u * cos + self.v * sin) * self.radius
    }

    /// The parts of an arc above the horizon, upwards.
    fn visible(&self, normal: Direction, [from, to]: [f64; 2]) -> Vec<Visible> {
        let rise = self.radius * libm::hypot(normal.dot(self.u), normal.dot(self.v));
        let height = normal.dot(self.center);
        let part = |[from, to]: [f64; 2]| Visible {
            ends: [self.at(from), self.at(to)],
            integral: self.integral(normal, to) - self.integral(normal, from)
                + self.sine_term(normal, from, to),
        };
        if height >= rise {
            return vec![part([from, to])];
        }
        if height <= -rise {
            return Vec::new();
        }
        let half_width = libm::acos(-height / rise);
        let top = self.top(normal);
        let turns = libm::ceil((from - top - half_width) / TAU) as i32
            ..=libm::floor((to - top + half_width) / TAU) as i32;
        let middle = |turn: i32| top + TAU * f64::from(turn);
        let clipped = |middle: f64| [from.max(middle - half_width), to.min(middle + half_width)];
        turns.map(|turn| part(clipped(middle(turn)))).collect()
    }

    /// An antiderivative of N₀ + N₁ cosφ over r².
    fn integral(&self, normal: Direction, angle: f64) -> f64 {
        let (h, p, radius) = (
            self.w.dot(self.center),
            self.center.dot(self.u),
            self.radius,
        );
        let (near, far) = (
            (p - radius) * (p - radius) + h * h,
            (p + radius) * (p + radius) + h * h,
        );
        let (s, a, k) = ((near * far).sqrt(), 0.5 * (near + far), (near / far).sqrt());
        let (nu, nw) = (normal.dot(self.u), normal.dot(self.w));
        let (sin, cos) = libm::sincos(0.5 * angle);
        // D = atan2(B t, 1) with the t of which nothing cancels.
        let tangent = 2.0 * sin * cos / ((1.0 + k) * far * (cos * cos + k * sin * sin));
        let b = 2.0 * radius * p;
        let d = libm::atan(b * tangent);
        let d_over_b = if b == 0.0 { tangent } else { d / b };
        let weight = nw * (s + h * h + radius * radius - p * p) + 2.0 * p * h * nu;
        let round = if s > 0.0 {
            (angle - 2.0 * d) * radius * radius * weight / (s * (s + a))
        } else {
            0.0
        };
        round + 2.0 * radius * (p * nw - h * nu) * d_over_b
    }

    /// The integral of −ϱ h (n·v) sinφ over r².
    fn sine_term(&self, normal: Direction, from: f64, to: f64) -> f64 {
        let (h, p) = (self.w.dot(self.center), self.center.dot(self.u));
        let start = self.at(from).length_squared();
        let change = (libm::cos(to) - libm::cos(from)) / start;
        let b = 2.0 * self.radius * p;
        let logarithm_over_b = if b * change == 0.0 {
            change
        } else {
            libm::log1p(b * change) / b
        };
        if start > 0.0 {
            self.radius * h * normal.dot(self.v) * logarithm_over_b
        } else {
            0.0
        }
    }
}

#[cfg(test)]
impl Circle {
    /// The integral along the whole circle, whatever the horizon.
    pub(super) fn integral_of_all(&self, normal: Direction) -> f64 {
        self.integral(normal, 0.5 * TAU) - self.integral(normal, -0.5 * TAU)
    }
}
