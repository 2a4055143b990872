//! Builder of the built-in scenes: materials, textures, shapes, lights and cameras.

use std::collections::HashMap;

use glam::{Vec3, Vec4};

use super::shape::Shape;
use crate::base::ids::{MaterialId, TextureId};
use crate::scene::{
    Camera, Image, Light, LightKind, Material, Sampler, Scene, SceneBuilder, Texture, TextureSlot, Vertex, Wrap,
};

/// A scene under construction.
pub(super) struct Builder {
    scene: SceneBuilder,
    textures: Vec<Texture>,
}

/// Returns a diffuse material of the given linear reflectance.
pub(super) fn paint(name: &str, reflectance: [f32; 3]) -> Material {
    Material { name: name.to_owned(), ..Material::diffuse(reflectance.into()) }
}

impl Builder {
    pub(super) fn new(name: &str) -> Self {
        Self { scene: SceneBuilder::new(name), textures: Vec::new() }
    }

    pub(super) fn finish(self) -> Scene {
        Scene { textures: self.textures, ..self.scene.build() }
    }

    pub(super) fn material(&mut self, material: Material) -> MaterialId {
        self.scene.material(material)
    }

    /// Adds a diffuse material that emits `radiance`, nit per channel, in a light group.
    pub(super) fn glowing(&mut self, paint: Material, radiance: Vec3, group: &str) -> MaterialId {
        let group = Some(self.scene.group(group));
        self.material(Material { emission: radiance, group, ..paint })
    }

    /// Adds a repeating texture.
    pub(super) fn texture(&mut self, image: Image) -> TextureSlot {
        let sampler = Sampler { wrap_u: Wrap::Repeat, wrap_v: Wrap::Repeat, nearest: false };
        self.textures.push(Texture { image: image.into(), sampler });
        let texture = TextureId::new(self.textures.len() - 1);
        TextureSlot { texture, uv_set: 0, transform: glam::Affine2::IDENTITY }
    }

    /// Adds a diffuse material with a texture.
    pub(super) fn textured(&mut self, paint: Material, texture: TextureSlot) -> MaterialId {
        self.material(Material { base_colour_texture: Some(texture), ..paint })
    }

    /// Adds a shape as an instance.
    pub(super) fn place(&mut self, name: &str, material: MaterialId, shape: Shape) {
        let shape = weld(&shape);
        self.scene.mesh(name, material, shape.vertices, shape.triangles);
    }

    /// Adds a light; `intensity` in candela, for a directional one in lux.
    pub(super) fn light(&mut self, name: &str, kind: LightKind, intensity: Vec3, group: &str) {
        let group = self.scene.group(group);
        self.scene.light(Light { name: name.to_owned(), group, ..Light::new(kind, intensity) });
    }

    /// Adds a camera with a full vertical angle of `fov_deg` degrees.
    pub(super) fn camera(&mut self, name: &str, eye: [f32; 3], target: [f32; 3], fov_deg: f32) {
        self.scene.camera(Camera::looking_at(name, eye.into(), target.into(), fov_deg.to_radians()));
    }
}

/// Merges vertices that are equal in position, normal and texture coordinates.
fn weld(shape: &Shape) -> Shape {
    let mut welded = Shape::default();
    let mut known = HashMap::new();
    let number: Vec<u32> = shape
        .vertices
        .iter()
        .map(|vertex| {
            *known.entry(bits(vertex)).or_insert_with(|| {
                welded.vertices.push(*vertex);
                welded.vertices.len() as u32 - 1
            })
        })
        .collect();
    welded.triangles = shape.triangles.iter().map(|corners| corners.map(|v| number[v as usize])).collect();
    welded
}

fn bits(vertex: &Vertex) -> [u32; 8] {
    debug_assert_eq!(vertex.colour, Vec4::ONE, "shapes have no vertex colours");
    let Vertex { position, normal, uv, .. } = vertex;
    // Adding zero makes -0 the same as 0.
    [position.x, position.y, position.z, normal.x, normal.y, normal.z, uv[0].x, uv[0].y].map(|x| (x + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::super::shape::cuboid;
    use super::*;

    #[test]
    fn a_welded_box_keeps_four_vertices_per_side() {
        let halves = cuboid(Vec3::ZERO, Vec3::ONE, &[]).join(cuboid(Vec3::ZERO, Vec3::ONE, &[]));
        assert_eq!(weld(&halves).vertices.len(), 24);
        assert_eq!(weld(&halves).triangles.len(), 24);
    }
}
