//! A picture without a window, and its file.

use std::io::Cursor;
use std::path::Path;
use std::sync::Arc;

use glam::Vec3;

use super::{RenderError, RenderSettings, Renderer, ShadowScene, View};
use crate::baked::BakedScene;
use crate::base::colour::srgb_from_linear;
use crate::base::output::write_whole;
use crate::gpu::readback::read_texture;
use crate::gpu::{Gpu, GpuError};
use crate::render::scene::SceneBuffers;
use crate::scene::Camera;

/// Samples a pixel of a picture for people.
const SAMPLES: u32 = 4;

/// A finished picture, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Linear radiance before exposure, premultiplied by the fourth channel, the share of the pixel that is covered.
    pub radiance: Vec<[f32; 4]>,
    /// RGBA bytes as displayed, sRGB.
    pub display: Vec<u8>,
}

/// A picture of `size` pixels, with smooth edges.
///
/// # Errors
/// The size is more than the GPU can draw, or the GPU was lost.
pub fn picture(
    gpu: &Gpu,
    baked: &BakedScene,
    camera: &Camera,
    size: [u32; 2],
    settings: &RenderSettings,
) -> Result<Picture, GpuError> {
    let asks = settings.shadows.is_some() || settings.shadow_debug.is_some();
    let shadows = asks.then(|| Arc::new(ShadowScene::new(gpu, Arc::new(baked.scene.clone()))));
    picture_in_light(gpu, &SceneBuffers::new(gpu, baked), shadows, camera, size, settings, SAMPLES)
}

/// A picture of a scene that is on the device already, with `samples` samples a pixel, 1 or 4.
///
/// # Errors
/// As [`picture`].
pub fn picture_of(
    gpu: &Gpu,
    scene: &SceneBuffers,
    camera: &Camera,
    size: [u32; 2],
    settings: &RenderSettings,
    samples: u32,
) -> Result<Picture, GpuError> {
    picture_in_light(gpu, scene, None, camera, size, settings, samples)
}

/// A picture as [`picture_of`], with direct light from the lights of `shadows` where the look asks for it.
///
/// # Errors
/// As [`picture`].
pub fn picture_in_light(
    gpu: &Gpu,
    scene: &SceneBuffers,
    shadows: Option<Arc<ShadowScene>>,
    camera: &Camera,
    size: [u32; 2],
    settings: &RenderSettings,
    samples: u32,
) -> Result<Picture, GpuError> {
    check_size(gpu, size)?;
    let mut renderer = Renderer::new(gpu, wgpu::TextureFormat::Rgba8Unorm, samples);
    renderer.cast_shadows(shadows);
    renderer.keep_radiance();
    let target = display_target(gpu, size);
    let view = View::from_camera(camera, size[0] as f32 / size[1] as f32);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("picture") });
    renderer.draw(gpu, &mut encoder, &target.create_view(&Default::default()), size, scene, &view, settings);
    gpu.queue.submit([encoder.finish()]);

    let display = read_texture(gpu, &target, 4)?;
    let hdr = renderer.hdr().expect("a picture has just been drawn");
    let radiance = radiance_from_hdr(&read_texture(gpu, hdr, 8)?, scene.pre_exposure);
    Ok(Picture { width: size[0], height: size[1], radiance, display })
}

/// A picture of this size can be drawn.
///
/// # Errors
/// It cannot.
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

/// Undoes half floats and pre-exposure.
fn radiance_from_hdr(bytes: &[u8], pre_exposure: f32) -> Vec<[f32; 4]> {
    let (pixels, _) = bytes.as_chunks::<8>();
    let channel = |pixel: &[u8; 8], i: usize| f32_from_half(u16::from_le_bytes([pixel[2 * i], pixel[2 * i + 1]]));
    let radiance = |pixel: &[u8; 8]| {
        let [r, g, b] = std::array::from_fn(|i| channel(pixel, i) / pre_exposure);
        [r, g, b, channel(pixel, 3)]
    };
    pixels.iter().map(radiance).collect()
}

