//! Rough metals side by side: what a batch meets of them, sixteen paths to a block.
//!
//! Metals whose parameters are the same everywhere are shaded in single precision, one pass after another over all of them: light samples are
//! drawn, what they are worth is found in blocks, directions are drawn and weighed in blocks. Every path keeps to its own lane, so
//! that what becomes of it does not depend on its neighbours, and blocks are compiled for each instruction set, with the same bits.

use glam::Vec3;

use super::super::choice::Sampled;
use super::super::columns::{Flight, Identity, Place, Workspace};
use super::super::light_samples::{Drawn, LightSamples, Places};
use super::super::path::Tracer;
use super::super::scatter::{fill, survives, tangents};
use super::super::shading_normal::direction;
use super::super::tables::{Lanes4, Tables};
use super::super::wide::{WIDTH, get, put};
use super::Encounter;
use super::rows::{Block, Draw, Evaluate, Weigh, local};
use crate::brdf::{Later, Metal};

/// The rough metals that a batch of paths has met.
#[derive(Default)]
pub(in crate::transport) struct Metals {
    blocks: Vec<Block>,
    /// Numbers of the encounters.
    rows: Vec<u32>,
    identity: Identity,
    samples: Vec<Option<Drawn>>,
    /// Whether facets pass light on in any row.
    have_later: bool,
    /// Encounters with everything else.
    others: Vec<u32>,
}

impl Metals {
    /// Takes the encounters with rough metals out of all of them.
    fn gather(&mut self, tables: &Tables, encounters: &[Encounter]) {
        self.rows.clear();
        self.others.clear();
        self.identity.clear();
        self.have_later = false;
        for (number, encounter) in encounters.iter().enumerate() {
            if self.add(tables, encounter).is_some() {
                self.rows.push(number as u32);
            } else {
                self.others.push(number as u32);
            }
        }
    }

    fn add(&mut self, tables: &Tables, encounter: &Encounter) -> Option<()> {
        let side = &tables.sides[encounter.side as usize];
        let (metal, later) = tables.metals[side.material.0 as usize].as_ref()?;
        if encounter.through == Some(true) {
            return None;
        }
        let axes = axes(tables, metal, encounter)?;
        let (block, lane) = (self.rows.len() / WIDTH, self.rows.len() % WIDTH);
        if block == self.blocks.len() {
            self.blocks.push(Block::default());
        }
        let block = &mut self.blocks[block];
        for (columns, axis) in block.axes.iter_mut().zip(axes) {
            put(columns, lane, axis);
        }
        let viewer = local(&axes, encounter.viewer);
        let later = later.as_ref().map(|later| later.share(viewer[2]));
        self.have_later |= later.is_some();
        block.later[lane] = later.unwrap_or(0.0);
        put(&mut block.viewer, lane, viewer);
        block.metal.set(lane, metal);
        block.places.set(lane, encounter, axes[2], metal);
        block.places.shine.share[lane] = 1.0 - block.later[lane];
        let (slot, key, index) = encounter.identity;
        self.identity.push(slot, key, index);
        Some(())
    }

    /// Takes the rows of metals whose facets pass light on, with their blocks and lanes.
    fn each_later(
        &mut self,
        (tables, encounters): (&Tables, &[Encounter]),
        mut take: impl FnMut(usize, &Later, &mut Block, usize),
    ) {
        if !self.have_later {
            return;
        }
        for (row, &number) in self.rows.iter().enumerate() {
            let side = &tables.sides[encounters[number as usize].side as usize];
            if let Some((_, Some(later))) = &tables.metals[side.material.0 as usize] {
                take(row, later, &mut self.blocks[row / WIDTH], row % WIDTH);
            }
        }
    }

    /// ρ cosθ_i and the density of each row's direction.
    fn evaluate(&mut self, tracer: &Tracer, encounters: &[Encounter]) {
        tracer.set.run(Evaluate(self.used()));
        self.each_later((tracer.tables, encounters), |_, later, block, lane| {
            let first = (get(&block.value, lane), block.pdf[lane]);
            if first.1 > 0.0 {
                let both = later.added_to(first, block.later[lane], block.direction[2][lane]);
                put(&mut block.value, lane, both.0);
                block.pdf[lane] = both.1;
            }
        });
    }

