//! A mesh primitive in mesh space: vertices and separate triangles, whatever the topology in the file.

use glam::DMat3;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;
use serde_json::Value;

use super::attributes::{Attributes, Influence};
use super::topology::{keep_used, triangulate};
use super::{draco, morph};
use crate::scene::gltf::error::Cause;
use crate::scene::gltf::file::document::Document;
use crate::scene::{ElementRecord, Vertex, VertexAttribute};

/// A primitive in mesh space.
#[derive(Clone)]
pub(crate) struct Geometry {
    /// The vertices that triangles use, in file order; the normal is zero if the file has none.
    pub vertices: Vec<Vertex>,
    /// Corners, counter-clockwise as seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// True if the file has normals.
    pub has_normals: bool,
    /// Baked light at `vertices`.
    pub irradiance: Vec<VertexAttribute>,
    /// Joints and weights of each of `vertices`; empty if the primitive is not skinned.
    pub influences: Vec<Vec<Influence>>,
    /// True if it is the back of a double-sided surface, which a bake writes as separate triangles.
    pub is_back: bool,
    /// Record of a bake about its triangles; `None` if no bake wrote the primitive.
    pub elements: Option<ElementRecord>,
}

impl Geometry {
    /// Reads a primitive. `None` if it has no triangles: points, lines, or no positions.
    ///
    /// `uv_sets` are the texture coordinate sets of its material, `weights` those of its morph targets. `name`
    /// identifies the primitive in messages.
    ///
    /// # Errors
    /// Returns an error if an accessor cannot be read or an index refers to no vertex.
    pub fn read(
        document: &Document<'_>,
        primitive: &Primitive,
        uv_sets: [u32; 2],
        weights: &[f32],
        name: &str,
    ) -> Result<Option<Self>, Cause> {
        let decoded = draco::decode(document, primitive, name)?;
        let extras = extras(primitive);
        let attributes = Attributes::new(document, primitive, &decoded, name);
        let Some(positions) = attributes.reader(Semantic::Positions)? else { return Ok(None) };
        let Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) = primitive.mode else {
            return Ok(None);
        };
        let order = match primitive.indices {
            Some(index) => attributes.open(index)?.indices()?,
            None => (0..positions.count() as u32).collect(),
        };
        let mut triangles = triangulate(mode, &order);
        let rows = keep_used(&mut triangles, positions.count()).map_err(|row| dangling_vertex(primitive, row))?;
        let (mut vertices, has_normals) = attributes.vertices(&rows, uv_sets)?;
        morph::apply(&attributes, primitive.targets.as_deref().unwrap_or_default(), weights, &rows, &mut vertices)?;
        Ok(Some(Self {
            vertices,
            triangles,
            has_normals,
            irradiance: attributes.irradiance(&rows)?,
            influences: attributes.influences(&rows)?,
            is_back: extras["back_side"] == true,
            elements: element_record(&extras["elements"]),
        }))
    }
}

fn dangling_vertex(primitive: &Primitive, row: u32) -> Cause {
    let accessor = primitive.indices.map_or(0, |index| index.value());
    Cause::accessor(accessor, format!("index {row} refers to no vertex"))
}

/// Returns the `extras` of a primitive; null if there are none.
fn extras(primitive: &Primitive) -> Value {
    let value = primitive.extras.as_ref().and_then(|raw| serde_json::from_str(raw.get()).ok());
    value.unwrap_or_default()
}

/// Returns the record of a bake about the triangles of a primitive; `None` if there is none or it has no version.
fn element_record(elements: &Value) -> Option<ElementRecord> {
    Some(ElementRecord {
        version: elements["version"].as_u64()?,
        trees: elements["trees"].as_str().map(str::to_owned),
        back_of: elements["back_of"].as_u64().and_then(|count| usize::try_from(count).ok()),
    })
}

