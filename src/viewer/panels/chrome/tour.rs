//! Three lines of introduction at the first start.

use egui::{Align2, Area, Frame, Id, Rect, RichText};

use super::theme;

const LINES: [(&str, &str); 3] = [
    ("W A S D", "walk; drag the mouse to look around"),
    ("M", "then click: measures how bright it is there and where the light comes from"),
    ("H", "shows all keys; everything else is in the panel at the right"),
];

pub fn tour_ui(ctx: &egui::Context, free: Rect, has_seen: &mut bool) {
    if *has_seen {
        return;
    }
    let place = Area::new(Id::unique("tour")).pivot(Align2::CENTER_BOTTOM);
    place.fixed_pos(free.center_bottom() - egui::vec2(0.0, 24.0)).show(ctx, |ui| {
        Frame::window(ui.style()).show(ui, |ui| {
            egui::Grid::new("tour").num_columns(2).spacing([18.0, 6.0]).show(ui, |ui| {
                for (key, meaning) in LINES {
                    ui.label(theme::key(key));
                    ui.label(RichText::new(meaning).strong());
                    ui.end_row();
                }
            });
            ui.add_space(4.0);
            if ui.button("Let me walk").clicked() {
                *has_seen = true;
            }
        });
    });
}
