//! Sixteen paths at rough metals, side by side.

use steradian_kernel::Work;

use super::super::light_samples::Places;
use super::super::wide::{WIDTH, Wide, get, put, wide};
use crate::brdf::Metal;

/// The greatest number below 1.
const BELOW_ONE: f32 = 1.0 - 0.5 * f32::EPSILON;

/// Paths at rough metals.
#[derive(Clone, Debug, Default)]
#[repr(align(64))]
pub(super) struct Block {
    /// Axes of the surface; the third is the shading normal.
    pub axes: [[Wide; 3]; 3],
    pub places: Places,
    /// Towards the viewer, along the axes.
    pub viewer: [Wide; 3],
    pub metal: Parameters,
    /// Of draws, those of light that facets have passed on.
    pub later: Wide,
    /// A direction in which light may come: of a light sample, then of the model's own.
    pub direction: [Wide; 3],
    /// ρ cosθ_i of it, and its density.
    pub value: [Wide; 4],
    pub pdf: Wide,
}

/// What the metals of a block are like.
#[derive(Clone, Debug, Default)]
pub(super) struct Parameters {
    alpha: [Wide; 2],
    correlated: Wide,
    eta: [Wide; 4],
    kappa: [Wide; 4],
}

impl Parameters {
    pub fn set(&mut self, lane: usize, metal: &Metal) {
        put(&mut self.alpha, lane, metal.alpha);
        self.correlated[lane] = metal.correlated;
        put(&mut self.eta, lane, metal.eta);
        put(&mut self.kappa, lane, metal.kappa);
    }

    #[inline(always)]
    fn at(&self, lane: usize) -> Metal {
        Metal {
            alpha: get(&self.alpha, lane),
            correlated: self.correlated[lane],
            eta: get(&self.eta, lane),
            kappa: get(&self.kappa, lane),
        }
    }
}

/// ρ cosθ_i and the density of each block's direction.
pub(super) struct Evaluate<'a>(pub &'a mut [Block]);

impl Work for Evaluate<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for block in self.0 {
            block.evaluate();
        }
    }
}

/// Directions of the metals' facets.
pub(super) struct Draw<'a>(pub &'a mut [Block], pub [&'a [f32]; 2]);

impl Work for Draw<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self(blocks, u) = self;
        for (number, block) in blocks.iter_mut().enumerate() {
            let [u, v] = u.map(|column| wide(&column[number * WIDTH..]));
            block.draw(u, v);
        }
    }
}

/// Turns directions to the world, and values into weights.
pub(super) struct Weigh<'a>(pub &'a mut [Block]);

impl Work for Weigh<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for block in self.0 {
            block.weigh();
        }
    }
}

impl Block {
    #[inline(always)]
    fn draw(&mut self, u: Wide, v: Wide) {
        for lane in 0..WIDTH {
            let viewer = get(&self.viewer, lane);
            // What is left of the number where it does not choose light that was passed on.
            let left = (u[lane] - self.later[lane]) / (1.0 - self.later[lane]);
            let left = left.clamp(0.0, BELOW_ONE);
            let direction = self.metal.at(lane).sample(viewer, [left, v[lane]]);
            put(&mut self.direction, lane, direction);
        }
    }

    #[inline(always)]
    fn evaluate(&mut self) {
        for lane in 0..WIDTH {
            let ways = (get(&self.viewer, lane), get(&self.direction, lane));
            let (value, pdf) = self.metal.at(lane).evaluate(ways.0, ways.1);
            put(&mut self.value, lane, value);
            self.pdf[lane] = pdf;
        }
    }

    #[inline(always)]
    fn weigh(&mut self) {
        for lane in 0..WIDTH {
            let local = get(&self.direction, lane);
            let along = |axis: usize| {
                let part = |k: usize| local[k] * self.axes[k][axis][lane];
                part(0) + part(1) + part(2)
            };
            let world = [along(0), along(1), along(2)];
            put(&mut self.direction, lane, world);
            let per_density = 1.0 / self.pdf[lane];
            let value = get(&self.value, lane).map(|part| part * per_density);
            put(&mut self.value, lane, value);
        }
    }
}

/// A world direction along the axes.
#[inline(always)]
pub(super) fn local(axes: &[[f32; 3]; 3], direction: [f32; 3]) -> [f32; 3] {
    axes.map(|axis| axis[0] * direction[0] + axis[1] * direction[1] + axis[2] * direction[2])
}
