//! NumPy's `.npz`: a ZIP archive, not compressed, of `.npy` arrays.
//!
//! Sources: the NumPy enhancement proposal 1 (format of `.npy`, version 1.0); PKWARE's APPNOTE 6.3 (ZIP: local headers, central
//! directory, method 0). Dates are the first that ZIP knows, 1 January 1980, so that the same arrays give the same bytes.

use super::ReportError;

/// An array by name.
#[derive(Clone, Debug, PartialEq)]
pub enum Array {
    /// 64-bit floating point, one dimension.
    Floats(Vec<f64>),
    /// 64-bit signed integers, one dimension.
    Integers(Vec<i64>),
    /// Texts of Unicode, one dimension.
    Texts(Vec<String>),
    /// One text of ASCII, without dimension, as `scipy.sparse` names its formats.
    Ascii(String),
}

impl Array {
    /// The bytes of the `.npy` file.
    fn to_npy(&self) -> Vec<u8> {
        let (kind, shape, data) = self.parts();
        let shape = shape.map_or_else(|| "()".to_owned(), |length| format!("({length},)"));
        let mut header =
            format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
        // Magic, version and length take 10 bytes; data start at a multiple of 64.
        let padding = 63 - (10 + header.len()) % 64;
        header.push_str(&" ".repeat(padding));
        header.push('\n');
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(data);
        bytes
    }

    /// Type, length and data.
    fn parts(&self) -> (String, Option<usize>, Vec<u8>) {
        match self {
            Self::Floats(numbers) => {
                let data = numbers.iter().flat_map(|number| number.to_le_bytes());
                ("<f8".to_owned(), Some(numbers.len()), data.collect())
            }
            Self::Integers(numbers) => {
                let data = numbers.iter().flat_map(|number| number.to_le_bytes());
                ("<i8".to_owned(), Some(numbers.len()), data.collect())
            }
            Self::Texts(texts) => {
                let longest = texts.iter().map(|text| text.chars().count()).max();
                let longest = longest.unwrap_or(0).max(1);
                let data = texts.iter().flat_map(|text| {
                    let padding = std::iter::repeat('\0');
                    text.chars().chain(padding).take(longest).map(u32::from)
                });
                let data = data.flat_map(u32::to_le_bytes).collect();
                (format!("<U{longest}"), Some(texts.len()), data)
            }
            Self::Ascii(text) => (format!("|S{}", text.len()), None, text.as_bytes().to_vec()),
        }
    }
}

/// The archive of these arrays.
///
/// # Errors
/// If it is larger than the 4 GiB that ZIP holds without extensions.
pub fn encode(arrays: &[(&str, Array)]) -> Result<Vec<u8>, ReportError> {
    let (mut archive, mut directory) = (Vec::new(), Vec::new());
    for (name, array) in arrays {
        let (name, data) = (format!("{name}.npy"), array.to_npy());
        let (length, offset) = (offset(data.len())?, offset(archive.len())?);
        let description = description(&name, checksum(&data), length);
        archive.extend(b"PK\x03\x04");
        archive.extend(&description);
        archive.extend(name.as_bytes());
        archive.extend(&data);
        directory.extend(b"PK\x01\x02\x14\x00");
        directory.extend(&description);
        // No comment, first disk, no attributes.
        directory.extend([0; 10]);
        directory.extend(offset.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let start = offset(archive.len())?;
    let count = (arrays.len() as u16).to_le_bytes();
    let length = offset(directory.len())?;
    archive.extend(directory);
    archive.extend(b"PK\x05\x06\0\0\0\0");
    archive.extend([count, count].concat());
    archive.extend([length.to_le_bytes(), start.to_le_bytes()].concat());
    archive.extend([0; 2]);
    Ok(archive)
}

fn offset(bytes: usize) -> Result<u32, ReportError> {
    let message = "an npz file holds at most 4 GiB; write csv instead";
    u32::try_from(bytes).map_err(|_| ReportError::Encoding(message.to_owned()))
}

/// What the header of a file and its entry in the directory share: version 2.0, no flags, stored, date, checksum, lengths.
fn description(name: &str, checksum: u32, length: u32) -> Vec<u8> {
    let mut bytes = vec![20, 0, 0, 0, 0, 0, 0, 0, 0x21, 0];
    for number in [checksum, length, length] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend((name.len() as u16).to_le_bytes());
    bytes.extend([0; 2]);
    bytes
}

/// CRC-32 of ISO 3309, bit by bit over a table of bytes.
fn checksum(data: &[u8]) -> u32 {
    let table: Vec<u32> = (0..256)
        .map(|byte| {
            (0..8).fold(byte, |crc: u32, _| {
                (crc >> 1) ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 }
            })
        })
        .collect();
    !data.iter().fold(u32::MAX, |crc, &byte| {
        table[((crc ^ u32::from(byte)) & 255) as usize] ^ (crc >> 8)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_of_the_standard() {
        assert_eq!(checksum(b"123456789"), 0xcbf4_3926);
        assert_eq!(checksum(b""), 0);
    }

    #[test]
    fn headers_say_type_and_shape_and_end_at_64_bytes() {
        let header = |array: Array| {
            let bytes = array.to_npy();
            let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
            assert_eq!((10 + length) % 64, 0);
            assert_eq!(bytes[9 + length], b'\n');
            let data = bytes[10 + length..].to_vec();
            (
                String::from_utf8_lossy(&bytes[10..10 + length])
                    .trim_end()
                    .to_owned(),
                data,
            )
        };
        let (floats, data) = header(Array::Floats(vec![1.0, -2.5]));
        assert_eq!(
            floats,
            "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }"
        );
        assert_eq!(
            data,
            [1.0_f64.to_le_bytes(), (-2.5_f64).to_le_bytes()].concat()
        );
        let (texts, data) = header(Array::Texts(vec!["a".into(), "bø".into()]));
        assert!(texts.contains("'<U2'") && data.len() == 16 && data[12] == 0xf8);
        let (ascii, data) = header(Array::Ascii("csr".into()));
        assert!(ascii.contains("'|S3'") && ascii.contains("'shape': ()") && data == b"csr");
    }

    #[test]
    fn the_directory_leads_to_every_file() {
        let arrays = [
            ("data", Array::Floats(vec![0.25])),
            ("indices", Array::Integers(vec![7])),
        ];
        let bytes = encode(&arrays).unwrap();
        let end = bytes.len() - 22;
        let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!(&bytes[end..end + 4], b"PK\x05\x06");
        let mut at = number(end + 16);
        assert_eq!(at + number(end + 12), end);
        for (name, array) in &arrays {
            let header = number(at + 42);
            let name = format!("{name}.npy");
            assert_eq!(&bytes[at + 46..at + 46 + name.len()], name.as_bytes());
            let data = header + 30 + name.len();
            assert_eq!(&bytes[data..data + number(at + 24)], array.to_npy());
            assert_eq!(number(at + 16) as u32, checksum(&array.to_npy()));
            assert_eq!(&bytes[header + 4..header + 30], &bytes[at + 6..at + 32]);
            at += 46 + name.len();
        }
    }
}
