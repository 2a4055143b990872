use std::collections::HashMap;

use glam::{UVec2, Vec2, Vec3};

use super::tiles::NOTHING;
use super::{CoarseMesh, Tile};
use crate::baked::BakedScene;
use crate::base::sampling::r2;
use crate::patch::{MeshSettings, PatchMesh, Splits};
use crate::scene::{AlphaMode, Scene, Triangle, builtin};

const MAX_SIDE: u32 = 8192;

/// Returns the elements of a scene, finer round one of its vertices.
fn elements_of(scene: &Scene, element_size: f32) -> Scene {
    let settings = MeshSettings { element_size, patch_size: 1.0 };
    let mut splits = Splits::default();
    let mut mesh = PatchMesh::new(scene, &settings).expect("a mesh");
    let middle = scene.vertices[scene.vertices.len() / 2].position;
    for radius in [1.0, 0.7, 0.4] {
        for element in &mesh.elements {
            let [a, b, c] = mesh.corners(element);
            if a.distance(middle) < radius {
                splits.insert(b, c);
            }
        }
        mesh = PatchMesh::refined(scene, &settings, &mut splits).expect("a mesh");
    }
    BakedScene::of_mesh(scene, &mesh).scene
}

fn corners(scene: &Scene, triangle: &Triangle) -> [Vec3; 3] {
    triangle.vertices.map(|v| scene.vertices[v as usize].position)
}

fn area(scene: &Scene, triangles: &[Triangle]) -> f64 {
    let area = |[a, b, c]: [Vec3; 3]| f64::from((b - a).cross(c - a).length()) / 2.0;
    triangles.iter().map(|triangle| area(corners(scene, triangle))).sum()
}

#[test]
fn the_coarse_mesh_has_the_same_surfaces_in_fewer_triangles() {
    for (scene, element_size, share) in [(builtin::cornell(), 0.1, 20), (builtin::gallery(), 0.3, 2)] {
        let elements = elements_of(&scene, element_size);
        let coarse = CoarseMesh::new(&elements, None, MAX_SIDE).expect("a bake");
        let (num_elements, num_coarse) = (elements.triangles.len(), coarse.triangles.len());
        assert!(share * num_coarse < num_elements, "{num_coarse} of {num_elements}");
        let (fine, left) = (area(&elements, &elements.triangles), area(&elements, &coarse.triangles));
        assert!((fine - left).abs() < 1e-5 * fine, "{left} of {fine} m2");
        let tiled: u64 = coarse.triangles[coarse.tiles.len()..].len() as u64 + coarse.elements.len() as u64;
        assert_eq!(tiled, num_elements as u64, "every element is in a tile or drawn");
    }
}

#[test]
fn no_vertex_is_left_in_the_middle_of_an_edge() {
    let elements = elements_of(&builtin::cornell(), 0.1);
    let coarse = CoarseMesh::new(&elements, None, MAX_SIDE).expect("a bake");
    let bits = |p: Vec3| (p + Vec3::ZERO).to_array().map(f32::to_bits);
    let used: HashMap<_, _> =
        coarse.triangles.iter().flat_map(|t| corners(&elements, t)).map(|corner| (bits(corner), corner)).collect();
    // A vertex of an element in a tile must not be a corner of another triangle, except at the corners of the tile.
    for (triangle, tile) in coarse.triangles.iter().zip(&coarse.tiles) {
        let own = corners(&elements, triangle);
        for element in coarse.elements.iter().filter(|e| e.corners.iter().all(|&texel| is_in(tile, texel))) {
            for vertex in element.vertices {
                let at = elements.vertices[vertex as usize].position;
                assert!(own.contains(&at) || !used.contains_key(&bits(at)), "{at} is in the middle of {own:?}");
            }
        }
    }
}

#[test]
fn a_vertex_that_another_triangle_touches_is_not_removed() {
    let mut elements = elements_of(&builtin::cornell(), 0.2);
    // Middle of the edge between floor and back wall.
    let middle = Vec3::new(2.748, 0.0, 5.592);
    let num_at = |coarse: &CoarseMesh, elements: &Scene| {
        let places = coarse.triangles.iter().flat_map(|triangle| corners(elements, triangle));
        places.filter(|place| place.distance(middle) < 1e-4).count()
    };
    assert_eq!(num_at(&CoarseMesh::new(&elements, None, MAX_SIDE).expect("a bake"), &elements), 0);
    let touching = elements.vertices.iter().position(|vertex| vertex.position.distance(middle) < 1e-4).expect("halved");
    let vertices = [touching as u32, 0, 1];
    elements.triangles.push(Triangle { vertices, ..elements.triangles[0] });
    assert!(num_at(&CoarseMesh::new(&elements, None, MAX_SIDE).expect("a bake"), &elements) >= 4);
}

fn is_in(tile: &Tile, texel: UVec2) -> bool {
    texel.cmpge(tile.origin).all() && (texel - tile.origin).element_sum() <= tile.side
}

