//! The blocks of every band.

use std::sync::Arc;

use roxmltree::Node;
use steradian::brdf::Measured;
use steradian::brdf::measured::{
    AngleBasis, Block, MeasuredError, PatchMatrix, Rank, Side, TwoSided,
};

use super::numbers::{Negative, tokens};
use super::{Reader, children, shortened, text};
use crate::import::bsdf::{Band, BsdfError, XmlFault};

/// How the numbers of a block are arranged.
enum Structure {
    /// Incidence by columns, or by rows.
    Matrix {
        columns: bool,
    },
    Tree(Rank),
}

/// A block's direction.
#[derive(Copy, Clone, PartialEq)]
struct Way {
    from: Side,
    transmits: bool,
}

impl Way {
    fn named(name: &str) -> Option<Self> {
        let [transmits, above] = match name.to_ascii_lowercase().as_str() {
            "transmission front" => [true, false],
            "transmission back" => [true, true],
            "reflection front" => [false, false],
            "reflection back" => [false, true],
            _ => return None,
        };
        let from = if above { Side::Above } else { Side::Below };
        Some(Self { from, transmits })
    }
}

/// A band while it is read.
#[derive(Default)]
struct Tables(Vec<(String, TwoSided)>);

impl Tables {
    fn of(&mut self, band: &str) -> &mut TwoSided {
        let known = self.0.iter().position(|(name, _)| name == band);
        let index = known.unwrap_or_else(|| {
            self.0.push((band.to_owned(), TwoSided::default()));
            self.0.len() - 1
        });
        &mut self.0[index].1
    }
}

