//! A texture in place of the screen.

use hemicube::gpu::Gpu;
use hemicube::gpu::readback::read_texture;
use hemicube::render::{PictureRequest, Renderer};
use wgpu::{
    CommandEncoderDescriptor, Extent3d, Texture, TextureDescriptor, TextureDimension, TextureFormat, TextureUsages,
};

/// Creates a texture of `size` pixels.
pub fn screen(gpu: &Gpu, size: [u32; 2], format: TextureFormat) -> Texture {
    gpu.device.create_texture(&TextureDescriptor {
        label: Some("screen"),
        size: Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format,
        usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC | TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// Draws a picture with a renderer for [`TextureFormat::Rgba8Unorm`]. Returns its RGBA bytes.
pub fn displayed(gpu: &Gpu, renderer: &mut Renderer, request: &PictureRequest<'_>) -> Vec<u8> {
    let target = screen(gpu, request.size, TextureFormat::Rgba8Unorm);
    let mut encoder = gpu.device.create_command_encoder(&CommandEncoderDescriptor::default());
    renderer.draw(gpu, &mut encoder, &target.create_view(&Default::default()), request);
    gpu.queue.submit([encoder.finish()]);
    read_texture(gpu, &target, 4).expect("a picture")
}
