//! Cameras of the file, placed in the world.

use glam::{DAffine3, DQuat};
use gltf::json::camera::{Camera as CameraDefinition, Type as CameraType};
use gltf::json::validation::Checked;

use super::error::Cause;
use super::node::tree::frame;
use crate::scene::{Camera, Projection};

/// Returns the camera at its position in the world; scale and mirroring of its node are ignored.
///
/// # Errors
/// Returns an error if the camera has no valid projection.
pub(super) fn placed(definition: &CameraDefinition, name: String, world_from_node: DAffine3) -> Result<Camera, Cause> {
    let missing = || Cause::NotGltf(format!("camera {name:?} lacks its projection"));
    let projection = match definition.type_ {
        Checked::Valid(CameraType::Perspective) => {
            let fov_y = definition.perspective.as_ref().ok_or_else(missing)?.yfov;
            Projection::Perspective { fov_y: clamp_finite(fov_y, 0.01, 3.1) }
        }
        Checked::Valid(CameraType::Orthographic) => {
            let half_height = definition.orthographic.as_ref().ok_or_else(missing)?.ymag.abs();
            Projection::Orthographic { half_height: clamp_finite(half_height, 1e-3, 1e6) }
        }
        Checked::Invalid => return Err(missing()),
    };
    let world_from_view = DQuat::from_mat3(&frame(world_from_node)).normalize().as_quat();
    Ok(Camera { name, position: world_from_node.translation.as_vec3(), world_from_view, projection })
}

fn clamp_finite(number: f32, low: f32, high: f32) -> f32 {
    if number.is_nan() { low } else { number.clamp(low, high) }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use serde_json::json;

    use super::super::fixture::Fixture;
    use super::*;

    #[test]
    fn a_camera_looks_along_minus_z_even_in_a_mirrored_node() {
        let mut fixture = Fixture::triangle();
        fixture.json["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1}}]);
        fixture.json["nodes"][0] = json!({"camera": 0, "scale": [-1, 1, 1], "translation": [0, 1, 0]});
        let camera = &fixture.load().cameras[0];
        assert_eq!((camera.name.as_str(), camera.position), ("camera 0", Vec3::Y));
        assert!((camera.forward() - Vec3::NEG_Z).length() < 1e-6, "{}", camera.forward());
        assert!((camera.world_from_view * Vec3::Y - Vec3::Y).length() < 1e-6);
        assert_eq!(camera.projection, Projection::Perspective { fov_y: 1.0 });
    }
}
