//! The section of advice: each finding of the loader and the mesh doctor, its remedy, and its locations.

use egui::Ui;

use super::super::chrome::theme;
use super::super::chrome::widgets::hint;
use crate::viewer::action::Action;
use crate::viewer::session::advice::Advice;
use crate::viewer::settings::view::AdviceLocation;

pub fn advice_ui(ui: &mut Ui, advice: &[Advice], shown: Option<AdviceLocation>, actions: &mut Vec<Action>) {
    if advice.is_empty() {
        hint(ui, "Nothing to complain about.");
    }
    for (index, Advice { text, locations }) in advice.iter().enumerate() {
        // The finding and its remedy are separated by a semicolon.
        let (what, remedy) = text.split_once("; ").unwrap_or((text, ""));
        ui.add(egui::Label::new(egui::RichText::new(what).color(theme::WARNING)).wrap());
        if !remedy.is_empty() {
            ui.add(egui::Label::new(remedy).wrap());
        }
        if !locations.is_empty() {
            ui.horizontal(|ui| {
                let shown = shown.filter(|shown| shown.advice == index);
                let text = if shown.is_some() { "Show the next" } else { "Show where" };
                if ui
                    .small_button(text)
                    .on_hover_text("Marks the location and flies there; Esc removes the mark")
                    .clicked()
                {
                    actions.push(Action::ShowAdvice(index));
                }
                if let Some(AdviceLocation { location, .. }) = shown {
                    ui.weak(format!("{} of {}", location + 1, locations.len()));
                }
            });
        }
        ui.add_space(3.0);
    }
}
