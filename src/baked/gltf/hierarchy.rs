//! The tree of names that a bake keeps: nodes that show triangles, and those above them.

use std::ops::Range;

use crate::scene::Scene;

/// A node that is written.
pub(super) struct Branch {
    pub name: String,
    /// The branch above, which comes before.
    pub parent: Option<usize>,
    /// Its triangles, a range of the scene's; empty for a mere name.
    pub triangles: Range<usize>,
}

/// The branches of a scene; without a tree, every instance is one.
pub(super) fn branches(scene: &Scene) -> Vec<Branch> {
    if scene.nodes.is_empty() {
        let shown = scene.instances.iter().filter(|instance| !instance.triangles.is_empty());
        let branch = |instance: &crate::scene::Instance| Branch {
            name: instance.name.clone(),
            parent: None,
            triangles: instance.triangles.clone(),
        };
        return shown.map(branch).collect();
    }
    let triangles: Vec<_> = scene.nodes.iter().map(|node| triangles_of(scene, &node.instances)).collect();
    let mut is_kept: Vec<bool> = triangles.iter().map(|range| !range.is_empty()).collect();
    for n in (0..scene.nodes.len()).rev().filter(|&n| scene.nodes[n].parent.is_some()) {
        let parent = scene.nodes[n].parent.unwrap_or_default();
        is_kept[parent] |= is_kept[n];
    }
    let mut number = vec![0; scene.nodes.len()];
    let mut branches = Vec::new();
    for (n, node) in scene.nodes.iter().enumerate().filter(|&(n, _)| is_kept[n]) {
        number[n] = branches.len();
        let parent = node.parent.map(|parent| number[parent]);
        branches.push(Branch { name: name_of(scene, n), parent, triangles: triangles[n].clone() });
    }
    branches
}

/// Instances lie side by side, and so do their triangles.
fn triangles_of(scene: &Scene, instances: &Range<usize>) -> Range<usize> {
    let shown = &scene.instances[instances.clone()];
    match (shown.first(), shown.last()) {
        (Some(first), Some(last)) => first.triangles.start..last.triangles.end,
        _ => 0..0,
    }
}

/// A node without a name takes that of what it shows.
fn name_of(scene: &Scene, n: usize) -> String {
    let node = &scene.nodes[n];
    match scene.instances[node.instances.clone()].first() {
        Some(instance) if node.name.is_empty() => instance.name.clone(),
        _ => node.name.clone(),
    }
}
