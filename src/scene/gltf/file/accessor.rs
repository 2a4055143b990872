//! Reads the numbers of accessors within checked bounds: strides, normalised integers, sparse substitution.
//!
//! Only the rows that a primitive uses are read, because many primitives may share one buffer.
//!
//! Source: glTF 2.0, section 3.6.2.

use gltf::json::accessor::{Accessor, ComponentType, Type};
use gltf::json::buffer::View;
use gltf::json::validation::Checked;
use gltf::json::{self, Index};

use super::document::Document;
use crate::scene::gltf::error::Cause;

/// Largest number of elements of an accessor without a buffer view, whose values are zero except for sparse
/// substitutes.
const MAX_VIRTUAL_COUNT: usize = 1 << 20;

/// An accessor with a checked layout: all rows below `count` are inside its bytes.
pub(crate) struct Reader<'a> {
    id: usize,
    count: usize,
    width: usize,
    component: ComponentType,
    normalized: bool,
    base: Option<Rows<'a>>,
    overlay: Option<Overlay<'a>>,
}

/// Evenly spaced elements in a buffer view.
struct Rows<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
}

/// Sparse substitutes, sorted by row.
struct Overlay<'a> {
    rows: Vec<(u32, usize)>,
    values: Rows<'a>,
}

impl<'a> Rows<'a> {
    fn new(bytes: &'a [u8], offset: u64, stride: usize, size: usize, count: usize) -> Option<Self> {
        let bytes = bytes.get(usize::try_from(offset).ok()?..)?;
        let used = match count {
            0 => 0,
            _ => (count - 1).checked_mul(stride)?.checked_add(size)?,
        };
        (stride >= size && used <= bytes.len()).then_some(Self { bytes, stride, size })
    }

    fn get(&self, row: usize) -> &'a [u8] {
        &self.bytes[row * self.stride..][..self.size]
    }
}

impl<'a> Reader<'a> {
    /// Checks the layout of accessor `index`. `user` describes the item that refers to the accessor, for the error
    /// message.
    ///
    /// # Errors
    /// Returns an error if the accessor does not exist or does not fit its buffer view.
    pub fn new(document: &'a Document<'_>, index: Index<Accessor>, user: impl Fn() -> String) -> Result<Self, Cause> {
        Self::over(document, index, None, user)
    }

    /// Does the same as [`Self::new`], but reads the `decoded` bytes, if there are any, instead of those of the file.
    ///
    /// # Errors
    /// Returns an error as [`Self::new`] does.
    pub fn over(
        document: &'a Document<'_>,
        index: Index<Accessor>,
        decoded: Option<&'a [u8]>,
        user: impl Fn() -> String,
    ) -> Result<Self, Cause> {
        let accessor = document.find(index, "accessor", user)?;
        let failed = |problem: &str| Cause::accessor(index.value(), problem);
        let Checked::Valid(json::accessor::GenericComponentType(component)) = accessor.component_type else {
            return Err(failed("unknown component type"));
        };
        let Checked::Valid(shape) = accessor.type_ else { return Err(failed("unknown type")) };
        let count = usize::try_from(accessor.count.0).map_err(|_| failed("its count is too large"))?;
        let mut reader = Self {
            id: index.value(),
            count,
            width: shape.multiplicity(),
            component,
            normalized: accessor.normalized,
            base: None,
            overlay: None,
        };
        if matches!(shape, Type::Mat2 | Type::Mat3) {
            return Err(failed("a matrix where a vector or a number is required"));
        }
        if let Some(bytes) = decoded {
            let rows = Rows::new(bytes, 0, reader.size(), reader.size(), count);
            reader.base = Some(rows.ok_or_else(|| failed("its compressed data has too few values"))?);
            return Ok(reader);
        }
        let offset = accessor.byte_offset.unwrap_or_default().0;
        match accessor.buffer_view {
            Some(view) => reader.base = Some(reader.rows(document, view, offset, reader.size(), count)?),
            None if count > MAX_VIRTUAL_COUNT => return Err(failed("it has no data, but a huge count")),
            None => {}
        }
        if let Some(sparse) = &accessor.sparse {
            reader.overlay = Some(reader.read_overlay(document, sparse)?);
        }
        Ok(reader)
    }

    /// Returns the number of elements.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns the number of components of an element.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Returns true if its numbers are integers.
    pub fn is_integer(&self) -> bool {
        self.component != ComponentType::F32
    }

    /// Returns the same accessor with integers read as fractions of their largest value, even if the file does not mark
    /// them so.
    pub fn into_fractions(mut self) -> Self {
        self.normalized = true;
        self
    }

