//! Direct light, light sample by light sample, in the shadows of one technique.

mod decisions;
mod inspection;

pub use decisions::SampleDecisions;

use std::time::Instant;

use crate::gpu::{Gpu, Stopwatch};
use crate::render::scene::SceneBuffers;
use crate::render::shadow::cutout_shadow::CutoutShadowPass;
use crate::render::shadow::depth_prepass::DepthPrepass;
use crate::render::shadow::direct_light::{self, DIRECT_LIGHT, DirectLightPass, Lit, WHERE_UNSHADOWED};
use crate::render::shadow::few_lights::FewLights;
use crate::render::shadow::light_samples::LightSample;
use crate::render::shadow::light_targets::LightTargets;
use crate::render::shadow::light_uniforms::{LightUniforms, light_sample_layout};
use crate::render::shadow::map_light::{MapKind, MapLight};
use crate::render::shadow::planar_shadow::{ON_RECEIVER, PlanarShadowPass, SHADOWS};
use crate::render::shadow::raytraced::RaytracedLight;
use crate::render::shadow::shadow_map::ShadowMapPass;
use crate::render::shadow::shadow_volume::ShadowVolumePass;
use crate::render::shadow::silhouette::Counting;
use crate::render::shadow::{ShadowScene, ShadowSettings, ShadowTechnique};
use crate::render::{RenderSettings, View};

/// What a picture is of: the same for every pass.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// Bind group 0.
    pub frame: &'a wgpu::BindGroup,
    /// On the device.
    pub scene: &'a SceneBuffers,
    /// What of it may be in view.
    pub seen: &'a SceneBuffers,
    /// Its casters and lights.
    pub shadows: &'a ShadowScene,
    /// From where.
    pub view: &'a View,
    /// How.
    pub settings: &'a RenderSettings,
    /// Times the passes.
    pub watch: Option<&'a Stopwatch>,
}

impl Subject<'_> {
    /// What was recorded since the last mark is called `name`.
    pub fn lap(&self, encoder: &mut wgpu::CommandEncoder, name: &'static str) {
        self.watch.iter().for_each(|watch| watch.lap(encoder, name));
    }

    /// Times work of the processor.
    pub fn work<T>(&self, name: &'static str, work: impl FnOnce() -> T) -> T {
        let begun = Instant::now();
        let done = work();
        self.watch.iter().for_each(|watch| watch.work(name, begun.elapsed()));
        done
    }
}

/// The direct light of a picture as the surface pass takes it.
pub enum LiveLight {
    /// Light samples that it adds itself.
    Few(FewLights),
    /// Irradiance times pre-exposure, one value a pixel.
    Pixels(wgpu::TextureView),
    /// The same with as many samples a pixel as the picture.
    Samples(wgpu::TextureView),
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
    map_light: MapLight,
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
        let light = |lit: &Lit| DirectLightPass::new(gpu, &layouts, (&DIRECT_LIGHT, &[]), samples, lit);
        Self {
            samples,
            prepass: DepthPrepass::new(gpu, frame_layout, samples),
            unshadowed: light(&WHERE_UNSHADOWED),
            map_light: MapLight::new([frame_layout, &sample_layout, maps.read_layout()], samples),
            maps,
            planar: PlanarShadowPass::new(gpu, frame_layout, samples),
            planar_light: light(&Lit { read_mask: SHADOWS, ..WHERE_UNSHADOWED }),
            planar_twice: light(&PLANAR_TWICE),
            on_receivers: light(&ON_RECEIVERS),
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

    /// Gives back the textures that direct light is gathered in, until a picture needs them again.
    pub fn release_targets(&mut self) {
        self.targets = None;
        self.raytraced.release_targets();
    }

    /// Records the direct light of a picture of `size` pixels.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        size: [u32; 2],
        subject: Subject<'_>,
        settings: &ShadowSettings,
    ) -> LiveLight {
        if let Some(lights) = FewLights::of(gpu, encoder, &self.maps, subject, settings) {
            subject.lap(encoder, "shadow maps");
            return LiveLight::Few(lights);
        }
        let samples = settings.samples(subject.shadows);
        let goes_on = settings.batch.is_some_and(|batch| !batch.is_first());
        if settings.technique == ShadowTechnique::Raytraced {
            let raytraced = &mut self.raytraced;
            let draw = || raytraced.draw(gpu, size, subject, &samples, goes_on);
            return LiveLight::Pixels(subject.work("rays, on the processor", draw));
        }
        let targets = self.targets_of(gpu, size);
        let lights = LightUniforms::new(gpu, &self.sample_layout, &samples, subject);
        subject.work("silhouettes, on the processor", || self.prepare(gpu, subject, &samples, settings));

        // Which surfaces are visible, and no light on them.
        self.prepass.draw(encoder, &targets, subject.frame, subject.seen, subject.settings);
        if !goes_on {
            direct_light::clear(encoder, &targets);
        }
        subject.lap(encoder, "depth prepass");
        // One shadow and one layer of light after the other.
        for (index, sample) in samples.iter().enumerate() {
            self.add_sample(gpu, encoder, &targets, subject, settings, &lights, (index, sample));
        }
        let irradiance = self.targets.insert(targets).irradiance_view.clone();
        if self.samples > 1 { LiveLight::Samples(irradiance) } else { LiveLight::Pixels(irradiance) }
    }

    fn targets_of(&mut self, gpu: &Gpu, size: [u32; 2]) -> LightTargets {
        match self.targets.take() {
            Some(targets) if targets.size == size => targets,
            _ => LightTargets::new(gpu, size, self.samples),
        }
    }

    /// Does for all light samples what can be done before the first pass.
    fn prepare(&mut self, gpu: &Gpu, subject: Subject<'_>, samples: &[LightSample], settings: &ShadowSettings) {
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
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        targets: &LightTargets,
        subject: Subject<'_>,
        settings: &ShadowSettings,
        lights: &LightUniforms,
        (index, sample): (usize, &LightSample),
    ) {
        self.mark_shadows(gpu, encoder, targets, subject, settings, lights, (index, sample));
        subject.lap(encoder, "shadow stencil");
        // Light where there are none.
        let is_map = settings.technique == ShadowTechnique::Map;
        let map = is_map.then(|| self.maps.map(gpu, encoder, subject, sample, &settings.maps));
        let kind = |num_faces| MapKind { is_cube: num_faces == 6, pcf_radius: settings.maps.pcf_radius };
        let map_pass = map.as_ref().map(|map| self.map_light.pass(gpu, kind(map.num_faces)));
        if is_map {
            subject.lap(encoder, "shadow maps");
        }
        let mut pass = direct_light::begin(encoder, targets);
        pass.set_bind_group(0, subject.frame, &[]);
        lights.bind(&mut pass, index);
        if let Some(map) = &map {
            pass.set_bind_group(2, &self.maps.bind(gpu, map), &[]);
        }
        let light = map_pass.unwrap_or(match settings.technique {
            ShadowTechnique::Planar => &self.planar_light,
            _ => &self.unshadowed,
        });
        light.draw(&mut pass, subject.seen, subject.settings);
        if settings.technique == ShadowTechnique::Planar && !settings.planar.darkens_once {
            self.planar_twice.draw(&mut pass, subject.seen, subject.settings);
        }
        drop(pass);
        subject.lap(encoder, "direct light");
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
