//! Targets of the surface pass: radiance for the passes that follow, or display colours directly.

use super::variant::Output;
use crate::base::colour::srgb_from_linear;
use crate::gpu::Gpu;
use crate::render::RenderSettings;
use crate::render::targets::Targets;

/// Textures that the surface pass draws into, all of one size.
pub struct SurfaceTargets<'a> {
    /// Target of radiance or display colours, according to `output`.
    colour: &'a wgpu::TextureView,
    /// Target that receives the mean of the samples of each pixel.
    resolve: Option<&'a wgpu::TextureView>,
    /// Target of depth.
    depth: &'a wgpu::TextureView,
    /// Target of luminance for the light meter, if `output` includes it.
    luminance: Option<&'a wgpu::TextureView>,
    /// Output of the pass.
    pub output: Output,
    /// Colour of pixels without a surface.
    background: wgpu::Color,
}

impl<'a> SurfaceTargets<'a> {
    /// Returns targets of radiance. Pixels without a surface have no light and no coverage.
    pub fn radiance(targets: &'a Targets) -> Self {
        let (colour, resolve) = match &targets.samples {
            Some(samples) => (samples, Some(&targets.hdr_view)),
            None => (&targets.hdr_view, None),
        };
        let background = wgpu::Color::TRANSPARENT;
        Self { colour, resolve, depth: &targets.depth, luminance: None, output: Output::Radiance, background }
    }

    /// Returns targets of display colours, of `format`. Pixels without a surface have the background of `settings`.
    pub fn display(
        target: &'a wgpu::TextureView,
        format: wgpu::TextureFormat,
        targets: &'a Targets,
        settings: &RenderSettings,
    ) -> Self {
        let encoded = |linear| if format.is_srgb() { linear } else { srgb_from_linear(linear) };
        let [r, g, b] = settings.background.to_array().map(|channel| f64::from(encoded(channel.clamp(0.0, 1.0))));
        Self {
            colour: target,
            resolve: None,
            depth: &targets.depth,
            luminance: None,
            output: Output::Display(format, settings.tone_map_in_force()),
            background: wgpu::Color { r, g, b, a: 1.0 },
        }
    }

    /// Returns the targets of [`Self::display`], and one for the luminance from which the exposure of the next picture
    /// is metered.
    pub fn display_and_luminance(
        gpu: &Gpu,
        target: &'a wgpu::TextureView,
        format: wgpu::TextureFormat,
        targets: &'a Targets,
        settings: &RenderSettings,
    ) -> Self {
        let output = Output::DisplayAndLuminance(format, settings.tone_map_in_force());
        Self { luminance: Some(targets.luminance(gpu)), output, ..Self::display(target, format, targets, settings) }
    }

    /// Begins a pass that clears the targets. Depth is cleared to that of infinity.
    pub fn begin<'e>(&self, encoder: &'e mut wgpu::CommandEncoder) -> wgpu::RenderPass<'e> {
        let cleared = |view, resolve_target, colour| {
            let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(colour), store: wgpu::StoreOp::Store };
            Some(wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target, ops })
        };
        let mut colours = vec![cleared(self.colour, self.resolve, self.background)];
        colours.extend(self.luminance.map(|view| cleared(view, None, wgpu::Color::TRANSPARENT)));
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("surface"),
            color_attachments: &colours,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: self.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }
}
