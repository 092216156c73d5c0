//! Angle bases: those that a file defines, and those that programs know.

use roxmltree::Node;
use steradian::brdf::measured::AngleBasis;

use super::{Reader, child, children, shortened, text};
use crate::import::bsdf::{BsdfError, XmlFault};

impl Reader<'_> {
    /// All bases that the file defines.
    pub(super) fn bases(&mut self, definition: Node) -> Result<Vec<AngleBasis>, BsdfError> {
        let mut bases = vec![];
        for node in children(definition, "AngleBasis") {
            let basis = self.basis(node)?;
            let known = AngleBasis::named(basis.name());
            if !known.is_empty() && !known.iter().any(|other| other.divides_as(&basis)) {
                let name = basis.name();
                let warning = format!("the file divides {name} otherwise than is usual");
                self.warnings.push(warning);
            }
            bases.push(basis);
        }
        Ok(bases)
    }

    fn basis(&self, node: Node) -> Result<AngleBasis, BsdfError> {
        let name = text(self.need(node, "AngleBasisName")?);
        let mut rings = vec![];
        let mut below = 0.0;
        for block in children(node, "AngleBasisBlock") {
            let bounds = self.need(block, "ThetaBounds")?;
            let lower = child(bounds, "LowerTheta");
            let upper: f64 = self.number(self.need(bounds, "UpperTheta")?)?;
            if let Some(lower) = lower.filter(|_| !rings.is_empty()) {
                self.expect_continued(lower, below)?;
            }
            rings.push((upper, self.number(self.need(block, "nPhis")?)? as usize));
            below = upper;
        }
        AngleBasis::new(name, &rings)
            .map_err(|fault| self.table_fault(node.range().start, name, fault))
    }

    /// The lower bound of a ring is the upper one of the ring before.
    fn expect_continued(&self, lower: Node, below: f64) -> Result<(), BsdfError> {
        let found = self.number(lower)?;
        if (found - below).abs() <= 1e-6 * below {
            return Ok(());
        }
        let fault = XmlFault::Unexpected {
            expected: "the upper bound of the ring before",
            found: found.to_string(),
        };
        Err(self.source.at_node(lower, fault))
    }

    pub(super) fn number(&self, node: Node) -> Result<f64, BsdfError> {
        let word = text(node);
        let number = word.parse().ok().filter(|x: &f64| x.is_finite());
        number.ok_or_else(|| {
            let fault = XmlFault::NoNumber(shortened(word));
            self.source.at_node(node, fault)
        })
    }

    /// The bases that a block may mean: those of the file, else those that programs know.
    pub(super) fn named_bases(
        &self,
        bases: &[AngleBasis],
        node: Node,
    ) -> Result<Vec<AngleBasis>, BsdfError> {
        let name = text(node);
        let defined = bases
            .iter()
            .find(|basis| basis.name().eq_ignore_ascii_case(name));
        let found = match defined {
            Some(basis) => vec![basis.clone()],
            None => AngleBasis::named(name),
        };
        match found.is_empty() {
            true => Err(self
                .source
                .at_node(node, XmlFault::UnknownBasis(shortened(name)))),
            false => Ok(found),
        }
    }
}
