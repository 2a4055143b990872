//! The stored light of a bake: irradiance at any point on either side of a surface.

use glam::Vec3;

use crate::baked::BakedScene;
use crate::base::ids::TriangleId;
use crate::raytrace::surface::hit::Surface;
use crate::scene::Scene;

/// Irradiance that the bake lacks, at its vertices `[v]`, lux per channel.
pub(crate) struct CausticLight {
    /// Irradiance straight from lights, through panes.
    pub through_panes: Vec<Vec3>,
    /// Irradiance from lights by way of mirrors.
    pub by_mirrors: Vec<Vec3>,
    /// Irradiance after at least one diffuse reflection.
    pub reflected: Vec<Vec3>,
}

/// Stored irradiance, the sum of all light groups.
pub(crate) struct StoredLight<'a> {
    scene: &'a Scene,
    /// Irradiance straight from the lights `[v]`, lux per channel.
    direct: Vec<Vec3>,
    /// Irradiance after at least one reflection `[v]`.
    indirect: Vec<Vec3>,
    /// Irradiance from lights by way of mirrors `[v]`; 0 until [`Self::add`].
    by_mirrors: Vec<Vec3>,
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
        Self { scene, direct, indirect, by_mirrors: vec![Vec3::ZERO; num_vertices] }
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

    /// Returns the triangle that stores the light of one side of a surface.
    pub(crate) fn side(&self, triangle: TriangleId, is_front: bool) -> TriangleId {
        self.scene.on_side(triangle, Vec3::ZERO, is_front).0
    }

    fn interpolate(&self, surface: &Surface, value: impl Fn(usize) -> Vec3) -> Vec3 {
        let (side, weights) = self.scene.on_side(surface.triangle, surface.barycentric, surface.is_front);
        let corners = self.scene.triangles[side.index()].vertices;
        let share = |(&v, weight)| value(v as usize) * weight;
        corners.iter().zip(weights.to_array()).map(share).sum::<Vec3>().max(Vec3::ZERO)
    }
}

fn add(sums: &mut [Vec3], values: &[Vec3]) {
    for (sum, &value) in sums.iter_mut().zip(values) {
        *sum += value;
    }
}
