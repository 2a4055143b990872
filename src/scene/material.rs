//! Materials, and their optical properties at a point.

use glam::{Vec2, Vec3, Vec4};

use super::texture::{Texture, TextureSlot};
use crate::base::ids::GroupId;

/// Largest reflectance in light transport. Brighter materials are clamped, and the loader notes it.
pub const MAX_REFLECTANCE: f32 = 0.99;

/// The properties of a glTF material that affect light.
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
    /// Emission texture (sRGB), a factor of `emission`.
    pub emissive_texture: Option<TextureSlot>,
    /// Light group of the emission; `None` if the material emits nothing.
    pub group: Option<GroupId>,
    /// Effect of alpha.
    pub alpha_mode: AlphaMode,
    /// True if both faces reflect and emit.
    pub double_sided: bool,
    /// True for KHR_materials_unlit: the surface blocks light and reflects none.
    pub unlit: bool,
    /// Share of the light that is transmitted (KHR_materials_transmission); used by ray tracing only.
    pub transmission: f32,
    /// Index of refraction; used by ray tracing only.
    pub ior: f32,
}

/// Effect of alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored.
    Opaque,
    /// Holes where alpha is below the cut-off.
    Mask {
        /// Smallest alpha that is solid.
        cutoff: f32,
    },
    /// The share 1 - alpha of the light passes through.
    Blend,
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

/// Optical properties of a surface at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Diffuse reflectance per channel, at most [`MAX_REFLECTANCE`].
    pub reflectance: Vec3,
    /// Specular reflectance of the metal at normal incidence (base colour x metallic); not used by radiosity.
    pub metal: Vec3,
    /// 0 mirror .. 1 rough.
    pub roughness: f32,
    /// Linear base colour.
    pub base_colour: Vec3,
    /// Emitted radiance, nit per channel.
    pub emission: Vec3,
    /// Share of the light that is blocked: 1 solid, 0 hole; exactly 0 or 1 for alpha mode MASK.
    pub opacity: f32,
}

impl Material {
    /// Returns a matt material of the given linear reflectance.
    #[must_use]
    pub fn diffuse(reflectance: Vec3) -> Self {
        Self { base_colour: reflectance.extend(1.0), metallic: 0.0, ..Self::default() }
    }

    /// Returns true if the material emits light.
    #[must_use]
    pub fn is_emissive(&self) -> bool {
        self.emission.max_element() > 0.0
    }

    /// Returns the optical properties at a point with texture coordinates `uv` and vertex colour `colour`.
    ///
    /// Diffuse reflectance rho = base colour x (1 - metallic), clamped to [`MAX_REFLECTANCE`]; base colour = factor x
    /// texture x vertex colour, linear.
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
