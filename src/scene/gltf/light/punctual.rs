//! KHR_lights_punctual: point, spot and directional lights of the file, placed in the world.

use glam::{DAffine3, Vec3};
use gltf::json::extensions::scene::khr_lights_punctual::Type as LightType;
use gltf::json::validation::Checked;

use crate::scene::gltf::error::Cause;
use crate::scene::gltf::node::tree::frame;
use crate::scene::{Light, LightKind};

pub(crate) use gltf::json::extensions::scene::khr_lights_punctual::Light as LightDefinition;

/// Highest plausible intensity, candela or lux.
pub(crate) const MAX_INTENSITY: f32 = 1e15;

/// Returns the light at its position in the world, in group 0 until groups are assigned; `None` if its intensity is
/// zero.
///
/// # Errors
/// Returns an error if the type is unknown or the intensity is not plausible.
pub(crate) fn placed(
    definition: &LightDefinition,
    name: &str,
    world_from_node: DAffine3,
) -> Result<Option<Light>, Cause> {
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
    Ok(Some(Light { name: name.to_owned(), range, ..Light::new(kind, intensity) }))
}

/// Returns a spot light; angles are clamped to the limits of the extension.
fn spot(definition: &LightDefinition, position: Vec3, direction: Vec3) -> LightKind {
    let default_outer = std::f32::consts::FRAC_PI_4;
    let (inner, outer) =
        definition.spot.as_ref().map_or((0.0, default_outer), |spot| (spot.inner_cone_angle, spot.outer_cone_angle));
    let outer_angle = if outer > 0.0 { outer.min(std::f32::consts::FRAC_PI_2) } else { default_outer };
    let inner_angle = if inner > 0.0 { inner.min(outer_angle) } else { 0.0 };
    LightKind::Spot { position, direction, inner_angle, outer_angle }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;
    use crate::scene::Scene;
    use crate::scene::gltf::fixture::Fixture;

    fn scene_with_light(light: Value, node: Value) -> Scene {
        let mut fixture = Fixture::triangle();
        fixture.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [light]}});
        fixture.json["nodes"][0] = node;
        fixture.json["nodes"][0]["extensions"] = json!({"KHR_lights_punctual": {"light": 0}});
        fixture.load()
    }

    #[test]
    fn a_spot_points_along_minus_z_of_its_node_whatever_the_scale() {
        // A quarter turn about +X maps -Z to +Y.
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let node = json!({"translation": [1, 2, 3], "rotation": [half, 0, 0, half], "scale": [2, 3, 4]});
        let light = json!({"type": "spot", "intensity": 10, "color": [1, 0.5, 0], "range": 8,
            "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.4}});
        let scene = scene_with_light(light, node);
        let LightKind::Spot { position, direction, inner_angle, outer_angle } = scene.lights[0].kind else {
            panic!("not a spot");
        };
        assert_eq!(position, Vec3::new(1.0, 2.0, 3.0));
        assert!((direction - Vec3::Y).length() < 1e-6, "{direction}");
        assert_eq!((inner_angle, outer_angle), (0.2, 0.4));
        assert_eq!(scene.lights[0].intensity, Vec3::new(10.0, 5.0, 0.0));
        assert_eq!(
            (scene.lights[0].range, scene.light_groups.as_slice()),
            (Some(8.0), ["light 0".to_owned()].as_slice())
        );
    }

    #[test]
    fn invalid_cones_are_clamped_to_the_limits() {
        let light = json!({"type": "spot", "spot": {"innerConeAngle": 3, "outerConeAngle": 2}});
        let LightKind::Spot { inner_angle, outer_angle, .. } = scene_with_light(light, json!({})).lights[0].kind else {
            panic!("not a spot");
        };
        assert!(inner_angle <= outer_angle && outer_angle <= std::f32::consts::FRAC_PI_2);
    }

    #[test]
    fn a_light_of_zero_intensity_is_ignored() {
        let scene = scene_with_light(json!({"type": "point", "intensity": 0}), json!({}));
        assert!(scene.lights.is_empty() && scene.light_groups.is_empty());
        assert!(scene.notes[0].contains("no intensity"), "{:?}", scene.notes);
    }
}
