//! Scenes built in code, without a file.

use glam::{Quat, Vec3};

use super::camera::Camera;
use super::light::Light;
use super::material::Material;
use super::model::{Instance, Scene};
use super::triangle::{Triangle, Vertex, normal_of};
use crate::base::ids::{GroupId, InstanceId, MaterialId};

/// Builds a [`Scene`] object by object.
///
/// Corners are counter-clockwise as seen from the front, positions in metres with +Y up.
///
/// ```
/// use glam::Vec3;
/// use hemicube::scene::{Light, Material, SceneBuilder};
///
/// let mut builder = SceneBuilder::new("room");
/// let white = builder.material(Material::diffuse(Vec3::splat(0.7)));
/// builder.room(Vec3::ZERO, Vec3::new(4.0, 3.0, 5.0), [white; 6]);
/// let lamps = builder.group("lamps");
/// builder.light(Light { group: lamps, ..Light::point(Vec3::new(2.0, 2.5, 2.5), Vec3::splat(100.0)) });
/// let scene = builder.build();
/// assert_eq!(scene.triangles.len(), 12);
/// assert!((scene.area() - 94.0).abs() < 1e-3);
/// ```
#[derive(Clone, Debug, Default)]
pub struct SceneBuilder {
    scene: Scene,
}

impl SceneBuilder {
    /// Returns an empty scene of this name.
    #[must_use]
    pub fn new(name: &str) -> Self {
        Self { scene: Scene { name: name.to_owned(), ..Scene::default() } }
    }

    /// Adds a material.
    pub fn material(&mut self, material: Material) -> MaterialId {
        self.scene.materials.push(material);
        MaterialId::new(self.scene.materials.len() - 1)
    }

    /// Returns the light group of this name. Adds it if the scene has none of this name.
    pub fn group(&mut self, name: &str) -> GroupId {
        let groups = &mut self.scene.light_groups;
        let index = groups.iter().position(|group| group == name).unwrap_or_else(|| {
            groups.push(name.to_owned());
            groups.len() - 1
        });
        GroupId::new(index)
    }

    /// Adds a light, whose group must come from [`Self::group`].
    pub fn light(&mut self, light: Light) -> &mut Self {
        self.scene.lights.push(light);
        self
    }

    /// Adds a camera.
    pub fn camera(&mut self, camera: Camera) -> &mut Self {
        self.scene.cameras.push(camera);
        self
    }

    /// Adds an instance of these vertices; `triangles` are indices into them.
    pub fn mesh(
        &mut self,
        name: &str,
        material: MaterialId,
        vertices: impl IntoIterator<Item = Vertex>,
        triangles: impl IntoIterator<Item = [u32; 3]>,
    ) -> &mut Self {
        let scene = &mut self.scene;
        let (instance, first) = (InstanceId::new(scene.instances.len()), scene.vertices.len() as u32);
        let start = scene.triangles.len();
        scene.vertices.extend(vertices);
        let triangle = |corners: [u32; 3]| Triangle { vertices: corners.map(|v| first + v), material, instance };
        scene.triangles.extend(triangles.into_iter().map(triangle));
        scene.instances.push(Instance { name: name.to_owned(), triangles: start..scene.triangles.len() });
        self
    }

    /// Adds a triangle as an instance.
    pub fn triangle(&mut self, corners: [Vec3; 3], material: MaterialId) -> &mut Self {
        let normal = normal_of(corners);
        self.mesh("triangle", material, corners.map(|position| Vertex::new(position, normal)), [[0, 1, 2]])
    }

    /// Adds a flat quadrilateral as an instance.
    pub fn quad(&mut self, corners: [Vec3; 4], material: MaterialId) -> &mut Self {
        let normal = normal_of([corners[0], corners[1], corners[2]]);
        let vertices = corners.map(|position| Vertex::new(position, normal));
        self.mesh("quad", material, vertices, [[0, 1, 2], [0, 2, 3]])
    }

    /// Adds the six walls of a room, which face inwards: floor, ceiling, -X, +X, -Z, +Z.
    pub fn room(&mut self, low: Vec3, high: Vec3, materials: [MaterialId; 6]) -> &mut Self {
        let p = |x: f32, y: f32, z: f32| low + (high - low) * Vec3::new(x, y, z);
        let walls = [
            [p(0., 0., 0.), p(0., 0., 1.), p(1., 0., 1.), p(1., 0., 0.)],
            [p(0., 1., 0.), p(1., 1., 0.), p(1., 1., 1.), p(0., 1., 1.)],
            [p(0., 0., 0.), p(0., 1., 0.), p(0., 1., 1.), p(0., 0., 1.)],
            [p(1., 0., 0.), p(1., 0., 1.), p(1., 1., 1.), p(1., 1., 0.)],
            [p(0., 0., 0.), p(1., 0., 0.), p(1., 1., 0.), p(0., 1., 0.)],
            [p(0., 0., 1.), p(0., 1., 1.), p(1., 1., 1.), p(1., 0., 1.)],
        ];
        for (wall, material) in walls.into_iter().zip(materials) {
            self.quad(wall, material);
        }
        self
    }

    /// Adds a box whose edges are twice as long as `half`, rotated by `rotation` about its centre. Sides face outwards.
    pub fn block(&mut self, centre: Vec3, half: Vec3, rotation: Quat, material: MaterialId) -> &mut Self {
        let p = |x: f32, y: f32, z: f32| centre + rotation * (half * Vec3::new(x, y, z));
        let sides = [
            [p(-1., -1., -1.), p(1., -1., -1.), p(1., -1., 1.), p(-1., -1., 1.)],
            [p(-1., 1., -1.), p(-1., 1., 1.), p(1., 1., 1.), p(1., 1., -1.)],
            [p(-1., -1., -1.), p(-1., -1., 1.), p(-1., 1., 1.), p(-1., 1., -1.)],
            [p(1., -1., -1.), p(1., 1., -1.), p(1., 1., 1.), p(1., -1., 1.)],
            [p(-1., -1., -1.), p(-1., 1., -1.), p(1., 1., -1.), p(1., -1., -1.)],
            [p(-1., -1., 1.), p(1., -1., 1.), p(1., 1., 1.), p(-1., 1., 1.)],
        ];
        sides.into_iter().for_each(|side| {
            self.quad(side, material);
        });
        self
    }

    /// Returns the finished scene.
    #[must_use]
    pub fn build(self) -> Scene {
        self.scene
    }
}
