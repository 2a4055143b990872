//! Real-time direct light: adds the light samples of a scene, each in its shadows.

use std::collections::HashMap;
use std::sync::Arc;

use super::cutout::CutoutShadowPass;
use super::dispatch::{TechniquePasses, passes_of};
use super::few_lights::{FewLights, FewLightsPass};
use super::light::direct_light;
use super::light::pass_setup::PassSetup;
use super::light::sample::LightSample;
use super::light::sample_context::SampleContext;
use super::light::shadow_pass::ShadowPass;
use super::light::targets::LightTargets;
use super::light::uniforms::LightUniforms;
use super::raytraced::RaytracedLight;
use super::settings::ShadowSettings;
use super::shared::depth_prepass::DepthPrepass;
use super::shared::frame_context::FrameContext;
use super::technique::ShadowTechnique;
use crate::gpu::Gpu;

/// The direct light of a picture, as input of the surface pass.
pub enum DirectLight {
    /// Light samples that the surface pass adds itself.
    Few(FewLights),
    /// A texture of irradiance times pre-exposure, one value a pixel.
    Pixels(wgpu::TextureView),
    /// A texture of irradiance times pre-exposure, with as many samples a pixel as the picture.
    Samples(wgpu::TextureView),
}

/// Passes of direct light, for pictures with a given number of samples a pixel.
pub struct RealTimeLight {
    setup: PassSetup,
    prepass: DepthPrepass,
    few_lights: FewLightsPass,
    cutouts: CutoutShadowPass,
    /// Passes of the techniques that have been drawn so far.
    techniques: HashMap<ShadowTechnique, TechniquePasses>,
    targets: Option<LightTargets>,
}

/// The light samples of one picture, ready to be drawn one after the other.
pub struct SampleRun<'a> {
    frame: FrameContext<'a>,
    settings: &'a ShadowSettings,
    lights: LightUniforms,
    /// The light samples.
    pub samples: Arc<[LightSample]>,
    /// The targets that their light is added up in.
    pub targets: LightTargets,
}

impl SampleRun<'_> {
    /// Returns light sample `index`.
    fn sample(&self, index: usize) -> SampleContext<'_> {
        let Self { frame, settings, lights, samples, .. } = self;
        SampleContext { frame: *frame, settings, lights, index, sample: &samples[index] }
    }
}

