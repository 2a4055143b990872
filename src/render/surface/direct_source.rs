//! Sources of direct light, and the shader and bindings of each.
//!
//! There are six shaders because constants, inputs and outputs of a shader are fixed when it is compiled. There are
//! four sources of direct light, and two of them have a second shader for stored light in tiles. The files are shared;
//! a shader differs in its `varying` and its `direct` part only. Merging them would add unused inputs to every vertex,
//! and a software driver writes and interpolates unused inputs too. [`DirectSource::Few`] was designed for software
//! rendering; it also serves hardware, where its gain is not measured.

use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::shadow::few_lights;
use crate::render::shadow::real_time::DirectLight;

/// Shader for light of the vertices.
pub(in crate::render) const SURFACE: Shader = shader!(
    "surface",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "display/display_colour.wgsl",
    "display/false_colour.wgsl",
    "shared/material.wgsl",
    "surface/varying.wgsl",
    "surface/pass.wgsl",
    "surface/direct_stored.wgsl"
);
/// Shader for light of the vertices, in tiles.
pub(in crate::render) const SURFACE_TILES: Shader = shader!(
    "surface, tiles",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "display/display_colour.wgsl",
    "display/false_colour.wgsl",
    "shared/material.wgsl",
    "surface/varying_tiles.wgsl",
    "surface/pass.wgsl",
    "surface/direct_stored.wgsl"
);
/// Shader for direct irradiance from a texture with one sample a pixel.
pub(in crate::render) const SURFACE_LIT: Shader = shader!(
    "surface lit",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "display/display_colour.wgsl",
    "display/false_colour.wgsl",
    "shared/material.wgsl",
    "surface/varying.wgsl",
    "surface/pass.wgsl",
    "surface/direct_one.wgsl"
);
/// Shader for direct irradiance from a texture with several samples a pixel.
pub(in crate::render) const SURFACE_LIT_SAMPLES: Shader = shader!(
    "surface lit samples",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "display/display_colour.wgsl",
    "display/false_colour.wgsl",
    "shared/material.wgsl",
    "surface/varying.wgsl",
    "surface/pass.wgsl",
    "surface/direct_many.wgsl"
);
/// Shader for direct light of a few light samples, which the pass adds itself.
pub(in crate::render) const SURFACE_FEW_LIGHTS: Shader = shader!(
    "surface few lights",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "display/display_colour.wgsl",
    "display/false_colour.wgsl",
    "shared/material.wgsl",
    "shadow/light/facet.wgsl",
    "shadow/light/light_sample.wgsl",
    "shadow/map/projection.wgsl",
    "shadow/map/pcf.wgsl",
    "surface/varying_few.wgsl",
    "surface/pass.wgsl",
    "surface/direct_few.wgsl"
);
/// Shader for direct light of a few light samples, with the light of the vertices in tiles.
pub(in crate::render) const SURFACE_FEW_LIGHTS_TILES: Shader = shader!(
    "surface few lights, tiles",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "display/display_colour.wgsl",
    "display/false_colour.wgsl",
    "shared/material.wgsl",
    "shadow/light/facet.wgsl",
    "shadow/light/light_sample.wgsl",
    "shadow/map/projection.wgsl",
    "shadow/map/pcf.wgsl",
    "surface/varying_few_tiles.wgsl",
    "surface/pass.wgsl",
    "surface/direct_few.wgsl"
);

/// Source of direct light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DirectSource {
    /// The vertices, as baked.
    Stored,
    /// A texture of irradiance, one value a pixel.
    Pixels,
    /// A texture of irradiance with several samples a pixel.
    Samples,
    /// A few light samples, in the shadows of their maps.
    Few,
}

impl DirectSource {
    /// Returns the source for direct light from the lights themselves; `None` selects the vertices.
    pub fn of(live: Option<&DirectLight>) -> Self {
        match live {
            None => DirectSource::Stored,
            Some(DirectLight::Pixels(_)) => DirectSource::Pixels,
            Some(DirectLight::Samples(_)) => DirectSource::Samples,
            Some(DirectLight::Few(_)) => DirectSource::Few,
        }
    }

    /// Returns true if the coarse mesh can be drawn. It cannot with light from a texture: that light was computed at
    /// the depths of the elements, and the depths of the surfaces must be equal to them to the last bit.
    pub fn shows_tiles(self) -> bool {
        self.tiled_shader().is_some()
    }

    pub(super) fn tiled_shader(self) -> Option<&'static Shader> {
        match self {
            DirectSource::Stored => Some(&SURFACE_TILES),
            DirectSource::Few => Some(&SURFACE_FEW_LIGHTS_TILES),
            DirectSource::Pixels | DirectSource::Samples => None,
        }
    }

    pub(super) fn shader(self) -> &'static Shader {
        match self {
            DirectSource::Stored => &SURFACE,
            DirectSource::Pixels => &SURFACE_LIT,
            DirectSource::Samples => &SURFACE_LIT_SAMPLES,
            DirectSource::Few => &SURFACE_FEW_LIGHTS,
        }
    }

    pub(super) fn layout(self, gpu: &Gpu) -> Option<wgpu::BindGroupLayout> {
        match self {
            DirectSource::Stored => None,
            DirectSource::Pixels => Some(texture_layout(gpu, false)),
            DirectSource::Samples => Some(texture_layout(gpu, true)),
            DirectSource::Few => Some(few_lights::layout(gpu)),
        }
    }
}

fn texture_layout(gpu: &Gpu, multisampled: bool) -> wgpu::BindGroupLayout {
    let texture = wgpu::BindGroupLayoutEntry {
        binding: 0,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled,
        },
        count: None,
    };
    let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some("direct irradiance"), entries: &[texture] };
    gpu.device.create_bind_group_layout(&descriptor)
}
