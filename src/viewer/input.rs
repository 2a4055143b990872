//! Keys that are held and the mouse that looks around.

use std::collections::HashSet;
use std::time::{Duration, Instant};

use winit::dpi::PhysicalPosition;
use winit::event::MouseButton;
use winit::keyboard::KeyCode;
use winit::window::{CursorGrabMode, Window};

use super::travel::Intent;

/// Turn for one pixel of mouse movement, radians.
const TURN_PER_PIXEL: f32 = 0.0025;
/// A press that moves less than this far, in pixels, and ends soon is a click.
const CLICK_REACH: f32 = 4.0;
/// Longest click.
const CLICK_TIME: Duration = Duration::from_millis(300);

/// Which keys are down.
#[derive(Debug, Default)]
pub struct Keys(HashSet<KeyCode>);

impl Keys {
    /// A key goes down or up.
    pub fn set(&mut self, key: KeyCode, is_down: bool) {
        if is_down {
            self.0.insert(key);
        } else {
            self.0.remove(&key);
        }
    }

    /// All keys are up (the window has lost the keyboard).
    pub fn release_all(&mut self) {
        self.0.clear();
    }

    /// Either control key is down.
    #[must_use]
    pub fn is_control_down(&self) -> bool {
        self.any(&[KeyCode::ControlLeft, KeyCode::ControlRight])
    }

    /// Either Alt key is down.
    #[must_use]
    pub fn is_alt_down(&self) -> bool {
        self.any(&[KeyCode::AltLeft, KeyCode::AltRight])
    }

    /// Where the held keys want to go.
    #[must_use]
    pub fn intent(&self) -> Intent {
        use KeyCode::*;
        Intent {
            forward: self.axis(&[KeyW], &[KeyS]),
            right: self.axis(&[KeyD], &[KeyA]),
            up: self.axis(&[KeyE, Space], &[KeyQ, KeyC]),
            turn_left: self.axis(&[ArrowLeft], &[ArrowRight]),
            turn_up: self.axis(&[ArrowUp], &[ArrowDown]),
            run: self.any(&[ShiftLeft, ShiftRight]),
        }
    }

    fn axis(&self, plus: &[KeyCode], minus: &[KeyCode]) -> f32 {
        f32::from(self.any(plus)) - f32::from(self.any(minus))
    }

    fn any(&self, keys: &[KeyCode]) -> bool {
        keys.iter().any(|key| self.0.contains(key))
    }
}

/// The mouse looks around while a button is held, or after a click until Escape.
#[derive(Debug, Default)]
pub struct MouseLook {
    state: State,
    /// The system reports raw motion; else the pointer's own steps are used.
    has_raw_motion: bool,
    pointer: Option<PhysicalPosition<f64>>,
    /// Where the pointer comes back to.
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

impl MouseLook {
    /// Mouse motion turns the view.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.state != State::Free
    }

    /// The pointer is locked until Escape or a click.
    #[must_use]
    pub fn is_captured(&self) -> bool {
        self.state == State::Captured
    }

    /// A button goes down over the picture.
    pub fn press(&mut self, button: MouseButton, window: &Window) {
        if self.is_captured() {
            self.release(window);
        } else if matches!(button, MouseButton::Left | MouseButton::Right | MouseButton::Middle) && !self.is_active() {
            self.state = State::Dragging { button, since: Instant::now(), travelled: 0.0 };
            self.begin(window);
            // Only some systems can lock; the others go on reporting motion while a button is held.
            let _ = window.set_cursor_grab(CursorGrabMode::Locked);
        }
    }

    /// A button goes up and a drag ends; where the left button was clicked, if it was: pixels from the window's corner.
    pub fn lift(&mut self, button: MouseButton, window: &Window) -> Option<[f64; 2]> {
        let State::Dragging { button: dragging, since, travelled } = self.state else { return None };
        if dragging != button {
            return None;
        }
        let at = self.start.or(self.pointer);
        self.release(window);
        let is_click = button == MouseButton::Left && travelled < CLICK_REACH && since.elapsed() < CLICK_TIME;
        at.filter(|_| is_click).map(|at| [at.x, at.y])
    }

    /// Keeps the mouse until Escape or a press.
    pub fn capture(&mut self, window: &Window) {
        self.state = State::Captured;
        self.begin(window);
        let locked = window.set_cursor_grab(CursorGrabMode::Locked);
        if locked.or_else(|_| window.set_cursor_grab(CursorGrabMode::Confined)).is_err() {
            log::debug!("the pointer cannot be kept in the window");
        }
    }

    /// Where the pointer is, pixels from the window's corner.
    #[must_use]
    pub fn pointer(&self) -> Option<[f64; 2]> {
        self.pointer.map(|at| [at.x, at.y])
    }

    /// Gives the mouse back; whether it was taken.
    pub fn release(&mut self, window: &Window) -> bool {
        if !self.is_active() {
            return false;
        }
        self.state = State::Free;
        // Both may be refused; then the pointer is where the user left it.
        let _ = window.set_cursor_grab(CursorGrabMode::None);
        if let Some(start) = self.start.take() {
            let _ = window.set_cursor_position(start);
        }
        window.set_cursor_visible(true);
        true
    }

    /// Raw motion of the mouse, pixels right and down; the turn (left, up) in radians.
    pub fn raw_motion(&mut self, delta: (f64, f64)) -> Option<(f32, f32)> {
        if !self.is_active() {
            return None;
        }
        self.has_raw_motion = true;
        self.turn(delta.0 as f32, delta.1 as f32)
    }

    /// The pointer has moved to a place in the window; the turn where there is no raw motion.
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
    fn opposite_keys_cancel_each_other() {
        let mut keys = Keys::default();
        keys.set(KeyCode::KeyW, true);
        keys.set(KeyCode::KeyD, true);
        assert_eq!(keys.intent(), Intent { forward: 1.0, right: 1.0, ..Intent::default() });
        keys.set(KeyCode::KeyS, true);
        assert_eq!(keys.intent().forward, 0.0);
        keys.release_all();
        assert_eq!(keys.intent(), Intent::default());
    }

    #[test]
    fn the_pointer_turns_the_view_only_where_raw_motion_is_silent() {
        let mut look = MouseLook { state: State::Captured, ..MouseLook::default() };
        assert_eq!(look.pointer_motion(PhysicalPosition::new(10.0, 10.0)), None);
        let (left, up) = look.pointer_motion(PhysicalPosition::new(20.0, 10.0)).expect("no raw motion so far");
        assert!(left < 0.0 && up == 0.0);
        assert!(look.raw_motion((0.0, 5.0)).is_some_and(|(_, up)| up < 0.0));
        assert_eq!(look.pointer_motion(PhysicalPosition::new(30.0, 10.0)), None);
    }

    #[test]
    fn a_free_mouse_turns_nothing() {
        let mut look = MouseLook::default();
        assert_eq!(look.raw_motion((5.0, 5.0)), None);
    }
}
