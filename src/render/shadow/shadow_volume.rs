//! Shadow volume pass: the stencil counts the volumes that each visible point is in.
//!
//! Depth-pass counts sides in front of the point, entered ones up and left ones down, and is wrong where the near plane
//! is in a volume: what lies before it is not counted. Depth-fail counts behind the point, needs caps, and is right
//! everywhere. The cure of depth-pass takes depth-fail for the few triangles whose volumes reach the near plane: counts
//! are sums over triangles, and each may be counted either way.
//!
//! The stencil wraps at 256: passing through more volumes than that is no fault, being in exactly 256 (or a multiple)
//! counts as none. An orthographic view has a far plane, which cuts volumes off as [`VolumeSettings::far_plane`] does.
//!
//! Source: Heidmann 1991; Everitt, Kilgard 2002; Hornus et al. 2005 (ZP+, the idea of the cure).

use std::collections::HashMap;
use std::ops::Range;

use glam::{Vec3, Vec4};
use wgpu::util::DeviceExt;

use super::casters::{Caster, Casters};
use super::light_targets::depth_stencil_format;
use super::near_plane::NearPlane;
use super::real_time::Subject;
use super::silhouette::{Counting, Hull, facing, hull, hull_triangle_by_triangle};
use crate::gpu::{Gpu, shaders};

/// How shadow volumes are counted, and what is done about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumeSettings {
    /// Depth-pass takes depth-fail for triangles whose volumes reach the near plane; off shows the text book's fault.
    pub near_plane_cure: bool,
    /// Distance of a far plane that cuts volumes off, metres; none is the cure.
    pub far_plane: Option<f32>,
    /// Triangles share one volume where they meet; off gives each its own, which is slow and tells whether joining is
    /// right. Depth-fail only.
    pub joined: bool,
}

impl Default for VolumeSettings {
    fn default() -> Self {
        Self { near_plane_cure: true, far_plane: None, joined: true }
    }
}

/// Shadow volume pass.
pub struct ShadowVolumePass {
    pipelines: Pipelines,
    cut_off: Option<(f32, Pipelines)>,
    layout: wgpu::PipelineLayout,
    module: wgpu::ShaderModule,
    samples: u32,
    hulls: HashMap<HullKey, HullBuffers>,
}

struct Pipelines {
    /// For triangles that are counter-clockwise seen from outside, and for those that are clockwise.
    pass: [wgpu::RenderPipeline; 2],
    fail: [wgpu::RenderPipeline; 2],
}

/// What the volumes of a light depend on: its place, and the near plane where that matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct HullKey {
    place: [u32; 4],
    near_plane: Option<[u32; 16]>,
    is_depth_pass: bool,
    is_joined: bool,
}

/// The volumes of one light on the device, those counted each way apart.
struct HullBuffers {
    pass: Indices,
    fail: Indices,
}

/// A [`Hull`] in one index buffer.
struct Indices {
    buffer: wgpu::Buffer,
    /// Walls and facing caps.
    counter_clockwise: Range<u32>,
    /// Averted caps.
    clockwise: Range<u32>,
}

