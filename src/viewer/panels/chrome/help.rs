//! The key sheet: a list of all keys.

use egui::{Align2, Grid, Id, Ui};

use super::theme;

/// A heading, and below it keys with what they do.
type Subject = (&'static str, &'static [(&'static str, &'static str)]);

/// The whole key sheet.
const SHEET: [Subject; 5] = [
    (
        "Moving",
        &[
            ("W A S D", "forward, left, back, right"),
            ("Shift", "run"),
            ("F", "walk or fly"),
            ("E Space / Q C", "up / down while flying"),
            ("Wheel", "faster or slower"),
            ("Ctrl Wheel", "narrower or wider view"),
            ("Home", "the whole scene in view"),
            ("PgUp PgDn", "cameras of the file"),
            ("1 ... 9", "go to a bookmark, Ctrl sets it"),
        ],
    ),
    (
        "Looking",
        &[
            ("Drag", "look around with either button"),
            ("Click", "capture the mouse, Esc releases it"),
            ("Alt Drag", "orbit the point under the mouse"),
            ("Arrows", "look around without a mouse"),
        ],
    ),
    (
        "Measuring",
        &[
            ("M", "lux meter: a click measures a point"),
            ("G", "grid: a click measures a flat surface"),
            ("N", "a click shows the view from that patch"),
            ("L", "a click selects an object"),
            ("Enter", "pin the reading"),
            ("Esc", "back to looking around"),
        ],
    ),
    (
        "Light",
        &[
            ("- +", "darker, brighter by a third of a stop"),
            ("X", "automatic exposure"),
            ("T", "tone map"),
            ("V", "lit, light only, lux, reflectance, normals"),
            ("J K", "direct, indirect light"),
            ("R", "trace rays while the camera is still"),
            ("B", "start a bake, or end it"),
        ],
    ),
    (
        "Window",
        &[
            ("P", "show or hide the panels"),
            ("F11", "full screen"),
            ("F12", "write a picture"),
            ("H F1", "this sheet"),
            ("O", "choose a file; or drop one"),
            ("F5", "read the file and the shaders again"),
            ("Ctrl Q", "quit"),
        ],
    ),
];

pub fn help_ui(ctx: &egui::Context, is_open: &mut bool) {
    let window = egui::Window::new("All keys").id(Id::unique("keys")).collapsible(false).resizable(false).open(is_open);
    window.anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(ctx, |ui| {
        ui.horizontal_top(|ui| {
            for (column, subjects) in [&SHEET[..3], &SHEET[3..]].into_iter().enumerate() {
                ui.vertical(|ui| column_ui(ui, column, subjects));
                ui.add_space(14.0);
            }
        });
    });
}

fn column_ui(ui: &mut Ui, column: usize, subjects: &[Subject]) {
    Grid::new(column).num_columns(2).spacing([18.0, 4.0]).show(ui, |ui| {
        for (subject, keys) in subjects {
            ui.label(theme::title(subject));
            ui.end_row();
            for (key, meaning) in *keys {
                ui.label(theme::key(key));
                ui.label(*meaning);
                ui.end_row();
            }
        }
    });
}
