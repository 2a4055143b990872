//! Handles events: of the window, keys and mouse, and of worker and job threads.

use winit::event::{DeviceEvent, ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::keyboard::{Key, KeyCode, NamedKey, PhysicalKey};

use crate::viewer::session::Outcome;
use crate::viewer::session::user_event::{UserEvent, WorkerEvent};
use crate::viewer::settings::tool::Tool;
use crate::viewer::window::input::shortcuts::action_of;
use crate::viewer::window::viewer::Viewer;

/// Scroll distance of a touchpad that equals one notch of a wheel, pixels.
const PIXELS_A_NOTCH: f64 = 40.0;

/// Distance from the divider of a split picture below which a press drags the divider, points.
const DIVIDER_REACH: f32 = 7.0;

impl Viewer {
    /// Handles an event of another thread.
    pub fn on_user_event(&mut self, event: UserEvent) {
        match event {
            UserEvent::Worker { run, event } if run == self.session.run() => self.on_worker_event(event),
            UserEvent::Worker { .. } => {}
            UserEvent::Job { number, result } => self.receive(number, result),
            UserEvent::FileChanged => self.reload("The file has changed: reading it again"),
            UserEvent::ShadersChanged => self.reload_shaders(),
        }
        self.pacer.request();
    }

    fn on_worker_event(&mut self, event: WorkerEvent) {
        match self.session.receive(event) {
            Outcome::Changed => {}
            Outcome::Opened => self.on_scene_opened(),
            Outcome::Note(text) => self.notify(text),
            Outcome::Trouble(title, text) => self.show_trouble(title, text),
        }
    }

    /// Handles an event of the window. Returns true if the window is to be closed.
    pub fn on_window_event(&mut self, event: &WindowEvent) -> bool {
        let is_turning = matches!(event, WindowEvent::CursorMoved { .. }) && self.controls.mouse.is_active();
        if !is_turning && *event != WindowEvent::RedrawRequested && self.gui.on_event(&self.window, event).repaint {
            self.pacer.request();
        }
        match event {
            WindowEvent::CloseRequested => return true,
            WindowEvent::RedrawRequested => self.draw_frame(),
            WindowEvent::Resized(size) => {
                let resized = self.surface.resize(*size);
                self.failure = resized.err().or(self.failure.take());
                self.pacer.request();
            }
            WindowEvent::Focused(false) => {
                self.controls.keys.release_all();
                self.controls.mouse.set_free(&self.window);
            }
            WindowEvent::DroppedFile(path) => self.open_file(path.clone()),
            WindowEvent::KeyboardInput { event, .. } if self.is_quit(event) => return true,
            WindowEvent::KeyboardInput { event, .. } if !self.gui.has_keyboard() => self.on_key(event),
            WindowEvent::MouseInput { state: ElementState::Pressed, button, .. } if self.is_over_picture() => {
                self.on_press(*button);
            }
            WindowEvent::MouseInput { state: ElementState::Released, button, .. } => self.on_release(*button),
            WindowEvent::MouseWheel { delta, .. } if self.is_over_picture() => self.on_wheel(*delta),
            WindowEvent::CursorMoved { position, .. } => {
                let turn = self.controls.mouse.pointer_motion(*position);
                self.turn(turn);
            }
            _ => {}
        }
        false
    }

    /// Handles raw motion of the mouse.
    pub fn on_device_event(&mut self, event: &DeviceEvent) {
        if let DeviceEvent::MouseMotion { delta } = event {
            let turn = self.controls.mouse.raw_motion(*delta);
            self.turn(turn);
        }
    }

    fn turn(&mut self, turn: Option<(f32, f32)>) {
        if let (Some((left, up)), Some(open_scene)) = (turn, &mut self.session.open_scene) {
            match self.controls.orbit_pivot {
                Some(pivot) => open_scene.controller.orbit(pivot, left, up),
                None => open_scene.controller.pose.turn(left, up),
            }
            self.pacer.request();
        }
    }

    /// Returns true if the pointer is over the picture and not over a panel or the divider.
    ///
    /// egui reports whether the pointer was over a panel in the last frame. A click can come before the next frame, so
    /// the current position is also compared with the size of the picture.
    fn is_over_picture(&self) -> bool {
        let [width, height] = self.picture.size.map(f64::from);
        let is_on_divider = |x: f64| {
            let reach = f64::from(DIVIDER_REACH) * self.window.scale_factor();
            self.panels.light.is_split() && (x - f64::from(self.panels.light.divider) * width).abs() < reach
        };
        let pointer = self.controls.mouse.pointer();
        let is_inside = pointer.is_none_or(|[x, y]| x < width && y < height && !is_on_divider(x));
        is_inside && !self.gui.has_pointer()
    }

    fn on_press(&mut self, button: MouseButton) {
        let orbits = button == MouseButton::Middle || (button == MouseButton::Left && self.controls.keys.is_alt_down());
        let pivot = self.controls.mouse.pointer().filter(|_| orbits).and_then(|pixel| self.pick(pixel));
        self.controls.orbit_pivot = pivot.map(|pick| pick.point);
        self.controls.mouse.press(button, &self.window);
        self.pacer.request();
    }

    fn on_release(&mut self, button: MouseButton) {
        let click = self.controls.mouse.release(button, &self.window);
        let click = click.filter(|_| self.controls.orbit_pivot.is_none());
        self.controls.orbit_pivot = None;
        match click {
            Some(_) if self.panels.tool == Tool::Look => self.controls.mouse.capture(&self.window),
            Some(pixel) => self.on_click(pixel),
            None => {}
        }
        self.pacer.request();
    }

    /// Returns true if the key is Ctrl+Q.
    fn is_quit(&self, event: &KeyEvent) -> bool {
        event.state == ElementState::Pressed
            && event.physical_key == PhysicalKey::Code(KeyCode::KeyQ)
            && self.controls.keys.is_control_down()
    }

    fn on_key(&mut self, event: &KeyEvent) {
        let is_down = event.state == ElementState::Pressed;
        if let PhysicalKey::Code(code) = event.physical_key {
            self.controls.keys.set(code, is_down);
        }
        if is_down && event.logical_key == Key::Named(NamedKey::Escape) {
            self.escape();
        } else if is_down && let Some(action) = action_of(event, self.controls.keys.is_control_down()) {
            self.perform(action);
        }
        self.pacer.request();
    }

    /// Handles the Escape key: ends one thing, the first active one of mouse capture, help, dialog, message, tool,
    /// selection and advice.
    fn escape(&mut self) {
        let panels = &mut self.panels;
        let _ = self.controls.mouse.set_free(&self.window)
            || std::mem::take(&mut panels.shows_help)
            || panels.dialog.take().is_some()
            || panels.trouble.take().is_some()
            || std::mem::take(&mut panels.tool) != Tool::Look
            || panels.selection.chosen.take().is_some()
            || panels.shown_advice.take().is_some();
    }

    fn on_wheel(&mut self, delta: MouseScrollDelta) {
        let notches = match delta {
            MouseScrollDelta::LineDelta(_, lines) => lines,
            MouseScrollDelta::PixelDelta(pixels) => (pixels.y / PIXELS_A_NOTCH) as f32,
        };
        if self.controls.keys.is_control_down() {
            self.zoom(notches);
        } else if let Some(open_scene) = &mut self.session.open_scene {
            open_scene.controller.change_speed(notches);
        }
        self.pacer.request();
    }
}