impl ShadowVolumePass {
    /// Pipelines for targets with `samples` samples a pixel.
    pub fn new(
        gpu: &Gpu,
        frame_layout: &wgpu::BindGroupLayout,
        sample_layout: &wgpu::BindGroupLayout,
        samples: u32,
    ) -> Self {
        let module = shaders::SHADOW_VOLUME.module(&gpu.device);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shadow volume"),
            bind_group_layouts: &[Some(frame_layout), Some(sample_layout)],
            immediate_size: 0,
        });
        let pipelines = Pipelines::new(gpu, &layout, &module, samples, None);
        Self { pipelines, cut_off: None, layout, module, samples, hulls: HashMap::new() }
    }

    /// Finds the volumes of all lights at `places`; those of the last picture are kept where nothing has moved.
    pub fn prepare(
        &mut self,
        gpu: &Gpu,
        subject: Subject<'_>,
        places: &[Vec4],
        counting: Counting,
        settings: &VolumeSettings,
    ) {
        if let Some(distance) =
            settings.far_plane.filter(|&d| self.cut_off.as_ref().is_none_or(|(known, _)| *known != d))
        {
            let depth = subject.view.depth_at(distance);
            self.cut_off = Some((distance, Pipelines::new(gpu, &self.layout, &self.module, self.samples, Some(depth))));
        }
        let mut known = std::mem::take(&mut self.hulls);
        for &place in places {
            let key = HullKey::new(subject, place, counting, settings);
            let buffers = known.remove(&key).unwrap_or_else(|| volumes(gpu, subject, place, counting, settings));
            self.hulls.insert(key, buffers);
        }
    }

    /// Forgets the volumes of the last scene.
    pub fn forget(&mut self) {
        self.hulls.clear();
    }

    /// Counts the volumes of the light at `place`, in a pass with cleared stencil to which bind groups 0 and 1 are set.
    pub fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        subject: Subject<'_>,
        place: Vec4,
        counting: Counting,
        settings: &VolumeSettings,
    ) {
        let key = HullKey::new(subject, place, counting, settings);
        let hulls = self.hulls.get(&key).expect("the volumes of every light have been prepared");
        let pipelines = match (&self.cut_off, settings.far_plane) {
            (Some((_, cut_off)), Some(_)) => cut_off,
            _ => &self.pipelines,
        };
        pass.set_vertex_buffer(0, subject.shadows.corners.slice(..));
        hulls.fail.draw(pass, &pipelines.fail);
        hulls.pass.draw(pass, &pipelines.pass);
    }
}

impl HullKey {
    fn new(subject: Subject<'_>, place: Vec4, counting: Counting, settings: &VolumeSettings) -> Self {
        let is_depth_pass = counting == Counting::DepthPass;
        let matrix = subject.view.projection_from_world().to_cols_array().map(f32::to_bits);
        let near_plane = (is_depth_pass && settings.near_plane_cure).then_some(matrix);
        Self { place: place.to_array().map(f32::to_bits), near_plane, is_depth_pass, is_joined: settings.joined }
    }
}

/// The volumes of the light at `place`, each triangle counted the way that is right for it.
fn volumes(gpu: &Gpu, subject: Subject<'_>, place: Vec4, counting: Counting, settings: &VolumeSettings) -> HullBuffers {
    let casters = &subject.shadows.casters;
    let facing = facing(casters, place);
    let (pass, fail) = match (counting, settings.near_plane_cure) {
        (Counting::DepthFail, _) if !settings.joined => {
            (Hull::default(), hull_triangle_by_triangle(casters, &facing, place))
        }
        (Counting::DepthFail, _) => (Hull::default(), hull(casters, &facing, place, Counting::DepthFail)),
        (Counting::DepthPass, false) => (hull(casters, &facing, place, Counting::DepthPass), Hull::default()),
        (Counting::DepthPass, true) => cured(subject, casters, &facing, place),
    };
    HullBuffers { pass: Indices::new(gpu, &pass), fail: Indices::new(gpu, &fail) }
}

/// Depth-fail for triangles between the light and the near plane, depth-pass for the others.
fn cured(subject: Subject<'_>, casters: &Casters, facing: &[i32], place: Vec4) -> (Hull, Hull) {
    let near_plane = NearPlane::new(subject.view);
    let reaches = |triangle: &Caster| near_plane.is_reached_by_volume(casters.corners(triangle), place);
    let is_fail: Vec<bool> = casters.triangles.iter().map(reaches).collect();
    let only = |wanted: bool| -> Vec<i32> {
        facing.iter().zip(&is_fail).map(|(&facing, &is_fail)| if is_fail == wanted { facing } else { 0 }).collect()
    };
    let by_pass = only(false);
    let mut pass = hull(casters, &by_pass, place, Counting::DepthPass);
    // A cap coincides with its triangle, and only where that is invisible is the cap in front of what is seen.
    for (triangle, &facing) in casters.triangles.iter().zip(&by_pass).filter(|(_, facing)| **facing != 0) {
        let is_invisible =
            subject.look.cull_back && triangle.is_single_sided && is_seen_from_behind(subject, casters, triangle);
        if is_invisible {
            pass.add_light_caps(casters, triangle, facing);
        }
    }
    (pass, hull(casters, &only(true), place, Counting::DepthFail))
}

