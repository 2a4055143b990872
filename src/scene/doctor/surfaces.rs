//! What materials and textures say: reflectance, missing images.

use glam::Vec3;

use super::{Finding, Kind, Place};
use crate::base::ids::TriangleId;
use crate::scene::{Material, Scene, Texture};

/// Mean reflectance above which a material is doubted: fresh snow reflects 0.9, white paint 0.85.
const DOUBTFUL_REFLECTANCE: f32 = 0.9;

/// Most pixels of a texture that its mean is taken over.
const MEAN_PIXELS: usize = 1 << 16;

/// Materials in use with a mean reflectance above 0.9, with the triangles that wear them.
pub(super) fn bright_materials(scene: &Scene) -> Finding {
    let reflectances = mean_reflectances(scene);
    let is_bright = |t: &usize| reflectances[scene.triangles[*t].material.index()] > DOUBTFUL_REFLECTANCE;
    let bright: Vec<usize> = (0..scene.triangles.len()).filter(is_bright).collect();
    let mut materials: Vec<_> = bright.iter().map(|&t| scene.triangles[t].material.index()).collect();
    materials.sort_unstable();
    materials.dedup();
    let names: Vec<_> = materials.iter().map(|&m| scene.materials[m].name.as_str()).collect();
    let mut finding = Finding::new(Kind::BrightMaterial);
    finding.detail = names.join(", ");
    finding.count = materials.len();
    finding.show(bright.into_iter().map(|t| Place::triangle(scene.corners(TriangleId::new(t)))));
    finding
}

/// Textures whose image could not be read.
pub(super) fn missing_textures(scene: &Scene) -> Finding {
    let is_missing = |texture: &&Texture| texture.image.encoded.is_empty();
    Finding { count: scene.textures.iter().filter(is_missing).count(), ..Finding::new(Kind::MissingTexture) }
}

/// Mean reflectance of each material, brightest channel: factors times texture means, vertex colours left out.
#[must_use]
pub fn mean_reflectances(scene: &Scene) -> Vec<f32> {
    let colour_means: Vec<_> = scene.textures.iter().map(|texture| mean(texture, Texture::sample_srgb)).collect();
    let data_means: Vec<_> = scene.textures.iter().map(|texture| mean(texture, Texture::sample_linear)).collect();
    let reflectance = |material: &Material| {
        let colour = material.base_colour_texture.map_or(Vec3::ONE, |slot| colour_means[slot.texture.index()]);
        let metallic = material.metallic_roughness_texture.map_or(1.0, |slot| data_means[slot.texture.index()].z);
        let reflected = material.base_colour.truncate() * colour * (1.0 - material.metallic * metallic);
        if material.unlit { 0.0 } else { reflected.max_element() }
    };
    scene.materials.iter().map(reflectance).collect()
}

/// Mean of a texture over a regular grid of its pixels.
fn mean(texture: &Texture, sample: impl Fn(&Texture, glam::Vec2) -> glam::Vec4) -> Vec3 {
    let (width, height) = (texture.image.width as usize, texture.image.height as usize);
    let step = (1..).find(|step| (width / step).max(1) * (height / step).max(1) <= MEAN_PIXELS).unwrap_or(1);
    let (columns, rows) = ((width / step).max(1), (height / step).max(1));
    let centre = |i: usize, n: usize| (i as f32 + 0.5) / n as f32;
    let sum: glam::Vec4 = (0..rows * columns)
        .map(|i| sample(texture, glam::Vec2::new(centre(i % columns, columns), centre(i / columns, rows))))
        .sum();
    sum.truncate() / (rows * columns) as f32
}
