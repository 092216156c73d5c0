//! What every report of readings takes: the measurements and the facts about the run that they do not hold.

use steradian::measurement::Measurements;

/// Measurements with the identity of the scene they were made in.
#[derive(Clone, Copy, Debug)]
pub struct Run<'a> {
    /// What was found.
    pub measurements: &'a Measurements,
    /// Hash of the scene's content.
    pub scene_hash: &'a str,
    /// Version of Steradian.
    pub version: &'a str,
}

/// What the error bars of a report do not cover.
pub const SAMPLING_ERROR_ONLY: &str =
    "Sampling error only; errors of geometry, photometry and sky are not included.";

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use serde_json::json;

    /// Two lanes and two groups; a point by closed form, and one with four replicates of ten samples whose `visible`
    /// part from the lamp has the means 1, 2, 3, 4 and whose other columns are zero.
    pub fn measurements() -> Measurements {
        let sums = [10, 0, 0, 0, 20, 0, 0, 0, 30, 0, 0, 0, 40, 0, 0, 0];
        let replicates = json!({
            "sensor": 0, "confidence": 0.95, "weights": [1.0, 1.0, 1.0, 1.0], "sums": sums,
            "samples": [10, 10, 10, 10], "largest": 5.0, "largest_of_sensor": 5.0, "converged": true,
        });
        let point = |index: usize, exact: [f64; 4], replicates: serde_json::Value| {
            let closed = [replicates.is_null(); 4];
            json!({
                "index": index, "position": [0.5, 0.0, index], "normal": [0.0, 0.0, 1.0],
                "sits_on": { "shape": "desk", "side": "front" }, "exact": exact, "closed": closed,
                "replicates": replicates,
            })
        };
        let irradiance = json!({
            "name": "irradiance", "unit": "W/m2", "weights": [1.0, 1.0], "channel_factor": 1.0, "photometric": false,
        });
        let points = [
            point(0, [80.0, 20.0, 0.0, 0.0], json!(null)),
            point(1, [0.0; 4], replicates),
        ];
        let measurements = json!({
            "scene_name": "A, \"desk\"", "seed": 3, "confidence": 0.95, "luminous_efficacy": 179.0, "max_depth": null,
            "lanes": [{ "name": "visible" }, { "name": "nir" }], "groups": ["lamp", "window"],
            "sensors": [{ "name": "a, b", "quantities": [irradiance], "layout": null, "points": points }],
            "unsampled": ["point lights seen in mirrors"], "warnings": ["a warning"], "shard": null,
        });
        serde_json::from_value(measurements).unwrap()
    }

    /// A run of these measurements.
    pub fn run(measurements: &Measurements) -> Run<'_> {
        Run {
            measurements,
            scene_hash: "0123456789abcdef0123",
            version: "1.2.3",
        }
    }

    /// s² = 5/3 of the means over four; the rounding of single precision adds less than a millionth.
    #[test]
    fn the_example_has_the_error_of_four_means() {
        let reading = &measurements().readings()[1];
        assert_eq!(reading.estimate.value, 2.5);
        assert!((reading.estimate.std_error - (5.0_f64 / 12.0).sqrt()).abs() < 1e-6);
    }
}
