//! Accessors: typed elements in buffers, dense or sparse.
//!
//! Elements are read one by one, so that the work is in proportion to the elements that a mesh uses, whatever `count`
//! says; readers tell [`Document::count`] how many they will ask for. An accessor without a buffer view is zero where it
//! is not sparse.
//!
//! Normalised integers stand for f = max(c / c_max, −1).

use super::document::{Document, part};
use super::error::GltfError;
use super::schema::{Accessor, Sparse};

#[derive(Copy, Clone, Debug, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn new(code: u32) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    fn is_unsigned(self) -> bool {
        matches!(self, Self::U8 | Self::U16 | Self::U32)
    }

    /// The number at the start of `bytes`.
    fn value(self, bytes: &[u8]) -> Option<f64> {
        let two = || bytes.first_chunk::<2>().copied();
        let four = || bytes.first_chunk::<4>().copied();
        Some(match self {
            Self::I8 => f64::from(*bytes.first()? as i8),
            Self::U8 => f64::from(*bytes.first()?),
            Self::I16 => f64::from(i16::from_le_bytes(two()?)),
            Self::U16 => f64::from(u16::from_le_bytes(two()?)),
            Self::U32 => f64::from(u32::from_le_bytes(four()?)),
            Self::F32 => f64::from(f32::from_le_bytes(four()?)),
        })
    }

    /// What a normalised number stands for.
    fn normalized(self, value: f64) -> f64 {
        match self {
            Self::I8 => (value / 127.0).max(-1.0),
            Self::U8 => value / 255.0,
            Self::I16 => (value / 32_767.0).max(-1.0),
            Self::U16 => value / 65_535.0,
            Self::U32 | Self::F32 => value,
        }
    }
}

/// Elements that replace others.
struct Replaced<'a> {
    /// Their numbers, ascending.
    indices: Vec<usize>,
    values: &'a [u8],
}

/// The elements of an accessor.
pub(super) struct Elements<'a> {
    place: String,
    /// Bytes from the first element on; `None` is zero.
    dense: Option<&'a [u8]>,
    stride: usize,
    replaced: Option<Replaced<'a>>,
    component: Component,
    is_normalized: bool,
    width: usize,
    count: usize,
}

