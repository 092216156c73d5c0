//! A node of the tree: four balls of lights, and how much light may come from each.
//!
//! Of lights in a ball of radius R, whose middle is at the distance d from the receiver in the direction ω, about the irradiance
//!
//! I = I_max ē(θ) s̄(θ_i) / max(d², R²/3)
//!
//! arrives. Both cosines are means over the ball, seen under sinθ_u = R/d = r, of which the part t lies on the bright side of an edge:
//!
//! f = t max(c, (c + r)/2), t = (1 + x/r)/2 within 0 and 1.
//!
//! | symbol | meaning | s̄, of the receiver | ē, of the lights |
//! |---|---|---|---|
//! | c | cosine in the middle of the ball | cosθ_i | cos max(θ − θ_o, 0) |
//! | x | how far inside the edge that is, per d | cosθ_i | sin(θ_o + θ_e − θ), of at most a right angle |
//!
//! At a plane f is the mean of max(h, 0)/d over heights h between (c − r)d and (c + r)d, (c + r)²/(4r) where the plane cuts the ball.
//! R²/3 is the mean square distance of the points of a box from its middle. A receiver without normal has no s̄, a light without edge
//! t = 1. So I is nearly what arrives, and it is 0 only where nothing of the ball can: t bounds what an edge lets pass.
//!
//! Sines come from cross products, which keep their digits at small angles, so that x is right to some 10 roundings; r is enlarged by
//! more than that, and R by the rounding of coordinates. The four balls are computed side by side, in the same order of operations on
//! every machine.
//!
//! A surface with a [highlight](super::highlight) puts s̄ (1 − w) + w t l in the place of s̄, where w is the share of its light that the
//! highlight reflects.
//!
//! Source of the form: A. Conty Estevez, C. Kulla (2018), eq. 3. Its cosines are bounds over the ball, cos max(θ − θ_u, 0); with means a
//! sample's standard deviation is a half to a third of theirs under lamps in rows below a ceiling.

use std::f64::consts::PI;

use glam::{Vec3, Vec4};

use super::bounds::Bounds;
use super::highlight::Highlight;
use super::number::Number;

/// By how much sines and cosines may be wrong: 16 roundings of 2⁻²⁴ are 10⁻⁶.
const SLACK: f32 = 4e-6;

/// Metres within which a light counts as here.
const NEAREST: f32 = 1e-6;

/// Where light is gathered.
#[derive(Copy, Clone, Debug, Default, PartialEq)]
pub(in crate::transport) struct Receiving {
    pub point: Vec3,
    /// Of a receiver that takes no light from behind.
    pub normal: Option<Vec3>,
    /// Of such a receiver, if it has one.
    pub highlight: Option<Highlight>,
}

/// A ball of lights in single precision, or several column by column.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(in crate::transport) struct Ball<N> {
    center: [N; 3],
    radius: N,
    axis: [N; 3],
    /// Cosine and sine of θ_o.
    spread: [N; 2],
    /// Cosine and sine of θ_o + θ_e, at most π: no edge.
    edge: [N; 2],
    intensity: N,
}

/// Four balls, with what follows below each. A ball that is missing has no intensity.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(super) struct Node {
    balls: Ball<Vec4>,
    links: [u32; WIDTH],
}

/// Balls of a node.
pub(super) const WIDTH: usize = 4;

/// Marks a link to a light.
const LIGHT: u32 = 1 << 31;

/// What is below a ball.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Below {
    Node(usize),
    Light(usize),
}

impl Node {
    /// Without balls.
    pub const EMPTY: Self = Self {
        balls: Ball {
            center: [Vec4::ZERO; 3],
            radius: Vec4::ZERO,
            axis: [Vec4::ZERO; 3],
            spread: [Vec4::ZERO; 2],
            edge: [Vec4::ZERO; 2],
            intensity: Vec4::ZERO,
        },
        links: [LIGHT; WIDTH],
    };

