//! Fills the tiles of a coarse mesh with the light of the vertices, unless they hold that light already.
//!
//! A tile holds the radiance of white paint. At the vertices of the elements that its triangle replaces, the values are
//! those of the vertices; the texels between are linear in each element. Tiles were designed for software rendering,
//! where a picture of a fifth as many triangles is drawn faster. They also serve hardware, where the gain is not
//! measured.

use std::collections::HashMap;
use std::sync::PoisonError;

use glam::Vec3;

use crate::base::ids::GroupId;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::RenderSettings;
use crate::render::scene::SceneBuffers;
use crate::render::scene::tiles::{HeldLight, Tiles};
use crate::render::settings::MAX_GROUPS;

/// Shader that fills tiles.
pub(in crate::render) const LIGHT_TILES: Shader =
    shader!("light tiles", "shared/frame.wgsl", "stored_light/light_tiles.wgsl");

/// Invocations of a compute group.
const GROUP: u32 = 64;
/// Largest number of compute groups along one axis that every device can dispatch.
const MAX_ROW: u32 = 65_535;

/// Pipelines for vertices, for texels inside elements, and for texels beyond the long sides of tiles.
struct Pipelines {
    vertices: wgpu::ComputePipeline,
    inside: wgpu::ComputePipeline,
    beyond: wgpu::ComputePipeline,
}

/// The light that tiles are filled with.
#[derive(Clone, Copy)]
pub struct TileLight<'a> {
    /// The scene of the tiles.
    pub scene: &'a SceneBuffers,
    /// Settings with the weights of its light.
    pub settings: &'a RenderSettings,
    /// The light of its vertices, summed over the light groups with these weights.
    pub weighted: &'a wgpu::Buffer,
    /// True if direct light comes from the lights themselves. Tiles then hold no direct light.
    pub lit_by_lights: bool,
}

/// Fills tiles.
pub struct TileFiller {
    layout: wgpu::BindGroupLayout,
    pipeline_layout: wgpu::PipelineLayout,
    /// Pipelines by `lit_by_lights`; each is created for the first picture that needs it.
    pipelines: HashMap<bool, Pipelines>,
}

impl TileFiller {
    /// Creates the layouts. Pipelines are created with the first picture.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout) -> Self {
        let layout = bind_group_layout(gpu);
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("light tiles"),
            bind_group_layouts: &[Some(frame_layout), Some(&layout)],
            immediate_size: 0,
        });
        Self { layout, pipeline_layout, pipelines: HashMap::new() }
    }

    /// Fills `tiles` with the light of their scene, unless they hold that light already.
    pub fn fill(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        frame: &wgpu::BindGroup,
        tiles: &Tiles,
        light: TileLight<'_>,
    ) {
        let TileLight { scene, settings, weighted, lit_by_lights } = light;
        let wanted = HeldLight { light: scene.light_version(), weights: weights(settings, lit_by_lights) };
        let mut held = tiles.held.lock().unwrap_or_else(PoisonError::into_inner);
        if held.as_ref() == Some(&wanted) {
            return;
        }
        *held = Some(wanted);
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("light tiles"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: weighted.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: tiles.elements.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 2, resource: tiles.element_of.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 3, resource: tiles.beyond.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 4, resource: wgpu::BindingResource::TextureView(&tiles.light) },
                wgpu::BindGroupEntry { binding: 5, resource: tiles.radiances.as_entire_binding() },
            ],
        });
        let pipelines = self.pipelines.entry(lit_by_lights);
        let pipelines = pipelines.or_insert_with(|| Pipelines::new(gpu, &self.pipeline_layout, lit_by_lights));
        let descriptor = wgpu::ComputePassDescriptor { label: Some("light tiles"), timestamp_writes: None };
        let mut pass = encoder.begin_compute_pass(&descriptor);
        pass.set_bind_group(0, frame, &[]);
        pass.set_bind_group(1, &bindings, &[]);
        pass.set_pipeline(&pipelines.vertices);
        let num_groups = (scene.num_vertices() as u32).div_ceil(GROUP);
        pass.dispatch_workgroups(num_groups.min(MAX_ROW), num_groups.div_ceil(MAX_ROW), 1);
        pass.set_pipeline(&pipelines.inside);
        pass.dispatch_workgroups(tiles.side.div_ceil(GROUP), tiles.side, 1);
        pass.set_pipeline(&pipelines.beyond);
        let num_beyond = (tiles.beyond.size() / 4) as u32;
        pass.dispatch_workgroups(num_beyond.div_ceil(GROUP), 1, 1);
    }
}

/// Returns all numbers that the light of the tiles depends on.
fn weights(settings: &RenderSettings, lit_by_lights: bool) -> Vec<Vec3> {
    let direct = if lit_by_lights { 0.0 } else { settings.direct };
    let groups = (0..MAX_GROUPS).map(|group| settings.group_weight(GroupId::new(group)));
    groups.chain([settings.ambient, Vec3::new(direct, settings.indirect, 0.0)]).collect()
}

impl Pipelines {
    fn new(gpu: &Gpu, layout: &wgpu::PipelineLayout, lit_by_lights: bool) -> Self {
        let module = LIGHT_TILES.module(gpu);
        let constants = [("LIT_BY_LIGHTS", f64::from(u8::from(lit_by_lights)))];
        let pipeline = |entry_point| {
            gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("light tiles"),
                layout: Some(layout),
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
                cache: None,
            })
        };
        Self { vertices: pipeline("sum_up"), inside: pipeline("fill"), beyond: pipeline("fill_beyond") }
    }
}

fn bind_group_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::COMPUTE, ty, count: None };
    let buffer = |read_only| wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Storage { read_only },
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let texture = wgpu::BindingType::StorageTexture {
        access: wgpu::StorageTextureAccess::WriteOnly,
        format: crate::render::targets::HDR_FORMAT,
        view_dimension: wgpu::TextureViewDimension::D2,
    };
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("light tiles"),
        entries: &[
            entry(0, buffer(true)),
            entry(1, buffer(true)),
            entry(2, buffer(true)),
            entry(3, buffer(true)),
            entry(4, texture),
            entry(5, buffer(false)),
        ],
    })
}