    /// Draws a direction of each row's metal.
    fn draw(&mut self, tracer: &Tracer, encounters: &[Encounter], u: [&[f32]; 2]) {
        tracer.set.run(Draw(self.used(), u));
        self.each_later((tracer.tables, encounters), |row, later, block, lane| {
            let (share, [u, v]) = (block.later[lane], u.map(|column| column[row]));
            if u < share {
                let direction = later.sample([u / share, v]);
                put(&mut block.direction, lane, direction);
            }
        });
    }

    /// Draws a light sample of each path.
    fn draw_lights(
        &mut self,
        tracer: &Tracer,
        encounters: &[Encounter],
        workspace: &mut Workspace,
    ) {
        self.samples.clear();
        let candidates = tracer.tables.for_surfaces();
        let samples = LightSamples { tracer, candidates };
        for (block, rows) in self.blocks.iter_mut().zip(self.rows.chunks(WIDTH)) {
            let of_row = |lane: usize| &encounters[rows[lane] as usize];
            for lane in 0..rows.len() {
                let slot = of_row(lane).identity.0 as usize;
                workspace.receiving[slot] = block.places.at::<true>(lane);
            }
            if candidates.count == 0 {
                self.samples.extend(rows.iter().map(|_| None));
                continue;
            }
            let numbers: [_; WIDTH] =
                std::array::from_fn(|lane| of_row(lane.min(rows.len() - 1)).light);
            let place = |lane| of_row(lane).place;
            let drawn = samples.draw::<true>(&block.places, &numbers[..rows.len()], place);
            for (lane, drawn) in drawn.into_iter().enumerate().take(rows.len()) {
                let drawn =
                    drawn.and_then(|drawn| block.above(lane, drawn, (tracer.tables, &place(lane))));
                self.samples.push(drawn);
            }
        }
    }

    /// Adds those that are seen to the shadow rays.
    fn cast(&self, tracer: &Tracer, encounters: &[Encounter], workspace: &mut Workspace) {
        for (row, sample) in self.samples.iter().enumerate() {
            let Some(drawn) = sample else { continue };
            let (block, lane) = (&self.blocks[row / WIDTH], row % WIDTH);
            let encounter = &encounters[self.rows[row] as usize];
            let (value, pdf) = (get(&block.value, lane), block.pdf[lane]);
            cast(drawn, (tracer, encounter), (value, pdf), workspace);
        }
    }

    /// Sends the paths on, or ends them by roulette.
    fn leave(
        &self,
        tracer: &Tracer,
        encounters: &[Encounter],
        segment: u32,
        workspace: &mut Workspace,
    ) {
        for (row, &number) in self.rows.iter().enumerate() {
            let encounter = &encounters[number as usize];
            let (block, lane) = (&self.blocks[row / WIDTH], row % WIDTH);
            let direction = Vec3::from_array(get(&block.direction, lane));
            // Neither below the surface nor below its shading normal's.
            if block.pdf[lane] <= 0.0 || direction.dot(encounter.place.normal.into()) < 0.0 {
                continue;
            }
            let scale = workspace.luggage[encounter.identity.0 as usize].scale;
            let mut throughput: Lanes4 =
                std::array::from_fn(|k| encounter.throughput[k] * block.value[k][lane]);
            throughput[tracer.tables.lanes..].fill(0.0);
            let greatest = throughput.into_iter().fold(0.0, f32::max);
            let Some(survival) = survives(greatest / scale, encounter.identity, segment) else {
                continue;
            };
            let [_, _, u, v] = workspace.uniforms.each_ref().map(|column| column[row]);
            workspace.flights.push(Flight {
                origin: encounter.place.cleared(),
                direction: direction.into(),
                throughput: throughput.map(|part| part / survival),
                pdf: block.pdf[lane],
                identity: encounter.identity,
                light: [u, v],
            });
        }
    }

    fn used(&mut self) -> &mut [Block] {
        &mut self.blocks[..self.rows.len().div_ceil(WIDTH)]
    }
}

