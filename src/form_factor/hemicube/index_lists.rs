//! The triangles that each face draws, as index lists on the device.

use std::ops::Range;

use rayon::prelude::*;

use super::culling::Culling;
use super::faces::Face;
use crate::gpu::Gpu;

/// Number of indices after which no further lists are made, to limit their memory.
const MAX_INDICES: usize = 1 << 22;

/// Number of faces culled in parallel.
const FACES_AT_ONCE: usize = 64;

/// Returns the index lists of as many faces as fit, at least of the first.
pub(super) fn index_lists(culling: &Culling, faces: &[Face]) -> Vec<Vec<u32>> {
    let (mut lists, mut num_indices) = (Vec::with_capacity(faces.len()), 0);
    for some in faces.chunks(FACES_AT_ONCE) {
        if num_indices > MAX_INDICES {
            break;
        }
        let list_of = |face: &Face| culling.indices(&face.clip_from_world, face.eye, face.size());
        let next: Vec<Vec<u32>> = some.par_iter().map(list_of).collect();
        num_indices += next.iter().map(Vec::len).sum::<usize>();
        lists.extend(next);
    }
    lists
}

/// An index buffer that grows with its contents.
pub(super) struct IndexBuffer {
    pub buffer: wgpu::Buffer,
}

impl IndexBuffer {
    pub(super) fn new(gpu: &Gpu) -> Self {
        Self { buffer: new_buffer(gpu, 4096) }
    }

    /// Writes the lists one after the other; returns the range of each.
    pub(super) fn write(&mut self, gpu: &Gpu, lists: &[Vec<u32>]) -> Vec<Range<u32>> {
        let num_indices: usize = lists.iter().map(Vec::len).sum();
        let num_bytes = (num_indices * size_of::<u32>()) as u64;
        if num_bytes > self.buffer.size() {
            self.buffer = new_buffer(gpu, num_bytes.next_power_of_two());
        }
        gpu.queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(&lists.concat()));
        let mut end = 0;
        let range_of = |list: &Vec<u32>| {
            let first = end;
            end += list.len() as u32;
            first..end
        };
        lists.iter().map(range_of).collect()
    }
}

fn new_buffer(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("hemicube indices"),
        size,
        usage: wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