fn is_seen_from_behind(subject: Subject<'_>, casters: &Casters, triangle: &Caster) -> bool {
    let [a, b, c] = casters.corners(triangle).map(Vec3::as_dvec3);
    (b - a).cross(c - a).dot(subject.view.towards_eye(a.as_vec3()).as_dvec3()) <= 0.0
}

impl Indices {
    fn new(gpu: &Gpu, hull: &Hull) -> Self {
        let Hull { walls, facing_caps, averted_caps } = hull;
        let middle = (walls.len() + facing_caps.len()) as u32;
        let end = middle + averted_caps.len() as u32;
        let buffer = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("shadow volumes"),
            contents: bytemuck::cast_slice(&[walls.as_slice(), facing_caps, averted_caps].concat()),
            usage: wgpu::BufferUsages::INDEX,
        });
        Self { buffer, counter_clockwise: 0..middle, clockwise: middle..end }
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, pipelines: &[wgpu::RenderPipeline; 2]) {
        let parts = pipelines.iter().zip([&self.counter_clockwise, &self.clockwise]);
        for (pipeline, indices) in parts.filter(|(_, indices)| !indices.is_empty()) {
            pass.set_index_buffer(self.buffer.slice(..), wgpu::IndexFormat::Uint32);
            pass.set_pipeline(pipeline);
            pass.draw_indexed(indices.clone(), 0, 0..1);
        }
    }
}

impl Pipelines {
    fn new(
        gpu: &Gpu,
        layout: &wgpu::PipelineLayout,
        module: &wgpu::ShaderModule,
        samples: u32,
        far_depth: Option<f32>,
    ) -> Self {
        let make = |counting, front_face| pipeline(gpu, layout, module, samples, far_depth, counting, front_face);
        let both = |counting| [wgpu::FrontFace::Ccw, wgpu::FrontFace::Cw].map(|front| make(counting, front));
        Self { pass: both(Counting::DepthPass), fail: both(Counting::DepthFail) }
    }
}

/// Counts on the two faces: depth-pass goes into a volume through a front, depth-fail through a back.
fn stencil(counting: Counting) -> wgpu::StencilState {
    use wgpu::StencilOperation::{DecrementWrap, IncrementWrap, Keep};
    let face = |depth_fail_op, pass_op| wgpu::StencilFaceState {
        compare: wgpu::CompareFunction::Always,
        fail_op: Keep,
        depth_fail_op,
        pass_op,
    };
    let (front, back) = match counting {
        Counting::DepthPass => (face(Keep, IncrementWrap), face(Keep, DecrementWrap)),
        Counting::DepthFail => (face(DecrementWrap, Keep), face(IncrementWrap, Keep)),
    };
    wgpu::StencilState { front, back, read_mask: !0, write_mask: !0 }
}

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    samples: u32,
    far_depth: Option<f32>,
    counting: Counting,
    front_face: wgpu::FrontFace,
) -> wgpu::RenderPipeline {
    let constants = [("FAR_DEPTH", f64::from(far_depth.unwrap_or(0.0)))];
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("shadow volume"),
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
        primitive: wgpu::PrimitiveState { front_face, cull_mode: None, ..Default::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: depth_stencil_format(gpu),
            depth_write_enabled: Some(false),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: stencil(counting),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState { count: samples, ..Default::default() },
        fragment: far_depth.map(|_| wgpu::FragmentState {
            module,
            entry_point: Some("beyond"),
            compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    })
}
