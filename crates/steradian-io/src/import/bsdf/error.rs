//! What is wrong with a file of a measured surface.

use steradian::brdf::measured::MeasuredError;
use thiserror::Error;

/// What is wrong with a file of a measured surface.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BsdfError {
    /// An extension that no reader knows.
    #[error("expected a file of a measured surface (.xml, .binary or .bsdf), found {0:?}")]
    Format(String),
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// In an XML file.
    #[error("line {line}, column {column}: {fault}")]
    Xml {
        /// The line, from 1.
        line: usize,
        /// The column, from 1.
        column: usize,
        /// What is wrong there.
        fault: XmlFault,
    },
    /// In a binary file.
    #[error("byte {byte}: {fault}")]
    Binary {
        /// The byte, from 0.
        byte: usize,
        /// What is wrong there.
        fault: BinaryFault,
    },
}

/// What is wrong at a place of a binary file.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BinaryFault {
    /// A file that is too short or too long.
    #[error("the file needs {needed} bytes, but has {found}")]
    Length {
        /// How many it should have.
        needed: usize,
        /// How many it has.
        found: usize,
    },
    /// A number of cells that the format does not have.
    #[error("expected {expected} cells, found {found}")]
    Dimension {
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A number that is infinite or NaN, in single precision.
    #[error("{0} is no finite number")]
    NotFinite(String),
    /// Not a tensor file.
    #[error("not a tensor file: it does not begin with \"tensor_file\"")]
    NoTensors,
    /// More fields or dimensions than any file has.
    #[error("{count} fields or dimensions, {most} at most")]
    Many {
        /// How many the file says.
        count: usize,
        /// How many there may be.
        most: usize,
    },
    /// A field is missing.
    #[error("the file has no field {0}")]
    NoField(&'static str),
    /// A field of other numbers than is usual.
    #[error("field {name} has numbers of type {found}")]
    Type {
        /// The field.
        name: String,
        /// The code of the type.
        found: u8,
    },
    /// A field of other dimensions than its nodes have.
    #[error("field {name} has the dimensions {shape:?}, which do not fit the nodes of incidence")]
    Shape {
        /// The field.
        name: String,
        /// Its dimensions.
        shape: Vec<usize>,
    },
    /// Numbers of a field that make no table.
    #[error("field {name}: {fault}")]
    Field {
        /// The field.
        name: &'static str,
        /// What is wrong.
        fault: MeasuredError,
    },
    /// Values that make no table.
    #[error("{0}")]
    Table(MeasuredError),
}

impl BinaryFault {
    pub(super) fn at(self, byte: usize) -> BsdfError {
        BsdfError::Binary { byte, fault: self }
    }
}

/// What is wrong at a place of an XML file.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum XmlFault {
    /// Bytes that are no text.
    #[error("the file is not UTF-8 from here on")]
    Encoding,
    /// No XML at all.
    #[error("no XML here: neither <?xml nor <WindowElement")]
    NoXml,
    /// Broken XML.
    #[error("{0}")]
    Syntax(String),
    /// Another kind of file.
    #[error("expected {expected}, found {found:?}")]
    Unexpected {
        /// What would be right.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// Something is missing.
    #[error("<{parent}> has no <{child}>")]
    Missing {
        /// Where it should be.
        parent: String,
        /// What it is.
        child: &'static str,
    },
    /// A basis that the file does not define.
    #[error("the angle basis {0:?} is neither defined in the file nor one of Klems's")]
    UnknownBasis(String),
    /// A word that is no number, or no finite one.
    #[error("expected a number, found {0:?}")]
    NoNumber(String),
    /// Braces of a tensor tree that do not match.
    #[error("expected {expected} in the tensor tree, found {found}")]
    Brace {
        /// What would be right.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// Values that make no table.
    #[error("{direction}: {fault}")]
    Table {
        /// The block's direction.
        direction: String,
        /// What is wrong.
        fault: MeasuredError,
    },
}
