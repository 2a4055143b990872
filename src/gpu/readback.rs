//! Copies textures and buffers to the CPU.

use super::{Gpu, GpuError};

/// Returns the bytes of a whole single-sample texture, rows tightly packed.
///
/// Waits until the queue is empty. It is therefore used for pictures, but not in the loop over hemicubes.
///
/// # Errors
/// Returns an error if the device was lost.
pub fn read_texture(gpu: &Gpu, texture: &wgpu::Texture, bytes_per_pixel: u32) -> Result<Vec<u8>, GpuError> {
    read_aspect(gpu, texture.as_image_copy(), bytes_per_pixel)
}

/// Returns the stencil of a whole single-sample texture, one byte per pixel.
///
/// # Errors
/// Returns an error if the device was lost.
pub fn read_stencil(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Vec<u8>, GpuError> {
    let stencil = wgpu::TexelCopyTextureInfo { aspect: wgpu::TextureAspect::StencilOnly, ..texture.as_image_copy() };
    read_aspect(gpu, stencil, 1)
}

fn read_aspect(gpu: &Gpu, source: wgpu::TexelCopyTextureInfo<'_>, bytes_per_pixel: u32) -> Result<Vec<u8>, GpuError> {
    gpu.check()?;
    let size = source.texture.size();
    let row = size.width * bytes_per_pixel;
    let padded_row = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: u64::from(padded_row) * u64::from(size.height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("readback") });
    encoder.copy_texture_to_buffer(
        source,
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded_row), rows_per_image: None },
        },
        size,
    );
    gpu.queue.submit([encoder.finish()]);
    let padded = mapped_bytes(gpu, &buffer)?;
    Ok(padded.chunks_exact(padded_row as usize).flat_map(|padded| &padded[..row as usize]).copied().collect())
}

/// Returns the bytes of a whole buffer, whose usage must include `COPY_SRC`.
///
/// Waits until the queue is empty. It is therefore used for single numbers, but not in the loop over hemicubes.
///
/// # Errors
/// Returns an error if the device was lost.
pub fn read_buffer(gpu: &Gpu, source: &wgpu::Buffer) -> Result<Vec<u8>, GpuError> {
    gpu.check()?;
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: source.size(),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("readback") });
    encoder.copy_buffer_to_buffer(source, 0, &buffer, 0, source.size());
    gpu.queue.submit([encoder.finish()]);
    mapped_bytes(gpu, &buffer)
}

/// Waits for the queue and maps `buffer`.
fn mapped_bytes(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<Vec<u8>, GpuError> {
    // Reading the range below fails if the buffer could not be mapped.
    buffer.map_async(wgpu::MapMode::Read, .., |_| {});
    gpu.wait()?;
    let view = buffer.get_mapped_range(..).map_err(|error| GpuError::Lost(error.to_string()))?;
    Ok(view.to_vec())
}

/// Returns the value of an IEEE 754 half float: 1 sign bit, 5 bits of exponent, 10 bits of fraction.
#[must_use]
pub fn f32_from_half(bits: u16) -> f32 {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_floats_are_decoded() {
        let known = [(0x0000, 0.0), (0x3c00, 1.0), (0xc000, -2.0), (0x7bff, 65504.0), (0x0001, 5.960_464_5e-8)];
        for (bits, value) in known {
            assert_eq!(f32_from_half(bits), value, "{bits:#x}");
        }
        assert_eq!(f32_from_half(0x3555), 0.333_251_95);
        assert!(f32_from_half(0x7c00).is_infinite() && f32_from_half(0x7e00).is_nan());
    }
}
