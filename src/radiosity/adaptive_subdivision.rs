//! Adaptive subdivision: elements are halved where light is not linear between their corners.
//!
//! Light is sampled at the middle of every edge. If it differs from the mean of the ends, as at the edge of a shadow,
//! the edge is halved, and the sample becomes the light of the new vertex. The next round tests only new edges, so the
//! work follows the shadows and not the area. Patches stay unchanged: elements receive, patches shoot.
//!
//! Source: Cohen, Greenberg, Immel, Brock 1986 (elements within patches); Vedel, Puech 1991, "A testbed for adaptive
//! subdivision in progressive radiosity" (the test at midpoints).

use glam::Vec3;
use rustc_hash::{FxHashMap, FxHashSet};

use super::field::Field;
use super::viewpoints::Viewpoints;
use crate::base::colour::luminance;
use crate::base::ids::ElementId;
use crate::form_factor::Viewpoint;
use crate::patch::{LightKey, LightVertex, MeshError, MeshSettings, PatchMesh, Splits, light_key};
use crate::scene::Scene;

/// How far elements are subdivided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SubdivisionSettings {
    /// An edge is halved if the light at its midpoint deviates by more than this from the mean of its ends, as a share
    /// of the light at the midpoint or of that mean, whichever is larger.
    pub max_error: f32,
    /// Edges shorter than this, in metres, are halved only at larger deviations, in inverse proportion to their length.
    /// Small elements pay off at the edge of a hard shadow, but not at that of a soft one.
    pub short_edge: f32,
    /// Edges shorter than twice this length, in metres, are never halved.
    pub min_edge: f32,
    /// Approximate limit of the number of elements.
    pub max_elements: usize,
}

/// Light sampled at viewpoints.
pub struct SampledLight {
    /// Irradiance `[viewpoint][column]`, lux per channel; the caller decides what the columns are.
    pub light: Field,
    /// False if the viewpoint lies inside a solid, where the light has no meaning.
    pub is_open: Vec<bool>,
}

/// The subdivision of a scene so far.
pub struct AdaptiveSubdivision<'a> {
    scene: &'a Scene,
    sizes: MeshSettings,
    viewpoints: Viewpoints,
    splits: Splits,
}

impl<'a> AdaptiveSubdivision<'a> {
    /// Subdivides the scene into elements of one size.
    ///
    /// # Errors
    /// Returns an error if the mesh would be too large.
    pub fn new(scene: &'a Scene, sizes: MeshSettings) -> Result<(Self, PatchMesh), MeshError> {
        let subdivision = Self { scene, sizes, viewpoints: Viewpoints::new(scene), splits: Splits::default() };
        Ok((subdivision, PatchMesh::new(scene, &sizes)?))
    }

    /// Halves edges of `mesh`, whose light vertices have the light `sampled`, until light is linear along all of them.
    /// Errors well below the luminance `floor` are ignored; `evaluate` samples the light of further viewpoints.
    ///
    /// # Errors
    /// Returns an error if `evaluate` does, or if the mesh would be too large.
    pub fn refine<E: From<MeshError>>(
        &mut self,
        mesh: PatchMesh,
        sampled: SampledLight,
        settings: &SubdivisionSettings,
        floor: f32,
        evaluate: &mut dyn FnMut(&[Viewpoint]) -> Result<SampledLight, E>,
    ) -> Result<(PatchMesh, SampledLight), E> {
        let (mut mesh, mut sampled) = (mesh, sampled);
        let mut known = KnownLight::default();
        known.add(mesh.light_vertices.iter().map(key_of), &sampled);
        let mut tested = FxHashSet::default();
        loop {
            let room = settings.max_elements.saturating_sub(mesh.elements.len()) / ELEMENTS_A_SPLIT;
            let edges = untested_edges(&mesh, settings.min_edge, &mut tested);
            if edges.is_empty() || room == 0 {
                return Ok((mesh, sampled));
            }
            // Sample the middles.
            let viewpoints = edges.iter().map(|edge| edge.viewpoint(&mesh, &self.viewpoints));
            let middles = evaluate(&viewpoints.collect::<Vec<_>>())?;
            known.add(edges.iter().map(|edge| key_of(&edge.middle(&mesh))), &middles);
            // Halve the edges that deviate most.
            let mut deviating: Vec<(f32, &Edge)> = (0..)
                .zip(&edges)
                .filter_map(|(i, edge)| Some((edge.deviation(&sampled, &middles, i, floor)?, edge)))
                .filter(|(deviation, edge)| {
                    *deviation > settings.max_error * edge.strictness(&mesh, settings.short_edge)
                })
                .collect();
            if deviating.is_empty() {
                return Ok((mesh, sampled));
            }
            deviating.sort_by(|a, b| b.0.total_cmp(&a.0));
            for (_, edge) in deviating.iter().take(room) {
                let [a, b] = edge.ends.map(|l| mesh.light_vertices[l].position);
                self.splits.insert(a, b);
            }
            mesh = PatchMesh::refined(self.scene, &self.sizes, &mut self.splits)?;
            sampled = self.light_of(&mesh, &mut known, evaluate)?;
        }
    }

