//! Surface pass: radiance of every visible point, with the light of the vertices.

use std::collections::HashMap;

use super::weighted_light::WeightedLight;
use super::{Look, Shading};
use crate::gpu::material_buffers::material_layout;
use crate::gpu::scene_buffers::{Batch, Faces, GpuVertex};
use crate::gpu::targets::{DEPTH_FORMAT, HDR_FORMAT, Targets};
use crate::gpu::{Gpu, SceneBuffers, shaders};
use crate::scene::AlphaMode;

/// Colour is premultiplied and coverage adds up under it.
const PREMULTIPLIED: wgpu::BlendState = wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING;

/// A mask's samples are solid, but their alpha is the coverage of the pixel: it must not thin what lies behind.
const KEEP_LARGER_ALPHA: wgpu::BlendState = wgpu::BlendState {
    color: wgpu::BlendComponent::REPLACE,
    alpha: wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Max,
    },
};

/// A kind of alpha as a pipeline knows it.
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

/// What is fixed when a pipeline is made, so that its shader has no branch for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Variant {
    shading: Shading,
    alpha: Alpha,
    has_textures: bool,
    culls: bool,
}

/// How alpha acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Alpha {
    Opaque,
    Mask,
    Blend,
}

impl Variant {
    fn new(batch: &Batch, look: &Look) -> Self {
        Self {
            shading: look.shading,
            alpha: match batch.alpha_mode {
                AlphaMode::Opaque => Alpha::Opaque,
                AlphaMode::Mask { .. } => Alpha::Mask,
                AlphaMode::Blend => Alpha::Blend,
            },
            has_textures: batch.has_textures,
            culls: match batch.faces {
                Faces::Front => look.cull_back,
                Faces::FrontOfTwins => true,
                Faces::Both => false,
            },
        }
    }
}

/// Surface pass.
pub struct SurfacePass {
    layout: wgpu::PipelineLayout,
    module: wgpu::ShaderModule,
    samples: u32,
    /// Made when they are first needed.
    pipelines: HashMap<Variant, wgpu::RenderPipeline>,
    /// Of bind group 3, where there is one.
    direct_layout: Option<wgpu::BindGroupLayout>,
}

/// Where direct light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direct {
    /// The vertices, as baked.
    Stored,
    /// A texture of irradiance, one value a pixel.
    Pixels,
    /// A texture of irradiance with several samples a pixel.
    Samples,
}

impl Direct {
    fn shader(self) -> &'static shaders::Shader {
        match self {
            Direct::Stored => &shaders::SURFACE,
            Direct::Pixels => &shaders::SURFACE_LIT,
            Direct::Samples => &shaders::SURFACE_LIT_SAMPLES,
        }
    }

    fn layout(self, gpu: &Gpu) -> Option<wgpu::BindGroupLayout> {
        let texture = wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: self == Direct::Samples,
            },
            count: None,
        };
        let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some("direct irradiance"), entries: &[texture] };
        (self != Direct::Stored).then(|| gpu.device.create_bind_group_layout(&descriptor))
    }
}

impl SurfacePass {
    /// A pass for HDR targets with `samples` samples a pixel, and for direct light from `direct`.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout, samples: u32, direct: Direct) -> Self {
        let direct_layout = direct.layout(gpu);
        let module = direct.shader().module(&gpu.device);
        let material = material_layout(gpu);
        let mut layouts = vec![Some(frame_layout), None, Some(&material)];
        layouts.extend(direct_layout.as_ref().map(Some));
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("surface"),
            bind_group_layouts: &layouts,
            immediate_size: 0,
        });
        Self { layout, module, samples, pipelines: HashMap::new(), direct_layout }
    }

    /// Clears the targets and draws the scene into them, its vertices in `light`; `direct` is the texture that [`Direct`] promised.
    #[expect(clippy::too_many_arguments, reason = "where to draw (encoder, targets) and what of it")]
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        frame: &wgpu::BindGroup,
        scene: &SceneBuffers,
        light: &wgpu::Buffer,
        look: &Look,
        direct: Option<&wgpu::TextureView>,
    ) {
        for variant in scene.batches.iter().map(|batch| Variant::new(batch, look)) {
            if !self.pipelines.contains_key(&variant) {
                self.pipelines.insert(variant, self.pipeline(gpu, variant));
            }
        }
        let direct = self.direct_layout.as_ref().zip(direct).map(|(layout, view)| bind_direct(gpu, layout, view));
        let mut pass = begin(encoder, targets);
        if direct.is_some() {
            pass.set_bind_group(3, &direct, &[]);
        }
        pass.set_bind_group(0, frame, &[]);
        if !scene.batches.is_empty() {
            pass.set_vertex_buffer(0, scene.vertices.slice(..));
            pass.set_vertex_buffer(1, light.slice(..));
            pass.set_index_buffer(scene.indices.slice(..), wgpu::IndexFormat::Uint32);
        }
        for batch in &scene.batches {
            pass.set_pipeline(&self.pipelines[&Variant::new(batch, look)]);
            pass.set_bind_group(2, &scene.materials[batch.material.index()], &[]);
            pass.draw_indexed(batch.indices.clone(), 0, 0..1);
        }
    }

    fn pipeline(&self, gpu: &Gpu, variant: Variant) -> wgpu::RenderPipeline {
        let alpha = match variant.alpha {
            Alpha::Opaque => &OPAQUE,
            Alpha::Mask => &MASK,
            Alpha::Blend => &BLEND,
        };
        let switch = |is_on: bool| f64::from(u8::from(is_on));
        let constants = [
            ("SHADING", f64::from(variant.shading.number())),
            ("HAS_TEXTURES", switch(variant.has_textures)),
            ("ALPHA_MODE", alpha.shader_mode),
            ("ALPHA_TO_COVERAGE", switch(alpha.to_coverage && self.samples > 1)),
            ("LIT_BY_LIGHTS", switch(self.direct_layout.is_some())),
        ];
        pipeline(gpu, &self.layout, &self.module, self.samples, alpha, &constants, variant.culls)
    }
}

fn bind_direct(gpu: &Gpu, layout: &wgpu::BindGroupLayout, view: &wgpu::TextureView) -> wgpu::BindGroup {
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("direct irradiance"),
        layout,
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(view) }],
    })
}

/// Begins the pass with nothing drawn: no light, no coverage, infinitely far.
fn begin<'e>(encoder: &'e mut wgpu::CommandEncoder, targets: &Targets) -> wgpu::RenderPass<'e> {
    let (view, resolve_target) = match &targets.samples {
        Some(samples) => (samples, Some(&targets.hdr_view)),
        None => (&targets.hdr_view, None),
    };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("surface"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &targets.depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    samples: u32,
    alpha: &AlphaVariant,
    constants: &[(&str, f64)],
    culls: bool,
) -> wgpu::RenderPipeline {
    let compilation_options = wgpu::PipelineCompilationOptions { constants, ..Default::default() };
    let cull_mode = culls.then_some(wgpu::Face::Back);
    let target = wgpu::ColorTargetState { format: HDR_FORMAT, blend: alpha.blend, write_mask: wgpu::ColorWrites::ALL };
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(&format!("surface, {}, {}", alpha.label, if culls { "culled" } else { "two-faced" })),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: compilation_options.clone(),
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
            alpha_to_coverage_enabled: alpha.to_coverage && samples > 1,
            ..Default::default()
        },
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("fragment"),
            compilation_options,
            targets: &[Some(target)],
        }),
        multiview_mask: None,
        cache: None,
    })
}
