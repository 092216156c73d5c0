//! Lines and columns of what is wrong.

use roxmltree::Node;

use crate::import::bsdf::{BsdfError, XmlFault};

/// The XML of a file.
#[derive(Copy, Clone, Debug)]
pub(super) struct Source<'a> {
    pub text: &'a str,
    /// Lines of the file before it.
    before: usize,
}

impl<'a> Source<'a> {
    /// The XML of these bytes, and how many lines stand before it.
    pub fn find(bytes: &'a [u8]) -> Result<(Self, usize), BsdfError> {
        let text = str::from_utf8(bytes).map_err(|error| {
            let read = &bytes[..error.valid_up_to()];
            let text = str::from_utf8(read).unwrap_or_default();
            Self { text, before: 0 }.at(text.len(), XmlFault::Encoding)
        })?;
        let start = text.find("<?xml").or_else(|| text.find("<WindowElement"));
        let Some(start) = start else {
            return Err(Self { text, before: 0 }.at(0, XmlFault::NoXml));
        };
        let before = text[..start].matches('\n').count();
        let source = Self {
            text: &text[start..],
            before,
        };
        Ok((source, before))
    }

    /// A fault at a byte of the XML.
    pub fn at(&self, byte: usize, fault: XmlFault) -> BsdfError {
        let read = &self.text[..byte];
        let line = self.before + read.matches('\n').count() + 1;
        let column = read.chars().rev().take_while(|c| *c != '\n').count() + 1;
        BsdfError::Xml {
            line,
            column,
            fault,
        }
    }

    pub fn at_node(&self, node: Node, fault: XmlFault) -> BsdfError {
        self.at(node.range().start, fault)
    }

    pub fn syntax(&self, error: &roxmltree::Error) -> BsdfError {
        // The parser tells no place for a text that ends too early.
        if matches!(error, roxmltree::Error::UnexpectedEndOfStream) {
            return self.at(self.text.len(), XmlFault::Syntax(error.to_string()));
        }
        let position = error.pos();
        let message = error.to_string();
        let fault = match message.rsplit_once(" at ") {
            Some((what, _)) => what.to_owned(),
            None => message,
        };
        BsdfError::Xml {
            line: self.before + position.row as usize,
            column: position.col as usize,
            fault: XmlFault::Syntax(fault),
        }
    }

    /// The line of a byte, from 1.
    pub fn line(&self, byte: usize) -> usize {
        self.before + self.text[..byte].matches('\n').count() + 1
    }
}
