//! A surface that is measured from both sides: up to four blocks of values.

use super::basis::DiscPoint;
use super::matrix::PatchMatrix;
use super::to_spectrum;
use super::tree::TensorTree;
use crate::brdf::Scatter;
use crate::brdf::sampling::choose;
use crate::geometry::{Direction, Vector};
use crate::quantity::Spectrum;

/// Values of light that is scattered from one side to the same or to the other.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// Constant on patches.
    Matrix(PatchMatrix),
    /// Constant on the leaves of a tree.
    Tree(TensorTree),
}

impl Block {
    /// The same surface for light that goes the other way, if it is reciprocal.
    #[must_use]
    pub fn reversed(&self) -> Self {
        match self {
            Self::Matrix(matrix) => Self::Matrix(matrix.reversed()),
            Self::Tree(tree) => Self::Tree(tree.reversed()),
        }
    }

    fn value(&self, scattered: DiscPoint, incident: DiscPoint) -> f64 {
        match self {
            Self::Matrix(matrix) => matrix.value(scattered, incident),
            Self::Tree(tree) => tree.value(scattered, incident),
        }
    }

    fn total(&self, scattered: DiscPoint) -> f64 {
        match self {
            Self::Matrix(matrix) => matrix.total(scattered),
            Self::Tree(tree) => tree.total(scattered),
        }
    }

    fn hemispherical_at(&self, incident: DiscPoint) -> f64 {
        match self {
            Self::Matrix(matrix) => matrix.hemispherical_at(incident),
            Self::Tree(tree) => tree.hemispherical_at(incident),
        }
    }

    fn sample(&self, scattered: DiscPoint, total: f64, u: [f64; 2]) -> Option<DiscPoint> {
        match self {
            Self::Matrix(matrix) => matrix.sample(scattered, u),
            Self::Tree(tree) => tree.sample(scattered, total, u),
        }
    }
}

/// The side of a surface that a direction lies on.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Side {
    /// z > 0: `Back` in files of WINDOW, the interior.
    Above,
    /// z ≤ 0: `Front` in files of WINDOW, the exterior.
    Below,
}

impl Side {
    /// That of a direction.
    pub fn of(direction: Direction) -> Self {
        if direction.z() > 0.0 {
            Self::Above
        } else {
            Self::Below
        }
    }

    const fn index(self) -> usize {
        match self {
            Self::Above => 0,
            Self::Below => 1,
        }
    }

    /// The other side.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Above => Self::Below,
            Self::Below => Self::Above,
        }
    }
}

/// Up to four blocks; what has none is black.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TwoSided {
    reflection: [Option<Block>; 2],
    transmission: [Option<Block>; 2],
}

impl TwoSided {
    /// Sets what light from a side becomes on the same side.
    pub fn set_reflection(&mut self, from: Side, block: Block) {
        self.reflection[from.index()] = Some(block);
    }

    /// Sets what light from a side becomes on the other.
    pub fn set_transmission(&mut self, from: Side, block: Block) {
        self.transmission[from.index()] = Some(block);
    }

    /// What light from a side becomes on the same side.
    pub fn reflection(&self, from: Side) -> Option<&Block> {
        self.reflection[from.index()].as_ref()
    }

    /// What light from a side becomes on the other.
    pub fn transmission(&self, from: Side) -> Option<&Block> {
        self.transmission[from.index()].as_ref()
    }

    /// ρ(d_e, d_i) in 1/sr.
    pub fn value(&self, wo: Direction, wi: Direction) -> f64 {
        let from = Side::of(wi);
        let block = match from == Side::of(wo) {
            true => self.reflection(from),
            false => self.transmission(from),
        };
        block.map_or(0.0, |block| block.value(scattered(wo), incident(wi)))
    }

    /// Of the light that arrives along d_i, the shares that leave on its side and on the other.
    pub fn hemispherical(&self, wi: Direction) -> [f64; 2] {
        let from = Side::of(wi);
        [self.reflection(from), self.transmission(from)]
            .map(|block| block.map_or(0.0, |block| block.hemispherical_at(incident(wi))))
    }

    /// ∫ ρ |cosθ_i| dω_i over d_e's side, and over the other.
    pub fn totals(&self, wo: Direction) -> [f64; 2] {
        self.towards(wo)
            .map(|block| block.map_or(0.0, |block| block.total(scattered(wo))))
    }

    fn towards(&self, wo: Direction) -> [Option<&Block>; 2] {
        let side = Side::of(wo);
        [self.reflection(side), self.transmission(side.other())]
    }

    pub(super) fn evaluate(&self, wo: Direction, wi: Direction) -> Spectrum {
        to_spectrum(self.value(wo, wi))
    }

    /// A direction in proportion to ρ cosθ_i: every weight is the same.
    pub(super) fn sample(&self, wo: Direction, u: [f64; 2]) -> Option<Scatter> {
        let totals @ [reflected, transmitted] = self.totals(wo);
        let both = reflected + transmitted;
        if both <= 0.0 {
            return None;
        }
        let (is_reflected, u0) = choose(u[0], reflected / both);
        let part = usize::from(!is_reflected);
        let block = self.towards(wo)[part]?;
        let point = block.sample(scattered(wo), totals[part], [u0, u[1]])?;
        let wi = arriving(point, is_reflected == (Side::of(wo) == Side::Above))?;
        let value = self.value(wo, wi);
        Scatter::finite(wi, to_spectrum(value), value * wi.z().abs() / both)
    }

    pub(super) fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        let value = self.value(wo, wi);
        if value <= 0.0 {
            return 0.0;
        }
        let [reflected, transmitted] = self.totals(wo);
        value * wi.z().abs() / (reflected + transmitted)
    }
}

fn scattered(wo: Direction) -> DiscPoint {
    [wo.x(), wo.y()]
}

/// Incidence is named by the direction in which light travels on.
fn incident(wi: Direction) -> DiscPoint {
    [-wi.x(), -wi.y()]
}

fn arriving([x, y]: DiscPoint, above: bool) -> Option<Direction> {
    let height = (1.0 - x * x - y * y).max(0.0).sqrt();
    let z = if above { height } else { -height };
    Direction::new(Vector::new(-x, -y, z)).ok()
}
