//! Elements, trees and patches on small scenes.

use std::collections::HashMap;

use glam::Vec3;
use hemicube::base::ids::TriangleId;
use hemicube::base::sampling::{r2, triangle_from_square};
use hemicube::base::triangle::interpolate;
use hemicube::patch::{MeshSettings, PatchMesh, Splits};
use hemicube::radiosity::Viewpoints;
use hemicube::scene::normal_of;

use crate::support::scenes;

fn furnace_mesh() -> (hemicube::scene::Scene, PatchMesh) {
    let scene = scenes::furnace(Vec3::splat(0.5), Vec3::ONE);
    let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 0.13, patch_size: 0.4 }).unwrap();
    (scene, mesh)
}

#[test]
fn the_tree_finds_the_element_that_contains_a_point() {
    let (scene, mesh) = furnace_mesh();
    for t in 0..scene.triangles.len() {
        let triangle = TriangleId::new(t);
        let corners = scene.corners(triangle);
        for i in 0..500 {
            let weights = triangle_from_square(r2(i, t as u32));
            let point = interpolate(corners, weights);
            let element = &mesh.elements[mesh.element_at(triangle, weights).index()];
            let [a, b, c] = mesh.corners(element);
            let whole = (b - a).cross(c - a);
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let side = (to - from).cross(point - from).dot(whole);
                assert!(side >= -1e-6, "point {point} lies outside its element");
            }
            assert_eq!(element.triangle, triangle);
        }
    }
}

/// In a closed room, an edge of only one element would contain a T-vertex.
#[track_caller]
fn assert_conforming(mesh: &PatchMesh) {
    let mut uses: HashMap<[[u32; 3]; 2], usize> = HashMap::new();
    for element in &mesh.elements {
        let corners = mesh.corners(element);
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            assert!(a.distance(b) <= 0.13);
            let mut edge = [a, b].map(|p| p.to_array().map(f32::to_bits));
            edge.sort_unstable();
            *uses.entry(edge).or_default() += 1;
        }
    }
    assert!(uses.values().all(|&count| count == 2), "an edge is not shared by exactly two elements");
}

#[test]
fn a_mesh_with_a_few_edges_halved_is_conforming() {
    let (scene, mesh) = furnace_mesh();
    let mut splits = Splits::default();
    for element in mesh.elements.iter().step_by(37) {
        for k in 0..3 {
            let corners = mesh.corners(element);
            splits.insert(corners[k], corners[(k + 1) % 3]);
        }
    }
    let settings = MeshSettings { element_size: 0.13, patch_size: 0.4 };
    let refined = PatchMesh::refined(&scene, &settings, &mut splits).unwrap();
    assert_conforming(&refined);
    assert!((mesh.elements.len() + 10..4 * mesh.elements.len()).contains(&refined.elements.len()));
    let area: f64 = refined.elements.iter().map(|element| f64::from(element.area)).sum();
    assert!((area - scene.area()).abs() < 1e-5);
}

#[test]
fn elements_are_conforming_and_small_and_fill_the_surface() {
    let (scene, mesh) = furnace_mesh();
    assert_conforming(&mesh);
    let area: f64 = mesh.elements.iter().map(|element| f64::from(element.area)).sum();
    assert!((area - scene.area()).abs() < 1e-5);
}

#[test]
fn patches_are_flat_pieces_of_about_the_requested_size() {
    let (_, mesh) = furnace_mesh();
    for patch in &mesh.patches {
        let members = mesh.members_of(patch);
        let instance = |e: hemicube::base::ids::ElementId| mesh.elements[e.index()].triangle.0 / 2;
        assert!(members.iter().all(|&e| instance(e) == instance(members[0])), "a patch spans two walls");
        assert!(patch.area <= 0.3 * 0.8, "a patch of {} m2", patch.area);
    }
    assert!((36..=100).contains(&mesh.patches.len()), "{} patches", mesh.patches.len());
}

#[test]
fn viewpoints_lie_above_their_elements_even_if_shading_normals_lean() {
    let mut scene = scenes::furnace(Vec3::splat(0.5), Vec3::ONE);
    for vertex in &mut scene.vertices {
        vertex.normal = (vertex.normal + 0.2 * vertex.normal.any_orthonormal_vector()).normalize();
    }
    let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 0.3, patch_size: 0.5 }).unwrap();
    let viewpoints = Viewpoints::new(&scene).at_light_vertices(&mesh);
    for element in &mesh.elements {
        let normal = normal_of(mesh.corners(element));
        for l in mesh.light_vertices_of(element) {
            let height = (viewpoints[l].position - mesh.light_vertices[l].position).dot(normal);
            assert!(height > 0.0, "a viewpoint is {height} below its surface");
        }
    }
}
