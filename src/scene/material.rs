//! Materials as transport and display see them, and the textures they name.

use glam::{Affine2, Vec2, Vec3, Vec4};

use crate::base::colour::srgb_byte_table;
use crate::base::ids::{GroupId, TextureId};

/// Largest reflectance that transport uses; brighter surfaces are clamped (and the user is told).
pub const MAX_REFLECTANCE: f32 = 0.99;

/// A glTF material, reduced to what light needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the file.
    pub name: String,
    /// Linear base colour factor with alpha.
    pub base_colour: Vec4,
    /// Base colour texture (sRGB).
    pub base_colour_texture: Option<TextureSlot>,
    /// 0 dielectric .. 1 metal: the diffuse reflectance is base colour x (1 - metallic).
    pub metallic: f32,
    /// 0 mirror .. 1 rough.
    pub roughness: f32,
    /// Metallic (blue) and roughness (green) texture (linear).
    pub metallic_roughness_texture: Option<TextureSlot>,
    /// Tangent-space normal map (linear) and its scale.
    pub normal_texture: Option<(TextureSlot, f32)>,
    /// Emitted radiance: factor x strength, nit per channel.
    pub emission: Vec3,
    /// Emission texture (sRGB), multiplied in.
    pub emissive_texture: Option<TextureSlot>,
    /// Light group of the emission; meaningless where nothing is emitted.
    pub group: Option<GroupId>,
    /// How alpha acts.
    pub alpha_mode: AlphaMode,
    /// Both faces reflect and emit.
    pub double_sided: bool,
    /// KHR_materials_unlit: blocks light, reflects none.
    pub unlit: bool,
    /// Share of light that passes (KHR_materials_transmission); second pass only.
    pub transmission: f32,
    /// Index of refraction; second pass only.
    pub ior: f32,
}

/// How alpha acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored.
    Opaque,
    /// Holes where alpha is below the cut-off.
    Mask {
        /// Smallest alpha that is solid.
        cutoff: f32,
    },
    /// Passes 1 - alpha of the light.
    Blend,
}

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

impl Default for Material {
    /// glTF's default material: a white metal, which reflects nothing diffusely.
    fn default() -> Self {
        Self {
            name: String::new(),
            base_colour: Vec4::ONE,
            base_colour_texture: None,
            metallic: 1.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            normal_texture: None,
            emission: Vec3::ZERO,
            emissive_texture: None,
            group: None,
            alpha_mode: AlphaMode::Opaque,
            double_sided: false,
            unlit: false,
            transmission: 0.0,
            ior: 1.5,
        }
    }
}

/// What the surface is at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Diffuse reflectance per channel, at most [`MAX_REFLECTANCE`].
    pub reflectance: Vec3,
    /// Reflectance of the metal's sheen where it is met head-on (base colour x metallic); no part of radiosity.
    pub metal: Vec3,
    /// 0 mirror .. 1 rough.
    pub roughness: f32,
    /// Linear base colour.
    pub base_colour: Vec3,
    /// Emitted radiance, nit per channel.
    pub emission: Vec3,
    /// Share of light that is stopped: 1 solid, 0 hole; MASK is already decided.
    pub opacity: f32,
}

impl Material {
    /// Something is emitted.
    #[must_use]
    pub fn is_emissive(&self) -> bool {
        self.emission.max_element() > 0.0
    }

    /// Base colour, emission and opacity at a point with texture coordinates `uv` and vertex colour `colour`.
    #[must_use]
    pub fn at(&self, textures: &[Texture], uv: [Vec2; 2], colour: Vec4) -> SurfacePoint {
        let fetch = |slot: &TextureSlot| textures[slot.texture.index()].sample_srgb(slot.coordinate(uv));
        let base = self.base_colour_texture.as_ref().map_or(Vec4::ONE, fetch) * self.base_colour * colour;
        let finish = self
            .metallic_roughness_texture
            .as_ref()
            .map_or(Vec4::ONE, |slot| textures[slot.texture.index()].sample_linear(slot.coordinate(uv)));
        let (metallic, roughness) = (self.metallic * finish.z, self.roughness * finish.y);
        let base_colour = base.truncate();
        let reflecting = |share: f32| {
            let share = if self.unlit { 0.0 } else { share };
            (base_colour * share).clamp(Vec3::ZERO, Vec3::splat(MAX_REFLECTANCE))
        };
        let emission = self.emission * self.emissive_texture.as_ref().map_or(Vec3::ONE, |slot| fetch(slot).truncate());
        SurfacePoint {
            reflectance: reflecting(1.0 - metallic),
            metal: reflecting(metallic),
            roughness,
            base_colour,
            emission,
            opacity: self.opacity(base.w),
        }
    }

    fn opacity(&self, alpha: f32) -> f32 {
        match self.alpha_mode {
            AlphaMode::Opaque => 1.0,
            AlphaMode::Mask { cutoff } => f32::from(alpha >= cutoff),
            AlphaMode::Blend => alpha.clamp(0.0, 1.0),
        }
    }
}
