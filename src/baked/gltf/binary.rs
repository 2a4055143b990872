//! The binary part of a .glb: arrays of numbers, one after the other.

use serde_json::{Value, json};

const COMPONENT_U16: u32 = 5123;
const COMPONENT_U32: u32 = 5125;
const COMPONENT_F32: u32 = 5126;
const TARGET_VERTICES: u32 = 34962;
const TARGET_INDICES: u32 = 34963;

/// Bytes so far, with the buffer views and accessors that refer to them.
#[derive(Default)]
pub(super) struct Binary {
    pub(super) bytes: Vec<u8>,
    pub(super) views: Vec<Value>,
    pub(super) accessors: Vec<Value>,
}

impl Binary {
    /// Adds a vertex attribute of N floats per vertex and returns its accessor.
    pub(super) fn push_attribute<const N: usize>(&mut self, values: impl Iterator<Item = [f32; N]>) -> usize {
        let values: Vec<[f32; N]> = values.collect();
        let view = self.push_view(bytemuck::cast_slice(values.as_flattened()), Some(TARGET_VERTICES));
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        self.push_accessor(json!({
            "bufferView": view, "componentType": COMPONENT_F32, "count": values.len(), "type": kind,
        }))
    }

    /// Adds colours of 0 to 1 with 16 bits per channel and returns their accessor.
    pub(super) fn push_colours(&mut self, colours: impl Iterator<Item = [f32; 4]>) -> usize {
        let short: Vec<[u16; 4]> = colours.map(|colour| colour.map(|x| (x * 65_535.0).round() as u16)).collect();
        let view = self.push_view(bytemuck::cast_slice(short.as_flattened()), Some(TARGET_VERTICES));
        self.push_accessor(json!({
            "bufferView": view, "componentType": COMPONENT_U16, "normalized": true, "count": short.len(), "type": "VEC4",
        }))
    }

    /// Adds positions, at least one, with the bounds that glTF requires, and returns their accessor.
    pub(super) fn push_positions(&mut self, positions: impl Iterator<Item = [f32; 3]> + Clone) -> usize {
        let bound = |pick: fn(f32, f32) -> f32| -> [f32; 3] {
            let fold = |a: [f32; 3], b: [f32; 3]| std::array::from_fn(|axis| pick(a[axis], b[axis]));
            positions.clone().reduce(fold).expect("a primitive has vertices")
        };
        let (low, high) = (bound(f32::min), bound(f32::max));
        let accessor = self.push_attribute(positions);
        self.accessors[accessor]["min"] = json!(low);
        self.accessors[accessor]["max"] = json!(high);
        accessor
    }

    /// Adds triangle indices, of two bytes if that is enough (the largest value is reserved), and returns their
    /// accessor.
    pub(super) fn push_indices(&mut self, indices: &[u32], num_vertices: usize) -> usize {
        let (view, component) = if num_vertices <= usize::from(u16::MAX) {
            let short: Vec<u16> = indices.iter().map(|&index| index as u16).collect();
            (self.push_view(bytemuck::cast_slice(&short), Some(TARGET_INDICES)), COMPONENT_U16)
        } else {
            (self.push_view(bytemuck::cast_slice(indices), Some(TARGET_INDICES)), COMPONENT_U32)
        };
        self.push_accessor(json!({
            "bufferView": view, "componentType": component, "count": indices.len(), "type": "SCALAR",
        }))
    }

    /// Adds the bytes of a file, such as an image, and returns their buffer view.
    pub(super) fn push_file(&mut self, bytes: &[u8]) -> usize {
        self.push_view(bytes, None)
    }

    fn push_view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        // Every array starts at a multiple of four, the largest component size.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend_from_slice(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    fn push_accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}
