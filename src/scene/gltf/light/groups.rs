//! Default light groups: one for each light definition and each emissive material, so that each can be dimmed after a
//! bake.

use std::collections::BTreeMap;
use std::f32::consts::{PI, TAU};

use crate::base::colour::luminance;
use crate::base::ids::GroupId;
use crate::scene::{Light, LightKind, Material, Scene, area_of};

/// Largest number of groups of a scene; each group costs memory at every vertex.
pub(crate) const MAX_GROUPS: usize = 8;

/// Name of the group of all sources that have no group of their own.
pub(crate) const OTHERS: &str = "other lights";

/// Sources of light, sorted in the order of groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Source {
    /// A light definition of the file.
    Light(usize),
    /// A material of the scene.
    Material(usize),
}

/// Creates the groups of a scene and assigns every light and every used emissive material to its group.
///
/// `definitions[l]` is the index of the light definition of the scene's light l; `names` are the names of the
/// definitions.
pub(crate) fn assign(scene: &mut Scene, definitions: &[usize], names: &[Option<String>]) {
    let flux = flux_of_sources(scene, definitions);
    let own = sources_with_own_group(&flux);
    scene.light_groups = Vec::with_capacity(MAX_GROUPS);
    for &source in &own {
        let name = match source {
            Source::Light(definition) => light_name(scene, definitions, names, definition),
            Source::Material(m) => scene.materials[m].name.clone(),
        };
        scene.light_groups.push(unused_name(&name, &scene.light_groups));
    }
    if own.len() < flux.len() {
        scene.light_groups.push(OTHERS.to_owned());
    }
    let group_of = |source| GroupId::new(own.iter().position(|&s| s == source).unwrap_or(own.len()));
    for (light, &definition) in scene.lights.iter_mut().zip(definitions) {
        light.group = group_of(Source::Light(definition));
    }
    for (m, material) in scene.materials.iter_mut().enumerate() {
        let source = Source::Material(m);
        material.group = flux.contains_key(&source).then(|| group_of(source));
    }
}

/// Returns the sources with a group of their own, in file order. These are all sources if there are enough groups, else
/// those of the largest flux; the others share the last group.
fn sources_with_own_group(flux: &BTreeMap<Source, f32>) -> Vec<Source> {
    let mut sources: Vec<_> = flux.keys().copied().collect();
    if sources.len() > MAX_GROUPS {
        sources.sort_by(|a, b| flux[b].total_cmp(&flux[a]));
        sources.truncate(MAX_GROUPS - 1);
        sources.sort_unstable();
    }
    sources
}

/// Returns the luminous flux of each source, lumen, without the effect of textures.
///
/// Point light: 4 pi I. Spot: 2 pi (1 - cos(outer angle)) I. Directional: E times the area of the disc around the
/// scene. Emissive material: pi L A, twice for a double-sided one.
fn flux_of_sources(scene: &Scene, definitions: &[usize]) -> BTreeMap<Source, f32> {
    let cross_section = PI * 0.25 * scene.bounds().size().length_squared();
    let mut flux = BTreeMap::new();
    for (light, &definition) in scene.lights.iter().zip(definitions) {
        *flux.entry(Source::Light(definition)).or_insert(0.0) += light_flux(light, cross_section);
    }
    let mut areas = vec![0.0; scene.materials.len()];
    for triangle in &scene.triangles {
        areas[triangle.material.index()] += area_of(triangle.vertices.map(|v| scene.vertices[v as usize].position));
    }
    for (m, (material, &area)) in scene.materials.iter().zip(&areas).enumerate() {
        if material.is_emissive() && area > 0.0 {
            flux.insert(Source::Material(m), exitance(material) * area);
        }
    }
    flux
}

fn light_flux(light: &Light, cross_section: f32) -> f32 {
    let intensity = luminance(light.intensity);
    match light.kind {
        LightKind::Point { .. } => match &light.profile {
            Some(profile) => intensity * profile.photometry.flux() / profile.photometry.peak(),
            None => intensity * 2.0 * TAU,
        },
        LightKind::Spot { outer_angle, .. } => intensity * TAU * (1.0 - outer_angle.cos()),
        LightKind::Directional { .. } => intensity * cross_section,
    }
}

fn exitance(material: &Material) -> f32 {
    let sides = if material.double_sided { 2.0 } else { 1.0 };
    sides * PI * luminance(material.emission)
}

/// Returns the name of a light definition, or of its first light in the scene if the definition has none.
fn light_name(scene: &Scene, definitions: &[usize], names: &[Option<String>], definition: usize) -> String {
    if let Some(Some(name)) = names.get(definition).filter(|name| name.as_ref().is_some_and(|n| !n.trim().is_empty())) {
        return name.clone();
    }
    let first = definitions.iter().position(|&d| d == definition);
    first.map_or_else(|| format!("light {definition}"), |l| scene.lights[l].name.clone())
}

fn unused_name(name: &str, used: &[String]) -> String {
    let numbered = (2..).map(|n| format!("{name} ({n})"));
    let mut candidates = std::iter::once(name.to_owned()).chain(numbered);
    candidates.find(|candidate| !used.contains(candidate)).expect("there are infinitely many numbers")
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    fn scene_with_points(intensities: &[f32]) -> Scene {
        let light = |&candela: &f32| Light {
            name: format!("lamp {candela}"),
            ..Light::point(Vec3::ZERO, Vec3::splat(candela))
        };
        Scene { lights: intensities.iter().map(light).collect(), ..Scene::default() }
    }

    #[test]
    fn the_brightest_seven_of_nine_keep_their_own_group() {
        let mut scene = scene_with_points(&[5.0, 1.0, 7.0, 3.0, 9.0, 4.0, 2.0, 8.0, 6.0]);
        assign(&mut scene, &[0, 1, 2, 3, 4, 5, 6, 7, 8], &[]);
        assert_eq!(scene.light_groups.len(), 8);
        assert_eq!(scene.light_groups[0], "lamp 5");
        assert_eq!(scene.light_groups[7], OTHERS);
        assert_eq!((scene.lights[1].group, scene.lights[6].group), (GroupId(7), GroupId(7)));
    }

    #[test]
    fn lights_of_one_definition_share_a_group_and_equal_names_are_numbered() {
        let mut scene = scene_with_points(&[1.0, 1.0, 1.0]);
        let names = [Some("lamp".to_owned()), Some("lamp".to_owned())];
        assign(&mut scene, &[1, 0, 1], &names);
        assert_eq!(scene.light_groups, ["lamp", "lamp (2)"]);
        assert_eq!(scene.lights[0].group, scene.lights[2].group);
    }
}
