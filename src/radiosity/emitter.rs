//! Emissive surfaces as area lights: which of them a place should aim rays at, and where on them.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::{Vec2, Vec3};

use crate::base::colour::luminance;
use crate::base::ids::{ElementId, GroupId};
use crate::base::sampling::{r2, triangle_from_square};
use crate::form_factor::point_to_polygon;
use crate::patch::PatchMesh;
use crate::scene::{Scene, area_of, normal_of};

/// Triangles of one surface closer than this share of the scene's extent are one emitter: lamps of one mesh that hang
/// apart are not hidden together.
const PLACE_SHARE: f32 = 0.1;

/// Emitters below this share of a place's light are aimed at together, so that a thousand lamps do not take a thousand
/// times the rays of one.
const SMALL_SHARE: f32 = 1.0 / 64.0;

/// All emissive triangles of a scene, emitter by emitter.
pub(super) struct Emitters {
    triangles: Vec<EmitterTriangle>,
    emitters: Vec<Emitter>,
}

/// Emissive triangles of one instance, material, side and place: lit and hidden together.
struct Emitter {
    group: GroupId,
    triangles: Range<usize>,
}

/// Group, instance, material, side and place: what triangles of one emitter have in common.
type SurfaceKey = (GroupId, u32, u32, bool, [i32; 3]);

struct EmitterTriangle {
    corners: [Vec3; 3],
    normal: Vec3,
    exitance: Vec3,
    area: f32,
}

/// What one place should aim rays at; kept from place to place for its memory.
#[derive(Default)]
pub(super) struct Aims {
    pub aims: Vec<Aim>,
    targets: Vec<Target>,
    seen: Vec<(usize, Vec3, Range<usize>)>,
    contributions: Vec<Target>,
}

/// An emitter, or the small ones of a light group together.
pub(super) struct Aim {
    pub group: GroupId,
    /// Irradiance if nothing stood between.
    pub unoccluded: Vec3,
    targets: Range<usize>,
    is_pool: bool,
}

/// A triangle and the luminance that it brings; where aimed at, the running sum of its aim.
#[derive(Clone, Copy)]
struct Target {
    triangle: usize,
    luminance: f32,
    cumulative: f32,
}

/// A point of an emitter as a receiver sees it.
pub(super) struct EmitterSample {
    pub point: Vec3,
    /// Its share in the unoccluded irradiance, up to a factor common to all samples of an aim.
    pub weight: f32,
}

