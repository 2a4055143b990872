//! The legend of false colours, in lux.

use egui::{Align2, Color32, FontId, Rect, Ui, pos2, vec2};

use super::super::chrome::widgets::lux;
use crate::render::{LuxScale, turbo};

/// Size of the bar, points.
const BAR: egui::Vec2 = vec2(18.0, 220.0);
/// Width of the numbers, points.
const NUMBERS: f32 = 58.0;
/// Number of parts of the legend if the picture shows no lines of equal illuminance.
const DEFAULT_PARTS: u32 = 4;
/// Number of colours in the bar.
const STEPS: usize = 64;

pub fn legend_ui(ui: &mut Ui, free: Rect, scale: &LuxScale) {
    let bar = Rect::from_min_size(pos2(free.left() + 22.0, free.bottom() - BAR.y - 24.0), BAR);
    let frame = Rect::from_min_max(bar.min - vec2(10.0, 30.0), bar.max + vec2(NUMBERS, 12.0));
    if free.height() < frame.height() || free.width() < frame.width() {
        return;
    }
    let painter = ui.painter_at(free);
    painter.rect_filled(frame, 6.0, Color32::from_black_alpha(190));
    painter.text(
        bar.left_top() - vec2(0.0, 10.0),
        Align2::LEFT_BOTTOM,
        "lux",
        FontId::proportional(14.0),
        Color32::WHITE,
    );
    for step in 0..STEPS {
        let [low, high] = [step, step + 1].map(|step| bar.bottom() - BAR.y * step as f32 / STEPS as f32);
        let [r, g, b] = turbo((step as f32 + 0.5) / STEPS as f32);
        let part = Rect::from_min_max(pos2(bar.left(), high), pos2(bar.right(), low));
        painter.rect_filled(part, 0.0, Color32::from_rgb(r, g, b));
    }
    let parts = if scale.num_parts == 0 { DEFAULT_PARTS } else { scale.num_parts };
    for part in 0..=parts {
        let place = part as f32 / parts as f32;
        let y = bar.bottom() - BAR.y * place;
        painter.hline(bar.right()..=bar.right() + 4.0, y, (1.0, Color32::WHITE));
        let text = lux(scale.lux_at(place));
        painter.text(pos2(bar.right() + 8.0, y), Align2::LEFT_CENTER, text, FontId::proportional(12.0), Color32::WHITE);
    }
}
