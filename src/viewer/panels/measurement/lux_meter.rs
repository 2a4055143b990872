//! Lux meter: the last reading, pinned readings, a grid with its statistics, and the table to write.

use egui::{CollapsingHeader, Color32, DragValue, Grid, RichText, Role, Ui};
use glam::Vec3;

use super::super::chrome::theme;
use super::super::chrome::widgets::{hint, lux, named, row, wide_button};
use super::super::facts::Facts;
use crate::base::colour::luminance;
use crate::viewer::action::Action;
use crate::viewer::settings::light::GroupDial;
use crate::viewer::settings::tool::GridSettings;
use crate::viewer::settings::tool::Tool;
use crate::viewer::solution::meter::{Grid as MeasuredGrid, Reading};

pub fn lux_meter_ui(
    ui: &mut Ui,
    grid: &mut GridSettings,
    dials: &[GroupDial],
    tool: Tool,
    facts: &Facts<'_>,
    actions: &mut Vec<Action>,
) {
    if !facts.bake.is_solved {
        hint(ui, "Waits for the light: measuring needs a finished bake.");
    } else {
        tool_ui(ui, tool, actions);
    }
    if let Some(reading) = facts.measurement.last {
        reading_ui(ui, reading, dials);
        if wide_button(ui, "Keep this reading", true, "Pins it to its position (Enter)") {
            actions.push(Action::PinReading);
        }
    }
    pins_ui(ui, facts.measurement.pins);
    plan_ui(ui, grid);
    if let Some(grid) = facts.measurement.grid {
        grid_ui(ui, grid);
    }
    if !facts.measurement.pins.is_empty() || facts.measurement.grid.is_some() || facts.measurement.last.is_some() {
        ui.horizontal(|ui| {
            let hint = "Writes hemicube-lux-NNN.csv with the columns of hemicube measure";
            if ui.button("Write a table").on_hover_text(hint).clicked() {
                actions.push(Action::WriteReadings);
            }
            if ui.button("Clear").on_hover_text("Discards all readings and the grid").clicked() {
                actions.push(Action::ClearReadings);
            }
        });
    }
}

fn tool_ui(ui: &mut Ui, tool: Tool, actions: &mut Vec<Action>) {
    match tool {
        Tool::Meter => hint(ui, "Click a surface to measure it."),
        Tool::Grid => hint(ui, "Click a flat surface to measure a grid over it."),
        _ => {
            ui.horizontal(|ui| {
                if ui.button("Measure a point").on_hover_text("Then click a surface (M)").clicked() {
                    actions.push(Action::SelectTool(Tool::Meter));
                }
                if ui.button("Measure a surface").on_hover_text("Then click a flat surface (G)").clicked() {
                    actions.push(Action::SelectTool(Tool::Grid));
                }
            });
        }
    }
}

fn reading_ui(ui: &mut Ui, reading: &Reading, dials: &[GroupDial]) {
    let is_dimmed = dials.iter().any(|dial| !dial.is_as_baked());
    ui.horizontal(|ui| {
        ui.label(RichText::new(format!("{} lx", lux(reading.lux()))).heading().color(theme::ACCENT));
        if is_dimmed {
            ui.label(RichText::new("as baked").weak());
        }
    });
    if is_dimmed {
        row(ui, "As the dials are", format!("{} lx", lux(reading.dimmed_lux(dials))));
    }
    let direct = reading.direct_share();
    row(ui, "Direct", share(luminance(reading.measured.direct), direct));
    row(ui, "Indirect", share(luminance(reading.measured.total - reading.measured.direct), 1.0 - direct));
    for (group, part) in reading.groups.iter().zip(reading.group_shares()) {
        row(ui, &format!("from {}", group.name), format!("{:.0} %", 100.0 * part));
    }
    if let Some(surface) = &reading.surface {
        let radiosity = reading.radiosity().unwrap_or(Vec3::ZERO);
        row(ui, "Reflectance", format!("{:.2}", luminance(surface.reflectance)));
        row(ui, "Radiosity", format!("{} lm/m²", lux(luminance(radiosity))));
        row(ui, "Object", surface.instance.as_str());
        row(ui, "Material", surface.material.as_str());
        row(ui, "Patch, element", format!("{}, {}", surface.patch, surface.element));
    }
}

fn share(value: f32, share: f32) -> String {
    format!("{} lx   {:.0} %", lux(value.max(0.0)), 100.0 * share)
}

fn pins_ui(ui: &mut Ui, pins: &[Reading]) {
    if pins.is_empty() {
        return;
    }
    CollapsingHeader::new(format!("Kept readings: {}", pins.len())).default_open(true).show(ui, |ui| {
        Grid::new("pins").num_columns(3).striped(true).show(ui, |ui| {
            for (number, pin) in pins.iter().enumerate() {
                ui.label(RichText::new(format!("{}", number + 1)).weak());
                ui.label(RichText::new(format!("{} lx", lux(pin.lux()))).color(Color32::WHITE));
                let name = pin.surface.as_ref().map_or("", |surface| surface.instance.as_str());
                ui.add(egui::Label::new(name).truncate());
                ui.end_row();
            }
        });
    });
}

fn plan_ui(ui: &mut Ui, grid: &mut GridSettings) {
    ui.horizontal(|ui| {
        ui.label("Grid every");
        let spacing = ui.add(DragValue::new(&mut grid.spacing).range(0.01..=20.0).speed(0.01).suffix(" m"));
        named(&spacing, Role::SpinButton, "Grid spacing");
        ui.label("at");
        let height = ui.add(DragValue::new(&mut grid.height).range(0.0..=5.0).speed(0.01).suffix(" m"));
        named(&height, Role::SpinButton, "Grid height");
        height.on_hover_text("Height above the surface; a desk is 0.75 to 0.85 m high");
    });
}

fn grid_ui(ui: &mut Ui, grid: &MeasuredGrid) {
    row(ui, "Points", format!("{}, every {:.2} m", grid.measured.len(), grid.plan.spacing));
    row(ui, "Minimum", format!("{} lx", lux(grid.min())));
    row(ui, "Mean", format!("{} lx", lux(grid.mean())));
    row(ui, "Maximum", format!("{} lx", lux(grid.max())));
    row(ui, "Uniformity", format!("{:.2}", grid.uniformity()));
}
