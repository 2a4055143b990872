//! Facts about the camera.

use glam::Vec3;

use crate::viewer::camera::pose::CameraPose;

/// Facts about the camera.
#[derive(Clone)]
pub struct CameraFacts<'a> {
    /// Position and direction of the camera; `None` before a scene is open.
    pub pose: Option<CameraPose>,
    /// True if the camera walks on the floor, false if it flies.
    pub is_walking: bool,
    /// Speed without running, m/s.
    pub speed: f32,
    /// True while the mouse is captured and turns the camera.
    pub is_captured: bool,
    /// Numbers of the bookmarks of this scene.
    pub bookmarks: Vec<u8>,
    /// Returns true if no surface hides a point from the camera.
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
    /// Returns the position of the camera, metres; the origin before a scene is open.
    #[must_use]
    pub fn position(&self) -> Vec3 {
        self.pose.map_or(Vec3::ZERO, |pose| pose.position)
    }
}
