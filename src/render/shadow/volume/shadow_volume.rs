//! Shadow volume pass: counts in the stencil the number of volumes that each visible point is in.
//!
//! The volumes of a light are cached while neither light nor casters move; with [`VolumeSettings::near_plane_cure`]
//! those of z-pass depend on the view as well. An orthographic view has a far plane, which cuts volumes off as
//! [`VolumeSettings::far_plane`] does.

use std::collections::HashMap;
use std::ops::Range;

use glam::Vec4;
use rayon::prelude::*;
use wgpu::util::DeviceExt;

use super::hull::{Counting, Hull};
use super::settings::VolumeSettings;
use super::stencil::VolumePipelines;
use super::volumes::{Viewpoint, Volumes};
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::shadow::light::pass_setup::PassSetup;
use crate::render::shadow::shared::casters::Casters;
use crate::render::shadow::shared::frame_context::FrameContext;
use crate::render::shadow::shared::scene::SceneData;

const SHADOW_VOLUME: Shader = shader!(
    "shadow volume",
    "shared/frame.wgsl",
    "shadow/light/light_sample.wgsl",
    "shadow/light/one_light.wgsl",
    "shadow/volume/shadow_volume.wgsl"
);
/// Stencil value of a point whose triangle faces away from the light.
const DARK: u32 = 1;

/// Shadow volume pass.
pub struct ShadowVolumePass {
    setup: PassSetup,
    module: wgpu::ShaderModule,
    counting: Counting,
    pipelines: VolumePipelines,
    /// Pipelines that cut volumes off, and the distance of their far plane, metres.
    cut_off: Option<(f32, VolumePipelines)>,
    volumes: HashMap<VolumeKey, VolumeBuffers>,
}

/// Everything that the volumes of a light depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct VolumeKey {
    /// Bits of the homogeneous position of the light.
    light: [u32; 4],
    /// Bits of the projection, and whether backs are culled; `None` if the volumes do not depend on the view.
    view: Option<([u32; 16], bool)>,
    is_joined: bool,
}

/// [`Volumes`] on the device.
struct VolumeBuffers {
    depth_pass: HullBuffer,
    depth_fail: HullBuffer,
    terminator: HullBuffer,
}

/// A [`Hull`] as one index buffer.
struct HullBuffer {
    indices: wgpu::Buffer,
    counter_clockwise: Range<u32>,
    clockwise: Range<u32>,
}

/// Corners of the casters of a scene on the device, in the order of the indices of [`Hull`]. Each is stored twice: with
/// w = 0 for the corner at its own position, and with w = 1 for the corner moved to infinity. Here w is a flag and not
/// the homogeneous coordinate.
struct CornerBuffer(wgpu::Buffer);

impl SceneData for CornerBuffer {}

impl CornerBuffer {
    fn new(gpu: &Gpu, casters: &Casters) -> Self {
        let corners: Vec<Vec4> = casters.positions.iter().flat_map(|p| [0.0, 1.0].map(|w| p.extend(w))).collect();
        Self(gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("corners of casters"),
            contents: bytemuck::cast_slice(&corners),
            usage: wgpu::BufferUsages::VERTEX,
        }))
    }
}

impl ShadowVolumePass {
    /// Creates pipelines for volumes that are counted by `counting`.
    pub fn new(gpu: &Gpu, setup: &PassSetup, counting: Counting) -> Self {
        let module = SHADOW_VOLUME.module(gpu);
        let pipelines = VolumePipelines::new(gpu, setup, &module, None);
        Self { setup: setup.clone(), module, counting, pipelines, cut_off: None, volumes: HashMap::new() }
    }