/// Samples a light at every encounter with a rough metal and sends the paths on; hands the numbers of the other encounters on.
pub(super) fn scatter(
    tracer: &Tracer,
    encounters: &[Encounter],
    workspace: &mut Workspace,
    segment: u32,
    others: impl FnMut(&Encounter, &mut Workspace),
) {
    let mut metals = std::mem::take(&mut workspace.metals);
    metals.gather(tracer.tables, encounters);
    if !metals.rows.is_empty() {
        metals.draw_lights(tracer, encounters, workspace);
        metals.evaluate(tracer, encounters);
        metals.cast(tracer, encounters, workspace);
        fill(tracer, &metals.identity, segment, &mut workspace.uniforms);
        let [u, v, ..] = &workspace.uniforms;
        metals.draw(tracer, encounters, [u, v]);
        metals.evaluate(tracer, encounters);
        tracer.set.run(Weigh(metals.used()));
        metals.leave(tracer, encounters, segment, workspace);
    }
    let mut others = others;
    for &number in &metals.others {
        others(&encounters[number as usize], workspace);
    }
    workspace.metals = metals;
}

/// The axes of a metal where it is met.
fn axes(tables: &Tables, metal: &Metal, encounter: &Encounter) -> Option<[[f32; 3]; 3]> {
    let single = |axis: [f64; 3]| axis.map(|part| part as f32);
    let normal = match encounter.site.normal == [0.0; 3] {
        true => encounter.place.normal,
        false => single(tables.shading_normal(encounter)?.to_array()),
    };
    if metal.alpha[0] == metal.alpha[1] {
        let [first, second] = tangents(normal);
        return Some([first, second, normal]);
    }
    let frame = tables.frame(encounter.primitive, direction(normal)?);
    let axes = [frame.tangent(), frame.bitangent(), frame.normal()];
    Some(axes.map(|axis| single(axis.to_array())))
}

impl Places {
    fn set(&mut self, lane: usize, encounter: &Encounter, normal: [f32; 3], metal: &Metal) {
        put(&mut self.point, lane, encounter.place.point);
        put(&mut self.normal, lane, encounter.place.normal);
        let [along, across] = metal.alpha;
        put(&mut self.shine.viewer, lane, encounter.viewer);
        put(&mut self.shine.normal, lane, normal);
        self.shine.alpha[lane] = along.max(across);
    }
}

/// Adds the shadow ray of a light sample, and what it is worth, if it is seen.
fn cast(
    drawn: &Drawn,
    (tracer, encounter): (&Tracer, &Encounter),
    (value, own_density): (Lanes4, f32),
    workspace: &mut Workspace,
) {
    if value == [0.0; 4] {
        return;
    }
    let Drawn {
        towards,
        u,
        sampled,
    } = drawn;
    let Sampled { number, rate, .. } = *sampled;
    let ratio = own_density / (towards.density * rate);
    let gain = towards.per_power / (rate * (1.0 + ratio * ratio));
    let start = encounter.place.cleared();
    let (span, reach) = match towards.infinite {
        true => (towards.direction, f32::INFINITY),
        false => (towards.end - Vec3::from_array(start), 1.0),
    };
    let slot = encounter.identity.0 as usize;
    let medium = workspace.luggage[slot].medium;
    let way = span.length() * reach;
    let attenuation = tracer
        .tables
        .attenuation(medium, way, &workspace.wavelengths[slot]);
    let response = |lane: usize| encounter.throughput[lane] * value[lane] * attenuation[lane];
    let response = std::array::from_fn(response);
    workspace
        .lit
        .push(encounter.place, response, encounter.identity, *u);
    let ray = (start, span.into(), reach);
    workspace.shadows.push(ray, gain, number as u32, *u);
}

impl Block {
    /// A light sample, of all emitters together, and its direction along the axes; none if it comes from below.
    fn above(
        &mut self,
        lane: usize,
        drawn: Drawn,
        (tables, place): (&Tables, &Place),
    ) -> Option<Drawn> {
        let Drawn {
            sampled, towards, ..
        } = drawn;
        let direction = towards.direction;
        if direction.dot(place.normal.into()) < 0.0 {
            return None;
        }
        let axes = self.axes.each_ref().map(|axis| get(axis, lane));
        put(&mut self.direction, lane, local(&axes, direction.into()));
        let (number, at) = ((sampled.number, sampled.rate), || {
            self.places.at::<true>(lane)
        });
        let way = (place.cleared().into(), towards);
        let towards = tables.shared(number, way, tables.for_surfaces(), at);
        Some(Drawn { towards, ..drawn })
    }
}
