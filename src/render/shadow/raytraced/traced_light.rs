//! Direct light by rays to all light samples.

use glam::{DVec3, DVec4, Vec3, Vec4};
use rayon::prelude::*;
use wgpu::util::DeviceExt;

use super::pixel_rays::PixelRays;
use super::ray_origin::{RayOrigin, front_normal};
use super::visible_points::{VisiblePoint, VisiblePoints};
use crate::gpu::{Gpu, GpuError};
use crate::render::shadow::light::sample::LightSample;
use crate::render::shadow::light::targets::LightTargets;
use crate::render::shadow::shared::depth_prepass::DepthPrepass;
use crate::render::shadow::shared::exact_rays::Line;
use crate::render::shadow::shared::frame_context::FrameContext;

/// Direct light by rays, for pictures of any number of samples a pixel.
pub struct RaytracedLight {
    prepass: DepthPrepass,
    points: VisiblePoints,
    targets: Option<LightTargets>,
    /// Irradiance of the last picture.
    irradiance: Vec<Vec4>,
}

impl RaytracedLight {
    /// Creates the passes that find visible points.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout) -> Self {
        Self {
            prepass: DepthPrepass::new(gpu, frame_layout, 1),
            points: VisiblePoints::new(gpu, frame_layout),
            targets: None,
            irradiance: Vec::new(),
        }
    }

    /// Frees the textures of visible points, until a picture needs them again.
    pub fn release_targets(&mut self) {
        self.targets = None;
    }

    /// Returns a texture of irradiance times pre-exposure. Its fourth channel counts the visible samples. If
    /// `adds_to_last` is true, the last picture is added. If the device was lost, the texture is black, and the next
    /// read-back reports the loss.
    pub fn draw(&mut self, frame: FrameContext<'_>, samples: &[LightSample], adds_to_last: bool) -> wgpu::TextureView {
        let origins = self.origins(frame).unwrap_or_default();
        let irradiance_at = |origin: &RayOrigin| {
            let mut sum = Vec4::ZERO;
            for sample in samples {
                let received = received(frame, &origin.visible, sample);
                if received.max_element() > 0.0 && is_lit(frame, origin, sample) {
                    sum += (received * frame.scene.pre_exposure).extend(1.0);
                }
            }
            sum
        };
        let mut irradiance: Vec<Vec4> =
            origins.par_iter().map(|origin| origin.as_ref().map_or(Vec4::ZERO, irradiance_at)).collect();
        irradiance.resize((frame.size[0] * frame.size[1]) as usize, Vec4::ZERO);
        if adds_to_last {
            irradiance.iter_mut().zip(&self.irradiance).for_each(|(sum, last)| *sum += last);
        }
        self.irradiance = irradiance;
        upload(frame, &self.irradiance)
    }

    /// Returns for each light sample whether it lights a pixel, `[sample][pixel]`.
    ///
    /// # Errors
    /// Returns an error if the device was lost.
    pub fn decisions(&mut self, frame: FrameContext<'_>, samples: &[LightSample]) -> Result<Vec<Vec<bool>>, GpuError> {
        let origins = self.origins(frame)?;
        let lights = |sample: &LightSample, origin: &RayOrigin| {
            received(frame, &origin.visible, sample).max_element() > 0.0 && is_lit(frame, origin, sample)
        };
        let of_sample = |sample| {
            origins.par_iter().map(|origin| origin.as_ref().is_some_and(|origin| lights(sample, origin))).collect()
        };
        Ok(samples.iter().map(of_sample).collect())
    }

    fn origins(&mut self, frame: FrameContext<'_>) -> Result<Vec<Option<RayOrigin>>, GpuError> {
        let (gpu, size) = (frame.gpu, frame.size);
        let targets = match self.targets.take() {
            Some(targets) if targets.size == size => targets,
            _ => LightTargets::new(gpu, size, 1),
        };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.prepass.draw(&mut encoder, &targets.depth_stencil, frame);
        gpu.queue.submit([encoder.finish()]);
        let points = self.points.find(&targets.depth_stencil, frame);
        self.targets = Some(targets);
        let lines = PixelRays::new(frame.view, size);
        let rays = frame.shadows.rays();
        let origin = |(pixel, visible): (usize, Option<VisiblePoint>)| {
            visible.map(|visible| RayOrigin::new(rays, &lines, pixel, visible))
        };
        Ok(points?.into_par_iter().enumerate().map(origin).collect())
    }
}

/// Returns the unshadowed irradiance of a light sample, dimmed with its light group.
fn received(frame: FrameContext<'_>, visible: &VisiblePoint, sample: &LightSample) -> Vec3 {
    sample.irradiance(visible.point, visible.normal) * frame.render_settings.group_weight(sample.light.group)
}

/// Returns true if a visible point faces the light with the side that the eye sees, and nothing solid stands between
/// the point and the light sample.
fn is_lit(frame: FrameContext<'_>, origin: &RayOrigin, sample: &LightSample) -> bool {
    let light = sample.position().as_dvec4();
    let eye = frame.view.eye().as_dvec4();
    if origin.triangle.is_some_and(|corners| turns_its_back(corners, eye, light)) {
        return false;
    }
    !frame.shadows.rays().is_blocked(Line::between(origin.origin, light))
}

/// Returns true if the eye and the light, both homogeneous, are on different sides of a triangle.
fn turns_its_back(corners: [DVec3; 3], eye: DVec4, light: DVec4) -> bool {
    let normal = front_normal(corners);
    let height = |position: DVec4| normal.dot(position.truncate() - position.w * corners[0]);
    height(eye) * height(light) < 0.0
}

/// Uploads irradiance as a texture of one sample a pixel.
fn upload(frame: FrameContext<'_>, irradiance: &[Vec4]) -> wgpu::TextureView {
    let FrameContext { gpu, size, .. } = frame;
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
