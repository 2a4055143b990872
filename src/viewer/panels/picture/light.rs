//! Light: exposure, tone map, direct and indirect light, and a dial for each light group.

use egui::{Align, Atom, AtomExt as _, Checkbox, Layout, Role, Slider, Ui};

use super::super::chrome::widgets::named;
use crate::render::ToneMap;
use crate::viewer::action::Action;
use crate::viewer::settings::light::{GroupDial, LightSettings};

/// Width of the number beside a slider, points.
const NUMBER_WIDTH: f32 = 62.0;
/// Width of a light group's checkbox and name, points.
const NAME_WIDTH: f32 = 92.0;

pub fn light_ui(ui: &mut Ui, light: &mut LightSettings, actions: &mut Vec<Action>) {
    exposure_ui(ui, light, actions);
    ui.horizontal(|ui| {
        ui.label("Tone map").on_hover_text("T switches");
        ui.selectable_value(&mut light.tone_map, ToneMap::Neutral, "Neutral")
            .on_hover_text("Colours stay as they are, highlights roll off");
        ui.selectable_value(&mut light.tone_map, ToneMap::Linear, "Linear").on_hover_text("Clipped at white");
    });
    ui.horizontal(|ui| {
        ui.label("Show");
        ui.checkbox(&mut light.direct, "direct").on_hover_text("Light that arrives straight from the lamps (J)");
        ui.checkbox(&mut light.indirect, "indirect").on_hover_text("Light after at least one reflection (K)");
    });
    groups_ui(ui, &mut light.groups);
}

fn exposure_ui(ui: &mut Ui, light: &mut LightSettings, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let label = ui.label("Exposure").on_hover_text("- and + change it");
        let mut is_auto = light.is_auto;
        if ui.checkbox(&mut is_auto, "auto").on_hover_text("Metered from the picture (X)").clicked() {
            actions.push(Action::ToggleAutoExposure);
        }
        ui.add_enabled_ui(!light.is_auto, |ui| {
            ui.spacing_mut().slider_width = ui.available_width() - NUMBER_WIDTH;
            ui.add(Slider::new(&mut light.ev, -16.0..=8.0).fixed_decimals(1).suffix(" EV")).labelled_by(label.id);
        });
    });
}

fn groups_ui(ui: &mut Ui, groups: &mut [GroupDial]) {
    if groups.is_empty() {
        return;
    }
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        ui.label("Light groups");
        let is_changed = groups.iter().any(|group| !group.is_as_baked());
        if is_changed
            && ui
                .small_button("as baked")
                .on_hover_text("Sets all light groups back to the light of the bake")
                .clicked()
        {
            groups.iter_mut().for_each(|group| *group = GroupDial::of(&group.name));
        }
    });
    for group in groups {
        ui.horizontal(|ui| group_ui(ui, group));
    }
}

fn group_ui(ui: &mut Ui, group: &mut GroupDial) {
    let height = ui.spacing().interact_size.y;
    let name = Layout::left_to_right(Align::Center);
    ui.allocate_ui_with_layout(egui::vec2(NAME_WIDTH, height), name, |ui| {
        ui.set_width(NAME_WIDTH);
        let name = Atom::from(group.name.as_str()).atom_shrink(true);
        let hint = format!("Switches {} on or off without a new bake", group.name);
        ui.add(Checkbox::new(&mut group.is_on, name)).on_hover_text(hint);
    });
    ui.add_enabled_ui(group.is_on, |ui| {
        let mut tint = group.tint.to_array();
        let colour = ui.color_edit_button_rgb(&mut tint).on_hover_text("Colour of this light");
        named(&colour, Role::ColorWell, format!("Colour of {}", group.name));
        if colour.changed() {
            group.tint = tint.into();
        }
        ui.spacing_mut().slider_width = ui.available_width() - NUMBER_WIDTH;
        let slider = ui.add(Slider::new(&mut group.intensity, 0.0..=4.0).fixed_decimals(2).suffix(" x"));
        named(&slider, Role::Slider, format!("Intensity of {}", group.name));
    });
}
