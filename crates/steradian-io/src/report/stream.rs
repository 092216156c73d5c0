//! Reports of measurements that come [block by block](steradian::transport::measure_in_blocks), in memory that does not grow with the points.
//!
//! The bytes are those of the report of all blocks together. CSV and Parquet are written as blocks come. JSON begins with whether every tolerance
//! was met, so blocks after the first wait in a file until all are there.

use std::io::{self, Write};
use std::path::PathBuf;

use steradian::measurement::{Gathered, Measurements, Unmeasured};

#[cfg(feature = "parquet")]
use super::error::ReportError;
use super::run::Run;
use super::spool::Spool;
use super::{csv, json};

/// What a block of measurements is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StreamFormat {
    /// [`super::json`].
    Json,
    /// [`super::csv`].
    Csv,
    /// [`super::parquet`].
    #[cfg(feature = "parquet")]
    Parquet,
}

/// What all blocks of a run have in common, and where they go.
#[derive(Clone, Debug)]
pub struct StreamFacts {
    /// Hash of the scene's content.
    pub scene_hash: String,
    /// Version of Steradian.
    pub version: String,
    /// A file for blocks that must wait; there is none before, and none after.
    pub scratch: PathBuf,
}

/// How a run went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// No light was left out and no point is missing.
    pub complete: bool,
    /// Readings that did not meet their tolerance.
    pub missed: usize,
}

/// A report in the making.
pub struct Stream<W: Write + Send> {
    facts: StreamFacts,
    /// The measurements so far, without their points.
    found: Option<Measurements>,
    missed: usize,
    writer: Writer<W>,
}

enum Writer<W: Write + Send> {
    Csv(Box<csv::Writer<W>>),
    Json(JsonBlocks<W>),
    /// Columns are known with the first block.
    #[cfg(feature = "parquet")]
    NoParquet(W),
    #[cfg(feature = "parquet")]
    Parquet(Box<super::parquet::Writer<W>>),
    /// After a failure.
    Broken,
}

impl<W: Write + Send> Stream<W> {
    /// Begins a report.
    ///
    /// # Errors
    /// If `out` refuses.
    pub fn new(format: StreamFormat, facts: StreamFacts, out: W) -> io::Result<Self> {
        let writer = match format {
            StreamFormat::Csv => Writer::Csv(Box::new(csv::Writer::new(out)?)),
            StreamFormat::Json => Writer::Json(JsonBlocks::new(out)),
            #[cfg(feature = "parquet")]
            StreamFormat::Parquet => Writer::NoParquet(out),
        };
        Ok(Self {
            facts,
            found: None,
            missed: 0,
            writer,
        })
    }

    /// Adds the next block.
    ///
    /// # Errors
    /// If the output or the file of waiting blocks refuses, or two columns of Parquet would have one name.
    pub fn block(&mut self, block: Measurements) -> io::Result<()> {
        let found = self.found.get_or_insert_with(|| Measurements {
            sensors: vec![],
            ..block.without_points()
        });
        found.append_without_points(&block);
        self.writer = match std::mem::replace(&mut self.writer, Writer::Broken) {
            Writer::Csv(mut writer) => {
                self.missed += block.missed();
                writer.block(&block)?;
                Writer::Csv(writer)
            }
            Writer::Json(mut writer) => {
                writer.block(block, &self.facts)?;
                self.missed = writer.gathered.missed();
                Writer::Json(writer)
            }
            #[cfg(feature = "parquet")]
            Writer::NoParquet(out) => {
                let run = self.facts.run(found);
                self.missed += block.missed();
                let mut writer = super::parquet::Writer::new(&run, out).map_err(told)?;
                writer.block(&block).map_err(told)?;
                Writer::Parquet(Box::new(writer))
            }
            #[cfg(feature = "parquet")]
            Writer::Parquet(mut writer) => {
                self.missed += block.missed();
                writer.block(&block).map_err(told)?;
                Writer::Parquet(writer)
            }
            Writer::Broken => return Err(broken()),
        };
        Ok(())
    }

    /// Writes the rest and gives the output back; `missing` are points that the run did not come to.
    ///
    /// # Errors
    /// As [`block`](Self::block); or if there was no block.
    pub fn finish(self, missing: &[Unmeasured]) -> io::Result<(W, Verdict)> {
        let mut found = self.found.ok_or_else(broken)?;
        found.leave_out(missing);
        let run = self.facts.run(&found);
        let out = match self.writer {
            Writer::Csv(writer) => writer.finish()?,
            Writer::Json(writer) => writer.finish(&run, missing)?,
            #[cfg(feature = "parquet")]
            Writer::Parquet(writer) => {
                let facts = json::facts_if(&run, self.missed == 0);
                writer.finish(&facts).map_err(told)?
            }
            #[cfg(feature = "parquet")]
            Writer::NoParquet(_) => return Err(broken()),
            Writer::Broken => return Err(broken()),
        };
        let verdict = Verdict {
            complete: found.complete(),
            missed: self.missed,
        };
        Ok((out, verdict))
    }
}

impl StreamFacts {
    fn run<'a>(&'a self, measurements: &'a Measurements) -> Run<'a> {
        Run {
            measurements,
            scene_hash: &self.scene_hash,
            version: &self.version,
        }
    }
}

/// The first block stays in memory, for most runs have no other.
struct JsonBlocks<W> {
    out: W,
    gathered: Gathered,
    blocks: Waiting,
}

enum Waiting {
    Nothing,
    Block(Box<Measurements>),
    Blocks(Spool),
}

impl<W: Write> JsonBlocks<W> {
    fn new(out: W) -> Self {
        Self {
            out,
            gathered: Gathered::default(),
            blocks: Waiting::Nothing,
        }
    }

    fn block(&mut self, block: Measurements, facts: &StreamFacts) -> io::Result<()> {
        self.gathered.add(&block);
        self.blocks = match std::mem::replace(&mut self.blocks, Waiting::Nothing) {
            Waiting::Nothing => Waiting::Block(Box::new(block)),
            Waiting::Block(first) => {
                let mut spool = Spool::create(facts.scratch.clone())?;
                spool.push(&first)?;
                spool.push(&block)?;
                Waiting::Blocks(spool)
            }
            Waiting::Blocks(mut spool) => {
                spool.push(&block)?;
                Waiting::Blocks(spool)
            }
        };
        Ok(())
    }

    fn finish(self, run: &Run<'_>, missing: &[Unmeasured]) -> io::Result<W> {
        let Self {
            mut out,
            gathered,
            blocks,
        } = self;
        match blocks {
            Waiting::Nothing => return Err(broken()),
            Waiting::Block(mut whole) => {
                whole.leave_out(missing);
                let run = Run {
                    measurements: &whole,
                    ..*run
                };
                json::write_blocks(&run, &gathered, &mut &*whole, &mut out)?;
            }
            Waiting::Blocks(mut spool) => {
                json::write_blocks(run, &gathered, &mut spool.read(&gathered), &mut out)?;
            }
        }
        out.flush()?;
        Ok(out)
    }
}

fn broken() -> io::Error {
    io::Error::other("there is nothing to write")
}

/// A failure of the system as it is, others with their message.
#[cfg(feature = "parquet")]
fn told(error: ReportError) -> io::Error {
    match error {
        ReportError::Output(source) => source,
        error => io::Error::other(error),
    }
}
