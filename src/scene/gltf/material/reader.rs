//! Reads the properties of glTF materials that affect light.

use glam::{Affine2, Mat2, Vec2, Vec3, Vec4};
use gltf::json;
use gltf::json::extensions::texture::TextureTransform;
use gltf::json::validation::Checked;
use serde::Deserialize;

use super::original;
use crate::scene::gltf::error::Cause;
use crate::scene::gltf::file::document::Document;
use crate::scene::gltf::texture::table::TextureTable;
use crate::scene::{AlphaMode, Material, Texture, TextureSlot};

/// Highest plausible emitted radiance, nit: far above the disc of the sun, 1.6e9 nit.
const MAX_RADIANCE: f32 = 1e12;

/// KHR_materials_pbrSpecularGlossiness without its specular part.
#[derive(Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct SpecularGlossiness {
    diffuse_factor: [f32; 4],
    diffuse_texture: Option<json::texture::Info>,
    glossiness_factor: f32,
}

impl Default for SpecularGlossiness {
    fn default() -> Self {
        Self { diffuse_factor: [1.0; 4], diffuse_texture: None, glossiness_factor: 1.0 }
    }
}

/// Reads materials and collects the textures that they use.
pub(crate) struct MaterialReader<'a> {
    /// The file.
    pub document: &'a Document<'a>,
    /// Textures used so far.
    pub textures: TextureTable,
    /// Messages to the user.
    pub notes: Vec<String>,
    /// Texture coordinate sets of the file that are stored in the two sets of a vertex, by material `[m]`.
    pub uv_sets: Vec<[u32; 2]>,
    /// Texture coordinate sets of the material that is being read.
    vertex_sets: [Option<u32>; 2],
}

/// Reference of a material of the file to a texture.
struct Reference<'a> {
    index: json::Index<json::Texture>,
    uv_set: u32,
    transform: Option<&'a TextureTransform>,
}

impl<'a> Reference<'a> {
    fn new(info: &'a json::texture::Info) -> Self {
        let transform = info.extensions.as_ref().and_then(|extensions| extensions.texture_transform.as_ref());
        Self { index: info.index, uv_set: info.tex_coord, transform }
    }
}

impl<'a> MaterialReader<'a> {
    /// Returns a reader without textures.
    pub fn new(document: &'a Document<'a>) -> Self {
        Self {
            document,
            textures: TextureTable::default(),
            notes: Vec::new(),
            uv_sets: Vec::new(),
            vertex_sets: [None; 2],
        }
    }

    /// Reads all materials of the file in its order.
    ///
    /// # Errors
    /// Returns an error if a texture does not exist or a factor is not plausible.
    pub fn read_all(&mut self) -> Result<Vec<Material>, Cause> {
        let document = self.document;
        document.root.materials.iter().enumerate().map(|(i, material)| self.read(i, material)).collect()
    }

    fn read(&mut self, index: usize, source: &json::Material) -> Result<Material, Cause> {
        let name = source.name.clone().unwrap_or_else(|| format!("material {index}"));
        self.vertex_sets = [None; 2];
        let extensions = source.extensions.as_ref();
        let pbr = &source.pbr_metallic_roughness;
        let strength = extensions.and_then(|e| e.emissive_strength.as_ref()).map_or(1.0, |e| e.emissive_strength.0);
        let mut material = Material {
            base_colour: Vec4::from(pbr.base_color_factor.0),
            base_colour_texture: self.slot(&name, pbr.base_color_texture.as_ref().map(Reference::new))?,
            metallic: pbr.metallic_factor.0,
            roughness: pbr.roughness_factor.0,
            metallic_roughness_texture: self
                .slot(&name, pbr.metallic_roughness_texture.as_ref().map(Reference::new))?,
            normal_texture: self.normal_texture(&name, source.normal_texture.as_ref())?,
            emission: Vec3::from(source.emissive_factor.0) * strength,
            emissive_texture: self.slot(&name, source.emissive_texture.as_ref().map(Reference::new))?,
            group: None,
            alpha_mode: alpha_mode(source),
            double_sided: source.double_sided,
            unlit: extensions.is_some_and(|e| e.unlit.is_some()),
            transmission: extensions.and_then(|e| e.transmission.as_ref()).map_or(0.0, |t| t.transmission_factor.0),
            ior: extensions.and_then(|e| e.ior.as_ref()).map_or(1.5, |ior| ior.ior.0),
            name,
        };
        if let Some(original) = original::of(source) {
            material.base_colour = Vec4::from(original.base_colour);
            material.double_sided = original.double_sided;
            material.unlit = original.unlit;
            if original.shows_emission {
                let name = material.name.clone();
                material.base_colour_texture =
                    self.slot(&name, original.base_colour_texture.as_ref().map(Reference::new))?;
            }
        }
        if let Some(value) = extensions.and_then(|e| e.others.get("KHR_materials_pbrSpecularGlossiness")) {
            self.take_diffuse(&mut material, value)?;
        }
        clamp(&mut material)?;
        self.uv_sets.push([self.vertex_sets[0].unwrap_or(0), self.vertex_sets[1].unwrap_or(1)]);
        Ok(material)
    }

