//! Light samples of sixteen places at once.
//!
//! Where few lights are chosen among, all of them are weighed for all places of a block side by side, which costs less than to go down the tree
//! at each; where a chosen light is a sphere seen from outside, its cone is drawn from side by side, too. Every place gets the very sample that it
//! would get alone.

use glam::Vec3;
use steradian_kernel::Work;

use super::choice::{Sampled, choose_by};
use super::columns::Place;
use super::light_tree::{Ball, FEW, Highlight, Receiving};
use super::path::Tracer;
use super::tables::{Candidates, EmitterShape, Tables};
use super::towards::{Towards, cone, in_cone};
use super::wide::{WIDTH, Wide, get, put};
use crate::brdf::Gloss;

/// Where light is gathered.
#[derive(Clone, Debug, Default)]
pub(super) struct Places {
    pub point: [Wide; 3],
    pub normal: [Wide; 3],
    /// Of places with a highlight.
    pub shine: Shine,
}

/// How places mirror.
#[derive(Clone, Debug, Default)]
pub(super) struct Shine {
    pub viewer: [Wide; 3],
    pub normal: [Wide; 3],
    pub alpha: Wide,
    pub share: Wide,
}

impl Places {
    /// What the choice of a light knows of a place; whether it has a highlight is the same for all of them.
    #[inline(always)]
    pub fn at<const SHINES: bool>(&self, lane: usize) -> Receiving {
        let Shine {
            viewer,
            normal,
            alpha,
            share,
        } = &self.shine;
        Receiving {
            point: get(&self.point, lane).into(),
            normal: Some(get(&self.normal, lane).into()),
            highlight: SHINES.then(|| Highlight {
                viewer: get(viewer, lane).into(),
                normal: get(normal, lane).into(),
                gloss: Gloss {
                    alpha: alpha[lane],
                    share: share[lane],
                },
            }),
        }
    }
}

/// A light sample at a place.
pub(super) struct Drawn {
    pub sampled: Sampled,
    /// Numbers that the emitter was sampled with.
    pub u: [f32; 2],
    pub towards: Towards,
}

/// Draws light samples.
pub(super) struct LightSamples<'a> {
    pub tracer: &'a Tracer<'a>,
    pub candidates: Candidates,
}

impl LightSamples<'_> {
    /// Whether there are so few emitters that all of them are weighed at every place.
    pub fn weigh_all(&self) -> bool {
        !self.balls().is_empty()
    }

    fn balls(&self) -> &[[Ball<f32>; 4]] {
        let selection = self.tracer.tables.selection(self.candidates);
        selection.map_or(&[], |selection| selection.few_balls())
    }

    /// One at each of the first places of a block, by their numbers.
    pub fn draw<const SHINES: bool>(
        &self,
        places: &Places,
        numbers: &[[f32; 2]],
        place: impl Fn(usize) -> Place,
    ) -> [Option<Drawn>; WIDTH] {
        let tables = self.tracer.tables;
        let chosen = self.choose::<SHINES>(places, numbers);
        let mut cones = Cones::default();
        for (lane, chosen) in chosen.iter().enumerate() {
            if let Some((sampled, u)) = chosen {
                cones.set(tables, lane, sampled, *u);
            }
        }
        if cones.radius != [0.0; WIDTH] {
            self.tracer.set.run(FillCones(&mut cones, &places.point));
        }
        std::array::from_fn(|lane| {
            let (sampled, u) = chosen[lane]?;
            let alone = || sampled.towards(tables, &place(lane), u);
            let towards = cones.get(lane).or_else(alone)?;
            Some(Drawn {
                sampled,
                u,
                towards,
            })
        })
    }

    /// An emitter for each place, and the numbers that are left to use.
    fn choose<const SHINES: bool>(
        &self,
        places: &Places,
        numbers: &[[f32; 2]],
    ) -> [Option<(Sampled, [f32; 2])>; WIDTH] {
        let (tables, candidates) = (self.tracer.tables, self.candidates);
        let balls = self.balls();
        let mut weights = [[[0.0; WIDTH]; 4]; FEW];
        self.tracer
            .set
            .run(Weigh::<SHINES>(balls, places, &mut weights));
        std::array::from_fn(|lane| {
            let [u, v] = *numbers.get(lane)?;
            let (sampled, u) = choose_by(
                tables,
                candidates,
                ([u, v], (0, 1)),
                |tree, u| match balls {
                    [] => tree.draw(&places.at::<SHINES>(lane), u),
                    _ => tree.draw_by(|node| get(&weights[node], lane), u),
                },
            )?;
            Some((sampled, [u, v]))
        })
    }
}

/// Weighs every ball of a small tree at every place of a block.
struct Weigh<'a, const SHINES: bool>(&'a [[Ball<f32>; 4]], &'a Places, &'a mut [[Wide; 4]; FEW]);

impl<const SHINES: bool> Work for Weigh<'_, SHINES> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self(nodes, places, weights) = self;
        for (balls, weights) in nodes.iter().zip(weights) {
            for (ball, weights) in balls.iter().zip(weights) {
                if ball.is_dark() {
                    continue;
                }
                for lane in 0..WIDTH {
                    weights[lane] = ball.importance(&places.at::<SHINES>(lane));
                }
            }
        }
    }
}

/// Spheres seen from outside.
#[derive(Default)]
struct Cones {
    center: [Wide; 3],
    /// 0 where there is none.
    radius: Wide,
    u: [Wide; 2],
    direction: [Wide; 3],
    end: [Wide; 3],
    /// 0 where there is none.
    density: Wide,
}

impl Cones {
    /// A place samples this emitter, if that is a sphere.
    fn set(&mut self, tables: &Tables, lane: usize, sampled: &Sampled, u: [f32; 2]) {
        let emitter = &tables.emitters[sampled.number];
        let EmitterShape::Sphere {
            center,
            radius,
            inside,
            ports,
        } = &emitter.shape
        else {
            return;
        };
        let shines_outside = !*inside || emitter.two_sided;
        if shines_outside && ports.is_empty() && !emitter.is_directed {
            put(&mut self.center, lane, *center);
            put(&mut self.u, lane, u);
            self.radius[lane] = *radius;
        }
    }

    fn get(&self, lane: usize) -> Option<Towards> {
        (self.density[lane] > 0.0).then(|| Towards {
            direction: get(&self.direction, lane).into(),
            end: get(&self.end, lane).into(),
            infinite: false,
            per_power: 1.0 / self.density[lane],
            density: self.density[lane],
        })
    }
}

/// Draws directions in the cones from these points.
struct FillCones<'a>(&'a mut Cones, &'a [Wide; 3]);

impl Work for FillCones<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self(cones, points) = self;
        for lane in 0..WIDTH {
            let vertex = Vec3::from_array(get(points, lane));
            let (center, radius) = (get(&cones.center, lane).into(), cones.radius[lane]);
            let axis = center - vertex;
            let width = cone(axis, radius, true).unwrap_or(0.0);
            let towards = in_cone(axis, center, radius, width, vertex, get(&cones.u, lane));
            put(&mut cones.direction, lane, towards.direction.into());
            put(&mut cones.end, lane, towards.end.into());
            cones.density[lane] = if width > 0.0 { towards.density } else { 0.0 };
        }
    }
}
