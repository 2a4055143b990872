//! Places a primitive in the world: transformed, wound counter-clockwise, with unit normals.

use glam::{DAffine3, Vec3};

use super::geometry::{Geometry, normal_matrix};
use crate::base::ids::{InstanceId, MaterialId, TriangleId};
use crate::scene::gltf::error::Cause;
use crate::scene::{Instance, Scene, Triangle, Vertex, VertexAttribute, is_degenerate, is_placeable, normal_of};

/// Adds `geometry` to the scene as one instance.
///
/// # Errors
/// Returns an error if a transformed position is not finite or implausibly far away.
pub(crate) fn place(
    scene: &mut Scene,
    geometry: &Geometry,
    world_from_mesh: DAffine3,
    name: String,
    material: MaterialId,
) -> Result<(), Cause> {
    let corners = corner_indices(geometry);
    let sources = vertex_sources(geometry);
    let first = scene.vertices.len();
    add_vertices(scene, geometry, &sources, world_from_mesh, &name)?;
    add_irradiance(scene, geometry, &sources, first);

    let instance = InstanceId::new(scene.instances.len());
    let first_triangle = scene.triangles.len();
    let is_mirrored = world_from_mesh.matrix3.determinant() < 0.0;
    for corners in corners {
        let [a, b, c] = corners.map(|corner| corner + first as u32);
        let vertices = if is_mirrored { [a, c, b] } else { [a, b, c] };
        let positions = vertices.map(|v| scene.vertices[v as usize].position);
        if is_degenerate(positions) {
            scene.dropped_triangles += 1;
            continue;
        }
        set_missing_normals(scene, vertices, normal_of(positions));
        if geometry.is_back {
            scene.sides.add_back(TriangleId::new(scene.triangles.len()));
        }
        scene.triangles.push(Triangle { vertices, material, instance });
    }
    for vertex in scene.vertices[first..].iter_mut().filter(|vertex| vertex.normal == Vec3::ZERO) {
        vertex.normal = Vec3::Y;
    }
    if let Some(record) = &geometry.elements {
        scene.element_records.push((instance, record.clone()));
    }
    scene.instances.push(Instance { name, triangles: first_triangle..scene.triangles.len() });
    Ok(())
}

/// Returns the indices of the geometry's vertices in the order of the scene: unchanged, or three per triangle if the
/// file has no normals, for flat shading.
fn vertex_sources(geometry: &Geometry) -> Vec<u32> {
    if geometry.has_normals {
        (0..geometry.vertices.len() as u32).collect()
    } else {
        geometry.triangles.iter().flatten().copied().collect()
    }
}

