//! Patch view: the view of the hemicube at a viewpoint, unfolded.
//!
//! The top face lies in the middle, the four half sides around it with their horizons outwards; the corners stay empty.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use crate::baked::BakedScene;
use crate::form_factor::hemicube::Hemicubes;
use crate::form_factor::{FormFactorError, Viewpoint};
use crate::gpu::Gpu;
use crate::patch::{MeshError, MeshSettings, PatchMesh};

/// An unfolded hemicube.
pub struct PatchView {
    /// Width and height, pixels: twice the width of the hemicube.
    pub size: [u32; 2],
    /// The element of the bake that each pixel shows, if any `[pixel]`.
    pub items: Vec<Option<u32>>,
    /// Linear radiance `[pixel]`; the fourth channel is 0 if no element is in view.
    pub radiance: Vec<[f32; 4]>,
}

/// A patch view cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum PatchViewError {
    /// The bake has no elements.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The device failed.
    #[error(transparent)]
    FormFactor(#[from] FormFactorError),
}

/// Draws the hemicube at `viewpoint`, `size_px` pixels wide, over the elements of a bake.
///
/// # Errors
/// Returns an error if the bake is empty or the device fails.
pub fn patch_view(
    gpu: &Gpu,
    baked: &BakedScene,
    viewpoint: &Viewpoint,
    size_px: u32,
) -> Result<PatchView, PatchViewError> {
    // The triangles of the bake are its elements, so they are not subdivided again.
    let mesh = PatchMesh::new(&baked.scene, &MeshSettings::uncut())?;
    let mut hemicubes = Hemicubes::new(gpu, &baked.scene, &mesh, size_px);
    let folded = hemicubes.elements_seen(viewpoint)?;
    let n = hemicubes.size_px() as usize;
    let items: Vec<Option<u32>> =
        (0..4 * n * n).map(|at| folded_pixel(at % (2 * n), at / (2 * n), n).and_then(|pixel| folded[pixel])).collect();
    let radiance = items.iter().map(|item| item.map_or([0.0; 4], |e| radiance_of(baked, &mesh, e as usize))).collect();
    Ok(PatchView { size: [2 * n as u32; 2], items, radiance })
}

/// Returns the pixel of the faces, in the layout of an atlas cell, that lies at (`u`, `v`) of the unfolded hemicube, or
/// `None` in the corners.
fn folded_pixel(u: usize, v: usize, n: usize) -> Option<usize> {
    let half = n / 2;
    let inner = half..half + n;
    let (column, row) = (u.wrapping_sub(half), v.wrapping_sub(half));
    // Side `k` is rotated so that its upper edge touches the top face.
    let side = |k: usize, x: usize, y: usize| Some((n + (k - 1) * half + y) * n + x);
    match (inner.contains(&u), inner.contains(&v)) {
        (true, true) => Some(row * n + column),
        (false, true) if u < half => side(1, row, half - 1 - u),
        (true, false) if v < half => side(2, n - 1 - column, half - 1 - v),
        (false, true) => side(3, n - 1 - row, u - half - n),
        (true, false) => side(4, column, v - half - n),
        (false, false) => None,
    }
}

/// Returns the radiance of an element, the mean over its corners.
///
/// Equation: L = (M + rho E) / pi.
fn radiance_of(baked: &BakedScene, mesh: &PatchMesh, e: usize) -> [f32; 4] {
    let element = &mesh.elements[e];
    let corners = baked.scene.triangles[element.triangle.index()].vertices;
    let at = |v: u32| -> Vec3 {
        baked.light.groups.iter().map(|group| group.direct[v as usize] + group.indirect[v as usize]).sum()
    };
    let irradiance = corners.into_iter().map(at).sum::<Vec3>() / 3.0;
    ((element.exitance + element.reflectance * irradiance) * FRAC_1_PI).extend(1.0).to_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_of_the_faces_appears_once() {
        const N: usize = 8;
        let mut seen: Vec<usize> =
            (0..4 * N * N).filter_map(|at| folded_pixel(at % (2 * N), at / (2 * N), N)).collect();
        seen.sort_unstable();
        assert_eq!(seen, (0..3 * N * N).collect::<Vec<_>>());
    }
}
