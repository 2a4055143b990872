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
        let button = Button::new(camera.name.as_str()).truncate();
        let response = ui.vertical_centered_justified(|ui| ui.add(button)).inner;
        if response.on_hover_text("Page Up and Page Down step through them").clicked() {
            commands.push(Command::Jump(index));
        }
    }
}
