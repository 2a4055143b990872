//! The atlas of one submission: many hemicubes in one pair of textures, drawn in one pass and read back in one copy.

use std::num::NonZero;

use glam::Mat4;

use super::faces::{Face, NUM_FACES, faces_of};
use super::geometry::Geometry;
use super::index_lists::{IndexBuffer, index_lists};
use super::layout::{ATLAS_HEIGHT, ATLAS_WIDTH, Layout};
use crate::form_factor::Viewpoint;
use crate::gpu::Gpu;

/// Bytes from one view to the next: the largest alignment of dynamic uniform offsets that any device requires.
const VIEW_STRIDE: usize = 256;

/// Largest number of vertices of one draw call without culling. A software driver processes all vertices of a call
/// again for every few clipped triangles.
const MAX_VERTICES: u32 = 3 * 512;

/// Targets and buffers of one submission in flight.
pub(super) struct Atlas {
    items: wgpu::Texture,
    items_view: wgpu::TextureView,
    depth_view: wgpu::TextureView,
    views: wgpu::Buffer,
    bindings: wgpu::BindGroup,
    indices: IndexBuffer,
    readback: wgpu::Buffer,
}

/// Resources that every submission draws with.
pub(super) struct AtlasDraw<'a> {
    pub gpu: &'a Gpu,
    pub pipeline: &'a wgpu::RenderPipeline,
    pub geometry: &'a Geometry,
    pub layout: Layout,
    /// Distance of the near plane, metres.
    pub near: f32,
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
        Self { items, items_view, depth_view, views, bindings, indices: IndexBuffer::new(gpu), readback }
    }

    /// Draws the hemicubes of `viewpoints` and starts the read-back of their items; returns the submission to wait for.
    ///
    /// If the index lists of all faces do not fit, the faces are drawn in several submissions.
    pub(super) fn submit(&mut self, draw: &AtlasDraw<'_>, viewpoints: &[Viewpoint]) -> wgpu::SubmissionIndex {
        let &AtlasDraw { gpu, pipeline, geometry, layout, near } = draw;
        let faces = faces_of(viewpoints, layout, near);
        self.write_views(gpu, &faces);
        let mut drawn = 0;
        while drawn < faces.len() {
            let lists = geometry.culling.as_ref().map(|culling| index_lists(culling, &faces[drawn..]));
            let ranges = lists.map(|lists| self.indices.write(gpu, &lists));
            let count = ranges.as_ref().map_or(faces.len(), Vec::len);
            let mut encoder = new_encoder(gpu);
            let mut pass = self.begin_pass(&mut encoder, drawn == 0);
            pass.set_pipeline(pipeline);
            pass.set_vertex_buffer(0, geometry.vertices.slice(..));
            pass.set_index_buffer(self.indices.buffer.slice(..), wgpu::IndexFormat::Uint32);
            for i in 0..count {
                self.begin_face(&mut pass, &faces, drawn + i);
                match &ranges {
                    Some(ranges) => pass.draw_indexed(ranges[i].clone(), 0, 0..1),
                    None => draw_everything(&mut pass, geometry.num_vertices),
                }
            }
            drop(pass);
            // A write to the index buffer takes effect before this submission and after those before it.
            gpu.queue.submit([encoder.finish()]);
            drawn += count;
        }
        self.read_back(gpu)
    }

    fn write_views(&self, gpu: &Gpu, faces: &[Face]) {
        let mut views = vec![0u8; faces.len() * VIEW_STRIDE];
        for (view, face) in views.chunks_exact_mut(VIEW_STRIDE).zip(faces) {
            view[..size_of::<Mat4>()].copy_from_slice(bytemuck::bytes_of(&face.clip_from_world));
        }
        gpu.queue.write_buffer(&self.views, 0, &views);
    }

    fn begin_face(&self, pass: &mut wgpu::RenderPass<'_>, faces: &[Face], index: usize) {
        let [left, top, width, height] = faces[index].rectangle;
        pass.set_viewport(left as f32, top as f32, width as f32, height as f32, 0.0, 1.0);
        pass.set_scissor_rect(left, top, width, height);
        pass.set_bind_group(0, &self.bindings, &[(index * VIEW_STRIDE) as u32]);
    }

    fn read_back(&self, gpu: &Gpu) -> wgpu::SubmissionIndex {
        let mut encoder = new_encoder(gpu);
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

    fn begin_pass<'a>(&self, encoder: &'a mut wgpu::CommandEncoder, is_first: bool) -> wgpu::RenderPass<'a> {
        let nothing = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("item buffer"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.items_view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: if is_first { nothing } else { wgpu::LoadOp::Load },
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

    /// The items, mapped; valid after the submission has ended.
    pub(super) fn items(&self) -> Result<wgpu::BufferView, wgpu::MapRangeError> {
        self.readback.get_mapped_range(..)
    }

    /// Unmaps the items, so that the atlas can be drawn again.
    pub(super) fn release(&self) {
        self.readback.unmap();
    }
}

fn draw_everything(pass: &mut wgpu::RenderPass<'_>, num_vertices: u32) {
    for first in (0..num_vertices).step_by(MAX_VERTICES as usize) {
        pass.draw(first..(first + MAX_VERTICES).min(num_vertices), 0..1);
    }
}

fn new_encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("hemicubes") })
}

fn extent() -> wgpu::Extent3d {
    wgpu::Extent3d { width: ATLAS_WIDTH, height: ATLAS_HEIGHT, depth_or_array_layers: 1 }
}
