//! Collects materials, shapes, lights and cameras into a scene.

use std::collections::HashMap;

use glam::{Vec3, Vec4};

use super::shape::Shape;
use crate::base::ids::{GroupId, InstanceId, MaterialId, TextureId};
use crate::scene::{
    Camera, Image, Instance, Light, LightKind, Material, Sampler, Scene, Texture, TextureSlot, Triangle, Vertex, Wrap,
};

/// A scene in the making.
pub(super) struct Builder {
    scene: Scene,
}

/// A matt surface of the given linear reflectance.
pub(super) fn paint(name: &str, reflectance: [f32; 3]) -> Material {
    let base_colour = Vec3::from(reflectance).extend(1.0);
    Material { name: name.to_owned(), base_colour, metallic: 0.0, ..Material::default() }
}

impl Builder {
    pub(super) fn new(name: &str) -> Self {
        Self { scene: Scene { name: name.to_owned(), ..Scene::default() } }
    }

    pub(super) fn finish(self) -> Scene {
        self.scene
    }

    pub(super) fn material(&mut self, material: Material) -> MaterialId {
        self.scene.materials.push(material);
        MaterialId::new(self.scene.materials.len() - 1)
    }

    /// A matt surface that also emits `radiance`, nit per channel, in a light group.
    pub(super) fn glowing(&mut self, paint: Material, radiance: Vec3, group: &str) -> MaterialId {
        let group = Some(self.group(group));
        self.material(Material { emission: radiance, group, ..paint })
    }

    /// A texture that repeats.
    pub(super) fn texture(&mut self, image: Image) -> TextureSlot {
        let sampler = Sampler { wrap_u: Wrap::Repeat, wrap_v: Wrap::Repeat, nearest: false };
        self.scene.textures.push(Texture { image: image.into(), sampler });
        let texture = TextureId::new(self.scene.textures.len() - 1);
        TextureSlot { texture, uv_set: 0, transform: glam::Affine2::IDENTITY }
    }

    /// A matt surface with a texture.
    pub(super) fn textured(&mut self, paint: Material, texture: TextureSlot) -> MaterialId {
        self.material(Material { base_colour_texture: Some(texture), ..paint })
    }

    /// The light group of this name, a new one if need be.
    pub(super) fn group(&mut self, name: &str) -> GroupId {
        let groups = &mut self.scene.light_groups;
        let index = groups.iter().position(|group| group == name).unwrap_or_else(|| {
            groups.push(name.to_owned());
            groups.len() - 1
        });
        GroupId::new(index)
    }

    /// Makes a shape an object of the scene.
    pub(super) fn place(&mut self, name: &str, material: MaterialId, shape: Shape) {
        let shape = weld(&shape);
        let scene = &mut self.scene;
        let (instance, first) = (InstanceId::new(scene.instances.len()), scene.vertices.len() as u32);
        let begin = scene.triangles.len();
        scene.vertices.extend(shape.vertices);
        let triangle = |corners: [u32; 3]| Triangle {
            vertices: corners.map(|v| first + v),
            material,
            instance,
            is_back_side: false,
        };
        scene.triangles.extend(shape.triangles.into_iter().map(triangle));
        scene.instances.push(Instance { name: name.to_owned(), triangles: begin..scene.triangles.len() });
    }

    /// Adds a light; `intensity` in candela, for a directional one in lux.
    pub(super) fn light(&mut self, name: &str, kind: LightKind, intensity: Vec3, group: &str) {
        let group = self.group(group);
        self.scene.lights.push(Light { name: name.to_owned(), kind, intensity, range: None, profile: None, group });
    }

    /// Adds a camera with a full vertical angle of `fov_deg` degrees.
    pub(super) fn camera(&mut self, name: &str, eye: [f32; 3], target: [f32; 3], fov_deg: f32) {
        self.scene.cameras.push(Camera::looking_at(name, eye.into(), target.into(), fov_deg.to_radians()));
    }
}

/// Makes vertices that agree in everything one.
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
    fn a_welded_box_keeps_four_vertices_a_side() {
        let halves = cuboid(Vec3::ZERO, Vec3::ONE, &[]).join(cuboid(Vec3::ZERO, Vec3::ONE, &[]));
        assert_eq!(weld(&halves).vertices.len(), 24);
        assert_eq!(weld(&halves).triangles.len(), 24);
    }
}
