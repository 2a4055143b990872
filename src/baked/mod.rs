//! Floor 2: a scene with its light, the end of the bake and the beginning of every picture.
//!
//! The scene of a [`BakedScene`] has the *elements* as its triangles; double-sided input triangles are written out as a
//! front and a back. Everything that works on a [`Scene`] (rays, shadows, `info`) therefore works on a bake.

pub(crate) mod coarse;
pub mod exposure;
pub mod gltf;
pub mod lightmap;

use std::path::PathBuf;

use glam::Vec3;
use thiserror::Error;

use crate::scene::Scene;

pub use lightmap::{Lightmap, Texels};

/// A bake could not be written.
#[derive(Debug, Error)]
pub enum BakedError {
    /// The file system refused.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file that was to be.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A .glb counts its bytes in 32 bits.
    #[error("the scene takes {bytes} bytes, a .glb file holds 4 GiB; bake with larger elements")]
    TooLarge {
        /// Size of the whole file.
        bytes: usize,
    },
}

/// A scene whose vertices carry light.
#[derive(Clone, Debug, Default)]
pub struct BakedScene {
    /// Elements as triangles.
    pub scene: Scene,
    /// Light at the vertices of `scene`.
    pub light: VertexLight,
}

impl BakedScene {
    /// A scene as its file has it, without any light.
    #[must_use]
    pub fn dark(scene: Scene) -> Self {
        Self { light: VertexLight::dark(scene.light_groups.len(), scene.vertices.len()), scene }
    }
}

/// Irradiance at vertices, direct and indirect apart, light group by light group.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VertexLight {
    /// Light of each group `[g]`, in the order of [`Scene::light_groups`].
    pub groups: Vec<GroupLight>,
}

/// Irradiance that one light group brings, lux per channel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroupLight {
    /// Straight from the lights `[v]`.
    pub direct: Vec<Vec3>,
    /// After at least one reflection `[v]`.
    pub indirect: Vec<Vec3>,
}

impl VertexLight {
    /// No light at all.
    #[must_use]
    pub fn dark(num_groups: usize, num_vertices: usize) -> Self {
        let group = GroupLight { direct: vec![Vec3::ZERO; num_vertices], indirect: vec![Vec3::ZERO; num_vertices] };
        Self { groups: vec![group; num_groups] }
    }
}
