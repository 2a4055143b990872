//! Pipelines of the surface pass: one for each kind of surface and each way to show it. Each is compiled for its case,
//! so shaders need no branches.

use crate::gpu::Gpu;
use crate::render::scene::draw_batch::{DrawBatch, Faces};
use crate::render::scene::gpu_vertex::GpuVertex;
use crate::render::stored_light::weighted_light::WeightedLight;
use crate::render::targets::{DEPTH_FORMAT, HDR_FORMAT, LUMINANCE_FORMAT};
use crate::render::{RenderSettings, Shading, ToneMap};
use crate::scene::AlphaMode;

/// Blend state of premultiplied colour: source + (1 - source alpha) x target, for colour and alpha.
const PREMULTIPLIED: wgpu::BlendState = wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING;

/// Replaces colour and keeps the larger alpha. With alpha to coverage, a multisample that a masked
/// surface hits is fully covered, but the alpha written to it is the share of the pixel that is covered. If that
/// replaced the alpha 1 of a surface behind, the background would show through.
const KEEP_LARGER_ALPHA: wgpu::BlendState = wgpu::BlendState {
    color: wgpu::BlendComponent::REPLACE,
    alpha: wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Max,
    },
};

/// State of a pipeline for one alpha mode.
struct AlphaVariant {
    label: &'static str,
    /// `ALPHA_MODE` of the shader.
    shader_mode: f64,
    blend: Option<wgpu::BlendState>,
    writes_depth: bool,
    to_coverage: bool,
}

const OPAQUE: AlphaVariant =
    AlphaVariant { label: "opaque", shader_mode: 0.0, blend: None, writes_depth: true, to_coverage: false };
const MASK: AlphaVariant = AlphaVariant {
    label: "mask",
    shader_mode: 1.0,
    blend: Some(KEEP_LARGER_ALPHA),
    writes_depth: true,
    to_coverage: true,
};
const BLEND: AlphaVariant = AlphaVariant {
    label: "blend",
    shader_mode: 2.0,
    blend: Some(PREMULTIPLIED),
    writes_depth: false,
    to_coverage: false,
};

/// Everything that is fixed when a pipeline is created.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Variant {
    shading: Shading,
    alpha: Alpha,
    has_textures: bool,
    is_unlit: bool,
    /// True if light is in tiles. This needs another shader module.
    pub is_tiled: bool,
    culls: bool,
    has_dark_back: bool,
    metal_as_diffuse: bool,
    output: Output,
}

/// What the pass writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// Radiance times pre-exposure, into [`HDR_FORMAT`].
    Radiance,
    /// Display colours by this tone map, into a target of this format.
    Display(wgpu::TextureFormat, ToneMap),
    /// Display colours as for [`Self::Display`], and luminance times pre-exposure into [`LUMINANCE_FORMAT`].
    DisplayAndLuminance(wgpu::TextureFormat, ToneMap),
}

/// The alpha mode of a material, without its cut-off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Alpha {
    Opaque,
    Mask,
    Blend,
}

impl Variant {
    /// Returns the variant that draws a batch with these settings.
    pub fn new(batch: &DrawBatch, settings: &RenderSettings, output: Output) -> Self {
        Self {
            shading: settings.shading,
            alpha: match batch.alpha_mode {
                AlphaMode::Opaque => Alpha::Opaque,
                AlphaMode::Mask { .. } => Alpha::Mask,
                AlphaMode::Blend => Alpha::Blend,
            },
            has_textures: batch.has_textures,
            is_unlit: batch.is_unlit,
            is_tiled: batch.is_tiled,
            culls: batch.faces.are_culled(settings.cull_back),
            has_dark_back: batch.faces == Faces::Front && !settings.cull_back,
            metal_as_diffuse: settings.metal_as_diffuse,
            output,
        }
    }

    /// Creates the pipeline for targets with `samples` samples a pixel. `constants` are those of the direct light.
    pub fn pipeline(
        self,
        gpu: &Gpu,
        layout: &wgpu::PipelineLayout,
        module: &wgpu::ShaderModule,
        samples: u32,
        mut constants: Vec<(&'static str, f64)>,
    ) -> wgpu::RenderPipeline {
        let alpha = match self.alpha {
            Alpha::Opaque => &OPAQUE,
            Alpha::Mask => &MASK,
            Alpha::Blend => &BLEND,
        };
        let to_coverage = alpha.to_coverage && samples > 1;
        let switch = |is_on: bool| f64::from(u8::from(is_on));
        constants.extend([
            ("SHADING", f64::from(self.shading.number())),
            ("HAS_TEXTURES", switch(self.has_textures)),
            ("IS_UNLIT", switch(self.is_unlit)),
            ("HAS_DARK_BACK", switch(self.has_dark_back)),
            ("METAL_AS_DIFFUSE", switch(self.metal_as_diffuse)),
            ("ALPHA_MODE", alpha.shader_mode),
            ("ALPHA_TO_COVERAGE", switch(to_coverage)),
        ]);
        let format = match self.output {
            Output::Radiance => HDR_FORMAT,
            Output::Display(format, tone_map) | Output::DisplayAndLuminance(format, tone_map) => {
                let encodes = switch(format.is_srgb());
                let tone_map = f64::from(tone_map.number());
                constants.extend([("DISPLAYS", 1.0), ("TARGET_ENCODES", encodes), ("TONE_MAP", tone_map)]);
                format
            }
        };
        let options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
        let cull_mode = self.culls.then_some(wgpu::Face::Back);
        let target = |format, blend| Some(wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::ALL });
        let mut targets = vec![target(format, alpha.blend)];
        if matches!(self.output, Output::DisplayAndLuminance(..)) {
            targets.push(target(LUMINANCE_FORMAT, None));
        }
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(&format!("surface, {}, {}", alpha.label, if self.culls { "culled" } else { "two-faced" })),
            layout: Some(layout),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some("vertex"),
                compilation_options: options.clone(),
                buffers: &[Some(GpuVertex::LAYOUT), Some(WeightedLight::LAYOUT)],
            },
            primitive: wgpu::PrimitiveState { cull_mode, ..Default::default() },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(alpha.writes_depth),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: samples,
                alpha_to_coverage_enabled: to_coverage,
                ..Default::default()
            },
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some("fragment"),
                compilation_options: options,
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}