    /// Computes the volumes of all lights at homogeneous positions, except those that are cached.
    pub fn prepare(&mut self, frame: FrameContext<'_>, lights: &[Vec4], settings: &VolumeSettings) {
        if let Some(distance) = settings.far_plane
            && self.cut_off.as_ref().is_none_or(|(known, _)| *known != distance)
        {
            let far_depth = frame.view.depth_at(distance);
            self.cut_off =
                Some((distance, VolumePipelines::new(frame.gpu, &self.setup, &self.module, Some(far_depth))));
        }
        let needed: HashMap<VolumeKey, Vec4> =
            lights.iter().map(|&light| (self.key(frame, light, settings), light)).collect();
        self.volumes.retain(|key, _| needed.contains_key(key));
        let missing: Vec<_> = needed.into_iter().filter(|(key, _)| !self.volumes.contains_key(key)).collect();
        let (casters, viewpoint, counting) = (frame.shadows.casters(), Viewpoint::new(frame), self.counting);
        let computed: Vec<_> = missing
            .par_iter()
            .map(|&(key, light)| (key, Volumes::new(casters, &viewpoint, light, counting, settings)))
            .collect();
        self.volumes.extend(computed.into_iter().map(|(key, volumes)| (key, VolumeBuffers::new(frame.gpu, &volumes))));
    }

    /// Drops the volumes of the last scene.
    pub fn clear_scene(&mut self) {
        self.volumes.clear();
    }

    /// Counts the volumes of a light. The stencil of the pass must be cleared and bind groups 0 and 1 set.
    pub fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        frame: FrameContext<'_>,
        light: Vec4,
        settings: &VolumeSettings,
    ) {
        let key = self.key(frame, light, settings);
        let volumes = self.volumes.get(&key).expect("the volumes of all lights have been prepared");
        let pipelines = match (&self.cut_off, settings.far_plane) {
            (Some((_, cut_off)), Some(_)) => cut_off,
            _ => &self.pipelines,
        };
        let corners = frame.shadows.kept(|| CornerBuffer::new(frame.gpu, frame.shadows.casters()));
        pass.set_vertex_buffer(0, corners.0.slice(..));
        volumes.depth_fail.draw(pass, &pipelines.depth_fail);
        volumes.depth_pass.draw(pass, &pipelines.depth_pass);
        pass.set_stencil_reference(DARK);
        volumes.terminator.draw(pass, &pipelines.terminator);
    }

    fn key(&self, frame: FrameContext<'_>, light: Vec4, settings: &VolumeSettings) -> VolumeKey {
        let depends_on_view = self.counting == Counting::DepthPass && settings.near_plane_cure;
        let projection = || frame.view.projection_from_world().to_cols_array().map(f32::to_bits);
        VolumeKey {
            light: light.to_array().map(f32::to_bits),
            view: depends_on_view.then(|| (projection(), frame.render_settings.cull_back)),
            is_joined: settings.joined,
        }
    }
}

impl VolumeBuffers {
    fn new(gpu: &Gpu, volumes: &Volumes) -> Self {
        Self {
            depth_pass: HullBuffer::new(gpu, &volumes.depth_pass),
            depth_fail: HullBuffer::new(gpu, &volumes.depth_fail),
            terminator: HullBuffer::new(gpu, &volumes.terminator),
        }
    }
}

impl HullBuffer {
    fn new(gpu: &Gpu, hull: &Hull) -> Self {
        let middle = hull.counter_clockwise.len() as u32;
        let end = middle + hull.clockwise.len() as u32;
        let indices = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("shadow volumes"),
            contents: bytemuck::cast_slice(&[hull.counter_clockwise.as_slice(), &hull.clockwise].concat()),
            usage: wgpu::BufferUsages::INDEX,
        });
        Self { indices, counter_clockwise: 0..middle, clockwise: middle..end }
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, pipelines: &[wgpu::RenderPipeline; 2]) {
        let parts = pipelines.iter().zip([&self.counter_clockwise, &self.clockwise]);
        for (pipeline, range) in parts.filter(|(_, range)| !range.is_empty()) {
            pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.set_pipeline(pipeline);
            pass.draw_indexed(range.clone(), 0, 0..1);
        }
    }
}
