use glam::{Vec2, Vec3, Vec4};

use super::*;
use crate::base::ids::{GroupId, InstanceId, MaterialId};
use crate::scene::{Light, LightKind, Material, Triangle, Vertex};

/// A scene of white diffuse triangles over these positions, no vertex shared, normals as the winding has them.
fn soup(corners: &[[[f32; 3]; 3]]) -> Scene {
    let vertices = corners.iter().flat_map(|corners| {
        let positions = corners.map(Vec3::from);
        let normal = normal_of(positions);
        positions.map(|position| Vertex { position, normal, uv: [Vec2::ZERO; 2], colour: Vec4::ONE })
    });
    let triangle = |t: usize| Triangle {
        vertices: [0, 1, 2].map(|c| 3 * t as u32 + c),
        material: MaterialId(0),
        instance: InstanceId(0),
        is_back_side: false,
    };
    Scene {
        vertices: vertices.collect(),
        triangles: (0..corners.len()).map(triangle).collect(),
        materials: vec![Material { name: "white".to_owned(), metallic: 0.0, ..Material::default() }],
        ..Scene::default()
    }
}

const O: [f32; 3] = [0.0, 0.0, 0.0];
const X: [f32; 3] = [1.0, 0.0, 0.0];
const Y: [f32; 3] = [0.0, 1.0, 0.0];
const Z: [f32; 3] = [0.0, 0.0, 1.0];
/// A point of the edge from O to X.
const INSIDE_X: [f32; 3] = [0.3, 0.0, 0.0];
const MINUS_Y: [f32; 3] = [0.0, -1.0, 0.0];

fn count(scene: &Scene, kind: Kind) -> usize {
    examine(scene).count(kind)
}

#[test]
fn a_closed_tetrahedron_is_healthy_but_bright_and_dark() {
    let scene = soup(&[[O, Y, X], [O, X, Z], [O, Z, Y], [X, Y, Z]]);
    let found: Vec<_> = examine(&scene).findings.iter().map(|finding| finding.kind).collect();
    assert_eq!(found, [Kind::BrightMaterial, Kind::Dark]);
    assert_eq!(examine(&scene).findings[0].detail, "white");
}

#[test]
fn a_missing_face_opens_three_edges_and_shows_them() {
    let findings = examine(&soup(&[[O, Y, X], [O, X, Z], [O, Z, Y]]));
    let open = findings.findings.iter().find(|finding| finding.kind == Kind::OpenEdge).expect("found");
    assert_eq!((open.count, open.places.len()), (3, 3));
    assert!(open.places.iter().flat_map(|place| &place.lines).flatten().all(|end| *end != Vec3::ZERO));
}

#[test]
fn a_flipped_face_is_wound_against_its_three_neighbours() {
    let scene = soup(&[[O, X, Y], [O, X, Z], [O, Z, Y], [X, Y, Z]]);
    assert_eq!((count(&scene, Kind::FlippedWinding), count(&scene, Kind::OpenEdge)), (3, 0));
}

#[test]
fn normals_that_point_to_the_back_are_found() {
    let mut scene = soup(&[[O, X, Y], [O, X, Z]]);
    scene.vertices[..3].iter_mut().for_each(|vertex| vertex.normal = -vertex.normal);
    assert_eq!(count(&scene, Kind::NormalAgainstWinding), 1);
}

#[test]
fn doubles_count_whichever_corner_comes_first_but_backs_do_not() {
    let mut scene = soup(&[[O, X, Y], [X, Y, O], [O, Y, X]]);
    assert_eq!((count(&scene, Kind::DuplicateTriangle), count(&scene, Kind::NonManifoldEdge)), (1, 3));
    assert_eq!(count(&scene, Kind::CoplanarOverlap), 0, "doubles are counted once");
    scene.triangles[1].is_back_side = true;
    assert_eq!(count(&scene, Kind::DuplicateTriangle), 0);
}

#[test]
fn three_sheets_at_an_edge_are_not_a_manifold() {
    assert_eq!(count(&soup(&[[O, X, Y], [O, X, Z], [X, O, MINUS_Y]]), Kind::NonManifoldEdge), 1);
}

