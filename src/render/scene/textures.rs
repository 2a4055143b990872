//! Textures and samplers of a scene on the device.

use std::collections::HashMap;
use std::sync::Arc;

use wgpu::util::DeviceExt;

use super::mip::{Encoding, Level, mip_chain};
use crate::gpu::Gpu;
use crate::scene::{Image, Sampler, Scene, TextureSlot, Wrap};

/// Largest number of samples along the longer axis of the footprint of a pixel.
const ANISOTROPY: u16 = 8;

/// The samplers of a scene, and the images that its materials read. An image is uploaded once for each encoding.
pub struct Textures {
    images: HashMap<(*const Image, Encoding), wgpu::TextureView>,
    samplers: HashMap<Sampler, wgpu::Sampler>,
    white: wgpu::TextureView,
}

impl Textures {
    /// Creates a set that holds only a white texel.
    #[must_use]
    pub fn new(gpu: &Gpu) -> Self {
        let white = [Level { width: 1, height: 1, rgba: vec![255; 4] }];
        Self { images: HashMap::new(), samplers: HashMap::new(), white: upload(gpu, "white", &white, Encoding::Linear) }
    }

    /// Returns texture and sampler of a slot. The first call uploads the texture. Without a slot the texture is white.
    pub fn bind(
        &mut self,
        gpu: &Gpu,
        scene: &Scene,
        slot: Option<&TextureSlot>,
        encoding: Encoding,
    ) -> (wgpu::TextureView, wgpu::Sampler) {
        let Some(texture) = slot.map(|slot| &scene.textures[slot.texture.index()]) else {
            let anything = Sampler { wrap_u: Wrap::Clamp, wrap_v: Wrap::Clamp, nearest: true };
            return (self.white.clone(), self.sampler(gpu, anything));
        };
        let view = self
            .images
            .entry((Arc::as_ptr(&texture.image), encoding))
            .or_insert_with(|| upload_image(gpu, &texture.image, encoding))
            .clone();
        (view, self.sampler(gpu, texture.sampler))
    }

    fn sampler(&mut self, gpu: &Gpu, sampler: Sampler) -> wgpu::Sampler {
        self.samplers.entry(sampler).or_insert_with(|| create_sampler(gpu, sampler)).clone()
    }
}

fn upload_image(gpu: &Gpu, image: &Image, encoding: Encoding) -> wgpu::TextureView {
    let max_size = gpu.device.limits().max_texture_dimension_2d;
    let levels = mip_chain(image.width, image.height, &image.rgba, encoding, max_size);
    upload(gpu, &image.name, &levels, encoding)
}

fn upload(gpu: &Gpu, label: &str, levels: &[Level], encoding: Encoding) -> wgpu::TextureView {
    let texels: Vec<u8> = levels.iter().flat_map(|level| &level.rgba).copied().collect();
    let descriptor = wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: levels[0].width, height: levels[0].height, depth_or_array_layers: 1 },
        mip_level_count: levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: match encoding {
            Encoding::Srgb => wgpu::TextureFormat::Rgba8UnormSrgb,
            Encoding::Linear => wgpu::TextureFormat::Rgba8Unorm,
        },
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    gpu.device.create_texture_with_data(&gpu.queue, &descriptor, order, &texels).create_view(&Default::default())
}

fn create_sampler(gpu: &Gpu, sampler: Sampler) -> wgpu::Sampler {
    let mode = |wrap| match wrap {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
    };
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("scene texture"),
        address_mode_u: mode(sampler.wrap_u),
        address_mode_v: mode(sampler.wrap_v),
        mag_filter: if sampler.nearest { wgpu::FilterMode::Nearest } else { wgpu::FilterMode::Linear },
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        // Anisotropic filtering requires that every filter is linear.
        anisotropy_clamp: if sampler.nearest { 1 } else { ANISOTROPY },
        ..Default::default()
    })
}
