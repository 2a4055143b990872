//! Up to four light samples, unshadowed or with shadow maps, that the surface pass adds itself. Depth and direct light
//! then need no passes of their own.
//!
//! Designed for software rendering (`viewer::software`), which it makes faster; it also serves hardware, where the gain
//! is not measured.

use bytemuck::Zeroable;

use super::light::sample::LightSample;
use super::light::uniforms::{HAS_CUBE, LightUniform};
use super::map::bindings::{BLOCK_PLANES_ARRAY, DEPTH_ARRAY, GATHERED, UNIFORM, entry, uniform_buffer};
use super::map::projection::MapUniform;
use super::map::shadow_map::ShadowMapPass;
use super::settings::ShadowSettings;
use super::shared::frame_context::FrameContext;
use super::technique::ShadowTechnique;
use crate::gpu::Gpu;

/// Largest number of light samples; equal to `MAX_LIGHTS` of shaders/surface/direct_few.wgsl.
const MAX_LIGHTS: usize = 4;

/// Properties of the light samples. They are constants of the shader, because software drivers execute both sides of a
/// branch; so the surface pass has one pipeline for each combination.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LightKinds {
    num_lights: usize,
    has_maps: bool,
    /// [`LightUniform::kind`] of each light, with [`HAS_CUBE`].
    of_lights: [u32; MAX_LIGHTS],
    pcf_radius: u32,
    has_normal_offset: bool,
}

impl LightKinds {
    /// Returns the `override` constants of shaders/surface/direct_few.wgsl.
    pub fn constants(&self) -> Vec<(&'static str, f64)> {
        let switch = |is_on: bool| f64::from(u8::from(is_on));
        let kinds = ["KIND_0", "KIND_1", "KIND_2", "KIND_3"].into_iter().zip(self.of_lights.map(f64::from));
        let numbers = [
            ("NUM_LIGHTS", self.num_lights as f64),
            ("HAS_MAPS", switch(self.has_maps)),
            ("PCF_RADIUS", f64::from(self.pcf_radius)),
            ("HAS_NORMAL_OFFSET", switch(self.has_normal_offset)),
        ];
        numbers.into_iter().chain(kinds).collect()
    }
}

/// Light samples and their maps, bound for the surface pass.
pub struct FewLights {
    /// Properties of the samples.
    pub kinds: LightKinds,
    /// Bind group 3.
    pub bindings: wgpu::BindGroup,
}

/// Draws the shadow maps of a few lights and binds all of them.
pub struct FewLightsPass {
    maps: ShadowMapPass,
    layout: wgpu::BindGroupLayout,
}

impl FewLightsPass {
    /// Creates the pass.
    pub fn new(gpu: &Gpu) -> Self {
        Self { maps: ShadowMapPass::new(gpu), layout: layout(gpu) }
    }

    /// Binds the light samples of a picture, and draws those of their maps that are not cached. Returns `None` if the
    /// surface pass cannot add the samples: for other techniques, for more samples, and for a sum over several
    /// pictures.
    pub fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame: FrameContext<'_>,
        settings: &ShadowSettings,
    ) -> Option<FewLights> {
        if !settings.technique.info().is_in_surface_pass || settings.batch.is_some() {
            return None;
        }
        let samples = settings.samples(frame.shadows);
        (1..=MAX_LIGHTS).contains(&samples.len()).then(|| self.bind(encoder, frame, settings, &samples))
    }

    fn bind(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame: FrameContext<'_>,
        settings: &ShadowSettings,
        samples: &[LightSample],
    ) -> FewLights {
        let has_maps = settings.technique == ShadowTechnique::Map;
        let mut kinds = LightKinds {
            num_lights: samples.len(),
            has_maps,
            of_lights: [0; MAX_LIGHTS],
            pcf_radius: settings.maps.pcf_radius,
            has_normal_offset: settings.maps.normal_offset > 0.0,
        };
        let mut lights = [LightUniform::zeroed(); MAX_LIGHTS];
        let mut projections = [MapUniform::zeroed(); MAX_LIGHTS];
        // Every binding must be bound, also those of the lights that are missing.
        let mut textures = [(); MAX_LIGHTS].map(|()| self.maps.no_map().clone());
        for (index, sample) in samples.iter().enumerate() {
            lights[index] = LightUniform::new(sample, frame);
            kinds.of_lights[index] = lights[index].kind();
            if has_maps {
                let map = self.maps.map(encoder, frame, sample, &settings.maps);
                projections[index] = map.uniform;
                kinds.of_lights[index] |= if map.num_faces == 6 { HAS_CUBE } else { 0 };
                textures[index] = map.textures;
            }
        }
        let [lights, projections] = [bytemuck::cast_slice(&lights), bytemuck::cast_slice(&projections)]
            .map(|bytes| uniform_buffer(frame.gpu, bytes));
        let mut entries = vec![
            wgpu::BindGroupEntry { binding: 0, resource: lights.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: projections.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(self.maps.sampler()) },
        ];
        let (depths, planes) = (textures.iter().map(|map| &map.depth), textures.iter().map(|map| &map.block_planes));
        entries.extend(depths.chain(planes).zip(3..).map(|(view, binding)| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::TextureView(view),
        }));
        let descriptor =
            wgpu::BindGroupDescriptor { label: Some("few lights"), layout: &self.layout, entries: &entries };
        FewLights { kinds, bindings: frame.gpu.device.create_bind_group(&descriptor) }
    }
}

/// Creates the layout of bind group 3 of the surface pass.
pub fn layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let read = wgpu::ShaderStages::FRAGMENT;
    let mut entries =
        vec![entry(0, wgpu::ShaderStages::VERTEX_FRAGMENT, UNIFORM), entry(1, read, UNIFORM), entry(2, read, GATHERED)];
    let textures = [DEPTH_ARRAY; MAX_LIGHTS].into_iter().chain([BLOCK_PLANES_ARRAY; MAX_LIGHTS]);
    entries.extend(textures.zip(3..).map(|(texture, binding)| entry(binding, read, texture)));
    gpu.device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("few lights"), entries: &entries })
}
