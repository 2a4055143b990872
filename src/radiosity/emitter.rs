//! Emissive surfaces as area lights.

use std::collections::BTreeMap;

use glam::Vec3;

use crate::base::colour::luminance;
use crate::base::ids::{ElementId, GroupId};
use crate::base::sampling::{r2, triangle_from_square};
use crate::form_factor::analytic::point_to_polygon;
use crate::patch::PatchMesh;
use crate::scene::{Scene, area_of, normal_of};

/// Triangles of one surface closer than this share of the scene's extent are one emitter: lamps of one mesh that hang
/// apart are not hidden together.
const PLACE_SHARE: f32 = 0.1;

/// Emissive triangles of one instance, material, side and place: lit and hidden together.
pub(super) struct Emitter {
    pub group: GroupId,
    triangles: Vec<EmitterTriangle>,
    /// Running sum of areas of the triangles, the last one being the whole.
    cumulative_area: Vec<f32>,
}

struct EmitterTriangle {
    corners: [Vec3; 3],
    normal: Vec3,
    exitance: Vec3,
}

/// A point of an emitter as a receiver sees it.
pub(super) struct EmitterSample {
    pub point: Vec3,
    /// Its share in the unoccluded irradiance, up to a factor common to all samples.
    pub weight: f32,
}

/// All emitters of a scene.
///
/// Where the emission has a texture its elements are the triangles, else the input triangles: the closed form does not
/// care how finely a plain panel is cut.
pub(super) fn emitters(scene: &Scene, mesh: &PatchMesh) -> Vec<Emitter> {
    let (low, high) = scene.bounds();
    let place_size = PLACE_SHARE * (high - low).max_element().max(f32::MIN_POSITIVE);
    let mut by_surface: BTreeMap<(u32, u32, bool, [i32; 3]), Emitter> = BTreeMap::new();
    for (t, root) in mesh.roots.iter().enumerate() {
        let triangle = &scene.triangles[t];
        let material = &scene.materials[triangle.material.index()];
        let Some(group) = material.group.filter(|_| material.is_emissive()) else { continue };
        let corners = triangle.vertices.map(|v| scene.vertices[v as usize].position);
        let place = ((corners[0] + corners[1] + corners[2]) / (3.0 * place_size)).floor().as_ivec3().to_array();
        let sides = if root.has_backs { 2 } else { 1 };
        for side in 0..sides {
            let first = root.first_element + side * root.num_elements;
            let key = (triangle.instance.0, triangle.material.0, side == 1, place);
            let emitter = by_surface.entry(key).or_insert_with(|| Emitter::new(group));
            if material.emissive_texture.is_some() {
                for e in first..first + root.num_elements {
                    emitter.add_element(mesh, ElementId(e));
                }
            } else {
                let [a, b, c] = corners;
                emitter.add(if side == 1 { [a, c, b] } else { corners }, mesh.elements[first as usize].exitance);
            }
        }
    }
    by_surface.into_values().filter(|emitter| !emitter.triangles.is_empty()).collect()
}

impl Emitter {
    fn new(group: GroupId) -> Self {
        Self { group, triangles: Vec::new(), cumulative_area: Vec::new() }
    }

    fn add_element(&mut self, mesh: &PatchMesh, id: ElementId) {
        let element = &mesh.elements[id.index()];
        self.add(mesh.corners(element), element.exitance);
    }

    fn add(&mut self, corners: [Vec3; 3], exitance: Vec3) {
        if exitance.max_element() <= 0.0 {
            return;
        }
        let area = self.cumulative_area.last().unwrap_or(&0.0) + area_of(corners);
        self.cumulative_area.push(area);
        self.triangles.push(EmitterTriangle { corners, normal: normal_of(corners), exitance });
    }

    /// Irradiance at a point if nothing stood between.
    ///
    /// Equation: E = sum over triangles that face the point of M x F(point, triangle).
    pub(super) fn unoccluded(&self, point: Vec3, normal: Vec3) -> Vec3 {
        self.triangles
            .iter()
            .filter(|triangle| triangle.normal.dot(point - triangle.corners[0]) > 0.0)
            .map(|triangle| triangle.exitance * point_to_polygon(point, normal, &triangle.corners))
            .sum()
    }

    /// The `index`-th point of a sequence spread evenly over the emitter's area.
    pub(super) fn sample(&self, index: u32, seed: u32, point: Vec3, normal: Vec3) -> EmitterSample {
        let square = r2(index, seed);
        let whole = *self.cumulative_area.last().expect("an emitter has triangles");
        let target = square.x * whole;
        let at = self.cumulative_area.partition_point(|&sum| sum <= target).min(self.triangles.len() - 1);
        let before = if at == 0 { 0.0 } else { self.cumulative_area[at - 1] };
        // What is left of the first coordinate is uniform within the chosen triangle.
        let within = ((target - before) / (self.cumulative_area[at] - before)).clamp(0.0, 1.0);
        let triangle = &self.triangles[at];
        let weights = triangle_from_square(glam::Vec2::new(within, square.y));
        let [a, b, c] = triangle.corners;
        let on_emitter = a * weights.x + b * weights.y + c * weights.z;
        let offset = on_emitter - point;
        let cosines = normal.dot(offset).max(0.0) * (-triangle.normal.dot(offset)).max(0.0);
        let weight = luminance(triangle.exitance) * cosines / offset.length_squared().powi(2).max(f32::MIN_POSITIVE);
        EmitterSample { point: on_emitter, weight }
    }
}
