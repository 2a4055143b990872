//! Draws a frame and schedules the next.

use std::time::{Duration, Instant};

use winit::event_loop::ControlFlow;

use crate::viewer::action::Action;
use crate::viewer::panels::Facts;
use crate::viewer::panels::shapes::PanelShapes;
use crate::viewer::session::worker::Worker;
use crate::viewer::settings::view::Tab;
use crate::viewer::window::facts;
use crate::viewer::window::surface::FrameOutcome;
use crate::viewer::window::viewer::Viewer;

/// Pause between two uploads of light during a bake, in frame times. Longer pauses leave more time to the bake.
const LIGHT_INTERVAL: f32 = 6.0;

impl Viewer {
    /// Draws one frame.
    pub fn draw_frame(&mut self) {
        // Bake and jobs pause until the frame is on the screen.
        let paused = self.session.worker().map(Worker::pause);
        self.jobs.pause();
        let is_baking = paused.is_some();
        let seconds = self.pacer.begin();

        let is_moving = self.move_by_keys(seconds);
        // Actions that the panels request are performed after this frame and change the next one.
        let (panels, actions) = self.lay_out();
        let is_retried = match self.present(panels) {
            FrameOutcome::Retry => true,
            FrameOutcome::Presented | FrameOutcome::Hidden => false,
            FrameOutcome::Failed(error) => {
                self.failure = Some(error);
                false
            }
        };

        drop(paused);
        self.jobs.resume();
        self.pacer.end(is_baking);
        if is_moving || is_retried || !actions.is_empty() {
            self.pacer.request();
        }
        if let Some(worker) = self.session.worker() {
            worker.request_light(Duration::from_secs_f32(LIGHT_INTERVAL * self.pacer.frame_seconds()));
        }
        for action in actions {
            self.perform(action);
        }
        self.save_changed_preferences();
    }

    /// Moves the camera by the keys that are held down. Returns true if it moves in the next frame too.
    fn move_by_keys(&mut self, seconds: f32) -> bool {
        let input = self.controls.keys.motion_input();
        let Some(open_scene) = &mut self.session.open_scene else { return false };
        if !input.is_moving() && !open_scene.controller.is_moving() {
            return false;
        }
        open_scene.controller.advance(input, seconds, &open_scene.collider);
        input.is_moving() || open_scene.controller.is_moving()
    }

    /// Lays out the panels. Returns the triangles of the panels and the requested actions.
    fn lay_out(&mut self) -> (PanelShapes, Vec<Action>) {
        let open_scene = self.session.open_scene.as_ref();
        let settings = self.next_settings();
        // Mesh sizes depend on the area of the scene. It is summed only if the page that shows the sizes is open.
        let scene_of_page = open_scene.filter(|_| self.panels.preferences.tab == Tab::Solution);
        let next_bake = scene_of_page.map(|open_scene| (settings, open_scene.mesh_sizes(&settings)));
        let curve = self.session.curve();
        let bookmarks = self.panels.preferences.bookmarks_of(&self.session.name());
        let is_visible = |point| open_scene.is_some_and(|open_scene| open_scene.sees(point));
        let facts = Facts {
            scene: facts::of_scene(&self.session),
            bake: facts::of_bake(&self.session, &self.results, &self.jobs, next_bake, &curve),
            camera: facts::of_camera(open_scene, self.controls.mouse.is_captured(), bookmarks, &is_visible),
            picture: facts::of_picture(&self.picture, &self.jobs, &self.pacer, &self.adapter),
            shadows: facts::of_shadows(&self.picture, &self.surface.canvas, self.num_points()),
            measurement: facts::of_measurement(&self.results, &self.jobs),
        };
        let (mut actions, mut free) = (Vec::new(), egui::Rect::ZERO);
        let mut shapes = self.gui.run(&self.window, |ui| (actions, free) = self.panels.ui(ui, &facts));
        shapes.divider = self.panels.light.divider;
        let window = self.surface.size().map(|side| side as f32 / shapes.pixels_per_point);
        shapes.side = egui::Rect::from_min_max(egui::pos2(free.right(), 0.0), egui::pos2(window[0], free.bottom()));
        self.picture.size = pixels(free, shapes.pixels_per_point, self.surface.size());
        (shapes, actions)
    }

    /// Draws and presents the next picture with the panels.
    fn present(&mut self, panels: PanelShapes) -> FrameOutcome {
        self.surface.canvas.time(&self.surface.gpu, self.panels.shows_times());
        let picture = self.next_picture();
        self.surface.present(&self.window, picture, panels)
    }

    /// Requests the next frame if one is due. Returns how long the event loop may sleep.
    pub fn plan(&mut self) -> ControlFlow {
        let now = Instant::now();
        let refinement = &self.picture.refinement;
        let wake = [self.gui.wake(), refinement.sketch_ends, refinement.tracing_begins].into_iter().flatten().min();
        if wake.is_some_and(|wake| wake <= now) {
            self.gui.clear_wake();
            self.pacer.request();
        }
        match self.pacer.due(self.session.worker().is_some()) {
            Some(due) if due <= now => {
                self.window.request_redraw();
                ControlFlow::Wait
            }
            Some(due) => ControlFlow::WaitUntil(due),
            None => wake.map_or(ControlFlow::Wait, ControlFlow::WaitUntil),
        }
    }
}

/// Computes the size, in pixels, of a rectangle at the top left corner of the window.
fn pixels(free: egui::Rect, pixels_per_point: f32, window: [u32; 2]) -> [u32; 2] {
    let side = |points: f32, limit: u32| ((points * pixels_per_point).ceil() as u32).clamp(1, limit.max(1));
    [side(free.right(), window[0]), side(free.bottom(), window[1])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_never_exceeds_the_window() {
        let rect = |x, y| egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(x, y));
        assert_eq!(pixels(rect(100.0, 50.5), 1.5, [400, 300]), [150, 76]);
        assert_eq!(pixels(rect(900.0, -3.0), 2.0, [400, 300]), [400, 1]);
    }
}
