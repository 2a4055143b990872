//! The light of a bake as rays look it up: irradiance at any point of any side of a surface.

use std::collections::HashMap;

use glam::Vec3;

use super::surface::Surface;
use crate::baked::BakedScene;
use crate::base::ids::TriangleId;
use crate::scene::Scene;

/// Stored irradiance, all light groups together.
pub(super) struct StoredLight<'a> {
    scene: &'a Scene,
    /// Straight from the lights `[v]`, lux per channel.
    direct: Vec<Vec3>,
    /// After at least one reflection `[v]`.
    indirect: Vec<Vec3>,
    /// The back that a bake wrote out for a triangle, by the triangle.
    back_of: HashMap<TriangleId, TriangleId>,
}

impl<'a> StoredLight<'a> {
    pub(super) fn new(baked: &'a BakedScene) -> Self {
        let scene = &baked.scene;
        let num_vertices = scene.vertices.len();
        let (mut direct, mut indirect) = (vec![Vec3::ZERO; num_vertices], vec![Vec3::ZERO; num_vertices]);
        for group in &baked.light.groups {
            add(&mut direct, &group.direct);
            add(&mut indirect, &group.indirect);
        }
        Self { scene, direct, indirect, back_of: backs(scene) }
    }

    /// Indirect irradiance at a surface.
    pub(super) fn indirect(&self, surface: &Surface) -> Vec3 {
        self.interpolate(surface, |v| self.indirect[v])
    }

    /// All irradiance at a surface.
    pub(super) fn total(&self, surface: &Surface) -> Vec3 {
        self.interpolate(surface, |v| self.direct[v] + self.indirect[v])
    }

    fn interpolate(&self, surface: &Surface, value: impl Fn(usize) -> Vec3) -> Vec3 {
        let front = self.scene.triangles[surface.triangle.index()].vertices;
        let weights = surface.barycentric.to_array();
        let side = match self.back_of.get(&surface.triangle) {
            Some(back) if !surface.is_front => self.scene.triangles[back.index()].vertices,
            _ => front,
        };
        let position = |v: u32| self.scene.vertices[v as usize].position;
        // The back goes round the other way: its corners are told by their places.
        let weight_at = |v: u32| (0..3).find(|&i| position(front[i]) == position(v)).map_or(0.0, |i| weights[i]);
        side.iter().map(|&v| value(v as usize) * weight_at(v)).sum::<Vec3>().max(Vec3::ZERO)
    }
}

fn add(sums: &mut [Vec3], values: &[Vec3]) {
    for (sum, &value) in sums.iter_mut().zip(values) {
        *sum += value;
    }
}

/// Pairs fronts and backs by the places of their corners.
fn backs(scene: &Scene) -> HashMap<TriangleId, TriangleId> {
    let place = |triangle: TriangleId| {
        let mut corners = scene.corners(triangle).map(|corner| corner.to_array().map(f32::to_bits));
        corners.sort_unstable();
        corners
    };
    let sides = |is_back: bool| {
        let all = (0..scene.triangles.len()).map(TriangleId::new);
        all.filter(move |t| scene.triangles[t.index()].is_back_side == is_back)
    };
    let by_place: HashMap<_, _> = sides(true).map(|back| (place(back), back)).collect();
    if by_place.is_empty() {
        return HashMap::new();
    }
    sides(false).filter_map(|front| Some((front, *by_place.get(&place(front))?))).collect()
}
