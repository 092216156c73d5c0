//! Single rays through the tree by turns.
//!
//! A ray on its own mostly waits: for a node to come from memory, and for the processor to turn back where it guessed wrongly how many
//! boxes are met or what comes next. So a few dozen rays are under way at once, and each takes a step when its turn comes: first
//! all that stand before a node, then all that stand before a leaf. What a ray needs next is asked for as soon as that is known, and
//! a step has hardly a branch that depends on what is met. The closest hit is the smallest `(t, primitive)` in any order of visits.
//!
//! Source: I. Wald, S. Woop, C. Benthin, G. S. Johnson, M. Ernst, "Embree: A Kernel Framework for Efficient CPU Ray Tracing", ACM
//! Transactions on Graphics 33(4), 2014, for streams of rays and trees of eight children.

mod block;
mod stack;

use crate::batch::{Hit, MISS, RayBatch};
use crate::node::{Below, Child, WIDTH};
use crate::prepared_ray::{PreparedRay, SlabNumbers};
use crate::simd::{Floats, Simd};
use crate::traversal::{Closest, Target, closest_in_leaf, occluded_in_leaf};
use crate::triangle::Shear;
use block::Block;
use stack::SORTED;
use std::hint::select_unpredictable;

/// Rays under way at once.
const SLOTS: usize = 32;

/// A tree of no more bytes stays near the processor; to ask for its nodes beforehand costs more than it saves.
const SMALL: usize = 1 << 20;

/// What is asked of every ray.
pub(crate) trait Question {
    /// Whether any hit will do.
    const ANY: bool;

    /// Takes the answer. If any hit will do, only the primitive tells something.
    fn settle(&mut self, row: usize, hit: Hit);
}

/// A ray under way.
#[derive(Copy, Clone)]
struct Traveller {
    slabs: SlabNumbers<f32>,
    closest: Closest,
    current: Child,
    row: usize,
    /// The end of its stack.
    top: usize,
    prepared: PreparedRay,
}

impl Traveller {
    const IDLE: Self = Self {
        slabs: SlabNumbers {
            near_origin: [0.0; 3],
            far_origin: [0.0; 3],
            reciprocal: [0.0; 3],
        },
        closest: Closest(Hit::NONE),
        current: Child::node(0),
        row: 0,
        top: 0,
        prepared: PreparedRay {
            axes: [0; 3],
            shear: Shear {
                origin: [0.0; 3],
                slope: [0.0; 3],
            },
            t_max: 0.0,
        },
    };
}

/// Slots that wait for their turn.
#[derive(Default)]
struct Queue {
    slots: [u8; SLOTS],
    len: usize,
}

impl Queue {
    /// Without a branch.
    #[inline(always)]
    fn add_if(&mut self, slot: usize, condition: bool) {
        self.slots[self.len % SLOTS] = slot as u8;
        self.len += usize::from(condition);
    }

    /// Empties the queue; its slots stay readable up to the length that this gives.
    #[inline(always)]
    fn take(&mut self) -> usize {
        std::mem::take(&mut self.len)
    }

    #[inline(always)]
    fn slot(&self, place: usize) -> usize {
        usize::from(self.slots[place % SLOTS])
    }
}

/// The rays that have not set out.
struct Waiting<'a> {
    rays: &'a RayBatch,
    /// Where blocks begin.
    starts: std::slice::Iter<'a, u32>,
    block: Block,
    /// The rows left of the block.
    rows: std::ops::Range<usize>,
}

/// Everything about rays under way.
pub(crate) struct Turns<'a, S, Q> {
    set: S,
    target: Target<'a>,
    is_large: bool,
    waiting: Waiting<'a>,
    question: Q,
    travellers: [Traveller; SLOTS],
    /// All stacks, as long as each other.
    stacks: Vec<u64>,
    room: usize,
    nodes: Queue,
    leaves: Queue,
}

impl<'a, S: Simd, Q: Question> Turns<'a, S, Q> {
    /// Answers the question for the rays of blocks that begin at these rows.
    #[inline(always)]
    pub(crate) fn trace(
        set: S,
        target: Target<'a>,
        rays: &'a RayBatch,
        starts: &'a [u32],
        question: Q,
    ) {
        let room = SORTED + (WIDTH - 1) * target.tree.depth + 2 * WIDTH;
        let slots = SLOTS.min(starts.len() * S::Wide::LANES);
        let mut turns = Self {
            set,
            target,
            is_large: target.tree.memory_bytes() > SMALL,
            waiting: Waiting {
                rays,
                starts: starts.iter(),
                block: Block::EMPTY,
                rows: 0..0,
            },
            question,
            travellers: [Traveller::IDLE; SLOTS],
            stacks: vec![u64::MAX; slots * room],
            room,
            nodes: Queue::default(),
            leaves: Queue::default(),
        };
        turns.set_out(slots);
        turns.run();
    }

    /// Fills as many slots.
    #[inline(always)]
    fn set_out(&mut self, slots: usize) {
        for slot in 0..slots {
            self.send_next(slot);
        }
    }

    #[inline(always)]
    fn run(&mut self) {
        while self.nodes.len + self.leaves.len > 0 {
            for place in 0..self.nodes.take() {
                let slot = self.nodes.slot(place);
                let next = self.step_down(slot);
                self.go_on(slot, next);
            }
            for place in 0..self.leaves.take() {
                let slot = self.leaves.slot(place);
                self.visit_leaf(slot);
                let next = self.stacks[self.travellers[slot % SLOTS].top - 1];
                self.go_on(slot, next);
            }
        }
    }