/// Returns the corners of the triangles as indices into [`vertex_sources`].
fn corner_indices(geometry: &Geometry) -> Vec<[u32; 3]> {
    if geometry.has_normals {
        geometry.triangles.clone()
    } else {
        (0..geometry.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect()
    }
}

fn add_vertices(
    scene: &mut Scene,
    geometry: &Geometry,
    sources: &[u32],
    world_from_mesh: DAffine3,
    name: &str,
) -> Result<(), Cause> {
    let normal_matrix = normal_matrix(world_from_mesh.matrix3);
    scene.vertices.reserve(sources.len());
    for &source in sources {
        let vertex = &geometry.vertices[source as usize];
        let position = world_from_mesh.transform_point3(vertex.position.as_dvec3()).as_vec3();
        if !is_placeable(position) {
            return Err(Cause::NotFinite(format!("a vertex position of {name:?}")));
        }
        let normal = (normal_matrix * vertex.normal.as_dvec3()).normalize_or_zero().as_vec3();
        scene.vertices.push(Vertex { position, normal, ..*vertex });
    }
    Ok(())
}

/// Adds the baked light. Vertices without an attribute that other primitives have get zeros.
fn add_irradiance(scene: &mut Scene, geometry: &Geometry, sources: &[u32], first: usize) {
    for attribute in &geometry.irradiance {
        let values = match scene.irradiance.iter_mut().find(|stored| stored.name == attribute.name) {
            Some(stored) => &mut stored.values,
            None => {
                scene.irradiance.push(VertexAttribute { name: attribute.name.clone(), values: Vec::new() });
                &mut scene.irradiance.last_mut().expect("just pushed").values
            }
        };
        values.resize(first, Vec3::ZERO);
        values.extend(sources.iter().map(|&source| attribute.values[source as usize]));
    }
    for stored in &mut scene.irradiance {
        stored.values.resize(scene.vertices.len(), Vec3::ZERO);
    }
}

/// Sets normals that are zero to the normal of the face.
fn set_missing_normals(scene: &mut Scene, vertices: [u32; 3], normal: Vec3) {
    for v in vertices {
        let vertex = &mut scene.vertices[v as usize];
        if vertex.normal == Vec3::ZERO {
            vertex.normal = normal;
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::base::ids::TriangleId;
    use crate::scene::gltf::fixture::Fixture;

    fn front_normal(scene: &Scene) -> Vec3 {
        normal_of(scene.corners(TriangleId(0)))
    }

    #[test]
    fn a_mirrored_node_keeps_its_front_faces() {
        let mut fixture = Fixture::triangle();
        fixture.json["nodes"][0]["scale"] = json!([-1, 1, 1]);
        let scene = fixture.load();
        assert_eq!(scene.vertices[1].position, Vec3::NEG_X);
        assert_eq!(front_normal(&scene), Vec3::Z);
        assert_eq!(scene.vertices[0].normal, Vec3::Z);
    }

    #[test]
    fn normals_stay_perpendicular_under_non_uniform_scale() {
        let mut fixture = Fixture::new();
        fixture.floats("POSITION", "VEC3", &[0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0]);
        fixture.floats("NORMAL", "VEC3", &[1.0, 1.0, 0.0].repeat(3));
        fixture.json["nodes"][0]["matrix"] = json!([4, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1]);
        let scene = fixture.load();
        assert_eq!(scene.vertices[0].position.x, 7.0);
        assert!((scene.vertices[0].normal - front_normal(&scene)).length() < 1e-6, "{}", scene.vertices[0].normal);
    }

    #[test]
    fn a_mesh_without_normals_is_shaded_flat() {
        let mut fixture = Fixture::new();
        fixture.floats("POSITION", "VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
        fixture.indices(&[0, 1, 2, 0, 3, 1]);
        let scene = fixture.load();
        assert_eq!(scene.vertices.len(), 6);
        assert!(scene.vertices[..3].iter().all(|vertex| vertex.normal == Vec3::Z));
        assert!(scene.vertices[3..].iter().all(|vertex| vertex.normal == Vec3::Y));
    }

    #[test]
    fn zero_normals_become_the_normal_of_the_face() {
        let mut fixture = Fixture::triangle();
        fixture.floats("NORMAL", "VEC3", &[0.0; 9]);
        assert!(fixture.load().vertices.iter().all(|vertex| vertex.normal == Vec3::Z));
    }

    #[test]
    fn triangles_without_area_are_dropped_and_counted() {
        let mut fixture = Fixture::triangle();
        fixture.indices(&[0, 1, 1, 0, 1, 2]);
        let scene = fixture.load();
        assert_eq!((scene.triangles.len(), scene.dropped_triangles), (1, 1));
        assert!(scene.notes.iter().any(|note| note.contains("without area")), "{:?}", scene.notes);
    }

    #[test]
    fn instances_share_a_mesh_and_keep_their_triangles_together() {
        let mut fixture = Fixture::triangle();
        fixture.json["nodes"] =
            json!([{"mesh": 0, "name": "left", "children": [1]}, {"mesh": 0, "translation": [5, 0, 0]}]);
        let scene = fixture.load();
        assert_eq!(scene.instances.len(), 2);
        assert_eq!((scene.instances[0].name.as_str(), scene.instances[1].triangles.clone()), ("left", 1..2));
        assert_eq!(scene.vertices[3].position.x, 5.0);
    }

    #[test]
    fn a_transform_to_implausible_positions_is_refused() {
        let mut fixture = Fixture::triangle();
        fixture.json["nodes"][0]["scale"] = json!([1e30, 1, 1]);
        assert!(fixture.error().contains("vertex position"), "{}", fixture.error());
        fixture.json["nodes"][0]["scale"] = json!([1e300, 1, 1]);
        assert!(fixture.error().contains("transform of node 0"), "{}", fixture.error());
    }
}
