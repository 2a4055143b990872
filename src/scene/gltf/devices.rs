//! Lights and cameras of the file, placed in the world.

use glam::{DAffine3, DMat3, DQuat, DVec3, Vec3};
use gltf::json::camera::{Camera as CameraDefinition, Type as CameraType};
use gltf::json::extensions::scene::khr_lights_punctual::{Light, Type as LightType};
use gltf::json::validation::Checked;

use super::error::Cause;
use crate::base::ids::GroupId;
use crate::scene::{self, Camera, LightKind, Projection};

pub(super) use gltf::json::extensions::scene::khr_lights_punctual::Light as LightDefinition;

/// Highest intensity that is taken for meant, candela or lux.
const MAX_INTENSITY: f32 = 1e15;

/// A light at its place, in group 0 until groups are made; none where it is dark.
pub(super) fn light(definition: &Light, name: &str, world_from_node: DAffine3) -> Result<Option<scene::Light>, Cause> {
    let intensity = (Vec3::from(definition.color) * definition.intensity).max(Vec3::ZERO);
    let is_sensible = definition.intensity.is_finite() && Vec3::from(definition.color).is_finite();
    if !is_sensible || intensity.max_element() > MAX_INTENSITY {
        return Err(Cause::NotFinite(format!("the intensity of light {name:?}")));
    }
    if intensity == Vec3::ZERO {
        return Ok(None);
    }
    let Checked::Valid(kind) = definition.type_ else {
        return Err(Cause::NotGltf(format!("light {name:?} is of unknown type")));
    };
    let position = world_from_node.translation.as_vec3();
    let direction = frame(world_from_node).z_axis.as_vec3() * -1.0;
    let kind = match kind {
        LightType::Point => LightKind::Point { position },
        LightType::Directional => LightKind::Directional { direction },
        LightType::Spot => spot(definition, position, direction),
    };
    let range = definition.range.filter(|&range| range > 0.0 && range.is_finite());
    Ok(Some(scene::Light { name: name.to_owned(), kind, intensity, range, group: GroupId(0) }))
}

/// Angles outside the extension's limits are brought inside.
fn spot(definition: &Light, position: Vec3, direction: Vec3) -> LightKind {
    let default_outer = std::f32::consts::FRAC_PI_4;
    let (inner, outer) =
        definition.spot.as_ref().map_or((0.0, default_outer), |spot| (spot.inner_cone_angle, spot.outer_cone_angle));
    let outer_angle = if outer > 0.0 { outer.min(std::f32::consts::FRAC_PI_2) } else { default_outer };
    let inner_angle = if inner > 0.0 { inner.min(outer_angle) } else { 0.0 };
    LightKind::Spot { position, direction, inner_angle, outer_angle }
}

/// A camera at its place; scale and mirroring of its node are ignored.
pub(super) fn camera(definition: &CameraDefinition, name: String, world_from_node: DAffine3) -> Result<Camera, Cause> {
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

/// Right-handed orthonormal axes that keep the node's +Z exactly and its +Y as nearly as possible.
fn frame(world_from_node: DAffine3) -> DMat3 {
    let z = world_from_node.matrix3.z_axis.try_normalize().unwrap_or(DVec3::Z);
    let across = world_from_node.matrix3.y_axis.cross(z);
    let x = across.try_normalize().unwrap_or_else(|| z.any_orthonormal_vector());
    DMat3::from_cols(x, z.cross(x), z)
}
