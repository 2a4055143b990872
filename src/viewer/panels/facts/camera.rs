//! Facts about the camera.

use glam::Vec3;

use crate::viewer::camera::pose::CameraPose;

/// What the panels show of the camera.
#[derive(Clone)]
pub struct CameraFacts<'a> {
    /// Where the camera is and where it looks; `None` before a scene is open.
    pub pose: Option<CameraPose>,
    /// The camera walks on the floor; otherwise it flies.
    pub is_walking: bool,
    /// Speed without running, metres a second.
    pub speed: f32,
    /// The window has captured the mouse, which turns the camera until Escape is pressed.
    pub is_captured: bool,
    /// Numbers of the bookmarks of this scene.
    pub bookmarks: Vec<u8>,
    /// Whether no surface hides a point from the camera.
    pub is_visible: &'a dyn Fn(Vec3) -> bool,
}

impl Default for CameraFacts<'_> {
    fn default() -> Self {
        Self {
            pose: None,
            is_walking: false,
            speed: 0.0,
            is_captured: false,
            bookmarks: Vec::new(),
            is_visible: &|_| true,
        }
    }
}

impl CameraFacts<'_> {
    /// Position of the camera, metres; the origin before a scene is open.
    #[must_use]
    pub fn position(&self) -> Vec3 {
        self.pose.map_or(Vec3::ZERO, |pose| pose.position)
    }
}
