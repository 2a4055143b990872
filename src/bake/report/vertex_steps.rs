//! Measures how well the mesh resolves the light: differences between neighbouring vertices.

use crate::baked::VertexLight;
use crate::base::colour::luminance;
use crate::scene::Scene;

/// Differences are relative to at least this share of the mean light over the vertices, because differences in the dark
/// are invisible.
const FLOOR: f32 = 0.05;

/// Returns the largest difference of light between two vertices of an element, relative to the brighter one. It is
/// close to 1 if the edge of a deep shadow lies within an element.
pub(in crate::bake) fn largest_neighbour_step(scene: &Scene, light: &VertexLight) -> f32 {
    let total: Vec<f32> = (0..scene.vertices.len())
        .map(|v| light.groups.iter().map(|group| luminance(group.direct[v] + group.indirect[v])).sum())
        .collect();
    let floor = FLOOR * total.iter().sum::<f32>() / total.len().max(1) as f32;
    let step = |[a, b, c]: [u32; 3]| {
        let [a, b, c] = [a, b, c].map(|v| total[v as usize]);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        (high - low) / high.max(floor).max(f32::MIN_POSITIVE)
    };
    scene.triangles.iter().map(|triangle| step(triangle.vertices)).fold(0.0, f32::max)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::scene::builtin;

    #[test]
    fn the_largest_step_is_that_between_the_darkest_and_the_brightest_corner_of_one_triangle() {
        let mut scene = builtin::cornell();
        scene.triangles.truncate(2);
        let (first, second) = (scene.triangles[0].vertices, scene.triangles[1].vertices);
        let mut light = VertexLight::dark(1, scene.vertices.len());
        first.into_iter().chain(second).for_each(|v| light.groups[0].indirect[v as usize] = Vec3::splat(8.0));
        assert_eq!(largest_neighbour_step(&scene, &light), 0.0);
        light.groups[0].indirect[first[0] as usize] = Vec3::splat(2.0);
        light.groups[0].direct[first[0] as usize] = Vec3::splat(4.0);
        assert!((largest_neighbour_step(&scene, &light) - 0.25).abs() < 1e-6);
    }
}
