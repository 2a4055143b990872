//! Direct light, light sample by light sample, in the shadows of one technique.

use super::cutout_shadow::CutoutShadowPass;
use super::depth_prepass::DepthPrepass;
use super::direct_light::{self, DirectLightPass, Lit, WHERE_UNSHADOWED};
use super::light_samples::LightSample;
use super::light_targets::LightTargets;
use super::light_uniforms::{LightUniforms, light_sample_layout};
use super::planar_shadow::{ON_RECEIVER, PlanarShadowPass, SHADOWS};
use super::raytraced::RaytracedLight;
use super::shadow_map::ShadowMapPass;
use super::shadow_volume::ShadowVolumePass;
use super::silhouette::Counting;
use super::{ShadowScene, ShadowSettings, ShadowTechnique};
use crate::gpu::readback::{read_stencil, read_texture};
use crate::gpu::{Gpu, GpuError, SceneBuffers, shaders};
use crate::render::picture::f32_from_half;
use crate::render::{Look, View};

/// What a picture is of: the same for every pass.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// Bind group 0.
    pub frame: &'a wgpu::BindGroup,
    /// On the device.
    pub scene: &'a SceneBuffers,
    /// Its casters and lights.
    pub shadows: &'a ShadowScene,
    /// From where.
    pub view: &'a View,
    /// How.
    pub look: &'a Look,
}

/// What a technique decides about one light sample, pixel by pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleDecisions {
    /// The sample is seen.
    pub lit: Vec<bool>,
    /// The technique claims to know; none claims everything.
    pub claimed: Option<Vec<bool>>,
}

/// Where at least two planar shadows overlap.
const PLANAR_TWICE: Lit = Lit {
    read_mask: SHADOWS,
    compare: wgpu::CompareFunction::LessEqual,
    reference: 2,
    operation: wgpu::BlendOperation::ReverseSubtract,
};
/// Where there is a receiver of planar shadows.
const ON_RECEIVERS: Lit = Lit { read_mask: ON_RECEIVER, compare: wgpu::CompareFunction::NotEqual, ..WHERE_UNSHADOWED };

/// Direct light for pictures with one number of samples a pixel.
pub struct RealTimeLight {
    samples: u32,
    sample_layout: wgpu::BindGroupLayout,
    prepass: DepthPrepass,
    unshadowed: DirectLightPass,
    maps: ShadowMapPass,
    map_light: DirectLightPass,
    planar: PlanarShadowPass,
    planar_light: DirectLightPass,
    /// Takes light away where planar shadows overlap: the fault of darkening twice.
    planar_twice: DirectLightPass,
    /// Lights all that is on a receiver, in shadow or not.
    on_receivers: DirectLightPass,
    volumes: ShadowVolumePass,
    cutouts: CutoutShadowPass,
    raytraced: RaytracedLight,
    targets: Option<LightTargets>,
}