impl Emitters {
    /// All emitters of a scene.
    ///
    /// Where the emission has a texture its elements are the triangles, else the input triangles: the closed form does not
    /// care how finely a plain panel is cut.
    pub(super) fn new(scene: &Scene, mesh: &PatchMesh) -> Self {
        let place_size = PLACE_SHARE * scene.bounds().extent().max(f32::MIN_POSITIVE);
        let mut by_surface: BTreeMap<SurfaceKey, Vec<EmitterTriangle>> = BTreeMap::new();
        for (t, root) in mesh.roots.iter().enumerate() {
            let triangle = &scene.triangles[t];
            let material = &scene.materials[triangle.material.index()];
            let Some(group) = material.group.filter(|_| material.is_emissive()) else { continue };
            let corners = triangle.vertices.map(|v| scene.vertices[v as usize].position);
            let place = ((corners[0] + corners[1] + corners[2]) / (3.0 * place_size)).floor().as_ivec3().to_array();
            let sides = if root.has_backs { 2 } else { 1 };
            for side in 0..sides {
                let first = root.first_element + side * root.num_elements;
                let surface = (group, triangle.instance.0, triangle.material.0, side == 1, place);
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

    /// Finds what a place should aim at.
    pub(super) fn aim(&self, point: Vec3, normal: Vec3, aims: &mut Aims) {
        aims.clear();
        for (e, emitter) in self.emitters.iter().enumerate() {
            let start = aims.contributions.len();
            let mut sum = Vec3::ZERO;
            for t in emitter.triangles.clone() {
                let irradiance = self.triangles[t].unoccluded(point, normal);
                let luminance = luminance(irradiance);
                if luminance > 0.0 {
                    sum += irradiance;
                    aims.contributions.push(Target { triangle: t, luminance, cumulative: 0.0 });
                }
            }
            if aims.contributions.len() > start {
                aims.seen.push((e, sum, start..aims.contributions.len()));
            }
        }
        let whole: f32 = aims.seen.iter().map(|(_, sum, _)| luminance(*sum)).sum();
        // Emitters are sorted by group, so the small ones of a group follow each other.
        for pooled in [false, true] {
            for seen in 0..aims.seen.len() {
                let (emitter, sum, contributions) = aims.seen[seen].clone();
                if (luminance(sum) < SMALL_SHARE * whole) == pooled {
                    aims.add(self.emitters[emitter].group, sum, contributions, pooled);
                }
            }
        }
    }

    /// The `index`-th point of a sequence spread evenly over what an aim contributes.
    pub(super) fn sample(&self, aims: &Aims, aim: &Aim, index: u32, viewpoint: (Vec3, Vec3, u32)) -> EmitterSample {
        let (point, normal, seed) = viewpoint;
        let targets = &aims.targets[aim.targets.clone()];
        let square = r2(index, seed);
        let whole = targets[targets.len() - 1].cumulative;
        let along = square.x * whole;
        let at = targets.partition_point(|target| target.cumulative <= along).min(targets.len() - 1);
        let target = targets[at];
        // What is left of the first coordinate is uniform within the chosen triangle.
        let within = (1.0 - (target.cumulative - along) / target.luminance).clamp(0.0, 1.0);
        let triangle = &self.triangles[target.triangle];
        let weights = triangle_from_square(Vec2::new(within, square.y));
        let [a, b, c] = triangle.corners;
        let on_emitter = interpolate([a, b, c], weights);
        let offset = on_emitter - point;
        let cosines = normal.dot(offset).max(0.0) * (-triangle.normal.dot(offset)).max(0.0);
        let density = target.luminance / (luminance(triangle.exitance) * triangle.area);
        let weight = cosines / (offset.length_squared().powi(2) * density).max(f32::MIN_POSITIVE);
        EmitterSample { point: on_emitter, weight }
    }
}

impl Aims {
    fn clear(&mut self) {
        self.aims.clear();
        self.targets.clear();
        self.seen.clear();
        self.contributions.clear();
    }

    /// Adds an emitter: an aim of its own, or a part of the last one where both are pooled and of one group.
    fn add(&mut self, group: GroupId, sum: Vec3, contributions: Range<usize>, pooled: bool) {
        let start = self.targets.len();
        let joins = pooled && self.aims.last().is_some_and(|aim| aim.group == group && aim.is_pool);
        let mut cumulative = if joins { self.targets[start - 1].cumulative } else { 0.0 };
        for target in &self.contributions[contributions] {
            cumulative += target.luminance;
            self.targets.push(Target { cumulative, ..*target });
        }
        match self.aims.last_mut().filter(|_| joins) {
            Some(pool) => {
                pool.unoccluded += sum;
                pool.targets.end = self.targets.len();
            }
            None => {
                let targets = start..self.targets.len();
                self.aims.push(Aim { group, unoccluded: sum, targets, is_pool: pooled });
            }
        }
    }
}

impl EmitterTriangle {
    fn new(corners: [Vec3; 3], exitance: Vec3) -> Option<Self> {
        let shines = exitance.max_element() > 0.0;
        shines.then(|| Self { corners, normal: normal_of(corners), exitance, area: area_of(corners) })
    }

    /// Irradiance at a point if nothing stood between.
    ///
    /// Equation: E = M x F(point, triangle) on the side that it faces.
    fn unoccluded(&self, point: Vec3, normal: Vec3) -> Vec3 {
        if self.normal.dot(point - self.corners[0]) <= 0.0 {
            return Vec3::ZERO;
        }
        self.exitance * point_to_polygon(point, normal, &self.corners)
    }
}
