//! Labels over a picture of shadows: the divider of a split screen, names, percentages, known faults.

use egui::{Align2, Area, Color32, CursorIcon, FontId, Id, Order, Painter, Pos2, Rect, Role, Sense, Ui, pos2, vec2};

use super::super::chrome::theme;
use super::super::chrome::widgets::named;
use super::super::facts::Facts;
use crate::render::shadow::{DebugView, count_colour};
use crate::viewer::settings::comparison::ComparisonLayout;
use crate::viewer::settings::light::LightSettings;

/// Width of the area in which the divider can be dragged, points.
const GRIP: f32 = 14.0;
/// Distance of the first label from the top of the picture, points.
const TOP: f32 = 18.0;
/// Distance between labels, points.
const LINE: f32 = 24.0;
/// Colour of pixels that only the first technique lights.
const TOO_BRIGHT: Color32 = Color32::from_rgb(255, 96, 64);
/// Colour of pixels that only the second technique lights.
const TOO_DARK: Color32 = Color32::from_rgb(96, 150, 255);
/// Counts in the legend of the stencil view.
const COUNTS: [u32; 5] = [1, 2, 4, 6, 8];

pub fn comparison_ui(ui: &mut Ui, free: Rect, light: &mut LightSettings, facts: &Facts<'_>) {
    if facts.scene.open.is_none() {
        return;
    }
    let painter = ui.painter_at(free);
    let mut line = free.top() + TOP;
    if let Some(compared) = light.compared_technique.filter(|_| light.is_real_time) {
        let [a, b] = [light.shadows.technique, compared].map(|technique| technique.info().title);
        match light.comparison_layout {
            ComparisonLayout::Split => {
                let at = divider_ui(ui, free, &mut light.divider);
                label(&painter, pos2(at - 10.0, line), Align2::RIGHT_CENTER, a, Color32::WHITE);
                label(&painter, pos2(at + 10.0, line), Align2::LEFT_CENTER, b, Color32::WHITE);
            }
            ComparisonLayout::Difference => {
                let share =
                    facts.shadows.difference.map_or("...".to_owned(), |share| format!("{:.3} %", 100.0 * share));
                let text = format!("{a} and {b} differ in {share} of the pixels");
                let middle = pos2(free.center().x, line);
                label(&painter, middle, Align2::CENTER_CENTER, &text, Color32::WHITE);
                let next = middle + vec2(0.0, LINE);
                label(&painter, next - vec2(6.0, 0.0), Align2::RIGHT_CENTER, "lit by the first only", TOO_BRIGHT);
                label(&painter, next + vec2(6.0, 0.0), Align2::LEFT_CENTER, "lit by the second only", TOO_DARK);
            }
        }
        line += 2.0 * LINE;
    }
    if light.is_real_time && light.debug == Some(DebugView::StencilCounts) {
        counts_ui(&painter, pos2(free.center().x, free.bottom() - TOP));
    }
    if let Some(fault) = facts.shadows.fault.filter(|_| light.is_real_time) {
        label(&painter, pos2(free.center().x, line), Align2::CENTER_CENTER, fault, theme::WARNING);
    }
}

/// Draws the line between both halves, which can be dragged. Returns its position, points.
fn divider_ui(ui: &mut Ui, free: Rect, divider: &mut f32) -> f32 {
    let at = free.left() + *divider * free.width();
    let grip = Rect::from_center_size(pos2(at, free.center().y), vec2(GRIP, free.height()));
    // The divider is an egui area of its own, so that dragging it does not turn the camera.
    let area = Area::new(Id::unique("divider")).order(Order::Background).fixed_pos(grip.min).constrain(false);
    let response = area.show(ui.ctx(), |ui| ui.allocate_response(grip.size(), Sense::drag())).inner;
    named(&response, Role::Slider, "Divider");
    if let Some(pointer) = response.interact_pointer_pos() {
        *divider = ((pointer.x - free.left()) / free.width().max(1.0)).clamp(0.02, 0.98);
    }
    let response = response.on_hover_cursor(CursorIcon::ResizeHorizontal);
    let colour = if response.hovered() || response.dragged() { theme::ACCENT } else { Color32::WHITE };
    let painter = ui.painter_at(free);
    painter.vline(at, free.y_range(), (3.0, Color32::from_black_alpha(140)));
    painter.vline(at, free.y_range(), (1.0, colour));
    painter.circle(pos2(at, free.center().y), 7.0, Color32::from_black_alpha(170), (1.5, colour));
    at
}

/// Draws the legend of the stencil view.
fn counts_ui(painter: &Painter, centre: Pos2) {
    let width = 44.0 * COUNTS.len() as f32;
    for (index, count) in COUNTS.into_iter().enumerate() {
        let left = pos2(centre.x - 0.5 * width + 44.0 * index as f32, centre.y);
        let [r, g, b] = count_colour(count);
        let text = if count == 8 { "8 +".to_owned() } else { count.to_string() };
        label(painter, left + vec2(18.0, 0.0), Align2::LEFT_CENTER, &text, Color32::WHITE);
        painter.rect_filled(
            Rect::from_center_size(left + vec2(6.0, 0.0), vec2(14.0, 14.0)),
            2.0,
            Color32::from_rgb(r, g, b),
        );
    }
}

/// Draws text on a dark background, readable over any picture.
fn label(painter: &Painter, at: Pos2, anchor: Align2, text: &str, colour: Color32) {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(13.5), colour);
    let rect = anchor.anchor_size(at, galley.size());
    painter.rect_filled(rect.expand2(vec2(6.0, 2.0)), 4.0, Color32::from_black_alpha(190));
    painter.galley(rect.min, galley, colour);
}
