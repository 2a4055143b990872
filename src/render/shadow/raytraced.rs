//! Ray-traced shadows: the truth. One ray from each visible point to each light sample, on the CPU.
//!
//! The points are those that the depth prepass found, at the middle of each pixel, so that nothing but the shadow
//! differs from the other techniques. With several samples a pixel all of them share that one point.

use glam::{Vec3, Vec4};
use rayon::prelude::*;
use wgpu::util::DeviceExt;

use super::depth_prepass::DepthPrepass;
use super::light_samples::LightSample;
use super::light_targets::{LightTargets, depth_stencil_format};
use super::real_time::Subject;
use super::solid::SolidPipelines;
use crate::base::ids::TriangleId;
use crate::gpu::readback::read_texture;
use crate::gpu::scene_buffers::GpuVertex;
use crate::gpu::{Gpu, GpuError, SceneBuffers, shaders};
use crate::render::{Look, View};
use crate::trace::Tracer;

/// A ray begins this share of the way from its point to the eye: on the side that is seen, beyond rounding.
const TOWARDS_EYE: f32 = 1e-5;

/// A visible point.
#[derive(Clone, Copy, Debug)]
struct VisiblePoint {
    /// Metres.
    point: Vec3,
    /// Unit shading normal on the side that is seen.
    normal: Vec3,
    /// The triangle on which it lies, where a ray from the eye finds it again.
    triangle: Option<TriangleId>,
}

/// Finds visible points.
struct VisiblePoints {
    pipelines: SolidPipelines,
}

impl VisiblePoints {
    /// Pipelines for targets with one sample a pixel.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout) -> Self {
        let module = shaders::VISIBLE_POINTS.module(&gpu.device);
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
        look: &Look,
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
            look,
        );
        gpu.queue.submit([encoder.finish()]);
        let points = read_texture(gpu, &textures[0], 16)?;
        let normals = read_texture(gpu, &textures[1], 16)?;
        let pixel = |(point, normal): (&[u8; 16], &[u8; 16])| {
            let ([x, y, z, is_there], [nx, ny, nz, _]) = (floats(point), floats(normal));
            (is_there > 0.0).then_some(VisiblePoint {
                point: Vec3::new(x, y, z),
                normal: Vec3::new(nx, ny, nz),
                triangle: None,
            })
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
        look: &Look,
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
        self.pipelines.draw(&mut pass, scene, look);
    }
}

/// Direct light by rays, for pictures of any number of samples a pixel.
pub struct RaytracedLight {
    prepass: DepthPrepass,
    points: VisiblePoints,
    targets: Option<LightTargets>,
}

impl RaytracedLight {
    /// Passes that find the points from which rays begin.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout) -> Self {
        Self {
            prepass: DepthPrepass::new(gpu, frame_layout, 1),
            points: VisiblePoints::new(gpu, frame_layout),
            targets: None,
        }
    }

    /// Irradiance times pre-exposure, the fourth channel counting the samples seen; black where the device was lost,
    /// which the next read-back tells.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        size: [u32; 2],
        subject: Subject<'_>,
        samples: &[LightSample],
    ) -> wgpu::TextureView {
        let tracer = Tracer::new(subject.shadows.scene());
        let points = self.points(gpu, size, subject, &tracer).unwrap_or_default();
        let of = |visible: &VisiblePoint| {
            let mut sum = Vec4::ZERO;
            for sample in samples {
                let received = received(subject, visible, sample);
                if received.max_element() > 0.0 && is_lit(&tracer, subject.view, visible, sample) {
                    sum += (received * subject.scene.pre_exposure).extend(1.0);
                }
            }
            sum
        };
        let mut irradiance: Vec<Vec4> = points.par_iter().map(|point| point.as_ref().map_or(Vec4::ZERO, of)).collect();
        irradiance.resize((size[0] * size[1]) as usize, Vec4::ZERO);
        upload(gpu, size, &irradiance)
    }

    /// Which pixels each light sample lights, `[sample][pixel]`.
    ///
    /// # Errors
    /// The device was lost.
    pub fn decisions(
        &mut self,
        gpu: &Gpu,
        size: [u32; 2],
        subject: Subject<'_>,
        samples: &[LightSample],
    ) -> Result<Vec<Vec<bool>>, GpuError> {
        let tracer = Tracer::new(subject.shadows.scene());
        let points = self.points(gpu, size, subject, &tracer)?;
        let lights = |sample: &LightSample, visible: &VisiblePoint| {
            received(subject, visible, sample).max_element() > 0.0 && is_lit(&tracer, subject.view, visible, sample)
        };
        let of_sample = |sample| {
            points.par_iter().map(|point| point.as_ref().is_some_and(|visible| lights(sample, visible))).collect()
        };
        Ok(samples.iter().map(of_sample).collect())
    }

    fn points(
        &mut self,
        gpu: &Gpu,
        size: [u32; 2],
        subject: Subject<'_>,
        tracer: &Tracer<'_>,
    ) -> Result<Vec<Option<VisiblePoint>>, GpuError> {
        let targets = match self.targets.take() {
            Some(targets) if targets.size == size => targets,
            _ => LightTargets::new(gpu, size, 1),
        };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.prepass.draw(&mut encoder, &targets, subject.frame, subject.scene, subject.look);
        gpu.queue.submit([encoder.finish()]);
        let points = self.points.find(gpu, &targets, subject.frame, subject.scene, subject.look);
        self.targets = Some(targets);
        let mut points = points?;
        points
            .par_iter_mut()
            .flatten()
            .for_each(|point| point.triangle = triangle_at(tracer, subject.view, point.point));
        Ok(points)
    }
}

