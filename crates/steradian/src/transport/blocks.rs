//! Measuring block by block, so that memory does not grow with the number of points.
//!
//! Points are cut into blocks of at most [`POINTS_OF_A_BLOCK`]. A block is prepared, estimated, handed on and forgotten. A sensor that
//! fits stays whole; a larger one is cut into equal parts, each a block of its own. [`measure`] is the same with all blocks kept.
//!
//! With a number of samples the cut changes no bit of a reading, since random numbers belong to a point by its sensor and number; only the
//! [upper bound](crate::estimation::Replicates::combine) of a dark one is made from the brightest sample of its block, until the blocks are
//! put together. With a tolerance ε each block of a cut sensor is a sensor by itself: its floor, ε · 1 % of the mean, and the pooled
//! variance of its pilot are those of the block. A time is shared out in proportion to points, and what one block leaves the others have.

mod watch;

use std::ops::Range;

use super::branching::Branches;
use super::channels;
use super::light_tracing::LightTracer;
use super::measure::pilot::POINTS as PILOT_POINTS;
use super::measure::{Meters, Part, Shared, Stream, streams};
use super::meters::{Context, Prepared};
use super::run::{Branching, MeasureOptions, SimulationError, chosen_sensors};
use super::tables::Tables;
use super::unsampled::unsampled;
use crate::estimation::{Observer, Replicates, estimate};
use crate::measurement::{
    Dimming, LaneRecord, Measurements, PointRecord, SensorRecord, Unmeasured,
};
use crate::scene::Scene;
use crate::sensor::{Kind, Readout};
use crate::spectrum::WavelengthDensity;
use watch::Watch;

/// Points that are in work at a time unless asked otherwise: some 2 kB each, and three times that while a tolerance is looked for.
pub const POINTS_OF_A_BLOCK: usize = 1 << 14;

/// Reads the sensors of a scene (all but cameras).
///
/// # Errors
/// If there is nothing to read, or a sample is not finite.
pub fn measure(
    scene: &Scene,
    options: &MeasureOptions,
    observer: &mut dyn Observer,
) -> Result<Measurements, SimulationError> {
    let mut whole: Option<Measurements> = None;
    let ended = measure_in_blocks(scene, options, observer, &mut |block| {
        match &mut whole {
            Some(whole) => whole.append(block),
            None => whole = Some(block),
        }
        Ok::<_, SimulationError>(())
    })?;
    if let Some(fault) = ended.fault {
        return Err(fault);
    }
    let mut whole = whole.ok_or(SimulationError::NothingToDo("meter"))?;
    whole.share_largest();
    whole.leave_out(&ended.missing);
    Ok(whole)
}

/// How far a run in blocks came.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ended {
    /// Points of which there is no block.
    pub missing: Vec<Unmeasured>,
    /// Why they are missing, unless the observer ended the run.
    pub fault: Option<SimulationError>,
}

/// Reads the sensors of a scene (all but cameras) and hands on the points of one block after the other, in order.
///
/// A block is what [`measure`] would give if the scene had no other points, but for their numbers and for how many branches their paths have, which
/// is found from points of the whole sensor. If the observer ends the run, the block
/// in work is handed on as it is, and what is missing is told; so it is where a block fails after others were handed on.
///
/// # Errors
/// As [`measure`] if no block was handed on, and those of `sink`.
pub fn measure_in_blocks<E: From<SimulationError>>(
    scene: &Scene,
    options: &MeasureOptions,
    observer: &mut dyn Observer,
    sink: &mut dyn FnMut(Measurements) -> Result<(), E>,
) -> Result<Ended, E> {
    let chosen = chosen_sensors(scene, options.sensors.as_deref())?;
    options.plan.check().map_err(SimulationError::from)?;
    let sizes: Vec<_> = chosen.iter().map(|&sensor| size(scene, sensor)).collect();
    let tables = Tables::new(scene);
    let blocks = cut(&sizes, options.points_of_a_block.max(1));
    let mut watch = Watch::new(observer, &blocks);
    let run = Run::new(scene, options, &tables, chosen);
    for (number, block) in blocks.iter().enumerate() {
        let ended = |fault| Ended {
            missing: run.unmeasured(&sizes, &blocks[number..]),
            fault,
        };
        if watch.is_stopped() {
            return Ok(ended(None));
        }
        match run.measure(block, &mut watch) {
            Ok(measured) => sink(measured)?,
            Err(fault) if number > 0 => return Ok(ended(Some(fault))),
            Err(fault) => return Err(fault.into()),
        }
        watch.end();
    }
    Ok(Ended::default())
}

/// Points of a sensor, and whether it can be cut between them.
#[derive(Clone, Copy)]
struct Size {
    points: usize,
    can_be_cut: bool,
}

