//! Debug view of the stencil: its counts in colours.

use super::overlay_pipeline::{begin, pipeline};
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::shadow::shared::stencil::SHADOW_BITS;
use crate::render::turbo;

const STENCIL_COUNTS: Shader = shader!(
    "stencil counts",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "display/false_colour.wgsl",
    "shadow/debug/stencil_counts.wgsl"
);
/// Largest count with a colour of its own, as in shaders/shadow/debug/stencil_counts.wgsl.
const MOST: u32 = 8;

/// Returns the colour of a positive count, sRGB.
#[must_use]
pub fn count_colour(count: u32) -> [u8; 3] {
    turbo(count.min(MOST) as f32 / MOST as f32)
}

/// Colours pixels by the counts in the stencil.
pub struct StencilCounts {
    layout: wgpu::BindGroupLayout,
    all_bits: wgpu::RenderPipeline,
    shadow_bits: wgpu::RenderPipeline,
}

impl StencilCounts {
    /// Creates pipelines.
    pub fn new(gpu: &Gpu, output_format: wgpu::TextureFormat) -> Self {
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("stencil counts"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Uint,
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                count: None,
            }],
        });
        let counts = |bits| pipeline(gpu, &STENCIL_COUNTS, &[None, Some(&layout)], output_format, ("COUNT_BITS", bits));
        Self { all_bits: counts(255.0), shadow_bits: counts(f64::from(SHADOW_BITS)), layout }
    }

    /// Draws the counts in `counted_bits` of `stencil`: `SHADOW_BITS` or all bits.
    pub fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        stencil: &wgpu::TextureView,
        counted_bits: u32,
    ) {
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("stencil counts"),
            layout: &self.layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(stencil) }],
        });
        let mut pass = begin(encoder, target, wgpu::LoadOp::Load);
        pass.set_pipeline(if counted_bits == SHADOW_BITS { &self.shadow_bits } else { &self.all_bits });
        pass.set_bind_group(1, &bindings, &[]);
        pass.draw(0..3, 0..1);
    }
}
