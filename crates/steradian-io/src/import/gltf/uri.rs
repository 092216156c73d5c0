//! Where buffers and pictures are: within the file as a data URI, or in a file beside it.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use super::error::GltfError;
use crate::files::{Files, reason};

/// Reads what URIs name.
pub(super) struct Resources<'f> {
    pub directory: PathBuf,
    pub files: &'f dyn Files,
}

impl Resources<'_> {
    /// The bytes that `uri`, which stands at `place`, names.
    pub fn read(&self, uri: &str, place: impl ToString) -> Result<Vec<u8>, GltfError> {
        if let Some(data) = uri.strip_prefix("data:") {
            return data_of(data).map_err(|fault| GltfError::at(place, fault));
        }
        if uri.contains("://") {
            let fault = format!("{uri:?} is not a file beside this one");
            return Err(GltfError::at(place, fault));
        }
        let name = unescaped(uri).map_err(|fault| GltfError::at(place, fault))?;
        let path = self.directory.join(Path::new(name.as_ref()));
        self.files.read(&path).map_err(|error| GltfError::File {
            reason: reason(&error),
            path,
        })
    }
}

/// The bytes of a data URI after its scheme.
fn data_of(data: &str) -> Result<Vec<u8>, String> {
    let (kind, content) = data
        .split_once(',')
        .ok_or("a data URI holds a comma before its content")?;
    if !kind.ends_with(";base64") {
        return Err("a data URI is coded in base64".into());
    }
    base64(content.as_bytes()).ok_or_else(|| "its content is not base64".into())
}

/// RFC 4648, section 4; padding may be left out.
fn base64(text: &[u8]) -> Option<Vec<u8>> {
    let text = text.strip_suffix(b"=").unwrap_or(text);
    let text = text.strip_suffix(b"=").unwrap_or(text);
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for group in text.chunks(4) {
        let mut bits = 0_u32;
        for &letter in group {
            bits = bits << 6 | u32::from(sextet(letter)?);
        }
        bits <<= 6 * (4 - group.len());
        let count = group.len().checked_sub(1).filter(|count| *count > 0)?;
        bytes.extend(&bits.to_be_bytes()[1..=count]);
    }
    Some(bytes)
}

fn sextet(letter: u8) -> Option<u8> {
    match letter {
        b'A'..=b'Z' => Some(letter - b'A'),
        b'a'..=b'z' => Some(letter - b'a' + 26),
        b'0'..=b'9' => Some(letter - b'0' + 52),
        b'+' => Some(62),
        b'/' => Some(63),
        _ => None,
    }
}

/// RFC 3986, section 2.1: `%20` is a space.
fn unescaped(uri: &str) -> Result<Cow<'_, str>, String> {
    if !uri.contains('%') {
        return Ok(uri.into());
    }
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        rest = after;
        if first != b'%' {
            bytes.push(first);
            continue;
        }
        let digits = after.get(..2).and_then(|two| str::from_utf8(two).ok());
        let code = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        bytes.push(code.ok_or_else(|| format!("{uri:?} has a % without two digits"))?);
        rest = &after[2..];
    }
    let text = String::from_utf8(bytes).map_err(|_| format!("{uri:?} is not UTF-8"))?;
    Ok(text.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_decoded_with_and_without_padding() {
        // RFC 4648, section 10.
        for (coded, plain) in [
            ("", ""),
            ("Zg==", "f"),
            ("Zm8=", "fo"),
            ("Zm9v", "foo"),
            ("Zm9vYg", "foob"),
        ] {
            assert_eq!(base64(coded.as_bytes()), Some(plain.into()), "{coded}");
        }
        assert_eq!(base64(b"+/+/"), Some(vec![0xfb, 0xff, 0xbf]));
        for bad in ["Z", "Zm9vY", "Zm 9v", "Z==="] {
            assert_eq!(base64(bad.as_bytes()), None, "{bad}");
        }
    }

    #[test]
    fn escapes_are_undone() {
        assert_eq!(unescaped("a%20b%C3%A9.bin").unwrap(), "a bé.bin");
        for bad in ["%", "%2", "%zz", "%FF"] {
            assert!(unescaped(bad).is_err(), "{bad}");
        }
    }
}
