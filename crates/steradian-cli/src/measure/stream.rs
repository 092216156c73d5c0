//! Readings that are written block by block as they are made.

use std::path::Path;

use steradian::measurement::Measurements;
use steradian::transport::{Ended, measure_in_blocks};
use steradian_io::report::{AtomicFile, Stream, StreamFacts, StreamFormat};

use super::Job;
use crate::output::{Sink, refused};
use crate::progress::Watch;
use crate::result::VERSION;
use crate::status::{Failure, Outcome, remark};

/// Traces and writes; what was finished is kept whatever happens to the rest.
pub fn write(job: &Job, format: StreamFormat, file: Option<&Path>) -> Result<Outcome, Failure> {
    let facts = StreamFacts {
        scene_hash: job.scene.hash.clone(),
        version: VERSION.to_owned(),
        scratch: scratch(file),
    };
    let told = |error| refused(error, file);
    let mut stream = Stream::new(format, facts, Sink::open(file)?).map_err(told)?;
    let mut watch = Watch::new()?;
    let mut take = |mut block: Measurements| {
        job.dim(&mut block)?;
        stream.block(block).map_err(told)
    };
    let ended = measure_in_blocks(&job.scene.scene, &job.options, &mut watch, &mut take)?;
    if watch.finish() {
        remark("stopped by Ctrl-C: these are the readings so far");
    }
    let (sink, verdict) = stream.finish(&ended.missing).map_err(told)?;
    sink.finish()?;
    tell(&ended);
    match ended.fault {
        Some(fault) => Err(fault.into()),
        None => Ok(Outcome::fine_if(verdict.complete && verdict.missed == 0)),
    }
}

fn tell(ended: &Ended) {
    let missing = ended.missing.iter();
    missing.for_each(|missing| remark(&format!("not written: {missing}")));
}

/// Beside the output, where there is room for it; for standard output in the system's folder for such files (`TMPDIR`).
fn scratch(file: Option<&Path>) -> std::path::PathBuf {
    let folder = std::env::temp_dir().join("steradian");
    AtomicFile::scratch_name(file.unwrap_or(&folder))
}