    /// Returns the elements of the given rows (ascending) as vectors of `N` numbers.
    ///
    /// # Errors
    /// Returns an error if the elements do not have `N` components, a row is out of range, or a number is not finite.
    pub fn vectors<const N: usize>(&self, rows: &[u32]) -> Result<Vec<[f32; N]>, Cause> {
        if self.width != N {
            return Err(self.failed(format!("elements of {} numbers where {N} are required", self.width)));
        }
        let size = self.component.size();
        let decode = |bytes: &[u8]| -> [f32; N] {
            std::array::from_fn(|c| decode_number(&bytes[c * size..][..size], self.component, self.normalized))
        };
        let vectors = self.read(rows, [0.0; N], decode)?;
        if vectors.iter().flatten().all(|number| number.is_finite()) {
            Ok(vectors)
        } else {
            Err(self.failed("it holds NaN or infinity".to_owned()))
        }
    }

    /// Returns all elements as vertex indices.
    ///
    /// # Errors
    /// Returns an error if the elements are not single unsigned integers.
    pub fn indices(&self) -> Result<Vec<u32>, Cause> {
        if self.width != 1 || !matches!(self.component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32) {
            return Err(self.failed("indices must be single unsigned integers".to_owned()));
        }
        let last = u32::try_from(self.count).map_err(|_| self.failed("too many indices".to_owned()))?;
        self.read(&(0..last).collect::<Vec<_>>(), 0, decode_index)
    }

    fn read<T: Copy>(&self, rows: &[u32], zero: T, decode: impl Fn(&[u8]) -> T) -> Result<Vec<T>, Cause> {
        if let Some(&last) = rows.last().filter(|&&row| row as usize >= self.count) {
            return Err(self.failed(format!("row {last} is read, but there are only {}", self.count)));
        }
        let mut values: Vec<T> = match &self.base {
            Some(base) => rows.iter().map(|&row| decode(base.get(row as usize))).collect(),
            None => vec![zero; rows.len()],
        };
        for (row, substitute) in self.overlay.iter().flat_map(|overlay| &overlay.rows) {
            if let (Ok(at), Some(overlay)) = (rows.binary_search(row), &self.overlay) {
                values[at] = decode(overlay.values.get(*substitute));
            }
        }
        Ok(values)
    }

    fn read_overlay(
        &self,
        document: &'a Document<'_>,
        sparse: &json::accessor::sparse::Sparse,
    ) -> Result<Overlay<'a>, Cause> {
        let count = usize::try_from(sparse.count.0).map_err(|_| self.failed("sparse count too large".to_owned()))?;
        let Checked::Valid(json::accessor::IndexComponentType(kind)) = sparse.indices.component_type else {
            return Err(self.failed("unknown type of sparse indices".to_owned()));
        };
        let indices = &sparse.indices;
        let index_rows = self.rows(document, indices.buffer_view, indices.byte_offset.0, kind.size(), count)?;
        let rows = (0..count).map(|substitute| (decode_index(index_rows.get(substitute)), substitute)).collect();
        let values = &sparse.values;
        let values = self.rows(document, values.buffer_view, values.byte_offset.0, self.size(), count)?;
        Ok(Overlay { rows, values })
    }

    fn rows(
        &self,
        document: &'a Document<'_>,
        view: Index<View>,
        offset: u64,
        size: usize,
        count: usize,
    ) -> Result<Rows<'a>, Cause> {
        let (bytes, stride) = document.view(view, || format!("accessor {}", self.id))?;
        Rows::new(bytes, offset, stride.unwrap_or(size), size, count)
            .ok_or_else(|| self.failed(format!("its count, offset or stride does not fit buffer view {view}")))
    }

    /// Returns the size of one element, bytes.
    fn size(&self) -> usize {
        self.width * self.component.size()
    }

    fn failed(&self, problem: String) -> Cause {
        Cause::accessor(self.id, problem)
    }
}

fn decode_number(bytes: &[u8], component: ComponentType, normalized: bool) -> f32 {
    let (number, largest) = match (component, bytes) {
        (ComponentType::I8, &[a]) => (f32::from(a as i8), 127.0),
        (ComponentType::U8, &[a]) => (f32::from(a), 255.0),
        (ComponentType::I16, &[a, b]) => (f32::from(i16::from_le_bytes([a, b])), 32_767.0),
        (ComponentType::U16, &[a, b]) => (f32::from(u16::from_le_bytes([a, b])), 65_535.0),
        (ComponentType::U32, &[a, b, c, d]) => (u32::from_le_bytes([a, b, c, d]) as f32, 4_294_967_295.0),
        (ComponentType::F32, &[a, b, c, d]) => return f32::from_le_bytes([a, b, c, d]),
        _ => unreachable!("rows are as long as their component type says"),
    };
    if normalized { (number / largest).max(-1.0) } else { number }
}

fn decode_index(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |index, &byte| index << 8 | u32::from(byte))
}

#[cfg(test)]
mod tests;
