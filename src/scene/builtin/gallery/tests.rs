use super::*;
use crate::base::ids::TriangleId;
use crate::scene::{edge_cross, normal_of};

#[test]
fn the_gallery_is_small_and_has_five_light_groups_and_four_cameras() {
    let scene = gallery();
    assert!(scene.triangles.len() < 6000, "{} triangles", scene.triangles.len());
    let mut groups = scene.light_groups.clone();
    groups.sort();
    assert_eq!(groups, ["ceiling panel", "daylight", "lamps", "spot", "sun"]);
    let cameras: Vec<_> = scene.cameras.iter().map(|camera| camera.name.as_str()).collect();
    assert_eq!(cameras, ["entrance", "stairs", "red room", "detail"]);
}

#[test]
fn every_triangle_has_area_and_agrees_with_its_normals() {
    let scene = gallery();
    for instance in &scene.instances {
        for t in instance.triangles.clone() {
            let corners = scene.corners(TriangleId::new(t));
            assert!(edge_cross(corners).length() > 1e-5, "sliver in {}: {corners:?}", instance.name);
            for v in scene.triangles[t].vertices {
                let normal = scene.vertices[v as usize].normal;
                assert!((normal.length() - 1.0).abs() < 1e-5, "{}", instance.name);
                assert!(normal.dot(normal_of(corners)) > 0.6, "{} is inside out", instance.name);
            }
        }
    }
}
