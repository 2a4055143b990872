//! The light of the vertices, summed over the light groups with the weights of the settings.
//!
//! ```text
//! E[v] = sum over groups g of weight[g] * E[g][v]
//! ```
//!
//! Light is linear, so dimming a lamp scales its group. A compute pass computes the sum when the light or a weight
//! changes, and the sum is cached until then. It does not depend on the camera.

use glam::Vec3;

use crate::base::ids::GroupId;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::RenderSettings;
use crate::render::scene::SceneBuffers;
use crate::render::scene::vertex_light::LightVersion;
use crate::render::settings::MAX_GROUPS;

/// Shader that sums over the light groups.
pub(in crate::render) const WEIGHTED_LIGHT: Shader =
    shader!("weighted light", "shared/frame.wgsl", "stored_light/weighted_light.wgsl");

/// Invocations of a compute group.
const GROUP: u32 = 64;
/// Largest number of compute groups in a row that every device can dispatch.
const MAX_ROW: u32 = 65_535;

/// Direct and indirect irradiance of a vertex.
type WeightedVertex = [Vec3; 2];

/// The summed light for a renderer, and the pass that computes it.
pub struct WeightedLight {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
    sum: Option<Sum>,
}

struct Sum {
    of: Summed,
    buffer: wgpu::Buffer,
}

/// The light and the weights that the cached sum was computed from.
#[derive(PartialEq)]
struct Summed {
    light: LightVersion,
    weights: [Vec3; MAX_GROUPS],
}

impl WeightedLight {
    /// Attributes of the vertex buffer: location 4 is direct irradiance, location 5 is indirect irradiance.
    pub const LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
        array_stride: size_of::<WeightedVertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![4 => Float32x3, 5 => Float32x3],
    };

    /// Creates the pipeline; nothing is summed yet.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout) -> Self {
        let layout = bind_group_layout(gpu);
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("weighted light"),
            bind_group_layouts: &[Some(frame_layout), Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("weighted light"),
            layout: Some(&pipeline_layout),
            module: &WEIGHTED_LIGHT.module(gpu),
            entry_point: Some("weigh"),
            compilation_options: Default::default(),
            cache: None,
        });
        Self { layout, pipeline, sum: None }
    }

    /// Returns the vertex buffer of the summed light of a scene. `frame` holds the weights of `settings`.
    pub fn of(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        frame: &wgpu::BindGroup,
        scene: &SceneBuffers,
        settings: &RenderSettings,
    ) -> &wgpu::Buffer {
        let of = Summed {
            light: scene.light_version(),
            weights: std::array::from_fn(|group| settings.group_weight(GroupId::new(group))),
        };
        let sum = match self.sum.take() {
            Some(last) if last.of == of => last,
            last => {
                let size = (scene.num_vertices().max(1) * size_of::<WeightedVertex>()) as u64;
                let buffer = last.map(|last| last.buffer).filter(|buffer| buffer.size() == size);
                let buffer = buffer.unwrap_or_else(|| vertex_buffer(gpu, size));
                self.add_up(gpu, encoder, frame, scene, &buffer);
                Sum { of, buffer }
            }
        };
        &self.sum.insert(sum).buffer
    }

    fn add_up(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        frame: &wgpu::BindGroup,
        scene: &SceneBuffers,
        buffer: &wgpu::Buffer,
    ) {
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("weighted light"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: scene.irradiance().as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: buffer.as_entire_binding() },
            ],
        });
        let descriptor = wgpu::ComputePassDescriptor { label: Some("weighted light"), timestamp_writes: None };
        let mut pass = encoder.begin_compute_pass(&descriptor);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, frame, &[]);
        pass.set_bind_group(1, &bindings, &[]);
        let num_groups = (scene.num_vertices() as u32).div_ceil(GROUP);
        pass.dispatch_workgroups(num_groups.min(MAX_ROW), num_groups.div_ceil(MAX_ROW), 1);
    }
}

fn vertex_buffer(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("weighted light"),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::VERTEX,
        mapped_at_creation: false,
    })
}

fn bind_group_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry = |binding, read_only| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("weighted light"),
        entries: &[entry(0, true), entry(1, false)],
    })
}
