//! Tensor trees: braces around eight or sixteen braces, or around a grid of numbers.

use std::iter::Peekable;

use roxmltree::Node;
use steradian::brdf::measured::{MeasuredError, Rank, TensorTree, TreeBuilder};

use super::Reader;
use super::numbers::{Negative, Token, tokens};
use crate::import::bsdf::{BsdfError, XmlFault};

/// A tree while it is read.
struct Parser<'a, 'r, I: Iterator<Item = Token<'a>>> {
    reader: &'r Reader<'r>,
    tokens: Peekable<I>,
    builder: TreeBuilder,
    rank: Rank,
    direction: &'r str,
    negative: Negative,
    /// Where the data end.
    end: usize,
}

impl Reader<'_> {
    pub(super) fn tree(
        &mut self,
        data: Node,
        rank: Rank,
        direction: &str,
    ) -> Result<TensorTree, BsdfError> {
        let mut parser = Parser {
            reader: self,
            tokens: tokens(data).peekable(),
            builder: TreeBuilder::new(rank),
            rank,
            direction,
            negative: Negative::default(),
            end: data.last_child().unwrap_or(data).range().end,
        };
        parser.part()?;
        if let Some(token) = parser.tokens.next() {
            return Err(parser.brace("the end", Some(token)));
        }
        let warning = parser.negative.warning(self, direction);
        let tree = parser
            .builder
            .build()
            .map_err(|fault| self.table_fault(data.range().start, direction, fault))?;
        self.warnings.extend(warning);
        Ok(tree)
    }
}

impl<'a, I: Iterator<Item = Token<'a>>> Parser<'a, '_, I> {
    fn part(&mut self) -> Result<(), BsdfError> {
        let open = self.brace_of("{")?;
        if self.tokens.peek().is_some_and(|token| token.word == "{") {
            self.builder
                .branch()
                .map_err(|fault| self.at(open, fault))?;
            for _ in 0..1 << self.rank.axes() {
                self.part()?;
            }
        } else {
            let values = self.values()?;
            self.builder
                .grid(&values)
                .map_err(|fault| self.at(open, fault))?;
        }
        self.brace_of("}").map(|_| ())
    }

    fn values(&mut self) -> Result<Vec<f32>, BsdfError> {
        let mut values = vec![];
        while let Some(token) = self.tokens.next_if(|token| token.word != "}") {
            values.push(self.reader.value(token, &mut self.negative)?);
        }
        Ok(values)
    }

    fn brace_of(&mut self, expected: &'static str) -> Result<usize, BsdfError> {
        match self.tokens.next() {
            Some(token) if token.word == expected => Ok(token.byte),
            other => Err(self.brace(expected, other)),
        }
    }

    fn brace(&self, expected: &'static str, found: Option<Token>) -> BsdfError {
        let (byte, found) = match found {
            Some(token) => (token.byte, super::shortened(token.word)),
            None => (self.end, "the end".to_owned()),
        };
        let fault = XmlFault::Brace { expected, found };
        self.reader.source.at(byte, fault)
    }

    fn at(&self, byte: usize, fault: MeasuredError) -> BsdfError {
        self.reader.table_fault(byte, self.direction, fault)
    }
}