/// Returns the matrix that transforms normals: the inverse transpose of `linear` up to a positive factor. It is
/// computed from cofactors, so it exists for singular transforms, too.
pub(crate) fn normal_matrix(linear: DMat3) -> DMat3 {
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = linear;
    let sign = if linear.determinant() < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use serde_json::json;

    use super::*;
    use crate::base::ids::{InstanceId, TriangleId};
    use crate::scene::gltf::fixture::Fixture;
    use crate::scene::{Scene, normal_of};

    /// Returns a unit square in the xy plane with its vertices in strip order and normals along +Z.
    fn square() -> Fixture {
        let mut fixture = Fixture::new();
        fixture.floats("POSITION", "VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0]);
        fixture.floats("NORMAL", "VEC3", &[0.0, 0.0, 1.0].repeat(4));
        fixture
    }

    fn assert_faces_plus_z(scene: &Scene, area: f64) {
        assert!((scene.area() - area).abs() < 1e-6, "area {}", scene.area());
        for t in 0..scene.triangles.len() {
            assert_eq!(normal_of(scene.corners(TriangleId::new(t))), Vec3::Z, "triangle {t}");
        }
    }

    #[test]
    fn triangles_need_no_indices() {
        assert_faces_plus_z(&Fixture::triangle().load(), 0.5);
    }

    #[test]
    fn every_other_triangle_of_a_strip_has_its_winding_swapped() {
        let mut fixture = square();
        fixture.primitive()["mode"] = json!(5);
        assert_faces_plus_z(&fixture.load(), 1.0);
    }

    #[test]
    fn the_triangles_of_a_fan_share_its_first_vertex() {
        let mut fixture = square();
        fixture.primitive()["mode"] = json!(6);
        fixture.indices(&[0, 1, 3, 2]);
        assert_faces_plus_z(&fixture.load(), 1.0);
    }

    #[test]
    fn unused_vertices_are_dropped_and_the_rest_keep_their_order() {
        let mut fixture = square();
        fixture.indices(&[3, 2, 1]);
        let scene = fixture.load();
        assert_eq!(scene.vertices.len(), 3);
        assert_eq!(scene.triangles[0].vertices, [2, 1, 0]);
        assert_eq!(scene.vertices[0].position, Vec3::X);
    }

    #[test]
    fn an_index_without_a_vertex_names_its_accessor() {
        let mut fixture = square();
        fixture.indices(&[0, 1, 4]);
        assert!(fixture.error().contains("accessor 2: index 4 refers to no vertex"), "{}", fixture.error());
    }

    #[test]
    fn primitives_of_lines_are_noted() {
        let mut fixture = square();
        fixture.primitive()["mode"] = json!(1);
        let scene = fixture.load();
        assert!(scene.triangles.is_empty() && scene.notes[0].contains("points or lines"), "{:?}", scene.notes);
    }

    #[test]
    fn baked_light_and_back_sides_are_recognised() {
        let mut fixture = Fixture::triangle();
        fixture.floats("_IRRADIANCE_DIRECT_0", "VEC3", &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        fixture.primitive()["extras"] = json!({"back_side": true});
        let mut plain = fixture.json["meshes"][0]["primitives"][0].clone();
        plain["attributes"].as_object_mut().expect("an object").remove("_IRRADIANCE_DIRECT_0");
        plain["extras"] = json!(null);
        fixture.json["meshes"][0]["primitives"] = json!([plain, fixture.json["meshes"][0]["primitives"][0]]);
        let scene = fixture.load();
        assert_eq!(scene.irradiance[0].name, "_IRRADIANCE_DIRECT_0");
        assert_eq!(scene.irradiance[0].values[2..4], [Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0)]);
        assert_eq!(scene.irradiance[0].values.len(), scene.vertices.len());
        assert_eq!([false, true], [0, 1].map(|t: usize| scene.sides.is_back(TriangleId::new(t))));
    }

    #[test]
    fn records_of_elements_are_read_as_far_as_they_have_the_right_types() {
        let record =
            |trees: Option<&str>, back_of| ElementRecord { version: 1, trees: trees.map(str::to_owned), back_of };
        for (elements, expected) in [
            (json!({"version": 1, "trees": "1ba", "back_of": 1}), Some(record(Some("1ba"), Some(1)))),
            (json!({"version": 1, "trees": 7, "back_of": -1}), Some(record(None, None))),
            (json!({"trees": "a"}), None),
            (json!("a"), None),
        ] {
            let mut fixture = Fixture::triangle();
            fixture.primitive()["extras"] = json!({ "elements": elements });
            let expected: Vec<_> = expected.map(|record| (InstanceId(0), record)).into_iter().collect();
            assert_eq!(fixture.load().element_records, expected);
        }
    }
}
