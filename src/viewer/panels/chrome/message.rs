//! Messages: a notice that disappears after some seconds, and an error that stays until it is closed.

use std::time::{Duration, Instant};

use egui::{Align2, Area, Frame, Id, Order, Rect, RichText, Ui};

use super::theme;
use crate::viewer::action::Action;
use crate::viewer::session::light_state::LightState;

/// How long a notice is shown.
const NOTICE_TIME: Duration = Duration::from_secs(4);

/// A line of text that disappears after some seconds.
pub struct Notice {
    text: String,
    until: Instant,
}

impl Notice {
    /// Creates a notice that is shown from now on.
    pub fn new(text: impl Into<String>) -> Self {
        Self { text: text.into(), until: Instant::now() + NOTICE_TIME }
    }
}

/// An error that is shown until it is closed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trouble {
    /// What failed.
    pub title: String,
    /// The full message.
    pub text: String,
    /// True if the text quotes code. It is then shown in a monospaced font, without the offer to open another file.
    pub is_code: bool,
}

impl Trouble {
    /// Creates a message in words.
    pub fn new(title: impl Into<String>, text: impl Into<String>) -> Self {
        Self { title: title.into(), text: text.into(), is_code: false }
    }

    /// Creates a message that quotes code.
    pub fn of_code(title: impl Into<String>, text: impl Into<String>) -> Self {
        Self { is_code: true, ..Self::new(title, text) }
    }
}

/// Fills the area of the picture while no scene is open.
pub fn empty_ui(ctx: &egui::Context, free: Rect, light: &LightState) {
    let text = match light {
        LightState::Working { .. } => "Opening ...",
        _ => "Drop a .glb or .gltf file here, or press O",
    };
    let place = Area::new(Id::unique("empty")).pivot(Align2::CENTER_CENTER).fixed_pos(free.center());
    place.order(Order::Background).interactable(false).show(ctx, |ui| {
        ui.add(egui::Label::new(RichText::new(text).heading().weak()).extend());
    });
}

pub fn notice_ui(ctx: &egui::Context, notice: &mut Option<Notice>) {
    let Some(shown) = notice else { return };
    let left = shown.until.saturating_duration_since(Instant::now());
    if left.is_zero() {
        *notice = None;
        return;
    }
    ctx.request_repaint_after(left);
    let place = Area::new(Id::unique("notice")).anchor(Align2::LEFT_TOP, [16.0, 16.0]).interactable(false);
    place.show(ctx, |ui| {
        Frame::window(ui.style()).show(ui, |ui| ui.add(egui::Label::new(RichText::new(&shown.text).strong()).extend()));
    });
}

pub fn trouble_ui(ctx: &egui::Context, trouble: &mut Option<Trouble>, actions: &mut Vec<Action>) {
    let Some(shown) = trouble.clone() else { return };
    let title = RichText::new(&shown.title).strong().color(theme::ALARM);
    let window = egui::Window::new(title).id(Id::unique("trouble")).collapsible(false).resizable(false);
    window.anchor(Align2::CENTER_CENTER, [0.0, 0.0]).default_width(520.0).show(ctx, |ui| {
        let text = RichText::new(&shown.text);
        // A quoted line of code and the mark below it must not be wrapped.
        let label =
            if shown.is_code { egui::Label::new(text.monospace()).extend() } else { egui::Label::new(text).wrap() };
        ui.add(label.selectable(true));
        ui.add_space(6.0);
        if !shown.is_code {
            ui.label(RichText::new("Drop another .glb or .gltf file on the window, or choose one.").weak());
        }
        ui.add_space(6.0);
        buttons_ui(ui, &shown, trouble, actions);
    });
}

fn buttons_ui(ui: &mut Ui, shown: &Trouble, trouble: &mut Option<Trouble>, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        if ui.button("Close").clicked() {
            *trouble = None;
        }
        if !shown.is_code && ui.button("Open the built-in scene").clicked() {
            *trouble = None;
            actions.push(Action::OpenBuiltIn);
        }
        if !shown.is_code && ui.button("Choose a file ...").clicked() {
            *trouble = None;
            actions.push(Action::ChooseFile);
        }
        if ui.button("Copy the text").clicked() {
            ui.copy_text(format!("{}: {}", shown.title, shown.text));
        }
    });
}
