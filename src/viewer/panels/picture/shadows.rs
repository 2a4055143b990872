//! The section of real-time shadows: choice of the technique, its settings, its classic faults, comparison with another
//! technique, debug views, durations of passes.

use egui::{ComboBox, DragValue, RichText, Role, Slider, Ui};

use super::super::chrome::theme;
use super::super::chrome::widgets::{named, row};
use super::super::facts::Facts;
use super::technique::technique_ui;
use crate::render::shadow::DebugView;
use crate::render::{ShadowSettings, ShadowTechnique};
use crate::viewer::action::Action;
use crate::viewer::settings::comparison::ComparisonLayout;
use crate::viewer::settings::light::LightSettings;
use crate::viewer::settings::tool::Tool;

/// Width of a combo box, points.
const COMBO_WIDTH: f32 = 170.0;
/// Largest radius of a lamp, metres.
const MAX_RADIUS: f32 = 0.5;

pub fn shadows_ui(ui: &mut Ui, light: &mut LightSettings, in_hand: Tool, facts: &Facts<'_>, actions: &mut Vec<Action>) {
    ui.checkbox(&mut light.is_real_time, "direct light with live shadows")
        .on_hover_text("Direct light comes from the lamps in real time instead of from the bake");
    ui.add_enabled_ui(light.is_real_time, |ui| {
        settings_ui(ui, &mut light.shadows, in_hand, actions);
        if let Some(fault) = facts.shadows.fault {
            ui.add(egui::Label::new(RichText::new(fault).color(theme::WARNING)).wrap());
        }
        ui.add_space(4.0);
        compared_ui(ui, light);
        debug_ui(ui, light, facts);
        times_ui(ui, facts);
    });
}

fn settings_ui(ui: &mut Ui, shadows: &mut ShadowSettings, in_hand: Tool, actions: &mut Vec<Action>) {
    ComboBox::from_label("Technique").selected_text(shadows.technique.info().title).width(COMBO_WIDTH).show_ui(
        ui,
        |ui| {
            for info in ShadowTechnique::ALL {
                ui.selectable_value(&mut shadows.technique, info.technique, info.title).on_hover_text(info.hint);
            }
        },
    );
    ui.add(Slider::new(&mut shadows.light_samples, 1..=256).logarithmic(true).text("points a lamp"))
        .on_hover_text("Many points on each lamp make soft shadows; while the camera rests, 256 are accumulated");
    ui.add(
        Slider::new(&mut shadows.light_radius, 0.0..=MAX_RADIUS).fixed_decimals(2).suffix(" m").text("radius of lamps"),
    )
    .on_hover_text("Radius of point and spot lights: their shadows become soft");
    technique_ui(ui, shadows, in_hand, actions);
}

/// Lays out the choice of the technique to compare with.
fn compared_ui(ui: &mut Ui, light: &mut LightSettings) {
    let name = light.compared_technique.map_or("Nothing", |technique| technique.info().title);
    ComboBox::from_label("Compare with").selected_text(name).width(COMBO_WIDTH).show_ui(ui, |ui| {
        ui.selectable_value(&mut light.compared_technique, None, "Nothing");
        for info in ShadowTechnique::ALL {
            ui.selectable_value(&mut light.compared_technique, Some(info.technique), info.title)
                .on_hover_text("With its default settings");
        }
    });
    if light.compared_technique.is_some() {
        ui.horizontal(|ui| {
            ui.selectable_value(&mut light.comparison_layout, ComparisonLayout::Split, "Split screen")
                .on_hover_text("Both techniques, left and right of a line that can be dragged");
            ui.selectable_value(&mut light.comparison_layout, ComparisonLayout::Difference, "Difference")
                .on_hover_text("Pixels that only one technique lights, away from shadow edges");
        });
    }
}

/// Lays out the choice of the debug view.
fn debug_ui(ui: &mut Ui, light: &mut LightSettings, facts: &Facts<'_>) {
    let name = light.debug.map_or("Nothing", |view| view.info().title);
    ComboBox::from_label("Look into").selected_text(name).width(COMBO_WIDTH).show_ui(ui, |ui| {
        ui.selectable_value(&mut light.debug, None, "Nothing");
        for info in DebugView::ALL {
            ui.selectable_value(&mut light.debug, Some(info.view), info.title).on_hover_text(info.hint);
        }
    });
    if !matches!(light.debug, None | Some(DebugView::Receivers)) {
        ui.horizontal(|ui| {
            ui.label("of light");
            let last = facts.shadows.num_light_samples.saturating_sub(1);
            let mut number = light.debug_light.min(last) + 1;
            let dial = ui.add(DragValue::new(&mut number).range(1..=last + 1).speed(0.1));
            named(&dial, Role::SpinButton, "Light that is shown");
            if dial.changed() {
                light.debug_light = number - 1;
            }
            ui.label(format!("of {}", last + 1));
        });
    }
}

/// Lays out the duration of each pass of the last picture, milliseconds.
fn times_ui(ui: &mut Ui, facts: &Facts<'_>) {
    if facts.shadows.laps.is_empty() {
        return;
    }
    ui.add_space(4.0);
    let clock = if facts.shadows.has_device_clock { "by the device's clock" } else { "the device has no clock" };
    row(ui, "Passes of the last picture", RichText::new(clock).weak());
    for &(name, milliseconds) in facts.shadows.laps {
        row(ui, name, format!("{milliseconds:.1} ms"));
    }
}
