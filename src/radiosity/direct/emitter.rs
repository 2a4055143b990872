//! Emissive surfaces as area lights: which of them a viewpoint samples with rays, and at which points.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::{Vec2, Vec3};

use crate::base::colour::luminance;
use crate::base::ids::{ElementId, GroupId};
use crate::base::sampling::{r2, triangle_from_square};
use crate::base::triangle::interpolate;
use crate::form_factor::point_to_polygon;
use crate::patch::PatchMesh;
use crate::scene::{Scene, area_of, normal_of};

/// Triangles of one surface form one emitter if they lie in one grid cell of this size, as a share of the scene's
/// extent. So separate lamps of one mesh have separate visibility.
const CELL_SHARE: f32 = 0.1;

/// Emitters below this share of a viewpoint's light are pooled and sampled together, so a thousand lamps do not need a
/// thousand times the rays of one.
const SMALL_SHARE: f32 = 1.0 / 64.0;

/// All emissive triangles of a scene, emitter by emitter.
pub(super) struct Emitters {
    triangles: Vec<EmitterTriangle>,
    emitters: Vec<Emitter>,
}

/// Emissive triangles of one instance, material, side and cell, which share one visibility.
struct Emitter {
    group: GroupId,
    triangles: Range<usize>,
}

/// Group, instance, material, side and cell, which are equal for all triangles of one emitter.
type SurfaceKey = (GroupId, u32, u32, bool, [i32; 3]);

struct EmitterTriangle {
    corners: [Vec3; 3],
    normal: Vec3,
    exitance: Vec3,
    area: f32,
}

/// The emitters that one viewpoint samples. One value serves many viewpoints in turn, so that its memory is reused.
#[derive(Default)]
pub(super) struct Candidates {
    pub list: Vec<Candidate>,
    /// Triangles of all candidates. Those of one candidate are contiguous.
    triangles: Vec<Contribution>,
    /// Emitters above the horizon: index, unoccluded irradiance, range of their contributions.
    facing: Vec<(usize, Vec3, Range<usize>)>,
    contributions: Vec<Contribution>,
}

/// One emitter, or the pool of all small emitters of a light group.
pub(super) struct Candidate {
    pub group: GroupId,
    /// Irradiance without occlusion, lux per channel.
    pub unoccluded: Vec3,
    triangles: Range<usize>,
    is_pool: bool,
}

/// A triangle, the luminance of its unoccluded irradiance, and the running sum of these within its candidate.
#[derive(Clone, Copy)]
struct Contribution {
    triangle: usize,
    luminance: f32,
    cumulative: f32,
}

/// A point of an emitter that a receiver samples.
pub(super) struct EmitterSample {
    pub point: Vec3,
    /// Its share of the unoccluded irradiance, up to a factor common to all samples of a candidate.
    pub weight: f32,
}

impl Emitters {
    /// Collects the emitters of a scene.
    ///
    /// Their triangles are the elements if the emission has a texture, else the input triangles: the closed form is
    /// exact for an untextured panel of any size.
    pub(super) fn new(scene: &Scene, mesh: &PatchMesh) -> Self {
        let cell_size = CELL_SHARE * scene.bounds().extent().max(f32::MIN_POSITIVE);
        let mut by_surface: BTreeMap<SurfaceKey, Vec<EmitterTriangle>> = BTreeMap::new();
        for (t, root) in mesh.roots.iter().enumerate() {
            let triangle = &scene.triangles[t];
            let material = &scene.materials[triangle.material.index()];
            let Some(group) = material.group.filter(|_| material.is_emissive()) else { continue };
            let corners = triangle.vertices.map(|v| scene.vertices[v as usize].position);
            let cell = ((corners[0] + corners[1] + corners[2]) / (3.0 * cell_size)).floor().as_ivec3().to_array();
            let sides = if root.has_backs { 2 } else { 1 };
            for side in 0..sides {
                let first = root.first_element + side * root.num_elements;
                let surface = (group, triangle.instance.0, triangle.material.0, side == 1, cell);
                let triangles = by_surface.entry(surface).or_default();
                if material.emissive_texture.is_some() {
                    let elements = (first..first + root.num_elements).map(|e| &mesh.elements[ElementId(e).index()]);
                    triangles.extend(elements.filter_map(|e| EmitterTriangle::new(mesh.corners(e), e.exitance)));
                } else {
                    let [a, b, c] = corners;
                    let corners = if side == 1 { [a, c, b] } else { corners };
                    triangles.extend(EmitterTriangle::new(corners, mesh.elements[first as usize].exitance));
                }
            }
        }
        let mut all = Self { triangles: Vec::new(), emitters: Vec::new() };
        for ((group, ..), triangles) in by_surface.into_iter().filter(|(_, triangles)| !triangles.is_empty()) {
            let start = all.triangles.len();
            all.triangles.extend(triangles);
            all.emitters.push(Emitter { group, triangles: start..all.triangles.len() });
        }
        all
    }

