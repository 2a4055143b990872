//! Draws pictures without a window.

use std::sync::Arc;

use super::frame::Renderer;
use super::picture::Picture;
use super::picture_request::PictureRequest;
use super::{RenderSettings, ShadowScene};
use crate::baked::BakedScene;
use crate::gpu::readback::{f32_from_half, read_texture};
use crate::gpu::{Gpu, GpuError};
use crate::render::scene::SceneBuffers;
use crate::scene::Camera;

/// Number of samples a pixel of a picture for people, with smooth edges.
const SAMPLES: u32 = 4;

/// Uploads a bake and draws a picture of `size` pixels with smooth edges.
///
/// ```no_run
/// use hemicube::scene::builtin;
/// use hemicube::{BakeSettings, Gpu, Quality, RenderSettings, bake, picture};
///
/// let baked = bake(&builtin::cornell(), &BakeSettings::preset(Quality::Draft))?.baked;
/// let camera = &baked.scene.cameras[0];
/// let picture = picture(&Gpu::headless()?, &baked, camera, [640, 480], &RenderSettings::default())?;
/// picture.save("cornell.png".as_ref())?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns an error if the size is more than the GPU can draw, or if the device was lost.
pub fn picture(
    gpu: &Gpu,
    baked: &BakedScene,
    camera: &Camera,
    size: [u32; 2],
    settings: &RenderSettings,
) -> Result<Picture, GpuError> {
    gpu.check()?;
    let has_shadows = settings.shadows.is_some() || settings.shadow_debug.is_some();
    let shadows = has_shadows.then(|| Arc::new(ShadowScene::new(gpu, Arc::new(baked.scene.clone()))));
    let scene = SceneBuffers::new(gpu, baked);
    let request = PictureRequest::new(&scene, camera, size, settings);
    draw_picture(gpu, &PictureRequest { shadows: shadows.as_ref(), ..request }, SAMPLES)
}

/// Draws a picture of a scene that is on the device already, with `samples` samples a pixel, 1 or 4.
///
/// # Errors
/// Returns an error in the same cases as [`picture`].
pub fn draw_picture(gpu: &Gpu, request: &PictureRequest<'_>, samples: u32) -> Result<Picture, GpuError> {
    let [width, height] = request.size;
    gpu.check()?;
    check_size(gpu, request.size)?;
    let mut renderer = Renderer::keeping_radiance(gpu, wgpu::TextureFormat::Rgba8Unorm, samples);
    let target = display_target(gpu, request.size);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("picture") });
    renderer.draw(gpu, &mut encoder, &target.create_view(&Default::default()), request);
    gpu.queue.submit([encoder.finish()]);

    let display = read_texture(gpu, &target, 4)?;
    let hdr = renderer.hdr().expect("a picture has just been drawn");
    let radiance = radiance_from_hdr(&read_texture(gpu, hdr, 8)?, request.scene.pre_exposure);
    Ok(Picture { width, height, radiance, display })
}

/// Checks that the device can draw a picture of this size.
///
/// # Errors
/// Returns an error if a side is 0 or larger than the largest texture.
pub fn check_size(gpu: &Gpu, size: [u32; 2]) -> Result<(), GpuError> {
    let limit = gpu.device.limits().max_texture_dimension_2d;
    if size.iter().all(|side| (1..=limit).contains(side)) {
        return Ok(());
    }
    Err(GpuError::PictureSize { width: size[0], height: size[1], limit })
}

fn display_target(gpu: &Gpu, size: [u32; 2]) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("display"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

/// Returns linear radiance from half floats that were scaled by the pre-exposure.
fn radiance_from_hdr(bytes: &[u8], pre_exposure: f32) -> Vec<[f32; 4]> {
    let (pixels, _) = bytes.as_chunks::<8>();
    let channel = |pixel: &[u8; 8], i: usize| f32_from_half(u16::from_le_bytes([pixel[2 * i], pixel[2 * i + 1]]));
    let radiance = |pixel: &[u8; 8]| {
        let [r, g, b] = std::array::from_fn(|i| channel(pixel, i) / pre_exposure);
        [r, g, b, channel(pixel, 3)]
    };
    pixels.iter().map(radiance).collect()
}
