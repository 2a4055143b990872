//! A sky for scenes that bring no light: nobody shall look into the dark.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use crate::base::colour::luminance;
use crate::base::ids::GroupId;
use crate::scene::{Light, Scene};

/// What the user is told.
pub const NOTE: &str = "the file brings no light: a default sky of 10 000 lx shines on it; \
                        add a lamp or an emissive material and export lights too";

/// On open level ground, lux: an overcast noon.
const ILLUMINANCE: f32 = 10_000.0;
/// A little bluer than white.
const COLOUR: Vec3 = Vec3::new(0.94, 0.98, 1.08);
/// Rings of suns from the horizon to the zenith, and suns in each.
const RINGS: [(u32, f32); 3] = [(8, 0.25), (6, 0.6), (3, 0.9)];

/// Nothing in the scene shines.
#[must_use]
pub fn is_needed(scene: &Scene) -> bool {
    scene.light_groups.is_empty() && !scene.triangles.is_empty()
}

/// Adds an even dome of faint suns, a light group of its own.
///
/// Equation: each ring of suns at height sin h stands for the part of an even sky round it; all together bring the
/// horizontal illuminance L pi of such a sky.
pub fn add(scene: &mut Scene) {
    let group = GroupId::new(scene.light_groups.len());
    scene.light_groups.push("default sky".to_owned());
    let horizontal: f32 = RINGS.iter().map(|&(count, height)| count as f32 * height).sum();
    for (count, height) in RINGS {
        let level = (1.0 - height * height).sqrt();
        for i in 0..count {
            let (sin, cos) = (TAU * (i as f32 + PI * height) / count as f32).sin_cos();
            scene.lights.push(Light {
                name: "default sky".to_owned(),
                group,
                ..Light::directional(
                    -Vec3::new(level * cos, height, level * sin),
                    COLOUR * (ILLUMINANCE / (horizontal * luminance(COLOUR))),
                )
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin;

    #[test]
    fn the_sky_brings_its_lux_to_open_ground_and_only_where_no_light_is() {
        let mut scene = builtin::cornell();
        assert!(!is_needed(&scene));
        scene.light_groups.clear();
        scene.lights.clear();
        assert!(is_needed(&scene));
        add(&mut scene);
        let arrivals = scene.lights.iter().map(|light| light.arrival(Vec3::ZERO));
        let lux: f32 = arrivals.map(|a| a.to_light.y.max(0.0) * luminance(a.irradiance)).sum();
        assert!((lux / ILLUMINANCE - 1.0).abs() < 0.02, "{lux}");
        assert!(!is_needed(&scene));
    }

    #[test]
    fn nothing_is_not_lit() {
        assert!(!is_needed(&Scene::default()));
    }
}
