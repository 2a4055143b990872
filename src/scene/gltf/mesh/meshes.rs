//! Reads and places the meshes of nodes. Each primitive is read once, and placed once per node and instance.

use std::collections::HashMap;

use glam::DAffine3;
use gltf::json::Index;
use gltf::json::mesh::{Mesh, Primitive};

use super::geometry::Geometry;
use super::{morph, placement, skin};
use crate::base::ids::MaterialId;
use crate::scene::gltf::error::Cause;
use crate::scene::gltf::file::document::Document;
use crate::scene::gltf::material::variant;
use crate::scene::gltf::node::instancing;
use crate::scene::gltf::node::tree::{PlacedNode, name_of};
use crate::scene::{Material, NamedNode, Scene, Transform};

/// Key of a primitive that has been read: mesh, primitive, and the bits of its morph weights.
type Key = (usize, usize, Vec<u32>);

/// Reads and places meshes.
pub(crate) struct Meshes<'a> {
    document: &'a Document<'a>,
    /// Texture coordinate sets of each material of the file `[m]`.
    uv_sets: Vec<[u32; 2]>,
    variant: Option<usize>,
    world_from_node: HashMap<usize, DAffine3>,
    geometries: HashMap<Key, Option<Geometry>>,
    default_material: Option<MaterialId>,
    /// Number of ignored primitives without triangles.
    pub not_triangles: usize,
}

impl<'a> Meshes<'a> {
    /// Prepares placing the meshes of `nodes`; `variant` is the index of the material variant in use.
    pub fn new(
        document: &'a Document<'a>,
        nodes: &[PlacedNode<'_>],
        uv_sets: Vec<[u32; 2]>,
        variant: Option<usize>,
    ) -> Self {
        Self {
            document,
            uv_sets,
            variant,
            world_from_node: skin::world_from_nodes(nodes),
            geometries: HashMap::new(),
            default_material: None,
            not_triangles: 0,
        }
    }

    /// Adds all instances of a node's mesh to the scene; `scene_node` is the index of the node in [`Scene::nodes`].
    ///
    /// # Errors
    /// Returns an error if the mesh or anything that it refers to is missing or invalid.
    pub fn place(
        &mut self,
        scene: &mut Scene,
        scene_node: usize,
        placed: &PlacedNode<'_>,
        index: Index<Mesh>,
    ) -> Result<(), Cause> {
        let PlacedNode { index: node_index, node, .. } = *placed;
        let mesh = self.document.find(index, "mesh", || format!("node {node_index}"))?;
        let name = name_of([&node.name, &mesh.name], "mesh", index.value());
        let transforms = instancing::transforms(self.document, node, node_index)?;
        for node_from_mesh in &transforms {
            let first = scene.instances.len();
            for (p, primitive) in mesh.primitives.iter().enumerate() {
                let weights = morph::weights(node, mesh);
                self.place_primitive(scene, placed, (index, p, primitive), weights, *node_from_mesh, &name)?;
            }
            let instances = first..scene.instances.len();
            if transforms.len() == 1 {
                scene.nodes[scene_node].instances = instances;
            } else {
                let transform = Transform::from_affine(*node_from_mesh);
                let node = NamedNode {
                    name: name.clone(),
                    parent: Some(scene_node),
                    transform,
                    instances,
                    ..NamedNode::default()
                };
                scene.nodes.push(node);
            }
        }
        Ok(())
    }

    fn place_primitive(
        &mut self,
        scene: &mut Scene,
        placed: &PlacedNode<'_>,
        (mesh, p, primitive): (Index<Mesh>, usize, &Primitive),
        weights: &[f32],
        node_from_mesh: DAffine3,
        name: &str,
    ) -> Result<(), Cause> {
        let what = format!("mesh {mesh}, primitive {p}");
        let material = self.material(primitive, &what)?;
        let key = (mesh.value(), p, weights.iter().map(|weight| weight.to_bits()).collect());
        if !self.geometries.contains_key(&key) {
            let uv_sets = material.map_or([0, 1], |material| self.uv_sets[material]);
            let geometry = Geometry::read(self.document, primitive, uv_sets, weights, &what)?;
            self.geometries.insert(key.clone(), geometry);
        }
        let Some(geometry) = &self.geometries[&key] else {
            self.not_triangles += 1;
            return Ok(());
        };
        let material = match material {
            Some(material) => MaterialId::new(material),
            None => default_material(&mut self.default_material, &mut scene.materials),
        };
        let name = name.to_owned();
        if let Some(skin) = skin::of_node(placed.node, geometry) {
            let user = || format!("node {}", placed.index);
            let joints = skin::world_from_joints(self.document, skin, &self.world_from_node, user)?;
            let posed = skin::posed(geometry, &joints)?;
            return placement::place(scene, &posed, DAffine3::IDENTITY, name, material);
        }
        placement::place(scene, geometry, placed.world_from_node * node_from_mesh, name, material)
    }

    /// Returns the index of the material of a primitive, after a check that the material exists.
    fn material(&self, primitive: &Primitive, name: &str) -> Result<Option<usize>, Cause> {
        let material = variant::material(primitive, self.variant, name)?;
        if let Some(material) = material {
            let index = Index::<gltf::json::Material>::new(material as u32);
            self.document.find(index, "material", || name.to_owned())?;
        }
        Ok(material)
    }
}

/// Returns the default material of glTF. Adds it to the scene if it is not there yet.
fn default_material(id: &mut Option<MaterialId>, materials: &mut Vec<Material>) -> MaterialId {
    *id.get_or_insert_with(|| {
        materials.push(Material { name: "glTF default".to_owned(), ..Material::default() });
        MaterialId::new(materials.len() - 1)
    })
}

#[cfg(test)]
mod tests {
    use crate::scene::gltf::fixture::Fixture;

    #[test]
    fn a_primitive_without_material_gets_the_default_material_of_gltf() {
        let scene = Fixture::triangle().load();
        assert_eq!((scene.materials.len(), scene.materials[0].metallic), (1, 1.0));
    }
}
