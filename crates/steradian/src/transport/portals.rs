//! Portals: openings in the walls of a room, through which samples look for light from everywhere.
//!
//! Light of an environment finds its way into a room only where directions that surfaces draw happen to meet a window. A portal is sampled
//! like a lamp of its shape: by area, with the density p = r²/(A cosθ_p) in solid angle, but the shadow ray goes on to infinity. So nothing is
//! assumed of what is before the window, and light that comes another way is still found by the directions of surfaces: a portal that shows
//! nothing costs time, not truth.
//!
//! Several samplers may find the same direction: portals behind each other, and the picture of the sky. All of them together count as one with
//! the density
//!
//! P(ω) = Σ n_k p_k(ω),
//!
//! n_k samples of each in the mean (the balance heuristic), which then competes with the surface's own by the power heuristic.
//!
//! In the room of `benchmarks/scenes/sky_room.toml`, whose window is 3 m × 1.4 m, a picture reaches an error in a tenth of the time.
//!
//! Source: E. Veach, *Robust Monte Carlo methods for light transport simulation* (1997), §9.2.2; portals as such are common practice.

use glam::Vec3;

use super::light_tree::Receiving;
use super::tables::{Candidates, EmitterShape, Everywhere, Tables};
use super::towards::Towards;
use crate::geometry::{Direction, Vector};
use crate::scene::Scene;
use crate::shape::Parallelogram;

/// How many are sampled, the largest ones: every direction that meets nothing is compared with all of them.
const MOST: usize = 64;

/// An opening whose front is inside, in kernel coordinates.
#[derive(Copy, Clone, Debug)]
pub(super) struct Portal {
    pub origin: Vec3,
    pub edges: [Vec3; 2],
    pub normal: Vec3,
    pub area: f32,
}

impl Portal {
    fn new(scene: &Scene, form: &Parallelogram) -> Self {
        let single = |v: [f64; 3]| Vec3::from_array(v.map(|x| x as f32));
        Self {
            origin: scene.surfaces().to_kernel(form.origin).into(),
            edges: form.edges.map(|edge| single(edge.to_array())),
            normal: single(form.normal.to_array()),
            area: form.area as f32,
        }
    }

    /// p of a direction from a point inside; 0 where it does not lead through the portal.
    pub fn density(&self, from: Vec3, direction: Vec3) -> f32 {
        let cos = -direction.dot(self.normal);
        let distance = (from - self.origin).dot(self.normal) / cos;
        if !(cos > 0.0 && distance > 0.0 && self.holds(from + direction * distance)) {
            return 0.0;
        }
        distance * distance / (self.area * cos)
    }

    fn holds(&self, point: Vec3) -> bool {
        let [a, b] = self.edges;
        let span = point - self.origin;
        let scale = 1.0 / (self.area * self.area);
        let normal = self.normal * self.area;
        let [s, t] = [span.cross(b).dot(normal), a.cross(span).dot(normal)].map(|x| x * scale);
        (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t)
    }

    /// A direction through a point of it.
    pub fn towards(&self, vertex: Vec3, u: [f32; 2]) -> Option<Towards> {
        let [a, b] = self.edges;
        let span = self.origin + a * u[0] + b * u[1] - vertex;
        let squared = span.length_squared();
        let direction = span / squared.sqrt();
        let density = squared / (self.area * -direction.dot(self.normal));
        (density > 0.0 && density.is_finite()).then_some(Towards {
            direction,
            end: direction,
            infinite: true,
            per_power: 1.0 / density,
            density,
        })
    }
}

/// Those of a scene that are sampled.
pub(super) fn portals(scene: &Scene) -> Vec<Portal> {
    let mut portals: Vec<_> = scene.portals().iter().collect();
    portals.sort_by(|a, b| b.area.total_cmp(&a.area));
    let largest = portals.into_iter().take(MOST);
    largest.map(|form| Portal::new(scene, form)).collect()
}

