//! Cameras: those of the file; a click goes there.

use egui::{Button, RichText, Ui};

use super::Command;
use crate::scene::Scene;

pub fn cameras_ui(ui: &mut Ui, scene: Option<&Scene>, commands: &mut Vec<Command>) {
    let cameras = scene.map_or(&[][..], |scene| &scene.cameras);
    if cameras.is_empty() {
        ui.label(RichText::new("The file brings none.").weak());
    }
    for (index, camera) in cameras.iter().enumerate() {
        let wide = egui::vec2(ui.available_width(), 0.0);
        let button = Button::new(camera.name.as_str()).truncate().min_size(wide);
        if ui.add(button).on_hover_text("Page Up and Page Down step through them").clicked() {
            commands.push(Command::Jump(index));
        }
    }
}