#[test]
fn a_vertex_inside_an_edge_is_a_t_junction_and_one_at_its_end_is_not() {
    let split = soup(&[[O, X, Y], [INSIDE_X, O, MINUS_Y], [X, INSIDE_X, MINUS_Y]]);
    assert_eq!(count(&split, Kind::TJunction), 1);
    let whole = soup(&[[O, X, Y], [X, O, MINUS_Y]]);
    assert_eq!(count(&whole, Kind::TJunction), 0);
    let beside = soup(&[[O, X, Y], [[0.3, 0.0, 0.01], Z, MINUS_Y]]);
    assert_eq!(count(&beside, Kind::TJunction), 0);
}

#[test]
fn overlaps_in_a_plane_are_found_whichever_way_they_face_and_neighbours_are_not() {
    let shifted = [[0.25, 0.25, 0.0], [1.25, 0.25, 0.0], [0.25, 1.25, 0.0f32]];
    let [a, b, c] = shifted;
    assert_eq!(count(&soup(&[[O, X, Y], [a, b, c]]), Kind::CoplanarOverlap), 2);
    assert_eq!(count(&soup(&[[O, X, Y], [a, c, b]]), Kind::CoplanarOverlap), 2);
    let corner = [1.0, 1.0, 0.0];
    assert_eq!(count(&soup(&[[O, X, Y], [X, corner, Y]]), Kind::CoplanarOverlap), 0);
    assert_eq!(count(&soup(&[[O, X, Y], [X, Y, corner]]), Kind::CoplanarOverlap), 0);
    let lifted = shifted.map(|[x, y, _]| [x, y, 0.001]);
    assert_eq!(count(&soup(&[[O, X, Y], lifted]), Kind::CoplanarOverlap), 0);
}

#[test]
fn a_scene_in_millimetres_is_doubted() {
    let findings = examine(&soup(&[[O, [4000.0, 0.0, 0.0], [0.0, 3000.0, 0.0]]]));
    assert_eq!(findings.count(Kind::DoubtfulScale), 1);
    assert!(findings.lines().iter().any(|line| line.contains("5000.000 m")), "{:?}", findings.lines());
}

#[test]
fn an_empty_scene_is_said_to_be_empty_and_nothing_else_but_dark() {
    let found: Vec<_> = examine(&Scene::default()).findings.iter().map(|finding| finding.kind).collect();
    assert_eq!(found, [Kind::Empty, Kind::Dark]);
}

/// A spot 3 m above the triangle.
fn spot(direction: Vec3, range: Option<f32>) -> Light {
    let kind = LightKind::Spot { position: Vec3::new(0.2, 0.2, 3.0), direction, inner_angle: 0.0, outer_angle: 0.3 };
    Light { name: "spot".into(), kind, intensity: Vec3::ONE, range, profile: None, group: GroupId(0) }
}

#[test]
fn lights_that_reach_nothing_are_named() {
    let idle = |light| {
        let scene = Scene { lights: vec![light], ..soup(&[[O, X, Y]]) };
        count(&scene, Kind::LightWithoutEffect)
    };
    assert_eq!(idle(spot(Vec3::NEG_Z, None)), 0);
    assert_eq!(idle(spot(Vec3::NEG_Z, Some(4.0))), 0);
    assert_eq!(idle(spot(Vec3::Z, None)), 1, "it shines the other way");
    assert_eq!(idle(spot(Vec3::NEG_Z, Some(1.0))), 1, "it ends too soon");
}

#[test]
fn a_glow_that_nothing_wears_has_no_effect() {
    let mut scene = soup(&[[O, X, Y]]);
    scene.materials.push(Material { name: "neon".into(), emission: Vec3::ONE, ..Material::default() });
    let findings = examine(&scene);
    assert_eq!(findings.count(Kind::LightWithoutEffect), 1);
    assert!(findings.lines().iter().any(|line| line.contains("neon")), "{:?}", findings.lines());
}
