//! Targets of direct light: depth and stencil of the visible surfaces, and the sum of their irradiance.

use crate::gpu::Gpu;
use crate::render::shadow::shared::pipeline::depth_stencil_format;

/// Returns 32-bit floats if the device can blend them, else 16-bit floats. Sums of hundreds of samples lose precision
/// in the latter.
pub fn irradiance_format(gpu: &Gpu, samples: u32) -> wgpu::TextureFormat {
    use wgpu::TextureFormatFeatureFlags as Flags;
    let needed = if samples > 1 { Flags::BLENDABLE | Flags::MULTISAMPLE_X4 } else { Flags::BLENDABLE };
    let features = gpu.device.features();
    let adds_up = features.contains(wgpu::Features::FLOAT32_BLENDABLE)
        && (samples == 1 || features.contains(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES))
        && gpu.adapter.get_texture_format_features(wgpu::TextureFormat::Rgba32Float).flags.contains(needed);
    if adds_up { wgpu::TextureFormat::Rgba32Float } else { wgpu::TextureFormat::Rgba16Float }
}

/// Targets in which direct light is added up.
pub struct LightTargets {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Depth and stencil of each sample of a pixel.
    pub depth_stencil: wgpu::TextureView,
    /// Texture of `depth_stencil`.
    pub depth_stencil_texture: wgpu::Texture,
    /// Irradiance times pre-exposure. The fourth channel counts the visible light samples.
    pub irradiance: wgpu::Texture,
    /// View of `irradiance`.
    pub irradiance_view: wgpu::TextureView,
}

impl LightTargets {
    /// Creates targets of `size` pixels with `samples` samples each.
    pub fn new(gpu: &Gpu, size: [u32; 2], samples: u32) -> Self {
        let texture = |label, format, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: samples,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let drawn = wgpu::TextureUsages::RENDER_ATTACHMENT;
        // Multisampled textures cannot be copied.
        let copied = if samples > 1 { wgpu::TextureUsages::empty() } else { wgpu::TextureUsages::COPY_SRC };
        let read = wgpu::TextureUsages::TEXTURE_BINDING;
        let irradiance = texture("direct irradiance", irradiance_format(gpu, samples), drawn | read | copied);
        // Debug views read the stencil, with one sample a pixel.
        let inspected = if samples > 1 { copied } else { copied | read };
        let depth_stencil = texture("depth and stencil", depth_stencil_format(gpu), drawn | inspected);
        Self {
            size,
            depth_stencil: depth_stencil.create_view(&Default::default()),
            depth_stencil_texture: depth_stencil,
            irradiance_view: irradiance.create_view(&Default::default()),
            irradiance,
        }
    }
}
