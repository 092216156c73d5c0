//! Readings from the file of an earlier run: nothing is traced.

use std::path::Path;

use steradian::measurement::Measurements;
use steradian_io::files::DiskFiles;
use steradian_io::report::stored;

use super::Arguments;
use crate::result::Readings;
use crate::status::Failure;

/// Whether the file is a result of `measure`, by its name.
pub fn is_one(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "json")
}

/// Reads the result, all sensors of it or those asked for.
pub fn read(arguments: &Arguments) -> Result<Readings, Failure> {
    refuse_tracing(arguments)?;
    let run = stored::read(&arguments.scene, &DiskFiles::default())?;
    let mut measurements = run.measurements;
    keep(&arguments.sensor, &mut measurements)?;
    measurements.dimming = arguments
        .when
        .dimming(measurements.dimming, &measurements.groups)?;
    Ok(Readings {
        measurements,
        scene_hash: run.scene_hash,
        version: run.version,
    })
}

/// What asks for other samples than a result has.
fn refuse_tracing(arguments: &Arguments) -> Result<(), Failure> {
    let (stop, engine) = (&arguments.stop, &arguments.engine);
    let given = [
        ("--points", arguments.points.is_some()),
        ("--balance", arguments.balance),
        ("--rel-error", stop.rel_error.is_some()),
        ("--abs-error", stop.abs_error.is_some()),
        ("--rms-error", stop.rms_error.is_some()),
        ("--time", stop.time.is_some()),
        ("--samples", stop.samples.is_some()),
        ("--max-depth", engine.max_depth.is_some()),
        ("--shard", engine.shard.is_some()),
        ("--seed", engine.seed != 0),
    ];
    let Some((flag, _)) = given.iter().find(|(_, given)| *given) else {
        return Ok(());
    };
    Err(Failure::message(format!(
        "{} is a result, from which nothing is traced: {flag} needs the scene",
        arguments.scene.display()
    )))
}

fn keep(wanted: &[String], measurements: &mut Measurements) -> Result<(), Failure> {
    let sensors = &mut measurements.sensors;
    let is_there = |name: &&String| sensors.iter().any(|sensor| sensor.name == **name);
    if let Some(name) = wanted.iter().find(|name| !is_there(name)) {
        let known: Vec<_> = sensors
            .iter()
            .map(|sensor| format!("`{}`", sensor.name))
            .collect();
        let known = known.join(", ");
        let message = format!("there is no sensor `{name}`; the result has {known}");
        return Err(Failure::message(message));
    }
    sensors.retain(|sensor| wanted.is_empty() || wanted.contains(&sensor.name));
    Ok(())
}
