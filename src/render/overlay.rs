//! Overlay: lines and tinted faces over a finished picture, hidden by the surfaces in front of them.
//!
//! It draws the depth of the scene again, with one sample a pixel. Only pictures with marks have this cost.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use wgpu::util::DeviceExt;

use super::frame_uniform::{frame_bind_group, frame_layout};
use super::picture_request::PictureRequest;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::scene::gpu_vertex::GpuVertex;
use crate::render::targets::DEPTH_FORMAT;
use crate::scene::AlphaMode;

/// Shader of the overlay.
pub(in crate::render) const OVERLAY: Shader =
    shader!("overlay", "shared/frame.wgsl", "shared/colour.wgsl", "overlay.wgsl");

/// A corner of a mark.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Mark {
    /// Position in world space, metres.
    pub position: Vec3,
    /// Display colour: sRGB encoded with straight alpha.
    pub colour: [u8; 4],
}

/// Marks on the device.
pub struct Overlay {
    lines: Corners,
    triangles: Corners,
}

struct Corners {
    buffer: wgpu::Buffer,
    count: u32,
}

impl Overlay {
    /// Uploads lines, two corners each, and triangles, three corners each.
    #[must_use]
    pub fn new(gpu: &Gpu, lines: &[Mark], triangles: &[Mark]) -> Self {
        let corners = |marks: &[Mark]| Corners {
            buffer: gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("overlay"),
                contents: bytemuck::cast_slice(marks),
                usage: wgpu::BufferUsages::VERTEX,
            }),
            count: marks.len() as u32,
        };
        Self { lines: corners(lines), triangles: corners(triangles) }
    }
}

/// Draws overlays into pictures of one format.
pub struct OverlayPass {
    frame_layout: wgpu::BindGroupLayout,
    culled: wgpu::RenderPipeline,
    two_faced: wgpu::RenderPipeline,
    lines: wgpu::RenderPipeline,
    triangles: wgpu::RenderPipeline,
    depth: Option<(wgpu::TextureView, [u32; 2])>,
}

impl OverlayPass {
    /// Creates pipelines for pictures of `output_format`.
    #[must_use]
    pub fn new(gpu: &Gpu, output_format: wgpu::TextureFormat) -> Self {
        let frame_layout = frame_layout(gpu);
        let module = OVERLAY.module(gpu);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("overlay"),
            bind_group_layouts: &[Some(&frame_layout)],
            immediate_size: 0,
        });
        let make = |drawn| pipeline(gpu, &layout, &module, output_format, drawn);
        Self {
            culled: make(Primitive::Depth { cull_mode: Some(wgpu::Face::Back) }),
            two_faced: make(Primitive::Depth { cull_mode: None }),
            lines: make(Primitive::Marks(wgpu::PrimitiveTopology::LineList)),
            triangles: make(Primitive::Marks(wgpu::PrimitiveTopology::TriangleList)),
            frame_layout,
            depth: None,
        }
    }

    /// Draws `overlay` over a finished picture in `target`, which has the size of the request.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        request: &PictureRequest<'_>,
        overlay: &Overlay,
    ) {
        let &PictureRequest { size, scene, view, settings, .. } = request;
        let depth = match self.depth.take() {
            Some(last) if last.1 == size => last,
            _ => (depth_target(gpu, size), size),
        };
        let frame = frame_bind_group(gpu, &self.frame_layout, scene, &view, settings);
        let seen = scene.in_view(gpu, &view.cull_view(settings.cull_back));
        let mut pass = begin(encoder, target, &depth.0);
        pass.set_bind_group(0, &frame, &[]);
        // Draw the depth of the surfaces that hide marks.
        let (indices, batches) = seen.coarsest();
        if !batches.is_empty() {
            pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        }
        for batch in batches.iter().filter(|batch| batch.alpha_mode != AlphaMode::Blend) {
            pass.set_pipeline(if batch.faces.are_culled(settings.cull_back) { &self.culled } else { &self.two_faced });
            pass.set_vertex_buffer(0, seen.vertices_of(batch).slice(..));
            pass.draw_indexed(batch.indices.clone(), 0, 0..1);
        }
        // Draw tinted faces, and lines on top of them.
        for (pipeline, corners) in [(&self.triangles, &overlay.triangles), (&self.lines, &overlay.lines)] {
            if corners.count > 0 {
                pass.set_pipeline(pipeline);
                pass.set_vertex_buffer(0, corners.buffer.slice(..));
                pass.draw(0..corners.count, 0..1);
            }
        }
        drop(pass);
        self.depth = Some(depth);
    }
}

fn depth_target(gpu: &Gpu, size: [u32; 2]) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("overlay depth"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: DEPTH_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
    depth: &wgpu::TextureView,
) -> wgpu::RenderPass<'e> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("overlay"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}

/// Kind of primitive that a pipeline draws.
#[derive(Clone, Copy)]
enum Primitive {
    /// The scene, into the depth only.
    Depth { cull_mode: Option<wgpu::Face> },
    /// Lines or triangles over the picture.
    Marks(wgpu::PrimitiveTopology),
}

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    output_format: wgpu::TextureFormat,
    drawn: Primitive,
) -> wgpu::RenderPipeline {
    const MARK: wgpu::VertexBufferLayout<'_> = wgpu::VertexBufferLayout {
        array_stride: size_of::<Mark>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Unorm8x4],
    };
    let (label, vertex, fragment, buffer, writes) = match drawn {
        Primitive::Depth { .. } => ("overlay depth", "solid", "unseen", GpuVertex::LAYOUT, wgpu::ColorWrites::empty()),
        Primitive::Marks(_) => ("overlay marks", "mark", "tint", MARK, wgpu::ColorWrites::ALL),
    };
    let primitive = match drawn {
        Primitive::Depth { cull_mode } => wgpu::PrimitiveState { cull_mode, ..Default::default() },
        Primitive::Marks(topology) => wgpu::PrimitiveState { topology, ..Default::default() },
    };
    let constants = [("TARGET_ENCODES", f64::from(u8::from(output_format.is_srgb())))];
    let blend = Some(wgpu::BlendState::ALPHA_BLENDING);
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: Default::default(),
            buffers: &[Some(buffer)],
        },
        primitive,
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(matches!(drawn, Primitive::Depth { .. })),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(fragment),
            compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
            targets: &[Some(wgpu::ColorTargetState { format: output_format, blend, write_mask: writes })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
