//! Planar shadow pass: casters flattened on to a few large planes (Blinn 1988, "Me and My (Fake) Shadow").
//!
//! Receivers are chosen by area. Each cure of a text book's fault has a switch: a stencil mark keeps the shadow on its
//! receiver (else it sticks out into the air beyond), the mark also stands in for the depth test (else the shadow fights
//! with its receiver for depth), a point is darkened once however many casters lie over it, and casters are cut at the
//! plane and at the light's height (else what is below throws shadows up, and what is above the light throws some too).
//! Deliberately absent: shadows on anything but planes.

use std::collections::HashMap;

use glam::{Mat4, Vec3, Vec4};
use wgpu::util::DeviceExt;

use super::casters::Casters;
use super::light_targets::depth_stencil_format;
use super::real_time::Subject;
use crate::base::ids::TriangleId;
use crate::gpu::{Gpu, shaders};
use crate::scene::{AlphaMode, Scene, area_of, normal_of};

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
/// Normals closer than this are one direction; distances by this share of the scene's extent are one plane.
const SAME_NORMAL: f32 = 1e-4;
const SAME_DISTANCE: f32 = 1e-5;
/// Casters within this share of the scene's extent of a plane lie in it.
const CLEARANCE: f32 = 2e-5;

/// How planar shadows are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlanarSettings {
    /// How many planes receive shadows: the largest.
    pub num_receivers: usize,
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
            stays_on_receiver: true,
            is_free_of_depth: true,
            darkens_once: true,
            clips_casters: true,
        }
    }
}

/// A plane that receives shadows.
#[derive(Clone, Debug, PartialEq)]
pub struct Receiver {
    /// Unit normal and distance: points with n . p + w = 0.
    pub plane: Vec4,
    /// Its triangles.
    pub triangles: Vec<TriangleId>,
    /// Square metres.
    pub area: f32,
}

/// The `count` planes of a scene on which most area lies.
#[must_use]
pub fn receivers(scene: &Scene, count: usize) -> Vec<Receiver> {
    let (low, high) = scene.bounds();
    let step = SAME_DISTANCE * (high - low).max_element().max(f32::MIN_POSITIVE);
    let mut planes: HashMap<[i64; 4], Receiver> = HashMap::new();
    for t in 0..scene.triangles.len() {
        let id = TriangleId::new(t);
        let corners = scene.corners(id);
        let normal = normal_of(corners);
        if normal == Vec3::ZERO || scene.material_of(id).alpha_mode == AlphaMode::Blend {
            continue;
        }
        let distance = -normal.dot((corners[0] + corners[1] + corners[2]) / 3.0);
        let [x, y, z] = normal.to_array().map(|n| (n / SAME_NORMAL).round() as i64);
        let key = [x, y, z, (distance / (10.0 * step)).round() as i64];
        let plane = normal.extend(distance);
        let receiver = planes.entry(key).or_insert(Receiver { plane, triangles: Vec::new(), area: 0.0 });
        receiver.triangles.push(id);
        receiver.area += area_of(corners);
    }
    let mut receivers: Vec<Receiver> = planes.into_values().collect();
    receivers.sort_by(|a, b| b.area.total_cmp(&a.area).then(a.triangles[0].cmp(&b.triangles[0])));
    receivers.truncate(count);
    receivers
}

/// Flattens on to `plane` as a light at the homogeneous `light` does.
///
/// Equation: M = (P . L) I - L P^T.
#[must_use]
pub fn flattening(plane: Vec4, light: Vec4) -> Mat4 {
    let outer = Mat4::from_cols(light * plane.x, light * plane.y, light * plane.z, light * plane.w);
    Mat4::from_diagonal(Vec4::splat(plane.dot(light))) - outer
}

/// Triangles flattened on to a plane, three homogeneous corners each, w > 0 where `clips`.
#[must_use]
pub fn flattened(casters: &Casters, plane: Vec4, light: Vec4, clips: bool, clearance: f32) -> Vec<Vec4> {
    let matrix = flattening(plane, light);
    let height_of_light = if light.w == 0.0 { f32::INFINITY } else { plane.dot(light) };
    let mut corners = Vec::new();
    for triangle in &casters.triangles {
        let polygon = casters.corners(triangle);
        if !clips {
            corners.extend(polygon.map(|corner| matrix * corner.extend(1.0)));
            continue;
        }
        let height = |corner: Vec3| plane.dot(corner.extend(1.0));
        let above = clip(&polygon, |corner| height(corner) - clearance);
        let between = if height_of_light.is_finite() {
            clip(&above, |corner| height_of_light - clearance - height(corner))
        } else {
            above
        };
        for i in 2..between.len() {
            corners.extend([0, i - 1, i].map(|corner| matrix * between[corner].extend(1.0)));
        }
    }
    corners
}

