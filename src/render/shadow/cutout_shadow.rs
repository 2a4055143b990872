//! Cut-out shadow pass: shadows of casters with holes, and of those that blend.
//!
//! A shadow volume knows the outline of a triangle and not the holes in its texture. So each visible point asks these
//! triangles themselves, through a tree of boxes, whether the line to the light meets them where they are solid, and is
//! marked in the stencil.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3, Vec3A, Vec4};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use wgpu::util::DeviceExt;

use super::pipeline::{PipelineRecipe, against_depth, culling};
use super::planar_shadow::SHADOWS;
use super::real_time::Subject;
use super::solid::SolidPipelines;
use crate::base::ids::MaterialId;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::scene::materials::material_layout;
use crate::scene::{AlphaMode, Scene};

/// Marks what lies behind casters with holes.
pub(in crate::render) const CUTOUT_SHADOW: Shader = shader!(
    "cut-out shadow",
    "shared/frame.wgsl",
    "shared/material.wgsl",
    "shared/visible_point.wgsl",
    "shared/light_sample.wgsl",
    "shared/one_light.wgsl",
    "cutout_shadow.wgsl"
);

/// Boxes are this much wider than what they hold, as a share of the scene's extent.
const SLACK: f32 = 1e-5;
/// A node of the tree that is no leaf.
const NO_TRIANGLE: u32 = u32::MAX;
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

/// `CutoutNode` of shaders/cutout_shadow.wgsl: a box of the tree, its first child right behind it.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct CutoutNode {
    low: Vec3,
    /// The node to go on with where a line misses the box.
    skip: u32,
    high: Vec3,
    /// The triangle of a leaf.
    triangle: u32,
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
        let triangles = scene.fronts().filter(|t| scene.triangles[t.index()].material == material);
        let solid_alpha = match scene.materials[material.index()].alpha_mode {
            AlphaMode::Mask { cutoff } => cutoff,
            AlphaMode::Opaque | AlphaMode::Blend => HALF_OPAQUE,
        };
        let corners: Vec<CutoutCorner> = triangles
            .flat_map(|t| scene.triangles[t.index()].vertices)
            .map(|v| &scene.vertices[v as usize])
            .map(|v| CutoutCorner { position: v.position, solid_alpha, uv: v.uv, colour: v.colour })
            .collect();
        if corners.is_empty() {
            return None;
        }
        let nodes = tree(&corners, SLACK * scene.bounds().extent());
        let buffer = |contents| {
            let usage = wgpu::BufferUsages::STORAGE;
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("cut-outs"),
                contents,
                usage,
            })
        };
        let (corners, nodes) = (buffer(bytemuck::cast_slice(&corners)), buffer(bytemuck::cast_slice(&nodes)));
        let triangles = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("cut-outs"),
            layout: &cutouts_layout(gpu),
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: corners.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: nodes.as_entire_binding() },
            ],
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
        let module = CUTOUT_SHADOW.module(gpu);
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
            self.pipelines.draw(pass, subject.scene, subject.settings);
        }
    }
}

/// A tree over triangles of three corners each, depth first.
fn tree(corners: &[CutoutCorner], slack: f32) -> Vec<CutoutNode> {
    let boxes: Vec<Aabb> = corners
        .chunks_exact(3)
        .map(|triangle| {
            let [a, b, c] = [0, 1, 2].map(|corner: usize| Vec3A::from(triangle[corner].position));
            Aabb::new(a.min(b).min(c) - slack, a.max(b).max(c) + slack)
        })
        .collect();
    let settings = BvhBuildParams { max_prims_per_leaf: 1, ..BvhBuildParams::medium_build() };
    let binary = build_bvh2(&boxes, settings, &mut std::time::Duration::default());
    let mut nodes = Vec::new();
    lay_out(&binary, 0, &mut nodes);
    nodes
}

fn lay_out(binary: &Bvh2, at: usize, nodes: &mut Vec<CutoutNode>) {
    let (node, place) = (&binary.nodes[at], nodes.len());
    let (low, high) = (node.aabb().min.into(), node.aabb().max.into());
    nodes.push(CutoutNode { low, skip: 0, high, triangle: NO_TRIANGLE });
    let first = node.first_index as usize;
    if node.is_leaf() {
        nodes[place].triangle = binary.primitive_indices[first];
    } else {
        lay_out(binary, first, nodes);
        lay_out(binary, first + 1, nodes);
    }
    nodes[place].skip = nodes.len() as u32;
}

fn cutouts_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry = |binding| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: true },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let entries = &[entry(0), entry(1)];
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("cut-outs"), entries })
}

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    samples: u32,
    cull_mode: Option<wgpu::Face>,
) -> wgpu::RenderPipeline {
    let stencil = wgpu::StencilState { front: MARK, back: MARK, read_mask: !0, write_mask: SHADOWS };
    PipelineRecipe {
        fragment: Some(("fragment", &[])),
        primitive: culling(cull_mode),
        depth_stencil: Some(against_depth(gpu, wgpu::CompareFunction::Equal, stencil, Default::default())),
        samples,
        ..PipelineRecipe::new("cut-out shadow", layout, module)
    }
    .make(gpu)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::struct_layout;
    use std::mem::offset_of;

    #[test]
    fn corners_lie_as_the_shader_reads_them() {
        macro_rules! offsets {
            ($($field:ident),+) => { vec![$(offset_of!(CutoutCorner, $field)),+, size_of::<CutoutCorner>()] };
        }
        assert_eq!(offsets![position, solid_alpha, uv, colour], struct_layout(&CUTOUT_SHADOW, "CutoutCorner"));
        let node = [offset_of!(CutoutNode, low), offset_of!(CutoutNode, skip), offset_of!(CutoutNode, high)];
        let node = [node.as_slice(), &[offset_of!(CutoutNode, triangle), size_of::<CutoutNode>()]].concat();
        assert_eq!(node, struct_layout(&CUTOUT_SHADOW, "CutoutNode"));
    }
}
