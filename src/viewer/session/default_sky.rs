//! A default sky for scenes without light.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use crate::base::colour::luminance;
use crate::base::ids::GroupId;
use crate::scene::{Light, Scene};

/// The advice that is shown for a scene with the default sky.
pub const NOTE: &str = "the file has no light: a default sky of 10 000 lx lights it; \
                        add a lamp or an emissive material and export lights too";

/// Illuminance on open horizontal ground, lux: an overcast noon.
const ILLUMINANCE: f32 = 10_000.0;
/// Colour, slightly bluer than white.
const COLOUR: Vec3 = Vec3::new(0.94, 0.98, 1.08);
/// Number of suns in each ring, and the sine of their altitude.
const RINGS: [(u32, f32); 3] = [(8, 0.25), (6, 0.6), (3, 0.9)];

/// Returns true if the scene has triangles but no light.
#[must_use]
pub fn is_needed(scene: &Scene) -> bool {
    scene.light_groups.is_empty() && !scene.triangles.is_empty()
}

/// Adds a uniform dome of faint suns as a light group of its own.
///
/// Equation: each sun has the illuminance E / sum(sin h) on a surface that faces it; the sum is over all suns, at
/// altitudes h. Together they give the horizontal illuminance E.
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
    fn the_sky_lights_open_ground_as_specified_and_only_scenes_without_light() {
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
    fn an_empty_scene_needs_no_sky() {
        assert!(!is_needed(&Scene::default()));
    }
}
