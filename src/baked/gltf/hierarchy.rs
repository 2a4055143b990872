//! The node tree. A bake keeps it with its transforms, so that other programs find each mesh, light and camera in its
//! place.

use std::ops::Range;

use glam::{DAffine3, DMat3, Vec3};
use serde_json::{Value, json};

use super::json::named;
use crate::scene::{Instance, Scene, Transform, is_degenerate, is_placeable};

/// A transform is flat if the image of the unit cube has less than this share of the volume of a cube whose edge is the
/// longest edge of the image.
const FLAT: f64 = 1e-9;

/// A glTF node that is written.
pub(super) struct Branch {
    pub name: String,
    /// Index of the parent, an earlier branch. `None` for a root.
    pub parent: Option<usize>,
    /// Its triangles in the scene; empty if it has no mesh.
    pub triangles: Range<usize>,
    /// Index of its light, if it has one.
    pub light: Option<usize>,
    /// Index of its camera, if it has one.
    pub camera: Option<usize>,
    pub space: Space,
    transform: Transform,
}

/// The space of a node, in which its mesh is written.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Space {
    world_from_node: DAffine3,
    node_from_world: DAffine3,
}

/// Returns the branches of a scene. Every instance is a branch if the scene has no node tree.
pub(super) fn branches(scene: &Scene) -> Vec<Branch> {
    if scene.nodes.is_empty() {
        let shown = scene.instances.iter().filter(|instance| !instance.triangles.is_empty());
        return shown.map(Branch::of_instance).collect();
    }
    let mut branches: Vec<Branch> = Vec::with_capacity(scene.nodes.len());
    let mut world_from_nodes: Vec<DAffine3> = Vec::with_capacity(scene.nodes.len());
    for (n, node) in scene.nodes.iter().enumerate() {
        let above = node.parent.map_or(DAffine3::IDENTITY, |parent| world_from_nodes[parent]);
        let world_from_node = above * node.transform.parent_from_node();
        world_from_nodes.push(world_from_node);
        let is_kept = is_invertible(world_from_node.matrix3);
        // A flat transform has no inverse: such a node and all below it are written in world space.
        let written_above = node.parent.map_or(Space::WORLD, |parent| branches[parent].space);
        let transform = if is_kept { node.transform } else { Transform::from_affine(written_above.node_from_world) };
        branches.push(Branch {
            name: name_of(scene, n),
            parent: node.parent,
            triangles: triangles_of(scene, &node.instances),
            light: node.light.filter(|_| is_kept),
            camera: node.camera.filter(|_| is_kept),
            space: Space::of(written_above.world_from_node * transform.parent_from_node()),
            transform,
        });
    }
    move_to_world_what_rounding_would_lose(scene, &mut branches);
    branches
}

/// Moves each mesh whose slivers rounding would destroy in the space of its node to a new node of the same name in
/// world space. An example is a skinned mesh far from its node.
fn move_to_world_what_rounding_would_lose(scene: &Scene, branches: &mut Vec<Branch>) {
    for n in 0..branches.len() {
        if !branches[n].space.keeps(scene, &branches[n].triangles) {
            let triangles = std::mem::take(&mut branches[n].triangles);
            let instance = Instance { name: branches[n].name.clone(), triangles };
            branches.push(Branch::of_instance(&instance));
        }
    }
}

fn is_invertible(linear: DMat3) -> bool {
    let longest =
        [linear.x_axis, linear.y_axis, linear.z_axis].map(|axis| axis.length()).into_iter().fold(0.0, f64::max);
    linear.determinant().abs() > FLAT * longest.powi(3)
}

impl Branch {
    fn of_instance(instance: &Instance) -> Self {
        Self {
            name: instance.name.clone(),
            parent: None,
            triangles: instance.triangles.clone(),
            light: None,
            camera: None,
            space: Space::WORLD,
            transform: Transform::default(),
        }
    }

    /// Returns the node as a glTF object, without mesh, light, camera and children.
    pub(super) fn node(&self) -> Value {
        let mut node = named(&self.name);
        match self.transform {
            transform if transform == Transform::default() => {}
            Transform::Matrix(columns) => node["matrix"] = json!(columns),
            Transform::Parts { translation, rotation, scale } => {
                node["translation"] = json!(translation);
                node["rotation"] = json!(rotation);
                node["scale"] = json!(scale);
            }
        }
        node
    }
}

impl Space {
    const WORLD: Self = Self { world_from_node: DAffine3::IDENTITY, node_from_world: DAffine3::IDENTITY };

    fn of(world_from_node: DAffine3) -> Self {
        Self { world_from_node, node_from_world: world_from_node.inverse() }
    }

    /// Returns true if no triangle becomes degenerate by the transform into this space and back.
    fn keeps(&self, scene: &Scene, triangles: &Range<usize>) -> bool {
        let back = |v: u32| {
            let local = self.position(scene.vertices[v as usize].position);
            self.world_from_node.transform_point3(local.as_dvec3()).as_vec3()
        };
        let is_kept = |triangle: &crate::scene::Triangle| {
            let corners = triangle.vertices.map(back);
            corners.into_iter().all(is_placeable) && !is_degenerate(corners)
        };
        *self == Self::WORLD || scene.triangles[triangles.clone()].iter().all(is_kept)
    }

    /// Returns true if the transform inverts the winding of triangles.
    pub(super) fn is_mirrored(&self) -> bool {
        self.world_from_node.matrix3.determinant() < 0.0
    }

    /// Transforms a point from world space.
    pub(super) fn position(&self, in_world: Vec3) -> Vec3 {
        self.node_from_world.transform_point3(in_world.as_dvec3()).as_vec3()
    }

    /// Transforms a unit normal from world space.
    pub(super) fn normal(&self, in_world: Vec3) -> Vec3 {
        if self.world_from_node == DAffine3::IDENTITY {
            return in_world;
        }
        (self.world_from_node.matrix3.transpose() * in_world.as_dvec3()).normalize_or(in_world.as_dvec3()).as_vec3()
    }
}

/// Returns the triangles of consecutive instances, which are consecutive as well.
fn triangles_of(scene: &Scene, instances: &Range<usize>) -> Range<usize> {
    let shown = &scene.instances[instances.clone()];
    match (shown.first(), shown.last()) {
        (Some(first), Some(last)) => first.triangles.start..last.triangles.end,
        _ => 0..0,
    }
}

/// Returns the name of a node, or of its first instance if it has none.
fn name_of(scene: &Scene, n: usize) -> String {
    let node = &scene.nodes[n];
    match scene.instances[node.instances.clone()].first() {
        Some(instance) if node.name.is_empty() => instance.name.clone(),
        _ => node.name.clone(),
    }
}
