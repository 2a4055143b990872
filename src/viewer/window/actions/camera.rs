//! Actions that move the camera: to cameras of the file, bookmarks, instances, locations of advice.

use crate::base::bounds::Bounds;
use crate::base::ids::TriangleId;
use crate::scene::Scene;
use crate::viewer::action::Action;
use crate::viewer::camera::pose::CameraPose;
use crate::viewer::session::open_scene::OpenScene;
use crate::viewer::settings::view::AdviceLocation;
use crate::viewer::window::viewer::Viewer;

/// Factor on the field of view for one notch of the wheel.
const ZOOM_NOTCH: f32 = 1.08;
/// Narrowest and widest field of view, degrees.
const FOV_RANGE: [f32; 2] = [10.0, 120.0];

impl Viewer {
    /// Performs an action that moves or changes the camera.
    pub(super) fn move_camera(&mut self, action: Action) {
        let aspect = self.picture.aspect();
        let Some(OpenScene { scene, collider, controller, camera_index, .. }) = &mut self.session.open_scene else {
            return;
        };
        match action {
            Action::ShowAdvice(index) => self.show_advice(index),
            Action::FrameAll => controller.frame_all(collider, aspect),
            Action::FrameInstance(index) => {
                if let Some(bounds) = bounds_of(scene, index) {
                    controller.frame(bounds, aspect);
                }
            }
            Action::SetFieldOfView(degrees) => controller.pose.fov_y = degrees.to_radians(),
            Action::ToggleWalking if controller.toggle_walking(collider).is_err() => {
                self.notify("No floor below to walk on: still flying");
            }
            Action::GoToCamera(index) => self.go_to_camera(index),
            Action::StepCamera(steps) => {
                let index = wrapped(*camera_index, steps, scene.cameras.len());
                self.go_to_camera(index);
            }
            _ => {}
        }
    }

    fn go_to_camera(&mut self, index: usize) {
        let Some(OpenScene { scene, collider, controller, camera_index, .. }) = &mut self.session.open_scene else {
            return;
        };
        *camera_index = index;
        if let Some(camera) = scene.cameras.get(index) {
            controller.jump(CameraPose::from_camera(camera), collider);
            let text = format!("Camera: {}", camera.name);
            self.notify(text);
        }
    }

    /// Marks the locations of a piece of advice and frames the next of them.
    fn show_advice(&mut self, index: usize) {
        let aspect = self.picture.aspect();
        let Some(OpenScene { controller, advice, .. }) = &mut self.session.open_scene else { return };
        let Some(advice) = advice.get(index) else { return };
        let last = self.panels.shown_advice.filter(|shown| shown.advice == index);
        let location = last.map_or(0, |shown| (shown.location + 1) % advice.locations.len().max(1));
        self.panels.shown_advice = Some(AdviceLocation { advice: index, location });
        if let Some(bounds) = advice.bounds(location) {
            controller.frame(bounds, aspect);
        }
    }

    pub(super) fn go_to_bookmark(&mut self, number: u8) {
        let name = self.session.name();
        let Some(OpenScene { collider, controller, .. }) = &mut self.session.open_scene else { return };
        let text = match self.panels.preferences.bookmark(&name, number) {
            Some(pose) => {
                controller.jump(pose, collider);
                format!("Bookmark {number}")
            }
            None => format!("No bookmark {number} yet: Ctrl {number} sets it"),
        };
        self.notify(text);
    }

    pub(super) fn set_bookmark(&mut self, number: u8) {
        let name = self.session.name();
        let Some(OpenScene { controller, .. }) = &self.session.open_scene else { return };
        self.panels.preferences.set_bookmark(&name, number, &controller.pose);
        self.notify(format!("This view is bookmark {number}"));
    }

    /// Narrows the field of view by notches of the wheel.
    pub fn zoom(&mut self, notches: f32) {
        if let Some(open_scene) = &mut self.session.open_scene {
            let angle = &mut open_scene.controller.pose.fov_y;
            *angle = (*angle * ZOOM_NOTCH.powf(-notches)).clamp(FOV_RANGE[0].to_radians(), FOV_RANGE[1].to_radians());
        }
    }
}

/// Computes the bounding box of an instance.
fn bounds_of(scene: &Scene, index: usize) -> Option<Bounds> {
    let triangles = scene.instances.get(index)?.triangles.clone();
    Bounds::around(triangles.flat_map(|t| scene.corners(TriangleId::new(t))))
}

/// Returns `index + steps` modulo `count`.
fn wrapped(index: usize, steps: isize, count: usize) -> usize {
    if count == 0 { 0 } else { (index as isize + steps).rem_euclid(count as isize) as usize }
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn stepping_through_cameras_wraps_around() {
        assert_eq!(wrapped(0, -1, 3), 2);
        assert_eq!(wrapped(2, 1, 3), 0);
        assert_eq!(wrapped(0, 1, 0), 0);
    }
}
