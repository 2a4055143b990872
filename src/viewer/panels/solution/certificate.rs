//! Shows the certificate, the quality report of a bake: the balance of luminous flux, the errors of the form factors,
//! the work and times, the peak memory.

use egui::{CollapsingHeader, Ui};

use super::super::chrome::widgets::{grouped, hint, row};
use crate::bake::Report;

pub fn certificate_ui(ui: &mut Ui, report: &Report) {
    CollapsingHeader::new("Certificate").show(ui, |ui| {
        let flux = &report.energy;
        hint(ui, "Luminous flux, lumen");
        row(ui, "Arrived from lamps", lumen(flux.emitted));
        row(ui, "Absorbed", lumen(flux.absorbed));
        row(ui, "Unshot", lumen(flux.unshot));
        row(ui, "Left the scene", lumen(flux.escaped));
        row(ui, "Not accounted for", format!("{:.1e}", flux.imbalance));
        hint(ui, "Form factors");
        let closure = &report.certificate.closure;
        row(ui, "Row sums", format!("{:.3} to {:.3}", closure.min, closure.max));
        row(ui, "Not reciprocal", format!("{:.2} %", 100.0 * report.certificate.reciprocity_residual));
        row(ui, "Backs seen", format!("{:.2} %", 100.0 * report.certificate.backface_share));
        hint(ui, "Work");
        row(ui, "Patches", grouped(report.mesh.patches));
        row(ui, "Shots", grouped(report.work.shots));
        row(ui, "Viewpoints", grouped(report.work.hemicubes));
        let seconds = &report.seconds;
        row(ui, "Meshing", format!("{:.1} s", seconds.mesh));
        row(ui, "Direct light", format!("{:.1} s", seconds.direct));
        row(ui, "Shooting", format!("{:.1} s", seconds.solve));
        row(ui, "Gathering", format!("{:.1} s", seconds.gather));
        if let Some(bytes) = report.memory_bytes.peak {
            row(ui, "Most memory", format!("{} MiB", grouped((bytes >> 20) as usize)));
        }
    });
}

fn lumen(flux: f64) -> String {
    if flux >= 100.0 { grouped(flux.round() as usize) } else { format!("{flux:.2}") }
}
