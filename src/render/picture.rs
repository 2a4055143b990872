//! A finished picture and its file.

use std::io::Cursor;
use std::path::Path;

use glam::Vec3;

use super::RenderError;
use crate::base::colour::srgb_from_linear;
use crate::base::output::write_whole;

/// A finished picture, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Linear radiance before exposure, premultiplied by the fourth channel, which is the covered share of the pixel.
    pub radiance: Vec<[f32; 4]>,
    /// RGBA bytes as displayed, sRGB encoded.
    pub display: Vec<u8>,
}

/// Content of a picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// `.png`: the picture as displayed.
    Display,
    /// `.exr`: linear radiance before exposure.
    Radiance,
}

impl FileKind {
    /// Returns the kind of a file by the extension of its name.
    ///
    /// # Errors
    /// Returns an error if the name ends in neither `.png` nor `.exr`.
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
    /// Writes the display colours as `.png`, or the linear radiance as `.exr`.
    ///
    /// The file is written under another name and renamed when it is complete.
    ///
    /// # Errors
    /// Returns an error if the name ends in neither, or if the file cannot be written.
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

/// Writes linear display colours with white at 1 into a `.png` (sRGB encoded) or `.exr` file (unchanged).
///
/// # Errors
/// Returns an error in the same cases as [`Picture::save`].
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
    fn a_file_name_without_a_known_ending_is_refused() {
        let picture = Picture { width: 1, height: 1, radiance: vec![[0.0; 4]], display: vec![0; 4] };
        let message = picture.save(Path::new("light.tiff")).expect_err("no such format").to_string();
        assert!(message.contains("light.tiff") && message.contains(".png"), "{message}");
    }
}
