//! Light: exposure, tone map, direct and indirect light, and a dial for each light group.

use egui::{Slider, Ui};

use super::super::settings::{GroupDial, LightSettings};
use crate::render::ToneMap;

/// Room that a slider leaves for its number, points.
const NUMBER_WIDTH: f32 = 62.0;

pub fn light_ui(ui: &mut Ui, light: &mut LightSettings) {
    exposure_ui(ui, light);
    ui.horizontal(|ui| {
        ui.label("Tone map").on_hover_text("T switches");
        ui.selectable_value(&mut light.tone_map, ToneMap::Neutral, "Neutral")
            .on_hover_text("True colours, highlights roll off");
        ui.selectable_value(&mut light.tone_map, ToneMap::Linear, "Linear").on_hover_text("Cut off at white");
    });
    ui.horizontal(|ui| {
        ui.label("Show");
        ui.checkbox(&mut light.direct, "direct").on_hover_text("Light straight from the lamps (1)");
        ui.checkbox(&mut light.indirect, "indirect").on_hover_text("Light after at least one reflection (2)");
    });
    groups_ui(ui, &mut light.groups);
}

fn exposure_ui(ui: &mut Ui, light: &mut LightSettings) {
    ui.horizontal(|ui| {
        ui.label("Exposure").on_hover_text("- and + change it");
        ui.checkbox(&mut light.is_auto, "auto").on_hover_text("Metered from the picture (X)");
    });
    ui.add_enabled_ui(!light.is_auto, |ui| {
        ui.spacing_mut().slider_width = ui.available_width() - NUMBER_WIDTH;
        ui.add(Slider::new(&mut light.ev, -16.0..=8.0).fixed_decimals(1).suffix(" EV"));
    });
}

fn groups_ui(ui: &mut Ui, groups: &mut [GroupDial]) {
    if groups.is_empty() {
        return;
    }
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        ui.label("Light groups");
        let is_changed = groups.iter().any(|group| !group.is_on || group.intensity != 1.0);
        if is_changed && ui.small_button("as baked").clicked() {
            for group in groups.iter_mut() {
                (group.is_on, group.intensity) = (true, 1.0);
            }
        }
    });
    for group in groups {
        ui.checkbox(&mut group.is_on, group.name.as_str()).on_hover_text("Switches these lights; no new bake");
        ui.add_enabled_ui(group.is_on, |ui| {
            ui.spacing_mut().slider_width = ui.available_width() - NUMBER_WIDTH;
            ui.add(Slider::new(&mut group.intensity, 0.0..=4.0).fixed_decimals(2).suffix(" x"));
        });
    }
}
