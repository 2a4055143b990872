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

use glam::{DVec4, Vec3, Vec4};
use rayon::prelude::*;
use wgpu::util::DeviceExt;

use super::casters::{Caster, Casters};
use super::near_plane::NearPlane;
use super::real_time::Subject;
use super::silhouette::{Counting, Hull, facing, hull, hull_triangle_by_triangle, terminator};
use super::volume_pipelines::VolumePipelines;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};

/// Counts shadow volumes in the stencil.
pub(in crate::render) const SHADOW_VOLUME: Shader = shader!(
    "shadow volume",
    "shared/frame.wgsl",
    "shared/light_sample.wgsl",
    "shared/one_light.wgsl",
    "shadow_volume.wgsl"
);

/// What the stencil holds where a triangle turns its back to the light.
const DARK: u32 = 1;

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
    pipelines: VolumePipelines,
    cut_off: Option<(f32, VolumePipelines)>,
    layout: wgpu::PipelineLayout,
    module: wgpu::ShaderModule,
    samples: u32,
    hulls: HashMap<HullKey, HullBuffers>,
}

/// What the volumes of a light depend on: its place, and the near plane where that matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct HullKey {
    place: [u32; 4],
    near_plane: Option<([u32; 16], bool)>,
    is_depth_pass: bool,
    is_joined: bool,
}

/// The volumes of one light, those counted each way apart, and what is dark whatever they count.
struct Volumes {
    pass: Hull,
    fail: Hull,
    terminator: Hull,
}

/// [`Volumes`] on the device.
struct HullBuffers {
    pass: Indices,
    fail: Indices,
    terminator: Indices,
}

/// A [`Hull`] in one index buffer.
struct Indices {
    buffer: wgpu::Buffer,
    counter_clockwise: Range<u32>,
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
        let module = SHADOW_VOLUME.module(gpu);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shadow volume"),
            bind_group_layouts: &[Some(frame_layout), Some(sample_layout)],
            immediate_size: 0,
        });
        let pipelines = VolumePipelines::new(gpu, &layout, &module, samples, None);
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
            self.cut_off =
                Some((distance, VolumePipelines::new(gpu, &self.layout, &self.module, self.samples, Some(depth))));
        }
        let key = |&place: &Vec4| (HullKey::new(subject, place, counting, settings), place);
        let wanted: HashMap<HullKey, Vec4> = places.iter().map(key).collect();
        self.hulls.retain(|key, _| wanted.contains_key(key));
        let missing: Vec<_> = wanted.into_iter().filter(|(key, _)| !self.hulls.contains_key(key)).collect();
        let (casters, eye) = (&subject.shadows.casters, Eye::new(subject));
        let found: Vec<_> =
            missing.par_iter().map(|&(key, place)| (key, volumes(casters, &eye, place, counting, settings))).collect();
        self.hulls.extend(found.into_iter().map(|(key, volumes)| (key, volumes.upload(gpu))));
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
        pass.set_stencil_reference(DARK);
        hulls.terminator.draw(pass, &pipelines.terminator);
    }
}

impl HullKey {
    fn new(subject: Subject<'_>, place: Vec4, counting: Counting, settings: &VolumeSettings) -> Self {
        let is_depth_pass = counting == Counting::DepthPass;
        let matrix = subject.view.projection_from_world().to_cols_array().map(f32::to_bits);
        Self {
            place: place.to_array().map(f32::to_bits),
            near_plane: (is_depth_pass && settings.near_plane_cure).then_some((matrix, subject.settings.cull_back)),
            is_depth_pass,
            is_joined: settings.joined,
        }
    }
}

/// What the cure of depth-pass asks of the eye.
struct Eye {
    /// Homogeneous.
    place: DVec4,
    near_plane: NearPlane,
    /// Single-sided triangles are invisible from behind.
    culls_backs: bool,
}

impl Eye {
    fn new(subject: Subject<'_>) -> Self {
        Self {
            place: subject.view.eye().as_dvec4(),
            near_plane: NearPlane::new(subject.view),
            culls_backs: subject.settings.cull_back,
        }
    }

    fn sees(&self, casters: &Casters, triangle: &Caster) -> bool {
        let [a, b, c] = casters.corners(triangle).map(Vec3::as_dvec3);
        let to_eye = self.place.truncate() - self.place.w * a;
        !self.culls_backs || !triangle.is_single_sided || (b - a).cross(c - a).dot(to_eye) > 0.0
    }
}

/// The volumes of the light at `place`, each triangle counted the way that is right for it.
fn volumes(casters: &Casters, eye: &Eye, place: Vec4, counting: Counting, settings: &VolumeSettings) -> Volumes {
    let facing = facing(casters, place);
    let none = Hull::default();
    let (pass, fail) = match (counting, settings.near_plane_cure) {
        (Counting::DepthFail, _) if !settings.joined => (none, hull_triangle_by_triangle(casters, &facing, place)),
        (Counting::DepthFail, _) => (none, hull(casters, &facing, place, Counting::DepthFail)),
        (Counting::DepthPass, false) => (hull(casters, &facing, place, Counting::DepthPass), none),
        (Counting::DepthPass, true) => cured(casters, eye, &facing, place),
    };
    Volumes { pass, fail, terminator: terminator(casters, &facing, place) }
}

/// Depth-fail for triangles between the light and the near plane, depth-pass for the others.
fn cured(casters: &Casters, eye: &Eye, facing: &[i32], place: Vec4) -> (Hull, Hull) {
    let reaches = |triangle: &Caster| eye.near_plane.is_reached_by_volume(casters.corners(triangle), place);
    let is_fail: Vec<bool> = casters.triangles.par_iter().map(reaches).collect();
    let only = |wanted: bool| -> Vec<i32> {
        facing.iter().zip(&is_fail).map(|(&facing, &is_fail)| if is_fail == wanted { facing } else { 0 }).collect()
    };
    let by_pass = only(false);
    let mut pass = hull(casters, &by_pass, place, Counting::DepthPass);
    // A cap coincides with its triangle, and only where that is invisible is the cap in front of what is seen.
    for (triangle, &facing) in casters.triangles.iter().zip(&by_pass) {
        if !eye.sees(casters, triangle) {
            pass.add_light_caps(casters, triangle, facing);
        }
    }
    (pass, hull(casters, &only(true), place, Counting::DepthFail))
}

impl Volumes {
    fn upload(&self, gpu: &Gpu) -> HullBuffers {
        HullBuffers {
            pass: Indices::new(gpu, &self.pass),
            fail: Indices::new(gpu, &self.fail),
            terminator: Indices::new(gpu, &self.terminator),
        }
    }
}

impl Indices {
    fn new(gpu: &Gpu, hull: &Hull) -> Self {
        let middle = hull.counter_clockwise.len() as u32;
        let end = middle + hull.clockwise.len() as u32;
        let buffer = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("shadow volumes"),
            contents: bytemuck::cast_slice(&[hull.counter_clockwise.as_slice(), &hull.clockwise].concat()),
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
