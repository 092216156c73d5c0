//! The energy balance: how well its accounts must be known.

use steradian::estimation::{Silent, Stopping};
use steradian::scene::Scene;
use steradian::sensor::{Kind, Term};
use steradian::transport::{MeasureOptions, measure};

use crate::status::Failure;

/// A tolerance relative to all that is emitted: n accounts that are each within ε Φ/√n make a balance within ε Φ.
///
/// Without it what comes out as nearly nothing, such as what glass absorbs, would have to be known as well as all the rest.
pub fn relative_to_emitted(scene: &Scene, options: &mut MeasureOptions) -> Result<(), Failure> {
    let Stopping {
        rel_error: Some(ratio),
        abs_error: None,
        ..
    } = options.plan.stop
    else {
        return Ok(());
    };
    let emitted = emitted(scene, options)?;
    let accounts = scene.sensors().iter().map(|sensor| match &sensor.kind {
        Kind::Balance(accounts) => accounts.len(),
        _ => 0,
    });
    let count = accounts.sum::<usize>() as f64;
    options.plan.stop.abs_error = (emitted > 0.0).then(|| ratio * emitted / count.sqrt());
    Ok(())
}

/// All that lights give.
fn emitted(scene: &Scene, options: &MeasureOptions) -> Result<f64, Failure> {
    let mut options = options.clone();
    options.sensors = Some(vec![Term::Emitted.name().into()]);
    options.plan.shard = None;
    let found = measure(scene, &options, &mut Silent)?;
    let readings = found.readings();
    let unit = readings.first().map(|reading| reading.unit.clone());
    let of_unit = readings
        .iter()
        .filter(|reading| Some(&reading.unit) == unit.as_ref());
    Ok(of_unit.map(|reading| reading.estimate.value).sum())
}
