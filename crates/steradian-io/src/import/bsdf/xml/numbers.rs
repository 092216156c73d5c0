//! Numbers of `ScatteringData`, each with its place.

use roxmltree::Node;

use super::Reader;
use crate::import::bsdf::{BsdfError, XmlFault};

/// A word, or a brace of a tensor tree.
#[derive(Copy, Clone, Debug, PartialEq)]
pub(super) struct Token<'a> {
    pub word: &'a str,
    /// Where it begins in the XML.
    pub byte: usize,
}

/// The words of an element's texts. Entities are not resolved: no number has one.
pub(super) fn tokens<'a>(node: Node<'a, 'a>) -> impl Iterator<Item = Token<'a>> {
    let document = node.document();
    let texts = node.children().filter(Node::is_text);
    texts.flat_map(move |text| {
        let range = text.range();
        words(&document.input_text()[range.clone()], range.start)
    })
}

fn words(text: &str, start: usize) -> impl Iterator<Item = Token<'_>> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let separates = |c: char| c.is_whitespace() || c == ',';
        at += text[at..].find(|c| !separates(c))?;
        let rest = &text[at..];
        let brace = rest.starts_with(['{', '}']);
        let length = match brace {
            true => 1,
            false => rest
                .find(|c| separates(c) || c == '{' || c == '}')
                .unwrap_or(rest.len()),
        };
        let byte = start + at;
        at += length;
        Some(Token {
            word: &rest[..length],
            byte,
        })
    })
}

/// Values below 0 that were taken as 0.
#[derive(Copy, Clone, Debug, Default)]
pub(super) struct Negative {
    count: usize,
    /// The first one and where it stands.
    first: Option<(f64, usize)>,
}

impl Negative {
    pub fn warning(&self, reader: &Reader, direction: &str) -> Option<String> {
        let (value, byte) = self.first?;
        let line = reader.source.line(byte);
        let count = self.count;
        Some(format!(
            "{direction}: {value} 1/sr in line {line} is negative; values taken as 0: {count}"
        ))
    }
}

impl Reader<'_> {
    /// A value in 1/sr; negative ones become 0.
    pub fn value(&self, token: Token, negative: &mut Negative) -> Result<f32, BsdfError> {
        let no_number = || {
            let fault = XmlFault::NoNumber(super::shortened(token.word));
            self.source.at(token.byte, fault)
        };
        let value: f64 = token.word.parse().map_err(|_| no_number())?;
        if !(value as f32).is_finite() {
            return Err(no_number());
        }
        if value < 0.0 {
            negative.count += 1;
            negative.first.get_or_insert((value, token.byte));
        }
        Ok(value.max(0.0) as f32)
    }
}
