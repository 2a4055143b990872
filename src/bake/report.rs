//! The solution's certificate, written by `--report`.

use glam::DVec3;
use serde::Serialize;

use super::certificate::Closure;
use super::settings::{Method, Quality, Solver};
use super::watch::Seconds;
use crate::base::colour::LUMINANCE;
use crate::radiosity::solver::Energy;

/// Counts, balances and times of a bake.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the scene.
    pub scene: String,
    /// Preset.
    pub quality: Quality,
    /// How form factors were found.
    pub method: Method,
    /// How the system was solved.
    pub solver: Solver,
    /// The device.
    pub adapter: String,
    /// Triangles of the scene.
    pub input_triangles: usize,
    /// Receivers of light.
    pub elements: usize,
    /// Shooters of light.
    pub patches: usize,
    /// Places at which light is stored.
    pub vertices: usize,
    /// Light groups.
    pub light_groups: Vec<String>,
    /// Hemicubes drawn.
    pub hemicubes: usize,
    /// Pixels across a gathering hemicube.
    pub hemicube_px: u32,
    /// Patches that shot, repeats counted.
    pub shots: usize,
    /// Shots a patch, gathering passes (the light of the last is that of as many reflections) or sweeps over the matrix.
    pub passes: usize,
    /// Share of the first reflected power that was not shot.
    pub unshot_share: f64,
    /// The bake was cancelled before its end.
    pub cancelled: bool,
    /// Where the light went, luminous flux in lumen.
    pub energy: Flux,
    /// Share of the patches' views that ends on surfaces that receive.
    pub closure: Closure,
    /// How far the form factors between patches are from A_i F_ij = A_j F_ji.
    pub reciprocity_residual: f64,
    /// Largest step of light between two vertices of an element, relative to the brighter one.
    pub largest_neighbour_step: f32,
    /// Share of back faces that the gathering sites saw.
    pub backface_share: f32,
    /// Viewpoints found inside or behind something.
    pub hidden_vertices: usize,
    /// By stage.
    pub seconds: Seconds,
    /// Memory.
    pub memory_bytes: Memory,
}

/// Bytes.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Memory {
    /// Foretold before the bake.
    pub predicted: u64,
    /// Most that the program has held until the end of the bake; null where the system does not tell.
    pub peak: Option<u64>,
}

/// Luminous flux, lumen.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Flux {
    /// Arrived at surfaces straight from the lights.
    pub emitted: f64,
    /// Kept by surfaces.
    pub absorbed: f64,
    /// Reflected but not shot.
    pub unshot: f64,
    /// Left the scene.
    pub escaped: f64,
    /// Share of the emitted power not accounted for, in the worst channel.
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
