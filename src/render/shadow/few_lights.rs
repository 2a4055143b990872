//! A few light samples, with their shadow maps or without shadows, all bound for one pass: the surface pass adds their light
//! itself, and neither depth nor direct light need passes of their own.

use bytemuck::Zeroable;

use super::light_samples::LightSample;
use super::light_uniforms::{HAS_CUBE, LightUniform};
use super::map_pipelines::{DEPTH_ARRAY, GATHERED, OVERVIEW_ARRAY, UNIFORM, entry, uniform_buffer};
use super::map_projection::MapUniform;
use super::real_time::Subject;
use super::shadow_map::ShadowMapPass;
use super::{ShadowSettings, ShadowTechnique};
use crate::gpu::Gpu;

/// `MAX_LIGHTS` of shaders/surface/direct_few.wgsl.
const MAX_LIGHTS: usize = 4;

/// What the light samples are like: one pipeline each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Kinds {
    num_lights: usize,
    has_maps: bool,
    /// Kind of each, with [`HAS_CUBE`].
    of_lights: [u32; MAX_LIGHTS],
    pcf_radius: u32,
    has_normal_offset: bool,
}

impl Kinds {
    /// Constants of shaders/surface/direct_few.wgsl.
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
    /// What they are like.
    pub kinds: Kinds,
    /// Bind group 3.
    pub bindings: wgpu::BindGroup,
}

impl FewLights {
    /// The light of a picture, its maps drawn where they are not kept; none where the surface pass cannot add it: for other
    /// techniques, more samples, or a sum over several pictures.
    pub fn of(
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        maps: &ShadowMapPass,
        subject: Subject<'_>,
        settings: &ShadowSettings,
    ) -> Option<Self> {
        let can_add = matches!(settings.technique, ShadowTechnique::None | ShadowTechnique::Map);
        if !can_add || settings.batch.is_some() {
            return None;
        }
        let samples = settings.samples(subject.shadows);
        (1..=MAX_LIGHTS).contains(&samples.len()).then(|| Self::new(gpu, encoder, maps, subject, settings, &samples))
    }

    fn new(
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        maps: &ShadowMapPass,
        subject: Subject<'_>,
        settings: &ShadowSettings,
        samples: &[LightSample],
    ) -> Self {
        let has_maps = settings.technique == ShadowTechnique::Map;
        let mut kinds = Kinds {
            num_lights: samples.len(),
            has_maps,
            of_lights: [0; MAX_LIGHTS],
            pcf_radius: settings.maps.pcf_radius,
            has_normal_offset: settings.maps.normal_offset > 0.0,
        };
        let mut lights = [LightUniform::zeroed(); MAX_LIGHTS];
        let mut projections = [MapUniform::zeroed(); MAX_LIGHTS];
        // Every binding must be bound.
        let mut textures = [(); MAX_LIGHTS].map(|()| maps.no_map().clone());
        for (index, sample) in samples.iter().enumerate() {
            lights[index] = LightUniform::new(sample, subject);
            kinds.of_lights[index] = lights[index].kind();
            if has_maps {
                let map = maps.map(gpu, encoder, subject, sample, &settings.maps);
                projections[index] = map.uniform;
                kinds.of_lights[index] |= if map.num_faces == 6 { HAS_CUBE } else { 0 };
                textures[index] = map.textures;
            }
        }
        let [lights, projections] =
            [bytemuck::cast_slice(&lights), bytemuck::cast_slice(&projections)].map(|bytes| uniform_buffer(gpu, bytes));
        let mut entries = vec![
            wgpu::BindGroupEntry { binding: 0, resource: lights.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: projections.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(maps.sampler()) },
        ];
        let (depths, overviews) = (textures.iter().map(|map| &map.depth), textures.iter().map(|map| &map.overview));
        entries.extend(depths.chain(overviews).zip(3..).map(|(view, binding)| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::TextureView(view),
        }));
        let layout = &layout(gpu);
        let descriptor = wgpu::BindGroupDescriptor { label: Some("few lights"), layout, entries: &entries };
        Self { kinds, bindings: gpu.device.create_bind_group(&descriptor) }
    }
}

/// Layout of bind group 3 of the surface pass.
pub fn layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let read = wgpu::ShaderStages::FRAGMENT;
    let mut entries =
        vec![entry(0, wgpu::ShaderStages::VERTEX_FRAGMENT, UNIFORM), entry(1, read, UNIFORM), entry(2, read, GATHERED)];
    let textures = [DEPTH_ARRAY; MAX_LIGHTS].into_iter().chain([OVERVIEW_ARRAY; MAX_LIGHTS]);
    entries.extend(textures.zip(3..).map(|(texture, binding)| entry(binding, read, texture)));
    gpu.device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("few lights"), entries: &entries })
}
