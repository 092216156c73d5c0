//! BSDF XML of Lawrence Berkeley National Laboratory, as WINDOW and Radiance's genBSDF write it.
//!
//! | element | what is read |
//! |---|---|
//! | `Material` | `Name`, `Manufacturer`, `DeviceType`, `Thickness`, `Width`, `Height` |
//! | `IncidentDataStructure` | `Columns` or `Rows`: which the patches of incidence are; `TensorTree3`, `TensorTree4` |
//! | `AngleBasis` | the rings of bases; they go before those of the same name that programs know |
//! | `WavelengthData` | `Wavelength` names the band; its blocks `WavelengthDataBlock` |
//! | `WavelengthDataDirection` | `Front`: light from outside, from below the surface; `Back`: from inside, from above |
//! | `ScatteringData` | values in 1/sr, separated by blanks or commas |
//!
//! Differences from Radiance:
//!
//! - Direct transmission is part of the patch of the same number, as in the file; nothing is made a line of sight.
//! - No Lambertian part is taken out: the table is the whole.
//! - With `Rows` the row's basis is that of incidence.
//! - Negative values are taken as 0, as Radiance does, but with a warning.
//! - Transmission of one direction serves for both by reciprocity, as in Radiance, but with a warning.
//! - The chromaticity of `CIE-X` and `CIE-Z`, `CIE-u` and `CIE-v` is read as bands of their own, not as colour.
//!
//! Lines before the XML, which genBSDF leaves behind, are passed over. Source: J. C. Jonsson et al., *WINDOW 6 BSDF XML*, schema
//! BSDF-v1.4; G. Ward, *genBSDF tutorial* (2013).

mod bands;
mod bases;
mod header;
mod numbers;
mod place;
mod tree;

use roxmltree::{Document, Node, ParsingOptions};

use super::{BsdfError, MeasuredFile, XmlFault};
use place::Source;

/// Elements and texts of a file at most.
const NODES: u32 = 1_000_000;

/// Reads a BSDF XML file.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn read(bytes: &[u8]) -> Result<MeasuredFile, BsdfError> {
    let (source, before) = Source::find(bytes)?;
    let options = ParsingOptions {
        nodes_limit: NODES,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(source.text, options)
        .map_err(|error| source.syntax(&error))?;
    let mut reader = Reader {
        source,
        warnings: vec![],
    };
    if before > 0 {
        let lines = "the file does not begin with XML; passed over lines";
        reader.warnings.push(format!("{lines}: {before}"));
    }
    reader.file(&document)
}

/// What a file becomes while it is read.
struct Reader<'a> {
    source: Source<'a>,
    warnings: Vec<String>,
}

impl Reader<'_> {
    fn file(mut self, document: &Document) -> Result<MeasuredFile, BsdfError> {
        let root = document.root_element();
        self.expect(
            root,
            root.tag_name().name(),
            "<WindowElement>",
            "WindowElement",
        )?;
        if let Some(kind) = child(root, "FileType") {
            self.expect(kind, text(kind), "the file type BSDF", "BSDF")?;
        }
        let layer = self.need(self.need(root, "Optical")?, "Layer")?;
        if layer
            .next_sibling_element()
            .is_some_and(|next| next.has_tag_name_of(layer))
        {
            self.warnings
                .push("only the first layer is read".to_owned());
        }
        Ok(MeasuredFile {
            format: "LBNL BSDF XML",
            header: header::read(layer),
            bands: self.bands(layer)?,
            warnings: self.warnings,
        })
    }

    fn expect(
        &self,
        node: Node,
        found: &str,
        expected: &'static str,
        value: &str,
    ) -> Result<(), BsdfError> {
        match found.eq_ignore_ascii_case(value) {
            true => Ok(()),
            false => Err(self.source.at_node(
                node,
                XmlFault::Unexpected {
                    expected,
                    found: shortened(found),
                },
            )),
        }
    }

    /// The first element of this name.
    fn need<'n, 'i>(
        &self,
        parent: Node<'n, 'i>,
        name: &'static str,
    ) -> Result<Node<'n, 'i>, BsdfError> {
        child(parent, name).ok_or_else(|| {
            let fault = XmlFault::Missing {
                parent: parent.tag_name().name().to_owned(),
                child: name,
            };
            self.source.at_node(parent, fault)
        })
    }
}

trait Siblings {
    fn has_tag_name_of(&self, other: Self) -> bool;
}

impl Siblings for Node<'_, '_> {
    fn has_tag_name_of(&self, other: Self) -> bool {
        self.tag_name().name() == other.tag_name().name()
    }
}

/// The first child element of this name, in any namespace.
fn child<'n, 'i>(parent: Node<'n, 'i>, name: &str) -> Option<Node<'n, 'i>> {
    children(parent, name).next()
}

fn children<'n, 'i>(parent: Node<'n, 'i>, name: &str) -> impl Iterator<Item = Node<'n, 'i>> {
    parent
        .children()
        .filter(move |node| node.is_element() && node.tag_name().name() == name)
}

fn text<'n>(node: Node<'n, '_>) -> &'n str {
    node.text().unwrap_or_default().trim()
}

/// How a text begins.
fn shortened(text: &str) -> String {
    match text.char_indices().nth(40) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests;
