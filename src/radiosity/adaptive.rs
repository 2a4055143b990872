//! Adaptive subdivision: elements are halved where light is not linear between their corners.
//!
//! The middle of every edge is looked at. Where its light differs from the mean of the ends', as it does at the edge of a
//! shadow or close to a contact, the edge is halved, and what was found there is the light of the new vertex. Only edges
//! that are new are looked at again, so the work follows the shadows and not the area. Patches stay as they are: elements
//! receive, patches shoot.
//!
//! Source: Cohen, Greenberg, Immel, Brock 1986 (elements within patches); Vedel, Puech 1991, "A testbed for adaptive
//! subdivision in progressive radiosity" (the test at midpoints).

use glam::Vec3;
use rustc_hash::{FxHashMap, FxHashSet};

use super::field::Field;
use super::sites::Sites;
use crate::base::colour::luminance;
use crate::base::ids::ElementId;
use crate::form_factor::Viewpoint;
use crate::patch::{LightKey, LightVertex, MeshError, MeshSettings, PatchMesh, Splits, light_key};
use crate::scene::Scene;

/// How far elements are refined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefineSettings {
    /// Deviation from the mean of the ends at which an edge is halved, relative to the light there.
    pub max_error: f32,
    /// Edges shorter than this must deviate more, in inverse proportion to their length, metres: a hard edge of a shadow
    /// is worth small elements, a soft one is not.
    pub short_edge: f32,
    /// Edges shorter than twice this stay whole, metres.
    pub min_edge: f32,
    /// About the most elements that there may be.
    pub max_elements: usize,
}

/// Light at places, and whether they lie in the open.
pub struct Lit {
    /// Irradiance in columns that belong to the caller, lux per channel.
    pub light: Field,
    /// False inside something, where the light means nothing.
    pub is_open: Vec<bool>,
}

/// How a scene is cut so far.
pub struct Cut<'a> {
    scene: &'a Scene,
    sizes: MeshSettings,
    sites: Sites,
    splits: Splits,
}

impl<'a> Cut<'a> {
    /// The scene cut into elements of one size.
    ///
    /// # Errors
    /// It cannot be cut.
    pub fn new(scene: &'a Scene, sizes: MeshSettings) -> Result<(Self, PatchMesh), MeshError> {
        let cut = Self { scene, sizes, sites: Sites::new(scene), splits: Splits::default() };
        Ok((cut, PatchMesh::new(scene, &sizes)?))
    }

    /// Halves edges of `mesh`, whose light vertices are lit as `lit`, until light is linear along all of them. `floor` is
    /// luminance beside which errors do not count, `evaluate` finds the light of further places.
    ///
    /// # Errors
    /// Those of `evaluate`, or the mesh grows beyond all bounds.
    pub fn refine<E: From<MeshError>>(
        &mut self,
        mesh: PatchMesh,
        lit: Lit,
        settings: &RefineSettings,
        floor: f32,
        evaluate: &mut dyn FnMut(&[Viewpoint]) -> Result<Lit, E>,
    ) -> Result<(PatchMesh, Lit), E> {
        let (mut mesh, mut lit) = (mesh, lit);
        let mut known = Known::default();
        known.add(mesh.light_vertices.iter().map(key_of), &lit);
        let mut tested = FxHashSet::default();
        loop {
            let room = settings.max_elements.saturating_sub(mesh.elements.len()) / ELEMENTS_A_SPLIT;
            let edges = untested_edges(&mesh, settings.min_edge, &mut tested);
            if edges.is_empty() || room == 0 {
                return Ok((mesh, lit));
            }
            // Look at the middles.
            let viewpoints: Vec<Viewpoint> = edges.iter().map(|edge| edge.viewpoint(&mesh, &self.sites)).collect();
            let middles = evaluate(&viewpoints)?;
            known.add(edges.iter().map(|edge| key_of(&edge.middle(&mesh))), &middles);
            // Halve those that deviate most.
            let mut wanted: Vec<(f32, &Edge)> = (0..)
                .zip(&edges)
                .filter_map(|(i, edge)| Some((edge.deviation(&lit, &middles, i, floor)?, edge)))
                .filter(|(deviation, edge)| {
                    *deviation > settings.max_error * edge.strictness(&mesh, settings.short_edge)
                })
                .collect();
            if wanted.is_empty() {
                return Ok((mesh, lit));
            }
            wanted.sort_by(|a, b| b.0.total_cmp(&a.0));
            for (_, edge) in wanted.iter().take(room) {
                let [a, b] = edge.ends.map(|l| mesh.light_vertices[l].position);
                self.splits.insert(a, b);
            }
            mesh = PatchMesh::refined(self.scene, &self.sizes, &mut self.splits)?;
            lit = self.light_of(&mesh, &mut known, evaluate)?;
        }
    }

