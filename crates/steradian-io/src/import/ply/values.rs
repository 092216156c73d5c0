//! The numbers of the body of a PLY file, one after another.

use super::header::{Encoding, Header, Scalar};

/// Why there is no next number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Missing {
    End,
    NoNumber(String),
}

/// What is left of the body.
pub(super) enum Values<'a> {
    Ascii(&'a [u8]),
    Little(&'a [u8]),
    Big(&'a [u8]),
}

impl<'a> Values<'a> {
    pub fn new(header: &Header, bytes: &'a [u8]) -> Self {
        let body = &bytes[header.length..];
        match header.encoding {
            Encoding::Ascii => Self::Ascii(body),
            Encoding::LittleEndian => Self::Little(body),
            Encoding::BigEndian => Self::Big(body),
        }
    }

    /// The next number, of this type. Exact, for all types fit into an `f64`.
    pub fn next(&mut self, scalar: Scalar) -> Result<f64, Missing> {
        match self {
            Self::Ascii(rest) => word(rest),
            Self::Little(rest) => take(rest, scalar.size()).map(|bytes| little(scalar, &bytes)),
            Self::Big(rest) => take(rest, scalar.size()).map(|mut bytes| {
                bytes[..scalar.size()].reverse();
                little(scalar, &bytes)
            }),
        }
    }
}

/// The first `count` bytes, of 8 at most.
fn take(rest: &mut &[u8], count: usize) -> Result<[u8; 8], Missing> {
    let (first, others) = rest.split_at_checked(count).ok_or(Missing::End)?;
    *rest = others;
    let mut bytes = [0; 8];
    bytes[..count].copy_from_slice(first);
    Ok(bytes)
}

fn little(scalar: Scalar, bytes: &[u8; 8]) -> f64 {
    let [a, b, c, d, ..] = *bytes;
    match scalar {
        Scalar::I8 => f64::from(a as i8),
        Scalar::U8 => f64::from(a),
        Scalar::I16 => f64::from(i16::from_le_bytes([a, b])),
        Scalar::U16 => f64::from(u16::from_le_bytes([a, b])),
        Scalar::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
        Scalar::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
        Scalar::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
        Scalar::F64 => f64::from_le_bytes(*bytes),
    }
}

fn word(rest: &mut &[u8]) -> Result<f64, Missing> {
    let text = rest.trim_ascii_start();
    let end = text
        .iter()
        .position(u8::is_ascii_whitespace)
        .unwrap_or(text.len());
    let (word, others) = text.split_at(end);
    *rest = others;
    if word.is_empty() {
        return Err(Missing::End);
    }
    let number = str::from_utf8(word).ok().and_then(|word| word.parse().ok());
    number.ok_or_else(|| {
        Missing::NoNumber(String::from_utf8_lossy(&word[..word.len().min(40)]).into_owned())
    })
}