impl Reader<'_> {
    pub(super) fn bands(&mut self, layer: Node) -> Result<Vec<Band>, BsdfError> {
        let definition = self.need(layer, "DataDefinition")?;
        let structure = self.structure(self.need(definition, "IncidentDataStructure")?)?;
        let bases = self.bases(definition)?;
        let mut tables = Tables::default();
        for data in children(layer, "WavelengthData") {
            let band = self.band_name(data)?;
            for node in children(data, "WavelengthDataBlock") {
                let (way, block) = self.block(node, &structure, &bases)?;
                self.place(tables.of(&band), &band, way, block);
            }
        }
        if tables.0.is_empty() {
            self.need(self.need(layer, "WavelengthData")?, "WavelengthDataBlock")?;
        }
        let band = |(name, mut table): (String, TwoSided)| {
            self.complete(&name, &mut table);
            let model = Measured::TwoSided(Arc::new(table));
            Band { name, model }
        };
        Ok(tables.0.into_iter().map(band).collect())
    }

    fn structure(&self, node: Node) -> Result<Structure, BsdfError> {
        match text(node).to_ascii_lowercase().as_str() {
            "columns" => Ok(Structure::Matrix { columns: true }),
            "rows" => Ok(Structure::Matrix { columns: false }),
            "tensortree3" => Ok(Structure::Tree(Rank::Three)),
            "tensortree4" => Ok(Structure::Tree(Rank::Four)),
            found => {
                let fault = XmlFault::Unexpected {
                    expected: "Columns, Rows, TensorTree3 or TensorTree4",
                    found: shortened(found),
                };
                Err(self.source.at_node(node, fault))
            }
        }
    }

    /// `Visible`, `Solar`, …; a wavelength with its unit.
    fn band_name(&self, data: Node) -> Result<String, BsdfError> {
        let node = self.need(data, "Wavelength")?;
        let unit = node.attribute("unit").unwrap_or("Integral");
        Ok(match unit.eq_ignore_ascii_case("integral") {
            true => text(node).to_owned(),
            false => format!("{} {}", text(node), unit.to_lowercase()),
        })
    }

    fn block(
        &mut self,
        node: Node,
        structure: &Structure,
        bases: &[AngleBasis],
    ) -> Result<(Way, Block), BsdfError> {
        let named = self.need(node, "WavelengthDataDirection")?;
        let direction = text(named);
        let way = Way::named(direction).ok_or_else(|| {
            let fault = XmlFault::Unexpected {
                expected: "Transmission or Reflection, Front or Back",
                found: shortened(direction),
            };
            self.source.at_node(named, fault)
        })?;
        let block = match structure {
            Structure::Matrix { columns } => {
                Block::Matrix(self.matrix(node, *columns, bases, direction)?)
            }
            Structure::Tree(rank) => {
                let basis = self.need(node, "AngleBasis")?;
                self.expect(basis, text(basis), "LBNL/Shirley-Chiu", "LBNL/Shirley-Chiu")?;
                Block::Tree(self.tree(self.need(node, "ScatteringData")?, *rank, direction)?)
            }
        };
        Ok((way, block))
    }

    fn matrix(
        &mut self,
        node: Node,
        columns: bool,
        bases: &[AngleBasis],
        direction: &str,
    ) -> Result<PatchMatrix, BsdfError> {
        let column = self.named_bases(bases, self.need(node, "ColumnAngleBasis")?)?;
        let row = self.named_bases(bases, self.need(node, "RowAngleBasis")?)?;
        let data = self.need(node, "ScatteringData")?;
        let (values, last) = self.values(data, direction)?;
        let matching = row
            .iter()
            .zip(&column)
            .find(|(row, column)| row.patches() * column.patches() == values.len());
        let (row, column) = matching.unwrap_or((&row[0], &column[0]));
        let matrix = match columns {
            true => PatchMatrix::new(column.clone(), row.clone(), values),
            false => {
                let values = transposed(&values, column.patches());
                PatchMatrix::new(row.clone(), column.clone(), values)
            }
        };
        matrix.map_err(|fault| self.table_fault(last, direction, fault))
    }

    /// The numbers of a matrix, and where the last one stands.
    fn values(&mut self, data: Node, direction: &str) -> Result<(Vec<f32>, usize), BsdfError> {
        let (mut values, mut last) = (vec![], data.range().start);
        let mut negative = Negative::default();
        for token in tokens(data) {
            values.push(self.value(token, &mut negative)?);
            last = token.byte;
        }
        let warning = negative.warning(self, direction);
        self.warnings.extend(warning);
        Ok((values, last))
    }

    pub(super) fn table_fault(
        &self,
        byte: usize,
        direction: &str,
        fault: MeasuredError,
    ) -> BsdfError {
        let direction = shortened(direction);
        self.source.at(byte, XmlFault::Table { direction, fault })
    }

    fn place(&mut self, table: &mut TwoSided, band: &str, way: Way, block: Block) {
        let old = match way.transmits {
            true => table.transmission(way.from),
            false => table.reflection(way.from),
        };
        if old.is_some() {
            let what = if way.transmits {
                "transmission"
            } else {
                "reflection"
            };
            let warning = format!("{band}: a block of {what} stands there twice; the last counts");
            self.warnings.push(warning);
        }
        match way.transmits {
            true => table.set_transmission(way.from, block),
            false => table.set_reflection(way.from, block),
        }
    }

    /// Transmission that is there in one direction only serves for the other.
    fn complete(&mut self, band: &str, table: &mut TwoSided) {
        for from in [Side::Above, Side::Below] {
            let missing = table.transmission(from).is_none();
            let Some(block) = table.transmission(from.other()).filter(|_| missing) else {
                continue;
            };
            let reversed = block.reversed();
            table.set_transmission(from, reversed);
            let warning = "transmission in one direction only: taken as reciprocal";
            self.warnings.push(format!("{band}: {warning}"));
            return;
        }
    }
}

fn transposed(values: &[f32], width: usize) -> Vec<f32> {
    let columns = 0..width;
    columns
        .flat_map(|column| values.iter().skip(column).step_by(width).copied())
        .collect()
}
