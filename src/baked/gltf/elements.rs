//! Records of a bake about its elements in the `extras` of primitives: bisection trees, and which backs belong to which
//! fronts.
//!
//! A primitive of a bake has an object `elements`:
//!
//! * `version`: 1. Records of other versions are ignored.
//! * `trees`: the bisection trees of its triangles, one after the other, each in preorder, one character a node: `a` to
//!   `p` is a regular tree of 2^0 to 2^15 triangles, all halved opposite their first corner; `0`, `1` or `2` is a
//!   triangle halved opposite that corner, and the trees of its two halves follow. The triangles of the primitive are
//!   the leaves, in this order. Corners are numbered in the order of the front: a back `[a, c, b]` is read as
//!   `[a, b, c]`.
//! * `back_of`: present if the triangles are backs. It is the number of primitives from their fronts to them: 1 if the
//!   fronts are the preceding primitive. Backs are in the order of their fronts, with corners `[a, c, b]` in place of
//!   `[a, b, c]`.
//!
//! Programs that change meshes may leave records that no longer fit, so all records are checked against the triangles.
//! If a record does not fit, its content is determined from the triangles, as for files without records.

use std::collections::HashMap;

use serde_json::{Value, json};

use crate::baked::BisectionTrees;
use crate::baked::bisection_trees::Tree;
use crate::base::ids::{InstanceId, TriangleId};
use crate::scene::{Back, ElementRecord, Scene};

/// Version of the records that are written and read.
const VERSION: u64 = 1;

/// The elements of a bake, to be recorded.
pub(super) struct Elements<'a> {
    scene: &'a Scene,
    /// Trees by the index of their first element; `None` if they are not known.
    trees: Option<HashMap<usize, Tree<'a>>>,
}

impl<'a> Elements<'a> {
    pub(super) fn new(scene: &'a Scene, trees: Option<&'a BisectionTrees>) -> Self {
        let trees = trees.filter(|trees| trees.num_elements() == scene.triangles.len());
        Self { scene, trees: trees.map(|trees| trees.iter().map(|tree| (tree.elements.start, tree)).collect()) }
    }

    /// Returns the record of a primitive of these triangles; `None` if there is nothing to record. `fronts` are the
    /// triangles of the preceding primitive if these triangles may be their backs.
    pub(super) fn record(&self, triangles: &[TriangleId], fronts: Option<&[TriangleId]>) -> Option<Value> {
        let mut record = json!({ "version": VERSION });
        if let Some(trees) = &self.trees {
            let trees: BisectionTrees = triangles.iter().filter_map(|t| trees.get(&t.index()).cloned()).collect();
            record["trees"] = json!(trees.to_string());
        }
        if fronts.is_some_and(|fronts| self.are_backs(triangles, fronts)) {
            record["back_of"] = json!(1);
        }
        (record.as_object()?.len() > 1).then_some(record)
    }

    fn are_backs(&self, triangles: &[TriangleId], fronts: &[TriangleId]) -> bool {
        let pairs = fronts.iter().zip(triangles);
        let is_pair = |(&front, &back)| self.scene.sides.back_of(front) == Some(Back::flipped(back));
        triangles.len() == fronts.len() && pairs.into_iter().all(is_pair)
    }
}

/// Trees and pairs of fronts and backs of a loaded scene, as far as the file has them.
#[derive(Default)]
pub(super) struct Recorded {
    /// The trees; `None` if a triangle has none or they do not fit.
    pub trees: Option<BisectionTrees>,
    /// Fronts with their backs; empty if a back has no front or they do not fit.
    pub pairs: Vec<(TriangleId, Back)>,
    /// Messages to the user about records that do not fit.
    pub notes: Vec<String>,
}

/// Reads the records of a loaded scene, and checks them against its triangles.
pub(super) fn read(scene: &Scene, records: &[(InstanceId, ElementRecord)]) -> Recorded {
    let mut recorded = Recorded::default();
    if records.is_empty() {
        return recorded;
    }
    if records.iter().any(|(_, record)| record.version != VERSION) {
        let note = "elements are recorded in another version; trees and backs are found from the triangles";
        return Recorded { notes: vec![note.to_owned()], ..recorded };
    }
    match trees(scene, records) {
        Ok(trees) => recorded.trees = trees,
        Err(problem) => recorded.notes.push(format!("{problem}; bisection trees are found from the triangles")),
    }
    match pairs(scene, records) {
        Ok(pairs) => recorded.pairs = pairs,
        Err(problem) => recorded.notes.push(format!("{problem}; backs are found by their positions")),
    }
    recorded
}

/// Returns the trees of all instances. `None` if an instance has no record of them.
fn trees(scene: &Scene, records: &[(InstanceId, ElementRecord)]) -> Result<Option<BisectionTrees>, String> {
    let by_instance: HashMap<usize, &ElementRecord> =
        records.iter().map(|(instance, record)| (instance.index(), record)).collect();
    let mut all = BisectionTrees::default();
    for (i, instance) in scene.instances.iter().enumerate() {
        let Some(text) = by_instance.get(&i).and_then(|record| record.trees.as_deref()) else {
            if instance.triangles.is_empty() {
                continue;
            }
            return Ok(None);
        };
        let trees = BisectionTrees::parse(text)
            .filter(|trees| trees.num_elements() == instance.triangles.len())
            .ok_or_else(|| format!("the recorded trees of {:?} do not have its triangles as leaves", instance.name))?;
        all.append(trees);
    }
    let fits = |tree: Tree<'_>| {
        let is_back = scene.sides.is_back(TriangleId::new(tree.elements.start));
        tree.visit(is_back, |e| ((), scene.triangles[e].vertices), |_, _| ()).is_ok()
    };
    if all.num_elements() != scene.triangles.len() || !all.iter().all(fits) {
        return Err("the recorded trees do not fit the edges of the triangles".to_owned());
    }
    Ok(Some(all))
}

/// Returns the fronts with their backs; empty if a back has no record of its front.
fn pairs(scene: &Scene, records: &[(InstanceId, ElementRecord)]) -> Result<Vec<(TriangleId, Back)>, String> {
    let mut pairs = Vec::new();
    for (instance, record) in records {
        let Some(back_of) = record.back_of else { continue };
        let backs = &scene.instances[instance.index()];
        let fronts = instance.index().checked_sub(back_of).filter(|_| back_of > 0).map(|i| &scene.instances[i]);
        let pair = |(front, back): (usize, usize)| {
            let (front, back) = (TriangleId::new(front), TriangleId::new(back));
            let ([a, b, c], corners) = (scene.corners(front), scene.corners(back));
            let is_pair = !scene.sides.is_back(front) && scene.sides.is_back(back) && corners == [a, c, b];
            is_pair.then(|| (front, Back::flipped(back)))
        };
        let found: Option<Vec<_>> = fronts
            .filter(|fronts| fronts.triangles.len() == backs.triangles.len())
            .and_then(|fronts| fronts.triangles.clone().zip(backs.triangles.clone()).map(pair).collect());
        pairs.extend(
            found.ok_or_else(|| format!("the recorded fronts of {:?} are not those of its backs", backs.name))?,
        );
    }
    let num_fronts = pairs.iter().map(|(front, _)| front).collect::<std::collections::HashSet<_>>().len();
    if num_fronts != pairs.len() {
        return Err("two backs are recorded for one front".to_owned());
    }
    if pairs.len() != scene.sides.num_unpaired() {
        return Ok(Vec::new());
    }
    Ok(pairs)
}
