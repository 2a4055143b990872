//! Small scenes with known answers.

use glam::{Quat, Vec2, Vec3, Vec4};
use hemicube::base::ids::{GroupId, InstanceId, MaterialId};
use hemicube::base::sampling::{hash, unit_float};
use hemicube::scene::{Instance, Light, LightKind, Material, Scene, Triangle, Vertex};

/// A scene that grows by quadrilaterals.
#[derive(Default)]
pub struct SceneBuilder {
    scene: Scene,
}

impl SceneBuilder {
    /// A diffuse material that reflects `reflectance` and emits the exitance `exitance` in light group 0.
    pub fn material(&mut self, reflectance: Vec3, exitance: Vec3) -> MaterialId {
        let is_emissive = exitance.max_element() > 0.0;
        self.scene.materials.push(Material {
            base_colour: reflectance.extend(1.0),
            metallic: 0.0,
            emission: exitance / std::f32::consts::PI,
            group: is_emissive.then_some(GroupId(0)),
            ..Material::default()
        });
        MaterialId::new(self.scene.materials.len() - 1)
    }

    /// A quadrilateral, counter-clockwise from the front, as an instance of its own.
    pub fn quad(&mut self, corners: [Vec3; 4], material: MaterialId) {
        let normal = hemicube::scene::normal_of([corners[0], corners[1], corners[2]]);
        let first = self.scene.vertices.len() as u32;
        self.scene.vertices.extend(corners.map(|position| Vertex {
            position,
            normal,
            uv: [Vec2::ZERO; 2],
            colour: Vec4::ONE,
        }));
        let start = self.scene.triangles.len();
        for vertices in [[0, 1, 2], [0, 2, 3]] {
            self.scene.triangles.push(Triangle {
                vertices: vertices.map(|v| first + v),
                material,
                instance: InstanceId::new(self.scene.instances.len()),
                is_back_side: false,
            });
        }
        self.scene.instances.push(Instance { name: "quad".into(), triangles: start..start + 2 });
    }

    /// The six walls of a room, facing inwards: floor, ceiling, -X, +X, -Z, +Z.
    pub fn room(&mut self, low: Vec3, high: Vec3, materials: [MaterialId; 6]) {
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
    }

    /// A box turned by `turn` about its centre, seen from outside.
    pub fn block(&mut self, centre: Vec3, half: Vec3, turn: Quat, material: MaterialId) {
        let p = |x: f32, y: f32, z: f32| centre + turn * (half * Vec3::new(x, y, z));
        let sides = [
            [p(-1., -1., -1.), p(1., -1., -1.), p(1., -1., 1.), p(-1., -1., 1.)],
            [p(-1., 1., -1.), p(-1., 1., 1.), p(1., 1., 1.), p(1., 1., -1.)],
            [p(-1., -1., -1.), p(-1., -1., 1.), p(-1., 1., 1.), p(-1., 1., -1.)],
            [p(1., -1., -1.), p(1., 1., -1.), p(1., 1., 1.), p(1., -1., 1.)],
            [p(-1., -1., -1.), p(-1., 1., -1.), p(1., 1., -1.), p(1., -1., -1.)],
            [p(-1., -1., 1.), p(1., -1., 1.), p(1., 1., 1.), p(-1., 1., 1.)],
        ];
        sides.into_iter().for_each(|side| self.quad(side, material));
    }

    /// A point light of group `group`.
    pub fn point_light(&mut self, position: Vec3, intensity: Vec3, group: u32) {
        let kind = LightKind::Point { position };
        self.scene.lights.push(Light {
            name: String::new(),
            kind,
            intensity,
            range: None,
            profile: None,
            group: GroupId(group),
        });
    }

    /// The scene, with `num_groups` light groups.
    pub fn build(mut self, num_groups: usize) -> Scene {
        self.scene.light_groups = (0..num_groups).map(|g| format!("group {g}")).collect();
        self.scene
    }
}

/// A closed unit cube in which every wall reflects `reflectance` and emits `exitance`: B = E / (1 - rho) everywhere.
pub fn furnace(reflectance: Vec3, exitance: Vec3) -> Scene {
    let mut builder = SceneBuilder::default();
    let wall = builder.material(reflectance, exitance);
    builder.room(Vec3::ZERO, Vec3::ONE, [wall; 6]);
    builder.build(1)
}

/// A closed room of seven blocks that stand, lean and overlap by chance, lit by its ceiling.
pub fn cluttered_room(seed: u32) -> Scene {
    let mut builder = SceneBuilder::default();
    let grey = builder.material(Vec3::splat(0.5), Vec3::ZERO);
    let lamp = builder.material(Vec3::splat(0.5), Vec3::ONE);
    builder.room(Vec3::ZERO, Vec3::new(4.0, 3.0, 5.0), [grey, lamp, grey, grey, grey, grey]);
    for i in 0..7 {
        let random = |k: u32| unit_float(hash(hash(seed) ^ (i * 16 + k)));
        let centre = Vec3::new(0.6 + 2.8 * random(0), 0.6 + 1.8 * random(1), 0.6 + 3.8 * random(2));
        let half = Vec3::new(0.05 + 0.4 * random(3), 0.05 + 0.4 * random(4), 0.05 + 0.4 * random(5));
        builder.block(centre, half, Quat::from_rotation_y(6.0 * random(6)) * Quat::from_rotation_x(random(7)), grey);
    }
    builder.build(1)
}
