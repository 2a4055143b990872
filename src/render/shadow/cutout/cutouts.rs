//! Uploads casters with holes, each material with a tree of bounding boxes.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3, Vec3A, Vec4};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use wgpu::util::DeviceExt;

use crate::base::ids::MaterialId;
use crate::gpu::Gpu;
use crate::render::shadow::shared::scene::SceneData;
use crate::scene::{AlphaMode, Scene};

/// Margin of a box round its triangles, as a share of the scene's extent.
const SLACK: f32 = 1e-5;
/// [`CutoutNode::triangle`] of an inner node.
const NO_TRIANGLE: u32 = u32::MAX;
/// Smallest alpha of a blending surface that casts a shadow; rays use the same value.
const HALF_OPAQUE: f32 = 0.5;

/// `CutoutCorner` of shaders/shadow/cutout/cutout_shadow.wgsl: a corner with everything that its opacity depends on.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct CutoutCorner {
    position: Vec3,
    /// Smallest alpha that is solid.
    solid_alpha: f32,
    uv: [Vec2; 2],
    colour: Vec4,
}

/// `CutoutNode` of shaders/shadow/cutout/cutout_shadow.wgsl: a box of the tree. Its first child is the next node.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct CutoutNode {
    low: Vec3,
    /// The node to visit next if a line misses the box.
    skip: u32,
    high: Vec3,
    /// The triangle of a leaf, or [`NO_TRIANGLE`].
    triangle: u32,
}

/// Casters with holes, of one material.
pub struct Cutouts {
    /// Their material.
    pub material: MaterialId,
    /// Bind group 3: the corners, and the tree over their triangles.
    pub triangles: wgpu::BindGroup,
}

/// All casters of a scene that are not opaque, by material.
pub struct SceneCutouts(pub Vec<Cutouts>);

impl SceneData for SceneCutouts {}

impl SceneCutouts {
    /// Uploads the casters of a scene that are not opaque.
    pub fn new(gpu: &Gpu, scene: &Scene) -> Self {
        let has_holes = |material: &MaterialId| scene.materials[material.index()].alpha_mode != AlphaMode::Opaque;
        let materials = (0..scene.materials.len()).map(MaterialId::new).filter(has_holes);
        Self(materials.filter_map(|material| Cutouts::of_material(gpu, scene, material)).collect())
    }
}

impl Cutouts {
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

/// Builds a tree over triangles of three corners each, in depth-first order.
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
    let (node, index) = (&binary.nodes[at], nodes.len());
    let (low, high) = (node.aabb().min.into(), node.aabb().max.into());
    nodes.push(CutoutNode { low, skip: 0, high, triangle: NO_TRIANGLE });
    let first = node.first_index as usize;
    if node.is_leaf() {
        nodes[index].triangle = binary.primitive_indices[first];
    } else {
        lay_out(binary, first, nodes);
        lay_out(binary, first + 1, nodes);
    }
    nodes[index].skip = nodes.len() as u32;
}

/// Creates the layout of bind group 3.
pub fn cutouts_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::struct_layout;
    use crate::render::shadow::cutout::cutout_shadow::CUTOUT_SHADOW;
    use std::mem::offset_of;

    #[test]
    fn corners_and_nodes_have_the_layout_of_the_shader() {
        macro_rules! offsets {
            ($($field:ident),+) => { vec![$(offset_of!(CutoutCorner, $field)),+, size_of::<CutoutCorner>()] };
        }
        assert_eq!(offsets![position, solid_alpha, uv, colour], struct_layout(&CUTOUT_SHADOW, "CutoutCorner"));
        let node = [offset_of!(CutoutNode, low), offset_of!(CutoutNode, skip), offset_of!(CutoutNode, high)];
        let node = [node.as_slice(), &[offset_of!(CutoutNode, triangle), size_of::<CutoutNode>()]].concat();
        assert_eq!(node, struct_layout(&CUTOUT_SHADOW, "CutoutNode"));
    }
}
