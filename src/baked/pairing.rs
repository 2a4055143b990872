//! Pairs fronts and backs of a bake by position, for files without a record of the pairs.

use std::collections::HashMap;

use crate::base::ids::TriangleId;
use crate::scene::{Back, Scene};

/// Adds the pairs of all fronts and backs whose corners have the same positions.
pub(super) fn pair_by_position(scene: &mut Scene) {
    let key = |triangle: TriangleId| {
        let mut corners = bits(scene, triangle);
        corners.sort_unstable();
        corners
    };
    let all = (0..scene.triangles.len()).map(TriangleId::new);
    let backs: HashMap<_, _> = all.filter(|&t| scene.sides.is_back(t)).map(|back| (key(back), back)).collect();
    let pair = |front: TriangleId| {
        let triangle = *backs.get(&key(front))?;
        let (front_corners, back_corners) = (bits(scene, front), bits(scene, triangle));
        let first = front_corners.iter().position(|corner| *corner == back_corners[0])?;
        Some((front, Back { triangle, first }))
    };
    let pairs: Vec<(TriangleId, Back)> = scene.fronts().filter_map(pair).collect();
    scene.sides.add_pairs(pairs);
}

/// Returns the bits of the corner positions of a triangle.
fn bits(scene: &Scene, triangle: TriangleId) -> [[u32; 3]; 3] {
    scene.corners(triangle).map(|corner| corner.to_array().map(f32::to_bits))
}
