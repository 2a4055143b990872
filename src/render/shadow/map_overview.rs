//! Overview of a shadow map: which blocks of texels show one plane, so that one look at it is enough there.
//!
//! Blocks are small against most triangles, and maps are kept: the overview is made once, and what is read of the map at
//! every pixel shrinks to the edges of things.

use super::map_cache::Map;
use super::map_pipelines::{DEPTH_ARRAY, GATHERED, OVERVIEW_FORMAT, UNIFORM, entry, uniform_buffer};
use super::map_projection::MapUniform;
use super::pipeline::PipelineRecipe;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};

/// Planes that blocks of a shadow map show.
pub(in crate::render) const MAP_OVERVIEW: Shader =
    shader!("map overview", "shared/shadow_map.wgsl", "map_overview.wgsl");

/// Texels across a block: `BLOCK` of shaders/shared/shadow_map.wgsl.
const BLOCK: u32 = 8;

/// Blocks across a map.
pub fn num_blocks(resolution: u32) -> u32 {
    resolution.div_ceil(BLOCK)
}

/// Makes overviews.
pub struct OverviewPass {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
}

impl OverviewPass {
    /// The pass.
    pub fn new(gpu: &Gpu) -> Self {
        let read = wgpu::ShaderStages::FRAGMENT;
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("map overview"),
            entries: &[
                entry(0, wgpu::ShaderStages::VERTEX, UNIFORM),
                entry(1, read, DEPTH_ARRAY),
                entry(2, read, GATHERED),
            ],
        });
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("map overview"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = PipelineRecipe {
            vertex: None,
            fragment: Some(("fragment", &[Some(OVERVIEW_FORMAT.into())])),
            ..PipelineRecipe::new("map overview", &pipeline_layout, &MAP_OVERVIEW.module(gpu))
        }
        .make(gpu);
        Self { layout, pipeline }
    }

    /// Makes that of a map that has been drawn.
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
            label: Some("map overview"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&map.textures.depth) },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(sampler) },
            ],
        });
        for (face, layer) in map.overview_faces.iter().zip(0..) {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("map overview"),
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

    #[test]
    fn blocks_are_as_large_as_the_shader_has_them() {
        assert_eq!(BLOCK, constant(&MAP_OVERVIEW, "BLOCK"));
        assert_eq!([1, 8, 9, 2048].map(num_blocks), [1, 1, 2, 256]);
    }
}
