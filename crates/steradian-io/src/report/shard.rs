//! A part of a run in a file: what it is, what it found, and a checksum.
//!
//! | bytes | meaning |
//! |---|---|
//! | 18 | `STERADIAN SHARD 1` and a line feed |
//! | 8 | length of the header, little-endian |
//! | … | header: one JSON object in UTF-8 that says what the part belongs to |
//! | … | content in the postcard format, floats as IEEE 754, so that nothing is rounded |
//! | 32 | BLAKE3 hash of everything before it |

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::error::ReportError;

const MAGIC: &[u8] = b"STERADIAN SHARD 1\n";
const HASH_LENGTH: usize = 32;

/// A part of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Shard {
    /// What the part belongs to; the same for all parts of a run.
    pub header: serde_json::Value,
    content: Vec<u8>,
}

impl Shard {
    /// A part that holds `content`.
    ///
    /// # Errors
    /// If the content cannot be serialised.
    pub fn new(header: serde_json::Value, content: &impl Serialize) -> Result<Self, ReportError> {
        let content = postcard::to_allocvec(content)
            .map_err(|error| ReportError::Encoding(error.to_string()))?;
        Ok(Self { header, content })
    }

    /// What the part holds.
    ///
    /// # Errors
    /// If it holds something else.
    pub fn content<T: DeserializeOwned>(&self) -> Result<T, ReportError> {
        postcard::from_bytes(&self.content).map_err(|error| fault(&format!("its content: {error}")))
    }

    /// The bytes of the file.
    pub fn encode(&self) -> Vec<u8> {
        let header = self.header.to_string();
        let mut bytes = MAGIC.to_vec();
        bytes.extend((header.len() as u64).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(&self.content);
        let hash = blake3::hash(&bytes);
        bytes.extend(hash.as_bytes());
        bytes
    }

    /// Reads the bytes of a file.
    ///
    /// # Errors
    /// If it is another kind of file, or was cut short or altered.
    pub fn decode(bytes: &[u8]) -> Result<Self, ReportError> {
        let rest = checked(bytes)?;
        let (length, rest) = rest.split_first_chunk::<8>().ok_or_else(altered)?;
        let length = usize::try_from(u64::from_le_bytes(*length)).map_err(|_| altered())?;
        let (header, content) = rest.split_at_checked(length).ok_or_else(altered)?;
        let header = serde_json::from_slice(header)
            .map_err(|error| fault(&format!("its header: {error}")))?;
        Ok(Self {
            header,
            content: content.to_vec(),
        })
    }
}

/// What lies between the magic and the hash, if the hash is right.
fn checked(bytes: &[u8]) -> Result<&[u8], ReportError> {
    if !bytes.starts_with(MAGIC) {
        return Err(fault("it does not begin as a shard of this version does"));
    }
    let end = bytes
        .len()
        .checked_sub(HASH_LENGTH)
        .filter(|end| *end >= MAGIC.len())
        .ok_or_else(altered)?;
    let (content, hash) = bytes.split_at(end);
    if blake3::hash(content).as_bytes() != hash {
        return Err(altered());
    }
    Ok(&content[MAGIC.len()..])
}

fn altered() -> ReportError {
    fault("its checksum does not match; it was cut short or altered")
}

fn fault(message: &str) -> ReportError {
    ReportError::Shard(message.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn shard() -> Shard {
        Shard::new(
            serde_json::json!({"seed": 1}),
            &vec![1.5, -0.0, f64::MIN_POSITIVE, f64::INFINITY],
        )
        .unwrap()
    }

    fn message(bytes: &[u8]) -> String {
        Shard::decode(bytes).unwrap_err().to_string()
    }

    #[test]
    fn another_kind_of_file_is_told() {
        assert!(message(b"PNG").contains("does not begin"));
        assert!(message(b"").contains("does not begin"));
    }

    #[test]
    fn every_truncation_is_told() {
        let bytes = shard().encode();
        for length in MAGIC.len()..bytes.len() {
            assert!(message(&bytes[..length]).contains("cut short"), "{length}");
        }
    }

    #[test]
    fn every_altered_byte_is_told() {
        let bytes = shard().encode();
        for at in 0..bytes.len() {
            let mut altered = bytes.clone();
            altered[at] ^= 1;
            assert!(Shard::decode(&altered).is_err(), "byte {at}");
        }
    }

    #[test]
    fn other_content_is_told() {
        assert!(
            shard()
                .content::<bool>()
                .unwrap_err()
                .to_string()
                .contains("its content")
        );
    }

    proptest! {
        #[test]
        fn every_float_reads_back_bit_for_bit(floats: Vec<f64>, name: String) {
            let shard = Shard::new(serde_json::json!({ "name": name }), &floats).unwrap();
            let read = Shard::decode(&shard.encode()).unwrap();
            prop_assert_eq!(&read, &shard);
            let bits = |floats: &[f64]| floats.iter().map(|float| float.to_bits()).collect::<Vec<_>>();
            prop_assert_eq!(bits(&read.content::<Vec<f64>>().unwrap()), bits(&floats));
        }
    }
}
