//! Keys that are held down.

use std::collections::HashSet;

use winit::keyboard::KeyCode;

use crate::viewer::camera::controller::MotionInput;

/// The keys that are held down.
#[derive(Debug, Default)]
pub struct Keys(HashSet<KeyCode>);

impl Keys {
    /// Records that a key is pressed or released.
    pub fn set(&mut self, key: KeyCode, is_down: bool) {
        if is_down {
            self.0.insert(key);
        } else {
            self.0.remove(&key);
        }
    }

    /// Releases all keys, for example when the window loses the focus.
    pub fn release_all(&mut self) {
        self.0.clear();
    }

    /// Returns true if a control key is down.
    #[must_use]
    pub fn is_control_down(&self) -> bool {
        self.any(&[KeyCode::ControlLeft, KeyCode::ControlRight])
    }

    /// Returns true if an Alt key is down.
    #[must_use]
    pub fn is_alt_down(&self) -> bool {
        self.any(&[KeyCode::AltLeft, KeyCode::AltRight])
    }

    /// Returns the movement that the keys request.
    #[must_use]
    pub fn motion_input(&self) -> MotionInput {
        use KeyCode::*;
        MotionInput {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opposite_keys_cancel_each_other() {
        let mut keys = Keys::default();
        keys.set(KeyCode::KeyW, true);
        keys.set(KeyCode::KeyD, true);
        assert_eq!(keys.motion_input(), MotionInput { forward: 1.0, right: 1.0, ..MotionInput::default() });
        keys.set(KeyCode::KeyS, true);
        assert_eq!(keys.motion_input().forward, 0.0);
        keys.release_all();
        assert_eq!(keys.motion_input(), MotionInput::default());
    }
}
