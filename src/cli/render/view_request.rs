//! The view of a scene that is drawn.

use anyhow::{Context, Result};

use super::options::{Lighting, RenderArgs};
use crate::scene::{Camera, Scene};

/// A view to draw, by rasterisation or by rays.
#[derive(Clone, Debug)]
pub struct ViewRequest {
    /// Camera of the picture.
    pub camera: Camera,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Which light the picture shows.
    pub lighting: Lighting,
}

impl ViewRequest {
    /// Returns the view that the options describe.
    ///
    /// # Errors
    /// Returns an error if the scene has no such camera.
    pub fn new(scene: &Scene, args: &RenderArgs) -> Result<Self> {
        let camera = args.eye.clone().map_or_else(|| choose_camera(scene, args.camera.as_deref()), Ok)?;
        Ok(Self { camera, size: args.size.0, lighting: args.lighting() })
    }
}

/// Returns the camera with the given name or, if there is none, the given index. Without either, returns the first
/// camera, or one with the whole scene in view if the scene has none.
fn choose_camera(scene: &Scene, wanted: Option<&str>) -> Result<Camera> {
    let Some(wanted) = wanted else {
        return Ok(scene.cameras.first().cloned().unwrap_or_else(|| Camera::framing(scene.bounds())));
    };
    let named = scene.cameras.iter().find(|camera| camera.name == wanted);
    let numbered = || wanted.parse::<usize>().ok().and_then(|index| scene.cameras.get(index));
    named.or_else(numbered).cloned().with_context(|| {
        let names: Vec<_> = scene.cameras.iter().map(|camera| camera.name.as_str()).collect();
        format!("{} has no camera {wanted}; it has {} ({})", scene.name, names.len(), names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn a_camera_is_found_by_name_then_by_index() {
        let camera = |name| Camera::looking_at(name, Vec3::Z, Vec3::ZERO, 1.0);
        let scene = Scene { cameras: vec![camera("door"), camera("0")], ..Scene::default() };
        let chosen = |wanted| choose_camera(&scene, wanted).map(|camera| camera.name);
        assert_eq!(chosen(None).expect("the first"), "door");
        assert_eq!(chosen(Some("0")).expect("by name"), "0");
        assert_eq!(chosen(Some("1")).expect("by index"), "0");
        let message = chosen(Some("attic")).expect_err("no such camera").to_string();
        assert!(message.contains("attic") && message.contains("door"), "{message}");
        assert_eq!(choose_camera(&Scene::default(), None).expect("an overview").name, "overview");
    }
}