impl Tables<'_> {
    /// P of a direction in which nothing is met.
    pub fn density_of_everywhere(
        &self,
        everywhere: &Everywhere,
        way: (Vec3, Vec3),
        candidates: Candidates,
        at: impl Fn() -> Receiving,
    ) -> f32 {
        let emitters = everywhere.emitters.clone();
        let densities = emitters.map(|number| self.density_of_one(number, way, candidates, &at));
        densities.sum()
    }

    /// n_k p_k.
    fn density_of_one(
        &self,
        number: u32,
        (from, direction): (Vec3, Vec3),
        candidates: Candidates,
        at: impl Fn() -> Receiving,
    ) -> f32 {
        let number = number as usize;
        match self.emitters[number].shape.density_beyond(from, direction) {
            0.0 => 0.0,
            density => density * self.rate(candidates, (number, 0), at),
        }
    }

    /// A sample of an emitter that gets so many in the mean, with P for its density if others find its direction too.
    pub fn shared(
        &self,
        (number, rate): (usize, f32),
        (from, towards): (Vec3, Towards),
        candidates: Candidates,
        at: impl Fn() -> Receiving,
    ) -> Towards {
        let with_others = |all: &&Everywhere| all.emitters.contains(&(number as u32));
        let everywhere = self.environment.iter().find(with_others);
        let Some(everywhere) = everywhere.filter(|all| all.emitters.len() > 1) else {
            return towards;
        };
        let way = (from, towards.direction);
        let others = everywhere
            .emitters
            .clone()
            .filter(|other| *other as usize != number);
        let others = others.map(|other| self.density_of_one(other, way, candidates, &at));
        let density = towards.density + others.sum::<f32>() / rate;
        Towards {
            per_power: towards.per_power * (towards.density / density),
            density,
            ..towards
        }
    }
}

impl EmitterShape {
    /// Density in solid angle with which samples of light from infinitely far away take a direction.
    fn density_beyond(&self, from: Vec3, direction: Vec3) -> f32 {
        match self {
            Self::Everywhere(map) => {
                let direction = Vector::from(direction.to_array().map(f64::from));
                let direction = Direction::new(direction);
                direction.map_or(0.0, |direction| map.pdf(direction)) as f32
            }
            Self::Portal(portal) => portal.density(from, direction),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::testing::independent;

    const SKEW: Portal = Portal {
        origin: Vec3::new(1.0, 2.0, -0.5),
        edges: [Vec3::new(0.5, 0.0, 0.0), Vec3::new(0.2, 0.0, 2.0)],
        normal: Vec3::new(0.0, -1.0, 0.0),
        area: 1.0,
    };

    /// The density of a direction is that with which it is drawn, to the rounding of r²/cosθ from points up to 8 m away; from behind and past
    /// the edges it is 0.
    #[test]
    fn directions_have_the_density_with_which_they_are_drawn() {
        let vertex = Vec3::new(-3.0, -4.0, 0.2);
        for [u, v] in independent(1, 1000) {
            let inside = [0.001 + 0.998 * u as f32, 0.001 + 0.998 * v as f32];
            let Some(drawn) = SKEW.towards(vertex, inside) else {
                panic!("the portal faces the vertex")
            };
            let density = SKEW.density(vertex, drawn.direction);
            assert!((density / drawn.density - 1.0).abs() < 1e-5, "{density}");
            assert!((drawn.per_power * drawn.density - 1.0).abs() < 1e-6);
        }
        for outside in [[-0.01, 0.5], [1.01, 0.5], [0.5, -0.01], [0.5, 1.01]] {
            let Some(past) = SKEW.towards(vertex, outside) else {
                panic!("its plane faces the vertex")
            };
            assert_eq!(SKEW.density(vertex, past.direction), 0.0);
        }
        let behind = Vec3::new(1.0, 5.0, 0.0);
        assert!(SKEW.towards(behind, [0.5, 0.5]).is_none());
        assert_eq!(SKEW.density(behind, Vec3::NEG_Y), 0.0);
    }
}