    /// The light of all light vertices, found where it is not known.
    fn light_of<E>(
        &self,
        mesh: &PatchMesh,
        known: &mut Known,
        evaluate: &mut dyn FnMut(&[Viewpoint]) -> Result<Lit, E>,
    ) -> Result<Lit, E> {
        let keys: Vec<LightKey> = mesh.light_vertices.iter().map(key_of).collect();
        let missing: Vec<usize> = (0..keys.len()).filter(|&l| !known.index_of.contains_key(&keys[l])).collect();
        let sites = self.sites.of_light_vertices(mesh);
        let viewpoints: Vec<Viewpoint> = missing.iter().map(|&l| sites[l]).collect();
        let found = evaluate(&viewpoints)?;
        known.add(missing.iter().map(|&l| keys[l]), &found);
        Ok(known.at(&keys))
    }
}

/// Elements that a halved edge adds, those that follow included.
const ELEMENTS_A_SPLIT: usize = 4;

/// An edge between light vertices `[l]`, seen by the elements of one side of a surface.
struct Edge {
    ends: [usize; 2],
    elements: Vec<ElementId>,
}

impl Edge {
    /// The light vertex that halving would make.
    fn middle(&self, mesh: &PatchMesh) -> LightVertex {
        let [a, b] = self.ends.map(|l| mesh.light_vertices[l]);
        LightVertex::between(a, b)
    }

    fn viewpoint(&self, mesh: &PatchMesh, sites: &Sites) -> Viewpoint {
        let middle = self.middle(mesh);
        let seed = middle.position.to_array().map(f32::to_bits).into_iter().fold(0, |seed, bits| seed ^ bits);
        sites.beside(mesh, &middle, self.elements.iter().copied(), seed)
    }

    /// How many times the largest error the edge must deviate by.
    fn strictness(&self, mesh: &PatchMesh, short_edge: f32) -> f32 {
        let [a, b] = self.ends.map(|l| mesh.light_vertices[l].position);
        (short_edge / a.distance(b)).max(1.0)
    }

    /// How far the middle is from the mean of the ends; none where one of them lies inside something.
    fn deviation(&self, lit: &Lit, middles: &Lit, at: usize, floor: f32) -> Option<f32> {
        let [a, b] = self.ends;
        if !(lit.is_open[a] && lit.is_open[b] && middles.is_open[at]) {
            return None;
        }
        let (middle, mean) = (middles.light.total(at), 0.5 * (lit.light.total(a) + lit.light.total(b)));
        Some(luminance((middle - mean).abs()) / (luminance(middle).max(luminance(mean)) + floor))
    }
}

/// Edges that are long enough and have not been looked at.
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
        keys.sort_unstable_by_key(|(place, normal)| (*place, normal.to_array()));
        tested.insert(keys)
    });
    edges
}

/// Light that has been found, by place and normal.
#[derive(Default)]
struct Known {
    index_of: FxHashMap<LightKey, usize>,
    num_columns: usize,
    light: Vec<Vec3>,
    is_open: Vec<bool>,
}

impl Known {
    fn add(&mut self, keys: impl Iterator<Item = LightKey>, lit: &Lit) {
        self.num_columns = lit.light.num_groups();
        for (i, key) in keys.enumerate() {
            let next = self.is_open.len();
            if *self.index_of.entry(key).or_insert(next) == next {
                self.light.extend(lit.light.at(i));
                self.is_open.push(lit.is_open[i]);
            }
        }
    }

    fn at(&self, keys: &[LightKey]) -> Lit {
        let indices = || keys.iter().map(|key| self.index_of[key]);
        let columns = |i: usize| &self.light[i * self.num_columns..(i + 1) * self.num_columns];
        let light = Field::from_values(self.num_columns, indices().flat_map(columns).copied().collect());
        Lit { light, is_open: indices().map(|i| self.is_open[i]).collect() }
    }
}

fn key_of(vertex: &LightVertex) -> LightKey {
    light_key(vertex.position, vertex.normal)
}
