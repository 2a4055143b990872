//! Emissive surfaces as lamps: groups triangles into lamps and places samples on them.

use std::collections::{BTreeMap, HashMap};

use glam::{Vec2, Vec3};

use super::sample::LightSample;
use crate::base::ids::{GroupId, TriangleId};
use crate::base::sampling::triangle_from_square;
use crate::base::triangle::interpolate;
use crate::scene::{Light, Scene, area_of, normal_of};

/// Step of the second coordinate from sample to sample, modulo 1. Multiples of the golden ratio are spread evenly for
/// any number of samples.
pub const GOLDEN: f32 = 0.618_034;
/// Size of the cells that lamps are split into, as a share of the scene's extent; the same as in the bake.
const CELL_SHARE: f32 = 0.1;
/// Height of a sample above its surface, as a share of the scene's extent. It keeps the surface from shadowing itself.
const HEIGHT: f32 = 2e-5;

/// An emissive surface: all connected pieces of one instance, material and side whose middles lie in one cell of space.
pub struct Emitter {
    group: GroupId,
    is_back: bool,
    triangles: Vec<TriangleId>,
    /// Running sum of the areas of the triangles, square metres.
    cumulative_area: Vec<f32>,
    /// Height of samples above the surface, metres.
    height: f32,
}

/// Returns the emissive surfaces of a scene.
pub fn emitters(scene: &Scene) -> Vec<Emitter> {
    let extent = scene.bounds().extent();
    let cell_size = CELL_SHARE * extent.max(f32::MIN_POSITIVE);
    let has_backs = scene.sides.has_backs();
    let mut by_cell: BTreeMap<_, Emitter> = BTreeMap::new();
    for piece in pieces(scene) {
        let triangle = &scene.triangles[piece[0].index()];
        let material = &scene.materials[triangle.material.index()];
        let Some(group) = material.group else { continue };
        let middle = piece.iter().flat_map(|&id| scene.corners(id)).sum::<Vec3>() / (3 * piece.len()) as f32;
        let cell = (middle / cell_size).floor().as_ivec3().to_array();
        // In a bake, backs of double-sided triangles are triangles of their own.
        let num_sides = if material.double_sided && !has_backs { 2 } else { 1 };
        for side in 0..num_sides {
            let key = (triangle.instance, triangle.material, scene.sides.is_back(piece[0]), side, cell);
            let emitter = by_cell.entry(key).or_insert_with(|| Emitter::new(group, side == 1, HEIGHT * extent));
            piece.iter().for_each(|&id| emitter.add(id, area_of(scene.corners(id))));
        }
    }
    by_cell.into_values().collect()
}

/// Returns the emissive triangles of one instance, material and side that are connected by shared corners.
fn pieces(scene: &Scene) -> Vec<Vec<TriangleId>> {
    let mut piece_of_corner = HashMap::new();
    let mut pieces: Vec<Vec<TriangleId>> = Vec::new();
    for (t, triangle) in scene.triangles.iter().enumerate() {
        if !scene.materials[triangle.material.index()].is_emissive() {
            continue;
        }
        let id = TriangleId::new(t);
        let surface = (triangle.instance, triangle.material, scene.sides.is_back(id));
        let corners = scene.corners(id).map(|corner| (surface, corner.to_array().map(f32::to_bits)));
        let mut touched: Vec<usize> =
            corners.iter().filter_map(|corner| piece_of_corner.get(corner).copied()).collect();
        touched.sort_unstable();
        touched.dedup();
        // The triangle connects all pieces that it touches: they are merged into the first of them.
        let home = touched.first().copied().unwrap_or_else(|| {
            pieces.push(Vec::new());
            pieces.len() - 1
        });
        for &other in touched.iter().skip(1) {
            let moved = std::mem::take(&mut pieces[other]);
            pieces[home].extend(moved);
            piece_of_corner.values_mut().filter(|piece| **piece == other).for_each(|piece| *piece = home);
        }
        pieces[home].push(id);
        piece_of_corner.extend(corners.map(|corner| (corner, home)));
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

impl Emitter {
    fn new(group: GroupId, is_back: bool, height: f32) -> Self {
        Self { group, is_back, triangles: Vec::new(), cumulative_area: Vec::new(), height }
    }

    fn add(&mut self, id: TriangleId, area: f32) {
        let before = self.cumulative_area.last().copied().unwrap_or(0.0);
        self.triangles.push(id);
        self.cumulative_area.push(before + area);
    }

    /// Adds `count` samples of lamp `lamp`, one for each of `count` strata of equal area.
    pub fn add_samples(&self, scene: &Scene, count: u32, lamp: usize, samples: &mut Vec<LightSample>) {
        let area = self.cumulative_area.last().copied().unwrap_or(0.0);
        for index in 0..count {
            let square = Vec2::new((index as f32 + 0.5) / count as f32, (0.5 + index as f32 * GOLDEN).fract());
            let (id, weights) = self.at(square, area);
            let corners = scene.corners(id);
            let [a, b, c] = corners;
            let normal = if self.is_back { -normal_of(corners) } else { normal_of(corners) };
            let position = interpolate([a, b, c], weights) + self.height * normal;
            let radiance = emission(scene, id, weights);
            samples.push(LightSample {
                light: Light {
                    name: scene.instances[scene.triangles[id.index()].instance.index()].name.clone(),
                    group: self.group,
                    // A Lambertian surface of radiance L and area A has the intensity L A cos.
                    ..Light::point(position, radiance * (area / count as f32))
                },
                surface_normal: Some(normal),
                lamp,
            });
        }
    }

    /// Maps a point of the unit square to a triangle and barycentric weights, in proportion to area.
    fn at(&self, square: Vec2, area: f32) -> (TriangleId, Vec3) {
        let target = square.x * area;
        let at = self.cumulative_area.partition_point(|&sum| sum <= target).min(self.triangles.len() - 1);
        let before = if at == 0 { 0.0 } else { self.cumulative_area[at - 1] };
        // The remainder of the first coordinate is uniform within the triangle.
        let within = ((target - before) / (self.cumulative_area[at] - before)).clamp(0.0, 1.0);
        (self.triangles[at], triangle_from_square(Vec2::new(within, square.y)))
    }
}

/// Returns the radiance that a triangle emits at a point; holes emit none.
fn emission(scene: &Scene, id: TriangleId, weights: Vec3) -> Vec3 {
    let point = scene.surface_at(id, weights);
    point.emission * point.opacity
}
