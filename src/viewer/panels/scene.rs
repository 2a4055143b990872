//! Scene: what is in the file, and what the loader noticed.

use egui::{RichText, Ui};

use super::{Facts, grouped, row, theme};

pub fn scene_ui(ui: &mut Ui, facts: &Facts<'_>) {
    let Some(scene) = facts.scene else {
        ui.label(RichText::new("Nothing is open.").weak());
        return;
    };
    let (low, high) = scene.bounds();
    let size = high - low;
    let num_lamps = scene.materials.iter().filter(|material| material.emission.max_element() > 0.0).count();
    row(ui, "Size", format!("{:.1} x {:.1} x {:.1} m", size.x, size.y, size.z));
    row(ui, "Triangles", grouped(scene.triangles.len()));
    row(ui, "Instances", grouped(scene.instances.len()));
    row(ui, "Materials", grouped(scene.materials.len()));
    row(ui, "Textures", grouped(scene.textures.len()));
    row(ui, "Glowing materials", grouped(num_lamps));
    row(ui, "Punctual lights", grouped(scene.lights.len()));
    row(ui, "Light groups", grouped(scene.light_groups.len()));
    row(ui, "Cameras", grouped(scene.cameras.len()));
    row(ui, "Device", facts.adapter);
    if !scene.notes.is_empty() {
        ui.add_space(4.0);
        ui.label(RichText::new("The loader says").color(theme::WARNING));
        for note in &scene.notes {
            ui.label(note);
        }
    }
}
