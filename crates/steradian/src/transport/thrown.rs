//! What polished surfaces throw from lights without extent, at meters: a path [from a light](super::light_tracing) for each sample of a flux, and
//! for one of four samples, which stands for all four, at points.
//!
//! | meter | what a path of flux Φ brings |
//! |---|---|
//! | irradiance, at each D | E = Φ ρ(d_e, d_i) \|cosθ_e\| T cosθ/r² |
//! | scalar irradiance | the same without cosθ |
//! | cylindrical irradiance | the same on a plane whose normal is drawn about the axis |
//! | flux | what [arrives and leaves](landing) |
//! | radiance | nothing: what is seen is the image of a single point |
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | E | irradiance | W/m² |
//! | T | transmittance from D to the meter | 1 |
//! | r, θ | distance of D, and its angle from the meter's normal | m, rad |
//!
//! E grows with the inverse square of the distance where surfaces that are lit come close to the point, as in a corner. Light at a point that a plane throws
//! there is [aimed at](super::light_tracing) in part, so that its weights are bounded for each place and plane; what curved surfaces, several in turn, or light from a
//! direction throw is not, and its variance grows with the inverse square of the point's distance from what they light. As in pictures, finer normals at grazing light have no bound. The numbers of a sample's path from the light are its own, so that its
//! replicate is one of both.

mod landing;

use glam::Vec3;
use steradian_kernel::InstructionSet;

use self::landing::Landing;
use super::columns::{BATCH, Place};
use super::interaction::Hit;
use super::light_tracing::{
    Arrival, Catch, Connection, Connections, Departure, Flock, LightTracer, Particle,
};
use super::measure::Stream;
use super::meters::Meter;
use super::tables::{Lanes4, Tables};
use crate::estimation::Run;
use crate::sampling::hash;
use crate::sensor::FluxOf;
use crate::spectrum::Wavelengths;

/// Tells the numbers of paths from lights from those of paths from the meter.
const KEY: u64 = 0x7468_726f_776e;

/// Scratch of a thread.
#[derive(Default)]
pub(super) struct Catching {
    flock: Flock,
    /// With the groups of their lights.
    connections: Connections<u32>,
    /// By slot.
    streams: Vec<u32>,
}

impl Catching {
    /// Rays so far.
    pub fn rays(&self) -> u64 {
        self.flock.traced
    }
}

/// Where the light of the paths of some runs is gathered.
pub(super) struct Gathering<'t> {
    pub wavelengths: &'t [Wavelengths],
    /// What is gathered in a slot is multiplied with, but for the meter's scale.
    pub sign: &'t [f64],
    pub gathered: &'t mut [f32],
}

/// Sends paths from lights for the samples of these runs, whose slots follow each other.
pub(super) fn gather(
    light: &LightTracer<'_>,
    streams: &[Stream<'_>],
    runs: &[Run],
    catching: &mut Catching,
    gathering: Gathering<'_>,
) {
    let Catching { flock, .. } = catching;
    catching.streams.clear();
    for run in runs {
        let key = hash::combine(run.key, KEY);
        let meter = &streams[run.stream as usize].meter;
        let is_caught = meter.catches() && light.max_depth >= 2 + meter.segments();
        let period = meter.period();
        let point = meter.place(0.5).map(|place| Vec3::from_array(place.point));
        for number in 0..run.count {
            let slot = catching.streams.len();
            catching.streams.push(run.stream);
            let group = (run.first + number) / period;
            let turn = hash::mix_64(key ^ u64::from(group)) as u32 % period;
            if is_caught && (run.first + number) % period == turn {
                let identity = (slot as u32, key, group);
                light.launch(identity, point, &gathering.wavelengths[slot], flock);
            }
        }
    }
    let wavelengths = gathering.wavelengths;
    let mut catch = AtMeters {
        tables: light.tables,
        set: light.set,
        max_depth: light.max_depth,
        meters: (streams, &catching.streams),
        connections: &mut catching.connections,
        gathering,
    };
    light.follow(flock, wavelengths, &mut catch);
}

impl Meter<'_> {
    /// Whether paths from lights find it.
    fn catches(&self) -> bool {
        match self {
            Self::Irradiance { .. } | Self::Scalar { .. } | Self::Cylinder(_) => true,
            Self::Flux(flux) => flux.of != FluxOf::Emitted,
            Self::Surface(_) | Self::Ray { .. } => false,
        }
    }

    /// So many samples share a path from a light, one of them by chance: what points have of it is mostly little beside their other light, and
    /// a path costs more than theirs.
    fn period(&self) -> u32 {
        match self {
            Self::Flux(_) => 1,
            _ => 4,
        }
    }

    /// From the last surface that light meets.
    fn segments(&self) -> u32 {
        u32::from(!matches!(self, Self::Flux(_)))
    }

    /// A place that light is thrown on; `None` of a flux, on which it lands, and of rays.
    fn place(&self, number: f32) -> Option<Place> {
        match self {
            Self::Irradiance { place, .. } | Self::Scalar { place, .. } => Some(*place),
            Self::Cylinder(cylinder) => Some(cylinder.place(number)),
            Self::Flux(_) | Self::Surface(_) | Self::Ray { .. } => None,
        }
    }

    fn landing(&self) -> Option<Landing<'_>> {
        match self {
            Self::Flux(flux) => Some(Landing(flux)),
            _ => None,
        }
    }
}