impl RealTimeLight {
    /// Creates the passes that all techniques share, for pictures with `samples` samples a pixel.
    #[must_use]
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout, samples: u32) -> Self {
        let setup = PassSetup::new(gpu, frame_layout, samples);
        Self {
            prepass: DepthPrepass::new(gpu, frame_layout, samples),
            few_lights: FewLightsPass::new(gpu),
            cutouts: CutoutShadowPass::new(gpu, &setup),
            setup,
            techniques: HashMap::new(),
            targets: None,
        }
    }

    /// Drops the data that is cached for the last scene, because the next picture shows another scene.
    pub fn clear_scene(&mut self) {
        for passes in self.techniques.values_mut() {
            if let TechniquePasses::BySample(pass) = passes {
                pass.clear_scene();
            }
        }
    }

    /// Frees the textures in which direct light is added up, until a picture needs them again.
    pub fn release_targets(&mut self) {
        self.targets = None;
        for passes in self.techniques.values_mut() {
            if let TechniquePasses::ByRays(rays) = passes {
                rays.release_targets();
            }
        }
    }

    /// Records the direct light of a picture.
    pub fn draw(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        frame: FrameContext<'_>,
        settings: &ShadowSettings,
    ) -> DirectLight {
        if let Some(lights) = self.few_lights.draw(encoder, frame, settings) {
            frame.lap(encoder, "shadow maps");
            return DirectLight::Few(lights);
        }
        let adds_to_last = settings.batch.is_some_and(|batch| !batch.is_first());
        if let Some(rays) = self.rays(frame.gpu, settings.technique) {
            let samples = settings.samples(frame.shadows);
            let draw = || rays.draw(frame, &samples, adds_to_last);
            return DirectLight::Pixels(frame.time_work("rays, on the processor", draw));
        }
        let run = frame.time_work("silhouettes, on the processor", || self.prepare(frame, settings));
        self.draw_depth(encoder, &run);
        if !adds_to_last {
            direct_light::clear(encoder, &run.targets);
        }
        frame.lap(encoder, "depth prepass");
        for index in 0..run.samples.len() {
            self.mark_shadows(encoder, &run, index);
            frame.lap(encoder, "shadow stencil");
            self.add_light(encoder, &run, index);
            frame.lap(encoder, "direct light");
        }
        let irradiance = run.targets.irradiance_view.clone();
        self.keep_targets(run);
        if self.setup.samples > 1 { DirectLight::Samples(irradiance) } else { DirectLight::Pixels(irradiance) }
    }

    /// Returns the number of samples a pixel.
    pub(super) fn samples_per_pixel(&self) -> u32 {
        self.setup.samples
    }

    /// Prepares a picture for a technique that draws sample by sample: uploads the light samples and computes what
    /// their passes need.
    pub(super) fn prepare<'a>(&mut self, frame: FrameContext<'a>, settings: &'a ShadowSettings) -> SampleRun<'a> {
        let samples = settings.samples(frame.shadows);
        let targets = match self.targets.take() {
            Some(targets) if targets.size == frame.size => targets,
            _ => LightTargets::new(frame.gpu, frame.size, self.setup.samples),
        };
        let lights = LightUniforms::new(frame.gpu, &self.setup.sample_layout, &samples, frame);
        if let Some(pass) = self.by_sample(frame.gpu, settings.technique) {
            pass.prepare(frame, settings, &samples);
        }
        SampleRun { frame, settings, lights, samples, targets }
    }

    /// Draws the depth of the visible surfaces.
    pub(super) fn draw_depth(&self, encoder: &mut wgpu::CommandEncoder, run: &SampleRun<'_>) {
        self.prepass.draw(encoder, &run.targets.depth_stencil, run.frame);
    }

    /// Marks the shadows of a light sample in the stencil.
    pub(super) fn mark_shadows(&mut self, encoder: &mut wgpu::CommandEncoder, run: &SampleRun<'_>, index: usize) {
        let sample = run.sample(index);
        let mut stencil = direct_light::begin_stencil(encoder, &run.targets, sample);
        let Some(TechniquePasses::BySample(pass)) = self.techniques.get(&run.settings.technique) else { return };
        pass.mark_shadows(&mut stencil, sample);
        if pass.needs_cutouts() {
            self.cutouts.draw(&mut stencil, run.frame);
        }
    }

    /// Adds a light sample wherever it is not in shadow.
    pub(super) fn add_light(&mut self, encoder: &mut wgpu::CommandEncoder, run: &SampleRun<'_>, index: usize) {
        if let Some(pass) = self.by_sample(run.frame.gpu, run.settings.technique) {
            pass.add_light(encoder, &run.targets, run.sample(index));
        }
    }

    /// Lights the surfaces on which the technique can show shadows, also where they are in shadow. Returns false, and
    /// draws nothing, if the technique can show shadows on every surface.
    pub(super) fn light_receivers(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        run: &SampleRun<'_>,
        index: usize,
    ) -> bool {
        let pass = self.by_sample(run.frame.gpu, run.settings.technique);
        let Some(receivers) = pass.and_then(|pass| pass.receivers()) else { return false };
        direct_light::clear(encoder, &run.targets);
        receivers.draw(&mut direct_light::begin(encoder, &run.targets, run.sample(index)), run.frame);
        true
    }

    /// Stores the targets of a picture, for use by the next one.
    pub(super) fn keep_targets(&mut self, run: SampleRun<'_>) {
        self.targets = Some(run.targets);
    }

    /// Returns the passes of a technique that traces rays; `None` for other techniques.
    pub(super) fn rays(&mut self, gpu: &Gpu, technique: ShadowTechnique) -> Option<&mut RaytracedLight> {
        match self.passes(gpu, technique) {
            TechniquePasses::ByRays(rays) => Some(rays),
            TechniquePasses::BySample(_) => None,
        }
    }

    fn by_sample(&mut self, gpu: &Gpu, technique: ShadowTechnique) -> Option<&mut Box<dyn ShadowPass>> {
        match self.passes(gpu, technique) {
            TechniquePasses::BySample(pass) => Some(pass),
            TechniquePasses::ByRays(_) => None,
        }
    }

    fn passes(&mut self, gpu: &Gpu, technique: ShadowTechnique) -> &mut TechniquePasses {
        self.techniques.entry(technique).or_insert_with(|| passes_of(gpu, &self.setup, technique))
    }
}
