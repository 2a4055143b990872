//! One frame, and when the next one is due.

use std::time::{Duration, Instant};

use winit::event_loop::ControlFlow;

use super::errand::Kind;
use super::panels::{
    Action, BakeFacts, CameraFacts, Facts, MeasurementFacts, PictureFacts, SceneFacts, ShadowFacts, Tab,
};
use super::screen::{PanelShapes, Shown};
use super::walkthrough::Walkthrough;
use super::worker::Worker;

/// Renewed light is wanted this many frame times after the last, so that showing it costs the bake little.
const LIGHT_INTERVAL: f32 = 6.0;

impl Walkthrough {
    /// Draws one frame.
    pub(super) fn draw_frame(&mut self) {
        // The bake rests until the frame is on the screen.
        let held = self.session.worker().map(Worker::hold);
        self.errands.hold();
        let is_baking = held.is_some();
        let seconds = self.pacer.begin();

        // Follow the keys.
        let is_moving = self.advance(seconds);
        // Lay out the panels; what they ask for changes the next frame.
        let (panels, actions) = self.lay_out();
        // The picture and the panels on top.
        let shown = self.show(panels);

        drop(held);
        self.errands.go_on();
        self.pacer.end(is_baking);
        if is_moving || shown == Shown::Retry || !actions.is_empty() {
            self.pacer.want();
        }
        if let Some(worker) = self.session.worker() {
            worker.ask_for_light(Duration::from_secs_f32(LIGHT_INTERVAL * self.pacer.frame_seconds()));
        }
        for action in actions {
            self.perform(action);
        }
        self.remember_changes();
    }

    /// Moves the eye; whether it goes on moving.
    fn advance(&mut self, seconds: f32) -> bool {
        let intent = self.keys.intent();
        let Some(place) = &mut self.session.place else { return false };
        if !intent.is_moving() && !place.traveller.is_moving() {
            return false;
        }
        place.traveller.advance(intent, seconds, &place.collider);
        intent.is_moving() || place.traveller.is_moving()
    }

    fn lay_out(&mut self) -> (PanelShapes, Vec<Action>) {
        let place = self.session.place.as_ref();
        let next_settings = self.next_settings();
        // The area of a large scene is not summed for a page that nobody sees.
        let baked_place = place.filter(|_| self.panels.memory.tab == Tab::Solution);
        let curve = self.session.curve();
        let solved = place.and_then(|place| place.solved.as_deref());
        let sees = |point| place.is_some_and(|place| place.sees(point));
        let laps = self.screen.canvas.laps();
        let facts = Facts {
            scene: SceneFacts {
                open: place.map(|place| &*place.scene),
                variant: self.session.variant(),
                num_elements: self.session.num_elements(),
                advice: place.map_or(&[], |place| &place.advice),
            },
            bake: BakeFacts {
                light: self.session.light_state(),
                is_solved: solved.is_some(),
                next: baked_place.map(|place| (next_settings, place.mesh_sizes(&next_settings))),
                curve: &curve,
                report: solved.and_then(|solved| solved.report.as_ref()),
                recording: self.inquiry.recording.as_deref(),
                is_recording: self.errands.is_out(Kind::Record),
            },
            camera: CameraFacts {
                pose: place.map(|place| place.traveller.eye),
                is_walking: place.is_some_and(|place| place.traveller.is_walking()),
                speed: place.map_or(0.0, |place| place.traveller.pace()),
                is_captured: self.look.is_captured(),
                bookmarks: self.panels.memory.bookmarks_of(&self.session.name()),
                is_visible: &sees,
            },
            picture: PictureFacts {
                size: self.picture_size,
                num_rays: self.inquiry.num_rays,
                is_writing: self.errands.is_out(Kind::Write),
                frame_rate: self.pacer.frame_rate(),
                frame_seconds: self.pacer.frame_seconds(),
                adapter: &self.adapter,
            },
            shadows: ShadowFacts {
                num_light_samples: self.inquiry.num_light_samples,
                num_points: self.num_points(),
                difference: self.screen.canvas.difference(),
                fault: self.inquiry.fault.as_deref(),
                laps: &laps.passes,
                has_device_clock: laps.is_of_device,
            },
            measurement: MeasurementFacts {
                last: self.inquiry.last.as_ref(),
                pins: &self.inquiry.pins,
                grid: self.inquiry.grid.as_ref(),
                patch_view: self.inquiry.sight.as_ref(),
                is_busy: self.errands.is_out(Kind::Measure),
            },
        };
        let (mut actions, mut free) = (Vec::new(), egui::Rect::ZERO);
        let mut shapes = self.gui.run(&self.window, |ui| (actions, free) = self.panels.ui(ui, &facts));
        shapes.divider = self.panels.light.divider;
        let window = self.screen.size().map(|side| side as f32 / shapes.pixels_per_point);
        shapes.side = egui::Rect::from_min_max(egui::pos2(free.right(), 0.0), egui::pos2(window[0], free.bottom()));
        self.picture_size = pixels(free, shapes.pixels_per_point, self.screen.size());
        (shapes, actions)
    }

    fn show(&mut self, panels: PanelShapes) -> Shown {
        self.screen.canvas.time(&self.screen.gpu, self.panels.shows_times());
        let picture = self.next_picture();
        self.screen.show(&self.window, picture, panels)
    }

    /// Asks for the next frame where one is due, else says until when nothing needs to happen.
    pub fn plan(&mut self) -> ControlFlow {
        let now = Instant::now();
        let wake = [self.gui.wake(), self.settle, self.still_due].into_iter().flatten().min();
        if wake.is_some_and(|wake| wake <= now) {
            self.gui.clear_wake();
            self.pacer.want();
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

/// Size in pixels of a rectangle that begins at the window's top left corner.
fn pixels(free: egui::Rect, pixels_per_point: f32, window: [u32; 2]) -> [u32; 2] {
    let side = |points: f32, limit: u32| ((points * pixels_per_point).ceil() as u32).clamp(1, limit.max(1));
    [side(free.right(), window[0]), side(free.bottom(), window[1])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_never_leaves_the_window() {
        let rect = |x, y| egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(x, y));
        assert_eq!(pixels(rect(100.0, 50.5), 1.5, [400, 300]), [150, 76]);
        assert_eq!(pixels(rect(900.0, -3.0), 2.0, [400, 300]), [400, 1]);
    }
}
