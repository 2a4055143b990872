//! The mouse: drags and captured motion turn the camera, short presses are clicks.

use std::time::{Duration, Instant};

use winit::dpi::PhysicalPosition;
use winit::event::MouseButton;
use winit::window::{CursorGrabMode, Window};

/// Turn for one pixel of motion, radians.
const TURN_PER_PIXEL: f32 = 0.0025;
/// Largest motion during a press that still counts as a click, pixels.
const CLICK_REACH: f32 = 4.0;
/// Longest duration of a press that still counts as a click.
const CLICK_TIME: Duration = Duration::from_millis(300);

/// State of the mouse. Its motion turns the camera while a button is held, and while it is captured.
#[derive(Debug, Default)]
pub struct Mouse {
    state: State,
    /// True if the system reports raw motion. Otherwise the motion is the change of the pointer's position.
    has_raw_motion: bool,
    /// Last position of the pointer, pixels.
    pointer: Option<PhysicalPosition<f64>>,
    /// Position to which the pointer is set back after a drag or capture.
    start: Option<PhysicalPosition<f64>>,
}

#[derive(Debug, Default, PartialEq)]
enum State {
    #[default]
    Free,
    Dragging {
        button: MouseButton,
        since: Instant,
        travelled: f32,
    },
    Captured,
}

impl Mouse {
    /// Returns true if motion turns the camera.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.state != State::Free
    }

    /// Returns true if the mouse is captured.
    #[must_use]
    pub fn is_captured(&self) -> bool {
        self.state == State::Captured
    }

    /// Handles the press of a button over the picture.
    pub fn press(&mut self, button: MouseButton, window: &Window) {
        if self.is_captured() {
            self.set_free(window);
        } else if matches!(button, MouseButton::Left | MouseButton::Right | MouseButton::Middle) && !self.is_active() {
            self.state = State::Dragging { button, since: Instant::now(), travelled: 0.0 };
            self.begin(window);
            // Systems that cannot lock the pointer still report motion while a button is held.
            let _ = window.set_cursor_grab(CursorGrabMode::Locked);
        }
    }

    /// Handles the release of a button, which ends a drag. Returns the position of a click of the left button, pixels.
    pub fn release(&mut self, button: MouseButton, window: &Window) -> Option<[f64; 2]> {
        let State::Dragging { button: dragging, since, travelled } = self.state else { return None };
        if dragging != button {
            return None;
        }
        let at = self.start.or(self.pointer);
        self.set_free(window);
        let is_click = button == MouseButton::Left && travelled < CLICK_REACH && since.elapsed() < CLICK_TIME;
        at.filter(|_| is_click).map(|at| [at.x, at.y])
    }

    /// Captures the mouse until Escape or a press.
    pub fn capture(&mut self, window: &Window) {
        self.state = State::Captured;
        self.begin(window);
        let locked = window.set_cursor_grab(CursorGrabMode::Locked);
        if locked.or_else(|_| window.set_cursor_grab(CursorGrabMode::Confined)).is_err() {
            log::debug!("the pointer cannot be confined to the window");
        }
    }

    /// Returns the position of the pointer, pixels from the top left corner of the window.
    #[must_use]
    pub fn pointer(&self) -> Option<[f64; 2]> {
        self.pointer.map(|at| [at.x, at.y])
    }

    /// Ends a drag or a capture. Returns false if there was none.
    pub fn set_free(&mut self, window: &Window) -> bool {
        if !self.is_active() {
            return false;
        }
        self.state = State::Free;
        // The system may refuse to release the pointer or to move it. The pointer then stays where it is.
        let _ = window.set_cursor_grab(CursorGrabMode::None);
        if let Some(start) = self.start.take() {
            let _ = window.set_cursor_position(start);
        }
        window.set_cursor_visible(true);
        true
    }

    /// Returns the turn (left, up), radians, for raw motion in pixels (right, down).
    pub fn raw_motion(&mut self, delta: (f64, f64)) -> Option<(f32, f32)> {
        if !self.is_active() {
            return None;
        }
        self.has_raw_motion = true;
        self.turn(delta.0 as f32, delta.1 as f32)
    }

    /// Returns the turn (left, up), radians, for a new position of the pointer; `None` if the system reports raw
    /// motion.
    pub fn pointer_motion(&mut self, to: PhysicalPosition<f64>) -> Option<(f32, f32)> {
        let from = self.pointer.replace(to)?;
        if !self.is_active() || self.has_raw_motion {
            return None;
        }
        self.turn((to.x - from.x) as f32, (to.y - from.y) as f32)
    }

    fn begin(&mut self, window: &Window) {
        self.has_raw_motion = false;
        self.start = self.pointer;
        window.set_cursor_visible(false);
    }

    fn turn(&mut self, right: f32, down: f32) -> Option<(f32, f32)> {
        if let State::Dragging { travelled, .. } = &mut self.state {
            *travelled += right.hypot(down);
        }
        Some((-right * TURN_PER_PIXEL, -down * TURN_PER_PIXEL))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pointer_turns_the_camera_only_without_raw_motion() {
        let mut mouse = Mouse { state: State::Captured, ..Mouse::default() };
        assert_eq!(mouse.pointer_motion(PhysicalPosition::new(10.0, 10.0)), None);
        let (left, up) = mouse.pointer_motion(PhysicalPosition::new(20.0, 10.0)).expect("no raw motion so far");
        assert!(left < 0.0 && up == 0.0);
        assert!(mouse.raw_motion((0.0, 5.0)).is_some_and(|(_, up)| up < 0.0));
        assert_eq!(mouse.pointer_motion(PhysicalPosition::new(30.0, 10.0)), None);
    }

    #[test]
    fn a_free_mouse_does_not_turn_the_camera() {
        let mut mouse = Mouse::default();
        assert_eq!(mouse.raw_motion((5.0, 5.0)), None);
    }
}