    /// Puts a ball in; `unit` is the intensity that counts as 1, so that single precision holds what distances make of it.
    pub fn set(&mut self, k: usize, bounds: &Bounds, unit: f64, below: Below) {
        let (center, cone, balls) = (bounds.center(), bounds.cone, &mut self.balls);
        let rounding = (center.abs().element_sum() + bounds.extent().length()) * 1e-6;
        balls.radius[k] = (0.5 * bounds.extent().length() + rounding) as f32;
        for coordinate in 0..3 {
            balls.center[coordinate][k] = center[coordinate] as f32;
            balls.axis[coordinate][k] = cone.axis[coordinate] as f32;
        }
        let edge = cos_sin((cone.spread + cone.reach).min(PI));
        for (part, value) in cos_sin(cone.spread).into_iter().enumerate() {
            balls.spread[part][k] = value;
            balls.edge[part][k] = edge[part];
        }
        balls.intensity[k] = (bounds.intensity / unit) as f32;
        self.links[k] = match below {
            Below::Node(number) => number as u32,
            Below::Light(number) => LIGHT | number as u32,
        };
    }

    #[inline(always)]
    pub fn below(&self, k: usize) -> Below {
        let link = self.links[k];
        match link & LIGHT {
            0 => Below::Node(link as usize),
            _ => Below::Light((link & !LIGHT) as usize),
        }
    }

    /// I of each ball, in units of the tree.
    #[inline(always)]
    pub fn importance(&self, at: &Receiving) -> [f32; WIDTH] {
        self.balls.importance(at).to_array()
    }

    /// One of the balls.
    pub fn ball(&self, k: usize) -> Ball<f32> {
        let Ball {
            center,
            radius,
            axis,
            spread,
            edge,
            intensity,
        } = self.balls;
        Ball {
            center: center.map(|column| column[k]),
            radius: radius[k],
            axis: axis.map(|column| column[k]),
            spread: spread.map(|column| column[k]),
            edge: edge.map(|column| column[k]),
            intensity: intensity[k],
        }
    }
}

impl Ball<f32> {
    /// Whether nothing can be of importance.
    pub fn is_dark(&self) -> bool {
        self.intensity == 0.0
    }
}

impl<N: Number> Ball<N> {
    /// I, in units of the tree.
    #[inline(always)]
    pub fn importance(&self, at: &Receiving) -> N {
        let one = N::splat(1.0);
        let point = at.point.to_array().map(N::splat);
        let span: [N; 3] = std::array::from_fn(|axis| point[axis] - self.center[axis]);
        let squared = dot(span, span).most(N::splat(NEAREST * NEAREST));
        let per_distance = one / squared.root();
        let way = span.map(|coordinate| coordinate * per_distance);
        let r = self.radius * per_distance + N::splat(SLACK);
        let received = at.normal.map_or(one, |normal| {
            let cos = -dot(normal.to_array().map(N::splat), way);
            let diffuse = mean(cos, cos, r);
            at.highlight.map_or(diffuse, |highlight| {
                let share = N::splat(highlight.gloss.share);
                diffuse + share * (within(cos, r) * highlight.over(way, r) - diffuse)
            })
        });
        let near = squared.most(self.radius * self.radius * N::splat(1.0 / 3.0));
        self.intensity * received * self.emitted(way, r) / near
    }

    /// ē.
    #[inline(always)]
    fn emitted(&self, way: [N; 3], r: N) -> N {
        let [zero, one] = [0.0, 1.0].map(N::splat);
        let ([cos_spread, sin_spread], [cos_edge, sin_edge]) = (self.spread, self.edge);
        let across = cross(self.axis, way);
        let (cos, sin) = (dot(self.axis, way), dot(across, across).root());
        let turned = cos * cos_spread + sin * sin_spread;
        let beyond = cos.if_reaching(cos_spread, one, turned);
        let inside = sin_edge * cos - cos_edge * sin;
        let near = cos_edge * cos + sin_edge * sin;
        let inside = near.if_above(zero, inside, one.signed_as(inside));
        // Of an angle of π there is no edge.
        (-one).if_reaching(cos_edge, one, mean(beyond, inside, r))
    }
}

#[inline(always)]
pub(super) fn dot<N: Number>(a: [N; 3], b: [N; 3]) -> N {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn cross<N: Number>(a: [N; 3], b: [N; 3]) -> [N; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// f.
#[inline(always)]
fn mean<N: Number>(cos: N, inside: N, r: N) -> N {
    let middle = (cos + r) * N::splat(0.5);
    within(inside, r) * cos.most(middle).most(N::splat(0.0))
}

/// t.
#[inline(always)]
fn within<N: Number>(inside: N, r: N) -> N {
    let [zero, half, one] = [0.0, 0.5, 1.0].map(N::splat);
    (inside / r * half + half).most(zero).least(one)
}

fn cos_sin(angle: f64) -> [f32; 2] {
    let (sin, cos) = libm::sincos(angle);
    [cos as f32, sin as f32]
}
