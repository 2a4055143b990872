//! What direct light is gathered in: depth and stencil of the visible surfaces, and the irradiance that adds up on them.

use crate::gpu::Gpu;

/// Depth with eight bits of stencil: as many as every device has, and as many as count volumes before they wrap.
pub fn depth_stencil_format(gpu: &Gpu) -> wgpu::TextureFormat {
    if gpu.device.features().contains(wgpu::Features::DEPTH32FLOAT_STENCIL8) {
        wgpu::TextureFormat::Depth32FloatStencil8
    } else {
        wgpu::TextureFormat::Depth24PlusStencil8
    }
}

/// Whole floats where the device can add them up, else half floats, which lose a little with hundreds of samples.
pub fn irradiance_format(gpu: &Gpu, samples: u32) -> wgpu::TextureFormat {
    use wgpu::TextureFormatFeatureFlags as Flags;
    let needed = if samples > 1 { Flags::BLENDABLE | Flags::MULTISAMPLE_X4 } else { Flags::BLENDABLE };
    let features = gpu.device.features();
    let adds_up = features.contains(wgpu::Features::FLOAT32_BLENDABLE)
        && (samples == 1 || features.contains(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES))
        && gpu.adapter.get_texture_format_features(wgpu::TextureFormat::Rgba32Float).flags.contains(needed);
    if adds_up { wgpu::TextureFormat::Rgba32Float } else { wgpu::TextureFormat::Rgba16Float }
}

/// What direct light is gathered in.
pub struct LightTargets {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Of each sample.
    pub depth_stencil: wgpu::TextureView,
    /// What `depth_stencil` is a view of.
    pub depth_stencil_texture: wgpu::Texture,
    /// Irradiance times pre-exposure; the fourth channel counts the light samples that are seen.
    pub irradiance: wgpu::Texture,
    /// View of `irradiance`.
    pub irradiance_view: wgpu::TextureView,
}

impl LightTargets {
    /// Targets of `size` pixels with `samples` samples each.
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
        // Textures with several samples a pixel can be neither copied from nor to.
        let copied = if samples > 1 { wgpu::TextureUsages::empty() } else { wgpu::TextureUsages::COPY_SRC };
        let read = wgpu::TextureUsages::TEXTURE_BINDING;
        let irradiance = texture("direct irradiance", irradiance_format(gpu, samples), drawn | read | copied);
        // Debug views read the stencil of pictures with one sample a pixel.
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
