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
//! Meters aim at portals as they do at lamps (see [`aim`](super::aim)): their own directions through portals count nothing, those of the picture
//! neither, and a direction through m portals counts 1/m from each.
//!
//! In the room of `benchmarks/scenes/sky_room.toml`, whose window is 3 m × 1.4 m, a picture reaches an error in a tenth of the time.
//!
//! Source: E. Veach, *Robust Monte Carlo methods for light transport simulation* (1997), §9.2.2; portals as such are common practice.

use glam::Vec3;

use super::columns::Place;
use super::light_tree::Receiving;
use super::tables::{Candidates, EmitterShape, Everywhere, Facet, Outline, Tables};
use super::towards::{Towards, by_area};
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

    /// A direction through a point of it, from where the ray starts: from anywhere else a strip along its edges would be seen by rays that
    /// find no light, and another by none.
    pub fn towards(&self, place: &Place, u: [f32; 2]) -> Option<Towards> {
        let [a, b] = self.edges;
        let point = self.origin + a * u[0] + b * u[1];
        let start = place.start(point - Vec3::from_array(place.point));
        let towards = by_area(start, point, self.normal, self.area, false)?;
        Some(Towards {
            end: towards.direction,
            infinite: true,
            ..towards
        })
    }
}

/// Those of a scene that are sampled, with their outlines, for meters to aim at.
pub(super) fn portals(scene: &Scene) -> Vec<(Portal, Outline)> {
    let mut portals: Vec<_> = scene.portals().iter().collect();
    portals.sort_by(|a, b| b.area.total_cmp(&a.area));
    let with_outline = |form: &Parallelogram| {
        let facet = Facet {
            corners: form.corners().to_vec(),
            normal: form.normal,
            primitives: 0..0,
        };
        (Portal::new(scene, form), Outline::Facets(vec![facet]))
    };
    portals.into_iter().take(MOST).map(with_outline).collect()
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

    /// How many portals, this emitter not counted, a direction leads through.
    pub fn other_portals(&self, number: usize, from: Vec3, direction: Vec3) -> usize {
        let Some(everywhere) = self.everywhere_of(number) else {
            return 0;
        };
        let through = everywhere.portals_on(self, (from, direction));
        through.filter(|other| *other as usize != number).count()
    }

    /// What an emitter of light from everywhere belongs to.
    fn everywhere_of(&self, number: usize) -> Option<&Everywhere> {
        let holds = |all: &&Everywhere| all.emitters.contains(&(number as u32));
        self.environment.iter().find(holds)
    }

    /// A sample of an emitter that gets so many in the mean, with P for its density if others find its direction too.
    pub fn shared(
        &self,
        (number, rate): (usize, f32),
        (from, towards): (Vec3, Towards),
        candidates: Candidates,
        at: impl Fn() -> Receiving,
    ) -> Towards {
        let everywhere = self.everywhere_of(number);
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

impl Everywhere {
    /// Emitters whose portals a direction leads through.
    pub fn portals_on(
        &self,
        tables: &Tables<'_>,
        (from, direction): (Vec3, Vec3),
    ) -> impl Iterator<Item = u32> {
        let leads = move |number: &u32| match &tables.emitters[*number as usize].shape {
            EmitterShape::Portal(portal) => portal.density(from, direction) > 0.0,
            _ => false,
        };
        self.emitters.clone().filter(leads)
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
        let place = |point: Vec3| Place {
            point: point.to_array(),
            normal: [0.0, 0.0, 1.0],
            clearance: 0.0,
        };
        for [u, v] in independent(1, 1000) {
            let inside = [0.001 + 0.998 * u as f32, 0.001 + 0.998 * v as f32];
            let Some(drawn) = SKEW.towards(&place(vertex), inside) else {
                panic!("the portal faces the vertex")
            };
            let density = SKEW.density(vertex, drawn.direction);
            assert!((density / drawn.density - 1.0).abs() < 1e-5, "{density}");
            assert!((drawn.per_power * drawn.density - 1.0).abs() < 1e-6);
        }
        for outside in [[-0.01, 0.5], [1.01, 0.5], [0.5, -0.01], [0.5, 1.01]] {
            let Some(past) = SKEW.towards(&place(vertex), outside) else {
                panic!("its plane faces the vertex")
            };
            assert_eq!(SKEW.density(vertex, past.direction), 0.0);
        }
        let behind = Vec3::new(1.0, 5.0, 0.0);
        assert!(SKEW.towards(&place(behind), [0.5, 0.5]).is_none());
        assert_eq!(SKEW.density(behind, Vec3::NEG_Y), 0.0);
    }
}
