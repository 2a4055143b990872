//! Small scenes with known answers.

use glam::{Quat, Vec3};
use hemicube::base::ids::GroupId;
use hemicube::base::sampling::{hash, unit_float};
use hemicube::scene::{Material, Scene, SceneBuilder};

/// Creates a diffuse material with `reflectance` that emits the exitance `exitance` in light group 0.
pub fn glowing(reflectance: Vec3, exitance: Vec3) -> Material {
    let group = (exitance.max_element() > 0.0).then_some(GroupId(0));
    Material { emission: exitance / std::f32::consts::PI, group, ..Material::diffuse(reflectance) }
}

/// Returns the scene with `num_groups` light groups.
pub fn with_groups(scene: Scene, num_groups: usize) -> Scene {
    Scene { light_groups: (0..num_groups).map(|g| format!("group {g}")).collect(), ..scene }
}

/// Builds a closed unit cube in which every wall reflects `reflectance` and emits `exitance`: B = E / (1 - rho)
/// everywhere.
pub fn furnace(reflectance: Vec3, exitance: Vec3) -> Scene {
    let mut builder = SceneBuilder::default();
    let wall = builder.material(glowing(reflectance, exitance));
    builder.room(Vec3::ZERO, Vec3::ONE, [wall; 6]);
    with_groups(builder.build(), 1)
}

/// Builds a closed room with seven blocks at random positions and angles, lit by its ceiling.
pub fn cluttered_room(seed: u32) -> Scene {
    let mut builder = SceneBuilder::default();
    let grey = builder.material(glowing(Vec3::splat(0.5), Vec3::ZERO));
    let lamp = builder.material(glowing(Vec3::splat(0.5), Vec3::ONE));
    builder.room(Vec3::ZERO, Vec3::new(4.0, 3.0, 5.0), [grey, lamp, grey, grey, grey, grey]);
    for i in 0..7 {
        let random = |k: u32| unit_float(hash(hash(seed) ^ (i * 16 + k)));
        let centre = Vec3::new(0.6 + 2.8 * random(0), 0.6 + 1.8 * random(1), 0.6 + 3.8 * random(2));
        let half = Vec3::new(0.05 + 0.4 * random(3), 0.05 + 0.4 * random(4), 0.05 + 0.4 * random(5));
        builder.block(centre, half, Quat::from_rotation_y(6.0 * random(6)) * Quat::from_rotation_x(random(7)), grey);
    }
    with_groups(builder.build(), 1)
}
