//! Readings as Apache Parquet, for data frames and databases.
//!
//! A row is what it is in CSV: the [fixed columns](super::rows), doubles of the same bits, and null for what a reading does not have; no
//! NaN. After them stand the parts of the value, `channel:NAME` and `channel:NAME:std_error`, then `group:NAME` and `group:NAME:std_error`
//! for each light group, in the row's unit. They are null in rows of what a reading adds up to, and channels where they have no part.
//!
//! The metadata of the file hold what [JSON](super::json) says about the run under the same keys: texts as they are, else as JSON.
//! Rows are written in groups of bounded size, so that memory does not grow with their number. Pages are compressed by Snappy.
//!
//! Source: Apache Parquet format 2.9; of its types, only those of version 1.0.

mod row_group;

use std::collections::HashSet;
use std::io::Write;
use std::sync::Arc;

use parquet::basic::{Compression, ConvertedType, LogicalType, Repetition, Type as Physical};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};
use serde_json::{Map, Value};
use steradian::measurement::Measurements;

use self::row_group::RowGroup;
use super::error::ReportError;
use super::json;
use super::rows::{COLUMNS, rows};
use super::run::Run;

/// As many cells are kept in memory, eight bytes and a few more each.
const CELLS_IN_MEMORY: usize = 1 << 21;

/// Writes the readings.
///
/// # Errors
/// If `sink` cannot be written to, or the names of channels and light groups make two columns of one name.
pub fn encode(run: &Run<'_>, sink: impl Write + Send) -> Result<(), ReportError> {
    encode_in_groups(run, CELLS_IN_MEMORY, sink)
}

fn encode_in_groups(
    run: &Run<'_>,
    cells: usize,
    sink: impl Write + Send,
) -> Result<(), ReportError> {
    let mut writer = Writer::with_cells(run, cells, sink)?;
    writer.block(run.measurements)?;
    writer.finish(&json::facts(run)).map(drop)
}

/// Writes readings block by block.
pub struct Writer<W: Write + Send> {
    parts: Parts,
    rows_in_group: usize,
    group: RowGroup,
    file: SerializedFileWriter<W>,
}

impl<W: Write + Send> Writer<W> {
    /// Begins a file with the columns that these measurements, or a block of them, have.
    ///
    /// # Errors
    /// As [`encode`].
    pub fn new(run: &Run<'_>, sink: W) -> Result<Self, ReportError> {
        Self::with_cells(run, CELLS_IN_MEMORY, sink)
    }

    fn with_cells(run: &Run<'_>, cells: usize, sink: W) -> Result<Self, ReportError> {
        let parts = Parts::of(run.measurements);
        let schema = schema(&parts)?;
        Ok(Self {
            rows_in_group: (cells / schema.get_fields().len()).max(1),
            group: RowGroup::new(&parts),
            file: SerializedFileWriter::new(sink, schema, Arc::new(properties(run.version)))?,
            parts,
        })
    }

    /// Adds the readings of the next block.
    ///
    /// # Errors
    /// If the sink refuses.
    pub fn block(&mut self, block: &Measurements) -> Result<(), ReportError> {
        for reading in block.iter_readings() {
            rows(&reading).for_each(|row| self.group.push(&self.parts, &row));
            if self.group.len() >= self.rows_in_group {
                self.group.write(&mut self.file)?;
                self.group = RowGroup::new(&self.parts);
            }
        }
        Ok(())
    }

    /// Writes what is left, with the facts about the run, and gives the sink back.
    ///
    /// # Errors
    /// If the sink refuses.
    pub fn finish(mut self, facts: &Map<String, Value>) -> Result<W, ReportError> {
        self.group.write(&mut self.file)?;
        metadata(facts).for_each(|pair| self.file.append_key_value_metadata(pair));
        Ok(self.file.into_inner()?)
    }
}

/// Names of what values are made of.
struct Parts {
    channels: Vec<String>,
    groups: Vec<String>,
}

impl Parts {
    fn of(measurements: &Measurements) -> Self {
        let lanes = measurements.lanes.iter();
        Self {
            channels: lanes.map(|lane| lane.name.clone()).collect(),
            groups: measurements.group_names().into_iter().cloned().collect(),
        }
    }

    /// The columns that hold them.
    fn columns(&self) -> impl Iterator<Item = String> {
        let channels = self.channels.iter().map(|name| format!("channel:{name}"));
        let groups = self.groups.iter().map(|name| format!("group:{name}"));
        let columns = channels.chain(groups);
        columns.flat_map(|name| [name.clone(), format!("{name}:std_error")])
    }
}

fn schema(parts: &Parts) -> Result<TypePtr, ReportError> {
    let fixed = COLUMNS.into_iter().map(str::to_owned);
    let names: Vec<String> = fixed.chain(parts.columns()).collect();
    let mut known = HashSet::new();
    if let Some(name) = names.iter().find(|name| !known.insert(*name)) {
        let message = format!("two columns would have the name `{name}`; rename the light group");
        return Err(ReportError::Encoding(message));
    }
    let fields = names.iter().map(|name| field(name).map(Arc::new));
    let fields = fields.collect::<Result<_, _>>()?;
    let schema = Type::group_type_builder("readings").with_fields(fields);
    Ok(Arc::new(schema.build()?))
}

fn field(name: &str) -> Result<Type, ParquetError> {
    let (physical, repetition) = match name {
        "sensor" | "quantity" | "unit" => (Physical::BYTE_ARRAY, Repetition::REQUIRED),
        "index" => (Physical::INT64, Repetition::REQUIRED),
        "converged" => (Physical::BOOLEAN, Repetition::REQUIRED),
        _ => (Physical::DOUBLE, Repetition::OPTIONAL),
    };
    let field = Type::primitive_type_builder(name, physical).with_repetition(repetition);
    match physical {
        Physical::BYTE_ARRAY => field
            .with_logical_type(Some(LogicalType::String))
            .with_converted_type(ConvertedType::UTF8)
            .build(),
        _ => field.build(),
    }
}

fn properties(version: &str) -> WriterProperties {
    WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(format!("steradian version {version}"))
        .build()
}

fn metadata(facts: &Map<String, Value>) -> impl Iterator<Item = KeyValue> {
    facts.iter().filter_map(|(key, fact)| match fact {
        Value::Null => None,
        Value::String(text) => Some(KeyValue::new(key.clone(), text.clone())),
        fact => Some(KeyValue::new(key.clone(), fact.to_string())),
    })
}

impl From<ParquetError> for ReportError {
    fn from(error: ParquetError) -> Self {
        match error {
            ParquetError::External(source) => match source.downcast() {
                Ok(refused) => Self::Output(*refused),
                Err(source) => Self::Encoding(source.to_string()),
            },
            error => Self::Encoding(error.to_string()),
        }
    }
}

#[cfg(test)]
mod tests;