fn size(scene: &Scene, sensor: usize) -> Size {
    let (points, can_be_cut) = match &scene.sensors()[sensor].kind {
        Kind::Irradiance(places) => (places.len(), true),
        Kind::ScalarIrradiance(points) => (points.len(), true),
        Kind::Cylindrical(cylinders) => (cylinders.len(), true),
        Kind::Radiance(rays) => (rays.len(), true),
        Kind::Balance(accounts) => (accounts.len(), false),
        Kind::Flux { .. } | Kind::Camera(_) => (1, false),
    };
    Size { points, can_be_cut }
}

/// Some points of a sensor.
#[derive(Clone, Debug, PartialEq)]
struct Piece {
    /// Which of the chosen sensors.
    position: usize,
    points: Range<usize>,
}

impl Piece {
    fn whole(position: usize, size: Size) -> Self {
        let points = 0..size.points;
        Self { position, points }
    }
}

/// Some points of a sensor, spread evenly; all of one that cannot be cut.
fn spread(whole: &Piece, size: Size) -> Vec<Piece> {
    if !size.can_be_cut || size.points <= PILOT_POINTS {
        return vec![whole.clone()];
    }
    let point = |number: usize| {
        let first = (2 * number + 1) * size.points / (2 * PILOT_POINTS);
        Piece {
            points: first..first + 1,
            ..*whole
        }
    };
    (0..PILOT_POINTS).map(point).collect()
}

fn points_of(block: &[Piece]) -> usize {
    block.iter().map(|piece| piece.points.len()).sum()
}

/// Blocks of at most so many points, but for sensors that cannot be cut.
fn cut(sizes: &[Size], most: usize) -> Vec<Vec<Piece>> {
    let mut blocks: Vec<Vec<Piece>> = Vec::new();
    let mut room = 0;
    for (position, size) in sizes.iter().enumerate() {
        let parts = if size.can_be_cut {
            size.points.div_ceil(most).max(1)
        } else {
            1
        };
        for part in 0..parts {
            let points = size.points * part / parts..size.points * (part + 1) / parts;
            let piece = Piece { position, points };
            match blocks.last_mut() {
                Some(block) if size.points <= room => {
                    room -= size.points;
                    block.push(piece);
                }
                _ => {
                    room = most.saturating_sub(piece.points.len());
                    blocks.push(vec![piece]);
                }
            }
        }
    }
    blocks
}

/// What all blocks of a run have in common.
struct Run<'r, 'a> {
    scene: &'a Scene,
    options: &'r MeasureOptions,
    tables: &'a Tables<'a>,
    context: Context<'a, 'a>,
    /// Numbers of the sensors to read.
    chosen: Vec<usize>,
    /// By chosen sensor.
    weights: Vec<Vec<f64>>,
    /// By chosen sensor; none unless the run is spectral.
    densities: Vec<WavelengthDensity>,
    /// By chosen sensor.
    branches: Vec<Branches>,
    /// Finds what paths from sensors cannot, if there is any.
    light: Option<LightTracer<'a>>,
    unsampled: Vec<String>,
}

impl<'r, 'a> Run<'r, 'a> {
    fn new(
        scene: &'a Scene,
        options: &'r MeasureOptions,
        tables: &'a Tables<'a>,
        chosen: Vec<usize>,
    ) -> Self {
        let sensors = || chosen.iter().map(|sensor| &scene.sensors()[*sensor]);
        let max_depth = options.max_depth.unwrap_or(u32::MAX);
        let mut run = Self {
            context: Context::new(tables, max_depth),
            weights: sensors()
                .map(|sensor| scalar_weights(scene, &sensor.readouts))
                .collect(),
            densities: sensors()
                .filter_map(|sensor| channels::density(scene, sensor))
                .collect(),
            branches: vec![],
            light: LightTracer::new(tables, options.instruction_set, max_depth),
            unsampled: unsampled(scene, sensors()),
            scene,
            options,
            tables,
            chosen,
        };
        run.branches = (0..run.chosen.len()).map(|i| run.branches(i)).collect();
        run
    }

    /// How many paths a sensor's paths branch into: those of a spectral run would share their wavelengths.
    fn branches(&self, position: usize) -> Branches {
        if !self.densities.is_empty() || self.options.branching == Branching::Never {
            return Branches::ONE;
        }
        let size = size(self.scene, self.chosen[position]);
        let mut parts: Vec<_> = spread(&Piece::whole(position, size), size)
            .iter()
            .map(|piece| self.part(piece))
            .collect();
        let streams = streams(&mut parts, &self.weights);
        if streams.is_empty() {
            return Branches::ONE;
        }
        let step = streams.len().div_ceil(PILOT_POINTS);
        let streams = streams.into_iter().step_by(step).collect();
        self.meters(streams)
            .suited_branches(self.options.plan.threads)
    }

