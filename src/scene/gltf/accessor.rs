//! Numbers out of accessors, every read within bounds: strides, normalised integers, sparse overlays.
//!
//! Only the rows that a primitive uses are read, because exporters often let a thousand primitives share one buffer.

use gltf::json::accessor::{Accessor, ComponentType, Type};
use gltf::json::buffer::View;
use gltf::json::validation::Checked;
use gltf::json::{self, Index};

use super::document::Document;
use super::error::Cause;

/// Longest accessor that may exist without any bytes behind it (all zeros but for a sparse overlay).
const MAX_VIRTUAL_COUNT: usize = 1 << 20;

/// An accessor whose layout is checked: reading any row below `count` stays inside its bytes.
pub(super) struct Reader<'a> {
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
    /// Checks the layout of accessor `index`.
    pub fn new(document: &'a Document<'_>, index: Index<Accessor>, user: impl Fn() -> String) -> Result<Self, Cause> {
        Self::over(document, index, None, user)
    }

    /// As [`Self::new`], over `decoded` bytes instead of those of the file where there are any.
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
            return Err(failed("a matrix where a vector or number is wanted"));
        }
        if let Some(bytes) = decoded {
            let rows = Rows::new(bytes, 0, reader.size(), reader.size(), count);
            reader.base = Some(rows.ok_or_else(|| failed("too few values were compressed"))?);
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

    /// Number of elements.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Components of an element.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Its numbers are integers.
    pub fn is_integer(&self) -> bool {
        self.component != ComponentType::F32
    }

    /// The same data with integers read as fractions of their largest value, whatever the file says.
    pub fn into_fractions(mut self) -> Self {
        self.normalized = true;
        self
    }

    /// Elements of the given rows (ascending) as vectors of `N` numbers.
    pub fn vectors<const N: usize>(&self, rows: &[u32]) -> Result<Vec<[f32; N]>, Cause> {
        if self.width != N {
            return Err(self.failed(format!("elements of {} numbers where {N} are wanted", self.width)));
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

    /// All elements as vertex indices.
    pub fn indices(&self) -> Result<Vec<u32>, Cause> {
        if self.width != 1 || !matches!(self.component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32) {
            return Err(self.failed("indices must be single unsigned integers".to_owned()));
        }
        let last = u32::try_from(self.count).map_err(|_| self.failed("too many indices".to_owned()))?;
        self.read(&(0..last).collect::<Vec<_>>(), 0, decode_index)
    }

    fn read<T: Copy>(&self, rows: &[u32], zero: T, decode: impl Fn(&[u8]) -> T) -> Result<Vec<T>, Cause> {
        if let Some(&last) = rows.last().filter(|&&row| row as usize >= self.count) {
            return Err(self.failed(format!("row {last} is wanted, but there are only {}", self.count)));
        }
        let mut values: Vec<T> = match &self.base {
            Some(base) => rows.iter().map(|&row| decode(base.get(row as usize))).collect(),
            None => vec![zero; rows.len()],
        };
        for (row, place) in self.overlay.iter().flat_map(|overlay| &overlay.rows) {
            if let (Ok(at), Some(overlay)) = (rows.binary_search(row), &self.overlay) {
                values[at] = decode(overlay.values.get(*place));
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
        let places = self.rows(document, indices.buffer_view, indices.byte_offset.0, kind.size(), count)?;
        let rows = (0..count).map(|place| (decode_index(places.get(place)), place)).collect();
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

    /// Bytes of one element.
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
mod tests {
    use glam::{Vec2, Vec3, Vec4};
    use serde_json::json;

    use super::super::fixture::Fixture;

    #[test]
    fn sparse_values_replace_rows() {
        let mut fixture = Fixture::triangle();
        let rows = fixture.view(&[2]);
        let values = fixture.view(&[0f32, 3.0, 0.0].map(f32::to_le_bytes).concat());
        fixture.json["accessors"][0]["sparse"] = json!({
            "count": 1, "indices": {"bufferView": rows, "componentType": 5121}, "values": {"bufferView": values},
        });
        assert_eq!(fixture.load().vertices[2].position, Vec3::new(0.0, 3.0, 0.0));
    }

    #[test]
    fn without_a_view_the_base_is_zero() {
        let mut fixture = Fixture::triangle();
        let colour = json!({"componentType": 5126, "type": "VEC3", "count": 3});
        fixture.json["accessors"].as_array_mut().expect("a list").push(colour);
        fixture.primitive()["attributes"]["COLOR_0"] = json!(2);
        assert_eq!(fixture.load().vertices[0].colour, Vec4::new(0.0, 0.0, 0.0, 1.0));
        fixture.json["accessors"][2]["count"] = json!(4_000_000_000u32);
        assert!(fixture.error().contains("accessor 2: it has no data"), "{}", fixture.error());
    }

    #[test]
    fn quantised_positions_are_plain_integers_and_may_have_a_stride() {
        let mut fixture = Fixture::triangle();
        let bytes = [0i8, 0, 0, 99, 100, 0, 0, 99, 0, -50, 0, 99].map(|value| value as u8);
        let positions = fixture.accessor(5120, "VEC3", 3, &bytes);
        let view = fixture.json["accessors"][positions]["bufferView"].as_u64().expect("a view") as usize;
        fixture.json["bufferViews"][view]["byteStride"] = json!(4);
        fixture.primitive()["attributes"]["POSITION"] = json!(positions);
        let scene = fixture.load();
        assert_eq!(scene.vertices[1].position, Vec3::new(100.0, 0.0, 0.0));
        assert_eq!(scene.vertices[2].position, Vec3::new(0.0, -50.0, 0.0));
    }

    #[test]
    fn normalised_integers_are_fractions() {
        let mut fixture = Fixture::triangle();
        let uv = fixture.accessor(5121, "VEC2", 3, &[0, 0, 255, 51, 0, 255]);
        fixture.json["accessors"][uv]["normalized"] = json!(true);
        fixture.primitive()["attributes"]["TEXCOORD_1"] = json!(uv);
        let bytes = [0u16, 65535, 0, 65535].map(u16::to_le_bytes).concat().repeat(3);
        let colour = fixture.accessor(5123, "VEC4", 3, &bytes);
        fixture.primitive()["attributes"]["COLOR_0"] = json!(colour);
        let vertex = fixture.load().vertices[1];
        assert_eq!(vertex.uv, [Vec2::ZERO, Vec2::new(1.0, 0.2)]);
        assert_eq!(vertex.colour, Vec4::new(0.0, 1.0, 0.0, 1.0), "integer colours are fractions even unmarked");
    }

    #[test]
    fn reading_outside_a_view_names_the_accessor() {
        for (field, value) in [("count", json!(4)), ("byteOffset", json!(4)), ("byteOffset", json!(u64::MAX))] {
            let mut fixture = Fixture::triangle();
            fixture.json["accessors"][0][field] = value;
            assert!(fixture.error().contains("accessor 0: its count, offset or stride"), "{}", fixture.error());
        }
    }

    #[test]
    fn a_view_outside_its_buffer_is_named() {
        for (field, value) in [("byteLength", json!(1u64 << 40)), ("byteOffset", json!(u64::MAX))] {
            let mut fixture = Fixture::triangle();
            fixture.json["bufferViews"][0][field] = value;
            assert!(fixture.error().contains("buffer view 0 reaches outside buffer 0"), "{}", fixture.error());
        }
    }

    #[test]
    fn not_a_number_is_refused() {
        let mut fixture = Fixture::triangle();
        fixture.floats("POSITION", "VEC3", &[f32::NAN, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        assert!(fixture.error().contains("accessor 2: it holds NaN"), "{}", fixture.error());
    }

    #[test]
    fn attributes_shorter_than_the_positions_are_refused() {
        let mut fixture = Fixture::triangle();
        fixture.json["accessors"][1]["count"] = json!(2);
        assert!(fixture.error().contains("accessor 1: row 2 is wanted"), "{}", fixture.error());
    }
}
