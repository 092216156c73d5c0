//! The header of a PLY file: which elements follow, and what each of them holds.

use super::PlyError;

/// Bytes of the longest header that is read.
const LONGEST: usize = 1 << 16;

/// How the numbers of the body are written.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// One number, or a list that begins with its length.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(super) enum Form {
    One(Scalar),
    List { count: Scalar, item: Scalar },
}

#[derive(Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub name: String,
    pub form: Form,
}

#[derive(Debug, PartialEq, Eq)]
pub(super) struct Element {
    pub name: String,
    pub count: usize,
    pub properties: Vec<Property>,
}

#[derive(Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Bytes before the body.
    pub length: usize,
    /// Lines before the body.
    pub lines: usize,
}

impl Scalar {
    fn parse(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes of one in a binary file.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

impl Element {
    /// How many take room in the file: none, if they have no properties, and so are no bound of anything.
    pub fn items(&self) -> usize {
        if self.properties.is_empty() {
            0
        } else {
            self.count
        }
    }

    /// The fewest bytes that one of these takes.
    fn least_size(&self, encoding: Encoding) -> usize {
        let least = |property: &Property| match (encoding, property.form) {
            // A digit and what divides it from the next.
            (Encoding::Ascii, _) => 2,
            (_, Form::One(scalar) | Form::List { count: scalar, .. }) => scalar.size(),
        };
        self.properties.iter().map(least).sum()
    }
}

impl Header {
    /// Reads the header, and holds its counts against the size of the file.
    pub fn read(bytes: &[u8]) -> Result<Self, PlyError> {
        let mut lines = Lines {
            bytes,
            length: 0,
            number: 0,
        };
        if lines.next()?.is_none_or(|line| line != "ply") {
            return Err(PlyError::Magic);
        }
        let (mut encoding, mut elements) = (None, Vec::new());
        while let Some(line) = lines.next()? {
            let wrong = |expected| lines.wrong(&line, expected);
            match line.split_whitespace().collect::<Vec<_>>()[..] {
                ["end_header"] => {
                    let encoding = encoding.ok_or_else(|| wrong("a format before end_header"))?;
                    let header = Self {
                        encoding,
                        elements,
                        length: lines.length,
                        lines: lines.number,
                    };
                    return header.checked(bytes.len());
                }
                [] | ["comment" | "obj_info", ..] => (),
                ["format", name, "1.0"] => {
                    encoding = Some(format(name).ok_or_else(|| wrong(FORMATS))?)
                }
                ["format", ..] => return Err(wrong(FORMATS)),
                ["element", name, count] => elements.push(Element {
                    name: name.to_owned(),
                    count: count.parse().map_err(|_| wrong("a number of elements"))?,
                    properties: vec![],
                }),
                ["property", ..] => {
                    let property = property(&line).ok_or_else(|| wrong(PROPERTY))?;
                    let element = elements
                        .last_mut()
                        .ok_or_else(|| wrong("an element before its properties"))?;
                    element.properties.push(property);
                }
                _ => return Err(wrong("format, element, property, comment or end_header")),
            }
        }
        Err(PlyError::Unending)
    }

    fn checked(self, size: usize) -> Result<Self, PlyError> {
        let mut left = (size - self.length) as u64;
        for element in &self.elements {
            let least = element.least_size(self.encoding) as u64;
            let needed = least.saturating_mul(element.count as u64);
            // The last number of a text file needs nothing after it.
            let spare = u64::from(self.encoding == Encoding::Ascii);
            if needed > left + spare {
                return Err(PlyError::Count {
                    element: element.name.clone(),
                    count: element.count,
                    needed,
                    left,
                });
            }
            left = left.saturating_sub(needed);
        }
        Ok(self)
    }
}

const FORMATS: &str = "format ascii, binary_little_endian or binary_big_endian 1.0";
const PROPERTY: &str = "property TYPE NAME or property list TYPE TYPE NAME, each type one of char, uchar, short, ushort, int, uint, float, double";

fn format(name: &str) -> Option<Encoding> {
    Some(match name {
        "ascii" => Encoding::Ascii,
        "binary_little_endian" => Encoding::LittleEndian,
        "binary_big_endian" => Encoding::BigEndian,
        _ => return None,
    })
}

fn property(line: &str) -> Option<Property> {
    let (form, name) = match line.split_whitespace().collect::<Vec<_>>()[..] {
        [_, "list", count, item, name] => {
            let count =
                Scalar::parse(count).filter(|count| !matches!(count, Scalar::F32 | Scalar::F64))?;
            (
                Form::List {
                    count,
                    item: Scalar::parse(item)?,
                },
                name,
            )
        }
        [_, scalar, name] => (Form::One(Scalar::parse(scalar)?), name),
        _ => return None,
    };
    Some(Property {
        name: name.to_owned(),
        form,
    })
}

/// The lines of the header, one after another.
struct Lines<'a> {
    bytes: &'a [u8],
    /// Bytes read so far.
    length: usize,
    /// Lines read so far.
    number: usize,
}

impl Lines<'_> {
    /// The next line without its end; `None` at the end of the file.
    fn next(&mut self) -> Result<Option<String>, PlyError> {
        let rest = &self.bytes[self.length..];
        let Some(end) = rest.iter().take(LONGEST).position(|byte| *byte == b'\n') else {
            return Ok(None);
        };
        self.length += end + 1;
        self.number += 1;
        if self.length > LONGEST {
            return Err(PlyError::Unending);
        }
        Ok(Some(
            String::from_utf8_lossy(&rest[..end]).trim().to_owned(),
        ))
    }

    fn wrong(&self, line: &str, expected: &'static str) -> PlyError {
        PlyError::Header {
            line: self.number,
            expected,
            found: line.chars().take(60).collect(),
        }
    }
}
