//! A mesh primitive in its own space: vertices and plain triangles, whatever the file's topology.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3, Vec4};
use gltf::json::accessor::Accessor;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;
use gltf::json::{Extras, Index};

use super::accessor::Reader;
use super::compression::draco::{self, Decoded};
use super::document::Document;
use super::error::Cause;
use super::morph;
use super::skin::{self, Influence};
use crate::scene::{Vertex, VertexAttribute};

/// What the attribute names of stored light begin with.
const IRRADIANCE: &str = "IRRADIANCE_";

/// A primitive, ready to be placed.
#[derive(Clone)]
pub(super) struct Geometry {
    /// Vertices that triangles use, in file order; the normal is zero where the file has none.
    pub vertices: Vec<Vertex>,
    /// Corners, counter-clockwise from the front.
    pub triangles: Vec<[u32; 3]>,
    /// The file has normals.
    pub has_normals: bool,
    /// Stored light at `vertices`.
    pub irradiance: Vec<VertexAttribute>,
    /// Joints that move each of `vertices`; empty where there are none.
    pub influences: Vec<Vec<Influence>>,
    /// It is the back of a double-sided surface, written out by a bake.
    pub is_back_side: bool,
}

/// Attributes of a primitive, read row by row.
pub(super) struct Attributes<'a> {
    document: &'a Document<'a>,
    map: &'a BTreeMap<Checked<Semantic>, Index<Accessor>>,
    decoded: &'a Decoded,
    name: &'a str,
}

impl<'a> Attributes<'a> {
    pub(super) fn reader(&self, semantic: Semantic) -> Result<Option<Reader<'a>>, Cause> {
        self.map.get(&Checked::Valid(semantic)).map(|&index| self.open(index)).transpose()
    }

    pub(super) fn open(&self, index: Index<Accessor>) -> Result<Reader<'a>, Cause> {
        let decoded = self.decoded.get(&index.value()).map(Vec::as_slice);
        Reader::over(self.document, index, decoded, || self.name.to_owned())
    }

    pub(super) fn vectors<const N: usize>(
        &self,
        semantic: Semantic,
        rows: &[u32],
    ) -> Result<Option<Vec<[f32; N]>>, Cause> {
        self.reader(semantic)?.map(|reader| reader.vectors(rows)).transpose()
    }

    /// COLOR_0 as RGBA; integers are fractions of their largest value.
    fn colours(&self, rows: &[u32]) -> Result<Option<Vec<Vec4>>, Cause> {
        if self.irradiance_accessors().next().is_some() {
            return self.baked_paint(rows);
        }
        let Some(reader) = self.reader(Semantic::Colors(0))? else { return Ok(None) };
        let reader = if reader.is_integer() { reader.into_fractions() } else { reader };
        let colours = if reader.width() == 3 {
            reader.vectors(rows)?.into_iter().map(|rgb| Vec3::from(rgb).extend(1.0)).collect()
        } else {
            reader.vectors(rows)?.into_iter().map(Vec4::from).collect()
        };
        Ok(Some(colours))
    }

    /// What COLOR_0 was before a bake made it show the light.
    fn baked_paint(&self, rows: &[u32]) -> Result<Option<Vec<Vec4>>, Cause> {
        let kept = |name: &str| self.vectors::<3>(Semantic::Extras(name.to_owned()), rows);
        let (colours, alphas) = (kept("COLOR")?, kept("ALPHA")?);
        let colour_at = |v: usize| colours.as_ref().map_or(Vec3::ONE, |colours| Vec3::from(colours[v]));
        let alpha_at = |v: usize| alphas.as_ref().map_or(1.0, |alphas| alphas[v][0]);
        Ok(Some((0..rows.len()).map(|v| colour_at(v).extend(alpha_at(v))).collect()))
    }

    fn irradiance_accessors(&self) -> impl Iterator<Item = (&String, Index<Accessor>)> {
        self.map.iter().filter_map(|(semantic, &index)| match semantic {
            Checked::Valid(Semantic::Extras(name)) if name.starts_with(IRRADIANCE) => Some((name, index)),
            _ => None,
        })
    }

    fn irradiance(&self, rows: &[u32]) -> Result<Vec<VertexAttribute>, Cause> {
        self.irradiance_accessors()
            .map(|(name, index)| {
                let values = self.open(index)?.vectors(rows)?.into_iter().map(Vec3::from).collect();
                Ok(VertexAttribute { name: format!("_{name}"), values })
            })
            .collect()
    }

    fn vertices(&self, rows: &[u32], uv_sets: [u32; 2]) -> Result<(Vec<Vertex>, bool), Cause> {
        let positions = self.vectors::<3>(Semantic::Positions, rows)?.unwrap_or_default();
        let normals = self.vectors::<3>(Semantic::Normals, rows)?;
        let [first, second] = uv_sets.map(|set| self.vectors::<2>(Semantic::TexCoords(set), rows));
        let uv = [first?, second?];
        let colours = self.colours(rows)?;
        let uv_at = |set: usize, v: usize| uv[set].as_ref().map_or(Vec2::ZERO, |uv| Vec2::from(uv[v]));
        let vertex = |(v, position): (usize, [f32; 3])| Vertex {
            position: Vec3::from(position),
            normal: normals.as_ref().map_or(Vec3::ZERO, |normals| Vec3::from(normals[v])),
            uv: [uv_at(0, v), uv_at(1, v)],
            colour: colours.as_ref().map_or(Vec4::ONE, |colours| colours[v]),
        };
        Ok((positions.into_iter().enumerate().map(vertex).collect(), normals.is_some()))
    }
}

