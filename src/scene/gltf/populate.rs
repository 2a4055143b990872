//! What hangs on the nodes: meshes are placed, lights and cameras taken along; the tree itself is not kept.

use std::collections::HashMap;

use glam::DAffine3;
use gltf::json::mesh::Mesh;
use gltf::json::{Index, Node};

use super::document::Document;
use super::error::Cause;
use super::geometry::Geometry;
use super::tree::PlacedNode;
use super::{devices, place};
use crate::base::ids::MaterialId;
use crate::scene::{Material, Scene};

/// Fills a scene whose materials are there already.
pub(super) struct Population<'a> {
    document: &'a Document<'a>,
    scene: Scene,
    light_definitions: Vec<usize>,
    geometries: HashMap<(usize, usize), Option<Geometry>>,
    default_material: Option<MaterialId>,
    oddities: Oddities,
}

/// What was passed over, counted for the notes.
#[derive(Default)]
struct Oddities {
    not_triangles: usize,
    morphed: usize,
    skinned: usize,
}

impl<'a> Population<'a> {
    /// Ready to add nodes.
    pub fn new(document: &'a Document<'a>, scene: Scene) -> Self {
        Self {
            document,
            scene,
            light_definitions: Vec::new(),
            geometries: HashMap::new(),
            default_material: None,
            oddities: Oddities::default(),
        }
    }

    /// Adds what hangs on a node.
    pub fn add(&mut self, placed: &PlacedNode<'_>) -> Result<(), Cause> {
        let PlacedNode { index, node, world_from_node } = *placed;
        let user = || format!("node {index}");
        if let Some(mesh) = node.mesh {
            self.place_mesh(node, mesh, world_from_node, user)?;
        }
        if let Some(camera) = node.camera {
            let camera = self.document.find(camera, "camera", user)?;
            let name = name_of([&node.name, &camera.name], "camera", self.scene.cameras.len());
            self.scene.cameras.push(devices::camera(camera, name, world_from_node)?);
        }
        if let Some(light) = node.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref()) {
            self.place_light(node, light.light, world_from_node, user)?;
        }
        Ok(())
    }

    fn place_mesh(
        &mut self,
        node: &Node,
        index: Index<Mesh>,
        world_from_node: DAffine3,
        user: impl Fn() -> String,
    ) -> Result<(), Cause> {
        let mesh = self.document.find(index, "mesh", user)?;
        self.oddities.skinned += usize::from(node.skin.is_some());
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            self.oddities.morphed += usize::from(primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty()));
            let key = (index.value(), p);
            if !self.geometries.contains_key(&key) {
                let geometry = Geometry::read(self.document, primitive, &format!("mesh {index}, primitive {p}"))?;
                self.geometries.insert(key, geometry);
            }
            let Some(geometry) = &self.geometries[&key] else {
                self.oddities.not_triangles += 1;
                continue;
            };
            let material = match geometry.material {
                Some(material) => MaterialId::new(material),
                None => default_material(&mut self.default_material, &mut self.scene.materials),
            };
            let name = name_of([&node.name, &mesh.name], "mesh", index.value());
            place::place(&mut self.scene, geometry, world_from_node, name, material)?;
        }
        Ok(())
    }

    fn place_light(
        &mut self,
        node: &Node,
        index: Index<devices::LightDefinition>,
        world_from_node: DAffine3,
        user: impl Fn() -> String,
    ) -> Result<(), Cause> {
        let definition = self.document.find(index, "light", user)?;
        let name = name_of([&node.name, &definition.name], "light", index.value());
        match devices::light(definition, &name, world_from_node)? {
            Some(light) => {
                self.scene.lights.push(light);
                self.light_definitions.push(index.value());
            }
            None => self.scene.notes.push(format!("light {name:?} has no intensity and is left out")),
        }
        Ok(())
    }

    /// The filled scene with notes on what was passed over, and the light definition behind each of its lights `[l]`.
    pub fn finish(mut self) -> (Scene, Vec<usize>) {
        let counts = [
            ("primitives of points or lines, or without positions, ignored", self.oddities.not_triangles),
            ("primitives with morph targets, shown in their base shape", self.oddities.morphed),
            ("skinned meshes, shown unposed", self.oddities.skinned),
            ("triangles without area, dropped", self.scene.dropped_triangles),
        ];
        let notes = counts.into_iter().filter(|&(_, count)| count > 0).map(|(what, count)| format!("{what}: {count}"));
        self.scene.notes.extend(notes);
        (self.scene, self.light_definitions)
    }
}

/// The glTF default material, added to the scene the first time it is needed.
fn default_material(id: &mut Option<MaterialId>, materials: &mut Vec<Material>) -> MaterialId {
    *id.get_or_insert_with(|| {
        materials.push(Material { name: "glTF default".to_owned(), ..Material::default() });
        MaterialId::new(materials.len() - 1)
    })
}

fn name_of(names: [&Option<String>; 2], kind: &str, index: usize) -> String {
    let given = names.into_iter().flatten().find(|name| !name.trim().is_empty());
    given.cloned().unwrap_or_else(|| format!("{kind} {index}"))
}

#[cfg(test)]
mod tests {
    use super::super::fixture::Fixture;

    #[test]
    fn a_primitive_without_material_gets_the_white_metal_of_the_standard() {
        let scene = Fixture::triangle().load();
        assert_eq!((scene.materials.len(), scene.materials[0].metallic), (1, 1.0));
    }
}
