//! Decompression of buffer views (EXT_meshopt_compression, KHR_meshopt_compression).
//!
//! Source: the extensions' specifications; meshoptimizer's own decoder is used.

use gltf::json::buffer::View;
use serde::Deserialize;
use serde_json::Value;

/// Names of the extension. Both have the same JSON; the second one adds a colour filter and a second vertex format.
pub(crate) const EXTENSIONS: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// Largest number of bytes that one byte of a stream can decode to: two bits of the shortest vertex block encode 256
/// zero bytes of one channel. A stream that claims more is refused before memory is allocated.
const MAX_EXPANSION: usize = 1024;

/// Largest vertex size, bytes; vertex sizes are multiples of four.
const MAX_STRIDE: usize = 256;

/// Returns the extension of a buffer view, if it has one.
pub(crate) fn extension_of(view: &View) -> Option<&Value> {
    let extensions = view.extensions.as_ref()?;
    EXTENSIONS.iter().find_map(|name| extensions.others.get(*name))
}

/// Location and format of compressed bytes.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Stream {
    /// Buffer with the compressed bytes.
    pub buffer: u32,
    /// Offset of the first byte.
    #[serde(default)]
    pub byte_offset: u64,
    /// Number of compressed bytes.
    pub byte_length: u64,
    byte_stride: usize,
    count: usize,
    mode: Mode,
    #[serde(default)]
    filter: Filter,
}

#[derive(Clone, Copy, Deserialize, PartialEq)]
#[serde(rename_all = "UPPERCASE")]
enum Mode {
    Attributes,
    Triangles,
    Indices,
}

#[derive(Clone, Copy, Default, Deserialize, PartialEq)]
#[serde(rename_all = "UPPERCASE")]
enum Filter {
    #[default]
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
}

/// A row of `W` words. The decoder requires a type of the size of a vertex.
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
struct Row<const W: usize>([u32; W]);

impl<const W: usize> Default for Row<W> {
    fn default() -> Self {
        Self([0; W])
    }
}

impl Stream {
    /// Reads the extension's JSON.
    ///
    /// # Errors
    /// Returns an error if the JSON is invalid or stride and count do not fit the mode.
    pub fn parse(extension: &Value) -> Result<Self, String> {
        let stream =
            Self::deserialize(extension).map_err(|error| format!("its compression extension is invalid: {error}"))?;
        let Self { byte_stride, count, mode, .. } = stream;
        let is_sound = match mode {
            Mode::Attributes => byte_stride % 4 == 0 && (4..=MAX_STRIDE).contains(&byte_stride),
            Mode::Triangles => matches!(byte_stride, 2 | 4) && count % 3 == 0,
            Mode::Indices => matches!(byte_stride, 2 | 4),
        };
        if is_sound { Ok(stream) } else { Err(format!("a stride of {byte_stride} and a count of {count} do not fit")) }
    }

    /// Decodes `compressed` to `count` rows of `byte_stride` bytes.
    ///
    /// # Errors
    /// Returns an error if the stream is invalid or claims an impossible size.
    pub fn decode(&self, compressed: &[u8]) -> Result<Vec<u8>, String> {
        let size = self.count.checked_mul(self.byte_stride);
        if size.is_none_or(|size| size > (compressed.len() + 1).saturating_mul(MAX_EXPANSION)) {
            return Err(format!("{} compressed bytes cannot hold {} rows", compressed.len(), self.count));
        }
        let mut bytes = match (self.mode, self.byte_stride) {
            (Mode::Attributes, stride) => vertices(compressed, self.count, stride)?,
            (Mode::Triangles, 2) => bytes_of::<u16>(meshopt::decode_index_buffer(compressed, self.count))?,
            (Mode::Triangles, _) => bytes_of::<u32>(meshopt::decode_index_buffer(compressed, self.count))?,
            (Mode::Indices, 2) => bytes_of::<u16>(meshopt::decode_index_sequence(compressed, self.count))?,
            (Mode::Indices, _) => bytes_of::<u32>(meshopt::decode_index_sequence(compressed, self.count))?,
        };
        if self.mode == Mode::Attributes {
            self.undo_filter(&mut bytes)?;
        }
        Ok(bytes)
    }

    fn undo_filter(&self, bytes: &mut [u8]) -> Result<(), String> {
        let wrong_stride = || format!("its filter does not support rows of {} bytes", self.byte_stride);
        match (self.filter, self.byte_stride) {
            (Filter::None, _) => {}
            (Filter::Octahedral, 4) => in_place(bytes, meshopt::decode_filter_oct::<i8>),
            (Filter::Octahedral, 8) => in_place(bytes, meshopt::decode_filter_oct::<i16>),
            (Filter::Quaternion, 8) => in_place(bytes, meshopt::decode_filter_quat),
            (Filter::Color, 4) => in_place(bytes, meshopt::decode_filter_color::<u8>),
            (Filter::Color, 8) => in_place(bytes, meshopt::decode_filter_color::<u16>),
            // The exponential filter acts on single words, so the row length does not matter.
            (Filter::Exponential, _) => in_place(bytes, meshopt::decode_filter_exp::<1>),
            _ => return Err(wrong_stride()),
        }
        Ok(())
    }
}

