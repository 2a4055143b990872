//! Cut-out shadow pass: shadows of casters with holes, and of those that blend.
//!
//! A shadow volume knows the outline of a triangle and not the holes in its texture. So each visible point asks these
//! triangles themselves whether the line to the light meets them where they are solid, and is marked in the stencil. The
//! cost is points times triangles: scenes with more than [`MAX_TRIANGLES`] such triangles a material have the rest of
//! them ignored.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3, Vec4};
use wgpu::util::DeviceExt;

use super::light_targets::depth_stencil_format;
use super::planar_shadow::SHADOWS;
use super::real_time::Subject;
use super::solid::SolidPipelines;
use crate::base::ids::{MaterialId, TriangleId};
use crate::gpu::material_buffers::material_layout;
use crate::gpu::scene_buffers::GpuVertex;
use crate::gpu::{Gpu, shaders};
use crate::scene::{AlphaMode, Scene};

/// Triangles of one material that a point can ask.
pub const MAX_TRIANGLES: usize = 512;
/// What the stencil of a point in shadow holds, in those of its bits that count planar shadows too.
const SHADOWED: u32 = 1;
/// Alpha from which on a surface that blends counts as solid, as for rays.
const HALF_OPAQUE: f32 = 0.5;

const MARK: wgpu::StencilFaceState = wgpu::StencilFaceState {
    compare: wgpu::CompareFunction::Always,
    fail_op: wgpu::StencilOperation::Keep,
    depth_fail_op: wgpu::StencilOperation::Keep,
    pass_op: wgpu::StencilOperation::Replace,
};

/// `Cutout` of shaders/cutout_shadow.wgsl: a corner with all that its opacity depends on.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct CutoutCorner {
    position: Vec3,
    /// Smallest alpha that is solid.
    solid_alpha: f32,
    uv: [Vec2; 2],
    colour: Vec4,
}

/// Casters with holes, of one material.
pub struct Cutouts {
    material: MaterialId,
    triangles: wgpu::BindGroup,
}

/// Cut-out shadow pass.
pub struct CutoutShadowPass {
    pipelines: SolidPipelines,
}

impl Cutouts {
    /// All casters of a scene that are not solid, material by material.
    #[must_use]
    pub fn of_scene(gpu: &Gpu, scene: &Scene) -> Vec<Self> {
        let has_holes = |material: &MaterialId| scene.materials[material.index()].alpha_mode != AlphaMode::Opaque;
        let materials = (0..scene.materials.len()).map(MaterialId::new).filter(has_holes);
        materials.filter_map(|material| Self::of_material(gpu, scene, material)).collect()
    }

    fn of_material(gpu: &Gpu, scene: &Scene, material: MaterialId) -> Option<Self> {
        let triangles = (0..scene.triangles.len())
            .filter(|&t| scene.triangles[t].material == material && !scene.triangles[t].is_back_side)
            .take(MAX_TRIANGLES);
        let solid_alpha = match scene.materials[material.index()].alpha_mode {
            AlphaMode::Mask { cutoff } => cutoff,
            AlphaMode::Opaque | AlphaMode::Blend => HALF_OPAQUE,
        };
        let corners: Vec<CutoutCorner> = triangles
            .flat_map(|t| scene.triangles[TriangleId::new(t).index()].vertices)
            .map(|v| &scene.vertices[v as usize])
            .map(|v| CutoutCorner { position: v.position, solid_alpha, uv: v.uv, colour: v.colour })
            .collect();
        if corners.is_empty() {
            return None;
        }
        let buffer = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("cut-outs"),
            contents: bytemuck::cast_slice(&corners),
            usage: wgpu::BufferUsages::STORAGE,
        });
        let triangles = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("cut-outs"),
            layout: &cutouts_layout(gpu),
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
        });
        Some(Self { material, triangles })
    }
}

impl CutoutShadowPass {
    /// Pipelines for targets with `samples` samples a pixel.
    pub fn new(
        gpu: &Gpu,
        frame_layout: &wgpu::BindGroupLayout,
        sample_layout: &wgpu::BindGroupLayout,
        samples: u32,
    ) -> Self {
        let module = shaders::CUTOUT_SHADOW.module(&gpu.device);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("cut-out shadow"),
            bind_group_layouts: &[
                Some(frame_layout),
                Some(sample_layout),
                Some(&material_layout(gpu)),
                Some(&cutouts_layout(gpu)),
            ],
            immediate_size: 0,
        });
        Self { pipelines: SolidPipelines::new(|cull| pipeline(gpu, &layout, &module, samples, cull)) }
    }

    /// Marks what lies behind casters with holes, in a stencil pass to which bind groups 0 and 1 are set.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, subject: Subject<'_>) {
        pass.set_stencil_reference(SHADOWED);
        for cutouts in &subject.shadows.cutouts {
            pass.set_bind_group(2, &subject.scene.materials[cutouts.material.index()], &[]);
            pass.set_bind_group(3, &cutouts.triangles, &[]);
            self.pipelines.draw(pass, subject.scene, subject.look);
        }
    }
}

fn cutouts_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("cut-outs"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: true },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }],
    })
}

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    samples: u32,
    cull_mode: Option<wgpu::Face>,
) -> wgpu::RenderPipeline {
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("cut-out shadow"),
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
            stencil: wgpu::StencilState { front: MARK, back: MARK, read_mask: !0, write_mask: SHADOWS },
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState { count: samples, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shaders::{CUTOUT_SHADOW, struct_layout};
    use std::mem::offset_of;

    #[test]
    fn corners_lie_as_the_shader_reads_them() {
        macro_rules! offsets {
            ($($field:ident),+) => { vec![$(offset_of!(CutoutCorner, $field)),+, size_of::<CutoutCorner>()] };
        }
        assert_eq!(offsets![position, solid_alpha, uv, colour], struct_layout(&CUTOUT_SHADOW, "CutoutCorner"));
    }
}
