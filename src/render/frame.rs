//! The frame: the passes that make one picture, in order.

use std::collections::HashMap;
use std::sync::Arc;

use super::display::light_meter::{LightMeter, Metered};
use super::display::tone_map::ToneMapPass;
use super::frame_uniform::{frame_bind_group, frame_layout};
use super::shadow::debug::DebugPass;
use super::shadow::{FrameContext, RealTimeLight, ShadowScene};
use super::stored_light::light_tiles::TileFiller;
use super::stored_light::weighted_light::WeightedLight;
use super::surface::direct_source::DirectSource;
use super::surface::pass::SurfacePass;
use super::surface::targets::SurfaceTargets;
use super::{RenderSettings, View};
use crate::gpu::readback::read_buffer;
use crate::gpu::{Gpu, GpuError, Stopwatch};
use crate::render::scene::SceneBuffers;
use crate::render::targets::Targets;
use crate::scene::AlphaMode;

/// Draws pictures of one output format.
pub struct Renderer {
    frame_layout: wgpu::BindGroupLayout,
    weighted: WeightedLight,
    tile_filler: TileFiller,
    /// Made when they are first needed.
    surfaces: HashMap<DirectSource, SurfacePass>,
    /// Made for the first picture whose direct light comes from the lights.
    live: Option<RealTimeLight>,
    shadows: Option<Arc<ShadowScene>>,
    /// Made when the first debug view is drawn.
    debug: Option<DebugPass>,
    meter: LightMeter,
    /// The meter of another renderer that sets the exposure here.
    followed: Option<wgpu::Buffer>,
    watch: Option<Arc<Stopwatch>>,
    tone_map: ToneMapPass,
    output_format: wgpu::TextureFormat,
    samples: u32,
    /// Those of the last pictures, the last first.
    targets: Vec<Targets>,
    keeps_radiance: bool,
    shows_last_exposure: bool,
}

impl Renderer {
    /// A renderer into textures of `output_format`, with `samples` samples a pixel (1 or 4).
    #[must_use]
    pub fn new(gpu: &Gpu, output_format: wgpu::TextureFormat, samples: u32) -> Self {
        let frame_layout = frame_layout(gpu);
        Self {
            weighted: WeightedLight::new(gpu, &frame_layout),
            tile_filler: TileFiller::new(gpu, &frame_layout),
            surfaces: HashMap::new(),
            live: None,
            keeps_radiance: false,
            shows_last_exposure: false,
            shadows: None,
            debug: None,
            meter: LightMeter::new(gpu, &frame_layout),
            followed: None,
            watch: None,
            tone_map: ToneMapPass::new(gpu, &frame_layout, output_format, samples),
            frame_layout,
            output_format,
            samples,
            targets: Vec::new(),
        }
    }

    /// Casters and lights of the scenes that are drawn from now on, for looks that ask for shadows.
    pub fn cast_shadows(&mut self, shadows: Option<Arc<ShadowScene>>) {
        let is_same = match (&self.shadows, &shadows) {
            (Some(last), Some(next)) => Arc::ptr_eq(last, next),
            _ => false,
        };
        if !is_same {
            self.live.iter_mut().for_each(RealTimeLight::clear_scene);
            self.debug.iter_mut().for_each(DebugPass::clear_scene);
        }
        self.shadows = shadows;
    }

    /// Pictures without a fixed exposure take that which another renderer has metered last.
    pub fn follow_exposure(&mut self, other: &Self) {
        self.followed = Some(other.meter.exposure().clone());
    }

    /// Both meter by one light meter: its exposure is that of the picture that either of them has drawn last.
    pub fn share_meter(&mut self, other: &Self) {
        self.meter.share(&other.meter);
    }

    /// Whether pictures without a fixed exposure are shown under that of the picture before, as they follow each other in a
    /// movement: with one sample a pixel and nothing that blends, that is sooner done.
    pub fn show_last_exposure(&mut self, shows: bool) {
        self.shows_last_exposure = shows;
    }

    /// [`Renderer::hdr`] holds the pictures that are drawn from now on.
    pub(super) fn keep_radiance(&mut self) {
        self.keeps_radiance = true;
    }

    /// Times the passes of the pictures that are drawn from now on.
    pub fn time(&mut self, watch: Option<Arc<Stopwatch>>) {
        self.watch = watch;
    }

    /// Records part of the direct light of a picture, which the next [`Renderer::draw`] of the same goes on with.
    pub fn add_light(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        size: [u32; 2],
        scene: &SceneBuffers,
        view: &View,
        render_settings: &RenderSettings,
    ) {
        let (Some(settings), Some(shadows)) = (&render_settings.shadows, &self.shadows) else { return };
        let bindings = &frame_bind_group(gpu, &self.frame_layout, scene, view, render_settings);
        let in_view = &scene.in_view(gpu, &view.cull_view(render_settings));
        let stopwatch = self.watch.as_deref();
        let frame = FrameContext { gpu, bindings, size, scene, in_view, shadows, view, render_settings, stopwatch };
        let live = self.live.get_or_insert_with(|| RealTimeLight::new(gpu, &self.frame_layout, self.samples));
        live.draw(encoder, frame, settings);
    }