/// Meters by slot.
struct AtMeters<'t, 'a> {
    tables: &'t Tables<'a>,
    set: InstructionSet,
    max_depth: u32,
    meters: (&'t [Stream<'a>], &'t [u32]),
    connections: &'t mut Connections<u32>,
    gathering: Gathering<'t>,
}

impl<'t, 'a> AtMeters<'t, 'a> {
    fn meter(&self, slot: u32) -> &'t Meter<'a> {
        let (streams, of_slot) = self.meters;
        &streams[of_slot[slot as usize] as usize].meter
    }

    /// Adds to the reading of a path's slot.
    fn add(&mut self, particle: &Particle, lanes: Lanes4) {
        let slot = particle.identity.0;
        let share = self.share(slot);
        let column = (particle.group, slot);
        add(
            self.tables,
            &mut self.gathering,
            column,
            lanes.map(|lane| lane * share),
        );
    }

    /// What is gathered, of what the reading of a slot gains.
    fn share(&self, slot: u32) -> f32 {
        let meter = self.meter(slot);
        let scale = meter.scale() * self.gathering.sign[slot as usize];
        (f64::from(meter.period()) / scale) as f32
    }
}

fn add(
    tables: &Tables<'_>,
    gathering: &mut Gathering<'_>,
    (group, slot): (u32, u32),
    value: Lanes4,
) {
    for (lane, value) in value.iter().enumerate().take(tables.lanes) {
        let column = group as usize * tables.lanes + lane;
        gathering.gathered[column * BATCH + slot as usize] += value;
    }
}

impl Catch for AtMeters<'_, '_> {
    fn segments(&self, slot: u32) -> u32 {
        self.meter(slot).segments()
    }

    fn fly(&mut self, particle: &Particle, reach: Option<f32>, waves: &Wavelengths) {
        let Some(landing) = self.meter(particle.identity.0).landing() else {
            return;
        };
        if particle.events > 0 && particle.events < self.max_depth {
            let lanes = landing.passing(self.tables, particle, reach, waves);
            self.add(particle, lanes);
        }
    }

    fn arrive(&mut self, particle: &Particle, hit: &Hit, waves: &Wavelengths) {
        let Some(landing) = self.meter(particle.identity.0).landing() else {
            return;
        };
        if particle.events > 0 && particle.events < self.max_depth {
            let lanes = landing.arriving(self.tables, particle, (hit, waves));
            self.add(particle, lanes);
        }
    }

    fn scatter(&mut self, particle: &Particle, arrival: &Arrival<'_>, numbers: [f32; 2]) {
        let meter = self.meter(particle.identity.0);
        let Some(place) = meter.place(numbers[0]) else {
            return;
        };
        let point = Vec3::from_array(place.point);
        let way = point - Vec3::from_array(arrival.hit.place.point);
        let direction = way.normalize_or_zero();
        let cosine = match meter {
            Meter::Scalar { .. } => 1.0,
            _ => -direction.dot(Vec3::from_array(place.normal)),
        };
        if cosine <= 0.0 {
            return;
        }
        let Some(seen) = arrival.towards(direction) else {
            return;
        };
        let factor = cosine / way.length_squared() * self.share(particle.identity.0);
        let (start, end) = (arrival.hit.place.start(direction), place.start(-direction));
        let flux = particle.carried();
        self.connections.push(Connection {
            ray: (start.into(), (end - start).into()),
            place: particle.group,
            value: std::array::from_fn(|lane| flux[lane] * seen[lane] * factor),
            slot: particle.identity.0,
        });
    }

    fn leave(&mut self, particle: &Particle, hit: &Hit, departure: &Departure) {
        if let Some(landing) = self.meter(particle.identity.0).landing() {
            let lanes = landing.leaving(self.tables, particle, (hit, departure));
            self.add(particle, lanes);
        }
    }

    fn settle(&mut self, wavelengths: &[Wavelengths]) {
        let (tables, gathering) = (self.tables, &mut self.gathering);
        let take = |connection: &Connection<u32>, lanes: Lanes4| {
            add(
                tables,
                gathering,
                (connection.place, connection.slot),
                lanes,
            );
        };
        self.connections.settle(tables, wavelengths, self.set, take);
    }
}
