//! Uploads materials: one bind group each, with numbers and textures.

use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4};
use wgpu::util::DeviceExt;

use super::mip::Encoding;
use super::textures::Textures;
use crate::gpu::Gpu;
use crate::scene::{AlphaMode, Material, Scene, TextureSlot};

/// `Material` of shaders/shared/material.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct MaterialUniform {
    base_colour: Vec4,
    emission: Vec3,
    metallic: f32,
    base_slot: SlotUniform,
    metallic_slot: SlotUniform,
    emissive_slot: SlotUniform,
    alpha_cutoff: f32,
    group: u32,
    padding: [u32; 2],
}

/// `Slot` of shaders/shared/material.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct SlotUniform {
    u: Vec3,
    uv_set: u32,
    v: Vec3,
    padding: u32,
}

impl MaterialUniform {
    fn new(material: &Material) -> Self {
        Self {
            base_colour: material.base_colour,
            emission: material.emission,
            metallic: material.metallic,
            base_slot: SlotUniform::new(material.base_colour_texture.as_ref()),
            metallic_slot: SlotUniform::new(material.metallic_roughness_texture.as_ref()),
            emissive_slot: SlotUniform::new(material.emissive_texture.as_ref()),
            alpha_cutoff: match material.alpha_mode {
                AlphaMode::Mask { cutoff } => cutoff,
                AlphaMode::Opaque | AlphaMode::Blend => 0.0,
            },
            group: material.group.map_or(u32::MAX, |group| group.0),
            padding: [0; 2],
        }
    }
}

impl SlotUniform {
    fn new(slot: Option<&TextureSlot>) -> Self {
        let Some(slot) = slot else {
            return Self::zeroed();
        };
        let (matrix, shift) = (slot.transform.matrix2, slot.transform.translation);
        Self {
            u: matrix.row(0).extend(shift.x),
            uv_set: slot.uv_set as u32,
            v: matrix.row(1).extend(shift.y),
            padding: 0,
        }
    }
}

/// Creates the layout of a material's bind group: uniform, then texture and sampler of base colour, metallic-roughness,
/// emission.
#[must_use]
pub fn material_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry = |binding, visibility, ty| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
    let texture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    let uniform = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let mut entries = vec![entry(0, wgpu::ShaderStages::VERTEX_FRAGMENT, uniform)];
    for binding in [1, 3, 5] {
        entries.push(entry(binding, wgpu::ShaderStages::FRAGMENT, texture));
        entries.push(entry(binding + 1, wgpu::ShaderStages::FRAGMENT, sampler));
    }
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("material"), entries: &entries })
}

/// Creates the bind groups of all materials `[m]`.
#[must_use]
pub fn material_bind_groups(gpu: &Gpu, scene: &Scene) -> Vec<wgpu::BindGroup> {
    let layout = material_layout(gpu);
    let mut textures = Textures::new(gpu);
    scene.materials.iter().map(|material| bind_group(gpu, scene, material, &layout, &mut textures)).collect()
}

fn bind_group(
    gpu: &Gpu,
    scene: &Scene,
    material: &Material,
    layout: &wgpu::BindGroupLayout,
    textures: &mut Textures,
) -> wgpu::BindGroup {
    let uniform = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some(&material.name),
        contents: bytemuck::bytes_of(&MaterialUniform::new(material)),
        usage: wgpu::BufferUsages::UNIFORM,
    });
    let base = textures.bind(gpu, scene, material.base_colour_texture.as_ref(), Encoding::Srgb);
    let metallic = textures.bind(gpu, scene, material.metallic_roughness_texture.as_ref(), Encoding::Linear);
    let emissive = textures.bind(gpu, scene, material.emissive_texture.as_ref(), Encoding::Srgb);
    let mut entries = vec![wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }];
    for (binding, (view, sampler)) in [(1, &base), (3, &metallic), (5, &emissive)] {
        entries.push(wgpu::BindGroupEntry { binding, resource: wgpu::BindingResource::TextureView(view) });
        entries.push(wgpu::BindGroupEntry { binding: binding + 1, resource: wgpu::BindingResource::Sampler(sampler) });
    }
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(&material.name), layout, entries: &entries })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::struct_layout;
    use crate::render::surface::direct_source::SURFACE;
    use std::mem::offset_of;

    #[test]
    fn the_layout_of_uniforms_is_that_of_the_shader() {
        macro_rules! offsets {
            ($uniform:ty: $($field:ident),+) => { vec![$(offset_of!($uniform, $field)),+, size_of::<$uniform>()] };
        }
        let slot = offsets![SlotUniform: u, uv_set, v, padding];
        assert_eq!(slot, struct_layout(&SURFACE, "Slot"));
        let material = offsets![
            MaterialUniform: base_colour, emission, metallic, base_slot, metallic_slot, emissive_slot, alpha_cutoff,
            group, padding
        ];
        assert_eq!(material, struct_layout(&SURFACE, "Material"));
    }
}
