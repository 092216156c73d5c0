//! Blocks of measurements that wait on disk until all are there: some formats say first what is known last.
//!
//! Of each point there are the sums of its replicates, in some 600 bytes. The file is beside the result until that is written.

use std::fs::{self, File};
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::PathBuf;

use steradian::measurement::{Gathered, Measurements};

use super::json::Blocks;

/// A file of blocks, removed when it is dropped.
#[derive(Debug)]
pub(super) struct Spool {
    path: PathBuf,
    file: File,
}

impl Spool {
    /// An empty file at this place.
    pub(super) fn create(path: PathBuf) -> io::Result<Self> {
        let mut options = File::options();
        let options = options.read(true).write(true).create(true).truncate(true);
        let file = options.open(&path)?;
        Ok(Self { path, file })
    }

    /// Appends a block: its length in bytes, then the block.
    pub(super) fn push(&mut self, block: &Measurements) -> io::Result<()> {
        let bytes = postcard::to_allocvec(block).map_err(io::Error::other)?;
        let mut out = BufWriter::new(&mut self.file);
        out.write_all(&(bytes.len() as u64).to_le_bytes())?;
        out.write_all(&bytes)?;
        out.flush()
    }

    /// The blocks from the first, as they are with what was gathered of all.
    pub(super) fn read<'s>(&'s mut self, gathered: &'s Gathered) -> Reread<'s> {
        Reread {
            spool: self,
            gathered,
        }
    }
}

impl Drop for Spool {
    fn drop(&mut self) {
        // What is left behind does no harm.
        let _ = fs::remove_file(&self.path);
    }
}

/// The blocks of a spool.
pub(super) struct Reread<'s> {
    spool: &'s mut Spool,
    gathered: &'s Gathered,
}

impl Blocks for Reread<'_> {
    fn each(&mut self, show: &mut dyn FnMut(&Measurements) -> io::Result<()>) -> io::Result<()> {
        self.spool.file.rewind()?;
        let end = self.spool.file.metadata()?.len();
        let mut file = BufReader::new(&mut self.spool.file);
        let mut bytes = Vec::new();
        while file.stream_position()? < end {
            let mut length = [0; 8];
            file.read_exact(&mut length)?;
            bytes.clear();
            (&mut file)
                .take(u64::from_le_bytes(length))
                .read_to_end(&mut bytes)?;
            let block: Result<Measurements, _> = postcard::from_bytes(&bytes);
            let mut block = block.map_err(io::Error::other)?;
            self.gathered.share_largest(&mut block);
            show(&block)?;
        }
        Ok(())
    }
}
