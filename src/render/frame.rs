//! The frame: the passes that make one picture, in order.

use std::collections::HashMap;
use std::sync::{Arc, Weak};

use super::display::light_meter::{LightMeter, MeterInput};
use super::display::tone_map::ToneMapPass;
use super::frame_uniform::{frame_bind_group, frame_layout};
use super::picture_request::{MeteredExposure, PictureRequest};
use super::shadow::debug::DebugPass;
use super::shadow::{FrameContext, RealTimeLight, ShadowScene};
use super::stored_light::light_tiles::{TileFiller, TileLight};
use super::stored_light::weighted_light::WeightedLight;
use super::surface::direct_source::DirectSource;
use super::surface::pass::{SurfaceInput, SurfacePass};
use super::surface::targets::SurfaceTargets;
use crate::gpu::readback::read_buffer;
use crate::gpu::{Gpu, GpuError};
use crate::render::scene::SceneBuffers;
use crate::render::targets::Targets;
use crate::scene::AlphaMode;

/// Draws pictures of one output format.
pub struct Renderer {
    frame_layout: wgpu::BindGroupLayout,
    weighted: WeightedLight,
    tile_filler: TileFiller,
    /// Passes for the sources of direct light that have been drawn so far.
    surfaces: HashMap<DirectSource, SurfacePass>,
    /// Passes of real-time direct light; created for the first picture that uses them.
    live: Option<RealTimeLight>,
    /// Passes of debug views; created for the first debug view.
    debug: Option<DebugPass>,
    /// The shadows of the last picture, to detect a change of scene.
    last_shadows: Weak<ShadowScene>,
    meter: LightMeter,
    /// The exposure of the renderer that this one follows, if any.
    followed: Option<wgpu::Buffer>,
    tone_map: ToneMapPass,
    output_format: wgpu::TextureFormat,
    samples: u32,
    /// Targets of the last pictures, the most recent first.
    targets: Vec<Targets>,
    keeps_radiance: bool,
}

