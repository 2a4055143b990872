//! An encoded image to pixels: PNG, JPEG, WebP, and KTX2 with Basis Universal inside.
//!
//! The size that an image claims is held against a limit before any memory is asked for.

use std::io::Cursor;

use basisu::{DecodeFlags, TargetFormat, Transcoder};
use image::{ImageFormat, ImageReader, Limits};

/// Largest image side that is decoded, pixels.
const MAX_IMAGE_SIDE: u32 = 16_384;

/// Memory of the largest image.
const MAX_IMAGE_BYTES: u64 = 4 * (MAX_IMAGE_SIDE as u64).pow(2);

/// What a KTX2 file begins with.
const KTX2_MAGIC: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// A decoded image.
pub(super) struct Pixels {
    pub width: u32,
    pub height: u32,
    /// RGBA bytes, row by row from the top.
    pub rgba: Vec<u8>,
    pub mime_type: &'static str,
}

/// Decodes an image, whatever its file claims to be.
///
/// Errors: a sentence that says what is wrong.
pub(super) fn decode(encoded: &[u8]) -> Result<Pixels, String> {
    if encoded.starts_with(&KTX2_MAGIC) {
        return decode_ktx2(encoded);
    }
    let format = match image::guess_format(encoded) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg | ImageFormat::WebP)) => format,
        _ => return Err("it is neither PNG, JPEG, WebP nor KTX2".to_owned()),
    };
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_IMAGE_SIDE);
    limits.max_image_height = Some(MAX_IMAGE_SIDE);
    limits.max_alloc = Some(MAX_IMAGE_BYTES);
    let mut reader = ImageReader::with_format(Cursor::new(encoded), format);
    reader.limits(limits);
    let pixels = reader.decode().map_err(|error| format!("it cannot be decoded: {error}"))?.into_rgba8();
    let (width, height) = pixels.dimensions();
    Ok(Pixels { width, height, rgba: pixels.into_raw(), mime_type: format.to_mime_type() })
}

/// The largest level of a Basis Universal texture.
fn decode_ktx2(encoded: &[u8]) -> Result<Pixels, String> {
    let failed = |error: basisu::Error| format!("it cannot be decoded as Basis Universal: {error:?}");
    let texture = Transcoder::new(encoded).map_err(failed)?;
    let (width, height) = texture.base_dimensions();
    if width == 0 || height == 0 || width > MAX_IMAGE_SIDE || height > MAX_IMAGE_SIDE {
        return Err(format!("{width} x {height} pixels are too many"));
    }
    let rgba = texture.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE).map_err(failed)?;
    if rgba.len() as u64 != 4 * u64::from(width) * u64::from(height) {
        return Err("its size is not what it claims".to_owned());
    }
    Ok(Pixels { width, height, rgba, mime_type: "image/ktx2" })
}
