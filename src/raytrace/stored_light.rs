//! The stored light of a bake: irradiance at any point on either side of a surface.

use std::collections::HashMap;

use glam::Vec3;

use crate::baked::BakedScene;
use crate::base::ids::TriangleId;
use crate::raytrace::surface::hit::Surface;
use crate::scene::Scene;

/// Irradiance that the bake lacks, at its vertices `[v]`, lux per channel.
pub(crate) struct CausticLight {
    /// Straight from lights, through panes.
    pub through_panes: Vec<Vec3>,
    /// From lights, by way of mirrors.
    pub by_mirrors: Vec<Vec3>,
    /// After at least one diffuse reflection.
    pub reflected: Vec<Vec3>,
}

/// Stored irradiance, the sum of all light groups.
pub(crate) struct StoredLight<'a> {
    scene: &'a Scene,
    /// Straight from the lights `[v]`, lux per channel.
    direct: Vec<Vec3>,
    /// After at least one reflection `[v]`.
    indirect: Vec<Vec3>,
    /// From lights by way of mirrors `[v]`; 0 until [`Self::add`].
    by_mirrors: Vec<Vec3>,
    /// The back that a bake wrote out for a triangle, by the triangle.
    back_of: HashMap<TriangleId, TriangleId>,
}

impl<'a> StoredLight<'a> {
    pub(crate) fn new(baked: &'a BakedScene) -> Self {
        let scene = &baked.scene;
        let num_vertices = scene.vertices.len();
        let (mut direct, mut indirect) = (vec![Vec3::ZERO; num_vertices], vec![Vec3::ZERO; num_vertices]);
        for group in &baked.light.groups {
            add(&mut direct, &group.direct);
            add(&mut indirect, &group.indirect);
        }
        Self { scene, direct, indirect, by_mirrors: vec![Vec3::ZERO; num_vertices], back_of: backs(scene) }
    }

    /// Indirect irradiance at a surface.
    pub(crate) fn indirect(&self, surface: &Surface) -> Vec3 {
        self.interpolate(surface, |v| self.indirect[v])
    }

    /// All irradiance at a surface.
    pub(crate) fn total(&self, surface: &Surface) -> Vec3 {
        self.interpolate(surface, |v| self.direct[v] + self.indirect[v] + self.by_mirrors[v])
    }

    /// Irradiance from lights by way of mirrors.
    pub(crate) fn by_mirrors(&self, surface: &Surface) -> Vec3 {
        self.interpolate(surface, |v| self.by_mirrors[v])
    }

    /// Adds light that the bake lacks.
    pub(crate) fn add(&mut self, caustics: &CausticLight) {
        add(&mut self.direct, &caustics.through_panes);
        add(&mut self.by_mirrors, &caustics.by_mirrors);
        add(&mut self.indirect, &caustics.reflected);
    }

    /// The triangle that stands for a side of a surface.
    pub(crate) fn side(&self, triangle: TriangleId, is_front: bool) -> TriangleId {
        match self.back_of.get(&triangle) {
            Some(&back) if !is_front => back,
            _ => triangle,
        }
    }

    fn interpolate(&self, surface: &Surface, value: impl Fn(usize) -> Vec3) -> Vec3 {
        let front = self.scene.triangles[surface.triangle.index()].vertices;
        let weights = surface.barycentric.to_array();
        let side = self.scene.triangles[self.side(surface.triangle, surface.is_front).index()].vertices;
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
