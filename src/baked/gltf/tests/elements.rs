//! Bisection trees and pairs of fronts and backs in a file, and files in which they are missing or damaged.

use glam::Vec3;

use super::reloaded;
use crate::baked::coarse::CoarseMesh;
use crate::baked::gltf::{from_scene, to_glb};
use crate::baked::{BakedScene, BisectionTrees};
use crate::base::ids::TriangleId;
use crate::patch::{MeshSettings, PatchMesh, Splits};
use crate::scene::{Scene, builtin};

/// Returns the elements of the Cornell box, whose blocks are double-sided, finer round one corner.
fn fresh() -> BakedScene {
    let mut scene = builtin::cornell();
    scene.materials[0].double_sided = true;
    let settings = MeshSettings { element_size: 0.2, patch_size: 1.0 };
    let mut mesh = PatchMesh::new(&scene, &settings).expect("a mesh");
    let mut splits = Splits::default();
    for element in &mesh.elements {
        let [a, b, c] = mesh.corners(element);
        if a.length() < 1.0 {
            splits.insert(b, c);
        }
    }
    mesh = PatchMesh::refined(&scene, &settings, &mut splits).expect("a mesh");
    BakedScene::of_mesh(&scene, &mesh)
}

fn loaded(baked: &BakedScene) -> Scene {
    reloaded(&to_glb(baked, 0.0).expect("small"))
}

fn read(scene: Scene) -> BakedScene {
    from_scene(scene).expect("there is light")
}

fn bits(scene: &Scene, corners: [u32; 3]) -> [[u32; 3]; 3] {
    corners.map(|v| (scene.vertices[v as usize].position + Vec3::ZERO).to_array().map(f32::to_bits))
}

/// Returns the triangles of the coarse mesh, with the sizes of their tiles, in an order that does not depend on the
/// file.
fn coarse(baked: &BakedScene, trees: Option<&BisectionTrees>) -> Vec<([[u32; 3]; 3], Option<u32>)> {
    let coarse = CoarseMesh::new(&baked.scene, trees, 8192).expect("far fewer triangles");
    let tiles = coarse.tiles.iter().map(|tile| Some(tile.side)).chain(std::iter::repeat(None));
    let corners = coarse.triangles.iter().map(|triangle| bits(&baked.scene, triangle.vertices));
    let mut found: Vec<_> = corners.zip(tiles).collect();
    found.sort_unstable();
    found
}

fn num_elements(trees: &str) -> usize {
    BisectionTrees::parse(trees).expect("trees").num_elements()
}

/// Returns the corners of all fronts and of their backs, in an order that does not depend on the file.
fn pairs(scene: &Scene) -> Vec<[[[u32; 3]; 3]; 2]> {
    let corners = |t: TriangleId| bits(scene, scene.triangles[t.index()].vertices);
    let pair = |front| Some([corners(front), corners(scene.sides.back_of(front)?.triangle)]);
    let mut found: Vec<_> = scene.fronts().filter_map(pair).collect();
    found.sort_unstable();
    found
}

#[test]
fn a_reloaded_bake_has_the_coarse_mesh_and_the_pairs_of_the_fresh_one_and_of_the_guess() {
    let fresh = fresh();
    let back = read(loaded(&fresh));
    assert!(back.trees.is_some() && back.scene.notes.is_empty(), "{:?}", back.scene.notes);
    let expected = coarse(&fresh, fresh.trees.as_ref());
    assert!(4 * expected.len() < fresh.scene.triangles.len(), "{} triangles", expected.len());
    for (baked, trees) in [(&fresh, None), (&back, back.trees.as_ref()), (&back, None)] {
        assert_eq!(coarse(baked, trees), expected);
    }
    let num_backs = fresh.scene.triangles.len() - fresh.scene.fronts().count();
    assert_eq!((pairs(&fresh.scene).len(), back.scene.sides.num_unpaired()), (num_backs, 0));
    assert_eq!(pairs(&back.scene), pairs(&fresh.scene));
}