impl Geometry {
    /// Reads a primitive; none where it has no triangles to show (points, lines, no positions).
    ///
    /// `uv_sets` are the texture coordinates that its material wants, `weights` those of its morph targets.
    pub fn read(
        document: &Document<'_>,
        primitive: &Primitive,
        uv_sets: [u32; 2],
        weights: &[f32],
        name: &str,
    ) -> Result<Option<Self>, Cause> {
        let decoded = draco::decode(document, primitive, name)?;
        let attributes = Attributes { document, map: &primitive.attributes, decoded: &decoded, name };
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
            influences: skin::influences(&attributes, &rows)?,
            is_back_side: says_back_side(&primitive.extras),
        }))
    }
}

fn dangling_vertex(primitive: &Primitive, row: u32) -> Cause {
    let accessor = primitive.indices.map_or(0, |index| index.value());
    Cause::accessor(accessor, format!("index {row} points at no vertex"))
}

/// Corners of the triangles that `mode` makes of vertices in this order (glTF 2.0, section 3.7.2.1).
fn triangulate(mode: Mode, order: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => {
            let swap_odd = |(i, w): (usize, &[u32])| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[0], w[2], w[1]] };
            order.windows(3).enumerate().map(swap_odd).collect()
        }
        Mode::TriangleFan => match order.split_first() {
            Some((&hub, rim)) => rim.windows(2).map(|w| [w[0], w[1], hub]).collect(),
            None => Vec::new(),
        },
        _ => order.chunks_exact(3).map(|w| [w[0], w[1], w[2]]).collect(),
    }
}

/// Renumbers corners so that only used vertices count, and returns those in file order; fails with an index too high.
fn keep_used(triangles: &mut [[u32; 3]], num_vertices: usize) -> Result<Vec<u32>, u32> {
    let mut new_index = vec![u32::MAX; num_vertices];
    for &corner in triangles.iter().flatten() {
        *new_index.get_mut(corner as usize).ok_or(corner)? = 0;
    }
    let mut rows = Vec::new();
    for (row, new) in new_index.iter_mut().enumerate().filter(|(_, new)| **new == 0) {
        *new = rows.len() as u32;
        rows.push(row as u32);
    }
    for corner in triangles.iter_mut().flatten() {
        *corner = new_index[*corner as usize];
    }
    Ok(rows)
}

fn says_back_side(extras: &Extras) -> bool {
    let value = extras.as_ref().and_then(|raw| serde_json::from_str::<serde_json::Value>(raw.get()).ok());
    value.is_some_and(|value| value["back_side"] == true)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::super::fixture::Fixture;
    use super::*;
    use crate::base::ids::TriangleId;
    use crate::scene::{Scene, normal_of};

    /// A unit square in the xy plane, as strip order wants it, with normals along +Z.
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
    fn every_other_triangle_of_a_strip_is_turned() {
        let mut fixture = square();
        fixture.primitive()["mode"] = json!(5);
        assert_faces_plus_z(&fixture.load(), 1.0);
    }

    #[test]
    fn a_fan_goes_round_its_first_vertex() {
        let mut fixture = square();
        fixture.primitive()["mode"] = json!(6);
        fixture.indices(&[0, 1, 3, 2]);
        assert_faces_plus_z(&fixture.load(), 1.0);
    }

    #[test]
    fn unused_vertices_are_left_out_and_the_rest_keep_their_order() {
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
        assert!(fixture.error().contains("accessor 2: index 4 points at no vertex"), "{}", fixture.error());
    }

    #[test]
    fn lines_and_missing_positions_are_noted() {
        let mut fixture = square();
        fixture.primitive()["mode"] = json!(1);
        let scene = fixture.load();
        assert!(scene.triangles.is_empty() && scene.notes[0].contains("points or lines"), "{:?}", scene.notes);
    }

    #[test]
    fn broken_topologies_give_no_triangles() {
        assert!(triangulate(Mode::TriangleFan, &[]).is_empty());
        assert!(triangulate(Mode::TriangleStrip, &[0, 1]).is_empty());
        assert_eq!(triangulate(Mode::Triangles, &[0, 1, 2, 3]).len(), 1);
    }

    #[test]
    fn stored_light_and_back_sides_are_recognised() {
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
        assert_eq!([false, true], [0, 1].map(|t: usize| scene.triangles[t].is_back_side));
    }
}
