//! Pinned readings and grids in the picture, each at its point.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Ui, pos2, vec2};
use glam::Vec3;

use super::super::chrome::theme;
use super::super::chrome::widgets::lux;
use super::super::facts::Facts;
use crate::render::turbo;
use crate::viewer::settings::light::GroupDial;

/// Largest number of points of a grid that is drawn with numbers.
const MAX_NUMBERS: usize = 120;

pub fn markers_ui(ui: &mut Ui, free: Rect, dials: &[GroupDial], facts: &Facts<'_>) {
    let Some(eye) = facts.camera.pose else { return };
    let aspect = facts.picture.size[0] as f32 / facts.picture.size[1] as f32;
    let painter = ui.painter_at(free);
    let place = |point: Vec3| {
        let [x, y] = eye.project(point, aspect)?;
        (x.abs() <= 1.0 && y.abs() <= 1.0 && (facts.camera.is_visible)(point))
            .then(|| free.center() + vec2(0.5 * x * free.width(), -0.5 * y * free.height()))
    };
    if let Some(grid) = facts.measurement.grid {
        let largest = grid.max().max(f32::MIN_POSITIVE);
        let has_numbers = grid.measured.len() <= MAX_NUMBERS;
        for (point, value) in grid.plan.points.iter().zip(grid.lux()) {
            let Some(at) = place(point.position) else { continue };
            let [r, g, b] = turbo(value / largest);
            painter.circle(at, 3.5, Color32::from_rgb(r, g, b), (1.0, Color32::BLACK));
            if has_numbers {
                let text = lux(value);
                label(&painter, at + vec2(6.0, -6.0), &text, 11.0, Color32::WHITE);
            }
        }
    }
    for reading in facts.measurement.pins {
        let Some(at) = place(reading.point.position) else { continue };
        pin(&painter, at, &format!("{} lx", lux(reading.dimmed_lux(dials))), Color32::WHITE);
    }
    if let Some(last) = facts.measurement.last
        && let Some(at) = place(last.point.position)
    {
        pin(&painter, at, &format!("{} lx", lux(last.dimmed_lux(dials))), theme::ACCENT);
    }
    if let Some(at) = facts.measurement.patch_view.and_then(|sight| place(sight.point.position)) {
        pin(&painter, at, "view from here", theme::ACCENT);
    }
}

fn pin(painter: &Painter, at: Pos2, text: &str, colour: Color32) {
    painter.circle(at, 5.0, Color32::TRANSPARENT, (3.0, Color32::BLACK));
    painter.circle(at, 5.0, Color32::TRANSPARENT, (1.5, colour));
    painter.circle_filled(at, 1.5, colour);
    label(painter, pos2(at.x + 9.0, at.y - 9.0), text, 13.0, colour);
}

/// Draws text on a dark background, readable over any picture.
fn label(painter: &Painter, at: Pos2, text: &str, size: f32, colour: Color32) {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(size), colour);
    let rect = Align2::LEFT_CENTER.anchor_size(at, galley.size());
    painter.rect_filled(rect.expand2(vec2(4.0, 1.0)), 3.0, Color32::from_black_alpha(190));
    painter.galley(rect.min, galley, colour);
}
