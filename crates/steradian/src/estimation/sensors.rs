//! What the streams of a sensor share: the floor of the tolerance.

use super::Integrand;
use super::cells::Cells;
use super::plan::FLOOR;

/// Which streams share a tolerance floor.
pub(super) struct Sensors {
    /// The sensor of each stream.
    pub(super) of_stream: Vec<usize>,
    /// Number of streams, by sensor.
    pub(super) streams: Vec<u64>,
}

impl Sensors {
    pub(super) fn new<I: Integrand>(integrand: &I) -> Self {
        let of_stream: Vec<_> = (0..integrand.streams())
            .map(|stream| integrand.sensor_of(stream))
            .collect();
        let mut streams = vec![0; of_stream.iter().max().map_or(0, |last| last + 1)];
        of_stream.iter().for_each(|&sensor| streams[sensor] += 1);
        Self { of_stream, streams }
    }

    /// Sums over the streams of each sensor.
    pub(super) fn sum(&self, term: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut sums = vec![0.0; self.streams.len()];
        for (stream, &sensor) in self.of_stream.iter().enumerate() {
            sums[sensor] += term(stream);
        }
        sums
    }
}

/// The largest half-width of a stream relative to its value or to the floor, if every stream has one.
pub(super) fn relative_error<I: Integrand>(
    integrand: &I,
    sensors: &Sensors,
    cells: &Cells,
    factor: f64,
) -> Option<f64> {
    let summaries: Vec<_> = (0..cells.streams())
        .map(|stream| cells.summary(stream))
        .collect();
    let value = |stream: usize| summaries[stream].mean + integrand.offset(stream);
    let sums = sensors.sum(value);
    let relative = |stream: usize| {
        let sensor = sensors.of_stream[stream];
        let scale = value(stream)
            .abs()
            .max(FLOOR * (sums[sensor] / sensors.streams[sensor] as f64).abs());
        factor * summaries[stream].variance.sqrt() / scale
    };
    let worst = (0..cells.streams())
        .map(relative)
        .fold(
            0.0_f64,
            |worst, error| if worst >= error { worst } else { error },
        );
    worst.is_finite().then_some(worst)
}
