//! A glTF file with its buffers, and checked access to its parts.
//!
//! Parts may be named any number of times, so that a small file could ask for endless work. All elements that are read
//! are counted, therefore, and may be 2²⁰ and four for each byte of the buffers.

use std::borrow::Cow;
use std::cell::Cell;
use std::fmt::Display;

use super::container::Container;
use super::error::GltfError;
use super::schema::Root;
use super::uri::Resources;

/// The JSON of a file and the bytes it is about.
pub(super) struct Document<'a> {
    pub root: Root,
    buffers: Vec<Cow<'a, [u8]>>,
    /// Elements read so far.
    elements: Cell<usize>,
}

/// Elements that any file may have.
const FREE_ELEMENTS: usize = 1 << 20;

/// Elements that each byte may be read as.
const ELEMENTS_A_BYTE: usize = 4;

impl<'a> Document<'a> {
    /// Reads the JSON and all buffers.
    pub fn new(container: &Container<'a>, resources: &Resources<'_>) -> Result<Self, GltfError> {
        let root: Root = serde_json::from_slice(container.json)
            .map_err(|error| GltfError::Json(error.to_string()))?;
        if !root.asset.version.starts_with("2.") {
            return Err(GltfError::Version(root.asset.version));
        }
        let buffers = (0..root.buffers.len())
            .map(|index| buffer(&root, index, container, resources))
            .collect::<Result<_, _>>()?;
        let elements = Cell::new(0);
        Ok(Self {
            root,
            buffers,
            elements,
        })
    }

    /// Counts elements that will be read, and refuses too many.
    pub fn count(&self, elements: usize) -> Result<(), GltfError> {
        let bytes: usize = self.buffers.iter().map(|buffer| buffer.len()).sum();
        let limit = FREE_ELEMENTS + bytes.saturating_mul(ELEMENTS_A_BYTE);
        let count = self.elements.get().saturating_add(elements);
        self.elements.set(count);
        let what = "elements in a file of this size";
        (count <= limit)
            .then_some(())
            .ok_or(GltfError::TooLarge { what, limit })
    }

    /// The bytes of a buffer view that `place` names.
    pub fn view(&self, index: usize, place: impl Display) -> Result<&[u8], GltfError> {
        let view = part(&self.root.buffer_views, index, "buffer view", &place)?;
        let place = format!("bufferViews[{index}]");
        let buffer = part(&self.buffers, view.buffer, "buffer", &place)?;
        let end = view.byte_offset.checked_add(view.byte_length);
        end.and_then(|end| buffer.get(view.byte_offset..end))
            .ok_or_else(|| {
                let (start, length) = (view.byte_offset, view.byte_length);
                let fault = format!(
                    "{length} bytes from byte {start} reach beyond the {} bytes of buffer {}",
                    buffer.len(),
                    view.buffer
                );
                GltfError::at(place, fault)
            })
    }
}

/// The element that `place` names by number.
pub(super) fn part<'a, T>(
    parts: &'a [T],
    index: usize,
    kind: &str,
    place: impl Display,
) -> Result<&'a T, GltfError> {
    parts.get(index).ok_or_else(|| {
        let fault = format!("there is no {kind} {index}; there are {}", parts.len());
        GltfError::at(place, fault)
    })
}

fn buffer<'a>(
    root: &Root,
    index: usize,
    container: &Container<'a>,
    resources: &Resources<'_>,
) -> Result<Cow<'a, [u8]>, GltfError> {
    let place = format!("buffers[{index}]");
    let buffer = &root.buffers[index];
    let bytes: Cow<'a, [u8]> = match (&buffer.uri, container.binary) {
        (Some(uri), _) => resources.read(uri, &place)?.into(),
        (None, Some(binary)) if index == 0 => binary.into(),
        (None, _) => return Err(GltfError::at(place, "it names no bytes")),
    };
    if bytes.len() < buffer.byte_length {
        let fault = format!(
            "expected {} bytes, found {}",
            buffer.byte_length,
            bytes.len()
        );
        return Err(GltfError::at(place, fault));
    }
    Ok(bytes)
}
