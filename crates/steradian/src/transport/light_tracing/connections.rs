//! Rays from what light meets to a sensor, and what they bring.

use steradian_kernel::{InstructionSet, RayBatch};

use crate::spectrum::Wavelengths;
use crate::transport::tables::{Lanes4, Tables};
use crate::transport::transmittance::Transmittance;

/// What would be seen if nothing stood between.
pub(in crate::transport) struct Connection<P> {
    /// Start and span to the sensor.
    pub ray: ([f32; 3], [f32; 3]),
    /// What it is for.
    pub place: P,
    /// By lane.
    pub value: Lanes4,
    /// Of the path.
    pub slot: u32,
}

/// Those of a batch.
pub(in crate::transport) struct Connections<P> {
    rays: RayBatch,
    waiting: Vec<Connection<P>>,
    transmittance: Transmittance,
}

impl<P> Default for Connections<P> {
    fn default() -> Self {
        Self {
            rays: RayBatch::default(),
            waiting: vec![],
            transmittance: Transmittance::default(),
        }
    }
}

impl<P> Connections<P> {
    pub fn push(&mut self, connection: Connection<P>) {
        let (start, span) = connection.ray;
        self.rays.push(start, span, 1.0);
        self.waiting.push(connection);
    }

    /// Hands on each connection that something gets along, with what does.
    pub fn settle(
        &mut self,
        tables: &Tables<'_>,
        wavelengths: &[Wavelengths],
        set: InstructionSet,
        mut hand_on: impl FnMut(&Connection<P>, Lanes4),
    ) {
        let of_ray = |i: usize| &wavelengths[self.waiting[i].slot as usize];
        self.transmittance.trace(tables, &self.rays, of_ray, set);
        for (i, connection) in self.waiting.iter().enumerate() {
            if !self.transmittance.stops(i) {
                let part = self.transmittance.of(i);
                let lanes = std::array::from_fn(|lane| connection.value[lane] * part[lane]);
                hand_on(connection, lanes);
            }
        }
        self.rays.clear();
        self.waiting.clear();
    }
}