impl<'a> Elements<'a> {
    /// The accessor that `place` names, of one of these types (`SCALAR`, `VEC2` …).
    pub fn new(
        document: &'a Document<'_>,
        index: usize,
        types: &[&str],
        place: &str,
    ) -> Result<Self, GltfError> {
        let accessor = part(&document.root.accessors, index, "accessor", place)?;
        let place = format!("accessors[{index}]");
        if !types.contains(&accessor.r#type.as_str()) {
            let fault = format!(
                "expected {}, found {:?}",
                types.join(" or "),
                accessor.r#type
            );
            return Err(GltfError::at(place, fault));
        }
        let component = component(accessor.component_type, &place)?;
        let width = width(&accessor.r#type);
        let size = width * component.size();
        let stride = stride(document, accessor, size, &place)?;
        let dense = dense(document, accessor, [stride, size], &place)?;
        let sparse = accessor.sparse.as_ref();
        let replaced = sparse
            .map(|sparse| replaced(document, sparse, accessor.count, size, &place))
            .transpose()?;
        Ok(Self {
            place,
            dense,
            stride,
            replaced,
            component,
            is_normalized: accessor.normalized,
            width,
            count: accessor.count,
        })
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Where they are declared.
    pub fn place(&self) -> &str {
        &self.place
    }

    /// An element; components that the file lacks are 1.
    pub fn at<const N: usize>(&self, index: usize) -> Result<[f64; N], GltfError> {
        let bytes = self.bytes(index);
        let mut element = [1.0; N];
        for (number, value) in element.iter_mut().take(self.width).enumerate() {
            *value = self.component_at(bytes, number);
            if !value.is_finite() {
                let fault = format!("element {index} is not finite");
                return Err(GltfError::at(&self.place, fault));
            }
        }
        Ok(element)
    }

    /// Refuses anything but the integers that number vertices.
    pub fn check_indices(&self) -> Result<(), GltfError> {
        if self.component.is_unsigned() && !self.is_normalized {
            return Ok(());
        }
        let fault = "vertices are numbered by unsigned integers";
        Err(GltfError::at(&self.place, fault))
    }

    /// The bytes of an element; none for a zero or beyond the last.
    fn bytes(&self, index: usize) -> &'a [u8] {
        let size = self.width * self.component.size();
        if let Some(replaced) = &self.replaced
            && let Ok(at) = replaced.indices.binary_search(&index)
        {
            return replaced.values.get(at * size..).unwrap_or_default();
        }
        let dense = self.dense.unwrap_or_default();
        dense.get(index * self.stride..).unwrap_or_default()
    }

    fn component_at(&self, bytes: &[u8], number: usize) -> f64 {
        let bytes = bytes.get(number * self.component.size()..);
        let value = bytes.and_then(|bytes| self.component.value(bytes));
        let value = value.unwrap_or(0.0);
        if self.is_normalized {
            self.component.normalized(value)
        } else {
            value
        }
    }
}

fn component(code: u32, place: &str) -> Result<Component, GltfError> {
    let fault = || format!("there is no component type {code}");
    Component::new(code).ok_or_else(|| GltfError::at(place, fault()))
}

fn width(kind: &str) -> usize {
    match kind {
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        _ => 1,
    }
}

/// Bytes from one element to the next.
fn stride(
    document: &Document<'_>,
    accessor: &Accessor,
    size: usize,
    place: &str,
) -> Result<usize, GltfError> {
    let view = accessor.buffer_view;
    let view = view.and_then(|view| document.root.buffer_views.get(view));
    let stride = view.and_then(|view| view.byte_stride).unwrap_or(size);
    let fault = || format!("its elements of {size} bytes overlap at a stride of {stride}");
    (stride >= size)
        .then_some(stride)
        .ok_or_else(|| GltfError::at(place, fault()))
}

/// The bytes from the first element on, all elements within.
fn dense<'a>(
    document: &'a Document<'_>,
    accessor: &Accessor,
    [stride, size]: [usize; 2],
    place: &str,
) -> Result<Option<&'a [u8]>, GltfError> {
    let Some(view) = accessor.buffer_view else {
        return Ok(None);
    };
    let bytes = document.view(view, place)?;
    within(bytes, accessor.byte_offset, accessor.count, [stride, size])
        .map(Some)
        .ok_or_else(|| beyond(accessor.count, bytes, view, place))
}

/// The bytes from `offset` on, if they hold `count` elements.
fn within(bytes: &[u8], offset: usize, count: usize, [stride, size]: [usize; 2]) -> Option<&[u8]> {
    let bytes = bytes.get(offset..)?;
    let needed = match count.checked_sub(1) {
        Some(steps) => steps.checked_mul(stride)?.checked_add(size)?,
        None => 0,
    };
    (needed <= bytes.len()).then_some(bytes)
}

fn beyond(count: usize, bytes: &[u8], view: usize, place: &str) -> GltfError {
    let length = bytes.len();
    let fault =
        format!("its {count} elements reach beyond the {length} bytes of buffer view {view}");
    GltfError::at(place, fault)
}

fn replaced<'a>(
    document: &'a Document<'_>,
    sparse: &Sparse,
    count: usize,
    size: usize,
    place: &str,
) -> Result<Replaced<'a>, GltfError> {
    let place = format!("{place}.sparse");
    document.count(sparse.count)?;
    let numbers = component(sparse.indices.component_type, &place)?;
    let elements = |view: usize, offset: usize, size: usize| {
        let bytes = document.view(view, &place)?;
        within(bytes, offset, sparse.count, [size, size])
            .ok_or_else(|| beyond(sparse.count, bytes, view, &place))
    };
    let (indices, step) = (&sparse.indices, numbers.size());
    let bytes = elements(indices.buffer_view, indices.byte_offset, step)?;
    let numbered = bytes.chunks_exact(step).take(sparse.count);
    let indices: Vec<usize> = numbered
        .map(|bytes| numbers.value(bytes).unwrap_or(0.0) as usize)
        .collect();
    let ascending = indices.windows(2).all(|two| two[0] < two[1]);
    let inside = indices.last().is_none_or(|last| *last < count);
    if !(numbers.is_unsigned() && ascending && inside) {
        let fault = format!("its indices do not ascend within {count} elements");
        return Err(GltfError::at(place, fault));
    }
    let values = &sparse.values;
    let values = elements(values.buffer_view, values.byte_offset, size)?;
    Ok(Replaced { indices, values })
}
