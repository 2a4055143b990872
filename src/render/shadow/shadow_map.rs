//! Shadow map pass: what the light sees is lit (Williams 1978).
//!
//! A spot has one map, a point six faces of a cube, a directional light an orthographic map fitted to the scene and
//! snapped to whole texels. Faces are a few texels wider than a quarter turn, so that filtering finds no seam. Depth is
//! reversed, as in pictures.

use bytemuck::{Pod, Zeroable};
use glam::camera::rh::proj::directx;
use glam::camera::rh::view::look_to_mat4;
use glam::{Mat4, Vec3, Vec3Swizzles};
use wgpu::util::DeviceExt;

use super::light_samples::LightSample;
use super::real_time::Subject;
use super::solid::bind_mesh;
use crate::base::sampling::tangent_frame;
use crate::gpu::material_buffers::material_layout;
use crate::gpu::scene_buffers::GpuVertex;
use crate::gpu::{Gpu, shaders};
use crate::scene::{AlphaMode, LightKind, Scene};

const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Axes of a cube's faces and what is up on them, in the order of shaders/shared/visibility_map.wgsl.
const FACES: [(Vec3, Vec3); 6] = [
    (Vec3::X, Vec3::Y),
    (Vec3::NEG_X, Vec3::Y),
    (Vec3::Y, Vec3::Z),
    (Vec3::NEG_Y, Vec3::Z),
    (Vec3::Z, Vec3::Y),
    (Vec3::NEG_Z, Vec3::Y),
];
/// Near plane of a map, as a share of the scene's extent.
const NEAR: f32 = 1e-4;
/// A wider spot is drawn as a point, radians.
const WIDEST_SPOT: f32 = 1.2;
/// Texels beyond the edge of a face for interpolation.
const BORDER: f32 = 2.0;

/// How shadow maps are drawn and read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapSettings {
    /// Texels across and down a map or a face.
    pub resolution: u32,
    /// Texels each way over which the edge of a shadow is softened.
    pub pcf_radius: u32,
    /// Shift of a point along its normal, texels: too little makes acne, too much lets light through thin walls.
    pub normal_offset: f32,
    /// Shift of a point towards the light, as deep as its surface falls over so many texels: too little makes acne, too
    /// much detaches shadows.
    pub slope_bias: f32,
}

impl Default for MapSettings {
    fn default() -> Self {
        Self { resolution: 2048, pcf_radius: 1, normal_offset: 0.4, slope_bias: 0.7 }
    }
}

/// `ShadowMap` of shaders/shared/visibility_map.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct MapUniform {
    projection_from_world: [Mat4; 6],
    num_faces: u32,
    texel: f32,
    normal_offset: f32,
    slope_bias: f32,
    pcf_radius: i32,
    padding: [u32; 7],
}

/// Shadow map pass.
pub struct ShadowMapPass {
    opaque: wgpu::RenderPipeline,
    mask: wgpu::RenderPipeline,
    blend: wgpu::RenderPipeline,
    face_layout: wgpu::BindGroupLayout,
    read_layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    map: Option<Map>,
}

/// The texture of all faces, used for one light after the other.
struct Map {
    resolution: u32,
    faces: Vec<wgpu::TextureView>,
    all: wgpu::TextureView,
}

