//! Projections of shadow maps.
//!
//! A spot light has one perspective map, a point light the six faces of a cube, and a directional light an orthographic
//! map that is fitted to the scene and snapped to whole texels. A face of a cube is a few texels wider than 90 degrees,
//! so that filters never cross its border. Depth is reversed as in pictures: near / distance for a perspective map,
//! which is 1 at the near plane and 0 at infinity.

use bytemuck::{Pod, Zeroable};
use glam::camera::rh::proj::directx;
use glam::camera::rh::view::look_to_mat4;
use glam::{Mat4, Vec2, Vec3, Vec3Swizzles};

use super::settings::MapSettings;
use crate::base::bounds::Bounds;
use crate::render::shadow::light::sample::LightSample;
use crate::render::shadow::light::space::light_from_world;
use crate::scene::LightKind;

/// Axis and up vector of each face of a cube, in light space, in the order of shaders/shadow/map/pcf.wgsl.
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
/// Largest outer angle of a spot with one map, radians; a wider one has a cube.
const WIDEST_SPOT: f32 = 1.2;
/// Number of texels that interpolation needs beyond the edge of a face.
const BORDER: f32 = 2.0;

/// Bound on the rounding of depths: absolute for an orthographic map, relative to the depth for a perspective one.
const ROUNDING: f32 = 2e-5;

/// Projections of the map of a light sample.
pub struct MapProjection {
    /// Projection of each face: one, or six of a cube.
    pub projection_from_world: Vec<Mat4>,
    /// Projection for passes that read the map.
    pub uniform: MapUniform,
}

/// `ShadowMap` of shaders/shadow/map/projection.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct MapUniform {
    origin: Vec2,
    scale: f32,
    depth_scale: f32,
    depth_offset: f32,
    inverse_resolution: f32,
    normal_offset: f32,
    slope_bias: f32,
    rounding: Vec2,
    reach: u32,
    padding: u32,
}

impl MapProjection {
    /// Returns the projections of a light sample's map of a scene within a box.
    pub fn new(bounds: Bounds, sample: &LightSample, settings: &MapSettings) -> Self {
        let near = NEAR * bounds.extent();
        let resolution = settings.resolution as f32;
        let border = BORDER + settings.pcf_radius as f32;
        // Widens the field of view by the border.
        let widened = resolution / (resolution - 2.0 * border);
        let light_from_world = light_from_world(sample);
        let (projection_from_light, uniform) = match sample.light.kind {
            LightKind::Directional { .. } => {
                let (least, most) = box_in_light_space(bounds, light_from_world);
                let fitted = Fitted::new((least, most), resolution, widened);
                (vec![fitted.projection()], fitted.uniform(settings))
            }
            LightKind::Spot { outer_angle, .. } if outer_angle < WIDEST_SPOT => {
                let half_width = outer_angle.tan() * widened;
                (vec![perspective(half_width, near)], perspective_uniform(half_width, near, settings))
            }
            LightKind::Spot { .. } | LightKind::Point { .. } => {
                let face = |(axis, up)| perspective(widened, near) * look_to_mat4(Vec3::ZERO, axis, up);
                (FACES.map(face).to_vec(), perspective_uniform(widened, near, settings))
            }
        };
        let projection_from_world = projection_from_light.iter().map(|&face| face * light_from_world).collect();
        Self { projection_from_world, uniform }
    }
}

fn perspective(half_width: f32, near: f32) -> Mat4 {
    directx::perspective_infinite_reverse(2.0 * half_width.atan(), 1.0, near)
}

fn perspective_uniform(half_width: f32, near: f32, settings: &MapSettings) -> MapUniform {
    let resolution = settings.resolution as f32;
    MapUniform {
        origin: Vec2::splat(0.5 * resolution - 0.5),
        scale: 0.5 * resolution / half_width,
        depth_scale: near,
        depth_offset: 0.0,
        inverse_resolution: 1.0 / resolution,
        normal_offset: settings.normal_offset,
        slope_bias: settings.slope_bias,
        rounding: ROUNDING * Vec2::Y,
        reach: reach(settings),
        padding: 0,
    }
}

/// Returns the number of texels in each direction that a lookup reads beside the texel of the point. Interpolation adds
/// one to the radius of the filter.
fn reach(settings: &MapSettings) -> u32 {
    settings.pcf_radius + 1
}

/// Returns the minimum and maximum corner of a box's bounds in light space.
fn box_in_light_space(Bounds { low, high }: Bounds, light_from_world: Mat4) -> (Vec3, Vec3) {
    let corner = |i: u32| Vec3::select(glam::BVec3::new(i & 1 > 0, i & 2 > 0, i & 4 > 0), high, low);
    let corners: Vec<Vec3> = (0..8).map(|i| light_from_world.transform_point3(corner(i))).collect();
    let least = corners.iter().copied().fold(Vec3::INFINITY, Vec3::min);
    let most = corners.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
    (least, most)
}