/// Irradiance of a light sample where nothing stands between.
fn received(subject: Subject<'_>, visible: &VisiblePoint, sample: &LightSample) -> Vec3 {
    sample.irradiance(visible.point, visible.normal) * subject.look.group_weight(sample.light.group)
}

/// The triangle that the eye sees at a point.
fn triangle_at(tracer: &Tracer<'_>, view: &View, point: Vec3) -> Option<TriangleId> {
    let back = 10.0 * TOWARDS_EYE * view.towards_eye(point);
    tracer.nearest(point + back, -back, 2.0).map(|hit| hit.triangle)
}

/// Nothing solid stands between a visible point and a light sample, and its triangle shows the light the side it shows
/// the eye.
fn is_lit(tracer: &Tracer<'_>, view: &View, visible: &VisiblePoint, sample: &LightSample) -> bool {
    let place = sample.place();
    if visible.triangle.is_some_and(|id| turns_its_back(tracer.scene().corners(id), view.eye(), place)) {
        return false;
    }
    let origin = visible.point + TOWARDS_EYE * view.towards_eye(visible.point);
    if place.w == 0.0 {
        return tracer.nearest(origin, place.truncate(), f32::INFINITY).is_none();
    }
    let to_light = place.truncate() - origin;
    tracer.nearest(origin, to_light.normalize_or_zero(), to_light.length()).is_none()
}

/// The eye and the light, both homogeneous, are on different sides of a triangle. In double precision, as a ray cannot
/// tell where light grazes the triangle.
fn turns_its_back(corners: [Vec3; 3], eye: Vec4, light: Vec4) -> bool {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let normal = (b - a).cross(c - a);
    let height = |place: Vec4| normal.dot(place.truncate().as_dvec3() - f64::from(place.w) * a);
    height(eye) * height(light) < 0.0
}

/// A texture of one sample a pixel that holds irradiance.
fn upload(gpu: &Gpu, size: [u32; 2], irradiance: &[Vec4]) -> wgpu::TextureView {
    let descriptor = wgpu::TextureDescriptor {
        label: Some("ray-traced irradiance"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &descriptor,
        Default::default(),
        bytemuck::cast_slice(irradiance),
    );
    texture.create_view(&Default::default())
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
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("visible points"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(GpuVertex::LAYOUT)],
        },
        primitive: wgpu::PrimitiveState { cull_mode, ..Default::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: depth_stencil_format(gpu),
            depth_write_enabled: Some(false),
            depth_compare: Some(wgpu::CompareFunction::Equal),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &[target.clone(), target],
        }),
        multiview_mask: None,
        cache: None,
    })
}