impl RealTimeLight {
    /// Passes for pictures with `samples` samples a pixel.
    #[must_use]
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout, samples: u32) -> Self {
        let sample_layout = light_sample_layout(gpu);
        let layouts = [Some(frame_layout), Some(&sample_layout)];
        let maps = ShadowMapPass::new(gpu);
        let map_layouts = [Some(frame_layout), Some(&sample_layout), Some(maps.read_layout())];
        let stencil_light = |lit: &Lit| DirectLightPass::new(gpu, &layouts, &shaders::DIRECT_LIGHT, samples, lit);
        let light = |layouts, shader| DirectLightPass::new(gpu, layouts, shader, samples, &WHERE_UNSHADOWED);
        Self {
            samples,
            prepass: DepthPrepass::new(gpu, frame_layout, samples),
            unshadowed: light(&layouts, &shaders::DIRECT_LIGHT),
            map_light: light(&map_layouts, &shaders::DIRECT_LIGHT_MAP),
            maps,
            planar: PlanarShadowPass::new(gpu, frame_layout, samples),
            planar_light: stencil_light(&Lit { read_mask: SHADOWS, ..WHERE_UNSHADOWED }),
            planar_twice: stencil_light(&PLANAR_TWICE),
            on_receivers: stencil_light(&ON_RECEIVERS),
            volumes: ShadowVolumePass::new(gpu, frame_layout, &sample_layout, samples),
            cutouts: CutoutShadowPass::new(gpu, frame_layout, &sample_layout, samples),
            raytraced: RaytracedLight::new(gpu, frame_layout),
            sample_layout,
            targets: None,
        }
    }

    /// Forgets what it keeps from picture to picture: the next is of another scene.
    pub fn forget(&mut self) {
        self.volumes.forget();
    }

    /// Records the direct light of a picture of `size` pixels: a texture of irradiance times pre-exposure, with as many
    /// samples a pixel as the picture, with one where it is ray-traced.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        size: [u32; 2],
        subject: Subject<'_>,
        settings: &ShadowSettings,
    ) -> wgpu::TextureView {
        let samples = settings.samples(subject.shadows.scene());
        if settings.technique == ShadowTechnique::Raytraced {
            return self.raytraced.draw(gpu, size, subject, &samples);
        }
        let targets = self.targets_of(gpu, size);
        let lights = LightUniforms::new(gpu, &self.sample_layout, &samples, subject.look);
        self.prepare(gpu, subject, &samples, settings);

        // Which surfaces are visible, and no light on them.
        self.prepass.draw(encoder, &targets, subject.frame, subject.scene, subject.look);
        direct_light::clear(encoder, &targets);
        // One shadow and one layer of light after the other.
        for (index, sample) in samples.iter().enumerate() {
            self.add_sample(gpu, encoder, &targets, subject, settings, &lights, (index, sample));
        }
        self.targets.insert(targets).irradiance_view.clone()
    }

    /// Which pixels each light sample lights; for passes with one sample a pixel.
    ///
    /// # Errors
    /// The device was lost.
    pub fn decisions(
        &mut self,
        gpu: &Gpu,
        size: [u32; 2],
        subject: Subject<'_>,
        settings: &ShadowSettings,
    ) -> Result<Vec<SampleDecisions>, GpuError> {
        assert_eq!(self.samples, 1, "decisions are taken pixel by pixel");
        let samples = settings.samples(subject.shadows.scene());
        if settings.technique == ShadowTechnique::Raytraced {
            let lit = self.raytraced.decisions(gpu, size, subject, &samples)?;
            return Ok(lit.into_iter().map(|lit| SampleDecisions { lit, claimed: None }).collect());
        }
        let targets = self.targets_of(gpu, size);
        let lights = LightUniforms::new(gpu, &self.sample_layout, &samples, subject.look);
        self.prepare(gpu, subject, &samples, settings);
        let mut decisions = Vec::with_capacity(samples.len());
        for (index, sample) in samples.iter().enumerate() {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            self.prepass.draw(&mut encoder, &targets, subject.frame, subject.scene, subject.look);
            direct_light::clear(&mut encoder, &targets);
            self.add_sample(gpu, &mut encoder, &targets, subject, settings, &lights, (index, sample));
            gpu.queue.submit([encoder.finish()]);
            let lit = lit_pixels(gpu, &targets)?;
            let is_planar = settings.technique == ShadowTechnique::Planar;
            let claimed = is_planar.then(|| self.receivers(gpu, &targets, subject, &lights, index)).transpose()?;
            decisions.push(SampleDecisions { lit, claimed });
        }
        self.targets = Some(targets);
        Ok(decisions)
    }

    /// What the stencil holds after the shadows of one light sample, a byte a pixel; for passes with one sample a pixel.
    ///
    /// # Errors
    /// The device was lost.
    pub fn stencil(
        &mut self,
        gpu: &Gpu,
        size: [u32; 2],
        subject: Subject<'_>,
        settings: &ShadowSettings,
        index: usize,
    ) -> Result<Vec<u8>, GpuError> {
        let samples = settings.samples(subject.shadows.scene());
        let targets = self.targets_of(gpu, size);
        let lights = LightUniforms::new(gpu, &self.sample_layout, &samples, subject.look);
        self.prepare(gpu, subject, &samples, settings);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.prepass.draw(&mut encoder, &targets, subject.frame, subject.scene, subject.look);
        self.mark_shadows(gpu, &mut encoder, &targets, subject, settings, &lights, (index, &samples[index]));
        gpu.queue.submit([encoder.finish()]);
        let stencil = read_stencil(gpu, &targets.depth_stencil_texture);
        self.targets = Some(targets);
        stencil
    }

    /// Pixels on receivers of planar shadows that a light sample reaches or would reach.
    fn receivers(
        &self,
        gpu: &Gpu,
        targets: &LightTargets,
        subject: Subject<'_>,
        lights: &LightUniforms,
        index: usize,
    ) -> Result<Vec<bool>, GpuError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        direct_light::clear(&mut encoder, targets);
        let mut pass = direct_light::begin(&mut encoder, targets);
        pass.set_bind_group(0, subject.frame, &[]);
        lights.bind(&mut pass, index);
        self.on_receivers.draw(&mut pass, subject.scene, subject.look);
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
        lit_pixels(gpu, targets)
    }

    fn targets_of(&mut self, gpu: &Gpu, size: [u32; 2]) -> LightTargets {
        match self.targets.take() {
            Some(targets) if targets.size == size => targets,
            _ => LightTargets::new(gpu, size, self.samples),
        }
    }

    /// Does for all light samples what can be done before the first pass.
    fn prepare(&mut self, gpu: &Gpu, subject: Subject<'_>, samples: &[LightSample], settings: &ShadowSettings) {
        if settings.technique == ShadowTechnique::Map {
            self.maps.prepare(gpu, &settings.maps);
        }
        if settings.technique == ShadowTechnique::Planar {
            self.planar.prepare(gpu, subject, &settings.planar);
        }
        if let Some(counting) = counting(settings.technique) {
            let places: Vec<_> = samples.iter().map(LightSample::place).collect();
            self.volumes.prepare(gpu, subject, &places, counting, &settings.volumes);
        }
    }

    /// Marks in the stencil what is in the shadow of one light sample, where the technique tells it so.
    #[expect(clippy::too_many_arguments, reason = "where to draw, what of it and how")]
    fn mark_shadows(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        targets: &LightTargets,
        subject: Subject<'_>,
        settings: &ShadowSettings,
        lights: &LightUniforms,
        (index, sample): (usize, &LightSample),
    ) {
        let mut pass = direct_light::begin_stencil(encoder, targets);
        pass.set_bind_group(0, subject.frame, &[]);
        lights.bind(&mut pass, index);
        if let Some(counting) = counting(settings.technique) {
            self.volumes.draw(&mut pass, subject, sample.place(), counting, &settings.volumes);
            self.cutouts.draw(&mut pass, subject);
        }
        if settings.technique == ShadowTechnique::Planar {
            self.planar.draw(gpu, &mut pass, subject, sample.place());
            self.cutouts.draw(&mut pass, subject);
        }
    }

    /// Adds one light sample where it is not in shadow.
    #[expect(clippy::too_many_arguments, reason = "where to draw, what of it and how")]
    fn add_sample(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        targets: &LightTargets,
        subject: Subject<'_>,
        settings: &ShadowSettings,
        lights: &LightUniforms,
        (index, sample): (usize, &LightSample),
    ) {
        self.mark_shadows(gpu, encoder, targets, subject, settings, lights, (index, sample));
        // Light where there are none.
        let is_map = settings.technique == ShadowTechnique::Map;
        let map = is_map.then(|| self.maps.draw(gpu, encoder, subject, sample, &settings.maps));
        let mut pass = direct_light::begin(encoder, targets);
        pass.set_bind_group(0, subject.frame, &[]);
        lights.bind(&mut pass, index);
        if map.is_some() {
            pass.set_bind_group(2, &map, &[]);
        }
        self.light_of(settings.technique).draw(&mut pass, subject.scene, subject.look);
        if settings.technique == ShadowTechnique::Planar && !settings.planar.darkens_once {
            self.planar_twice.draw(&mut pass, subject.scene, subject.look);
        }
    }

    fn light_of(&self, technique: ShadowTechnique) -> &DirectLightPass {
        match technique {
            ShadowTechnique::Map => &self.map_light,
            ShadowTechnique::Planar => &self.planar_light,
            _ => &self.unshadowed,
        }
    }
}

/// How a technique counts volumes, if it does.
fn counting(technique: ShadowTechnique) -> Option<Counting> {
    match technique {
        ShadowTechnique::VolumeDepthPass => Some(Counting::DepthPass),
        ShadowTechnique::VolumeDepthFail => Some(Counting::DepthFail),
        _ => None,
    }
}

/// Pixels in which at least half of the light sample is seen.
fn lit_pixels(gpu: &Gpu, targets: &LightTargets) -> Result<Vec<bool>, GpuError> {
    if targets.irradiance.format() == wgpu::TextureFormat::Rgba32Float {
        let bytes = read_texture(gpu, &targets.irradiance, 16)?;
        let seen = |pixel: &[u8; 16]| f32::from_le_bytes([pixel[12], pixel[13], pixel[14], pixel[15]]);
        return Ok(bytes.as_chunks().0.iter().map(|pixel| seen(pixel) >= 0.5).collect());
    }
    let bytes = read_texture(gpu, &targets.irradiance, 8)?;
    let seen = |pixel: &[u8; 8]| f32_from_half(u16::from_le_bytes([pixel[6], pixel[7]]));
    Ok(bytes.as_chunks().0.iter().map(|pixel| seen(pixel) >= 0.5).collect())
}