    /// Finds the emitters that contribute at a point: one candidate per bright emitter, then one pool per group.
    pub(super) fn find_candidates(&self, point: Vec3, normal: Vec3, found: &mut Candidates) {
        found.clear();
        for (e, emitter) in self.emitters.iter().enumerate() {
            let start = found.contributions.len();
            let mut sum = Vec3::ZERO;
            for t in emitter.triangles.clone() {
                let irradiance = self.triangles[t].unoccluded(point, normal);
                let luminance = luminance(irradiance);
                if luminance > 0.0 {
                    sum += irradiance;
                    found.contributions.push(Contribution { triangle: t, luminance, cumulative: 0.0 });
                }
            }
            if found.contributions.len() > start {
                found.facing.push((e, sum, start..found.contributions.len()));
            }
        }
        let total: f32 = found.facing.iter().map(|(_, sum, _)| luminance(*sum)).sum();
        // Emitters are sorted by group, so the small ones of a group are adjacent.
        for pooled in [false, true] {
            for at in 0..found.facing.len() {
                let (emitter, sum, contributions) = found.facing[at].clone();
                if (luminance(sum) < SMALL_SHARE * total) == pooled {
                    found.add(self.emitters[emitter].group, sum, contributions, pooled);
                }
            }
        }
    }

    /// Returns the `index`-th point of a sequence that is distributed evenly over a candidate by contribution.
    pub(super) fn sample(
        &self,
        candidates: &Candidates,
        candidate: &Candidate,
        index: u32,
        (point, normal, seed): (Vec3, Vec3, u32),
    ) -> EmitterSample {
        let contributions = &candidates.triangles[candidate.triangles.clone()];
        let square = r2(index, seed);
        // Choose a triangle with the probability of its contribution.
        let total = contributions[contributions.len() - 1].cumulative;
        let along = square.x * total;
        let at = contributions.partition_point(|c| c.cumulative <= along).min(contributions.len() - 1);
        let chosen = contributions[at];
        // The remainder of the first coordinate is uniform within the chosen triangle.
        let within = (1.0 - (chosen.cumulative - along) / chosen.luminance).clamp(0.0, 1.0);
        let triangle = &self.triangles[chosen.triangle];
        let weights = triangle_from_square(Vec2::new(within, square.y));
        let [a, b, c] = triangle.corners;
        let on_emitter = interpolate([a, b, c], weights);
        let offset = on_emitter - point;
        let cosines = normal.dot(offset).max(0.0) * (-triangle.normal.dot(offset)).max(0.0);
        let density = chosen.luminance / (luminance(triangle.exitance) * triangle.area);
        let weight = cosines / (offset.length_squared().powi(2) * density).max(f32::MIN_POSITIVE);
        EmitterSample { point: on_emitter, weight }
    }
}

impl Candidates {
    fn clear(&mut self) {
        self.list.clear();
        self.triangles.clear();
        self.facing.clear();
        self.contributions.clear();
    }

    /// Adds an emitter as a candidate, or to the last candidate if both are pooled and of one group.
    fn add(&mut self, group: GroupId, sum: Vec3, contributions: Range<usize>, pooled: bool) {
        let start = self.triangles.len();
        let joins = pooled && self.list.last().is_some_and(|last| last.group == group && last.is_pool);
        let mut cumulative = if joins { self.triangles[start - 1].cumulative } else { 0.0 };
        for contribution in &self.contributions[contributions] {
            cumulative += contribution.luminance;
            self.triangles.push(Contribution { cumulative, ..*contribution });
        }
        match self.list.last_mut().filter(|_| joins) {
            Some(pool) => {
                pool.unoccluded += sum;
                pool.triangles.end = self.triangles.len();
            }
            None => {
                let triangles = start..self.triangles.len();
                self.list.push(Candidate { group, unoccluded: sum, triangles, is_pool: pooled });
            }
        }
    }
}

impl EmitterTriangle {
    /// Returns `None` if the triangle does not emit.
    fn new(corners: [Vec3; 3], exitance: Vec3) -> Option<Self> {
        let is_emissive = exitance.max_element() > 0.0;
        is_emissive.then(|| Self { corners, normal: normal_of(corners), exitance, area: area_of(corners) })
    }

    /// Irradiance at a point without occlusion.
    ///
    /// Equation: E = M F(point, triangle) on the side that the triangle faces, where M is its exitance.
    fn unoccluded(&self, point: Vec3, normal: Vec3) -> Vec3 {
        if self.normal.dot(point - self.corners[0]) <= 0.0 {
            return Vec3::ZERO;
        }
        self.exitance * point_to_polygon(point, normal, &self.corners)
    }
}