    /// Records a picture of `scene` into the whole of `target`, which is `size` pixels wide and high.
    #[expect(clippy::too_many_arguments, reason = "where to draw (encoder, target, size) and what (scene, view, look)")]
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        size: [u32; 2],
        scene: &SceneBuffers,
        view: &View,
        render_settings: &RenderSettings,
    ) {
        let kept = self.targets.iter().position(|targets| targets.size == size);
        let targets = kept.map(|at| self.targets.remove(at)).unwrap_or_else(|| Targets::new(gpu, size, self.samples));
        let frame = frame_bind_group(gpu, &self.frame_layout, scene, view, render_settings);

        // The light of the vertices, each group as bright as wanted.
        let stored = self.weighted.of(gpu, encoder, &frame, scene, render_settings).clone();
        let seen = &scene.in_view(gpu, &view.cull_view(render_settings));
        let frame_context = self.shadows.as_ref().map(|shadows| FrameContext {
            gpu,
            bindings: &frame,
            size,
            scene,
            in_view: seen,
            shadows,
            view,
            render_settings,
            stopwatch: self.watch.as_deref(),
        });
        let lap =
            |encoder: &mut wgpu::CommandEncoder, name| self.watch.iter().for_each(|watch| watch.lap(encoder, name));
        // Light from the lights themselves, each in its shadows: their number and maps, or irradiance at the pixels.
        let live = render_settings.shadows.as_ref().zip(frame_context).map(|(settings, frame_context)| {
            let live = self.live.get_or_insert_with(|| RealTimeLight::new(gpu, &self.frame_layout, self.samples));
            live.draw(encoder, frame_context, settings)
        });
        if live.is_none() {
            self.live.iter_mut().for_each(RealTimeLight::release_targets);
        }
        // Light from every visible point towards the eye: displayed, or several samples a pixel and their mean.
        let is_metered = render_settings.fixed_exposure().is_none() && self.followed.is_none();
        let is_last = self.can_display_at_once(seen, render_settings);
        let onto = match (is_last, is_metered) {
            (true, true) => {
                SurfaceTargets::display_and_luminance(gpu, target, self.output_format, &targets, render_settings)
            }
            (true, false) => SurfaceTargets::display(target, self.output_format, &targets, render_settings),
            (false, _) => SurfaceTargets::radiance(&targets),
        };
        let exposure = self.followed.as_ref().unwrap_or(self.meter.exposure());
        let source = DirectSource::of(live.as_ref());
        if let Some(tiled) = scene.tiled.as_ref().filter(|_| source.shows_tiles()) {
            let lit_by_lights = live.is_some();
            self.tile_filler.fill(gpu, encoder, &frame, scene, &tiled.tiles, render_settings, &stored, lit_by_lights);
        }
        let surface = self.surfaces.entry(source);
        let surface = surface.or_insert_with(|| SurfacePass::new(gpu, &self.frame_layout, self.samples, source));
        surface.draw(gpu, encoder, &onto, &frame, seen, render_settings, &stored, exposure, live.as_ref());
        lap(encoder, "surfaces");
        // The exposure that suits this picture, unless one is given.
        if is_metered {
            let seen = if is_last { Metered::Luminance } else { Metered::Radiance };
            self.meter.draw(gpu, encoder, &targets, seen, &frame);
            lap(encoder, "light meter");
        }
        if !is_last {
            // Exposure, tone curve, sRGB, dither.
            self.tone_map.draw(gpu, encoder, &targets, &frame, exposure, target);
            lap(encoder, "tone map");
        }

        // What shadows work with.
        if let (Some(debug), Some(frame_context)) = (render_settings.shadow_debug, frame_context) {
            let pass = self.debug.get_or_insert_with(|| DebugPass::new(gpu, &self.frame_layout, self.output_format));
            pass.draw(encoder, target, frame_context, debug);
        }

        self.shadows.iter().for_each(|shadows| shadows.drop_unused());
        // Where a pixel has one sample, pictures of a movement may change their size back and forth.
        self.targets.insert(0, targets);
        self.targets.truncate(if self.samples == 1 { 2 } else { 1 });
    }

    /// Nothing needs the radiance but the screen, and what it shows of one point needs no other: the exposure is given or
    /// that of the last picture, and neither samples nor surfaces are blended.
    fn can_display_at_once(&self, seen: &SceneBuffers, render_settings: &RenderSettings) -> bool {
        let blends = seen.batches.iter().any(|batch| batch.alpha_mode == AlphaMode::Blend);
        let is_exposed = render_settings.fixed_exposure().is_some() || self.shows_last_exposure;
        !self.keeps_radiance && self.samples == 1 && is_exposed && !blends
    }

    /// The exposure in stops that was metered last; none before a picture was metered. Blocks until it is drawn.
    ///
    /// # Errors
    /// The device was lost.
    pub fn metered_ev(&self, gpu: &Gpu) -> Result<Option<f32>, GpuError> {
        let bytes = read_buffer(gpu, self.meter.exposure())?;
        let factor = bytes.first_chunk().map_or(0.0, |bytes| f32::from_ne_bytes(*bytes));
        Ok((factor > 0.0).then(|| factor.log2()))
    }

    /// The linear picture that was drawn last where it is kept, before exposure, scaled by [`SceneBuffers::pre_exposure`].
    pub(super) fn hdr(&self) -> Option<&wgpu::Texture> {
        self.targets.first().map(|targets| &targets.hdr)
    }
}
