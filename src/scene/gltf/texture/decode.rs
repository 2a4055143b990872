//! Decodes images: PNG, JPEG, WebP, and KTX2 with Basis Universal.
//!
//! The size in an image's header is checked against a limit before any memory is allocated.

use std::io::Cursor;

use basisu::{DecodeFlags, TargetFormat, Transcoder};
use image::{ImageFormat, ImageReader, Limits};

/// Largest image side that is decoded, pixels.
const MAX_IMAGE_SIDE: u32 = 16_384;

/// Largest number of bytes of a decoded image.
const MAX_IMAGE_BYTES: u64 = 4 * (MAX_IMAGE_SIDE as u64).pow(2);

/// First bytes of a KTX2 file.
const KTX2_MAGIC: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// A decoded image.
pub(crate) struct Pixels {
    pub width: u32,
    pub height: u32,
    /// RGBA bytes, row by row from the top.
    pub rgba: Vec<u8>,
    pub mime_type: &'static str,
}

/// Returns the number of pixels according to the header of an image.
///
/// # Errors
/// Returns an error if the format is not supported, the header is invalid, or a side is longer than [`MAX_IMAGE_SIDE`].
pub(crate) fn claimed_pixels(encoded: &[u8]) -> Result<u64, String> {
    let (width, height) = if encoded.starts_with(&KTX2_MAGIC) {
        let side = |at: usize| encoded.get(at..at + 4).map_or(0, |b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        (side(20), side(24))
    } else {
        let size = ImageReader::with_format(Cursor::new(encoded), format_of(encoded)?).into_dimensions();
        size.map_err(|error| format!("it cannot be decoded: {error}"))?
    };
    if width > MAX_IMAGE_SIDE || height > MAX_IMAGE_SIDE {
        return Err(format!("{width} x {height} pixels are too many"));
    }
    Ok(u64::from(width) * u64::from(height))
}

fn format_of(encoded: &[u8]) -> Result<ImageFormat, String> {
    match image::guess_format(encoded) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg | ImageFormat::WebP)) => Ok(format),
        _ => Err("it is neither PNG, JPEG, WebP nor KTX2".to_owned()),
    }
}

/// Decodes an image. Its first bytes determine the format, whatever the MIME type in the file.
///
/// # Errors
/// Returns an error if the format is not supported or the image is invalid. The error is one sentence, which the caller
/// embeds in a message.
pub(crate) fn decode(encoded: &[u8]) -> Result<Pixels, String> {
    if encoded.starts_with(&KTX2_MAGIC) {
        return decode_ktx2(encoded);
    }
    let format = format_of(encoded)?;
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

/// Bytes of a KTX2 header before its table of levels (KTX 2.0, section 2).
const KTX2_HEADER_BYTES: usize = 80;

/// Checks the header of a KTX2 file. glTF allows only a single two-dimensional image. No level may state more
/// uncompressed bytes than its pixels need, because the transcoder would allocate that memory.
fn check_ktx2_header(encoded: &[u8]) -> Result<(), String> {
    let word = |at: usize| encoded.get(at..at + 4).map_or(0, |b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let [width, height, depth, layers, faces, levels] = [20, 24, 28, 32, 36, 40].map(word);
    if depth > 1 || layers > 1 || faces != 1 {
        return Err("it is not a single two-dimensional image".to_owned());
    }
    for level in 0..levels.clamp(1, u32::BITS) {
        let blocks = |side: u32| u64::from((side >> level).max(1).div_ceil(4));
        // No block format needs more than 16 bytes for 4 x 4 pixels.
        let largest = 16 * blocks(width) * blocks(height);
        let at = KTX2_HEADER_BYTES + 24 * level as usize + 16;
        let unpacked = u64::from(word(at)) | u64::from(word(at + 4)) << 32;
        if unpacked > largest {
            return Err(format!("level {level} states {unpacked} bytes, but its pixels need at most {largest}"));
        }
    }
    Ok(())
}

/// Decodes the largest level of a Basis Universal texture.
fn decode_ktx2(encoded: &[u8]) -> Result<Pixels, String> {
    check_ktx2_header(encoded)?;
    let failed = |error: basisu::Error| format!("it cannot be decoded as Basis Universal: {error:?}");
    let texture = Transcoder::new(encoded).map_err(failed)?;
    let (width, height) = texture.base_dimensions();
    if width == 0 || height == 0 {
        return Err("it has no pixels".to_owned());
    }
    let rgba = texture.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE).map_err(failed)?;
    if rgba.len() as u64 != 4 * u64::from(width) * u64::from(height) {
        return Err("its size differs from its header".to_owned());
    }
    Ok(Pixels { width, height, rgba, mime_type: "image/ktx2" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_that_is_too_large_is_refused_by_its_header_alone() {
        let mut head = KTX2_MAGIC.to_vec();
        head.extend([0u32, 1, 100_000, 4, 0, 0, 1].into_iter().flat_map(u32::to_le_bytes));
        assert!(claimed_pixels(&head).expect_err("too wide").contains("100000 x 4"));
        let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec();
        png.extend([40_000u32, 40_000].into_iter().flat_map(u32::to_be_bytes));
        png.extend([8, 6, 0, 0, 0]);
        // Checksum of the header. Image data is missing, but the decoder does not read that far.
        png.extend(crc32(&png[12..29]).to_be_bytes());
        png.extend(b"\0\0\0\0IDAT\x35\xaf\x06\x1e");
        assert!(claimed_pixels(&png).expect_err("too large").contains("40000 x 40000"));
    }

    /// Returns the CRC-32 of PNG (ISO 3309).
    fn crc32(bytes: &[u8]) -> u32 {
        let step = |crc: u32, &byte: &u8| {
            (0..8).fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { 0xedb8_8320 ^ (c >> 1) } else { c >> 1 })
        };
        !bytes.iter().fold(!0, step)
    }
}
