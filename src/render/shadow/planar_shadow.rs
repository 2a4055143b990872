//! Planar shadow pass: casters flattened on to a few large planes (Blinn 1988, "Me and My (Fake) Shadow").
//!
//! Receivers are chosen by area. Each cure of a text book's fault has a switch: a stencil mark keeps the shadow on its
//! receiver (else it sticks out into the air beyond), the mark also stands in for the depth test (else the shadow fights
//! with its receiver for depth), a point is darkened once however many casters lie over it, and casters are cut at the
//! plane and at the light's height (else what is below throws shadows up, and what is above the light throws some too).
//! Deliberately absent: shadows on anything but planes.

use std::collections::BTreeSet;

use glam::Vec4;
use wgpu::util::DeviceExt;

use super::flattening::{Receiver, flattened, is_same_plane, plane_of, receivers};
use super::pipeline::{CORNER, PipelineRecipe, against_depth};
use super::real_time::Subject;
use crate::base::ids::{InstanceId, TriangleId};
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::scene::Scene;

/// Receivers, and casters flattened on to them.
pub(in crate::render) const PLANAR_SHADOW: Shader = shader!("planar shadow", "shared/frame.wgsl", "planar_shadow.wgsl");

/// Stencil bits that count shadows.
pub const SHADOWS: u32 = 0x07;
/// Stencil bits that tell which receiver a point is on, counted from 1.
pub const ON_RECEIVER: u32 = 0xf8;
/// One receiver.
const RECEIVER: u32 = 0x08;
/// Most receivers that the stencil can tell apart.
pub const MAX_RECEIVERS: usize = 31;
/// Lifts shadows that are free to stick out over their receivers.
const LIFT: wgpu::DepthBiasState = wgpu::DepthBiasState { constant: 16, slope_scale: 1.0, clamp: 0.0 };
/// What is within this share of the scene's extent of a plane lies in it.
const CLEARANCE: f32 = 2e-5;

/// How planar shadows are drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarSettings {
    /// How many planes receive shadows where none are chosen: the largest.
    pub num_receivers: usize,
    /// Planes that are chosen to receive shadows, as [`plane_of`] tells them.
    pub receivers: Vec<Vec4>,
    /// Instances that are chosen to throw shadows; where there are none, all do.
    pub casters: BTreeSet<InstanceId>,
    /// Shadows stay on their receivers; off lets them stick out.
    pub stays_on_receiver: bool,
    /// Shadows do not fight with their receivers for depth.
    pub is_free_of_depth: bool,
    /// Where several casters overlap it is as dark as under one.
    pub darkens_once: bool,
    /// Casters are cut at the plane and at the height of the light; off throws anti-shadows.
    pub clips_casters: bool,
}

impl Default for PlanarSettings {
    fn default() -> Self {
        Self {
            num_receivers: 8,
            receivers: Vec::new(),
            casters: BTreeSet::new(),
            stays_on_receiver: true,
            is_free_of_depth: true,
            darkens_once: true,
            clips_casters: true,
        }
    }
}

impl PlanarSettings {
    /// Chooses the plane of a triangle to receive shadows, or drops it again.
    pub fn toggle_receiver(&mut self, scene: &Scene, triangle: TriangleId) {
        let Some(plane) = plane_of(scene, triangle) else { return };
        let extent = scene.bounds().extent();
        let before = self.receivers.len();
        self.receivers.retain(|&chosen| !is_same_plane(chosen, plane, extent));
        if self.receivers.len() == before {
            self.receivers.push(plane);
        }
    }

    /// Chooses an instance to throw shadows, or drops it again.
    pub fn toggle_caster(&mut self, instance: InstanceId) {
        if !self.casters.remove(&instance) {
            self.casters.insert(instance);
        }
    }
}

/// Planar shadow pass.
pub struct PlanarShadowPass {
    layout: wgpu::PipelineLayout,
    module: wgpu::ShaderModule,
    samples: u32,
    mark: wgpu::RenderPipeline,
    shadow: Option<(PlanarSettings, wgpu::RenderPipeline)>,
    receivers: Vec<(Receiver, wgpu::Buffer)>,
}

