//! The size and memory of a bake, predicted before it starts.

use super::settings::{BakeSettings, Method, SHOOTING_RAYS};
use crate::form_factor::Entry;
use crate::patch::{Element, MeshError, PatchMesh};
use crate::scene::{Scene, Triangle, Vertex};

/// Memory of the program, the driver and their buffers, bytes.
const PROGRAM: usize = 82 << 20;

/// Memory for drawing hemicubes with a software driver, bytes. `DRAWING` is that of the driver, its shader compiler and
/// the atlases, `DRAWN_TRIANGLE` that of the driver and of the index lists per triangle.
const DRAWING: usize = 140 << 20;
const DRAWN_TRIANGLE: usize = 2200;

/// Elements that subdivision typically adds, as a share of the largest number that it may add. The first value is for
/// scenes whose lights all cast soft shadows, the second for scenes with lights that cast hard ones.
const TYPICAL_GROWTH: [f64; 2] = [0.1, 0.8];

/// Number of entries of a row, as a share of its rays. Rays that hit the same element share an entry.
const SHARE_OF_ENTRIES: f64 = 0.5;

/// Number of copies of the mesh and of the displayed scene that a bake holds at a time.
const COPIES: usize = 5;

/// Memory of the ray tree, bytes per triangle.
const RAY_TREE: usize = 110;

/// Predicted counts and memory of a bake.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forecast {
    /// Number of elements before subdivision by light.
    pub elements: usize,
    /// Number of patches.
    pub patches: usize,
    /// Number of light vertices before subdivision by light.
    pub vertices: usize,
    /// Peak memory of the process, bytes.
    pub bytes: usize,
}

impl Forecast {
    /// Meshes the scene and predicts the rest. If the settings contain no method, the prediction is for rays.
    ///
    /// # Errors
    /// Returns an error if the scene cannot be meshed.
    pub fn of(scene: &Scene, settings: &BakeSettings) -> Result<Self, MeshError> {
        let mesh = PatchMesh::new(scene, &settings.mesh_settings(scene))?;
        Ok(Self::of_mesh(scene, &mesh, settings, settings.method.unwrap_or(Method::Hemisphere)))
    }

    /// Predicts the same as [`Self::of`], for a meshed scene and a chosen method.
    #[must_use]
    pub fn of_mesh(scene: &Scene, mesh: &PatchMesh, settings: &BakeSettings, method: Method) -> Self {
        let added = if settings.refinement.max_error > 0.0 {
            let most = settings.max_elements(scene).saturating_sub(mesh.elements.len());
            TYPICAL_GROWTH[usize::from(!scene.lights.is_empty())] * most as f64
        } else {
            0.0
        };
        let growth = 1.0 + added / mesh.elements.len().max(1) as f64;
        let grown = |count: usize| (count as f64 * growth) as usize;
        let colour = size_of::<glam::Vec3>() * scene.light_groups.len();
        let an_element = size_of::<Element>() + size_of::<Triangle>() + 2 * colour;
        let a_vertex = size_of::<Vertex>() + 3 * colour;
        let textures: usize = scene.textures.iter().map(|texture| texture.image.rgba.len()).sum();
        let input = scene.vertices.len() * size_of::<Vertex>() + scene.triangles.len() * size_of::<Triangle>();
        let row = (f64::from(SHOOTING_RAYS) * SHARE_OF_ENTRIES) as usize * size_of::<Entry>();
        let rows = (mesh.patches.len() * settings.sampling.points_a_patch * row).min(super::settings::ROW_BYTES);
        let cut = grown(mesh.elements.len()) * an_element + grown(mesh.vertices.len()) * a_vertex;
        let drawing = match method {
            Method::Hemicube => DRAWING + scene.triangles.len() * DRAWN_TRIANGLE,
            Method::Hemisphere => 0,
        };
        let bytes = PROGRAM + drawing + textures + input + scene.triangles.len() * RAY_TREE + COPIES * cut + rows;
        Self { elements: mesh.elements.len(), patches: mesh.patches.len(), vertices: mesh.light_vertices.len(), bytes }
    }
}
