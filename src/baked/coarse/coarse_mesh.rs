//! The coarse mesh: its triangles, the tiles with their light, and the elements in the tiles.

use glam::UVec2;

use super::bisection::Forest;
use super::coarsen::{Whole, coarsen};
use super::tiles::{Filling, Layout};
use crate::baked::bisection_trees::BisectionTrees;
use crate::scene::{Scene, Triangle};

/// Largest width and height of the texture: 256 MiB of light.
const MAX_SIDE: u32 = 5792;
/// Largest number of texels per element. More would give fewer triangles, but hardly faster pictures.
const MAX_TEXELS_PER_ELEMENT: u64 = 32;
/// Largest number of coarse triangles per element. If there are more, the texture is not worth its cost.
const WORTH_WHILE: f32 = 0.75;

/// A mesh of fewer triangles over the vertices of a scene.
pub(crate) struct CoarseMesh {
    /// Triangles over the vertices of the scene: first those with tiles, then unchanged triangles of the scene.
    pub triangles: Vec<Triangle>,
    /// The tiles of the first triangles.
    pub tiles: Vec<Tile>,
    /// Width and height of the texture, texels.
    pub side: u32,
    /// The elements in tiles.
    pub elements: Vec<ElementTexels>,
    /// Index of the element of each texel, row by row.
    pub element_of: Vec<u32>,
    /// Texels beyond the long sides of tiles, which are extrapolated.
    pub beyond: Vec<UVec2>,
}

/// The place in the texture that holds the light of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tile {
    /// The texel of its first corner.
    pub origin: UVec2,
    /// Number of texels from there across to its second corner, and down to its third corner.
    pub side: u32,
}

/// An element in a tile.
pub(crate) struct ElementTexels {
    /// Its vertices in the scene.
    pub vertices: [u32; 3],
    /// The texels of its corners.
    pub corners: [UVec2; 3],
}

impl CoarseMesh {
    /// Returns the coarse mesh of a scene of elements; `trees` are their bisection trees if these are known. `None` if
    /// the mesh would not be much smaller, or the texture would be wider or higher than `max_side`.
    pub fn new(scene: &Scene, trees: Option<&BisectionTrees>, max_side: u32) -> Option<Self> {
        let forest = Forest::new(scene, trees);
        let num_elements = scene.triangles.len();
        // Most tiles have far fewer texels than the limit.
        let per_element = (2 * u64::from(MAX_SIDE).pow(2) / num_elements.max(1) as u64).min(MAX_TEXELS_PER_ELEMENT);
        let mut wholes = coarsen(scene, &forest, per_element);
        if wholes.len() as f32 >= WORTH_WHILE * num_elements as f32 {
            return None;
        }
        // Triangles of a single element have no tile.
        wholes.sort_by_key(|whole| forest.nodes[whole.node as usize].halves.is_none());
        let num_tiles = wholes.partition_point(|whole| forest.nodes[whole.node as usize].halves.is_some());
        let layout = Layout::new(&wholes[..num_tiles]);
        if layout.side > max_side.min(MAX_SIDE) {
            return None;
        }
        let Filling { elements, element_of, beyond, .. } = Filling::new(&forest, &wholes[..num_tiles], &layout);
        let vertices_of = |triangle: u32| scene.triangles[triangle as usize].vertices;
        let triangle = |whole: &Whole| {
            let of = forest.some_element(whole.node);
            Triangle { vertices: forest.nodes[whole.node as usize].corners, ..scene.triangles[of as usize] }
        };
        Some(Self {
            triangles: wholes.iter().map(triangle).collect(),
            tiles: wholes[..num_tiles]
                .iter()
                .zip(&layout.origins)
                .map(|(whole, &origin)| Tile { origin, side: 1 << whole.level })
                .collect(),
            side: layout.side,
            elements: elements
                .into_iter()
                .map(|e| ElementTexels { vertices: vertices_of(e.triangle), corners: e.corners })
                .collect(),
            element_of,
            beyond,
        })
    }
}
