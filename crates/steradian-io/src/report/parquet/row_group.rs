//! Rows that are written together, column by column.

use std::io::Write;

use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::{ParquetError, Result};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use steradian::estimation::Estimate;

use super::super::rows::{Row, finite};
use super::Parts;

/// Rows by column.
pub struct RowGroup {
    sensors: Vec<ByteArray>,
    indices: Vec<i64>,
    vectors: [Numbers; 6],
    quantities: Vec<ByteArray>,
    units: Vec<ByteArray>,
    numbers: [Numbers; 4],
    converged: Vec<bool>,
    /// In the order of [`Parts::columns`].
    shares: Vec<Numbers>,
}

/// Doubles that are there or not.
#[derive(Clone, Default)]
struct Numbers {
    there: Vec<f64>,
    /// 1 where a row has a number, 0 where it has none.
    levels: Vec<i16>,
}

impl Numbers {
    fn push(&mut self, number: Option<f64>) {
        self.there.extend(number);
        self.levels.push(i16::from(number.is_some()));
    }
}

impl RowGroup {
    /// No rows yet.
    pub fn new(parts: &Parts) -> Self {
        Self {
            sensors: Vec::new(),
            indices: Vec::new(),
            vectors: Default::default(),
            quantities: Vec::new(),
            units: Vec::new(),
            numbers: Default::default(),
            converged: Vec::new(),
            shares: vec![Numbers::default(); parts.columns().count()],
        }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.indices.len()
    }

    /// Adds a row with these parts.
    pub fn push(&mut self, parts: &Parts, row: &Row<'_>) {
        self.sensors.push(row.reading.sensor.as_str().into());
        self.indices.push(row.reading.index as i64);
        push_all(&mut self.vectors, row.vectors());
        self.quantities.push(row.quantity.into());
        self.units.push(row.unit.into());
        push_all(&mut self.numbers, row.numbers());
        self.converged.push(row.estimate.converged);
        let shares = shares(parts, row);
        push_all(&mut self.shares, shares);
    }

    /// Writes the rows, if there are any.
    pub fn write<W: Write + Send>(&self, file: &mut SerializedFileWriter<W>) -> Result<()> {
        if self.indices.is_empty() {
            return Ok(());
        }
        let mut group = file.next_row_group()?;
        write::<_, ByteArrayType>(&mut group, &self.sensors, None)?;
        write::<_, Int64Type>(&mut group, &self.indices, None)?;
        write_numbers(&mut group, &self.vectors)?;
        write::<_, ByteArrayType>(&mut group, &self.quantities, None)?;
        write::<_, ByteArrayType>(&mut group, &self.units, None)?;
        write_numbers(&mut group, &self.numbers)?;
        write::<_, BoolType>(&mut group, &self.converged, None)?;
        write_numbers(&mut group, &self.shares)?;
        group.close()?;
        Ok(())
    }
}

fn push_all(columns: &mut [Numbers], numbers: impl IntoIterator<Item = Option<f64>>) {
    for (column, number) in columns.iter_mut().zip(numbers) {
        column.push(number);
    }
}

/// Value and error of each part, in the order of [`Parts::columns`].
fn shares<'a>(parts: &'a Parts, row: &Row<'a>) -> impl Iterator<Item = Option<f64>> {
    let (channels, groups): (&[_], &[_]) = match row.has_parts {
        true => (&row.reading.channels, &row.reading.groups),
        false => (&[], &[]),
    };
    numbers_of(&parts.channels, channels).chain(numbers_of(&parts.groups, groups))
}

/// Value and error by name; what is `found` is in the order of the names, but need not be all of them.
fn numbers_of<'a>(
    names: &'a [String],
    found: &'a [(String, Estimate)],
) -> impl Iterator<Item = Option<f64>> {
    let mut found = found.iter().peekable();
    names.iter().flat_map(move |name| {
        let part = found.next_if(|(known, _)| known == name);
        let number = |of: fn(&Estimate) -> f64| part.and_then(|(_, part)| finite(of(part)));
        [number(|part| part.value), number(|part| part.std_error)]
    })
}

fn write_numbers<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    columns: &[Numbers],
) -> Result<()> {
    let mut columns = columns.iter();
    columns
        .try_for_each(|column| write::<_, DoubleType>(group, &column.there, Some(&column.levels)))
}

/// Writes the next column.
fn write<W: Write + Send, T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[T::T],
    levels: Option<&[i16]>,
) -> Result<()> {
    let column = group.next_column()?;
    let mut column = column.ok_or_else(|| ParquetError::General("no such column".to_owned()))?;
    column.typed::<T>().write_batch(values, levels, None)?;
    column.close()
}
