//! Samples shared out among the streams of a sensor, so that their errors are small in the root mean square.
//!
//! With r/√n the half-width of a stream after n samples, relative to its value, the fewest samples for
//!
//! (1/N) Σ r_i²/n_i = e²
//!
//! are n_i = r_i r̄/e², where r̄ is the mean of the N streams of the sensor: Σ n_i = N r̄²/e², where as many for each would be N mean(r²)/e². What
//! is gained is the square of the ratio of root mean square and mean of r: nothing where all points are alike, much where a few dark corners
//! would take most of the samples.
//!
//! | symbol | meaning |
//! |---|---|
//! | r_i | from the pilot; at least a quarter of the sensor's root mean square, which protects a stream that has been lucky so far |
//! | e² | that wanted over 1.1 + .86/√N: for a single stream 1.4² as for a tolerance of its own, for many what the noise of the r_i costs (3 %) and twice that of the sum |
//!
//! Values below the floor of the tolerance count as the floor. All streams of a sensor that misses run once more, afresh, with 2n.

use super::{Cells, Integrand, SMALLEST_FINAL, Session};
use crate::estimation::plan::FLOOR;

/// Fewer than for tolerances of single streams, whose lengths depend on each pilot alone.
pub(super) const PILOT_OF_STREAM: u64 = 1 << 10;

const LEAST_SHARE: f64 = 0.25;
const SAFETY: [f64; 2] = [1.1, 0.86];

impl<I: Integrand> Session<'_, I> {
    /// Samples of a replicate of each stream.
    pub(super) fn shared_out(&self, pilot: &Cells, means: &[f64], wanted: f64) -> Vec<u64> {
        let samples = |stream: usize| pilot.samples(stream).iter().sum::<u64>() as f64;
        let widths = self.half_widths(pilot, means);
        let per_sample = |stream: usize| widths[stream] * samples(stream).sqrt();
        let rms = self.root_mean_squares(per_sample);
        let of_sensor = |stream: usize| self.sensors.of_stream[stream];
        let share = |stream: usize| per_sample(stream).max(LEAST_SHARE * rms[of_sensor(stream)]);
        let sums = self.sensors.sum(share);
        let length = |stream: usize| {
            let count = self.sensors.streams[of_sensor(stream)] as f64;
            let mean = sums[of_sensor(stream)] / count;
            let squared = wanted * wanted / (SAFETY[0] + SAFETY[1] / count.sqrt());
            let least = SMALLEST_FINAL * samples(stream);
            self.length((share(stream) * mean / squared).max(least) as u64)
        };
        (0..pilot.streams()).map(length).collect()
    }

    /// Whether the sensor of each stream is within the error.
    pub(super) fn met_together(&self, cells: &Cells, means: &[f64], wanted: f64) -> Vec<bool> {
        let widths = self.half_widths(cells, means);
        let rms = self.root_mean_squares(|stream| widths[stream]);
        let sensors = self.sensors.of_stream.iter();
        sensors.map(|&sensor| rms[sensor] <= wanted).collect()
    }

    /// Of intervals, relative to values or the floor; 0 of what never varies.
    fn half_widths(&self, cells: &Cells, means: &[f64]) -> Vec<f64> {
        let width = |stream: usize| {
            let floor = FLOOR * means[self.sensors.of_stream[stream]].abs();
            let scale = self.value(cells, stream).abs().max(floor);
            match cells.summary(stream).variance.sqrt() * self.factor {
                0.0 => 0.0,
                width => width / scale,
            }
        };
        (0..cells.streams()).map(width).collect()
    }

    /// Over the streams of each sensor.
    fn root_mean_squares(&self, of: impl Fn(usize) -> f64) -> Vec<f64> {
        let squares = self.sensors.sum(|stream| of(stream) * of(stream));
        let counts = squares.iter().zip(&self.sensors.streams);
        counts
            .map(|(square, &count)| (square / count.max(1) as f64).sqrt())
            .collect()
    }
}

#[cfg(test)]
mod tests;
