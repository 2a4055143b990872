//! View: what is shown of the surfaces, and how one gets about.

use egui::Ui;

use super::super::settings::{LightSettings, SHADINGS};
use super::{Command, Facts};

pub fn view_ui(ui: &mut Ui, light: &mut LightSettings, facts: &Facts<'_>, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        for (shading, label, hint) in SHADINGS {
            ui.selectable_value(&mut light.shading, shading, label).on_hover_text(format!("{hint} (V)"));
        }
    });
    ui.checkbox(&mut light.see_through_backs, "look through backs of walls")
        .on_hover_text("Single-sided walls hide nothing from behind");
    ui.horizontal(|ui| {
        if ui.selectable_label(facts.is_walking, "Walk").on_hover_text("With gravity and walls (F)").clicked()
            && !facts.is_walking
        {
            commands.push(Command::ToggleWalking);
        }
        if ui.selectable_label(!facts.is_walking, "Fly").on_hover_text("Through everything (F)").clicked()
            && facts.is_walking
        {
            commands.push(Command::ToggleWalking);
        }
        if ui.button("Frame all").on_hover_text("The whole scene in view (Home)").clicked() {
            commands.push(Command::FrameAll);
        }
        if ui.button("Picture").on_hover_text("Writes a PNG without the panels (F12)").clicked() {
            commands.push(Command::Screenshot);
        }
    });
}
