//! A part of a run on its way from `--shard` to `merge`.

use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use steradian_io::report::{ReportError, Shard};

use crate::output;
use crate::result::VERSION;
use crate::status::{Failure, Outcome};

/// What a part holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Readings.
    Readings,
    /// A picture.
    Picture,
}

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Self::Readings => "readings",
            Self::Picture => "picture",
        }
    }
}

/// Writes a part; whether the whole converged is told when it is merged.
pub fn write(
    kind: Kind,
    content: &impl Serialize,
    scene_hash: &str,
    file: Option<&Path>,
) -> Result<Outcome, Failure> {
    let header = json!({ "kind": kind.name(), "scene_hash": scene_hash, "version": VERSION });
    output::write(&Shard::new(header, content)?.encode(), file)?;
    Ok(Outcome::Fine)
}

/// The parts of one run.
pub struct Parts {
    header: Value,
    shards: Vec<(PathBuf, Shard)>,
}

impl Parts {
    /// Reads the parts and makes sure that they belong together.
    pub fn read(files: &[PathBuf]) -> Result<Self, Failure> {
        let shards: Vec<(PathBuf, Shard)> = files.iter().map(read).collect::<Result<_, _>>()?;
        let Some((first, shard)) = shards.first() else {
            return Err(Failure::message("there are no parts"));
        };
        let header = shard.header.clone();
        if let Some((other, shard)) = shards.iter().find(|(_, shard)| shard.header != header) {
            return Err(Failure::message(format!(
                "the parts are of different scenes, versions or kinds: {} has {header}, {} has {}",
                first.display(),
                other.display(),
                shard.header
            )));
        }
        Ok(Self { header, shards })
    }

    /// What the parts hold.
    pub fn kind(&self) -> Result<Kind, Failure> {
        let kinds = [Kind::Readings, Kind::Picture];
        let known = kinds
            .into_iter()
            .find(|kind| self.header["kind"] == kind.name());
        known.ok_or_else(|| {
            Failure::message("the parts are of a kind that this version does not know")
        })
    }

    /// Hash of the scene.
    pub fn scene_hash(&self) -> String {
        self.header["scene_hash"]
            .as_str()
            .unwrap_or_default()
            .to_owned()
    }

    /// The content of each part.
    pub fn contents<T: DeserializeOwned>(&self) -> Result<Vec<T>, Failure> {
        let content = |(path, shard): &(PathBuf, Shard)| {
            shard.content().map_err(|error| in_file(path, &error))
        };
        self.shards.iter().map(content).collect()
    }
}

fn read(path: &PathBuf) -> Result<(PathBuf, Shard), Failure> {
    let bytes = std::fs::read(path).map_err(|source| ReportError::Read {
        path: path.clone(),
        source,
    })?;
    let shard = Shard::decode(&bytes).map_err(|error| in_file(path, &error))?;
    Ok((path.clone(), shard))
}

fn in_file(path: &Path, error: &ReportError) -> Failure {
    Failure::message(format!("{}: {error}", path.display()))
}
