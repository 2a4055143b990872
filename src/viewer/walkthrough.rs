//! The open window and what its events mean; what they ask for is done in `actions`, and a frame is drawn by
//! `frame`.

use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::event::{DeviceEvent, ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::event_loop::EventLoopProxy;
use winit::keyboard::{Key, KeyCode, NamedKey, PhysicalKey};
use winit::window::Window;

use super::ViewerOptions;
use super::errand::Errands;
use super::gui::Gui;
use super::input::{Keys, MouseLook};
use super::inquiry::Inquiry;
use super::marks_cache::MarksCache;
use super::memory::Memory;
use super::pacing::Pacer;
use super::panels::{Notice, Panels, Tool, Trouble};
use super::screen::Screen;
use super::session::{Outcome, Session};
use super::shortcuts::action_of;
use super::worker::{Event, News, Source};
use crate::bake::BakeSettings;

/// Pixels of a touchpad's scroll that count as one notch of a wheel.
const PIXELS_A_NOTCH: f64 = 40.0;

/// What is this near to the divider of a split screen takes hold of it, points.
const DIVIDER_REACH: f32 = 7.0;

/// What the user has set is written down at most this often.
const REMEMBER_INTERVAL: Duration = Duration::from_secs(2);

/// The open window and everything that lives as long.
pub struct Walkthrough {
    pub(super) window: Arc<Window>,
    pub(super) screen: Screen,
    pub(super) gui: Gui,
    pub(super) panels: Panels,
    pub(super) session: Session,
    pub(super) keys: Keys,
    pub(super) look: MouseLook,
    pub(super) pacer: Pacer,
    /// Pixels that the panels leave for the picture, across and down.
    pub(super) picture_size: [u32; 2],
    /// When a sketch shall be drawn out.
    pub(super) settle: Option<Instant>,
    /// As given on the command line; the first bake's.
    pub(super) settings: BakeSettings,
    pub(super) adapter: String,
    /// Work that clicks have asked for.
    pub(super) errands: Errands,
    /// What it has brought.
    pub(super) inquiry: Inquiry,
    pub(super) marks: MarksCache,
    /// When a still camera begins to trace.
    pub(super) still_due: Option<Instant>,
    /// What was written down last, and when.
    remembered: (Memory, Instant),
    /// A still camera was to trace in the last frame.
    pub(super) traced_stills: bool,
    /// Light samples that are added up in a frame while the camera rests.
    pub(super) samples_a_frame: usize,
    /// What the eye circles round while a button is held.
    orbit: Option<glam::Vec3>,
}

impl Walkthrough {
    /// Sets the window up and begins to load.
    ///
    /// # Errors
    /// No graphics device, no thread, or a frame log that cannot be written.
    pub fn new(window: Arc<Window>, options: &ViewerOptions, proxy: EventLoopProxy<News>) -> anyhow::Result<Self> {
        let screen = Screen::new(&window)?;
        let gui = Gui::new(&window, screen.gpu.device.limits().max_texture_dimension_2d);
        let refresh_rate = window.current_monitor().and_then(|monitor| monitor.refresh_rate_millihertz());
        let pacer = Pacer::new(refresh_rate.map_or(60.0, |rate| rate as f32 / 1e3), options.frame_log.as_deref())?;
        let errands = Errands::new(proxy.clone());
        let mut session = Session::new(Arc::clone(&screen.gpu), proxy);
        let memory = Memory::place().map_or_else(Memory::default, |path| Memory::read(&path));
        let source = options.scene.clone().map_or_else(Source::default, Source::of);
        session.open(source, options.variant.clone(), options.settings)?;
        Ok(Self {
            adapter: screen.gpu.name(),
            picture_size: screen.size(),
            remembered: (memory.clone(), Instant::now()),
            panels: Panels::new(options.settings.quality, memory),
            settings: options.settings,
            keys: Keys::default(),
            look: MouseLook::default(),
            window,
            screen,
            gui,
            session,
            pacer,
            settle: None,
            errands,
            inquiry: Inquiry::default(),
            marks: MarksCache::default(),
            still_due: None,
            traced_stills: false,
            samples_a_frame: 1,
            orbit: None,
        })
    }

    /// The worker has something to tell.
    pub fn on_news(&mut self, news: News) {
        // The open file stays the same from bake to bake.
        if news.job == self.session.job() || matches!(news.event, Event::FileChanged) {
            self.on_event(news.event);
        }
        self.pacer.want();
    }

    fn on_event(&mut self, event: Event) {
        let outcome = match event {
            Event::Found(errand, finding) => return self.receive(errand, finding),
            Event::FileChanged => return self.reload("The file has changed: reading it again"),
            event => self.session.hear(event),
        };
        match outcome {
            Outcome::Changed => {}
            Outcome::Opened => self.welcome(),
            Outcome::Note(text) => self.panels.notice = Some(Notice::new(text)),
            Outcome::Trouble(title, text) => self.panels.trouble = Some(Trouble { title, text }),
        }
    }

    fn welcome(&mut self) {
        self.forget();
        let Some(place) = &self.session.place else { return };
        self.window.set_title(&format!("{} - Hemicube", place.scene.name));
        self.panels.light.reset_groups(&place.scene);
        self.panels.selection = Default::default();
        self.panels.shown_advice = None;
        self.panels.trouble = None;
        if let Some(advice) = place.advice.first().filter(|advice| advice.text == super::default_sky::NOTE) {
            self.panels.notice = Some(Notice::new(advice.text.as_str()));
        }
        let name = self.session.name();
        if matches!(Source::of(name.clone()), Source::File(_)) {
            self.panels.memory.opened(&name);
        }
        self.remember();
    }

    /// Writes down what has changed, now and then.
    pub(super) fn remember_changes(&mut self) {
        if self.remembered.1.elapsed() > REMEMBER_INTERVAL && self.remembered.0 != self.panels.memory {
            self.remember();
        }
    }

    fn remember(&mut self) {
        if let Some(path) = Memory::place() {
            self.panels.memory.write(&path);
        }
        self.remembered = (self.panels.memory.clone(), Instant::now());
    }

    /// An event of the window; true where the window shall close.
    pub fn on_window_event(&mut self, event: &WindowEvent) -> bool {
        let is_looking = matches!(event, WindowEvent::CursorMoved { .. }) && self.look.is_active();
        if !is_looking && *event != WindowEvent::RedrawRequested && self.gui.on_event(&self.window, event).repaint {
            self.pacer.want();
        }
        match event {
            WindowEvent::CloseRequested => return true,
            WindowEvent::RedrawRequested => self.draw_frame(),
            WindowEvent::Resized(size) => {
                self.screen.resize(*size);
                self.pacer.want();
            }
            WindowEvent::Focused(false) => {
                self.keys.release_all();
                self.look.release(&self.window);
            }
            WindowEvent::DroppedFile(path) => self.open(path.clone()),
            WindowEvent::KeyboardInput { event, .. } if self.is_quit(event) => return true,
            WindowEvent::KeyboardInput { event, .. } if !self.gui.has_keyboard() => self.on_key(event),
            WindowEvent::MouseInput { state: ElementState::Pressed, button, .. } if self.is_over_picture() => {
                self.press(*button);
            }
            WindowEvent::MouseInput { state: ElementState::Released, button, .. } => self.lift(*button),
            WindowEvent::MouseWheel { delta, .. } if self.is_over_picture() => self.on_wheel(*delta),
            WindowEvent::CursorMoved { position, .. } => {
                let turn = self.look.pointer_motion(*position);
                self.turn(turn);
            }
            _ => {}
        }
        false
    }

    /// Raw motion of the mouse.
    pub fn on_device_event(&mut self, event: &DeviceEvent) {
        if let DeviceEvent::MouseMotion { delta } = event {
            let turn = self.look.raw_motion(*delta);
            self.turn(turn);
        }
    }

    fn turn(&mut self, turn: Option<(f32, f32)>) {
        if let (Some((left, up)), Some(place)) = (turn, &mut self.session.place) {
            match self.orbit {
                Some(pivot) => place.traveller.orbit(pivot, left, up),
                None => place.traveller.eye.turn(left, up),
            }
            self.pacer.want();
        }
    }

    /// The pointer is over the picture and over nothing that lies on it. The panels know of it only since their last frame, which
    /// a quick click does not wait for.
    fn is_over_picture(&self) -> bool {
        let [width, height] = self.picture_size.map(f64::from);
        let is_on_divider = |x: f64| {
            let reach = f64::from(DIVIDER_REACH) * self.window.scale_factor();
            self.panels.light.is_split() && (x - f64::from(self.panels.light.divider) * width).abs() < reach
        };
        let is_inside = self.look.pointer().is_none_or(|[x, y]| x < width && y < height && !is_on_divider(x));
        is_inside && !self.gui.has_pointer()
    }

    fn press(&mut self, button: MouseButton) {
        let circles = button == MouseButton::Middle || (button == MouseButton::Left && self.keys.is_alt_down());
        let pivot = self.look.pointer().filter(|_| circles).and_then(|pixel| self.picked(pixel));
        self.orbit = pivot.map(|pick| pick.point);
        self.look.press(button, &self.window);
        self.pacer.want();
    }

    fn lift(&mut self, button: MouseButton) {
        let click = self.look.lift(button, &self.window).filter(|_| self.orbit.is_none());
        self.orbit = None;
        match click {
            Some(_) if self.panels.tool == Tool::Look => self.look.capture(&self.window),
            Some(pixel) => self.click(pixel),
            None => {}
        }
        self.pacer.want();
    }

    /// Ctrl and Q.
    fn is_quit(&self, event: &KeyEvent) -> bool {
        event.state == ElementState::Pressed
            && event.physical_key == PhysicalKey::Code(KeyCode::KeyQ)
            && self.keys.is_control_down()
    }

    fn on_key(&mut self, event: &KeyEvent) {
        let is_down = event.state == ElementState::Pressed;
        if let PhysicalKey::Code(code) = event.physical_key {
            self.keys.set(code, is_down);
        }
        if is_down && event.logical_key == Key::Named(NamedKey::Escape) {
            self.escape();
        } else if is_down && let Some(action) = action_of(event, self.keys.is_control_down()) {
            self.perform(action);
        }
        self.pacer.want();
    }

    /// Gives back what is open, one thing at a time.
    fn escape(&mut self) {
        let panels = &mut self.panels;
        let _ = self.look.release(&self.window)
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
        if self.keys.is_control_down() {
            self.zoom(notches);
        } else if let Some(place) = &mut self.session.place {
            place.traveller.change_speed(notches);
        }
        self.pacer.want();
    }
}

impl Drop for Walkthrough {
    fn drop(&mut self) {
        self.remember();
    }
}
