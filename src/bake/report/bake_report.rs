//! The report of a bake, written by `--report` as one flat JSON object.

use glam::DVec3;
use serde::Serialize;

use super::memory::Memory;
use super::row_quality::Closure;
use super::seconds::Seconds;
use crate::bake::settings::{BakeSettings, Method, Quality, Solver};
use crate::base::colour::LUMINANCE;
use crate::gpu::Gpu;
use crate::patch::PatchMesh;
use crate::radiosity::solver::Energy;
use crate::scene::Scene;

/// Counts, balances and times of a bake. In JSON the fields of its parts lie side by side, in this order.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Scene and method of the bake.
    #[serde(flatten)]
    pub configuration: Configuration,
    /// Sizes of the scene and of its final mesh.
    #[serde(flatten)]
    pub mesh: MeshCounts,
    /// Amount of work, and what remains unsolved.
    #[serde(flatten)]
    pub work: Work,
    /// Balance of luminous flux, lumen.
    pub energy: Flux,
    /// Measures of the quality of the solution.
    #[serde(flatten)]
    pub certificate: Certificate,
    /// Duration of each stage, seconds.
    pub seconds: Seconds,
    /// Memory, bytes.
    pub memory_bytes: Memory,
}

/// The scene and the method of a bake.
#[derive(Clone, Debug, Serialize)]
pub struct Configuration {
    /// Name of the scene.
    pub scene: String,
    /// Name of the preset.
    pub quality: Quality,
    /// Method by which form factors were computed.
    pub method: Method,
    /// Solver of the system of patches.
    pub solver: Solver,
    /// Name of the device, or `none`.
    pub adapter: String,
}

impl Configuration {
    /// Returns the configuration of a bake by `method`.
    pub(in crate::bake) fn new(scene: &Scene, settings: &BakeSettings, method: Method, gpu: Option<&Gpu>) -> Self {
        Self {
            scene: scene.name.clone(),
            quality: settings.quality,
            method,
            solver: settings.solver,
            adapter: gpu.map_or_else(|| "none".to_owned(), Gpu::name),
        }
    }
}

/// Sizes of a scene and of its final mesh.
#[derive(Clone, Debug, Serialize)]
pub struct MeshCounts {
    /// Number of triangles of the scene.
    pub input_triangles: usize,
    /// Number of elements, which receive light.
    pub elements: usize,
    /// Number of patches, which shoot light.
    pub patches: usize,
    /// Number of light vertices, at which light is stored.
    pub vertices: usize,
    /// Names of the light groups.
    pub light_groups: Vec<String>,
}

impl MeshCounts {
    /// Returns the counts of a scene and its mesh.
    pub(in crate::bake) fn new(scene: &Scene, mesh: &PatchMesh) -> Self {
        Self {
            input_triangles: scene.triangles.len(),
            elements: mesh.elements.len(),
            patches: mesh.patches.len(),
            vertices: mesh.light_vertices.len(),
            light_groups: scene.light_groups.clone(),
        }
    }
}

/// Amount of work of a bake, and what remains unsolved.
#[derive(Clone, Debug, Serialize)]
pub struct Work {
    /// Number of hemicubes or hemispheres sampled, for patches and vertices.
    pub hemicubes: usize,
    /// Width of the hemicubes of the final gather, pixels.
    pub hemicube_px: u32,
    /// Number of shots; a patch may shoot several times.
    pub shots: usize,
    /// Shots per patch, Jacobi passes (pass n adds the light of the n-th reflection) or Gauss-Seidel sweeps.
    pub passes: usize,
    /// Share of the power of the first reflection that was not shot.
    pub unshot_share: f64,
    /// True if the bake was cancelled before its end.
    pub cancelled: bool,
}

/// Measures of the quality of a solution.
#[derive(Clone, Debug, Serialize)]
pub struct Certificate {
    /// Share of the patches' views in which a surface that receives light is visible.
    pub closure: Closure,
    /// Deviation of the form factors between patches from reciprocity, A_i F_ij = A_j F_ji.
    pub reciprocity_residual: f64,
    /// Largest difference of light between two vertices of an element, relative to the brighter one.
    pub largest_neighbour_step: f32,
    /// Mean share of back faces in the views of the final gather.
    pub backface_share: f32,
    /// Number of vertices inside or behind a solid.
    pub hidden_vertices: usize,
}

/// Luminous flux, lumen.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Flux {
    /// Flux that arrived at surfaces straight from the lights.
    pub emitted: f64,
    /// Flux absorbed by surfaces.
    pub absorbed: f64,
    /// Flux reflected but not shot.
    pub unshot: f64,
    /// Flux that left the scene.
    pub escaped: f64,
    /// Share of the emitted power that is missing from the balance, in the worst channel.
    pub imbalance: f64,
}

impl From<Energy> for Flux {
    fn from(energy: Energy) -> Self {
        let flux = |power: DVec3| power.dot(LUMINANCE.as_dvec3());
        Self {
            emitted: flux(energy.emitted),
            absorbed: flux(energy.absorbed),
            unshot: flux(energy.unshot),
            escaped: flux(energy.escaped),
            imbalance: energy.imbalance(),
        }
    }
}
