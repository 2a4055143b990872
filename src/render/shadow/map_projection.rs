//! What shadow maps show: projections from the lights.
//!
//! A spot has one map, a point six faces of a cube, a directional light an orthographic map fitted to the scene and
//! snapped to whole texels. Faces are a few texels wider than a quarter turn, so that filtering finds no seam. Depth is
//! reversed, as in pictures.

use bytemuck::{Pod, Zeroable};
use glam::camera::rh::proj::directx;
use glam::camera::rh::view::look_to_mat4;
use glam::{Mat4, Vec2, Vec3, Vec3Swizzles};

use super::light_samples::LightSample;
use super::shadow_map::MapSettings;
use crate::base::sampling::tangent_frame;
use crate::scene::{LightKind, Scene};

/// Axes of a cube's faces and what is up on them, in the order of shaders/shared/map_lookup.wgsl.
const FACES: [(Vec3, Vec3); 6] = [
    (Vec3::X, Vec3::Y),
    (Vec3::NEG_X, Vec3::Y),
    (Vec3::Y, Vec3::Z),
    (Vec3::NEG_Y, Vec3::Z),
    (Vec3::Z, Vec3::Y),
    (Vec3::NEG_Z, Vec3::Y),
];
/// Near plane of a map, as a share of the scene's extent.
const NEAR: f32 = 1e-4;
/// A wider spot is drawn as a point, radians.
const WIDEST_SPOT: f32 = 1.2;
/// Texels beyond the edge of a face for interpolation.
const BORDER: f32 = 2.0;

/// Depths are rounded by a few of these: of the whole range where rays are parallel, else of the depth itself.
const ROUNDING: f32 = 2e-5;

/// What the map of a light sample shows of a scene.
pub struct MapProjection {
    /// Of each face: one, or six of a cube.
    pub projection_from_world: Vec<Mat4>,
    /// What the pass that reads the map needs of them.
    pub uniform: MapUniform,
}

/// `ShadowMap` of shaders/shared/map_lookup.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct MapUniform {
    projection_from_world: Mat4,
    plane_from_world: Mat4,
    half_width: f32,
    near: f32,
    texel: f32,
    resolution: f32,
    inverse_resolution: f32,
    normal_offset: f32,
    slope_bias: f32,
    padding: u32,
    rounding: Vec2,
    padding_to_16: [u32; 2],
}

impl MapProjection {
    /// What the map of a light sample shows of a scene.
    pub fn new(scene: &Scene, sample: &LightSample, settings: &MapSettings) -> Self {
        let (low, high) = scene.bounds();
        let near = NEAR * (high - low).max_element();
        let resolution = settings.resolution as f32;
        let border = BORDER + settings.pcf_radius as f32;
        let (projection_from_world, half_width) = match sample.light.kind {
            LightKind::Directional { direction } => fitted((low, high), direction, resolution, border),
            LightKind::Spot { position, direction, outer_angle, .. } if outer_angle < WIDEST_SPOT => {
                let half_width = outer_angle.tan() * resolution / (resolution - 2.0 * border);
                let up = tangent_frame(direction).0;
                (vec![perspective(half_width, near) * look_to_mat4(position, direction, up)], half_width)
            }
            LightKind::Spot { position, .. } | LightKind::Point { position } => {
                let half_width = resolution / (resolution - 2.0 * border);
                let face = |(axis, up)| perspective(half_width, near) * look_to_mat4(position, axis, up);
                (FACES.map(face).to_vec(), half_width)
            }
        };
        let is_parallel = matches!(sample.light.kind, LightKind::Directional { .. });
        let uniform = MapUniform {
            projection_from_world: projection_from_world[0],
            plane_from_world: projection_from_world[0].inverse().transpose(),
            half_width,
            near,
            texel: 2.0 * half_width / resolution,
            resolution,
            inverse_resolution: 1.0 / resolution,
            normal_offset: settings.normal_offset,
            slope_bias: settings.slope_bias,
            padding: 0,
            rounding: ROUNDING * if is_parallel { Vec2::X } else { Vec2::Y },
            padding_to_16: [0; 2],
        };
        Self { projection_from_world, uniform }
    }
}

fn perspective(half_width: f32, near: f32) -> Mat4 {
    directx::perspective_infinite_reverse(2.0 * half_width.atan(), 1.0, near)
}

/// An orthographic map along `direction` that holds the whole box, and half its width.
///
/// Its middle lies on a grid of whole texels, so that a scene that grows a little does not make its shadows crawl.
fn fitted((low, high): (Vec3, Vec3), direction: Vec3, resolution: f32, border: f32) -> (Vec<Mat4>, f32) {
    let view_from_world = look_to_mat4(Vec3::ZERO, direction, tangent_frame(direction).0);
    let corner = |i: u32| Vec3::select(glam::BVec3::new(i & 1 > 0, i & 2 > 0, i & 4 > 0), high, low);
    let corners: Vec<Vec3> = (0..8).map(|i| view_from_world.transform_point3(corner(i))).collect();
    let least = corners.iter().copied().fold(Vec3::INFINITY, Vec3::min);
    let most = corners.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
    let half_width = 0.5 * (most - least).xy().max_element() * resolution / (resolution - 2.0 * border);
    let texel = 2.0 * half_width / resolution;
    let middle = ((0.5 * (least + most)).xy() / texel).round() * texel;
    let margin = 1e-3 * (most - least).max_element();
    // Far before near reverses the depth.
    let projection_from_view = directx::orthographic(
        middle.x - half_width,
        middle.x + half_width,
        middle.y - half_width,
        middle.y + half_width,
        margin - least.z,
        -margin - most.z,
    );
    (vec![projection_from_view * view_from_world], half_width)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shaders::{DIRECT_LIGHT_MAP, struct_layout};

    #[test]
    fn the_uniform_is_as_long_as_the_shader_reads_it() {
        let layout = struct_layout(&DIRECT_LIGHT_MAP, "ShadowMap");
        assert_eq!(layout.last(), Some(&size_of::<MapUniform>()));
        assert_eq!(layout[8], std::mem::offset_of!(MapUniform, slope_bias));
    }

    #[test]
    fn a_fitted_map_holds_the_box() {
        let (low, high) = (Vec3::new(-3.0, 0.0, 1.0), Vec3::new(4.0, 5.0, 9.0));
        let (maps, _) = fitted((low, high), Vec3::new(0.3, -0.8, 0.5).normalize(), 512.0, 3.0);
        for point in [low, high, Vec3::new(low.x, high.y, low.z), 0.5 * (low + high)] {
            let seen = maps[0].project_point3(point);
            assert!(
                seen.truncate().abs().max_element() <= 1.0 && (0.0..=1.0).contains(&seen.z),
                "{point} is at {seen}"
            );
        }
    }
}