impl ShadowMapPass {
    /// Pipelines and sampler.
    pub fn new(gpu: &Gpu) -> Self {
        let module = shaders::SHADOW_MAP.module(&gpu.device);
        let face_layout = face_layout(gpu);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shadow map"),
            bind_group_layouts: &[None, Some(&face_layout), Some(&material_layout(gpu))],
            immediate_size: 0,
        });
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("shadow map"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::GreaterEqual),
            ..Default::default()
        });
        Self {
            opaque: pipeline(gpu, &layout, &module, None),
            mask: pipeline(gpu, &layout, &module, Some(1.0)),
            blend: pipeline(gpu, &layout, &module, Some(2.0)),
            read_layout: read_layout(gpu),
            face_layout,
            sampler,
            map: None,
        }
    }

    /// Layout of bind group 2 of the pass that reads the map.
    pub fn read_layout(&self) -> &wgpu::BindGroupLayout {
        &self.read_layout
    }

    /// Makes room for maps of this resolution.
    pub fn prepare(&mut self, gpu: &Gpu, settings: &MapSettings) {
        if self.map.as_ref().is_none_or(|map| map.resolution != settings.resolution) {
            self.map = Some(Map::new(gpu, settings.resolution));
        }
    }

    /// Draws the map of a light sample and binds it for the pass that reads it.
    pub fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        subject: Subject<'_>,
        sample: &LightSample,
        settings: &MapSettings,
    ) -> wgpu::BindGroup {
        let map = self.map.as_ref().expect("room for maps has been made");
        let uniform = MapUniform::new(subject.shadows.scene(), sample, settings);
        let faces = uniform.projection_from_world.iter().zip(&map.faces).take(uniform.num_faces as usize);
        for (projection_from_world, face) in faces {
            self.draw_face(gpu, encoder, subject, projection_from_world, face);
        }
        let uniform = uniform_buffer(gpu, bytemuck::bytes_of(&uniform));
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shadow map"),
            layout: &self.read_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&map.all) },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(&self.sampler) },
            ],
        })
    }

    fn draw_face(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        subject: Subject<'_>,
        projection_from_world: &Mat4,
        face: &wgpu::TextureView,
    ) {
        let uniform = uniform_buffer(gpu, bytemuck::bytes_of(projection_from_world));
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shadow map face"),
            layout: &self.face_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow map"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: face,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(1, &bindings, &[]);
        bind_mesh(&mut pass, subject.scene);
        for batch in &subject.scene.batches {
            pass.set_pipeline(match batch.alpha_mode {
                AlphaMode::Opaque => &self.opaque,
                AlphaMode::Mask { .. } => &self.mask,
                AlphaMode::Blend => &self.blend,
            });
            pass.set_bind_group(2, &subject.scene.materials[batch.material.index()], &[]);
            pass.draw_indexed(batch.indices.clone(), 0, 0..1);
        }
    }
}

impl Map {
    fn new(gpu: &Gpu, resolution: u32) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shadow map"),
            size: wgpu::Extent3d { width: resolution, height: resolution, depth_or_array_layers: 6 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: DEPTH_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let view = |first, count| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(if count == 1 {
                    wgpu::TextureViewDimension::D2
                } else {
                    wgpu::TextureViewDimension::D2Array
                }),
                base_array_layer: first,
                array_layer_count: Some(count),
                ..Default::default()
            })
        };
        Self { resolution, faces: (0..6).map(|face| view(face, 1)).collect(), all: view(0, 6) }
    }
}

impl MapUniform {
    fn new(scene: &Scene, sample: &LightSample, settings: &MapSettings) -> Self {
        let (low, high) = scene.bounds();
        let near = NEAR * (high - low).max_element();
        let resolution = settings.resolution as f32;
        let border = BORDER + settings.pcf_radius as f32;
        let (projections, half_width) = match sample.light.kind {
            LightKind::Directional { direction } => fitted((low, high), direction, resolution, border),
            LightKind::Spot { position, direction, outer_angle, .. } if outer_angle < WIDEST_SPOT => {
                let half_width = outer_angle.tan() * resolution / (resolution - 2.0 * border);
                let up = tangent_frame(direction).0;
                (vec![perspective(half_width, near) * look_to_mat4(position, direction, up)], half_width)
            }
            LightKind::Spot { position, .. } | LightKind::Point { position } => {
                let half_width = resolution / (resolution - 2.0 * border);
                let face = |(axis, up)| perspective(half_width, near) * look_to_mat4(position, axis, up);
                (FACES.map(face).to_vec(), half_width)
            }
        };
        let mut projection_from_world = [Mat4::IDENTITY; 6];
        projection_from_world[..projections.len()].copy_from_slice(&projections);
        Self {
            projection_from_world,
            num_faces: projections.len() as u32,
            texel: 2.0 * half_width / resolution,
            normal_offset: settings.normal_offset,
            slope_bias: settings.slope_bias,
            pcf_radius: settings.pcf_radius as i32,
            padding: [0; 7],
        }
    }
}

