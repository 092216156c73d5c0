//! The container: named arrays of numbers.
//!
//! `tensor_file`, a zero byte, the version 1, 0, the number of fields as 32 bits; for each field the length of its name in 16 bits, the name, the
//! number of dimensions in 16 bits, the type in 8, the place of its data in 64, and the dimensions in 64 bits each; little-endian.

use crate::import::bsdf::BsdfError;
use crate::import::bsdf::error::BinaryFault;

/// Fields of a file, and dimensions of a field, at most.
const MOST: usize = 64;
const MAGIC: &[u8] = b"tensor_file\0";

/// A field of a file.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub name: String,
    pub shape: Vec<usize>,
    kind: u8,
    /// Where its data begin.
    pub byte: usize,
}

/// A file and its fields.
pub(super) struct Tensors<'a> {
    bytes: &'a [u8],
    pub fields: Vec<Field>,
}

/// Types of numbers: their code, and the bytes of one.
const UINT8: (u8, usize) = (1, 1);
const FLOAT32: (u8, usize) = (10, 4);

struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], BsdfError> {
        let (needed, found) = (self.at.saturating_add(count), self.bytes.len());
        let taken = self.bytes.get(self.at..needed);
        let taken = taken.ok_or(BinaryFault::Length { needed, found }.at(self.at))?;
        self.at = needed;
        Ok(taken)
    }

    fn number(&mut self, bytes: usize) -> Result<usize, BsdfError> {
        let taken = self.take(bytes)?.iter().rev();
        let number = taken.fold(0_u64, |sum, byte| sum << 8 | u64::from(*byte));
        Ok(usize::try_from(number).unwrap_or(usize::MAX))
    }
}

impl<'a> Tensors<'a> {
    pub fn read(bytes: &'a [u8]) -> Result<Self, BsdfError> {
        let mut cursor = Cursor { bytes, at: 0 };
        if !bytes.starts_with(MAGIC) {
            return Err(BinaryFault::NoTensors.at(0));
        }
        cursor.take(MAGIC.len() + 2)?;
        let count = cursor.number(4)?;
        if count > MOST {
            return Err(BinaryFault::Many { count, most: MOST }.at(MAGIC.len() + 2));
        }
        let fields = (0..count)
            .map(|_| field(&mut cursor))
            .collect::<Result<_, _>>()?;
        Ok(Self { bytes, fields })
    }

    pub fn find(&self, name: &'static str) -> Option<&Field> {
        self.fields.iter().find(|field| field.name == name)
    }

    pub fn need(&self, name: &'static str) -> Result<&Field, BsdfError> {
        let missing = || BinaryFault::NoField(name).at(self.bytes.len());
        self.find(name).ok_or_else(missing)
    }

    /// The bytes of a field of bytes.
    pub fn octets(&self, field: &Field) -> Result<&'a [u8], BsdfError> {
        self.data(field, UINT8)
    }

    /// The finite numbers of a field of 32-bit numbers.
    pub fn floats(&self, field: &Field) -> Result<Vec<f32>, BsdfError> {
        let data = self.data(field, FLOAT32)?;
        let number = |(k, four): (usize, &[u8])| {
            let value = f32::from_le_bytes(four.try_into().unwrap_or_default());
            match value.is_finite() {
                true => Ok(value),
                false => Err(BinaryFault::NotFinite(value.to_string()).at(field.byte + 4 * k)),
            }
        };
        data.chunks_exact(4).enumerate().map(number).collect()
    }

    fn data(&self, field: &Field, (kind, size): (u8, usize)) -> Result<&'a [u8], BsdfError> {
        if field.kind != kind {
            let (name, found) = (field.name.clone(), field.kind);
            return Err(BinaryFault::Type { name, found }.at(field.byte));
        }
        let count = field
            .shape
            .iter()
            .try_fold(size, |product, n| product.checked_mul(*n));
        let end = count
            .and_then(|bytes| field.byte.checked_add(bytes))
            .unwrap_or(usize::MAX);
        let found = self.bytes.len();
        let data = self.bytes.get(field.byte..end);
        data.ok_or(BinaryFault::Length { needed: end, found }.at(field.byte.min(found)))
    }
}

fn field(cursor: &mut Cursor) -> Result<Field, BsdfError> {
    let length = cursor.number(2)?;
    let name = String::from_utf8_lossy(cursor.take(length)?).into_owned();
    let at = cursor.at;
    let dimensions = cursor.number(2)?;
    if dimensions > MOST {
        let (count, most) = (dimensions, MOST);
        return Err(BinaryFault::Many { count, most }.at(at));
    }
    let (kind, byte) = (cursor.number(1)? as u8, cursor.number(8)?);
    let shape = (0..dimensions)
        .map(|_| cursor.number(8))
        .collect::<Result<_, _>>()?;
    Ok(Field {
        name,
        shape,
        kind,
        byte,
    })
}
