//! The quality of the rows of form factors: closure and reciprocity.

use serde::Serialize;

use crate::base::ids::PatchId;
use crate::patch::PatchMesh;
use crate::radiosity::solver::{PatchRow, RowStore};

/// Share of a patch's view that ends on surfaces that receive light: 1 everywhere in a closed room.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Closure {
    /// Closure of the most open patch.
    pub min: f32,
    /// Mean over all patches whose row is stored.
    pub mean: f32,
    /// Closure of the most closed patch.
    pub max: f32,
}

impl Closure {
    /// Computes closure over all stored rows; 0 if there are none.
    fn of(mesh: &PatchMesh, rows: &RowStore) -> Self {
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

/// Closure and reciprocity of the stored rows of a mesh.
pub(in crate::bake) struct RowQuality {
    pub closure: Closure,
    pub reciprocity_residual: f64,
}

impl RowQuality {
    pub fn of(mesh: &PatchMesh, rows: &RowStore) -> Self {
        Self { closure: Closure::of(mesh, rows), reciprocity_residual: reciprocity_residual(mesh, rows) }
    }
}

/// Deviation of the form factors between patches from reciprocity (A_i F_ij = A_j F_ji), over all pairs with stored
/// rows.
///
/// Equation: sum of |A_i F_ij - A_j F_ji| over sum of (A_i F_ij + A_j F_ji).
fn reciprocity_residual(mesh: &PatchMesh, rows: &RowStore) -> f64 {
    let mut exchanges: Vec<(u32, u32, f64)> = Vec::new();
    for (patch, row) in kept(mesh, rows) {
        let area = f64::from(mesh.patches[patch.index()].area);
        let seen = row.entries.iter().map(|entry| (mesh.elements[entry.element.index()].patch, entry.factor));
        for (other, factor) in seen.filter(|(other, _)| *other != patch && rows.get(*other).is_some()) {
            let (low, high) = (patch.0.min(other.0), patch.0.max(other.0));
            let sign = if patch.0 == low { 1.0 } else { -1.0 };
            exchanges.push((low, high, sign * area * f64::from(factor)));
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

/// Returns the patches with stored rows, and their rows.
fn kept<'a>(mesh: &PatchMesh, rows: &'a RowStore) -> impl Iterator<Item = (PatchId, &'a PatchRow)> {
    (0..mesh.patches.len()).map(PatchId::new).filter_map(|patch| Some((patch, rows.get(patch)?)))
}

#[cfg(test)]
mod tests {
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
        let mut source = Hemispheres::new(&tracer, &mesh, 512);
        rows.compute(&all, &mesh, &Viewpoints::new(&scene), &mut source, &Unwatched).expect("rays do not fail");
        let closure = Closure::of(&mesh, &rows);
        assert!(closure.min < closure.mean && closure.mean < 0.99 && closure.max <= 1.0 + 1e-4, "{closure:?}");
        let residual = reciprocity_residual(&mesh, &rows);
        assert!(residual > 0.0 && residual < 0.1, "{residual}");
    }
}
