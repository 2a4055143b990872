//! What the rows of form factors tell about their own quality, and what the bake took of memory.

use serde::Serialize;

use crate::baked::VertexLight;
use crate::base::colour::luminance;
use crate::base::ids::PatchId;
use crate::patch::PatchMesh;
use crate::radiosity::solver::{PatchRow, RowStore};
use crate::scene::Scene;

/// Share of a patch's view that ends on surfaces that receive: 1 everywhere in a closed room.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Closure {
    /// Of the most open patch.
    pub min: f32,
    /// Of all patches whose row is kept.
    pub mean: f32,
    /// Of the most closed one.
    pub max: f32,
}

impl Closure {
    /// Over all rows that are kept; all 0 where there are none.
    #[must_use]
    pub fn of(mesh: &PatchMesh, rows: &RowStore) -> Self {
        let sums: Vec<f32> =
            kept(mesh, rows).map(|(_, row)| row.entries.iter().map(|entry| entry.factor).sum()).collect();
        if sums.is_empty() {
            return Self { min: 0.0, mean: 0.0, max: 0.0 };
        }
        Self {
            min: sums.iter().copied().fold(f32::INFINITY, f32::min).max(0.0),
            mean: sums.iter().sum::<f32>() / sums.len() as f32,
            max: sums.iter().copied().fold(0.0, f32::max),
        }
    }
}

/// Light that steps are measured beside even in the dark, as a share of the mean over the vertices.
const FLOOR: f32 = 0.05;

/// Largest step of light between two vertices of an element, relative to the brighter one: near 1 where the edge of a deep
/// shadow lies within an element.
#[must_use]
pub fn largest_neighbour_step(scene: &Scene, light: &VertexLight) -> f32 {
    let total: Vec<f32> = (0..scene.vertices.len())
        .map(|v| light.groups.iter().map(|group| luminance(group.direct[v] + group.indirect[v])).sum())
        .collect();
    let floor = FLOOR * total.iter().sum::<f32>() / total.len().max(1) as f32;
    let step = |[a, b, c]: [u32; 3]| {
        let [a, b, c] = [a, b, c].map(|v| total[v as usize]);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        (high - low) / high.max(floor).max(f32::MIN_POSITIVE)
    };
    scene.triangles.iter().map(|triangle| step(triangle.vertices)).fold(0.0, f32::max)
}

/// How far patches are from seeing each other in the measure of their areas, over all pairs whose rows are both kept.
///
/// Equation: sum of |A_i F_ij - A_j F_ji| over sum of (A_i F_ij + A_j F_ji).
#[must_use]
pub fn reciprocity_residual(mesh: &PatchMesh, rows: &RowStore) -> f64 {
    let mut exchanges: Vec<(u32, u32, f64)> = Vec::new();
    for (patch, row) in kept(mesh, rows) {
        let area = f64::from(mesh.patches[patch.index()].area);
        let seen = row.entries.iter().map(|entry| (mesh.elements[entry.element.index()].patch, entry.factor));
        for (other, factor) in seen.filter(|(other, _)| *other != patch && rows.get(*other).is_some()) {
            let (low, high) = (patch.0.min(other.0), patch.0.max(other.0));
            let way = if patch.0 == low { 1.0 } else { -1.0 };
            exchanges.push((low, high, way * area * f64::from(factor)));
        }
    }
    exchanges.sort_by_key(|&(low, high, _)| (low, high));
    let (mut residual, mut total) = (0.0, 0.0);
    for pair in exchanges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        residual += pair.iter().map(|exchange| exchange.2).sum::<f64>().abs();
        total += pair.iter().map(|exchange| exchange.2.abs()).sum::<f64>();
    }
    if total > 0.0 { residual / total } else { 0.0 }
}

fn kept<'a>(mesh: &PatchMesh, rows: &'a RowStore) -> impl Iterator<Item = (PatchId, &'a PatchRow)> {
    (0..mesh.patches.len()).map(PatchId::new).filter_map(|patch| Some((patch, rows.get(patch)?)))
}

/// Most memory that the program has held at a time, bytes; none where the system does not tell.
#[must_use]
pub fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kibibytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kibibytes * 1024)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::base::progress::Unwatched;
    use crate::form_factor::hemisphere::Hemispheres;
    use crate::patch::MeshSettings;
    use crate::radiosity::Viewpoints;
    use crate::scene::builtin;
    use crate::trace::Tracer;

    #[test]
    fn rows_of_an_open_box_are_reciprocal_and_not_closed() {
        let scene = builtin::cornell();
        let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 0.5, patch_size: 1.0 }).expect("a small mesh");
        let tracer = Tracer::new(&scene);
        let mut rows = RowStore::new(mesh.patches.len(), 32, usize::MAX);
        let all: Vec<PatchId> = (0..mesh.patches.len()).map(PatchId::new).collect();
        let mut method = Hemispheres::new(&tracer, &mesh, 512);
        rows.compute(&all, &mesh, &Viewpoints::new(&scene), &mut method, &Unwatched).expect("rays do not fail");
        let closure = Closure::of(&mesh, &rows);
        assert!(closure.min < closure.mean && closure.mean < 0.99 && closure.max <= 1.0 + 1e-4, "{closure:?}");
        let residual = reciprocity_residual(&mesh, &rows);
        assert!(residual > 0.0 && residual < 0.1, "{residual}");
    }

    #[test]
    fn the_largest_step_is_that_between_the_darkest_and_the_brightest_corner_of_one_triangle() {
        let mut scene = builtin::cornell();
        scene.triangles.truncate(2);
        let (first, second) = (scene.triangles[0].vertices, scene.triangles[1].vertices);
        let mut light = VertexLight::dark(1, scene.vertices.len());
        first.into_iter().chain(second).for_each(|v| light.groups[0].indirect[v as usize] = Vec3::splat(8.0));
        assert_eq!(largest_neighbour_step(&scene, &light), 0.0);
        light.groups[0].indirect[first[0] as usize] = Vec3::splat(2.0);
        light.groups[0].direct[first[0] as usize] = Vec3::splat(4.0);
        assert!((largest_neighbour_step(&scene, &light) - 0.25).abs() < 1e-6);
    }
}