    /// Takes the next child, the topmost key, off the stack; where it is empty, another ray takes the place.
    #[inline(always)]
    fn go_on(&mut self, slot: usize, topmost: u64) {
        let traveller = &mut self.travellers[slot % SLOTS];
        let bottom = slot * self.room + SORTED;
        if traveller.top == bottom {
            let (row, hit) = (traveller.row, traveller.closest.into_hit());
            self.question.settle(row, hit);
            self.send_next(slot);
            return;
        }
        traveller.top -= 1;
        let child = Child(topmost as u32);
        traveller.current = child;
        if self.is_large {
            prefetch(self.set, self.target, child);
        }
        self.nodes.add_if(slot, child.is_node());
        self.leaves.add_if(slot, !child.is_node());
    }

    /// Fills a slot by the next ray that has something to do in the tree.
    #[inline(always)]
    fn send_next(&mut self, slot: usize) {
        loop {
            let Some(row) = self.waiting.rows.next() else {
                let Some(&start) = self.waiting.starts.next() else {
                    return;
                };
                self.load_block(start as usize);
                continue;
            };
            let lane = row % S::Wide::LANES;
            let Some((prepared, slabs)) = self.waiting.block.ray(lane) else {
                self.question.settle(row, Hit::NONE);
                continue;
            };
            let closest = self.before_tree(row, prepared.t_max);
            if self.target.tree.nodes.is_empty() || (Q::ANY && closest.0.primitive != MISS) {
                self.question.settle(row, closest.into_hit());
                continue;
            }
            self.travellers[slot % SLOTS] = Traveller {
                slabs,
                closest,
                current: Child::node(0),
                row,
                top: slot * self.room + SORTED,
                prepared,
            };
            self.nodes.add_if(slot, true);
            return;
        }
    }

    /// Blocks begin at multiples of their length.
    #[inline(always)]
    fn load_block(&mut self, start: usize) {
        let Waiting {
            rays, block, rows, ..
        } = &mut self.waiting;
        block.load::<S::Wide>(self.set, rays, start, self.target.bounds);
        *rows = start..rays.len().min(start + S::Wide::LANES);
    }

    /// The hit among what is not in the tree.
    #[inline(always)]
    fn before_tree(&self, row: usize, t_max: f32) -> Closest {
        let rays = self.waiting.rays;
        let last = if Q::ANY {
            rays.t_max[row].next_down()
        } else {
            t_max
        };
        let mut closest = Closest::up_to(last);
        for &index in self.target.unbounded {
            self.target
                .offer_quadric(index as usize, &rays.ray(row), &mut closest);
        }
        closest
    }

    /// Gives back the key that is then the topmost.
    #[inline(always)]
    fn step_down(&mut self, slot: usize) -> u64 {
        let traveller = &mut self.travellers[slot % SLOTS];
        let node = &self.target.tree.nodes[traveller.current.index()];
        let slabs = traveller.slabs.splat::<S::Eight>(self.set);
        let last = S::Eight::splat(self.set, traveller.closest.0.t);
        let (entry, met) = slabs.test(self.set, node, last);
        let Some(top) = self.stacks[traveller.top - SORTED..].first_chunk_mut() else {
            return u64::MAX;
        };
        let (count, topmost) = stack::push::<S>(self.set, met, entry, &node.children, Q::ANY, top);
        traveller.top += count;
        topmost
    }

    #[inline(always)]
    fn visit_leaf(&mut self, slot: usize) {
        let traveller = &mut self.travellers[slot % SLOTS];
        let is_better = match traveller.current.below() {
            Below::Leaf(index) => {
                let leaf = &self.target.tree.leaves[index];
                let Traveller {
                    prepared, closest, ..
                } = traveller;
                let shear = prepared.shear.splat::<S::Eight>(self.set);
                if Q::ANY {
                    occluded_in_leaf(self.set, leaf, prepared, &shear, closest)
                } else {
                    closest_in_leaf(self.set, leaf, prepared, &shear, closest)
                }
            }
            Below::Quadric(index) => {
                let ray = self.waiting.rays.ray(traveller.row);
                self.target
                    .offer_quadric(index, &ray, &mut traveller.closest)
            }
            Below::Node(_) => false,
        };
        if is_better {
            self.drop_behind(slot);
        }
    }

    /// Drops what begins behind the hit, or everything if any hit will do.
    #[inline(always)]
    fn drop_behind(&mut self, slot: usize) {
        let Traveller { closest, top, .. } = &mut self.travellers[slot % SLOTS];
        let bottom = slot * self.room + SORTED;
        if Q::ANY {
            *top = bottom;
            return;
        }
        *top = bottom + stack::keep(&mut self.stacks[bottom..*top], closest.0.t);
    }
}

/// Asks for a node or a leaf, without a branch.
#[inline(always)]
fn prefetch<S: Simd>(set: S, target: Target<'_>, child: Child) {
    let is_leaf = !child.is_node();
    let node = target.tree.nodes.as_ptr().wrapping_add(child.index());
    let leaf = target.tree.leaves.as_ptr().wrapping_add(child.index());
    let start = select_unpredictable(is_leaf, leaf.cast::<[u8; 64]>(), node.cast());
    for line in [0, 1, 2, 3, 3 + usize::from(is_leaf)] {
        set.prefetch(start.wrapping_add(line));
    }
}
