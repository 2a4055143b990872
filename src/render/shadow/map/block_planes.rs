//! Block planes of a shadow map: for each block of 8 x 8 texels the plane on which all of its texels lie, if there is
//! one.
//!
//! This is a min/max shadow map (Dmitriev and Uralsky 2007, "Soft shadows using hierarchical min-max shadow maps") of
//! one level that stores a plane in place of the bounds. A block includes the texels round it that a filter can touch.
//! A lookup in a block with a plane is one comparison, and only lookups at the edges of casters gather texels. The
//! planes are computed once for a map, which serves many pictures. Their texture has a 64th of the map's texels and
//! fits into caches: cornell with one map takes a third less time on a software driver.
//!
//! Designed for software rendering (`viewer::software`), which it makes faster; it also serves hardware, where the gain
//! is not measured.

use super::bindings::{BLOCK_PLANES_FORMAT, DEPTH_ARRAY, GATHERED, UNIFORM, entry, uniform_buffer};
use super::cache::Map;
use super::projection::MapUniform;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::shadow::shared::pipeline::{PipelineRecipe, pipeline_layout};

const BLOCK_PLANES: Shader = shader!("block planes", "shadow/map/projection.wgsl", "shadow/map/block_planes.wgsl");

/// Computes block planes.
pub struct BlockPlanesPass {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
}

impl BlockPlanesPass {
    /// Creates the pass.
    pub fn new(gpu: &Gpu) -> Self {
        let read = wgpu::ShaderStages::FRAGMENT;
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("block planes"),
            entries: &[
                entry(0, wgpu::ShaderStages::VERTEX, UNIFORM),
                entry(1, read, DEPTH_ARRAY),
                entry(2, read, GATHERED),
            ],
        });
        let pipeline_layout = pipeline_layout(gpu, "block planes", &[Some(&layout)]);
        let pipeline = PipelineRecipe {
            vertex: None,
            fragment: Some(("fragment", &[Some(BLOCK_PLANES_FORMAT.into())])),
            ..PipelineRecipe::new("block planes", &pipeline_layout, &BLOCK_PLANES.module(gpu))
        }
        .make(gpu);
        Self { layout, pipeline }
    }

    /// Computes the block planes of a map that has been drawn.
    pub fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        map: &Map,
        uniform: &MapUniform,
        sampler: &wgpu::Sampler,
    ) {
        let uniform = uniform_buffer(gpu, bytemuck::bytes_of(uniform));
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("block planes"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&map.textures.depth) },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(sampler) },
            ],
        });
        for (face, layer) in map.block_plane_faces.iter().zip(0..) {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("block planes"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: face,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..Default::default()
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &bindings, &[]);
            pass.draw(0..3, layer..layer + 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::constant;
    use crate::render::shadow::map::bindings::{BLOCK, num_blocks};

    #[test]
    fn blocks_are_as_large_as_in_the_shader() {
        assert_eq!(BLOCK, constant(&BLOCK_PLANES, "BLOCK"));
        assert_eq!([1, 8, 9, 2048].map(num_blocks), [1, 1, 2, 256]);
    }
}
