//! Normal maps: small relief that a texture tells.
//!
//! Tangents follow the texture coordinates of each triangle; those that a file may store are not read.

use glam::Vec3;

use crate::base::ids::TriangleId;
use crate::base::triangle::interpolate;
use crate::scene::Scene;

/// The unit normal that the normal map of a triangle's material tells at a point, given by the weights of the corners, on
/// the side of `smooth`, the interpolated normal of the front. None where there is no map, or it is not laid out.
pub(super) fn mapped_normal(scene: &Scene, triangle: TriangleId, weights: Vec3, smooth: Vec3) -> Option<Vec3> {
    let (slot, scale) = scene.material_of(triangle).normal_texture.as_ref()?;
    let corners = scene.triangles[triangle.index()].vertices.map(|v| &scene.vertices[v as usize]);
    let [a, b, c] = corners.map(|vertex| slot.coordinate(vertex.uv));
    let (ab, ac) = (b - a, c - a);
    let area = ab.perp_dot(ac);
    let [p, q, r] = corners.map(|vertex| vertex.position);
    // Where texture coordinates grow: u to the right and v down, as glTF lays out images.
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