/// The part of a convex polygon where `inside` is not negative (Sutherland, Hodgman 1974).
fn clip(polygon: &[Vec3], inside: impl Fn(Vec3) -> f32) -> Vec<Vec3> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &this) in polygon.iter().enumerate() {
        let next = polygon[(i + 1) % polygon.len()];
        let (of_this, of_next) = (inside(this), inside(next));
        if of_this >= 0.0 {
            kept.push(this);
        }
        if (of_this >= 0.0) != (of_next >= 0.0) {
            kept.push(this.lerp(next, of_this / (of_this - of_next)));
        }
    }
    kept
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
        let module = shaders::PLANAR_SHADOW.module(&gpu.device);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("planar shadow"),
            bind_group_layouts: &[Some(frame_layout)],
            immediate_size: 0,
        });
        let mark =
            pipeline(gpu, &layout, &module, samples, wgpu::CompareFunction::Equal, Default::default(), mark_stencil());
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
        let count = settings.num_receivers.min(MAX_RECEIVERS);
        self.receivers = receivers(scene, count).into_iter().map(upload).collect();
        if self.shadow.as_ref().is_none_or(|(known, _)| known != settings) {
            let (compare, bias) = match (settings.is_free_of_depth, settings.stays_on_receiver) {
                (true, true) => (wgpu::CompareFunction::Always, Default::default()),
                (true, false) => (wgpu::CompareFunction::GreaterEqual, LIFT),
                (false, _) => (wgpu::CompareFunction::GreaterEqual, Default::default()),
            };
            let stencil = shadow_stencil(settings);
            let pipeline = pipeline(gpu, &self.layout, &self.module, self.samples, compare, bias, stencil);
            self.shadow = Some((*settings, pipeline));
        }
    }

    /// Marks the shadows that a light at `light` throws on the receivers, in a pass with cleared stencil to which bind
    /// group 0 is set.
    pub fn draw(&self, gpu: &Gpu, pass: &mut wgpu::RenderPass<'_>, subject: Subject<'_>, light: Vec4) {
        let (settings, shadow) = self.shadow.as_ref().expect("receivers have been chosen");
        let (low, high) = subject.shadows.scene().bounds();
        let clearance = CLEARANCE * (high - low).max_element();
        for ((receiver, corners), number) in self.receivers.iter().zip(1..) {
            // Which pixels are on this receiver.
            pass.set_stencil_reference(RECEIVER * number);
            draw(pass, &self.mark, corners);
            // What stands between them and the light; a light behind the plane lights it not at all.
            if receiver.plane.dot(light) <= clearance * light.w {
                continue;
            }
            let shadows = flattened(&subject.shadows.casters, receiver.plane, light, settings.clips_casters, clearance);
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
    depth_compare: wgpu::CompareFunction,
    bias: wgpu::DepthBiasState,
    stencil: wgpu::StencilState,
) -> wgpu::RenderPipeline {
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("planar shadow"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<Vec4>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x4],
            })],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: depth_stencil_format(gpu),
            depth_write_enabled: Some(false),
            depth_compare: Some(depth_compare),
            stencil,
            bias,
        }),
        multisample: wgpu::MultisampleState { count: samples, ..Default::default() },
        fragment: None,
        multiview_mask: None,
        cache: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: Vec4 = Vec4::Y;

    #[test]
    fn a_point_is_flattened_along_the_line_from_the_light() {
        let light = Vec4::new(0.0, 4.0, 0.0, 1.0);
        let flat = (flattening(FLOOR, light) * Vec4::new(1.0, 2.0, 0.5, 1.0)).to_array();
        assert!(
            (flat[0] / flat[3] - 2.0).abs() < 1e-6 && flat[1].abs() < 1e-6 && (flat[2] / flat[3] - 1.0).abs() < 1e-6
        );
        let sun = Vec4::new(0.6, 0.8, 0.0, 0.0);
        let flat = (flattening(FLOOR, sun) * Vec4::new(1.0, 2.0, 0.5, 1.0)).to_array();
        assert!((flat[0] / flat[3] + 0.5).abs() < 1e-6, "{flat:?}");
    }

    #[test]
    fn casters_are_cut_at_the_plane_and_below_the_light() {
        let positions = vec![Vec3::new(0.0, -1.0, 0.0), Vec3::new(1.0, 9.0, 0.0), Vec3::new(0.0, 9.0, 1.0)];
        let triangle = super::super::casters::Caster { corners: [0, 1, 2], parts: 0..0, is_single_sided: false };
        let casters = Casters { positions, triangles: vec![triangle], ..Casters::default() };
        let light = Vec4::new(0.0, 4.0, 0.0, 1.0);
        let cut = flattened(&casters, FLOOR, light, true, 1e-3);
        assert_eq!(cut.len(), 6, "a quadrilateral");
        assert!(cut.iter().all(|corner| corner.w > 0.0));
        assert!(flattened(&casters, FLOOR, light, false, 1e-3).iter().any(|corner| corner.w < 0.0));
    }
}
