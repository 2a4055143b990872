//! Light space, in which a light looks as a camera does: to the right, up, and back along its own axis.
//!
//! There the cone of a spot, the cosine of an emissive surface and the place in a shadow map are a coordinate or two.

use glam::{Mat3, Mat4};

use super::light_samples::LightSample;
use crate::base::sampling::tangent_frame;
use crate::scene::LightKind;

/// Axes of light space in the world: right, up and back. A point light looks along the world's own.
pub fn axes(sample: &LightSample) -> Mat3 {
    let ahead = match (sample.surface_normal, sample.light.kind) {
        (Some(normal), _) => normal,
        (None, LightKind::Point { .. }) => return Mat3::IDENTITY,
        (None, LightKind::Directional { direction } | LightKind::Spot { direction, .. }) => direction,
    };
    let (up, right) = tangent_frame(ahead);
    Mat3::from_cols(right, up, -ahead)
}

/// From the world to metres from the light; for parallel light, from the origin.
pub fn light_from_world(sample: &LightSample) -> Mat4 {
    let place = sample.place();
    Mat4::from_mat3(axes(sample).transpose()) * Mat4::from_translation(-place.w * place.truncate())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Light;
    use glam::Vec3;

    #[test]
    fn a_light_looks_ahead_and_space_is_not_mirrored() {
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
            let has_place = !matches!(kind, LightKind::Directional { .. });
            let seen = light_from_world(&sample).transform_point3(position + 2.0 * direction);
            assert!(!has_place || (seen.length() - 2.0).abs() < 1e-5, "{seen}");
        }
    }
}
