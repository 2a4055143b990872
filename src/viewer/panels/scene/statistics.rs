//! Statistics: sizes of the scene, the device and the frame rate.

use egui::Ui;

use super::super::chrome::widgets::{grouped, row};
use super::super::facts::Facts;

pub fn statistics_ui(ui: &mut Ui, facts: &Facts<'_>) {
    row(ui, "Frame", format!("{:.1} ms", 1e3 * facts.picture.frame_seconds));
    row(ui, "Frames a second", format!("{:.0}", facts.picture.frame_rate));
    row(ui, "Picture size", format!("{} x {}", facts.picture.size[0], facts.picture.size[1]));
    row(ui, "Device", facts.picture.adapter);
    if let Some(scene) = facts.scene.open {
        row(ui, "Triangles of the file", grouped(scene.triangles.len()));
        row(ui, "Textures", grouped(scene.textures.len()));
        row(ui, "Light groups", grouped(scene.light_groups.len()));
    }
    if let Some(num_elements) = facts.scene.num_elements {
        row(ui, "Elements drawn", grouped(num_elements));
    }
    if let Some(report) = facts.bake.report {
        row(ui, "Vertices with light", grouped(report.mesh.vertices));
    }
}