#[test]
fn a_file_without_records_is_read_by_guessing() {
    let fresh = fresh();
    let mut scene = loaded(&fresh);
    scene.element_records.clear();
    let back = read(scene);
    assert!(back.trees.is_none() && back.scene.notes.is_empty());
    assert_eq!(coarse(&back, None), coarse(&fresh, fresh.trees.as_ref()));
    assert_eq!(pairs(&back.scene), pairs(&fresh.scene));
}

#[test]
fn a_bake_that_is_read_and_written_again_has_the_same_records() {
    let first = loaded(&fresh());
    assert!(first.element_records.iter().any(|(_, record)| record.back_of == Some(1)));
    assert!(first.element_records.iter().all(|(_, record)| record.trees.is_some()));
    let second = loaded(&read(first.clone()));
    assert_eq!(second.element_records, first.element_records);
}

#[test]
fn damaged_records_are_noted_and_replaced_by_the_guess() {
    let fresh = fresh();
    let (expected_mesh, expected_pairs) = (coarse(&fresh, fresh.trees.as_ref()), pairs(&fresh.scene));
    let with_trees = |change: fn(&str) -> String| {
        let mut scene = loaded(&fresh);
        let trees = scene.element_records[0].1.trees.as_mut().expect("trees");
        *trees = change(trees);
        scene
    };
    let with_back_of = |back_of: usize| {
        let mut scene = loaded(&fresh);
        let records = scene.element_records.iter_mut().map(|(_, record)| record);
        records.filter(|record| record.back_of.is_some()).for_each(|record| record.back_of = Some(back_of));
        scene
    };
    let with_swapped_triangles = || {
        let mut scene = loaded(&fresh);
        scene.triangles.swap(0, 3);
        scene
    };
    let with_version_2 = || {
        let mut scene = loaded(&fresh);
        scene.element_records[0].1.version = 2;
        scene
    };
    for (scene, problem, has_trees) in [
        (with_trees(|_| String::new()), "as leaves", false),
        (with_trees(|trees| format!("{trees}a")), "as leaves", false),
        (with_trees(|_| "p".repeat(100)), "as leaves", false),
        (with_trees(|_| "\u{0}ä".to_owned()), "as leaves", false),
        (with_trees(|trees| format!("ab{}", "a".repeat(num_elements(trees) - 3))), "edges", false),
        (with_back_of(0), "fronts", true),
        (with_back_of(2), "fronts", true),
        (with_back_of(usize::MAX), "fronts", true),
        (with_version_2(), "version", false),
    ] {
        let back = read(scene);
        assert_eq!(back.trees.is_some(), has_trees, "{:?}", back.scene.notes);
        assert!(back.scene.notes.iter().any(|note| note.contains(problem)), "{:?} for {problem}", back.scene.notes);
        assert_eq!(coarse(&back, back.trees.as_ref()), expected_mesh);
        assert_eq!(pairs(&back.scene), expected_pairs);
    }
    let back = read(with_swapped_triangles());
    assert!(back.trees.is_none() && back.scene.notes.iter().any(|note| note.contains("edges")));
    assert_eq!(pairs(&back.scene), expected_pairs);
}

#[test]
fn elements_that_were_moved_apart_since_are_not_joined() {
    let mut baked = fresh();
    let num_whole = coarse(&baked, baked.trees.as_ref()).len();
    for (v, vertex) in baked.scene.vertices.iter_mut().enumerate() {
        vertex.position += 0.01 * Vec3::new((v as f32).sin(), (1.7 * v as f32).cos(), 0.0);
    }
    let trees = baked.trees.clone();
    let moved = CoarseMesh::new(&baked.scene, trees.as_ref(), 8192);
    assert!(moved.is_none_or(|moved| moved.triangles.len() > 2 * num_whole));
}
