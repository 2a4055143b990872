//! The nodes of the file: one for each [`Branch`] (a glTF node with its mesh, light and camera), and one for each light
//! and camera without a branch.

use glam::{Quat, Vec3};
use serde_json::{Value, json};

use super::binary::Binary;
use super::hierarchy::Branch;
use super::json::named;
use crate::base::ids::GroupId;
use crate::scene::{Camera, Light, LightKind, Projection, Scene};

/// Name of the extension that holds the lights.
pub(super) const LIGHTS_EXTENSION: &str = "KHR_lights_punctual";
/// Name of the extension that holds photometric files.
pub(super) const PROFILES_EXTENSION: &str = "EXT_lights_ies";

/// Near plane of a perspective camera, metres. glTF requires one; this program does not read it.
const NEAR: f32 = 0.01;
/// Far plane of an orthographic camera, metres. glTF requires one; this program does not read it.
const FAR: f32 = 1000.0;

/// Returns one node for each branch and for each light and camera without a branch, and the indices of the roots.
pub(super) fn nodes(scene: &Scene, branches: &[Branch]) -> (Vec<Value>, Vec<usize>) {
    let mut nodes: Vec<Value> = branches.iter().map(Branch::node).collect();
    let drawn = branches.iter().enumerate().filter(|(_, branch)| !branch.triangles.is_empty());
    for (mesh, (node, _)) in drawn.enumerate() {
        nodes[node]["mesh"] = json!(mesh);
    }
    for (id, branch) in branches.iter().enumerate() {
        if let Some(light) = branch.light {
            nodes[id]["extensions"] = carrying(scene, light);
        }
        if let Some(camera) = branch.camera {
            nodes[id]["camera"] = json!(camera);
        }
        if let Some(parent) = branch.parent {
            let children = &mut nodes[parent]["children"];
            match children.as_array_mut() {
                Some(children) => children.push(json!(id)),
                None => *children = json!([id]),
            }
        }
    }
    let is_free = |carried: fn(&Branch) -> Option<usize>, id| branches.iter().all(|branch| carried(branch) != Some(id));
    for (id, light) in scene.lights.iter().enumerate().filter(|&(id, _)| is_free(|branch| branch.light, id)) {
        let (translation, rotation) = place_of_light(light);
        let mut node = placed(&light.name, translation, rotation);
        node["extensions"] = carrying(scene, id);
        nodes.push(node);
    }
    for (id, camera) in scene.cameras.iter().enumerate().filter(|&(id, _)| is_free(|branch| branch.camera, id)) {
        let mut node = placed(&camera.name, camera.position, camera.world_from_view);
        node["camera"] = json!(id);
        nodes.push(node);
    }
    let is_root = |id: &usize| branches.get(*id).is_none_or(|branch| branch.parent.is_none());
    let roots = (0..nodes.len()).filter(is_root).collect();
    (nodes, roots)
}

/// Returns the extensions of a node that carries a light. Lights with a photometric table and those without are in
/// separate lists.
fn carrying(scene: &Scene, light: usize) -> Value {
    let Light { profile, intensity, .. } = &scene.lights[light];
    let number = scene.lights[..light].iter().filter(|other| other.profile.is_some() == profile.is_some()).count();
    match profile {
        None => json!({ LIGHTS_EXTENSION: { "light": number } }),
        Some(profile) => {
            let multiplier = intensity.max_element() / profile.photometry.peak();
            let colour = colour_of(*intensity).to_array();
            json!({ PROFILES_EXTENSION: { "light": number, "multiplier": multiplier, "color": colour } })
        }
    }
}

fn placed(name: &str, translation: Vec3, rotation: Quat) -> Value {
    let mut node = named(name);
    node["translation"] = json!(translation.to_array());
    node["rotation"] = json!(rotation.to_array());
    node
}

/// Returns the translation and rotation of a light, which shines along the -Z axis of its node.
fn place_of_light(light: &Light) -> (Vec3, Quat) {
    let turned = |direction| Quat::from_rotation_arc(Vec3::NEG_Z, direction).normalize();
    match light.kind {
        LightKind::Point { position } => {
            (position, light.profile.as_ref().map_or(Quat::IDENTITY, |profile| profile.world_from_light))
        }
        LightKind::Spot { position, direction, .. } => (position, turned(direction)),
        LightKind::Directional { direction } => (Vec3::ZERO, turned(direction)),
    }
}

/// Returns the lights of KHR_lights_punctual.
pub(super) fn lights(scene: &Scene) -> Vec<Value> {
    let punctual = scene.lights.iter().filter(|light| light.profile.is_none());
    punctual.map(|light| punctual_light(light, group_name(scene, light.group))).collect()
}

/// Returns the photometric files of EXT_lights_ies.
pub(super) fn profiles(scene: &Scene, binary: &mut Binary) -> Vec<Value> {
    let profile = |light: &Light| {
        let view = binary.push_file(light.profile.as_ref()?.photometry.file());
        let mut object = named(&light.name);
        object["bufferView"] = json!(view);
        object["mimeType"] = json!("application/x-ies-lm-63");
        object["extras"] = json!({ "light_group": group_name(scene, light.group) });
        Some(object)
    };
    scene.lights.iter().filter_map(profile).collect()
}

/// Returns the colour of a light, scaled so that its largest channel is 1; white if the light is off.
fn colour_of(intensity: Vec3) -> Vec3 {
    let largest = intensity.max_element();
    if largest > 0.0 { intensity / largest } else { Vec3::ONE }
}

fn punctual_light(light: &Light, group: &str) -> Value {
    let intensity = light.intensity.max_element();
    let mut object = named(&light.name);
    object["intensity"] = json!(intensity);
    object["color"] = json!(colour_of(light.intensity).to_array());
    object["extras"] = json!({ "light_group": group });
    if let Some(range) = light.range {
        object["range"] = json!(range);
    }
    match light.kind {
        LightKind::Point { .. } => object["type"] = json!("point"),
        LightKind::Directional { .. } => object["type"] = json!("directional"),
        LightKind::Spot { inner_angle, outer_angle, .. } => {
            object["type"] = json!("spot");
            object["spot"] = json!({ "innerConeAngle": inner_angle, "outerConeAngle": outer_angle });
        }
    }
    object
}

/// Returns the name of a light group.
pub(super) fn group_name(scene: &Scene, group: GroupId) -> &str {
    &scene.light_groups[group.index()]
}

/// Returns the cameras as glTF objects; [`nodes`] writes their transforms.
pub(super) fn cameras(scene: &Scene) -> Vec<Value> {
    scene.cameras.iter().map(camera).collect()
}

fn camera(camera: &Camera) -> Value {
    let mut object = named(&camera.name);
    match camera.projection {
        Projection::Perspective { fov_y } => {
            object["type"] = json!("perspective");
            object["perspective"] = json!({ "yfov": fov_y, "znear": NEAR });
        }
        Projection::Orthographic { half_height } => {
            object["type"] = json!("orthographic");
            object["orthographic"] = json!({ "xmag": half_height, "ymag": half_height, "znear": 0.0, "zfar": FAR });
        }
    }
    object
}
