//! Putting the parts of one run together.

use super::replicates::share_largest;
use super::{EstimationError, Replicates};

/// The union of the cells of all shards of one run, bit for bit the result of the run in one piece.
///
/// Fails if shards differ in streams, columns or confidence, if two hold the same cell, or if a cell is in none.
pub fn merge_shards(shards: Vec<Vec<Replicates>>) -> Result<Vec<Replicates>, EstimationError> {
    let mut shards = shards.into_iter();
    let mut merged = shards
        .next()
        .ok_or_else(|| fault("there are none".to_owned()))?;
    for shard in shards {
        if shard.len() != merged.len() {
            return Err(fault(format!(
                "one has {} streams, another {}",
                merged.len(),
                shard.len()
            )));
        }
        for (stream, (into, part)) in merged.iter_mut().zip(&shard).enumerate() {
            unite(into, part).map_err(|what| fault(format!("stream {stream}: {what}")))?;
        }
    }
    if let Some(stream) = merged.iter().position(|stream| stream.samples.contains(&0)) {
        return Err(fault(format!(
            "a part of stream {stream} is in none of them"
        )));
    }
    share_largest(&mut merged);
    Ok(merged)
}

fn fault(what: String) -> EstimationError {
    EstimationError::Shards(what)
}

fn holds_samples(stream: &Replicates) -> bool {
    stream.samples.iter().any(|&samples| samples > 0)
}

fn unite(into: &mut Replicates, part: &Replicates) -> Result<(), &'static str> {
    let shape = |stream: &Replicates| {
        (
            stream.sensor,
            stream.samples.len(),
            stream.confidence.to_bits(),
        )
    };
    if shape(into) != shape(part) || into.weights != part.weights {
        return Err("they are of different runs");
    }
    into.converged = match (holds_samples(into), holds_samples(part)) {
        (true, true) => into.converged && part.converged,
        (true, false) => into.converged,
        (false, _) => part.converged,
    };
    into.largest = into.largest.max(part.largest);
    let columns = part.columns();
    for (replicate, &samples) in part
        .samples
        .iter()
        .enumerate()
        .filter(|(_, samples)| **samples > 0)
    {
        if into.samples[replicate] > 0 {
            return Err("two of them hold the same replicate");
        }
        into.samples[replicate] = samples;
        let cell = replicate * columns..(replicate + 1) * columns;
        into.sums[cell.clone()].copy_from_slice(&part.sums[cell]);
    }
    Ok(())
}
