//! Textures as materials name them, and how they are sampled on the CPU.

use glam::{Affine2, Vec2, Vec4};

use crate::base::colour::srgb_byte_table;
use crate::base::ids::TextureId;

/// A texture as a material uses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureSlot {
    /// Which texture.
    pub texture: TextureId,
    /// Which texture coordinate set, 0 or 1.
    pub uv_set: usize,
    /// KHR_texture_transform, from mesh coordinates to texture coordinates.
    pub transform: Affine2,
}

impl TextureSlot {
    /// Texture coordinate of a vertex' coordinate sets.
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
    /// How coordinates outside 0..1 and between pixels are read.
    pub sampler: Sampler,
}

/// Decoded pixels, and the bytes they came from so that a bake can pass them on unchanged.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Name in the file.
    pub name: String,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// RGBA bytes as stored (sRGB for colours), row by row from the top.
    pub rgba: Vec<u8>,
    /// The encoded file; empty where it could not be read and a grey pixel stands in.
    pub encoded: Vec<u8>,
    /// `image/png`, `image/jpeg`, `image/webp` or `image/ktx2`.
    pub mime_type: String,
}

/// glTF sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Sampler {
    /// Across.
    pub wrap_u: Wrap,
    /// Down.
    pub wrap_v: Wrap,
    /// Nearest instead of linear magnification.
    pub nearest: bool,
}

/// What happens outside 0..1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// Tiles.
    Repeat,
    /// Tiles, every other one mirrored.
    Mirror,
    /// Edge pixels go on.
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
    /// Bilinear sample with linear colour (sRGB decoded) and alpha; glTF's origin is the top left corner.
    #[must_use]
    pub fn sample_srgb(&self, uv: Vec2) -> Vec4 {
        static LINEAR: std::sync::LazyLock<[f32; 256]> = std::sync::LazyLock::new(srgb_byte_table);
        self.sample(uv, |[r, g, b, a]| {
            Vec4::new(LINEAR[r as usize], LINEAR[g as usize], LINEAR[b as usize], f32::from(a) / 255.0)
        })
    }

    /// Bilinear sample of linear data.
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
