//! Time machine: steps through a recorded bake.

use egui::{Slider, Ui};

use super::super::chrome::widgets::{grouped, hint, row, wide_button};
use super::super::facts::Facts;
use crate::viewer::action::Action;
use crate::viewer::session::light_state::LightState;
use crate::viewer::settings::view::ReplaySettings;

pub fn time_machine_ui(ui: &mut Ui, replay: &mut ReplaySettings, facts: &Facts<'_>, actions: &mut Vec<Action>) {
    let Some(recording) = facts.bake.recording else {
        record_ui(ui, facts, actions);
        return;
    };
    let last = recording.moments.len() - 1;
    replay.moment = replay.moment.min(last);
    ui.checkbox(&mut replay.is_on, "show the bake as it was").on_hover_text("Replaces the finished light");
    ui.add_enabled_ui(replay.is_on, |ui| {
        ui.horizontal(|ui| {
            for (label, hint, to) in [
                ("|<", "Direct light alone", 0),
                ("<", "One step back", replay.moment.saturating_sub(1)),
                (">", "One step forward", (replay.moment + 1).min(last)),
                (">|", "The end", last),
            ] {
                if ui.button(label).on_hover_text(hint).clicked() {
                    replay.moment = to;
                }
            }
            ui.checkbox(&mut replay.with_ambient, "ambient estimate")
                .on_hover_text("Adds the unshot light, spread evenly over all surfaces");
        });
        ui.spacing_mut().slider_width = ui.available_width() - 60.0;
        ui.add(Slider::new(&mut replay.moment, 0..=last).show_value(false).text("time"));
    });
    let moment = &recording.moments[replay.moment];
    row(ui, "Shots", grouped(moment.num_shots));
    row(ui, "Passes", format!("{:.2}", moment.num_shots as f32 / recording.num_patches.max(1) as f32));
    row(ui, "Unshot light", format!("{:.1} %", 100.0 * moment.unshot_share));
    row(ui, "Shooter", moment.shooter.map_or("none yet".to_owned(), |patch| format!("patch {}", patch.index())));
}

fn record_ui(ui: &mut Ui, facts: &Facts<'_>, actions: &mut Vec<Action>) {
    match facts.bake.light {
        LightState::Baked { .. } if facts.bake.is_recording => {
            hint(ui, "Shooting once more, patch by patch ...");
            if wide_button(ui, "Stop recording", true, "Discards the recording") {
                actions.push(Action::ToggleRecording);
            }
        }
        LightState::Baked { .. } => {
            hint(ui, "Shoots once more, a patch at a time, and keeps the light of each step.");
            if wide_button(ui, "Record the bake", true, "Then you can step through it, forwards and back") {
                actions.push(Action::ToggleRecording);
            }
        }
        LightState::Stored => hint(ui, "The light came with the file: there is no bake to record."),
        _ => hint(ui, "Waits for the end of a bake."),
    }
}