/// Value of an IEEE 754 half float.
pub(super) fn f32_from_half(bits: u16) -> f32 {
    let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
    let exponent = i32::from(bits >> 10 & 0x1f);
    let fraction = f32::from(bits & 0x3ff);
    sign * match exponent {
        0 => fraction * 2f32.powi(-24),
        31 if fraction == 0.0 => f32::INFINITY,
        31 => f32::NAN,
        _ => (1024.0 + fraction) * 2f32.powi(exponent - 25),
    }
}

/// What a picture file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// `.png`: the picture as displayed.
    Display,
    /// `.exr`: linear radiance before exposure.
    Radiance,
}

impl FileKind {
    /// The kind that a file name asks for.
    ///
    /// # Errors
    /// The name ends in neither `.png` nor `.exr`.
    pub fn of(path: &Path) -> Result<Self, RenderError> {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("png") => Ok(FileKind::Display),
            Some("exr") => Ok(FileKind::Radiance),
            _ => Err(RenderError::UnknownExtension { path: path.to_owned() }),
        }
    }
}

impl Picture {
    /// Writes what is displayed as `.png`, or the linear radiance as `.exr`.
    ///
    /// The file appears under its name only when it is whole.
    ///
    /// # Errors
    /// The name ends in neither, or the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), RenderError> {
        match FileKind::of(path)? {
            FileKind::Display => write_image(path, image::ImageFormat::Png, &self.displayed()),
            FileKind::Radiance => write_image(path, image::ImageFormat::OpenExr, &self.linear()),
        }
    }

    fn displayed(&self) -> image::DynamicImage {
        let opaque: Vec<u8> = self.display.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
        image::RgbImage::from_raw(self.width, self.height, opaque).expect("three bytes a pixel").into()
    }

    fn linear(&self) -> image::DynamicImage {
        let rgb: Vec<f32> = self.radiance.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
        image::Rgb32FImage::from_raw(self.width, self.height, rgb).expect("three floats a pixel").into()
    }
}

/// Writes linear display colours, whose white is 1, as `.png`, or as they are as `.exr`.
///
/// # Errors
/// As [`Picture::save`].
pub fn save_display(path: &Path, size: [u32; 2], pixels: &[Vec3]) -> Result<(), RenderError> {
    let encode = |channel: f32| (255.0 * srgb_from_linear(channel)).round() as u8;
    let display = pixels.iter().flat_map(|pixel| [encode(pixel.x), encode(pixel.y), encode(pixel.z), 255]).collect();
    let radiance = pixels.iter().map(|pixel| pixel.extend(1.0).to_array()).collect();
    Picture { width: size[0], height: size[1], radiance, display }.save(path)
}

fn write_image(path: &Path, format: image::ImageFormat, image: &image::DynamicImage) -> Result<(), RenderError> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).map_err(|cause| RenderError::Encode { path: path.to_owned(), cause })?;
    write_whole(path, bytes.get_ref()).map_err(|cause| RenderError::Write { path: path.to_owned(), cause })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_floats_have_their_value() {
        let known = [(0x0000, 0.0), (0x3c00, 1.0), (0xc000, -2.0), (0x7bff, 65504.0), (0x0001, 5.960_464_5e-8)];
        for (bits, value) in known {
            assert_eq!(f32_from_half(bits), value, "{bits:#x}");
        }
        assert_eq!(f32_from_half(0x3555), 0.333_251_95);
        assert!(f32_from_half(0x7c00).is_infinite() && f32_from_half(0x7e00).is_nan());
    }

    #[test]
    fn a_file_name_without_a_known_ending_is_refused() {
        let picture = Picture { width: 1, height: 1, radiance: vec![[0.0; 4]], display: vec![0; 4] };
        let message = picture.save(Path::new("light.tiff")).expect_err("no such format").to_string();
        assert!(message.contains("light.tiff") && message.contains(".png"), "{message}");
    }
}
