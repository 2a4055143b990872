//! Colours and spacing of the panels: dark grey, so that the picture is the brightest area, with one warm accent
//! colour.

use egui::{Color32, CornerRadius, Frame, Margin, RichText, Stroke, Theme, Visuals};

/// The accent colour.
pub const ACCENT: Color32 = Color32::from_rgb(255, 190, 92);
/// Colour of errors.
pub const ALARM: Color32 = Color32::from_rgb(255, 118, 104);
/// Colour of warnings.
pub const WARNING: Color32 = Color32::from_rgb(240, 190, 80);

const PANEL: Color32 = Color32::from_rgb(21, 23, 27);
const TEXT: Color32 = Color32::from_gray(214);
const STRONG_TEXT: Color32 = Color32::from_gray(245);
const WEAK_TEXT: Color32 = Color32::from_gray(150);
const LINE: Color32 = Color32::from_gray(50);

/// Applies the theme to the whole context.
pub fn apply(ctx: &egui::Context) {
    ctx.set_theme(Theme::Dark);
    ctx.set_visuals_of(Theme::Dark, visuals());
    ctx.all_styles_mut(|style| {
        style.spacing.item_spacing = egui::vec2(8.0, 5.0);
        style.spacing.button_padding = egui::vec2(9.0, 4.0);
        style.spacing.slider_rail_height = 4.0;
        // The scroll bar must not cover numbers at the right edge.
        style.spacing.scroll =
            egui::style::ScrollStyle { floating_allocated_width: 8.0, ..egui::style::ScrollStyle::thin() };
        // An animation would request frames and slow down the bake.
        style.animation_time = 0.0;
    });
    // The panels have the scale of the desktop. The keys Ctrl + and Ctrl - do not change it.
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
}

fn visuals() -> Visuals {
    let mut visuals = Visuals::dark();
    visuals.panel_fill = PANEL;
    visuals.window_fill = Color32::from_rgb(24, 26, 31);
    visuals.window_stroke = Stroke::new(1.0, LINE);
    visuals.window_corner_radius = CornerRadius::same(8);
    visuals.weak_text_color = Some(WEAK_TEXT);
    visuals.warn_fg_color = WARNING;
    visuals.error_fg_color = ALARM;
    visuals.selection.bg_fill = Color32::from_rgb(122, 84, 28);
    visuals.selection.stroke = Stroke::new(1.0, Color32::from_rgb(255, 226, 178));
    visuals.slider_trailing_fill = true;
    visuals.extreme_bg_color = Color32::from_rgb(11, 12, 15);
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.fg_stroke.color = TEXT;
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, LINE);
    widgets.inactive.fg_stroke.color = TEXT;
    widgets.inactive.weak_bg_fill = Color32::from_rgb(45, 49, 57);
    widgets.inactive.bg_fill = Color32::from_rgb(58, 63, 73);
    widgets.hovered.weak_bg_fill = Color32::from_rgb(62, 68, 79);
    widgets.hovered.bg_fill = Color32::from_rgb(76, 83, 96);
    widgets.hovered.fg_stroke.color = STRONG_TEXT;
    widgets.active.fg_stroke.color = STRONG_TEXT;
    visuals
}

/// Returns the frame of the side panel.
pub fn side() -> Frame {
    Frame::new().fill(PANEL).inner_margin(Margin { left: 14, right: 8, top: 10, bottom: 6 })
}

/// Returns the frame of the status line.
pub fn bar() -> Frame {
    Frame::new().fill(PANEL).inner_margin(Margin::symmetric(12, 4))
}

/// Formats the title of a section.
#[must_use]
pub fn title(text: &str) -> RichText {
    RichText::new(text).strong().color(STRONG_TEXT).size(14.5)
}

/// Formats the name of a key.
#[must_use]
pub fn key(text: &str) -> RichText {
    RichText::new(text).monospace().color(ACCENT)
}
