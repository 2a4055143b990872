//! Cameras of the file, and bookmarks.

use egui::{Button, RichText, Ui};

use super::widgets::hint;
use super::{Command, Facts};

pub fn views_ui(ui: &mut Ui, facts: &Facts<'_>, commands: &mut Vec<Command>) {
    let cameras = facts.scene.map_or(&[][..], |scene| &scene.cameras);
    if cameras.is_empty() {
        hint(ui, "The file brings none.");
    }
    for (index, camera) in cameras.iter().enumerate() {
        let button = Button::new(camera.name.as_str()).truncate();
        let response = ui.vertical_centered_justified(|ui| ui.add(button)).inner;
        if response.on_hover_text("Page Up and Page Down step through them").clicked() {
            commands.push(Command::Jump(index));
        }
    }
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.label("Bookmarks");
        for &number in &facts.bookmarks {
            let button = ui.button(RichText::new(number.to_string()).monospace());
            if button.on_hover_text(format!("Goes there (key {number})")).clicked() {
                commands.push(Command::Recall(number));
            }
        }
        let free = (1..=9).find(|number| !facts.bookmarks.contains(number));
        let add = ui.add_enabled(facts.scene.is_some() && free.is_some(), Button::new("Add"));
        if let Some(number) = free
            && add.on_hover_text(format!("Marks this view as {number} (Ctrl {number})")).clicked()
        {
            commands.push(Command::Bookmark(number));
        }
    });
}