/// Source of the automatic exposure of a renderer.
pub enum Metering<'a> {
    /// Its own light meter.
    Own,
    /// The light meter of another renderer. Both renderers meter, and the exposure is that of the picture drawn last.
    Shared(&'a Renderer),
    /// The light meter of another renderer. Only the other renderer meters.
    Followed(&'a Renderer),
}

impl Renderer {
    /// Creates a renderer for textures of `output_format`, with `samples` samples a pixel (1 or 4).
    #[must_use]
    pub fn new(gpu: &Gpu, output_format: wgpu::TextureFormat, samples: u32) -> Self {
        Self::with_metering(gpu, output_format, samples, Metering::Own)
    }

    /// Creates a renderer as [`Self::new`], with an automatic exposure from `metering`.
    #[must_use]
    pub fn with_metering(gpu: &Gpu, output_format: wgpu::TextureFormat, samples: u32, metering: Metering<'_>) -> Self {
        let frame_layout = frame_layout(gpu);
        let meter = match metering {
            Metering::Shared(other) => other.meter.exposure().clone(),
            Metering::Own | Metering::Followed(_) => LightMeter::new_exposure(gpu),
        };
        Self {
            weighted: WeightedLight::new(gpu, &frame_layout),
            tile_filler: TileFiller::new(gpu, &frame_layout),
            surfaces: HashMap::new(),
            live: None,
            debug: None,
            last_shadows: Weak::new(),
            meter: LightMeter::new(gpu, &frame_layout, meter),
            followed: match metering {
                Metering::Followed(other) => Some(other.meter.exposure().clone()),
                Metering::Own | Metering::Shared(_) => None,
            },
            tone_map: ToneMapPass::new(gpu, &frame_layout, output_format, samples),
            frame_layout,
            output_format,
            samples,
            targets: Vec::new(),
            keeps_radiance: false,
        }
    }

    /// Creates a renderer as [`Self::new`] whose [`Self::hdr`] holds the radiance of the last picture.
    pub(super) fn keeping_radiance(gpu: &Gpu, output_format: wgpu::TextureFormat, samples: u32) -> Self {
        Self { keeps_radiance: true, ..Self::new(gpu, output_format, samples) }
    }

    /// Records a part of the direct light of a picture. The next [`Self::draw`] of the same picture adds the rest.
    pub fn add_light(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, request: &PictureRequest<'_>) {
        self.note_scene(request);
        let bindings = frame_bind_group(gpu, &self.frame_layout, request.scene, &request.view, request.settings);
        let in_view = request.scene.in_view(gpu, &request.view.cull_view(request.settings.cull_back));
        let frame = frame_context(gpu, request, &bindings, &in_view);
        if let (Some(settings), Some(frame)) = (&request.settings.shadows, frame) {
            let live = self.live.get_or_insert_with(|| RealTimeLight::new(gpu, &self.frame_layout, self.samples));
            live.draw(encoder, frame, settings);
        }
    }

    /// Records the passes of a picture. It fills `target`, which has the size of the request.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        request: &PictureRequest<'_>,
    ) {
        self.note_scene(request);
        let &PictureRequest { size, scene, view, settings, stopwatch, .. } = request;
        let kept = self.targets.iter().position(|targets| targets.size == size);
        let targets = kept.map(|at| self.targets.remove(at)).unwrap_or_else(|| Targets::new(gpu, size, self.samples));
        let bindings = frame_bind_group(gpu, &self.frame_layout, scene, &view, settings);
        let in_view = &scene.in_view(gpu, &view.cull_view(settings.cull_back));
        let frame = frame_context(gpu, request, &bindings, in_view);
        let lap =
            |encoder: &mut wgpu::CommandEncoder, name| stopwatch.iter().for_each(|watch| watch.lap(encoder, name));

        // Sum the light of the vertices over the light groups.
        let stored = self.weighted.of(gpu, encoder, &bindings, scene, settings).clone();
        // Add up direct light from the lights themselves, each with its shadows.
        let live = settings.shadows.as_ref().zip(frame).map(|(shadows, frame)| {
            let live = self.live.get_or_insert_with(|| RealTimeLight::new(gpu, &self.frame_layout, self.samples));
            live.draw(encoder, frame, shadows)
        });
        if live.is_none() {
            self.live.iter_mut().for_each(RealTimeLight::release_targets);
        }
        // Draw the surfaces: as display colours, or as radiance for the passes that follow.
        let is_metered = settings.fixed_exposure().is_none() && self.followed.is_none();
        let is_last = self.can_display_at_once(in_view, request);
        let onto = match (is_last, is_metered) {
            (true, true) => SurfaceTargets::display_and_luminance(gpu, target, self.output_format, &targets, settings),
            (true, false) => SurfaceTargets::display(target, self.output_format, &targets, settings),
            (false, _) => SurfaceTargets::radiance(&targets),
        };
        let exposure = self.followed.as_ref().unwrap_or(self.meter.exposure());
        let source = DirectSource::of(live.as_ref());
        if let Some(tiled) = scene.tiled.as_ref().filter(|_| source.shows_tiles()) {
            let light = TileLight { scene, settings, weighted: &stored, lit_by_lights: live.is_some() };
            self.tile_filler.fill(gpu, encoder, &bindings, &tiled.tiles, light);
        }
        let surface = self.surfaces.entry(source);
        let surface = surface.or_insert_with(|| SurfacePass::new(gpu, &self.frame_layout, self.samples, source));
        let live = live.as_ref();
        let input = SurfaceInput { bindings: &bindings, in_view, settings, stored: &stored, exposure, live };
        surface.draw(gpu, encoder, &onto, input);
        lap(encoder, "surfaces");
        // Meter the exposure of this picture.
        if is_metered {
            let input = if is_last { MeterInput::Luminance } else { MeterInput::Radiance };
            self.meter.draw(gpu, encoder, &targets, input, &bindings);
            lap(encoder, "light meter");
        }
        // Apply exposure, tone curve, sRGB encoding and dither.
        if !is_last {
            self.tone_map.draw(gpu, encoder, &targets, &bindings, exposure, target);
            lap(encoder, "tone map");
        }
        // Draw the debug view of the shadow technique.
        if let (Some(debug), Some(frame)) = (settings.shadow_debug, frame) {
            let pass = self.debug.get_or_insert_with(|| DebugPass::new(gpu, &self.frame_layout, self.output_format));
            pass.draw(encoder, target, frame, debug);
        }

        request.shadows.iter().for_each(|shadows| shadows.drop_unused());
        // With one sample a pixel, pictures of a movement may alternate between sizes.
        self.targets.insert(0, targets);
        self.targets.truncate(if self.samples == 1 { 2 } else { 1 });
    }

    /// Drops the data that is cached for the last scene if the request is for another one.
    fn note_scene(&mut self, request: &PictureRequest<'_>) {
        let shadows = request.shadows.map_or_else(Weak::new, Arc::downgrade);
        if !Weak::ptr_eq(&self.last_shadows, &shadows) {
            self.live.iter_mut().for_each(RealTimeLight::clear_scene);
            self.debug.iter_mut().for_each(DebugPass::clear_scene);
            self.last_shadows = shadows;
        }
    }

    /// Returns true if the surface pass can write display colours: nothing else reads the radiance, the exposure is
    /// known in advance, and neither samples nor surfaces are blended.
    fn can_display_at_once(&self, in_view: &SceneBuffers, request: &PictureRequest<'_>) -> bool {
        let blends = in_view.batches.iter().any(|batch| batch.alpha_mode == AlphaMode::Blend);
        let is_exposed = request.settings.fixed_exposure().is_some() || request.exposure == MeteredExposure::OfLast;
        !self.keeps_radiance && self.samples == 1 && is_exposed && !blends
    }

    /// Returns the last metered exposure in stops; `None` if no picture was metered. Blocks until the picture is drawn.
    ///
    /// # Errors
    /// Returns an error if the device was lost.
    pub fn metered_ev(&self, gpu: &Gpu) -> Result<Option<f32>, GpuError> {
        let bytes = read_buffer(gpu, self.meter.exposure())?;
        let factor = bytes.first_chunk().map_or(0.0, |bytes| f32::from_ne_bytes(*bytes));
        Ok((factor > 0.0).then(|| factor.log2()))
    }

    /// Returns the radiance of the last picture of [`Self::keeping_radiance`], before exposure and scaled by
    /// [`SceneBuffers::pre_exposure`].
    pub(super) fn hdr(&self) -> Option<&wgpu::Texture> {
        self.targets.first().map(|targets| &targets.hdr)
    }
}

/// Returns the input of every shadow pass; `None` if the request has no casters and lights.
fn frame_context<'a>(
    gpu: &'a Gpu,
    request: &'a PictureRequest<'_>,
    bindings: &'a wgpu::BindGroup,
    in_view: &'a SceneBuffers,
) -> Option<FrameContext<'a>> {
    let PictureRequest { size, scene, shadows, view, settings, stopwatch, .. } = request;
    let (size, stopwatch) = (*size, *stopwatch);
    shadows.map(|shadows| FrameContext {
        gpu,
        bindings,
        size,
        scene,
        in_view,
        shadows,
        view,
        render_settings: settings,
        stopwatch,
    })
}
