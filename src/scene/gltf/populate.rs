//! Adds the content of the nodes to the scene: meshes, lights and cameras. The node tree is stored beside them.

use gltf::json::Index;

use super::camera;
use super::error::Cause;
use super::file::document::Document;
use super::light::{photometric, punctual};
use super::mesh::meshes::Meshes;
use super::node::tree::{PlacedNode, name_of, transform};
use crate::scene::{Light, NamedNode, Scene};

/// Fills a scene whose materials have been read.
pub(super) struct Population<'a> {
    document: &'a Document<'a>,
    scene: Scene,
    light_definitions: Vec<usize>,
    meshes: Meshes<'a>,
    profiles: photometric::Profiles<'a>,
}

impl<'a> Population<'a> {
    /// Copies the tree of `nodes` into the scene.
    pub fn new(document: &'a Document<'a>, nodes: &[PlacedNode<'_>], mut scene: Scene, meshes: Meshes<'a>) -> Self {
        let named = |placed: &PlacedNode<'_>| {
            let name = placed.node.name.clone().unwrap_or_default();
            NamedNode { name, parent: placed.parent, transform: transform(placed.node), ..NamedNode::default() }
        };
        scene.nodes = nodes.iter().map(named).collect();
        Self { document, scene, light_definitions: Vec::new(), meshes, profiles: photometric::Profiles::new(document) }
    }

    /// Adds the content of the node `placed`, which has index `scene_node` in [`Scene::nodes`].
    pub fn add(&mut self, scene_node: usize, placed: &PlacedNode<'_>) -> Result<(), Cause> {
        let PlacedNode { index, node, world_from_node, .. } = *placed;
        let user = || format!("node {index}");
        if let Some(mesh) = node.mesh {
            self.meshes.place(&mut self.scene, scene_node, placed, mesh)?;
        }
        if let Some(camera) = node.camera {
            let camera = self.document.find(camera, "camera", user)?;
            let name = name_of([&node.name, &camera.name], "camera", self.scene.cameras.len());
            self.scene.nodes[scene_node].camera = Some(self.scene.cameras.len());
            self.scene.cameras.push(camera::placed(camera, name, world_from_node)?);
        }
        if let Some(light) = node.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref()) {
            self.place_light(scene_node, placed, light.light)?;
        }
        if let Some(node_light) = photometric::of_node(node, index)? {
            self.place_photometric_light(scene_node, placed, &node_light)?;
        }
        Ok(())
    }

    fn place_light(
        &mut self,
        scene_node: usize,
        placed: &PlacedNode<'_>,
        index: Index<punctual::LightDefinition>,
    ) -> Result<(), Cause> {
        let PlacedNode { index: node_index, node, world_from_node, .. } = *placed;
        let definition = self.document.find(index, "light", || format!("node {node_index}"))?;
        let name = name_of([&node.name, &definition.name], "light", index.value());
        let light = punctual::placed(definition, &name, world_from_node)?;
        self.keep_light(scene_node, light, &name, index.value());
        Ok(())
    }

    fn place_photometric_light(
        &mut self,
        scene_node: usize,
        placed: &PlacedNode<'_>,
        node_light: &photometric::NodeLight,
    ) -> Result<(), Cause> {
        let definitions = photometric::definitions(&self.document.root);
        let stated = definitions.get(node_light.light).and_then(|definition| definition["name"].as_str());
        let name = name_of([&placed.node.name, &stated.map(str::to_owned)], "photometric light", node_light.light);
        let photometry = match self.profiles.get(node_light.light) {
            Ok(photometry) => photometry,
            Err(problem) => {
                self.scene.notes.push(format!("photometric file of light {name:?}: {problem}; the light is left out"));
                return Ok(());
            }
        };
        let light = photometric::placed(photometry, node_light.factor(), &name, placed.world_from_node)?;
        let punctual = self.document.root.extensions.as_ref().and_then(|root| root.khr_lights_punctual.as_ref());
        let num_before = punctual.map_or(0, |punctual| punctual.lights.len());
        self.keep_light(scene_node, light, &name, num_before + node_light.light);
        Ok(())
    }

    fn keep_light(&mut self, scene_node: usize, light: Option<Light>, name: &str, definition: usize) {
        match light {
            Some(light) => {
                self.scene.nodes[scene_node].light = Some(self.scene.lights.len());
                self.scene.lights.push(light);
                self.light_definitions.push(definition);
            }
            None => self.scene.notes.push(format!("light {name:?} has no intensity and is left out")),
        }
    }

    /// Returns the filled scene with notes about what is ignored, and the index of the light definition of each of its
    /// lights `[l]`.
    pub fn finish(mut self) -> (Scene, Vec<usize>) {
        if self.scene.lights.iter().any(|light| light.profile.is_some()) {
            let note = "bakes and rays use the photometric files of lights; --shadows treats these lights as uniform";
            self.scene.notes.push(note.to_owned());
        }
        let counts = [
            ("primitives of points or lines, or without positions, ignored", self.meshes.not_triangles),
            ("triangles without area, dropped", self.scene.dropped_triangles),
        ];
        let notes = counts.into_iter().filter(|&(_, count)| count > 0).map(|(what, count)| format!("{what}: {count}"));
        self.scene.notes.extend(notes);
        (self.scene, self.light_definitions)
    }
}
