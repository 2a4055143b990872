//! What a bake will take, before it is begun.

use super::settings::{BakeSettings, Method, SHOOTING_RAYS};
use crate::form_factor::Entry;
use crate::patch::{Element, MeshError, PatchMesh};
use crate::scene::{Scene, Triangle, Vertex};

/// Program, driver and their buffers, bytes.
const PROGRAM: usize = 82 << 20;

/// A software driver that draws hemicubes, its shader compiler and the atlases, bytes; and what it and the lists of
/// indices hold of each triangle.
const DRAWING: usize = 140 << 20;
const DRAWN_TRIANGLE: usize = 2200;

/// Elements that halving where light changes adds, as a share of the most that it may add: under lights that throw soft
/// shadows only, and under lights that throw hard ones. Where their edges lie is not known yet.
const TYPICAL_GROWTH: [f64; 2] = [0.1, 0.8];

/// Rays of a row that meet an element of their own.
const SHARE_OF_ENTRIES: f64 = 0.5;

/// Copies of the mesh and of the drawn scene that a bake holds at a time.
const COPIES: usize = 5;

/// Bytes a triangle of the ray tree.
const RAY_TREE: usize = 110;

/// Counts and memory of a bake to come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forecast {
    /// Elements before light refines them.
    pub elements: usize,
    /// Shooters.
    pub patches: usize,
    /// Places at which light is stored, before light refines the mesh.
    pub vertices: usize,
    /// Most memory that the program will hold.
    pub bytes: usize,
}

impl Forecast {
    /// Cuts the scene to see; light is not asked for. Without a method in the settings, rays are foretold.
    ///
    /// # Errors
    /// The scene cannot be cut.
    pub fn of(scene: &Scene, settings: &BakeSettings) -> Result<Self, MeshError> {
        let mesh = PatchMesh::new(scene, &settings.mesh_settings(scene))?;
        Ok(Self::of_mesh(scene, &mesh, settings, settings.method.unwrap_or(Method::Hemisphere)))
    }

    /// As [`Self::of`], for a scene that has been cut and a method that has been chosen.
    #[must_use]
    pub fn of_mesh(scene: &Scene, mesh: &PatchMesh, settings: &BakeSettings, method: Method) -> Self {
        let added = if settings.refine_error > 0.0 {
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
        let rows = (mesh.patches.len() * settings.points_a_patch * row).min(super::settings::ROW_BYTES);
        let cut = grown(mesh.elements.len()) * an_element + grown(mesh.vertices.len()) * a_vertex;
        let drawing = match method {
            Method::Hemicube => DRAWING + scene.triangles.len() * DRAWN_TRIANGLE,
            Method::Hemisphere => 0,
        };
        let bytes = PROGRAM + drawing + textures + input + scene.triangles.len() * RAY_TREE + COPIES * cut + rows;
        Self { elements: mesh.elements.len(), patches: mesh.patches.len(), vertices: mesh.light_vertices.len(), bytes }
    }
}