fn perspective(half_width: f32, near: f32) -> Mat4 {
    directx::perspective_infinite_reverse(2.0 * half_width.atan(), 1.0, near)
}

/// An orthographic map along `direction` that holds the whole box, and half its width.
///
/// Its middle lies on a grid of whole texels, so that a scene that grows a little does not make its shadows crawl.
fn fitted((low, high): (Vec3, Vec3), direction: Vec3, resolution: f32, border: f32) -> (Vec<Mat4>, f32) {
    let view_from_world = look_to_mat4(Vec3::ZERO, direction, tangent_frame(direction).0);
    let corner = |i: u32| Vec3::select(glam::BVec3::new(i & 1 > 0, i & 2 > 0, i & 4 > 0), high, low);
    let corners: Vec<Vec3> = (0..8).map(|i| view_from_world.transform_point3(corner(i))).collect();
    let least = corners.iter().copied().fold(Vec3::INFINITY, Vec3::min);
    let most = corners.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
    let half_width = 0.5 * (most - least).xy().max_element() * resolution / (resolution - 2.0 * border);
    let texel = 2.0 * half_width / resolution;
    let middle = ((0.5 * (least + most)).xy() / texel).round() * texel;
    let margin = 1e-3 * (most - least).max_element();
    // Far before near reverses the depth.
    let projection_from_view = directx::orthographic(
        middle.x - half_width,
        middle.x + half_width,
        middle.y - half_width,
        middle.y + half_width,
        margin - least.z,
        -margin - most.z,
    );
    (vec![projection_from_view * view_from_world], half_width)
}

fn uniform_buffer(gpu: &Gpu, contents: &[u8]) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::UNIFORM;
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some("shadow map"), contents, usage })
}

fn entry(binding: u32, visibility: wgpu::ShaderStages, ty: wgpu::BindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

const UNIFORM: wgpu::BindingType = wgpu::BindingType::Buffer {
    ty: wgpu::BufferBindingType::Uniform,
    has_dynamic_offset: false,
    min_binding_size: None,
};

fn face_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("shadow map face"),
        entries: &[entry(0, wgpu::ShaderStages::VERTEX, UNIFORM)],
    })
}

fn read_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let depth = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Depth,
        view_dimension: wgpu::TextureViewDimension::D2Array,
        multisampled: false,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison);
    let read = wgpu::ShaderStages::FRAGMENT;
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("shadow map"),
        entries: &[entry(0, read, UNIFORM), entry(1, read, depth), entry(2, read, sampler)],
    })
}

/// A pipeline for casters that are opaque, or that have the `ALPHA_MODE` of shaders/shared/material.wgsl.
fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    alpha_mode: Option<f64>,
) -> wgpu::RenderPipeline {
    let constants = [("ALPHA_MODE", alpha_mode.unwrap_or(0.0))];
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("shadow map"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(GpuVertex::LAYOUT)],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: alpha_mode.map(|_| wgpu::FragmentState {
            module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shaders::{DIRECT_LIGHT_MAP, struct_layout};

    #[test]
    fn the_uniform_is_as_long_as_the_shader_reads_it() {
        let layout = struct_layout(&DIRECT_LIGHT_MAP, "ShadowMap");
        assert_eq!(layout.last(), Some(&size_of::<MapUniform>()));
        assert_eq!(layout[5], std::mem::offset_of!(MapUniform, pcf_radius));
    }

    #[test]
    fn a_fitted_map_holds_the_box() {
        let (low, high) = (Vec3::new(-3.0, 0.0, 1.0), Vec3::new(4.0, 5.0, 9.0));
        let (maps, _) = fitted((low, high), Vec3::new(0.3, -0.8, 0.5).normalize(), 512.0, 3.0);
        for point in [low, high, Vec3::new(low.x, high.y, low.z), 0.5 * (low + high)] {
            let seen = maps[0].project_point3(point);
            assert!(
                seen.truncate().abs().max_element() <= 1.0 && (0.0..=1.0).contains(&seen.z),
                "{point} is at {seen}"
            );
        }
    }
}
