//! Visible points pass: finds position and normal of the surface in each pixel, after the depth prepass.

use glam::Vec3;

use crate::gpu::readback::read_texture;
use crate::gpu::shader::{Shader, shader};
use crate::gpu::{Gpu, GpuError};
use crate::render::shadow::shared::frame_context::FrameContext;
use crate::render::shadow::shared::pipeline::{PipelineRecipe, against_depth, culling, pipeline_layout};
use crate::render::shadow::shared::solid_surfaces::SolidPipelines;

const VISIBLE_POINTS: Shader = shader!(
    "visible points",
    "shared/frame.wgsl",
    "shadow/shared/visible_point.wgsl",
    "shadow/light/facet.wgsl",
    "shadow/raytraced/visible_points.wgsl"
);

/// The visible point of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct VisiblePoint {
    /// Position, metres.
    pub point: Vec3,
    /// Unit shading normal on the visible side.
    pub normal: Vec3,
}

/// Finds visible points.
pub struct VisiblePoints {
    pipelines: SolidPipelines,
}

impl VisiblePoints {
    /// Creates pipelines for targets with one sample a pixel.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout) -> Self {
        let module = VISIBLE_POINTS.module(gpu);
        let layout = pipeline_layout(gpu, "visible points", &[Some(frame_layout)]);
        let target = Some(wgpu::TextureFormat::Rgba32Float.into());
        let pipelines = SolidPipelines::new(|cull_mode| {
            let equal = wgpu::CompareFunction::Equal;
            PipelineRecipe {
                fragment: Some(("fragment", &[target.clone(), target.clone()])),
                primitive: culling(cull_mode),
                depth_stencil: Some(against_depth(gpu, equal, Default::default(), Default::default())),
                ..PipelineRecipe::new("visible points", &layout, &module)
            }
            .make(gpu)
        });
        Self { pipelines }
    }

    /// Returns the visible point of each pixel. `depth_stencil` is that of a depth prepass that has been submitted.
    ///
    /// # Errors
    /// Returns an error if the device was lost.
    pub fn find(
        &self,
        depth_stencil: &wgpu::TextureView,
        frame: FrameContext<'_>,
    ) -> Result<Vec<Option<VisiblePoint>>, GpuError> {
        let gpu = frame.gpu;
        let textures = [texture(gpu, frame.size), texture(gpu, frame.size)];
        let mut encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("visible points") });
        self.draw(&mut encoder, depth_stencil, &textures.each_ref().map(|t| t.create_view(&Default::default())), frame);
        gpu.queue.submit([encoder.finish()]);
        let points = read_texture(gpu, &textures[0], 16)?;
        let normals = read_texture(gpu, &textures[1], 16)?;
        let pixel = |(point, normal): (&[u8; 16], &[u8; 16])| {
            let ([x, y, z, is_there], [nx, ny, nz, _]) = (floats(point), floats(normal));
            (is_there > 0.0).then_some(VisiblePoint { point: Vec3::new(x, y, z), normal: Vec3::new(nx, ny, nz) })
        };
        Ok(points.as_chunks::<16>().0.iter().zip(normals.as_chunks::<16>().0).map(pixel).collect())
    }

    fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        depth_stencil: &wgpu::TextureView,
        views: &[wgpu::TextureView; 2],
        frame: FrameContext<'_>,
    ) {
        let clear = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        let attachments = views.each_ref().map(|view| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: clear, store: wgpu::StoreOp::Store },
            })
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("visible points"),
            color_attachments: &attachments,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: depth_stencil,
                depth_ops: None,
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, frame.bindings, &[]);
        self.pipelines.draw(&mut pass, frame.in_view, frame.render_settings);
    }
}

fn floats(bytes: &[u8; 16]) -> [f32; 4] {
    std::array::from_fn(|i| f32::from_le_bytes([bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]]))
}

fn texture(gpu: &Gpu, size: [u32; 2]) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("visible points"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}