/// Returns the texture, filled as shaders/stored_light/light_tiles.wgsl does it, with a value for each vertex.
fn filled(coarse: &CoarseMesh, value: impl Fn(u32) -> f32) -> Vec<f32> {
    let side = coarse.side;
    let at = |texel: UVec2| (texel.y * side + texel.x) as usize;
    let value_of = |texel: UVec2| {
        let element = &coarse.elements[coarse.element_of[at(texel)] as usize];
        let [a, b, c] = element.corners.map(|corner| corner.as_vec2());
        let (ab, ac, ap) = (b - a, c - a, texel.as_vec2() - a);
        let (v, w) = (ap.perp_dot(ac) / ab.perp_dot(ac), ab.perp_dot(ap) / ab.perp_dot(ac));
        let [x, y, z] = element.vertices.map(&value);
        (1.0 - v - w) * x + v * y + w * z
    };
    let texels = (0..side * side).map(|i| UVec2::new(i % side, i / side));
    let mut texture: Vec<f32> =
        texels.map(|t| if coarse.element_of[at(t)] == NOTHING { f32::NAN } else { value_of(t) }).collect();
    for &texel in &coarse.beyond {
        let sum = value_of(texel - UVec2::X) + value_of(texel - UVec2::Y) - value_of(texel - UVec2::ONE);
        texture[at(texel)] = sum;
    }
    texture
}

/// Interpolates between four texels. Those of weight zero may have any value.
fn sampled(texture: &[f32], side: u32, at: Vec2) -> f32 {
    let (low, share) = (at.floor().as_uvec2(), at.fract());
    let texels = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| {
        let weight = (if x == 1 { share.x } else { 1.0 - share.x }) * (if y == 1 { share.y } else { 1.0 - share.y });
        if weight == 0.0 { 0.0 } else { weight * texture[((low.y + y) * side + low.x + x) as usize] }
    });
    texels.iter().sum()
}

#[test]
fn tiles_reproduce_light_that_is_linear_on_a_surface() {
    let elements = elements_of(&builtin::cornell(), 0.1);
    let coarse = CoarseMesh::new(&elements, None, MAX_SIDE).expect("a bake");
    let light = |p: Vec3| 1.0 + p.dot(Vec3::new(3.0, 5.0, -2.0));
    let texture = filled(&coarse, |v| light(elements.vertices[v as usize].position));
    for (triangle, tile) in coarse.triangles.iter().zip(&coarse.tiles) {
        let [a, b, c] = corners(&elements, triangle);
        for i in 0..16 {
            let [x, y] = r2(i, 0).to_array();
            let [u, v] = if x + y > 1.0 { [1.0 - x, 1.0 - y] } else { [x, y] };
            let found = sampled(&texture, coarse.side, tile.origin.as_vec2() + tile.side as f32 * Vec2::new(u, v));
            let expected = light(a + u * (b - a) + v * (c - a));
            assert!((found - expected).abs() < 1e-3, "{found}, not {expected}, at {u}, {v} of {}", tile.side);
        }
    }
}

#[test]
fn both_sides_of_an_edge_show_the_same_light() {
    let elements = elements_of(&builtin::cornell(), 0.1);
    let coarse = CoarseMesh::new(&elements, None, MAX_SIDE).expect("a bake");
    // An arbitrary function of position that is not smooth.
    let light = |p: Vec3| (p * 1234.5).element_sum().sin();
    let texture = filled(&coarse, |v| light(elements.vertices[v as usize].position));
    let bits = |p: Vec3| (p + Vec3::ZERO).to_array().map(f32::to_bits);
    let mut found: HashMap<_, Vec<(f32, f32)>> = HashMap::new();
    for (triangle, tile) in coarse.triangles.iter().zip(&coarse.tiles) {
        let corners = corners(&elements, triangle);
        let places = [Vec2::ZERO, Vec2::X, Vec2::Y];
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let mut ends = [(bits(corners[i]), places[i]), (bits(corners[j]), places[j])];
            ends.sort_by_key(|end| end.0);
            let [from, to] = ends;
            for step in 0..=64 {
                let place = from.1.lerp(to.1, step as f32 / 64.0);
                let value = sampled(&texture, coarse.side, tile.origin.as_vec2() + tile.side as f32 * place);
                let along = found.entry((from.0, to.0)).or_insert_with(|| vec![(f32::INFINITY, f32::NEG_INFINITY); 65]);
                along[step] = (along[step].0.min(value), along[step].1.max(value));
            }
        }
    }
    let widest = found.values().flatten().map(|(low, high)| high - low).fold(0.0, f32::max);
    assert!(found.len() > 50 && widest < 1e-3, "{widest} on one of {} edges", found.len());
}

#[test]
fn triangles_that_blend_are_not_joined() {
    let mut scene = builtin::cornell();
    for material in &mut scene.materials {
        material.alpha_mode = AlphaMode::Blend;
    }
    assert!(CoarseMesh::new(&elements_of(&scene, 0.1), None, MAX_SIDE).is_none());
}

#[test]
fn scenes_that_are_no_bakes_have_no_coarse_mesh() {
    assert!(CoarseMesh::new(&builtin::gallery(), None, MAX_SIDE).is_none());
    assert!(CoarseMesh::new(&Scene::default(), None, MAX_SIDE).is_none());
}

#[test]
fn a_texture_larger_than_the_limit_is_not_made() {
    let elements = elements_of(&builtin::cornell(), 0.1);
    assert!(CoarseMesh::new(&elements, None, 100).is_none());
}
