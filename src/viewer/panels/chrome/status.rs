//! The status line: position, speed, work in the background, frame rate.

use egui::{Align, Layout, RichText, Ui};

use super::super::facts::Facts;
use super::theme;
use crate::viewer::session::light_state::LightState;

pub fn status_ui(ui: &mut Ui, facts: &Facts<'_>) {
    ui.horizontal(|ui| {
        let position = facts.camera.position();
        let way = if facts.camera.is_walking { "walking" } else { "flying" };
        ui.label(format!("{way}  {:.1} m/s", facts.camera.speed));
        ui.separator();
        ui.monospace(format!("{:7.2} {:7.2} {:7.2} m", position.x, position.y, position.z));
        if facts.camera.is_captured {
            ui.separator();
            ui.label(RichText::new("Esc releases the mouse").color(theme::ACCENT));
        }
        if let LightState::Working { stage, done, .. } = facts.bake.light {
            ui.separator();
            ui.label(RichText::new(format!("{} {:.0} %", stage.label(), 100.0 * done)).color(theme::ACCENT));
        }
        if let Some(num_rays) = facts.picture.num_rays {
            ui.separator();
            ui.label(RichText::new(format!("traced, {num_rays} rays a pixel")).color(theme::ACCENT));
        }
        if let Some([done, all]) = facts.shadows.num_points {
            ui.separator();
            ui.label(RichText::new(format!("{done} of {all} points a lamp")).color(theme::ACCENT));
        }
        if facts.measurement.is_busy {
            ui.separator();
            ui.label(RichText::new("measuring ...").color(theme::ACCENT));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.monospace(format!("{:3.0} fps  {:5.1} ms", facts.picture.frame_rate, 1e3 * facts.picture.frame_seconds));
        });
    });
}
