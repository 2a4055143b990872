//! The textures that one picture is drawn into.

use std::cell::OnceCell;

use crate::gpu::Gpu;

/// Radiance times pre-exposure, premultiplied by coverage; blendable and multisampled everywhere.
pub const HDR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Luminance times pre-exposure, for the light meter.
pub const LUMINANCE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R16Float;
/// Reversed depth: 1 at the near plane, 0 at infinity.
///
/// Perspective makes depth proportional to 1 / distance, and floats are dense near 0. With reversed depth the two
/// effects cancel, and the relative precision of a distance is nearly the same everywhere (Reed 2015, "Depth Precision
/// Visualized").
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// The textures that one picture is drawn into.
pub struct Targets {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The HDR picture with one value a pixel.
    pub hdr: wgpu::Texture,
    /// View of `hdr`.
    pub hdr_view: wgpu::TextureView,
    /// The HDR picture with several samples a pixel; `None` with one.
    pub samples: Option<wgpu::TextureView>,
    /// Depth of each sample.
    pub depth: wgpu::TextureView,
    /// Luminance texture; created by the first picture that needs it.
    luminance: OnceCell<wgpu::TextureView>,
}

impl Targets {
    /// Creates targets of `size` pixels with `samples` samples each.
    #[must_use]
    pub fn new(gpu: &Gpu, size: [u32; 2], samples: u32) -> Self {
        let drawn = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let texture = |label, format, sample_count, usage| texture(gpu, label, size, format, sample_count, usage);
        let hdr = texture("HDR", HDR_FORMAT, 1, drawn | wgpu::TextureUsages::COPY_SRC);
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self {
            size,
            hdr_view: view(&hdr),
            hdr,
            samples: (samples > 1).then(|| view(&texture("HDR samples", HDR_FORMAT, samples, drawn))),
            depth: view(&texture("depth", DEPTH_FORMAT, samples, wgpu::TextureUsages::RENDER_ATTACHMENT)),
            luminance: OnceCell::new(),
        }
    }

    /// Returns the luminance of each pixel, for pictures whose surface pass writes display colours.
    pub fn luminance(&self, gpu: &Gpu) -> &wgpu::TextureView {
        self.luminance.get_or_init(|| {
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
            let texture = texture(gpu, "luminance", self.size, LUMINANCE_FORMAT, 1, usage);
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        })
    }
}

fn texture(
    gpu: &Gpu,
    label: &str,
    size: [u32; 2],
    format: wgpu::TextureFormat,
    sample_count: u32,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}