    /// Replaces the metallic-roughness values by the diffuse part of a specular-glossiness material, for which they
    /// are only a fallback.
    fn take_diffuse(&mut self, material: &mut Material, extension: &serde_json::Value) -> Result<(), Cause> {
        let name = material.name.clone();
        let source = SpecularGlossiness::deserialize(extension).map_err(|error| {
            Cause::NotGltf(format!("material {name:?}: KHR_materials_pbrSpecularGlossiness: {error}"))
        })?;
        material.base_colour = Vec4::from(source.diffuse_factor);
        material.base_colour_texture = self.slot(&name, source.diffuse_texture.as_ref().map(Reference::new))?;
        material.metallic = 0.0;
        material.roughness = 1.0 - source.glossiness_factor;
        material.metallic_roughness_texture = None;
        Ok(())
    }

    /// Returns the normal texture with its scale. Its texture transform is read from JSON, because the gltf crate
    /// has no field for it.
    fn normal_texture(
        &mut self,
        name: &str,
        source: Option<&json::material::NormalTexture>,
    ) -> Result<Option<(TextureSlot, f32)>, Cause> {
        let Some(source) = source else { return Ok(None) };
        let transform = source.extensions.as_ref().and_then(|e| e.others.get("KHR_texture_transform"));
        let transform = transform.and_then(|value| TextureTransform::deserialize(value).ok());
        let reference = Reference { index: source.index, uv_set: source.tex_coord, transform: transform.as_ref() };
        Ok(self.slot(name, Some(reference))?.map(|slot| (slot, source.scale)))
    }

    fn slot(&mut self, material: &str, reference: Option<Reference<'_>>) -> Result<Option<TextureSlot>, Cause> {
        let Some(reference) = reference else { return Ok(None) };
        let texture = self.textures.id(self.document, reference.index, || format!("material {material:?}"))?;
        let uv_set = reference.transform.and_then(|transform| transform.tex_coord).unwrap_or(reference.uv_set);
        let Some(vertex_set) = self.vertex_set_of(uv_set) else {
            self.notes.push(format!(
                "material {material:?}: a texture is ignored because it uses a third coordinate set, TEXCOORD_{uv_set}"
            ));
            return Ok(None);
        };
        let transform = reference.transform.map_or(Affine2::IDENTITY, affine_of);
        if !transform.is_finite() {
            return Err(Cause::NotFinite(format!("a texture transform of material {material:?}")));
        }
        Ok(Some(TextureSlot { texture, uv_set: vertex_set, transform }))
    }

    /// Returns which coordinate set of the vertices, 0 or 1, holds the file's set `uv_set`. Sets 0 and 1 of the file
    /// keep their index if it is free. Returns `None` if both sets of the vertices hold other sets.
    fn vertex_set_of(&mut self, uv_set: u32) -> Option<usize> {
        let preferred = usize::from(uv_set > 0);
        let is_free = |set: &usize| self.vertex_sets[*set].is_none_or(|taken| taken == uv_set);
        let set = [preferred, 1 - preferred].into_iter().find(is_free)?;
        self.vertex_sets[set] = Some(uv_set);
        Some(set)
    }
}

/// Returns translation x rotation x scale. A positive angle is counter-clockwise as seen, with v pointing down.
///
/// Source: KHR_texture_transform.
fn affine_of(transform: &TextureTransform) -> Affine2 {
    let (sin, cos) = transform.rotation.0.sin_cos();
    let scale = Vec2::from(transform.scale.0);
    let turned = Mat2::from_cols(Vec2::new(cos, -sin) * scale.x, Vec2::new(sin, cos) * scale.y);
    Affine2::from_mat2_translation(turned, Vec2::from(transform.offset.0))
}

fn alpha_mode(source: &json::Material) -> AlphaMode {
    match source.alpha_mode {
        Checked::Valid(json::material::AlphaMode::Mask) => {
            AlphaMode::Mask { cutoff: source.alpha_cutoff.unwrap_or_default().0 }
        }
        Checked::Valid(json::material::AlphaMode::Blend) => AlphaMode::Blend,
        Checked::Valid(json::material::AlphaMode::Opaque) | Checked::Invalid => AlphaMode::Opaque,
    }
}

/// Clamps factors to the ranges of the standard.
///
/// # Errors
/// Returns an error if a factor is not finite or the emission is not plausible.
fn clamp(material: &mut Material) -> Result<(), Cause> {
    let factors = [material.metallic, material.roughness, material.transmission, material.ior];
    let is_finite = material.base_colour.is_finite()
        && material.emission.max_element() <= MAX_RADIANCE
        && material.emission.is_finite()
        && factors.iter().all(|factor| factor.is_finite());
    if !is_finite {
        return Err(Cause::NotFinite(format!("a factor of material {:?}", material.name)));
    }
    material.base_colour = material.base_colour.clamp(Vec4::ZERO, Vec4::ONE);
    material.metallic = material.metallic.clamp(0.0, 1.0);
    material.roughness = material.roughness.clamp(0.0, 1.0);
    material.transmission = material.transmission.clamp(0.0, 1.0);
    material.emission = material.emission.max(Vec3::ZERO);
    Ok(())
}

/// Removes normal and metallic-roughness textures whose image cannot be read. The grey substitute would be read as
/// data.
pub(crate) fn drop_missing_data_textures(materials: &mut [Material], textures: &[Texture]) {
    let is_there = |slot: &TextureSlot| !textures[slot.texture.index()].image.encoded.is_empty();
    for material in materials {
        material.normal_texture = material.normal_texture.filter(|(slot, _)| is_there(slot));
        material.metallic_roughness_texture = material.metallic_roughness_texture.filter(is_there);
    }
}

#[cfg(test)]
mod tests;
