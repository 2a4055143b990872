//! The atlas of one submission: many hemicubes in one pair of textures, drawn in one pass, copied out in one copy.

use std::num::NonZero;

use glam::{Mat4, Vec3};

use super::faces::{NUM_FACES, cell_rectangle, projections};
use super::geometry::Geometry;
use super::indices::{Indices, lists_of};
use crate::form_factor::Viewpoint;
use crate::gpu::Gpu;

/// Pixels across an atlas; a multiple of every hemicube size and of the copy alignment.
pub(super) const ATLAS_WIDTH: u32 = 512;
/// Pixels down an atlas: one hemicube of the largest size, 64 of the usual one.
const ATLAS_HEIGHT: u32 = 1536;

/// Bytes from one view to the next: what every device can offset a uniform by.
const VIEW_STRIDE: usize = 256;

/// Vertices of a draw call of everything: software drivers touch all of them again for every few clipped triangles.
const MAX_VERTICES: u32 = 3 * 512;

/// Targets and buffers of one submission in flight.
pub(super) struct Atlas {
    items: wgpu::Texture,
    items_view: wgpu::TextureView,
    depth_view: wgpu::TextureView,
    views: wgpu::Buffer,
    bindings: wgpu::BindGroup,
    indices: Indices,
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

/// One face of one hemicube.
pub(super) struct Face {
    pub clip_from_world: Mat4,
    pub eye: Vec3,
    /// Left, top, width and height in the atlas.
    rectangle: [u32; 4],
}

impl Face {
    /// Width and height, pixels.
    pub(super) fn size(&self) -> (u32, u32) {
        (self.rectangle[2], self.rectangle[3])
    }
}

/// The faces of hemicubes that fill an atlas cell by cell.
fn faces_of(viewpoints: &[Viewpoint], layout: Layout, near: f32) -> Vec<Face> {
    let of_cell = |(cell, viewpoint): (usize, &Viewpoint)| {
        let (left, top) = layout.origin(cell);
        let eye = viewpoint.position;
        let face = move |(face, clip_from_world)| {
            let (width, height, down) = cell_rectangle(face, layout.n);
            Face { clip_from_world, eye, rectangle: [left, top + down, width, height] }
        };
        projections(viewpoint, near).into_iter().enumerate().map(face)
    };
    viewpoints.iter().enumerate().flat_map(of_cell).collect()
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
        Self { items, items_view, depth_view, views, bindings, indices: Indices::new(gpu), readback }
    }

    /// Draws the hemicubes of `viewpoints` and asks for their items; returns what to wait for.
    pub(super) fn submit(
        &mut self,
        gpu: &Gpu,
        pipeline: &wgpu::RenderPipeline,
        geometry: &Geometry,
        layout: Layout,
        viewpoints: &[Viewpoint],
        near: f32,
    ) -> wgpu::SubmissionIndex {
        let faces = faces_of(viewpoints, layout, near);
        self.write_views(gpu, &faces);
        let mut drawn = 0;
        while drawn < faces.len() {
            let lists = geometry.culling.as_ref().map(|culling| lists_of(culling, &faces[drawn..]));
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
            // What is written to the list of indices is seen by this submission and not by those before.
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

    /// The items, mapped; only after the submission has ended.
    pub(super) fn items(&self) -> Result<wgpu::BufferView, wgpu::MapRangeError> {
        self.readback.get_mapped_range(..)
    }

    /// Gives the mapped items back, so that the atlas can be drawn again.
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