impl PlanarShadowPass {
    /// Pipelines for targets with `samples` samples a pixel.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout, samples: u32) -> Self {
        let module = PLANAR_SHADOW.module(gpu);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("planar shadow"),
            bind_group_layouts: &[Some(frame_layout)],
            immediate_size: 0,
        });
        let on_receiver = against_depth(gpu, wgpu::CompareFunction::Equal, mark_stencil(), Default::default());
        let mark = pipeline(gpu, &layout, &module, samples, on_receiver);
        Self { layout, module, samples, mark, shadow: None, receivers: Vec::new() }
    }

    /// Chooses the receivers of a scene.
    pub fn prepare(&mut self, gpu: &Gpu, subject: Subject<'_>, settings: &PlanarSettings) {
        let scene = subject.shadows.scene();
        let upload = |receiver: Receiver| {
            let corners: Vec<Vec4> =
                receiver.triangles.iter().flat_map(|&id| scene.corners(id)).map(|corner| corner.extend(1.0)).collect();
            let buffer = vertex_buffer(gpu, &corners);
            (receiver, buffer)
        };
        self.receivers = receivers(scene, settings).into_iter().take(MAX_RECEIVERS).map(upload).collect();
        if self.shadow.as_ref().is_none_or(|(known, _)| known != settings) {
            let (compare, bias) = match (settings.is_free_of_depth, settings.stays_on_receiver) {
                (true, true) => (wgpu::CompareFunction::Always, Default::default()),
                (true, false) => (wgpu::CompareFunction::GreaterEqual, LIFT),
                (false, _) => (wgpu::CompareFunction::GreaterEqual, Default::default()),
            };
            let tests = against_depth(gpu, compare, shadow_stencil(settings), bias);
            let pipeline = pipeline(gpu, &self.layout, &self.module, self.samples, tests);
            self.shadow = Some((settings.clone(), pipeline));
        }
    }

    /// Marks the shadows that a light at `light` throws on the receivers, in a pass with cleared stencil to which bind
    /// group 0 is set.
    pub fn draw(&self, gpu: &Gpu, pass: &mut wgpu::RenderPass<'_>, subject: Subject<'_>, light: Vec4) {
        let (settings, shadow) = self.shadow.as_ref().expect("receivers have been chosen");
        let clearance = CLEARANCE * subject.shadows.scene().bounds().extent();
        for ((receiver, corners), number) in self.receivers.iter().zip(1..) {
            // Which pixels are on this receiver.
            pass.set_stencil_reference(RECEIVER * number);
            draw(pass, &self.mark, corners);
            // What stands between them and the light; a light behind the plane lights it not at all.
            if receiver.plane.dot(light) <= clearance * light.w {
                continue;
            }
            let shadows = flattened(&subject.shadows.casters, receiver.plane, light, settings, clearance);
            if !shadows.is_empty() {
                pass.set_stencil_reference(RECEIVER * number + 1);
                draw(pass, shadow, &vertex_buffer(gpu, &shadows));
            }
        }
    }
}

fn draw(pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline, corners: &wgpu::Buffer) {
    pass.set_pipeline(pipeline);
    pass.set_vertex_buffer(0, corners.slice(..));
    pass.draw(0..(corners.size() / size_of::<Vec4>() as u64) as u32, 0..1);
}

fn vertex_buffer(gpu: &Gpu, corners: &[Vec4]) -> wgpu::Buffer {
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("planar shadow"),
        contents: bytemuck::cast_slice(corners),
        usage: wgpu::BufferUsages::VERTEX,
    })
}

/// Both faces write the receiver's number over what is visible.
fn mark_stencil() -> wgpu::StencilState {
    let face = stencil_face(wgpu::CompareFunction::Always, wgpu::StencilOperation::Replace);
    wgpu::StencilState { front: face, back: face, read_mask: !0, write_mask: ON_RECEIVER }
}

fn shadow_stencil(settings: &PlanarSettings) -> wgpu::StencilState {
    use wgpu::StencilOperation::{IncrementClamp, Replace};
    let on_receiver = wgpu::CompareFunction::Equal;
    let compare = if settings.stays_on_receiver { on_receiver } else { wgpu::CompareFunction::Always };
    let face = stencil_face(compare, if settings.darkens_once { Replace } else { IncrementClamp });
    wgpu::StencilState { front: face, back: face, read_mask: ON_RECEIVER, write_mask: SHADOWS }
}

fn stencil_face(compare: wgpu::CompareFunction, pass_op: wgpu::StencilOperation) -> wgpu::StencilFaceState {
    let keep = wgpu::StencilOperation::Keep;
    wgpu::StencilFaceState { compare, fail_op: keep, depth_fail_op: keep, pass_op }
}

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    samples: u32,
    depth_stencil: wgpu::DepthStencilState,
) -> wgpu::RenderPipeline {
    PipelineRecipe {
        vertex: Some(CORNER),
        depth_stencil: Some(depth_stencil),
        samples,
        ..PipelineRecipe::new("planar shadow", layout, module)
    }
    .make(gpu)
}
