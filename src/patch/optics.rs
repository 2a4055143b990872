//! Mean reflectance, exitance and solid area of elements.
//!
//! Equation: with opacity a at sample points, the solid area is A mean(a), the reflectance sum(a rho) / sum(a) and the
//! exitance pi sum(a L_e) / sum(a).

use std::f32::consts::PI;

use glam::Vec3;
use rayon::prelude::*;

use super::mesh::{Element, PatchMesh};
use crate::base::sampling::{r2, triangle_from_square};
use crate::scene::{Material, Scene, Vertex, area_of};

/// Sample points of an element whose material varies.
const NUM_SAMPLES: u32 = 16;

/// Fills in area, reflectance, exitance and group of every element.
pub(super) fn evaluate(mesh: &mut PatchMesh, scene: &Scene) {
    let PatchMesh { vertices, elements, .. } = mesh;
    elements.par_iter_mut().for_each(|element| evaluate_element(element, vertices, scene));
}

fn evaluate_element(element: &mut Element, vertices: &[Vertex], scene: &Scene) {
    let material = scene.material_of(element.triangle);
    let corners = element.vertices.map(|v| &vertices[v as usize]);
    let num_samples = if varies(material, corners) { NUM_SAMPLES } else { 1 };
    let mut solid = 0.0;
    let mut reflected = Vec3::ZERO;
    let mut emitted = Vec3::ZERO;
    for i in 0..num_samples {
        // A single sample lies at the centroid.
        let weights =
            if num_samples == 1 { Vec3::splat(1.0 / 3.0) } else { triangle_from_square(r2(i, element.triangle.0)) };
        let (uv, colour) = Vertex::uv_and_colour_at(corners, weights);
        let point = material.at(&scene.textures, uv, colour);
        solid += point.opacity;
        reflected += point.opacity * point.reflectance;
        emitted += point.opacity * point.emission;
    }
    // The area is never 0, because a ray or pixel may still hit an element whose samples are all holes.
    let solid = solid.max(0.5);
    element.area = area_of(corners.map(|v| v.position)) * solid / num_samples as f32;
    element.reflectance = reflected / solid;
    element.exitance = PI * emitted / solid;
    element.group = if element.exitance.max_element() > 0.0 { material.group } else { None };
}

/// Returns true if the material may vary over the element. Its mean then needs several samples.
fn varies(material: &Material, corners: [&Vertex; 3]) -> bool {
    material.base_colour_texture.is_some()
        || material.emissive_texture.is_some()
        || material.metallic_roughness_texture.is_some()
        || corners[0].colour != corners[1].colour
        || corners[0].colour != corners[2].colour
}
