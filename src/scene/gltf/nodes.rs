//! The node tree, walked once: meshes are placed, lights and cameras taken along; the tree itself is not kept.

use std::collections::HashMap;

use glam::{DAffine3, DMat4, DQuat, DVec3};
use gltf::json::mesh::Mesh;
use gltf::json::{Index, Node};

use super::document::Document;
use super::error::Cause;
use super::geometry::Geometry;
use super::{devices, place};
use crate::base::ids::MaterialId;
use crate::scene::{Material, Scene};

/// Deepest node tree that is walked.
const MAX_DEPTH: usize = 256;

/// Walks the tree and fills a scene whose materials are there already.
pub(super) struct Walk<'a> {
    document: &'a Document<'a>,
    scene: Scene,
    light_definitions: Vec<usize>,
    geometries: HashMap<(usize, usize), Option<Geometry>>,
    default_material: Option<MaterialId>,
    is_visited: Vec<bool>,
    oddities: Oddities,
}

/// What was passed over, counted for the notes.
#[derive(Default)]
struct Oddities {
    not_triangles: usize,
    morphed: usize,
    skinned: usize,
}

impl<'a> Walk<'a> {
    /// Ready to visit root nodes.
    pub fn new(document: &'a Document<'a>, scene: Scene) -> Self {
        Self {
            document,
            scene,
            light_definitions: Vec::new(),
            geometries: HashMap::new(),
            default_material: None,
            is_visited: vec![false; document.root.nodes.len()],
            oddities: Oddities::default(),
        }
    }

    /// Places a node and everything below it.
    pub fn visit(&mut self, index: Index<Node>, world_from_parent: DAffine3, depth: usize) -> Result<(), Cause> {
        let document = self.document;
        let node = document.find(index, "node", || "the node tree".to_owned())?;
        if depth > MAX_DEPTH {
            return Err(Cause::TooDeep(MAX_DEPTH));
        }
        if std::mem::replace(&mut self.is_visited[index.value()], true) {
            return Err(Cause::NodeTwice(index.value()));
        }
        if is_hidden(node) {
            return Ok(());
        }
        let user = || format!("node {index}");
        let world_from_node = world_from_parent * parent_from_node(node);
        if !world_from_node.is_finite() {
            return Err(Cause::NotFinite(format!("the transform of node {index}")));
        }
        if let Some(mesh) = node.mesh {
            self.place_mesh(node, mesh, world_from_node, user)?;
        }
        if let Some(camera) = node.camera {
            let camera = document.find(camera, "camera", user)?;
            let name = name_of([&node.name, &camera.name], "camera", self.scene.cameras.len());
            self.scene.cameras.push(devices::camera(camera, name, world_from_node)?);
        }
        if let Some(light) = node.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref()) {
            self.place_light(node, light.light, world_from_node, user)?;
        }
        for &child in node.children.iter().flatten() {
            self.visit(child, world_from_node, depth + 1)?;
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

    /// The filled scene with notes on what was passed over, and the light definition behind each of its lights [l].
    pub fn finish(mut self) -> (Scene, Vec<usize>) {
        let counts = [
            (self.oddities.not_triangles, "primitives of points or lines, or without positions, are ignored"),
            (self.oddities.morphed, "primitives have morph targets: their base shape is used"),
            (self.oddities.skinned, "skinned meshes are shown unposed"),
            (self.scene.dropped_triangles, "triangles without area were dropped"),
        ];
        let notes = counts.into_iter().filter(|&(count, _)| count > 0).map(|(count, what)| format!("{count} {what}"));
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

fn is_hidden(node: &Node) -> bool {
    let visibility = node.extensions.as_ref().and_then(|extensions| extensions.others.get("KHR_node_visibility"));
    visibility.is_some_and(|visibility| visibility["visible"] == false)
}

fn parent_from_node(node: &Node) -> DAffine3 {
    if let Some(matrix) = node.matrix {
        return DAffine3::from_mat4(DMat4::from_cols_array(&matrix.map(f64::from)));
    }
    let vector = |xyz: [f32; 3]| DVec3::from(xyz.map(f64::from));
    let rotation = DQuat::from_array(node.rotation.unwrap_or_default().0.map(f64::from));
    DAffine3::from_scale_rotation_translation(
        node.scale.map_or(DVec3::ONE, vector),
        if rotation.length_squared() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY },
        node.translation.map_or(DVec3::ZERO, vector),
    )
}
