//! Measuring a described scene.

use steradian::estimation::{Plan, Silent, Stopping};
use steradian::measurement::{Measurements, Reading};
use steradian::scene::Scene;
use steradian::scene::description::SceneDescription;
use steradian::transport::{MeasureOptions, measure};

/// 63 degrees of freedom make |z| > 4 a matter of 1.7e-4.
const REPLICATES: u32 = 64;

/// A plan of so many samples a reading.
pub fn samples(samples: u64) -> MeasureOptions {
    stopping(Stopping::at_samples(samples))
}

/// A plan that stops when the 95 % interval is narrower than this part of the value.
pub fn rel_error(rel_error: f64) -> MeasureOptions {
    stopping(Stopping::at_rel_error(rel_error))
}

fn stopping(stop: Stopping) -> MeasureOptions {
    let plan = Plan {
        stop,
        seed: 2006,
        replicates: REPLICATES,
        ..Plan::default()
    };
    MeasureOptions {
        plan,
        ..MeasureOptions::default()
    }
}

/// The validated scene.
///
/// # Panics
/// If the description has problems.
pub fn validated(description: &SceneDescription) -> Scene {
    Scene::new(description).unwrap_or_else(|problems| {
        let problems: Vec<_> = problems.iter().map(ToString::to_string).collect();
        panic!("{}", problems.join("; "))
    })
}

/// Everything the sensors of a scene measure.
///
/// # Panics
/// If the scene cannot be measured.
pub fn measured(description: &SceneDescription, options: &MeasureOptions) -> Measurements {
    measure(&validated(description), options, &mut Silent).unwrap_or_else(|error| panic!("{error}"))
}

/// The first reading of a sensor.
///
/// # Panics
/// If there is no such sensor.
pub fn reading(measurements: &Measurements, sensor: &str) -> Reading {
    let mut readings = measurements.readings().into_iter();
    readings
        .find(|reading| reading.sensor == sensor)
        .unwrap_or_else(|| panic!("there is no reading of `{sensor}`"))
}
