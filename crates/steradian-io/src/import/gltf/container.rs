//! The two ways in which glTF is stored: JSON text, or GLB, a container of JSON and one binary buffer.

use super::error::GltfError;

/// What a glTF file holds.
pub(super) struct Container<'a> {
    pub json: &'a [u8],
    /// The first buffer, where the file is a GLB that has one.
    pub binary: Option<&'a [u8]>,
}

const MAGIC: &[u8] = b"glTF";
const JSON: &[u8; 4] = b"JSON";
const BINARY: &[u8; 4] = b"BIN\0";

/// Takes a file apart.
pub(super) fn open(bytes: &[u8]) -> Result<Container<'_>, GltfError> {
    let Some(rest) = bytes.strip_prefix(MAGIC) else {
        let (json, binary) = (bytes, None);
        return Ok(Container { json, binary });
    };
    let (version, rest) = word(rest).ok_or_else(cut_short)?;
    if version != 2 {
        return Err(GltfError::Version(version.to_string()));
    }
    let (length, _) = word(rest).ok_or_else(cut_short)?;
    let whole = bytes.get(..length as usize).ok_or_else(cut_short)?;
    chunks(whole.get(12..).ok_or_else(cut_short)?)
}

/// JSON first, then perhaps the buffer; later chunks are for others.
fn chunks(rest: &[u8]) -> Result<Container<'_>, GltfError> {
    let ((kind, json), rest) = chunk(rest)?;
    if kind != JSON {
        return Err(GltfError::Container("its first chunk is not JSON".into()));
    }
    if rest.is_empty() {
        return Ok(Container { json, binary: None });
    }
    let ((kind, binary), _) = chunk(rest)?;
    let binary = (kind == BINARY).then_some(binary);
    Ok(Container { json, binary })
}

/// Kind and content.
type Chunk<'a> = (&'a [u8; 4], &'a [u8]);

/// The first chunk, and what follows.
fn chunk(rest: &[u8]) -> Result<(Chunk<'_>, &[u8]), GltfError> {
    let (length, rest) = word(rest).ok_or_else(cut_short)?;
    let (kind, rest) = rest.split_first_chunk::<4>().ok_or_else(cut_short)?;
    let (content, rest) = rest
        .split_at_checked(length as usize)
        .ok_or_else(cut_short)?;
    Ok(((kind, content), rest))
}

fn word(bytes: &[u8]) -> Option<(u32, &[u8])> {
    let (word, rest) = bytes.split_first_chunk::<4>()?;
    Some((u32::from_le_bytes(*word), rest))
}

fn cut_short() -> GltfError {
    GltfError::Container("the GLB container is shorter than its header says".into())
}
