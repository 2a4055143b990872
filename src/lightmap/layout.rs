//! Unwrapping: places the surfaces of a scene side by side in a texture.
//!
//! The crate `uvunwrap` grows charts of triangles within a cone of normals, flattens each by a least squares conformal
//! map (Lévy et al. 2002) and packs the charts with space between them.

use std::collections::HashMap;

use glam::{DVec2, Vec2};
use uvunwrap::{Atlas, Density, MeshInput, Options, OutputMesh, Packing, generate};

use super::settings::{LightmapError, LightmapSettings};
use crate::base::ids::{InstanceId, TriangleId};
use crate::scene::{Instance, Scene, Sides, Triangle, Vertex};

/// Empty texels round each chart. Bilinear filtering needs one, and the first smaller mip level two.
const PADDING: u32 = 2;

/// An unwrapped scene.
pub(super) struct Layout {
    /// Fronts and backs as separate triangles, with separate vertices at seams of the texture.
    pub scene: Scene,
    /// Texture coordinates of the vertices `[v]`, 0 to 1.
    pub coordinates: Vec<Vec2>,
    /// For each triangle `[t]`, the triangle of the loaded scene of which it is a side.
    pub sources: Vec<TriangleId>,
    /// Width and height, texels.
    pub size: [u32; 2],
    /// Width of a texel, metres.
    pub texel_size: f32,
}

/// Unwraps a scene: each instance by itself, its fronts and its backs separately.
pub(super) fn lay_flat(scene: &Scene, settings: &LightmapSettings) -> Result<Layout, LightmapError> {
    let sides = |instance: usize| [Sheet::of(scene, instance, false), Sheet::of(scene, instance, true)];
    let sheets: Vec<[Sheet; 2]> = (0..scene.instances.len()).map(sides).collect();
    let inputs: Vec<MeshInput<'_>> = sheets.iter().flatten().map(Sheet::input).collect();
    let atlas = packed(&inputs, sheets.iter().flatten().map(|sheet| sheet.area).sum(), settings)?;
    let mut layout = Layout {
        scene: Scene {
            vertices: Vec::new(),
            triangles: Vec::new(),
            sides: Sides::default(),
            instances: Vec::new(),
            ..scene.clone()
        },
        coordinates: Vec::new(),
        sources: Vec::new(),
        size: [atlas.width, atlas.height],
        texel_size: 1.0 / atlas.texels_per_unit,
    };
    for (sides, laid) in sheets.iter().zip(atlas.meshes.chunks_exact(2)) {
        let start = layout.sources.len();
        for (sheet, laid) in sides.iter().zip(laid) {
            layout.add(scene, sheet, laid);
        }
        let name = scene.instances[layout.scene.instances.len()].name.clone();
        layout.scene.instances.push(Instance { name, triangles: start..layout.sources.len() });
    }
    Ok(layout)
}

/// Packs charts at the density of the settings, or at the highest that fits.
fn packed(inputs: &[MeshInput<'_>], area: f64, settings: &LightmapSettings) -> Result<Atlas, LightmapError> {
    let options = |density| Options { density, padding: PADDING, packing: Packing::Fast, ..Options::default() };
    let side = settings.max_side;
    let wanted = Density::Fixed { texels_per_unit: 1.0 / settings.texel_size, page_size: None };
    if area <= (f64::from(side) * f64::from(settings.texel_size)).powi(2) {
        let atlas = generate(inputs, &options(wanted))?;
        if atlas.width.max(atlas.height) <= side {
            return Ok(atlas);
        }
    }
    let atlas = generate(inputs, &options(Density::Auto { page_size: side }))?;
    if atlas.page_count > 1 {
        return Err(LightmapError::TooManyCharts { charts: atlas.chart_count, side });
    }
    Ok(atlas)
}

/// One side of an instance as input of the unwrapping.
struct Sheet {
    instance: usize,
    is_back: bool,
    /// Triangles of this side in the scene.
    triangles: Vec<TriangleId>,
    /// Scene vertex of each vertex.
    vertices: Vec<u32>,
    positions: Vec<[f32; 3]>,
    /// Corners of the triangles, counter-clockwise as seen from this side.
    indices: Vec<u32>,
    /// Area, square metres.
    area: f64,
}

impl Sheet {
    fn of(scene: &Scene, instance: usize, is_back: bool) -> Self {
        let has_side = |&triangle: &TriangleId| !is_back || scene.material_of(triangle).double_sided;
        let triangles: Vec<TriangleId> =
            scene.instances[instance].triangles.clone().map(TriangleId::new).filter(has_side).collect();
        let mut number = HashMap::new();
        let mut vertices = Vec::new();
        let mut indices = Vec::with_capacity(3 * triangles.len());
        for &triangle in &triangles {
            let [a, b, c] = scene.triangles[triangle.index()].vertices;
            for vertex in if is_back { [a, c, b] } else { [a, b, c] } {
                indices.push(*number.entry(vertex).or_insert_with(|| {
                    vertices.push(vertex);
                    vertices.len() as u32 - 1
                }));
            }
        }
        let positions = vertices.iter().map(|&v| scene.vertices[v as usize].position.to_array()).collect();
        let area = triangles.iter().map(|&t| f64::from(crate::scene::area_of(scene.corners(t)))).sum();
        Self { instance, is_back, triangles, vertices, positions, indices, area }
    }

    fn input(&self) -> MeshInput<'_> {
        MeshInput::new(&self.positions, &self.indices)
    }
}

impl Layout {
    /// Adds one unwrapped side of an instance.
    fn add(&mut self, scene: &Scene, sheet: &Sheet, laid: &OutputMesh) {
        let first = self.scene.vertices.len() as u32;
        for placed in &laid.vertices {
            let vertex = scene.vertices[sheet.vertices[placed.xref as usize] as usize];
            let normal = if sheet.is_back { -vertex.normal } else { vertex.normal };
            self.scene.vertices.push(Vertex { normal, ..vertex });
            self.coordinates.push(placed.uv.into());
        }
        for (corners, &source) in laid.indices.as_chunks::<3>().0.iter().zip(&sheet.triangles) {
            self.scene.triangles.push(Triangle {
                vertices: corners.map(|corner| first + corner),
                material: scene.triangles[source.index()].material,
                instance: InstanceId::new(sheet.instance),
            });
            if sheet.is_back {
                self.scene.sides.add_back(TriangleId::new(self.sources.len()));
            }
            self.sources.push(source);
        }
    }

    /// Corners of a triangle in the texture, in texels.
    pub fn corners(&self, triangle: usize) -> [DVec2; 3] {
        let size = DVec2::from(self.size.map(f64::from));
        self.scene.triangles[triangle].vertices.map(|v| self.coordinates[v as usize].as_dvec2() * size)
    }
}
