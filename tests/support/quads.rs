//! Small scenes of quadrilaterals whose light is set by hand.

use std::sync::Arc;

use glam::{Affine2, Quat, Vec2, Vec3, Vec4};
use hemicube::baked::{BakedScene, GroupLight};
use hemicube::base::ids::{GroupId, InstanceId, MaterialId, TextureId};
use hemicube::scene::{Camera, Image, Material, Projection, Sampler, Texture, TextureSlot, Triangle, Vertex, Wrap};

/// Creates a diffuse material.
pub fn paint(colour: Vec3) -> Material {
    Material::diffuse(colour)
}

/// Creates a texture slot on coordinate set 0 without a transform.
pub fn slot(texture: usize) -> TextureSlot {
    TextureSlot { texture: TextureId::new(texture), uv_set: 0, transform: Affine2::IDENTITY }
}

/// Creates a repeating texture with `width` texels per row. It is not filtered, so each texel is a sharp square.
pub fn texture(width: u32, rgba: &[[u8; 4]]) -> Texture {
    let image = Image {
        name: "test".to_owned(),
        width,
        height: rgba.len() as u32 / width,
        rgba: rgba.concat(),
        encoded: Vec::new(),
        mime_type: "image/png".to_owned(),
    };
    Texture { image: Arc::new(image), sampler: Sampler { wrap_u: Wrap::Repeat, wrap_v: Wrap::Repeat, nearest: true } }
}

/// Creates a camera on +Z that sees exactly the square -1..1 of the plane z = 0.
pub fn square_camera() -> Camera {
    Camera {
        name: "square".to_owned(),
        position: Vec3::Z,
        world_from_view: Quat::IDENTITY,
        projection: Projection::Orthographic { half_height: 1.0 },
    }
}

/// Builds a [`BakedScene`] quad by quad.
#[derive(Default)]
pub struct Quads {
    pub baked: BakedScene,
}

impl Quads {
    /// Starts a scene with `num_groups` dark light groups.
    pub fn with_groups(num_groups: usize) -> Self {
        let mut quads = Self::default();
        quads.baked.scene.light_groups = (0..num_groups).map(|g| format!("group {g}")).collect();
        quads.baked.light.groups = vec![GroupLight::default(); num_groups];
        quads
    }

    /// Starts a scene with the square -1..1 of the plane z = 0, seen from +Z, under the given direct irradiance (one
    /// group).
    pub fn square(material: Material, irradiance: Vec3) -> Self {
        let mut quads = Self::with_groups(1);
        let material = quads.material(material);
        quads.quad(Vec3::new(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y, material);
        quads.light(GroupId(0), |_| irradiance, |_| Vec3::ZERO);
        quads
    }

    pub fn material(&mut self, material: Material) -> MaterialId {
        self.baked.scene.materials.push(material);
        MaterialId::new(self.baked.scene.materials.len() - 1)
    }

    /// Adds a parallelogram with its front towards `u` x `v`. Texture coordinates are those of glTF: (0, 0) at the top
    /// left of the front with `v` up.
    pub fn quad(&mut self, origin: Vec3, u: Vec3, v: Vec3, material: MaterialId) -> &mut Self {
        let scene = &mut self.baked.scene;
        let first = scene.vertices.len() as u32;
        let normal = u.cross(v).normalize();
        for (s, t) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
            let uv = [Vec2::new(s, 1.0 - t); 2];
            scene.vertices.push(Vertex { position: origin + s * u + t * v, normal, uv, colour: Vec4::ONE });
        }
        for corners in [[0, 1, 2], [0, 2, 3]] {
            let vertices = corners.map(|corner| first + corner);
            scene.triangles.push(Triangle { vertices, material, instance: InstanceId(0) });
        }
        self
    }

    /// Sets the light of one group at all vertices, by their position. Call it after the last quad was added.
    pub fn light(&mut self, group: GroupId, direct: impl Fn(Vec3) -> Vec3, indirect: impl Fn(Vec3) -> Vec3) {
        let positions = || self.baked.scene.vertices.iter().map(|vertex| vertex.position);
        self.baked.light.groups[group.index()] =
            GroupLight { direct: positions().map(direct).collect(), indirect: positions().map(indirect).collect() };
    }
}
