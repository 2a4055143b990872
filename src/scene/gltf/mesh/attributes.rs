//! Vertex attributes of a primitive, read row by row through accessors.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3, Vec4};
use gltf::json::Index;
use gltf::json::accessor::Accessor;
use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::validation::Checked;

use super::draco::Decoded;
use crate::scene::gltf::error::Cause;
use crate::scene::gltf::file::accessor::Reader;
use crate::scene::gltf::file::document::Document;
use crate::scene::{Vertex, VertexAttribute};

/// Prefix of the names of baked light attributes, after the underscore.
const IRRADIANCE: &str = "IRRADIANCE_";

/// Largest number of sets of four joints per vertex.
const MAX_SETS: u32 = 4;

/// Index of a joint in its skin, and its weight.
pub(crate) type Influence = (usize, f32);

/// Vertex attributes of a primitive.
pub(crate) struct Attributes<'a> {
    document: &'a Document<'a>,
    map: &'a BTreeMap<Checked<Semantic>, Index<Accessor>>,
    decoded: &'a Decoded,
    name: &'a str,
}

impl<'a> Attributes<'a> {
    /// Finds the attributes of `primitive`. `decoded` holds the bytes of accessors that Draco compressed; `name` is
    /// used in messages.
    pub(super) fn new(
        document: &'a Document<'a>,
        primitive: &'a Primitive,
        decoded: &'a Decoded,
        name: &'a str,
    ) -> Self {
        Self { document, map: &primitive.attributes, decoded, name }
    }

    pub(crate) fn reader(&self, semantic: Semantic) -> Result<Option<Reader<'a>>, Cause> {
        self.map.get(&Checked::Valid(semantic)).map(|&index| self.open(index)).transpose()
    }

    pub(crate) fn open(&self, index: Index<Accessor>) -> Result<Reader<'a>, Cause> {
        let decoded = self.decoded.get(&index.value()).map(Vec::as_slice);
        Reader::over(self.document, index, decoded, || self.name.to_owned())
    }

    pub(crate) fn vectors<const N: usize>(
        &self,
        semantic: Semantic,
        rows: &[u32],
    ) -> Result<Option<Vec<[f32; N]>>, Cause> {
        self.reader(semantic)?.map(|reader| reader.vectors(rows)).transpose()
    }

    /// Reads COLOR_0 as RGBA. Integers are read as fractions of their largest value.
    fn colours(&self, rows: &[u32]) -> Result<Option<Vec<Vec4>>, Cause> {
        if self.irradiance_accessors().next().is_some() {
            return self.original_colours(rows);
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

    /// Reads the original vertex colours of a baked primitive from `_COLOR` and `_ALPHA`; its COLOR_0 shows the baked
    /// light.
    fn original_colours(&self, rows: &[u32]) -> Result<Option<Vec<Vec4>>, Cause> {
        let original = |name: &str| self.vectors::<3>(Semantic::Extras(name.to_owned()), rows);
        let (colours, alphas) = (original("COLOR")?, original("ALPHA")?);
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

    pub(super) fn irradiance(&self, rows: &[u32]) -> Result<Vec<VertexAttribute>, Cause> {
        self.irradiance_accessors()
            .map(|(name, index)| {
                let values = self.open(index)?.vectors(rows)?.into_iter().map(Vec3::from).collect();
                Ok(VertexAttribute { name: format!("_{name}"), values })
            })
            .collect()
    }

    pub(super) fn vertices(&self, rows: &[u32], uv_sets: [u32; 2]) -> Result<(Vec<Vertex>, bool), Cause> {
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

    /// Returns the influences of each vertex: JOINTS_n with WEIGHTS_n, without those of weight zero; empty if the
    /// primitive has no joints.
    ///
    /// Source: glTF 2.0, section 3.7.3.3.
    ///
    /// # Errors
    /// Returns an error if an accessor cannot be read.
    pub(super) fn influences(&self, rows: &[u32]) -> Result<Vec<Vec<Influence>>, Cause> {
        let mut influences = Vec::new();
        for set in 0..MAX_SETS {
            let joints = self.vectors::<4>(Semantic::Joints(set), rows)?;
            let weights = self.vectors::<4>(Semantic::Weights(set), rows)?;
            let Some((joints, weights)) = joints.zip(weights) else { break };
            influences.resize(rows.len(), Vec::new());
            for (vertex, (joints, weights)) in influences.iter_mut().zip(joints.into_iter().zip(weights)) {
                let pairs = joints.map(|joint| joint as usize).into_iter().zip(weights);
                vertex.extend(pairs.filter(|&(_, weight)| weight > 0.0));
            }
        }
        Ok(influences)
    }
}
