//! Normal maps: textures that store small bumps as normals.
//!
//! Tangents are computed from the texture coordinates of each triangle; tangents stored in a file are not read.

use glam::Vec3;

use crate::base::ids::TriangleId;
use crate::base::triangle::interpolate;
use crate::scene::Scene;

/// Returns the unit normal that the normal map of a triangle's material gives at a point. The point is stated by the
/// weights of the corners.
///
/// It lies on the side of `smooth`, the interpolated normal of the front. `None` if the material has no normal map or
/// the texture coordinates of the triangle span no area.
pub(crate) fn mapped_normal(scene: &Scene, triangle: TriangleId, weights: Vec3, smooth: Vec3) -> Option<Vec3> {
    let (slot, scale) = scene.material_of(triangle).normal_texture.as_ref()?;
    let corners = scene.triangles[triangle.index()].vertices.map(|v| &scene.vertices[v as usize]);
    let [a, b, c] = corners.map(|vertex| slot.coordinate(vertex.uv));
    let (ab, ac) = (b - a, c - a);
    let area = ab.perp_dot(ac);
    let [p, q, r] = corners.map(|vertex| vertex.position);
    // Directions in which the texture coordinates increase: u to the right and v down, as in images of glTF.
    let right = ((q - p) * ac.y - (r - p) * ab.y) / area;
    let down = ((r - p) * ab.x - (q - p) * ac.x) / area;
    let tangent = right.reject_from_normalized(smooth).try_normalize()?;
    let across = smooth.cross(tangent);
    let bitangent = if across.dot(down) > 0.0 { -across } else { across };
    let at = interpolate([a, b, c], weights);
    let stored = scene.textures[slot.texture.index()].sample_linear(at).truncate() * 2.0 - 1.0;
    let relief = stored * Vec3::new(*scale, *scale, 1.0);
    (tangent * relief.x + bitangent * relief.y + smooth * relief.z).try_normalize()
}
