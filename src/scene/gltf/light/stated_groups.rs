//! Light groups that are given in `extras`, as in baked files and the built-in scenes.
//!
//! `light_groups` of a glTF scene lists the names in order; `light_group` of a light or an emissive material is the
//! name of its group.

use gltf::json::{Extras, Root};
use serde_json::Value;

use super::groups::{MAX_GROUPS, OTHERS};
use super::photometric;
use crate::base::ids::GroupId;
use crate::scene::Scene;

/// Assigns every light and every emissive material to its group in the file. Returns false and changes nothing if the
/// file has no groups or more than [`MAX_GROUPS`].
///
/// `definitions[l]` is the index of the light definition of the scene's light l.
pub(crate) fn assign(scene: &mut Scene, definitions: &[usize], root: &Root) -> bool {
    let of_definition = groups_of_lights(root);
    let of_light: Vec<_> = definitions.iter().map(|&d| of_definition.get(d).cloned().flatten()).collect();
    let of_material: Vec<_> = root.materials.iter().map(|material| stated_group(&material.extras)).collect();
    let mut names = listed_names(root);
    if names.is_empty() && of_light.iter().chain(&of_material).all(Option::is_none) {
        return false;
    }
    let mut group_of = |stated: Option<&String>| {
        let name = stated.map_or(OTHERS, String::as_str);
        let index = names.iter().position(|known| known == name).unwrap_or_else(|| {
            names.push(name.to_owned());
            names.len() - 1
        });
        GroupId::new(index)
    };
    let lights: Vec<_> = of_light.iter().map(|stated| group_of(stated.as_ref())).collect();
    let material_group = |(m, material): (usize, &crate::scene::Material)| {
        material.is_emissive().then(|| group_of(of_material.get(m).and_then(Option::as_ref)))
    };
    let materials: Vec<_> = scene.materials.iter().enumerate().map(material_group).collect();
    if names.len() > MAX_GROUPS {
        return false;
    }
    scene.light_groups = names;
    scene.lights.iter_mut().zip(lights).for_each(|(light, group)| light.group = group);
    scene.materials.iter_mut().zip(materials).for_each(|(material, group)| material.group = group);
    true
}

fn groups_of_lights(root: &Root) -> Vec<Option<String>> {
    let extension = root.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref());
    let punctual = extension.map_or(&[][..], |lights| &lights.lights).iter().map(|light| stated_group(&light.extras));
    let photometric =
        photometric::definitions(root).iter().map(|light| light["extras"]["light_group"].as_str().map(str::to_owned));
    punctual.chain(photometric).collect()
}

fn listed_names(root: &Root) -> Vec<String> {
    let lists = root.scenes.iter().filter_map(|scene| parsed(&scene.extras)?.get("light_groups").cloned());
    lists.filter_map(|list| serde_json::from_value(list).ok()).next().unwrap_or_default()
}

fn stated_group(extras: &Extras) -> Option<String> {
    Some(parsed(extras)?.get("light_group")?.as_str()?.to_owned())
}

fn parsed(extras: &Extras) -> Option<Value> {
    serde_json::from_str(extras.as_ref()?.get()).ok()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::scene::{Light, Material};

    /// Returns a scene with one light and one emissive material of this file.
    fn assigned(json: &str) -> Option<Scene> {
        let light = Light::point(Vec3::ZERO, Vec3::ONE);
        let glowing = Material { emission: Vec3::ONE, ..Material::default() };
        let mut scene = Scene { lights: vec![light], materials: vec![glowing], ..Scene::default() };
        let root = Root::from_str(json).expect("glTF");
        assign(&mut scene, &[0], &root).then_some(scene)
    }

    fn file(list: &str, light: &str, material: &str) -> String {
        format!(
            r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [], "extras": {{{list}}}}}],
                "materials": [{{"extras": {{{material}}}}}], "extensions": {{"KHR_lights_punctual": {{"lights":
                [{{"type": "point", "extras": {{{light}}}}}]}}}}}}"#
        )
    }

    #[test]
    fn the_list_gives_the_order_and_unlisted_names_follow() {
        let scene = assigned(&file(r#""light_groups": ["b", "a"]"#, r#""light_group": "a""#, r#""light_group": "c""#));
        let scene = scene.expect("groups are stated");
        assert_eq!(scene.light_groups, ["b", "a", "c"]);
        assert_eq!((scene.lights[0].group, scene.materials[0].group), (GroupId(1), Some(GroupId(2))));
    }

    #[test]
    fn sources_without_a_stated_group_share_one() {
        let scene = assigned(&file("", r#""light_group": "a""#, "")).expect("groups are stated");
        assert_eq!(scene.light_groups, ["a", OTHERS]);
    }

    #[test]
    fn without_a_statement_or_with_too_many_groups_nothing_changes() {
        assert!(assigned(&file("", "", "")).is_none());
        let many: Vec<String> = (0..=MAX_GROUPS).map(|g| format!("\"{g}\"")).collect();
        assert!(assigned(&file(&format!(r#""light_groups": [{}]"#, many.join(",")), "", "")).is_none());
    }
}
