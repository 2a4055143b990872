//! Section "Bake": preset, description of the settings, start, progress, cancel, certificate of the last bake.

use egui::{ProgressBar, RichText, Sense, Stroke, Ui, pos2, vec2};

use super::super::chrome::theme;
use super::super::chrome::widgets::{capitalised, clock, grouped, hint, metres, row, wide_button};
use super::super::facts::Facts;
use super::certificate::certificate_ui;
use crate::bake::{BakeSettings, Quality};
use crate::base::progress::Stage;
use crate::patch::MeshSettings;
use crate::viewer::action::Action;
use crate::viewer::session::light_state::LightState;

/// Height of the curve of unshot light, points.
const CURVE_HEIGHT: f32 = 56.0;
/// Smallest unshot share that the curve shows.
const CURVE_FLOOR: f32 = 1e-4;

/// Lays out the section. `is_dimmed` is true if the picture shows a light group at another intensity than the bake.
pub fn bake_ui(ui: &mut Ui, quality: &mut Quality, is_dimmed: bool, facts: &Facts<'_>, actions: &mut Vec<Action>) {
    match &facts.bake.light {
        &LightState::Working { stage, done, elapsed, is_cancelled } => {
            working_ui(ui, stage, done, is_cancelled, actions);
            row(ui, "Time", clock(elapsed));
        }
        LightState::Stored => hint(ui, "The file is a bake: its light is shown as it is stored."),
        state => {
            start_ui(ui, quality, facts, actions);
            if *state == LightState::Dark {
                ui.label(RichText::new("No light yet: shown in an even work light.").color(theme::WARNING));
            }
        }
    }
    if let LightState::Baked { elapsed } = facts.bake.light {
        row(ui, "Took", clock(elapsed));
    }
    if let Some([_, unshot]) = facts.bake.curve.last() {
        row(ui, "Unshot light", format!("{:.2} %", 100.0 * unshot));
        curve_ui(ui, facts.bake.curve);
    }
    if let Some(num_elements) = facts.scene.num_elements {
        row(ui, "Elements", grouped(num_elements));
    }
    if let Some(report) = facts.bake.report {
        certificate_ui(ui, report);
    }
    if wide_button(
        ui,
        "Save the bake",
        facts.bake.is_solved,
        "Writes the light as a standard .glb that opens without a bake",
    ) {
        actions.push(Action::SaveBake);
    }
    if is_dimmed && facts.bake.is_solved {
        hint(ui, "Saves every light group as it was baked, whatever the dials say.");
    }
}

fn working_ui(ui: &mut Ui, stage: Stage, done: f32, is_cancelled: bool, actions: &mut Vec<Action>) {
    let label = RichText::new(format!("{}   {:.0} %", stage.label(), 100.0 * done)).color(egui::Color32::WHITE);
    ui.add(ProgressBar::new(done).text(label).desired_height(20.0));
    let can_cancel = !is_cancelled && stage != Stage::Load;
    let text = if is_cancelled { "Ending ..." } else { "Cancel" };
    if wide_button(ui, text, can_cancel, "Ends the bake and keeps the light solved so far (B)") {
        actions.push(Action::CancelBake);
    }
}

fn start_ui(ui: &mut Ui, quality: &mut Quality, facts: &Facts<'_>, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.label("Quality");
        for preset in Quality::ALL {
            ui.selectable_value(quality, preset, capitalised(preset.name())).on_hover_text(preset.hint());
        }
    });
    if let Some((settings, sizes)) = &facts.bake.next {
        hint(ui, describe(settings, sizes));
    }
    if wide_button(ui, "Bake", facts.scene.open.is_some(), "Solves the light again (B)") {
        actions.push(Action::Bake);
    }
}

/// Describes the settings of a bake of the open scene.
fn describe(settings: &BakeSettings, sizes: &MeshSettings) -> String {
    format!(
        "Elements of at most {}, patches of about {}. Shoots until {:.2} % of the reflected light is left, then gathers with \
         {} rays or hemicubes of {} pixels; penumbrae take {} rays.",
        metres(sizes.element_size),
        metres(sizes.patch_size),
        100.0 * settings.threshold,
        grouped(settings.hemisphere_rays as usize),
        settings.hemicube_px,
        settings.sampling.num_penumbra_rays,
    )
}

/// Draws the unshot share over time, on a logarithmic scale.
fn curve_ui(ui: &mut Ui, curve: &[[f32; 2]]) {
    let (response, painter) = ui.allocate_painter(vec2(ui.available_width(), CURVE_HEIGHT), Sense::hover());
    let frame = response.rect.shrink(2.0);
    painter.rect_filled(response.rect, 3.0, ui.visuals().extreme_bg_color);
    let begin = curve.first().map_or(0.0, |point| point[0]);
    let end = curve.last().map_or(1.0, |point| point[0]);
    let height = |unshot: f32| unshot.max(CURVE_FLOOR).log10() / CURVE_FLOOR.log10();
    let line: Vec<egui::Pos2> = curve
        .iter()
        .map(|&[seconds, unshot]| {
            let along = (seconds - begin) / (end - begin).max(1e-6);
            pos2(frame.left() + along * frame.width(), frame.top() + height(unshot).min(1.0) * frame.height())
        })
        .collect();
    for decade in [0.1, 0.01, 0.001] {
        let y = frame.top() + height(decade) * frame.height();
        painter.hline(frame.x_range(), y, Stroke::new(1.0, egui::Color32::from_gray(45)));
    }
    painter.line(line, Stroke::new(1.5, theme::ACCENT));
    response.on_hover_text("Unshot share of the light over time; lines at 10 %, 1 % and 0.1 %");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_description_contains_the_numbers() {
        let sizes = MeshSettings { element_size: 0.12, patch_size: 1.4 };
        let text = describe(&BakeSettings::preset(Quality::Medium), &sizes);
        for part in ["12 cm", "1.4 m", "0.10 %", "64 pixels"] {
            assert!(text.contains(part), "{part} in {text}");
        }
    }
}
