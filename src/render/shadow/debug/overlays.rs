//! Debug views that colour pixels: counts of the stencil, and the shadow map.

use super::super::light_samples::LightSample;
use super::super::pipeline::PipelineRecipe;
use super::super::planar_shadow::SHADOWS;
use super::ShadowTechnique;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::turbo;

/// What the stencil counts, in colours over a picture.
pub(in crate::render) const STENCIL_COUNTS: Shader = shader!(
    "stencil counts",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "display/false_colour.wgsl",
    "stencil_counts.wgsl"
);
/// Depth in the faces of a shadow map.
pub(in crate::render) const MAP_FACES: Shader = shader!(
    "map faces",
    "shared/colour.wgsl",
    "shared/light_sample.wgsl",
    "shared/one_light.wgsl",
    "shared/shadow_map.wgsl",
    "shared/map_lookup.wgsl",
    "shared/visibility_map.wgsl",
    "map_faces.wgsl"
);

/// Counts from here on have one colour, as in shaders/stencil_counts.wgsl.
const MOST: u32 = 8;

/// Colour of a positive count, sRGB.
#[must_use]
pub fn count_colour(count: u32) -> [u8; 3] {
    turbo(count.min(MOST) as f32 / MOST as f32)
}

/// Colours pixels by what the stencil counts.
pub struct StencilOverlay {
    layout: wgpu::BindGroupLayout,
    volumes: wgpu::RenderPipeline,
    planar: wgpu::RenderPipeline,
}

impl StencilOverlay {
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
        Self { volumes: counts(255.0), planar: counts(f64::from(SHADOWS)), layout }
    }

    pub fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        stencil: &wgpu::TextureView,
        technique: ShadowTechnique,
    ) {
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("stencil counts"),
            layout: &self.layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(stencil) }],
        });
        let mut pass = begin(encoder, target, wgpu::LoadOp::Load);
        pass.set_pipeline(if technique == ShadowTechnique::Planar { &self.planar } else { &self.volumes });
        pass.set_bind_group(1, &bindings, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// Shows the faces of a shadow map in place of the picture.
pub struct MapOverlay {
    perspective: wgpu::RenderPipeline,
    orthographic: wgpu::RenderPipeline,
}

impl MapOverlay {
    pub fn new(gpu: &Gpu, map_layout: &wgpu::BindGroupLayout, output_format: wgpu::TextureFormat) -> Self {
        let layouts = [None, None, Some(map_layout)];
        let shows =
            |is_perspective| pipeline(gpu, &MAP_FACES, &layouts, output_format, ("IS_PERSPECTIVE", is_perspective));
        Self { perspective: shows(1.0), orthographic: shows(0.0) }
    }

    pub fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        size: [u32; 2],
        (num_faces, map): &(u32, wgpu::BindGroup),
        sample: &LightSample,
    ) {
        let mut pass = begin(encoder, target, wgpu::LoadOp::Clear(wgpu::Color::BLACK));
        pass.set_pipeline(if sample.place().w == 0.0 { &self.orthographic } else { &self.perspective });
        pass.set_bind_group(2, map, &[]);
        // Square faces, three in a row.
        let columns = if *num_faces == 6 { 3 } else { 1 };
        let rows = num_faces / columns;
        let side = (size[0] / columns).min(size[1] / rows).max(1);
        let corner = [(size[0] - columns * side) / 2, (size[1] - rows * side) / 2];
        for face in 0..*num_faces {
            let [x, y] = [corner[0] + face % columns * side, corner[1] + face / columns * side].map(|at| at as f32);
            pass.set_viewport(x, y, side as f32, side as f32, 0.0, 1.0);
            pass.draw(0..3, face..face + 1);
        }
    }
}

fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
    load: wgpu::LoadOp<wgpu::Color>,
) -> wgpu::RenderPass<'e> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("shadow debug"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    })
}

fn pipeline(
    gpu: &Gpu,
    shader: &Shader,
    layouts: &[Option<&wgpu::BindGroupLayout>],
    output_format: wgpu::TextureFormat,
    constant: (&str, f64),
) -> wgpu::RenderPipeline {
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(shader.name),
        bind_group_layouts: layouts,
        immediate_size: 0,
    });
    let target = wgpu::ColorTargetState {
        format: output_format,
        blend: Some(wgpu::BlendState::ALPHA_BLENDING),
        write_mask: wgpu::ColorWrites::ALL,
    };
    PipelineRecipe {
        constants: &[constant, ("TARGET_ENCODES", f64::from(u8::from(output_format.is_srgb())))],
        vertex: None,
        fragment: Some(("fragment", &[Some(target)])),
        ..PipelineRecipe::new(shader.name, &layout, &shader.module(gpu))
    }
    .make(gpu)
}