/// Applies a filter to the rows. The filter works on an aligned copy.
fn in_place<T: bytemuck::Pod>(bytes: &mut [u8], filter: impl Fn(&mut [T])) {
    let mut rows: Vec<T> = bytemuck::pod_collect_to_vec(bytes);
    filter(&mut rows);
    bytes.copy_from_slice(bytemuck::cast_slice(&rows));
}

fn bytes_of<T: bytemuck::Pod>(decoded: meshopt::Result<Vec<T>>) -> Result<Vec<u8>, String> {
    let rows = decoded.map_err(|error| format!("meshoptimizer cannot decode it: {error}"))?;
    Ok(bytemuck::cast_slice(&rows).to_vec())
}

/// Decodes vertices. The decoder requires a type for each of the 64 possible vertex sizes.
fn vertices(compressed: &[u8], count: usize, stride: usize) -> Result<Vec<u8>, String> {
    macro_rules! by_words {
        ($($words:literal)*) => {
            match stride / 4 {
                $($words => bytes_of::<Row<$words>>(meshopt::decode_vertex_buffer(compressed, count)),)*
                _ => Err(format!("rows of {stride} bytes are too long")),
            }
        };
    }
    by_words!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32
        33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60 61 62 63 64)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn stream(mode: &str, filter: &str, stride: usize, count: usize) -> Result<Stream, String> {
        Stream::parse(&json!({
            "buffer": 0, "byteLength": 1, "byteStride": stride, "count": count, "mode": mode, "filter": filter,
        }))
    }

    #[test]
    fn vertices_and_indices_survive_a_round_trip() {
        let rows: Vec<[u32; 5]> = (0..300).map(|i| [i, 2 * i, 7, i * i, 0]).collect();
        let compressed = meshopt::encode_vertex_buffer(&rows).expect("encodes");
        let decoded = stream("ATTRIBUTES", "NONE", 20, 300).expect("sound").decode(&compressed);
        assert_eq!(decoded.expect("decodes"), bytemuck::cast_slice::<_, u8>(&rows));
        let indices = [0u32, 1, 2, 2, 1, 3];
        let compressed = meshopt::encode_index_buffer(&indices, 4).expect("encodes");
        let decoded = stream("TRIANGLES", "NONE", 2, 6).expect("sound").decode(&compressed).expect("decodes");
        assert_eq!(decoded, [0u16, 1, 2, 2, 1, 3].map(u16::to_le_bytes).concat());
        let compressed = meshopt::encode_index_sequence(&indices, 4).expect("encodes");
        let decoded = stream("INDICES", "NONE", 4, 6).expect("sound").decode(&compressed).expect("decodes");
        assert_eq!(decoded, indices.map(u32::to_le_bytes).concat());
    }

    #[test]
    fn a_filter_is_undone() {
        let normals = [[0.0, 0.0, 1.0, 0.0], [0.6, 0.0, -0.8, 0.0f32]];
        let compressed = meshopt::encode_vertex_buffer(&meshopt::encode_filter_oct::<i16>(&normals, 16));
        let stream = stream("ATTRIBUTES", "OCTAHEDRAL", 8, 2).expect("sound");
        let decoded = stream.decode(&compressed.expect("encodes")).expect("decodes");
        let decoded: Vec<i16> = bytemuck::pod_collect_to_vec(&decoded);
        assert!((f32::from(decoded[4]) / 32767.0 - 0.6).abs() < 1e-4 && decoded[2] == 32767, "{decoded:?}");
    }

    #[test]
    fn an_impossible_stream_is_refused() {
        assert!(stream("ATTRIBUTES", "NONE", 6, 1).is_err());
        assert!(stream("TRIANGLES", "NONE", 4, 4).is_err());
        assert!(stream("FOG", "NONE", 4, 3).is_err());
        let huge = stream("ATTRIBUTES", "NONE", 4, usize::MAX).expect("valid JSON");
        assert!(huge.decode(&[0xa0; 64]).expect_err("too large").contains("cannot hold"));
        let short = stream("ATTRIBUTES", "NONE", 4, 16).expect("sound");
        assert!(short.decode(&[1, 2, 3]).expect_err("garbage").contains("cannot decode"));
    }
}
