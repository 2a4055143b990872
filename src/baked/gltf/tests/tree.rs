//! Tests of the nodes of a written file: tree, transforms, meshes, lights and cameras.

use std::sync::Arc;

use glam::{Quat, Vec3};

use super::*;
use crate::scene::{NamedNode, Profile, Transform, normal_of, photometry};

/// Returns a tree of nodes round the squares of [`scene`]: a turned house, a mirrored room in it, the squares, a lamp.
fn tree() -> Vec<NamedNode> {
    let node = |name: &str, parent, transform| NamedNode { name: name.into(), parent, transform, ..Default::default() };
    let turned = Transform::Parts { translation: [3.0, 0.1, -7.0], rotation: [0.0, 0.6, 0.0, 0.8], scale: [2.0; 3] };
    let mirrored = Transform::Matrix([-0.3, 0., 0., 0., 0.1, 1., 0., 0., 0., 0., 1., 0., 5., 6., 7., 1.]);
    vec![
        node("house", None, turned),
        node("room", Some(0), mirrored),
        NamedNode { instances: 0..1, ..node("", Some(1), Transform::default()) },
        NamedNode { light: Some(1), camera: Some(0), ..node("lamp holder", Some(0), Transform::default()) },
    ]
}

#[test]
fn the_node_tree_is_kept_with_its_names_and_transforms() {
    let glb = scene_to_glb(&Scene { nodes: tree(), ..scene() }).expect("small");
    let file = gltf::Gltf::from_slice(&glb).expect("valid glTF");
    let mut roots = file.scenes().flat_map(|scene| scene.nodes().collect::<Vec<_>>());
    let house = roots.next().expect("the house");
    let [room, holder] = &house.children().collect::<Vec<_>>()[..] else { panic!("two nodes in the house") };
    let squares = room.children().next().expect("the squares");
    let names = [&house, room, &squares, holder].map(|node| node.name().unwrap_or_default().to_owned());
    assert_eq!(names, ["house", "room", "squares", "lamp holder"]);
    assert!(house.mesh().is_none() && squares.mesh().is_some());
    assert_eq!(holder.light().map(|light| light.index()), Some(1));
    assert_eq!(holder.camera().map(|camera| camera.index()), Some(0));
    let beside: Vec<_> =
        roots.map(|node| (node.light().map(|l| l.index()), node.camera().map(|c| c.index()))).collect();
    assert_eq!(beside, [(Some(0), None), (Some(2), None), (None, Some(1))]);
    for (stored, back) in tree().iter().zip(&reloaded(&glb).nodes) {
        assert_eq!((stored.parent, stored.transform), (back.parent, back.transform));
    }
}

#[test]
fn a_rotated_and_mirrored_node_keeps_the_light_bit_by_bit_and_the_mesh_in_place() {
    let mut stored = baked();
    stored.scene.nodes = tree();
    let Ok(back) = from_scene(reloaded(&to_glb(&stored, 9.5).expect("small"))) else { panic!("the light is lost") };
    let pairs = sorted_triangles(&stored.scene).into_iter().zip(sorted_triangles(&back.scene));
    for ((_, a), (_, b)) in pairs {
        for v in a.vertices.map(|v| v as usize) {
            let place = stored.scene.vertices[v].position;
            let twin = |w: &u32| (back.scene.vertices[*w as usize].position - place).length() < 1e-5;
            let w = *b.vertices.iter().find(|w| twin(w)).expect("a corner in the same place") as usize;
            assert!((stored.scene.vertices[v].normal - back.scene.vertices[w].normal).length() < 1e-6);
            for (stored, back) in stored.light.groups.iter().zip(&back.light.groups) {
                assert_eq!((stored.direct[v], stored.indirect[v]), (back.direct[w], back.indirect[w]));
            }
        }
        let front = |scene: &Scene, triangle: &Triangle| {
            normal_of(triangle.vertices.map(|v| scene.vertices[v as usize].position))
        };
        assert!((front(&stored.scene, a) - front(&back.scene, b)).length() < 1e-4);
    }
}

#[test]
fn slivers_far_from_their_node_are_not_lost() {
    let mut stored = scene();
    for vertex in &mut stored.vertices {
        vertex.position *= 1e-6;
    }
    let far = Transform::Parts { translation: [1e3, 0.0, 0.0], rotation: [0.0, 0.0, 0.0, 1.0], scale: [1.0; 3] };
    let nodes = vec![NamedNode { name: "far".into(), transform: far, instances: 0..1, ..Default::default() }];
    let back = reloaded(&scene_to_glb(&Scene { nodes, ..stored.clone() }).expect("small"));
    assert_eq!(back.triangles.len(), stored.triangles.len());
    assert_eq!(back.nodes[0].transform, far);
}

#[test]
fn a_node_with_a_flat_transform_is_written_in_world_space() {
    let mut nodes = tree();
    nodes[1].transform =
        Transform::Parts { translation: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0], scale: [1.0, 1.0, 0.0] };
    let stored = Scene { nodes, ..scene() };
    let back = reloaded(&scene_to_glb(&stored).expect("small"));
    for ((_, a), (_, b)) in sorted_triangles(&stored).into_iter().zip(sorted_triangles(&back)) {
        for (v, w) in a.vertices.iter().zip(&b.vertices) {
            let [a, b] = [stored.vertices[*v as usize].position, back.vertices[*w as usize].position];
            assert!((a - b).length() < 1e-5, "{a} and {b}");
        }
    }
}

#[test]
fn a_photometric_light_keeps_its_table_rotation_and_group() {
    let table = b"IES:LM-63-2019\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 60 90\n0\n40 30 5\n";
    let photometry = Arc::new(photometry::parse(table).expect("LM-63"));
    let mut stored = scene();
    let bulb = &mut stored.lights[0];
    bulb.range = None;
    bulb.profile = Some(Profile { photometry, world_from_light: Quat::from_rotation_x(0.4) });
    let back = reloaded(&scene_to_glb(&stored).expect("small"));
    for (name, group) in [("bulb", GroupId(1)), ("spot", GroupId(1)), ("sun", GroupId(0))] {
        let of = |scene: &Scene| scene.lights.iter().find(|light| light.name == name).cloned().expect("it is there");
        let [stored, back] = [of(&stored), of(&back)];
        assert_eq!(back.group, group);
        for point in [Vec3::new(1.4, 0.5, 1.5), Vec3::new(1.0, 2.0, -9.0), Vec3::new(0.0, 9.0, 0.0)] {
            let [a, b] = [&stored, &back].map(|light| light.arrival(point).irradiance);
            assert!((a - b).length() <= 1e-4 * a.length() + 1e-6, "{name}: {a} became {b}");
        }
    }
}
