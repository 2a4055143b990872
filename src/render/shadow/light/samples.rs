//! Light samples: the lights of a scene as points and directions, each with one hard shadow.
//!
//! A punctual light is one sample, or many on a small sphere round its position. An emissive surface of radiance L and
//! area A becomes N points, stratified over its area ([`emitters`](super::emitters)). The intensity of each is L A / N
//! times the cosine to the surface's normal. Their sum tends to the irradiance that the bake computes in closed form:
//!
//! ```text
//! E = sum over N samples of  L (A / N) cos(emitted) cos(received) / r^2
//! ```

use std::sync::{Arc, Mutex, PoisonError};

use glam::Vec3;

use super::emitters::{GOLDEN, emitters};
use super::sample::LightSample;
use crate::render::shadow::shared::scene::{SceneData, ShadowScene};
use crate::scene::{Light, LightKind, Scene};

/// Returns the light samples of a scene. An emissive surface has `per_lamp` samples, and so has a punctual light if
/// `radius` (metres) is more than 0; otherwise the punctual light has one. A directional light always has one.
#[must_use]
pub fn light_samples(scene: &Scene, per_lamp: u32, radius: f32) -> Vec<LightSample> {
    let mut samples = Vec::new();
    for (lamp, light) in scene.lights.iter().enumerate() {
        add_punctual(light, lamp, if radius > 0.0 { per_lamp } else { 1 }, radius, &mut samples);
    }
    for (number, emitter) in emitters(scene).iter().enumerate() {
        emitter.add_samples(scene, per_lamp, scene.lights.len() + number, &mut samples);
    }
    samples.retain(|sample| sample.light.intensity.max_element() > 0.0);
    samples
}

/// Adds `count` equally strong points on a sphere round a punctual light (a Fibonacci lattice), or one point in its
/// middle.
fn add_punctual(light: &Light, lamp: usize, count: u32, radius: f32, samples: &mut Vec<LightSample>) {
    let (LightKind::Point { position } | LightKind::Spot { position, .. }) = light.kind else {
        samples.push(LightSample { light: light.clone(), surface_normal: None, lamp });
        return;
    };
    for index in 0..count {
        let height = 1.0 - (2 * index + 1) as f32 / count as f32;
        let (sin, cos) = (index as f32 * GOLDEN * std::f32::consts::TAU).sin_cos();
        let ring = if count > 1 { (1.0 - height * height).sqrt() } else { 0.0 };
        let mut part = light.clone();
        part.intensity /= count as f32;
        if let LightKind::Point { position: moved } | LightKind::Spot { position: moved, .. } = &mut part.kind {
            *moved = position + radius * Vec3::new(ring * cos, height, ring * sin);
        }
        samples.push(LightSample { light: part, surface_normal: None, lamp });
    }
}

/// Cache of the light samples that were last computed for a scene, because every picture needs them.
#[derive(Default)]
struct KeptSamples(Mutex<Option<Computed>>);

struct Computed {
    per_lamp: u32,
    radius: f32,
    samples: Arc<[LightSample]>,
}

impl SceneData for KeptSamples {}

/// Returns [`light_samples`] of a scene. They are computed only if the arguments differ from those of the last call.
pub fn samples_of(shadows: &ShadowScene, per_lamp: u32, radius: f32) -> Arc<[LightSample]> {
    let kept = shadows.kept(KeptSamples::default);
    let mut last = kept.0.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(same) = last.as_ref().filter(|last| (last.per_lamp, last.radius) == (per_lamp, radius)) {
        return Arc::clone(&same.samples);
    }
    let samples: Arc<[_]> = light_samples(shadows.scene(), per_lamp, radius).into();
    *last = Some(Computed { per_lamp, radius, samples: Arc::clone(&samples) });
    samples
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::PI;

    use crate::scene::{Material, SceneBuilder};

    /// A square of side 2 at height 1 that shines down with exitance pi.
    fn panel(double_sided: bool) -> Scene {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let mut builder = SceneBuilder::default();
        let group = Some(builder.group("lamps"));
        let lamp = builder.material(Material { emission: Vec3::ONE, group, double_sided, ..Material::default() });
        builder.quad(corners.map(|(x, z)| Vec3::new(x, 1.0, z)), lamp);
        builder.build()
    }

    #[test]
    fn samples_of_a_surface_sum_to_its_irradiance() {
        // Four times the form factor from a point to a parallel square of side a with a corner above it at distance c:
        // F = 2 / (2 pi) x a / sqrt(a^2 + c^2) x atan(a / sqrt(a^2 + c^2)), with a = c = 1.
        let half: f32 = 0.5f32.sqrt();
        let expected = PI * 4.0 * half * half.atan() / PI;
        // The error of evenly spread points is about 1 / N; of random ones it is 0.53 / sqrt(N), 3.3 % at 256.
        for count in [64, 256, 1024] {
            let samples = light_samples(&panel(false), count, 0.0);
            assert_eq!(samples.len(), count as usize);
            let sum: Vec3 = samples.iter().map(|sample| sample.irradiance(Vec3::ZERO, Vec3::Y)).sum();
            assert!((sum.x / expected - 1.0).abs() < 1.0 / count as f32, "{count} points: {sum}, not {expected}");
        }
    }

    #[test]
    fn the_points_of_a_light_with_a_radius_sum_to_its_intensity() {
        let position = Vec3::new(1.0, 2.0, 3.0);
        let lights = vec![Light::point(position, Vec3::ONE), Light::directional(Vec3::NEG_Y, Vec3::ONE)];
        let scene = Scene { lights, ..Scene::default() };
        assert_eq!(light_samples(&scene, 64, 0.0).len(), 2);
        assert_eq!(light_samples(&scene, 1, 0.3)[0].position(), position.extend(1.0));
        let samples = light_samples(&scene, 64, 0.3);
        let ball: Vec<_> = samples.iter().filter(|sample| sample.lamp == 0).collect();
        assert_eq!((ball.len(), samples.len()), (64, 65));
        assert!(ball.iter().all(|s| (s.position().truncate().distance(position) - 0.3).abs() < 1e-5));
        let total: f32 = ball.iter().map(|sample| sample.light.intensity.x).sum();
        let mean = ball.iter().map(|sample| sample.position().truncate()).sum::<Vec3>() / 64.0;
        assert!((total - 1.0).abs() < 1e-5 && mean.distance(position) < 0.01, "{total}, {mean}");
    }

    #[test]
    fn a_panel_emits_on_its_front_and_a_double_sided_one_on_both_sides() {
        let above = |scene: &Scene| -> Vec3 {
            light_samples(scene, 4, 0.0).iter().map(|sample| sample.irradiance(2.0 * Vec3::Y, Vec3::NEG_Y)).sum()
        };
        assert_eq!(above(&panel(false)), Vec3::ZERO);
        assert!(above(&panel(true)).x > 0.1);
    }
}
