//! Advice: what the loader and the mesh doctor found, each with what to do.

use egui::Ui;

use super::theme;
use super::widgets::hint;

pub fn advice_ui(ui: &mut Ui, advice: &[String]) {
    if advice.is_empty() {
        hint(ui, "Nothing to complain about.");
    }
    for line in advice {
        // What was found stands before the first semicolon, what to do after it.
        let (found, remedy) = line.split_once("; ").unwrap_or((line, ""));
        ui.add(egui::Label::new(egui::RichText::new(found).color(theme::WARNING)).wrap());
        if !remedy.is_empty() {
            ui.add(egui::Label::new(remedy).wrap());
        }
        ui.add_space(3.0);
    }
}
