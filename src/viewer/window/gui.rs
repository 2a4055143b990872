//! egui in the window: passes events to the panels, and turns the panels into triangles.

use std::time::{Duration, Instant};

use winit::event::WindowEvent;
use winit::window::Window;

use crate::viewer::panels::shapes::PanelShapes;
use crate::viewer::panels::theme;

/// egui and its connection to the window.
pub struct Gui {
    ctx: egui::Context,
    state: egui_winit::State,
    /// Time at which the panels have to be drawn again even if no event arrives.
    wake: Option<Instant>,
}

impl Gui {
    /// Creates the panels of `window` at its scale.
    #[must_use]
    pub fn new(window: &Window, max_texture_side: u32) -> Self {
        let ctx = egui::Context::default();
        theme::apply(&ctx);
        let state = egui_winit::State::new(
            ctx.clone(),
            egui::ViewportId::ROOT,
            window,
            Some(window.scale_factor() as f32),
            window.theme(),
            Some(max_texture_side as usize),
        );
        Self { ctx, state, wake: None }
    }

    /// Passes an event to the panels.
    pub fn on_event(&mut self, window: &Window, event: &WindowEvent) -> egui_winit::EventResponse {
        self.state.on_window_event(window, event)
    }

    /// Returns true if the pointer is over a panel or drags one of its widgets.
    #[must_use]
    pub fn has_pointer(&self) -> bool {
        self.ctx.egui_wants_pointer_input() || self.ctx.is_pointer_over_egui()
    }

    /// Returns true if keys are typed into a text field.
    #[must_use]
    pub fn has_keyboard(&self) -> bool {
        self.ctx.text_edit_focused()
    }

    /// Returns the time at which the panels have to be drawn again even if no event arrives.
    #[must_use]
    pub fn wake(&self) -> Option<Instant> {
        self.wake
    }

    /// Clears [`Gui::wake`], since a frame is about to be drawn.
    pub fn clear_wake(&mut self) {
        self.wake = None;
    }

    /// Lays out the panels with `contents`, and sets the shape of the pointer and the clipboard.
    pub fn run(&mut self, window: &Window, contents: impl FnMut(&mut egui::Ui)) -> PanelShapes {
        let input = self.state.take_egui_input(window);
        let output = self.ctx.run_ui(input, contents);
        self.state.handle_platform_output(window, output.platform_output);
        let delay = output.viewport_output.get(&egui::ViewportId::ROOT).map(|viewport| viewport.repaint_delay);
        // egui expresses "never" as a very long delay.
        self.wake = delay.filter(|&delay| delay < Duration::from_secs(3600)).map(|delay| Instant::now() + delay);
        PanelShapes {
            primitives: self.ctx.tessellate(output.shapes, output.pixels_per_point),
            textures: output.textures_delta,
            pixels_per_point: output.pixels_per_point,
            side: egui::Rect::ZERO,
            divider: 1.0,
        }
    }
}
