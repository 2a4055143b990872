//! Light space: the space of a camera at the light, with axes to its right, upwards, and backwards.
//!
//! The cone of a spot light, the cosine at an emissive surface and the position in a shadow map then depend on one or
//! two coordinates only.

use glam::{Mat3, Mat4};

use super::sample::LightSample;
use crate::base::sampling::tangent_frame;
use crate::scene::LightKind;

/// Returns the axes of light space in world space: right, up and back. For a point light they are the axes of the
/// world.
pub fn axes(sample: &LightSample) -> Mat3 {
    let ahead = match (sample.surface_normal, sample.light.kind) {
        (Some(normal), _) => normal,
        (None, LightKind::Point { .. }) => return Mat3::IDENTITY,
        (None, LightKind::Directional { direction } | LightKind::Spot { direction, .. }) => direction,
    };
    let (up, right) = tangent_frame(ahead);
    Mat3::from_cols(right, up, -ahead)
}

/// Returns the transform from world space to light space, whose origin is the light; for a directional light it is the
/// origin of the world.
pub fn light_from_world(sample: &LightSample) -> Mat4 {
    let position = sample.position();
    Mat4::from_mat3(axes(sample).transpose()) * Mat4::from_translation(-position.w * position.truncate())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Light;
    use glam::Vec3;

    #[test]
    fn light_space_looks_along_the_light_and_is_right_handed() {
        let position = Vec3::new(1.0, 2.0, 3.0);
        let direction = Vec3::new(0.3, -0.8, 0.5).normalize();
        let kinds = [
            LightKind::Point { position },
            LightKind::Directional { direction },
            LightKind::Spot { position, direction, inner_angle: 0.2, outer_angle: 0.4 },
        ];
        for kind in kinds {
            let sample = LightSample { light: Light::new(kind, Vec3::ONE), surface_normal: None, lamp: 0 };
            let axes = axes(&sample);
            assert!(
                (axes.determinant() - 1.0).abs() < 1e-5 && (axes * axes.transpose()).abs_diff_eq(Mat3::IDENTITY, 1e-5)
            );
            if !matches!(kind, LightKind::Point { .. }) {
                assert!(axes.z_axis.distance(-direction) < 1e-5);
            }
            let has_position = !matches!(kind, LightKind::Directional { .. });
            let seen = light_from_world(&sample).transform_point3(position + 2.0 * direction);
            assert!(!has_position || (seen.length() - 2.0).abs() < 1e-5, "{seen}");
        }
    }
}