/// An orthographic projection that covers a box of light space.
///
/// Its middle lies on a grid of whole texels, so that shadows do not crawl when the box grows a little.
struct Fitted {
    middle: Vec2,
    half_width: f32,
    nearest: f32,
    farthest: f32,
}

impl Fitted {
    fn new((least, most): (Vec3, Vec3), resolution: f32, widened: f32) -> Self {
        let half_width = 0.5 * (most - least).xy().max_element() * widened;
        let texel = 2.0 * half_width / resolution;
        let margin = 1e-3 * (most - least).max_element();
        Self {
            middle: ((0.5 * (least + most)).xy() / texel).round() * texel,
            half_width,
            nearest: -margin - most.z,
            farthest: margin - least.z,
        }
    }

    fn projection(&self) -> Mat4 {
        let (low, high) = (self.middle - self.half_width, self.middle + self.half_width);
        // Exchanging near and far reverses the depth.
        directx::orthographic(low.x, high.x, low.y, high.y, self.farthest, self.nearest)
    }

    fn uniform(&self, settings: &MapSettings) -> MapUniform {
        let resolution = settings.resolution as f32;
        let scale = 0.5 * resolution / self.half_width;
        let depth_scale = 1.0 / (self.nearest - self.farthest);
        MapUniform {
            origin: 0.5 * resolution - 0.5 - scale * self.middle * Vec2::new(1.0, -1.0),
            scale,
            depth_scale,
            depth_offset: -self.farthest * depth_scale,
            inverse_resolution: 1.0 / resolution,
            normal_offset: settings.normal_offset,
            slope_bias: settings.slope_bias,
            rounding: ROUNDING * Vec2::X,
            reach: reach(settings),
            padding: 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::struct_layout;
    use crate::render::shadow::map::pcf::DIRECT_LIGHT_PCF;
    use crate::scene::{Light, builtin};

    #[test]
    fn the_uniform_has_the_layout_of_the_shader() {
        use std::mem::offset_of;
        macro_rules! offsets {
            ($($field:ident),+) => { vec![$(offset_of!(MapUniform, $field)),+, size_of::<MapUniform>()] };
        }
        let written = offsets![
            origin,
            scale,
            depth_scale,
            depth_offset,
            inverse_resolution,
            normal_offset,
            slope_bias,
            rounding,
            reach,
            padding
        ];
        assert_eq!(written, struct_layout(&DIRECT_LIGHT_PCF, "ShadowMap"));
    }

    fn sample(kind: LightKind) -> LightSample {
        LightSample { light: Light::new(kind, Vec3::ONE), surface_normal: None, lamp: 0 }
    }

    #[test]
    fn a_directional_map_covers_the_scene() {
        let scene = builtin::gallery();
        let bounds = scene.bounds();
        let Bounds { low, high } = bounds;
        let sun = sample(LightKind::Directional { direction: Vec3::new(0.3, -0.8, 0.5).normalize() });
        let maps = MapProjection::new(bounds, &sun, &MapSettings::default());
        for point in [low, high, Vec3::new(low.x, high.y, low.z), bounds.centre()] {
            let seen = maps.projection_from_world[0].project_point3(point);
            assert!(
                seen.truncate().abs().max_element() <= 1.0 && (0.0..=1.0).contains(&seen.z),
                "{point} is at {seen}"
            );
        }
    }

    #[test]
    fn the_uniform_and_the_projection_map_a_point_to_the_same_texel() {
        let scene = builtin::gallery();
        let bounds = scene.bounds();
        let position = bounds.low.lerp(bounds.high, 0.6);
        let direction = Vec3::new(0.3, -0.8, 0.5).normalize();
        let spot = LightKind::Spot { position, direction, inner_angle: 0.4, outer_angle: 0.8 };
        for light in [sample(spot), sample(LightKind::Directional { direction })] {
            let map = MapProjection::new(bounds, &light, &MapSettings::default());
            let point = position + 1.7 * direction + Vec3::new(0.2, 0.1, -0.3);
            let drawn = map.projection_from_world[0].project_point3(point);
            // The same computation as `in_map` of the shader.
            let seen = light_from_world(&light).transform_point3(point) * Vec3::new(1.0, 1.0, -1.0);
            let is_parallel = light.position().w == 0.0;
            let uniform = &map.uniform;
            let scale = if is_parallel { uniform.scale } else { uniform.scale / seen.z };
            let texel = uniform.origin + scale * seen.xy() * Vec2::new(1.0, -1.0);
            let ahead = if is_parallel { seen.z } else { 1.0 / seen.z };
            let depth = uniform.depth_offset + uniform.depth_scale * ahead;
            let expected = (0.5 + 0.5 * drawn.xy() * Vec2::new(1.0, -1.0)) * 2048.0 - 0.5;
            assert!(texel.distance(expected) < 0.01, "{texel} for {expected}");
            assert!((depth - drawn.z).abs() < 1e-5 * drawn.z, "{depth} for {}", drawn.z);
        }
    }
}
