//! Textures of materials, and bilinear sampling on the CPU.

use glam::{Affine2, Vec2, Vec4};

use crate::base::colour::srgb_byte_table;
use crate::base::ids::TextureId;

/// Reference of a material to a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureSlot {
    /// The texture.
    pub texture: TextureId,
    /// Texture coordinate set, 0 or 1.
    pub uv_set: usize,
    /// KHR_texture_transform: transform from the vertices' coordinates to those of the texture.
    pub transform: Affine2,
}

impl TextureSlot {
    /// Returns the transformed texture coordinate, given both coordinate sets of a vertex.
    #[must_use]
    pub fn coordinate(&self, uv: [Vec2; 2]) -> Vec2 {
        self.transform.transform_point2(uv[self.uv_set])
    }
}

/// An image with its sampler.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Pixels.
    pub image: std::sync::Arc<Image>,
    /// Wrapping of coordinates outside 0..1, and interpolation between pixels.
    pub sampler: Sampler,
}

/// Decoded pixels with the encoded bytes, which a bake copies unchanged.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Name in the file.
    pub name: String,
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// RGBA bytes as stored (sRGB for colours), row by row from the top.
    pub rgba: Vec<u8>,
    /// The encoded file; empty if it cannot be read and a grey pixel replaces it.
    pub encoded: Vec<u8>,
    /// `image/png`, `image/jpeg`, `image/webp` or `image/ktx2`.
    pub mime_type: String,
}

/// glTF sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Sampler {
    /// Wrapping along u.
    pub wrap_u: Wrap,
    /// Wrapping along v.
    pub wrap_v: Wrap,
    /// True for nearest instead of linear magnification.
    pub nearest: bool,
}

/// Wrapping of texture coordinates outside 0..1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The image repeats.
    Repeat,
    /// The image repeats, every other copy mirrored.
    Mirror,
    /// The pixels at the edge continue.
    Clamp,
}

impl Wrap {
    fn apply(self, index: i64, size: i64) -> usize {
        let wrapped = match self {
            Wrap::Repeat => index.rem_euclid(size),
            Wrap::Mirror => {
                let period = index.rem_euclid(2 * size);
                period.min(2 * size - 1 - period)
            }
            Wrap::Clamp => index.clamp(0, size - 1),
        };
        wrapped as usize
    }
}

impl Texture {
    /// Samples an sRGB colour texture bilinearly; returns linear colour and alpha. The origin is the top left corner,
    /// as in glTF.
    #[must_use]
    pub fn sample_srgb(&self, uv: Vec2) -> Vec4 {
        static LINEAR: std::sync::LazyLock<[f32; 256]> = std::sync::LazyLock::new(srgb_byte_table);
        self.sample(uv, |[r, g, b, a]| {
            Vec4::new(LINEAR[r as usize], LINEAR[g as usize], LINEAR[b as usize], f32::from(a) / 255.0)
        })
    }

    /// Samples a texture with linear data bilinearly.
    #[must_use]
    pub fn sample_linear(&self, uv: Vec2) -> Vec4 {
        self.sample(uv, |rgba| Vec4::from(rgba.map(f32::from)) / 255.0)
    }

    fn sample(&self, uv: Vec2, decode: impl Fn([u8; 4]) -> Vec4) -> Vec4 {
        let size = Vec2::new(self.image.width as f32, self.image.height as f32);
        let texel = |x: i64, y: i64| {
            let column = self.sampler.wrap_u.apply(x, i64::from(self.image.width));
            let row = self.sampler.wrap_v.apply(y, i64::from(self.image.height));
            let at = 4 * (row * self.image.width as usize + column);
            decode([self.image.rgba[at], self.image.rgba[at + 1], self.image.rgba[at + 2], self.image.rgba[at + 3]])
        };
        if self.sampler.nearest {
            let at = (uv * size).floor();
            return texel(at.x as i64, at.y as i64);
        }
        let at = uv * size - 0.5;
        let low = at.floor();
        let share = at - low;
        let (x, y) = (low.x as i64, low.y as i64);
        let top = texel(x, y).lerp(texel(x + 1, y), share.x);
        let bottom = texel(x, y + 1).lerp(texel(x + 1, y + 1), share.x);
        top.lerp(bottom, share.y)
    }
}