    /// Returns the light of all light vertices. Light that is not known yet is sampled.
    fn light_of<E>(
        &self,
        mesh: &PatchMesh,
        known: &mut KnownLight,
        evaluate: &mut dyn FnMut(&[Viewpoint]) -> Result<SampledLight, E>,
    ) -> Result<SampledLight, E> {
        let keys: Vec<LightKey> = mesh.light_vertices.iter().map(key_of).collect();
        let missing: Vec<usize> = (0..keys.len()).filter(|&l| !known.index_of.contains_key(&keys[l])).collect();
        let viewpoints = self.viewpoints.at_light_vertices(mesh);
        let viewpoints: Vec<Viewpoint> = missing.iter().map(|&l| viewpoints[l]).collect();
        let found = evaluate(&viewpoints)?;
        known.add(missing.iter().map(|&l| keys[l]), &found);
        Ok(known.at(&keys))
    }
}

/// Number of elements that halving an edge adds, including those of the further halvings it causes.
const ELEMENTS_A_SPLIT: usize = 4;

/// An edge between light vertices `[l]`, and the elements beside it on one side of a surface.
struct Edge {
    ends: [usize; 2],
    elements: Vec<ElementId>,
}

impl Edge {
    /// Returns the light vertex that halving the edge creates.
    fn middle(&self, mesh: &PatchMesh) -> LightVertex {
        let [a, b] = self.ends.map(|l| mesh.light_vertices[l]);
        LightVertex::between(a, b)
    }

    fn viewpoint(&self, mesh: &PatchMesh, viewpoints: &Viewpoints) -> Viewpoint {
        let middle = self.middle(mesh);
        let seed = middle.position.to_array().map(f32::to_bits).into_iter().fold(0, |seed, bits| seed ^ bits);
        viewpoints.at_vertex(mesh, &middle, self.elements.iter().copied(), seed)
    }

    /// Factor by which the largest error is multiplied for this edge.
    fn strictness(&self, mesh: &PatchMesh, short_edge: f32) -> f32 {
        let [a, b] = self.ends.map(|l| mesh.light_vertices[l].position);
        (short_edge / a.distance(b)).max(1.0)
    }

    /// Returns the relative deviation of the midpoint from the mean of the ends, or `None` if one of the three lies
    /// inside a solid.
    fn deviation(&self, ends: &SampledLight, middles: &SampledLight, at: usize, floor: f32) -> Option<f32> {
        let [a, b] = self.ends;
        if !(ends.is_open[a] && ends.is_open[b] && middles.is_open[at]) {
            return None;
        }
        let (middle, mean) = (middles.light.total(at), 0.5 * (ends.light.total(a) + ends.light.total(b)));
        Some(luminance((middle - mean).abs()) / (luminance(middle).max(luminance(mean)) + floor))
    }
}

/// Returns the edges that are long enough and have not been tested.
fn untested_edges(mesh: &PatchMesh, min_edge: f32, tested: &mut FxHashSet<[LightKey; 2]>) -> Vec<Edge> {
    let mut index_of: FxHashMap<[usize; 2], usize> = FxHashMap::default();
    let mut edges: Vec<Edge> = Vec::new();
    for (e, element) in mesh.elements.iter().enumerate() {
        let corners = mesh.light_vertices_of(element);
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            let [from, to] = [a, b].map(|l| mesh.light_vertices[l].position);
            if from.distance(to) < 2.0 * min_edge {
                continue;
            }
            let ends = [a.min(b), a.max(b)];
            let index = *index_of.entry(ends).or_insert_with(|| {
                edges.push(Edge { ends, elements: Vec::new() });
                edges.len() - 1
            });
            edges[index].elements.push(ElementId::new(e));
        }
    }
    edges.retain(|edge| {
        let mut keys = edge.ends.map(|l| key_of(&mesh.light_vertices[l]));
        keys.sort_unstable_by_key(|(position, normal)| (*position, normal.to_array()));
        tested.insert(keys)
    });
    edges
}

/// Light that has been sampled, by position and normal.
#[derive(Default)]
struct KnownLight {
    index_of: FxHashMap<LightKey, usize>,
    num_columns: usize,
    light: Vec<Vec3>,
    is_open: Vec<bool>,
}

impl KnownLight {
    fn add(&mut self, keys: impl Iterator<Item = LightKey>, sampled: &SampledLight) {
        self.num_columns = sampled.light.num_groups();
        for (i, key) in keys.enumerate() {
            let next = self.is_open.len();
            if *self.index_of.entry(key).or_insert(next) == next {
                self.light.extend(sampled.light.at(i));
                self.is_open.push(sampled.is_open[i]);
            }
        }
    }

    fn at(&self, keys: &[LightKey]) -> SampledLight {
        let indices = || keys.iter().map(|key| self.index_of[key]);
        let columns = |i: usize| &self.light[i * self.num_columns..(i + 1) * self.num_columns];
        let light = Field::from_values(self.num_columns, indices().flat_map(columns).copied().collect());
        SampledLight { light, is_open: indices().map(|i| self.is_open[i]).collect() }
    }
}

fn key_of(vertex: &LightVertex) -> LightKey {
    light_key(vertex.position, vertex.normal)
}
