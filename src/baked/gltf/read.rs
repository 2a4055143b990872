//! Restores a bake from a loaded scene whose vertices carry light.

use super::elements::{self, Recorded};
use crate::baked::pairing::pair_by_position;
use crate::baked::{BakedScene, GroupLight, VertexLight};
use crate::scene::{Scene, VertexAttribute};

/// Moves the stored light, and the records of the elements, out of a loaded scene.
///
/// If only a part of a group is stored, the rest is dark. Groups without a name in the file are named by their number.
///
/// # Errors
/// Returns the scene itself, unchanged, if it carries no light.
#[expect(clippy::result_large_err, reason = "the error is the argument handed back, once a file")]
pub fn from_scene(mut scene: Scene) -> Result<BakedScene, Scene> {
    // A group number above the number of attributes is an error in the file. It must not cause memory to be allocated
    // for all groups below it.
    let limit = scene.irradiance.len();
    let part_of = |attribute: &VertexAttribute| part(&attribute.name).filter(|&(_, group)| group < limit);
    let Some(last) = scene.irradiance.iter().filter_map(part_of).map(|(_, group)| group).max() else {
        return Err(scene);
    };
    for g in scene.light_groups.len()..=last {
        scene.light_groups.push(format!("group {g}"));
    }
    let mut light = VertexLight::dark(scene.light_groups.len(), scene.vertices.len());
    for attribute in std::mem::take(&mut scene.irradiance) {
        if let Some((part, group)) = part_of(&attribute) {
            *part(&mut light.groups[group]) = attribute.values;
        }
    }
    let records = std::mem::take(&mut scene.element_records);
    let Recorded { trees, pairs, notes } = elements::read(&scene, &records);
    scene.notes.extend(notes);
    scene.sides.add_pairs(pairs);
    if scene.sides.num_unpaired() > 0 {
        pair_by_position(&mut scene);
    }
    Ok(BakedScene { scene, light, trees })
}

/// Selects the direct or the indirect light of a group.
type Part = fn(&mut GroupLight) -> &mut Vec<glam::Vec3>;

/// Returns the part and the group whose light an attribute holds; `None` if it holds no light.
fn part(name: &str) -> Option<(Part, usize)> {
    let (part, number): (Part, _) = if let Some(number) = name.strip_prefix("_IRRADIANCE_DIRECT_") {
        (|group| &mut group.direct, number)
    } else {
        (|group| &mut group.indirect, name.strip_prefix("_IRRADIANCE_INDIRECT_")?)
    };
    Some((part, number.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Vertex;
    use glam::Vec3;

    fn scene_with(attributes: &[(&str, f32)]) -> Scene {
        let vertex = Vertex::new(Vec3::ZERO, Vec3::Y);
        let attribute =
            |&(name, value): &(&str, f32)| VertexAttribute { name: name.to_owned(), values: vec![Vec3::splat(value)] };
        Scene {
            vertices: vec![vertex],
            irradiance: attributes.iter().map(attribute).collect(),
            light_groups: vec!["sun".into()],
            ..Scene::default()
        }
    }

    #[test]
    fn a_scene_without_light_is_returned_unchanged() {
        assert!(from_scene(scene_with(&[])).is_err());
        let other = from_scene(scene_with(&[("_IRRADIANCE_TOTAL", 1.0)])).unwrap_err();
        assert_eq!(other.irradiance.len(), 1);
    }

    #[test]
    fn attributes_go_to_their_groups_and_missing_parts_are_dark() {
        let attributes = [("_IRRADIANCE_DIRECT_1", 1.0), ("_IRRADIANCE_INDIRECT_0", 2.0)];
        let baked = from_scene(scene_with(&attributes)).expect("there is light");
        assert_eq!(baked.scene.light_groups, ["sun", "group 1"]);
        let [sun, other] = &baked.light.groups[..] else { panic!("two groups") };
        assert_eq!((sun.direct[0], sun.indirect[0]), (Vec3::ZERO, Vec3::splat(2.0)));
        assert_eq!((other.direct[0], other.indirect[0]), (Vec3::ONE, Vec3::ZERO));
    }

    #[test]
    fn a_group_number_beyond_the_number_of_attributes_is_ignored() {
        assert!(from_scene(scene_with(&[("_IRRADIANCE_DIRECT_4000000000", 1.0)])).is_err());
    }
}
