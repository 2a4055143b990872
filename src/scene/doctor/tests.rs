use glam::Vec3;

use super::*;
use crate::scene::{Light, Material, SceneBuilder};

/// Returns a scene of white diffuse triangles over these positions without shared vertices; normals follow the winding.
fn soup(corners: &[[[f32; 3]; 3]]) -> Scene {
    let mut builder = SceneBuilder::default();
    let white = builder.material(Material { name: "white".to_owned(), ..Material::diffuse(Vec3::ONE) });
    for corners in corners {
        builder.triangle(corners.map(Vec3::from), white);
    }
    builder.build()
}

const O: [f32; 3] = [0.0, 0.0, 0.0];
const X: [f32; 3] = [1.0, 0.0, 0.0];
const Y: [f32; 3] = [0.0, 1.0, 0.0];
const Z: [f32; 3] = [0.0, 0.0, 1.0];
/// A point of the edge from O to X.
const INSIDE_X: [f32; 3] = [0.3, 0.0, 0.0];
const MINUS_Y: [f32; 3] = [0.0, -1.0, 0.0];

fn count(scene: &Scene, kind: FindingKind) -> usize {
    examine(scene).count(kind)
}

#[test]
fn a_closed_tetrahedron_is_sound_but_bright_and_dark() {
    let scene = soup(&[[O, Y, X], [O, X, Z], [O, Z, Y], [X, Y, Z]]);
    let found: Vec<_> = examine(&scene).findings.iter().map(|finding| finding.kind).collect();
    assert_eq!(found, [FindingKind::BrightMaterial, FindingKind::Dark]);
    assert_eq!(examine(&scene).findings[0].detail, "white");
}

#[test]
fn a_missing_face_opens_three_edges_with_their_locations() {
    let findings = examine(&soup(&[[O, Y, X], [O, X, Z], [O, Z, Y]]));
    let open = findings.findings.iter().find(|finding| finding.kind == FindingKind::OpenEdge).expect("found");
    assert_eq!((open.count, open.locations.len()), (3, 3));
    assert!(open.locations.iter().flat_map(|location| &location.lines).flatten().all(|end| *end != Vec3::ZERO));
}

#[test]
fn a_flipped_face_has_the_opposite_winding_of_its_three_neighbours() {
    let scene = soup(&[[O, X, Y], [O, X, Z], [O, Z, Y], [X, Y, Z]]);
    assert_eq!((count(&scene, FindingKind::FlippedWinding), count(&scene, FindingKind::OpenEdge)), (3, 0));
}

#[test]
fn normals_that_point_to_the_back_are_found() {
    let mut scene = soup(&[[O, X, Y], [O, X, Z]]);
    scene.vertices[..3].iter_mut().for_each(|vertex| vertex.normal = -vertex.normal);
    assert_eq!(count(&scene, FindingKind::NormalAgainstWinding), 1);
}

#[test]
fn duplicates_count_whichever_corner_comes_first_but_backs_do_not() {
    let mut scene = soup(&[[O, X, Y], [X, Y, O], [O, Y, X]]);
    assert_eq!((count(&scene, FindingKind::DuplicateTriangle), count(&scene, FindingKind::NonManifoldEdge)), (1, 3));
    assert_eq!(count(&scene, FindingKind::CoplanarOverlap), 0, "duplicates are counted once");
    scene.sides.add_back(TriangleId(1));
    assert_eq!(count(&scene, FindingKind::DuplicateTriangle), 0);
}

#[test]
fn three_sheets_at_an_edge_are_non_manifold() {
    assert_eq!(count(&soup(&[[O, X, Y], [O, X, Z], [X, O, MINUS_Y]]), FindingKind::NonManifoldEdge), 1);
}

#[test]
fn a_vertex_inside_an_edge_is_a_t_junction_and_one_at_its_end_is_not() {
    let split = soup(&[[O, X, Y], [INSIDE_X, O, MINUS_Y], [X, INSIDE_X, MINUS_Y]]);
    assert_eq!(count(&split, FindingKind::TJunction), 1);
    let whole = soup(&[[O, X, Y], [X, O, MINUS_Y]]);
    assert_eq!(count(&whole, FindingKind::TJunction), 0);
    let beside = soup(&[[O, X, Y], [[0.3, 0.0, 0.01], Z, MINUS_Y]]);
    assert_eq!(count(&beside, FindingKind::TJunction), 0);
}

#[test]
fn coplanar_overlaps_are_found_whichever_way_they_face_but_neighbours_are_not() {
    let shifted = [[0.25, 0.25, 0.0], [1.25, 0.25, 0.0], [0.25, 1.25, 0.0f32]];
    let [a, b, c] = shifted;
    assert_eq!(count(&soup(&[[O, X, Y], [a, b, c]]), FindingKind::CoplanarOverlap), 2);
    assert_eq!(count(&soup(&[[O, X, Y], [a, c, b]]), FindingKind::CoplanarOverlap), 2);
    let corner = [1.0, 1.0, 0.0];
    assert_eq!(count(&soup(&[[O, X, Y], [X, corner, Y]]), FindingKind::CoplanarOverlap), 0);
    assert_eq!(count(&soup(&[[O, X, Y], [X, Y, corner]]), FindingKind::CoplanarOverlap), 0);
    let lifted = shifted.map(|[x, y, _]| [x, y, 0.001]);
    assert_eq!(count(&soup(&[[O, X, Y], lifted]), FindingKind::CoplanarOverlap), 0);
}

#[test]
fn a_scene_in_millimetres_has_a_doubtful_scale() {
    let findings = examine(&soup(&[[O, [4000.0, 0.0, 0.0], [0.0, 3000.0, 0.0]]]));
    assert_eq!(findings.count(FindingKind::DoubtfulScale), 1);
    assert!(findings.lines().iter().any(|line| line.contains("5000.000 m")), "{:?}", findings.lines());
}

#[test]
fn an_empty_scene_is_reported_as_empty_and_dark_only() {
    let found: Vec<_> = examine(&Scene::default()).findings.iter().map(|finding| finding.kind).collect();
    assert_eq!(found, [FindingKind::Empty, FindingKind::Dark]);
}

/// Returns a spot 3 m above the triangle.
fn spot(direction: Vec3, range: Option<f32>) -> Light {
    Light { range, ..Light::spot(Vec3::new(0.2, 0.2, 3.0), direction, [0.0, 0.3], Vec3::ONE) }
}

#[test]
fn lights_that_reach_no_surface_are_reported() {
    let idle = |light| {
        let scene = Scene { lights: vec![light], ..soup(&[[O, X, Y]]) };
        count(&scene, FindingKind::LightWithoutEffect)
    };
    assert_eq!(idle(spot(Vec3::NEG_Z, None)), 0);
    assert_eq!(idle(spot(Vec3::NEG_Z, Some(4.0))), 0);
    assert_eq!(idle(spot(Vec3::Z, None)), 1, "it points the other way");
    assert_eq!(idle(spot(Vec3::NEG_Z, Some(1.0))), 1, "its range is too short");
}

#[test]
fn an_emissive_material_that_no_triangle_uses_has_no_effect() {
    let mut scene = soup(&[[O, X, Y]]);
    scene.materials.push(Material { name: "neon".into(), emission: Vec3::ONE, ..Material::default() });
    let findings = examine(&scene);
    assert_eq!(findings.count(FindingKind::LightWithoutEffect), 1);
    assert!(findings.lines().iter().any(|line| line.contains("neon")), "{:?}", findings.lines());
}
