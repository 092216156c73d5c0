//! What stands between a point and its lamps.
//!
//! From the rectangles around all lamps of a plane down to each lamp: what reaches into the shaft of a rectangle is all that may hide a lamp
//! within. If nothing does, all of them are in full view; if one surface [hides](super::hiding) the rectangle, all are hidden; else the same is asked of
//! its halves. What reaches into a half's shaft is looked for among what reached into the whole's, unless that was too much to tell.

use std::ops::Range;

use steradian_kernel::{Obstacle, Regions};

use super::super::shaft::{Shaft, View};
use super::super::tables::{Outline, Tables};
use super::groups::{Groups, Node};
use super::hiding::Pyramid;
use crate::geometry::{Point, Vector};

/// Obstacles in a shaft that are kept; of more none is.
const MOST_OBSTACLES: usize = 32;

/// How a piece of a lamp is seen from a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Seen {
    /// Nothing is between.
    Whole,
    /// It shines elsewhere, is below the horizon, or something is between and hides all of it.
    Not,
    /// That is not known.
    Perhaps,
}

pub(super) struct Search<'s, 't> {
    tables: &'s Tables<'t>,
    groups: &'s Groups,
    view: &'s View,
    regions: Regions<'s>,
    shaft: Shaft,
    /// In the shafts of a node and of those above it.
    obstacles: Vec<Obstacle>,
    /// By piece.
    pub seen: Vec<Seen>,
}

impl<'s, 't> Search<'s, 't> {
    /// Looks at all lamps.
    pub fn new(tables: &'s Tables<'t>, groups: &'s Groups, view: &'s View) -> Self {
        let mut search = Self {
            tables,
            groups,
            view,
            regions: tables.scene.surfaces().accelerator().regions(),
            shaft: Shaft::default(),
            obstacles: vec![],
            seen: vec![Seen::Perhaps; groups.pieces.len()],
        };
        groups
            .planes
            .iter()
            .for_each(|plane| search.look(&groups.nodes[*plane], None));
        groups
            .spheres
            .iter()
            .for_each(|piece| search.look_at_sphere(*piece));
        search
    }

    /// Looks at a node; these obstacles are all that reach into the shaft of the one above it, if that is known.
    fn look(&mut self, node: &Node, above: Option<Range<usize>>) {
        if !self.view.may_see(&node.outline, node.two_sided) {
            self.mark(node, Seen::Not);
            return;
        }
        let off = match node.below {
            Some(_) => self.view.least_clearance(&node.outline),
            None => self.view.clearance(self.tables, &node.outline.corners),
        };
        let shaft = &mut self.shaft;
        shaft.enclose_facet(self.tables, self.view, &node.outline, off);
        let first = self.obstacles.len();
        let own = node.outline.primitives.clone();
        let are_all = self.collect(above, &|primitive| own.contains(&primitive));
        let obstacles = &self.obstacles[first..];
        if are_all && obstacles.is_empty() {
            self.mark(node, Seen::Whole);
        } else if Pyramid::new(self.tables, self.view, &node.outline.corners)
            .is_hidden_by(self.tables, obstacles)
        {
            self.mark(node, Seen::Not);
        } else if let Some(below) = node.below {
            let known = are_all.then_some(first..self.obstacles.len());
            let nodes = &self.groups.nodes;
            self.look(&nodes[below], known.clone());
            self.look(&nodes[below + 1], known);
        }
        self.obstacles.truncate(first);
    }

    /// Adds what reaches into the shaft; false if that is not all.
    fn collect(&mut self, above: Option<Range<usize>>, ignore: &dyn Fn(u32) -> bool) -> bool {
        let planes = self.shaft.half_spaces();
        let Some(above) = above else {
            let obstacles = &mut self.obstacles;
            return self
                .regions
                .collect(planes, ignore, MOST_OBSTACLES, obstacles);
        };
        for number in above {
            let obstacle = self.obstacles[number];
            if !ignore(obstacle.primitive) && self.regions.reaches(planes, &obstacle) {
                self.obstacles.push(obstacle);
            }
        }
        true
    }

    fn mark(&mut self, node: &Node, seen: Seen) {
        for piece in &self.groups.order[node.pieces.clone()] {
            self.seen[*piece] = seen;
        }
    }

    fn look_at_sphere(&mut self, piece: usize) {
        let number = self.groups.pieces[piece].emitter as usize;
        let emitter = &self.tables.emitters[number];
        let (Some(Outline::Sphere { center, radius }), Some(shape)) =
            (&emitter.outline, emitter.surface)
        else {
            return;
        };
        let (center, radius) = (*center, *radius);
        if !self.view.may_see_sphere(center, radius) {
            self.seen[piece] = Seen::Not;
            return;
        }
        let shaft = &mut self.shaft;
        if !shaft.enclose_sphere(self.tables, self.view, (center, radius)) {
            return;
        }
        let own = self.tables.scene.surfaces().first_primitive(shape);
        let first = self.obstacles.len();
        let are_all = self.collect(None, &|primitive| primitive == own);
        let obstacles = &self.obstacles[first..];
        if are_all && obstacles.is_empty() {
            self.seen[piece] = Seen::Whole;
        } else if Pyramid::new(self.tables, self.view, &cube(center, radius))
            .is_hidden_by(self.tables, obstacles)
        {
            self.seen[piece] = Seen::Not;
        }
        self.obstacles.truncate(first);
    }
}

/// The corners of the cube around a sphere.
fn cube(center: Point, radius: f64) -> [Point; 8] {
    let side = |k: usize, axis: usize| radius * (1.0 - 2.0 * (k >> axis & 1) as f64);
    std::array::from_fn(|k| center + Vector::new(side(k, 0), side(k, 1), side(k, 2)))
}
