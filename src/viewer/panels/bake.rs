//! Bake: preset, start, progress, cancel, and what the last bake took.

use egui::{Button, ProgressBar, RichText, Ui};

use super::{Command, Facts, LightState, clock, grouped, row, theme};
use crate::bake::Quality;
use crate::base::progress::Stage;

pub fn bake_ui(ui: &mut Ui, quality: &mut Quality, facts: &Facts<'_>, commands: &mut Vec<Command>) {
    match &facts.light {
        &LightState::Working { stage, done, elapsed, is_cancelled } => {
            working_ui(ui, stage, done, is_cancelled, commands);
            row(ui, "Time", clock(elapsed));
            if stage == Stage::Solve {
                row(ui, "Unshot light", format!("{:.1} %", 100.0 * (1.0 - done)));
            }
        }
        LightState::Stored => {
            ui.label(RichText::new("The file is a bake: its light is shown as it is stored.").weak());
        }
        state => {
            start_ui(ui, quality, facts, commands);
            outcome_ui(ui, state);
        }
    }
    if let Some(num_elements) = facts.num_elements {
        row(ui, "Elements", grouped(num_elements));
    }
}

fn working_ui(ui: &mut Ui, stage: Stage, done: f32, is_cancelled: bool, commands: &mut Vec<Command>) {
    let label = RichText::new(format!("{}   {:.0} %", stage.label(), 100.0 * done)).color(egui::Color32::WHITE);
    ui.add(ProgressBar::new(done).text(label).desired_height(20.0));
    let cancel = Button::new(if is_cancelled { "Ending ..." } else { "Cancel" });
    let can_cancel = !is_cancelled && stage != Stage::Load;
    let response = ui.vertical_centered_justified(|ui| ui.add_enabled(can_cancel, cancel)).inner;
    if response.on_hover_text("Ends the bake and keeps the light that is solved").clicked() {
        commands.push(Command::CancelBake);
    }
}

fn start_ui(ui: &mut Ui, quality: &mut Quality, facts: &Facts<'_>, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.label("Quality");
        for (preset, label, hint) in [
            (Quality::Draft, "Draft", "Coarse, in seconds"),
            (Quality::Medium, "Medium", "Good for walking"),
            (Quality::High, "High", "Fine shadows, takes its time"),
        ] {
            ui.selectable_value(quality, preset, label).on_hover_text(hint);
        }
    });
    let start = Button::new(RichText::new("Bake").strong());
    let response = ui.vertical_centered_justified(|ui| ui.add_enabled(facts.scene.is_some(), start)).inner;
    if response.on_hover_text("Solves the light anew (B)").clicked() {
        commands.push(Command::Bake);
    }
}

fn outcome_ui(ui: &mut Ui, state: &LightState) {
    match state {
        LightState::Baked { elapsed, unshot_share, num_hemicubes, num_patches } => {
            row(ui, "Took", clock(*elapsed));
            row(ui, "Unshot light", format!("{:.2} %", 100.0 * unshot_share));
            row(ui, "Patches", grouped(*num_patches));
            row(ui, "Hemicubes", grouped(*num_hemicubes));
        }
        LightState::Dark => {
            ui.label(RichText::new("No light yet: shown in an even work light.").color(theme::WARNING));
        }
        LightState::Nothing | LightState::Stored | LightState::Working { .. } => {}
    }
}
