//! Cameras of the file, and bookmarks.

use egui::{Button, RichText, Ui};

use super::super::chrome::widgets::hint;
use super::super::facts::Facts;
use crate::viewer::action::Action;

pub fn cameras_ui(ui: &mut Ui, facts: &Facts<'_>, actions: &mut Vec<Action>) {
    let cameras = facts.scene.open.map_or(&[][..], |scene| &scene.cameras);
    if cameras.is_empty() {
        hint(ui, "The file has no cameras.");
    }
    for (index, camera) in cameras.iter().enumerate() {
        let button = Button::new(camera.name.as_str()).truncate();
        let response = ui.vertical_centered_justified(|ui| ui.add(button)).inner;
        if response.on_hover_text("Page Up and Page Down step through them").clicked() {
            actions.push(Action::GoToCamera(index));
        }
    }
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.label("Bookmarks");
        for &number in &facts.camera.bookmarks {
            let button = ui.button(RichText::new(number.to_string()).monospace());
            if button.on_hover_text(format!("Goes to this view (key {number})")).clicked() {
                actions.push(Action::GoToBookmark(number));
            }
        }
        let free = (1..=9).find(|number| !facts.camera.bookmarks.contains(number));
        let add = ui.add_enabled(facts.scene.open.is_some() && free.is_some(), Button::new("Add"));
        if let Some(number) = free
            && add.on_hover_text(format!("Stores this view as bookmark {number} (Ctrl {number})")).clicked()
        {
            actions.push(Action::SetBookmark(number));
        }
    });
}
