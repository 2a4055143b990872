//! The atlas of one submission: many hemicubes in one pair of textures, drawn in one pass, copied out in one copy.

use std::num::NonZero;
use std::ops::Range;

use glam::Mat4;

use super::faces::{Frustum, NUM_FACES, cell_rectangle, projections};
use super::geometry::Geometry;
use crate::form_factor::Viewpoint;
use crate::gpu::Gpu;

/// Pixels across an atlas; a multiple of every hemicube size and of the copy alignment.
pub(super) const ATLAS_WIDTH: u32 = 512;
/// Pixels down an atlas: one hemicube of the largest size, 64 of the usual one.
const ATLAS_HEIGHT: u32 = 1536;

/// Bytes from one view to the next: what every device can offset a uniform by.
const VIEW_STRIDE: usize = 256;

/// Targets and buffers of one submission in flight.
pub(super) struct Atlas {
    items: wgpu::Texture,
    items_view: wgpu::TextureView,
    depth_view: wgpu::TextureView,
    views: wgpu::Buffer,
    bindings: wgpu::BindGroup,
    readback: wgpu::Buffer,
}

/// How hemicubes `n` pixels wide are laid out in an atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    pub n: u32,
}

impl Layout {
    pub(super) fn columns(self) -> u32 {
        ATLAS_WIDTH / self.n
    }

    /// Hemicubes a submission.
    pub(super) fn capacity(self) -> usize {
        (self.columns() * (ATLAS_HEIGHT / (3 * self.n))) as usize
    }

    /// Top left pixel of a cell.
    pub(super) fn origin(self, cell: usize) -> (u32, u32) {
        let cell = cell as u32;
        (cell % self.columns() * self.n, cell / self.columns() * 3 * self.n)
    }
}

impl Atlas {
    pub(super) fn new(gpu: &Gpu, bindings_layout: &wgpu::BindGroupLayout, geometry: &Geometry, layout: Layout) -> Self {
        let texture = |label, format, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: extent(),
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let items = texture("item buffer", wgpu::TextureFormat::R32Uint, wgpu::TextureUsages::COPY_SRC);
        let depth = texture("item depth", wgpu::TextureFormat::Depth32Float, wgpu::TextureUsages::empty());
        let views = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("hemicube views"),
            size: (layout.capacity() * NUM_FACES * VIEW_STRIDE) as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let view = wgpu::BufferBinding { buffer: &views, offset: 0, size: NonZero::new(size_of::<Mat4>() as u64) };
        let scene = [&geometry.triangles, &geometry.tree, &geometry.cutouts, &geometry.alphas];
        let resources =
            std::iter::once(wgpu::BindingResource::Buffer(view)).chain(scene.map(|buffer| buffer.as_entire_binding()));
        let entries: Vec<wgpu::BindGroupEntry<'_>> =
            (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("item buffer"),
            layout: bindings_layout,
            entries: &entries,
        });
        let readback = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("item readback"),
            size: u64::from(ATLAS_WIDTH * ATLAS_HEIGHT * 4),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let items_view = items.create_view(&wgpu::TextureViewDescriptor::default());
        let depth_view = depth.create_view(&wgpu::TextureViewDescriptor::default());
        Self { items, items_view, depth_view, views, bindings, readback }
    }

    /// Draws the hemicubes of `viewpoints` and asks for their items; returns what to wait for.
    pub(super) fn submit(
        &self,
        gpu: &Gpu,
        pipeline: &wgpu::RenderPipeline,
        geometry: &Geometry,
        layout: Layout,
        viewpoints: &[Viewpoint],
        near: f32,
    ) -> wgpu::SubmissionIndex {
        let faces: Vec<[Mat4; NUM_FACES]> = viewpoints.iter().map(|v| projections(v, near)).collect();
        let mut views = vec![0u8; faces.as_flattened().len() * VIEW_STRIDE];
        for (view, matrix) in views.chunks_exact_mut(VIEW_STRIDE).zip(faces.as_flattened()) {
            view[..size_of::<Mat4>()].copy_from_slice(bytemuck::bytes_of(matrix));
        }
        gpu.queue.write_buffer(&self.views, 0, &views);
        let mut encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("hemicubes") });
        {
            let mut pass = self.begin_pass(&mut encoder);
            pass.set_pipeline(pipeline);
            pass.set_vertex_buffer(0, geometry.vertices.slice(..));
            let mut ranges: Vec<(f32, Range<u32>)> = Vec::new();
            for (cell, matrices) in faces.iter().enumerate() {
                let (left, top) = layout.origin(cell);
                for (face, matrix) in matrices.iter().enumerate() {
                    let (width, height, down) = cell_rectangle(face, layout.n);
                    pass.set_viewport(left as f32, (top + down) as f32, width as f32, height as f32, 0.0, 1.0);
                    pass.set_scissor_rect(left, top + down, width, height);
                    let view = (cell * NUM_FACES + face) * VIEW_STRIDE;
                    pass.set_bind_group(0, &self.bindings, &[view as u32]);
                    geometry.visible_vertices(&Frustum::new(matrix), viewpoints[cell].position, &mut ranges);
                    for (_, range) in &ranges {
                        pass.draw(range.clone(), 0..1);
                    }
                }
            }
        }
        encoder.copy_texture_to_buffer(
            self.items.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.readback,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(4 * ATLAS_WIDTH),
                    rows_per_image: None,
                },
            },
            extent(),
        );
        let submission = gpu.queue.submit([encoder.finish()]);
        self.readback.map_async(wgpu::MapMode::Read, .., |_| {});
        submission
    }

    fn begin_pass<'a>(&self, encoder: &'a mut wgpu::CommandEncoder) -> wgpu::RenderPass<'a> {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("item buffer"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.items_view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth_view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }

    /// The items, mapped; only after the submission has ended.
    pub(super) fn items(&self) -> Result<wgpu::BufferView, wgpu::MapRangeError> {
        self.readback.get_mapped_range(..)
    }

    /// Gives the mapped items back, so that the atlas can be drawn again.
    pub(super) fn release(&self) {
        self.readback.unmap();
    }
}

fn extent() -> wgpu::Extent3d {
    wgpu::Extent3d { width: ATLAS_WIDTH, height: ATLAS_HEIGHT, depth_or_array_layers: 1 }
}
