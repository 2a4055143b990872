//! Visible points pass: where the surfaces are that the depth prepass has found, and how they are turned.

use glam::Vec3;

use super::light_targets::LightTargets;
use super::pipeline::{PipelineRecipe, against_depth, culling};
use super::solid::SolidPipelines;
use crate::gpu::readback::read_texture;
use crate::gpu::shader::{Shader, shader};
use crate::gpu::{Gpu, GpuError};
use crate::render::RenderSettings;
use crate::render::scene::SceneBuffers;

/// Places and normals of visible points.
pub(in crate::render) const VISIBLE_POINTS: Shader =
    shader!("visible points", "shared/frame.wgsl", "shared/visible_point.wgsl", "shared/facet.wgsl", "raytraced.wgsl");

/// A visible point.
#[derive(Clone, Copy, Debug)]
pub struct VisiblePoint {
    /// Metres.
    pub point: Vec3,
    /// Unit shading normal on the side that is seen.
    pub normal: Vec3,
}

/// Finds visible points.
pub struct VisiblePoints {
    pipelines: SolidPipelines,
}

impl VisiblePoints {
    /// Pipelines for targets with one sample a pixel.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout) -> Self {
        let module = VISIBLE_POINTS.module(gpu);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("visible points"),
            bind_group_layouts: &[Some(frame_layout)],
            immediate_size: 0,
        });
        Self { pipelines: SolidPipelines::new(|cull| pipeline(gpu, &layout, &module, cull)) }
    }

    /// The visible point of each pixel, after the depth prepass has been submitted.
    ///
    /// # Errors
    /// The device was lost.
    pub fn find(
        &self,
        gpu: &Gpu,
        targets: &LightTargets,
        frame: &wgpu::BindGroup,
        scene: &SceneBuffers,
        settings: &RenderSettings,
    ) -> Result<Vec<Option<VisiblePoint>>, GpuError> {
        let textures = [texture(gpu, targets.size), texture(gpu, targets.size)];
        let mut encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("visible points") });
        self.draw(
            &mut encoder,
            targets,
            &textures.each_ref().map(|t| t.create_view(&Default::default())),
            frame,
            scene,
            settings,
        );
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
        targets: &LightTargets,
        views: &[wgpu::TextureView; 2],
        frame: &wgpu::BindGroup,
        scene: &SceneBuffers,
        settings: &RenderSettings,
    ) {
        let attachments = views.each_ref().map(|view| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("visible points"),
            color_attachments: &attachments,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.depth_stencil,
                depth_ops: None,
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, frame, &[]);
        self.pipelines.draw(&mut pass, scene, settings);
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

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    cull_mode: Option<wgpu::Face>,
) -> wgpu::RenderPipeline {
    let target = Some(wgpu::TextureFormat::Rgba32Float.into());
    let visible = against_depth(gpu, wgpu::CompareFunction::Equal, Default::default(), Default::default());
    PipelineRecipe {
        fragment: Some(("fragment", &[target.clone(), target])),
        primitive: culling(cull_mode),
        depth_stencil: Some(visible),
        ..PipelineRecipe::new("visible points", layout, module)
    }
    .make(gpu)
}
