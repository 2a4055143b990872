//! Mean reflectance of materials: factors times the means of their textures.

use glam::Vec3;

use super::material::Material;
use super::model::Scene;
use super::texture::Texture;

/// Largest number of samples for the mean of a texture.
const MEAN_PIXELS: usize = 1 << 16;

/// Returns the mean reflectance of each material in its brightest channel `[m]`: factors times the means of textures,
/// without vertex colours.
pub(crate) fn mean_reflectances(scene: &Scene) -> Vec<f32> {
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

/// Returns the mean of a texture over a regular grid of samples.
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
