//! Light meter: computes the exposure of a picture on the GPU, so no frame waits for it.
//!
//! A histogram of log2 luminance yields the log-average. The exposure places it at middle grey, 0.2 of white (Reinhard
//! et al. 2002, "Photographic Tone Reproduction for Digital Images", eq. 1), unless the brightest twentieth of the
//! pixels would then exceed one and a half times white. `display::cpu_tone_map` states the equation.

use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::targets::Targets;

/// Shader of the light meter.
pub(in crate::render) const METER: Shader =
    shader!("meter", "shared/frame.wgsl", "shared/colour.wgsl", "display/light_meter.wgsl");

/// `NUM_BINS` of shaders/display/light_meter.wgsl.
const NUM_BINS: u64 = 256;
/// Width and height of a compute group, invocations.
const GROUP: u32 = 16;

/// Input of the light meter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeterInput {
    /// Radiance and coverage.
    Radiance,
    /// Luminance alone, of a picture whose surface pass writes display colours directly.
    Luminance,
}

impl MeterInput {
    /// Returns the distance between counted pixels, along rows and along columns.
    fn step(self) -> u32 {
        match self {
            MeterInput::Radiance => 2,
            MeterInput::Luminance => 4,
        }
    }
}

/// Light meter.
pub struct LightMeter {
    layout: wgpu::BindGroupLayout,
    count: wgpu::ComputePipeline,
    count_luminance: wgpu::ComputePipeline,
    settle: wgpu::ComputePipeline,
    histogram: wgpu::Buffer,
    exposure: wgpu::Buffer,
}

impl LightMeter {
    /// Creates pipelines and histogram. The result is written to `exposure`.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout, exposure: wgpu::Buffer) -> Self {
        let module = METER.module(gpu);
        let layout = bind_group_layout(gpu);
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("meter"),
            bind_group_layouts: &[Some(frame_layout), Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = |entry_point, constants| {
            gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(&format!("meter, {entry_point}")),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
                cache: None,
            })
        };
        Self {
            count: pipeline("count", &[("STEP", f64::from(MeterInput::Radiance.step()))]),
            count_luminance: pipeline(
                "count",
                &[("IS_LUMINANCE", 1.0), ("STEP", f64::from(MeterInput::Luminance.step()))],
            ),
            settle: pipeline("settle", &[]),
            histogram: storage(gpu, "luminance histogram", NUM_BINS * 4),
            exposure,
            layout,
        }
    }

    /// Returns the buffer of the exposure, one f32: displayed = radiance times this. It is 0 before anything was
    /// metered.
    pub fn exposure(&self) -> &wgpu::Buffer {
        &self.exposure
    }

    /// Creates the buffer of an exposure that was not metered yet.
    pub fn new_exposure(gpu: &Gpu) -> wgpu::Buffer {
        storage(gpu, "metered exposure", 4)
    }

    /// Meters the last picture: computes its exposure.
    pub fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        input: MeterInput,
        frame: &wgpu::BindGroup,
    ) {
        let (picture, count) = match input {
            MeterInput::Radiance => (&targets.hdr_view, &self.count),
            MeterInput::Luminance => (targets.luminance(gpu), &self.count_luminance),
        };
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("meter"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(picture) },
                wgpu::BindGroupEntry { binding: 1, resource: self.histogram.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 2, resource: self.exposure.as_entire_binding() },
            ],
        });
        encoder.clear_buffer(&self.histogram, 0, None);
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("meter"), timestamp_writes: None });
        pass.set_bind_group(0, frame, &[]);
        pass.set_bind_group(1, &bindings, &[]);
        pass.set_pipeline(count);
        let [columns, rows] = targets.size.map(|side| side.div_ceil(GROUP * input.step()));
        pass.dispatch_workgroups(columns, rows, 1);
        pass.set_pipeline(&self.settle);
        pass.dispatch_workgroups(1, 1, 1);
    }
}

fn storage(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    })
}

fn bind_group_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::COMPUTE, ty, count: None };
    let buffer = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Storage { read_only: false },
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let texture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("meter"),
        entries: &[entry(0, texture), entry(1, buffer), entry(2, buffer)],
    })
}
