//! A part of a run in a file: a JSON header, an array of 64-bit floats, and a checksum.
//!
//! | bytes | meaning |
//! |---|---|
//! | 18 | `STERADIAN SHARD 1` and a line feed |
//! | 8 | length of the header, little-endian |
//! | … | header: one JSON object in UTF-8 |
//! | 8 | number of floats, little-endian |
//! | 8 each | the floats, IEEE 754 binary64, little-endian |
//! | 32 | BLAKE3 hash of everything before it |

use super::error::ReportError;

const MAGIC: &[u8] = b"STERADIAN SHARD 1\n";
const HASH_LENGTH: usize = 32;

/// What a shard file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Shard {
    /// What the run was and what it found, except large arrays.
    pub header: serde_json::Value,
    /// The large array, e.g. the sums of a picture.
    pub payload: Vec<f64>,
}

impl Shard {
    /// The bytes of the file.
    pub fn encode(&self) -> Vec<u8> {
        let header = self.header.to_string();
        let mut bytes = MAGIC.to_vec();
        bytes.extend((header.len() as u64).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend((self.payload.len() as u64).to_le_bytes());
        bytes.extend(self.payload.iter().flat_map(|value| value.to_le_bytes()));
        let hash = blake3::hash(&bytes);
        bytes.extend(hash.as_bytes());
        bytes
    }

    /// Reads the bytes of a file; an error tells whether it is another kind of file, cut short or altered.
    pub fn decode(bytes: &[u8]) -> Result<Self, ReportError> {
        let content = checked_content(bytes)?;
        let mut rest = content;
        let header_length = take_length(&mut rest)?;
        let header = take(&mut rest, header_length)?;
        let count = take_length(&mut rest)?;
        let floats = take(&mut rest, count.checked_mul(8).ok_or_else(truncated)?)?;
        if !rest.is_empty() {
            return Err(altered());
        }
        let header = serde_json::from_slice(header)
            .map_err(|error| fault(&format!("its header: {error}")))?;
        let (floats, _) = floats.as_chunks::<8>();
        Ok(Self {
            header,
            payload: floats
                .iter()
                .map(|eight| f64::from_le_bytes(*eight))
                .collect(),
        })
    }
}

/// What lies between the magic and the hash, if the hash is right.
fn checked_content(bytes: &[u8]) -> Result<&[u8], ReportError> {
    if !bytes.starts_with(MAGIC) {
        return Err(fault("it does not begin as a shard of this version does"));
    }
    let end = bytes
        .len()
        .checked_sub(HASH_LENGTH)
        .filter(|end| *end >= MAGIC.len())
        .ok_or_else(truncated)?;
    let (content, hash) = bytes.split_at(end);
    if blake3::hash(content).as_bytes() != hash {
        return Err(altered());
    }
    Ok(&content[MAGIC.len()..])
}

fn take_length(rest: &mut &[u8]) -> Result<usize, ReportError> {
    let eight = take(rest, 8)?.try_into().map_err(|_| truncated())?;
    usize::try_from(u64::from_le_bytes(eight)).map_err(|_| truncated())
}

fn take<'a>(rest: &mut &'a [u8], length: usize) -> Result<&'a [u8], ReportError> {
    let (taken, after) = rest.split_at_checked(length).ok_or_else(truncated)?;
    *rest = after;
    Ok(taken)
}

fn truncated() -> ReportError {
    fault("it ends too early")
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
        Shard {
            header: serde_json::json!({"seed": 1, "x": 0.1}),
            payload: vec![1.5, -0.0, f64::MIN_POSITIVE, 1e300],
        }
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
            let message = message(&bytes[..length]);
            assert!(
                message.contains("early") || message.contains("cut short"),
                "{length}: {message}"
            );
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

    proptest! {
        #[test]
        fn every_float_reads_back_bit_for_bit(payload: Vec<f64>, name: String) {
            let shard = Shard { header: serde_json::json!({ "name": name }), payload };
            let read = Shard::decode(&shard.encode()).unwrap();
            prop_assert_eq!(&read.header, &shard.header);
            let bits = |shard: &Shard| shard.payload.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
            prop_assert_eq!(bits(&read), bits(&shard));
        }
    }
}