    fn part(&self, piece: &Piece) -> Part<'a> {
        let sensor = &self.scene.sensors()[self.chosen[piece.position]];
        Part {
            position: piece.position,
            sensor,
            readings: self.context.prepare(sensor, piece.points.clone()),
        }
    }

    fn meters<'s>(&'s self, streams: Vec<Stream<'s>>) -> Meters<'s> {
        let shared = Shared {
            weights: &self.weights,
            densities: &self.densities,
            branches: &self.branches,
            light: self.light.as_ref(),
        };
        Meters::new(self.tables, self.options, streams, shared)
    }

    fn measure(&self, block: &[Piece], watch: &mut Watch) -> Result<Measurements, SimulationError> {
        let mut parts: Vec<_> = block.iter().map(|piece| self.part(piece)).collect();
        let streams = streams(&mut parts, &self.weights);
        let plan = watch.begin(points_of(block), &self.options.plan);
        let replicates = if streams.is_empty() {
            vec![]
        } else {
            estimate(&self.meters(streams), &plan, watch)?
        };
        Ok(self.record(parts, replicates))
    }

    fn record(&self, parts: Vec<Part>, replicates: Vec<Replicates>) -> Measurements {
        let (scene, options) = (self.scene, self.options);
        // Streams are numbered in the order of the readings.
        let mut replicates = replicates.into_iter();
        let mut sensor = |part: Part| SensorRecord {
            name: part.sensor.name.clone(),
            quantities: part.sensor.readouts.clone(),
            layout: part.sensor.layout,
            points: part
                .readings
                .into_iter()
                .map(|reading| point(reading, &mut replicates))
                .collect(),
        };
        let lanes = scene.lanes().names().iter().cloned();
        Measurements {
            scene_name: scene.name().into(),
            seed: options.plan.seed,
            confidence: options.plan.confidence,
            luminous_efficacy: scene.reported_efficacy(),
            max_depth: options.max_depth,
            lanes: lanes.map(|name| LaneRecord { name }).collect(),
            groups: scene.groups().to_vec(),
            dimming: Dimming::new(scene.schedules().to_vec()),
            sensors: parts.into_iter().map(&mut sensor).collect(),
            unsampled: self.unsampled.clone(),
            warnings: scene.warnings().to_vec(),
            shard: options.plan.shard,
        }
    }

    /// What is in these blocks, by sensor.
    fn unmeasured(&self, sizes: &[Size], blocks: &[Vec<Piece>]) -> Vec<Unmeasured> {
        let missing = |(position, &sensor): (usize, &usize)| {
            let own = blocks.iter().flatten();
            let own = own.filter(|piece| piece.position == position);
            Unmeasured {
                sensor: self.scene.sensors()[sensor].name.clone(),
                points: own.map(|piece| piece.points.len()).sum(),
                of: sizes[position].points,
            }
        };
        let missing = self.chosen.iter().enumerate().map(missing);
        missing.filter(|missing| missing.points > 0).collect()
    }
}

/// Weights of the columns in the scalar that tolerances are about: the first readout, all groups.
fn scalar_weights(scene: &Scene, readouts: &[Readout]) -> Vec<f64> {
    let lanes = readouts.first().map_or_else(
        || scene.lanes().radiant_weights(),
        |readout| readout.weights.clone(),
    );
    (0..scene.columns())
        .map(|column| lanes[column % lanes.len()])
        .collect()
}

fn point(reading: Prepared, replicates: &mut impl Iterator<Item = Replicates>) -> PointRecord {
    PointRecord {
        index: reading.index,
        position: reading.position.map(|point| point.to_array()),
        normal: reading.normal.map(|normal| normal.to_array()),
        sits_on: reading.sits_on,
        about: reading.about,
        exact: reading.exact,
        closed: reading.closed,
        replicates: if reading.is_sampled {
            replicates.next()
        } else {
            None
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pieces(sizes: &[(usize, bool)], most: usize) -> Vec<Vec<(usize, Range<usize>)>> {
        let size = |&(points, can_be_cut): &(usize, bool)| Size { points, can_be_cut };
        let sizes: Vec<_> = sizes.iter().map(size).collect();
        let block = |block: Vec<Piece>| {
            let pieces = block.into_iter();
            pieces.map(|piece| (piece.position, piece.points)).collect()
        };
        cut(&sizes, most).into_iter().map(block).collect()
    }

    #[test]
    fn small_sensors_stay_whole_and_share_a_block() {
        let sizes = [(3, true), (4, true), (1, false), (8, true), (2, true)];
        let expected = [
            vec![(0, 0..3), (1, 0..4), (2, 0..1)],
            vec![(3, 0..8)],
            vec![(4, 0..2)],
        ];
        assert_eq!(pieces(&sizes, 8), expected);
    }

    #[test]
    fn a_large_sensor_is_cut_into_equal_parts() {
        let expected = [
            vec![(0, 0..6)],
            vec![(0, 6..12)],
            vec![(0, 12..18), (1, 0..2)],
        ];
        assert_eq!(pieces(&[(18, true), (2, true)], 8), expected);
        assert_eq!(pieces(&[(18, false)], 8), [[(0, 0..18)]]);
    }
}
