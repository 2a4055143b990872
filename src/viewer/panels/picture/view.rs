//! View: shading, the scale of false colours, wires, ray tracing at rest, and movement.

use egui::{Checkbox, DragValue, Role, Ui};

use super::super::chrome::widgets::named;
use super::super::facts::Facts;
use crate::render::{LuxScale, Shading};
use crate::viewer::action::Action;
use crate::viewer::settings::light::{LightSettings, SHADINGS};
use crate::viewer::settings::view::Wire;

/// Largest illuminance of a scale, lux: about twice that of direct sunlight.
const MAX_LUX: f32 = 200_000.0;

pub fn view_ui(
    ui: &mut Ui,
    light: &mut LightSettings,
    wire: &mut Wire,
    traces_stills: &mut bool,
    facts: &Facts<'_>,
    actions: &mut Vec<Action>,
) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (shading, label, hint) in SHADINGS {
            ui.selectable_value(&mut light.shading, shading, label).on_hover_text(format!("{hint} (V)"));
        }
    });
    if light.shading == Shading::FalseColour {
        scale_ui(ui, &mut light.lux_scale, facts, actions);
    }
    ui.horizontal(|ui| {
        ui.label("Wire");
        for (kind, label, hint) in [
            (Wire::None, "None", "No lines"),
            (Wire::Elements, "Elements", "Edges of the elements, which receive light"),
            (Wire::Patches, "Patches", "Edges of the patches, which shoot light"),
        ] {
            ui.selectable_value(wire, kind, label).on_hover_text(hint);
        }
    });
    ui.checkbox(&mut light.see_through_backs, "look through backs of walls")
        .on_hover_text("Single-sided walls are invisible from behind");
    ui.add_enabled(facts.bake.is_solved, Checkbox::new(traces_stills, "trace rays while still")).on_hover_text(
        "While the camera rests, the picture is ray-traced: sharp shadows, mirrors and glass over the baked light (R)",
    );
    moving_ui(ui, facts, actions);
}

fn scale_ui(ui: &mut Ui, scale: &mut LuxScale, facts: &Facts<'_>, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.label("From");
        let low = ui.add(DragValue::new(&mut scale.low).range(0.0..=MAX_LUX).speed(1.0).suffix(" lx"));
        named(&low, Role::SpinButton, "Lowest lux");
        ui.label("to");
        let high = ui.add(DragValue::new(&mut scale.high).range(0.0..=MAX_LUX).speed(5.0).suffix(" lx"));
        named(&high, Role::SpinButton, "Highest lux");
        let fit = ui.add_enabled(facts.bake.is_solved, egui::Button::new("Fit"));
        if fit.on_hover_text("Fits the scale to the light of this scene").clicked() {
            actions.push(Action::FitLuxScale);
        }
    });
    ui.horizontal(|ui| {
        ui.checkbox(&mut scale.is_logarithmic, "logarithmic")
            .on_hover_text("Equal ratios of illuminance have equal distances");
        let parts = ui.add(DragValue::new(&mut scale.num_parts).range(0..=20).speed(0.1));
        named(&parts, Role::SpinButton, "Parts between iso-lux lines");
        ui.label("parts between lines")
            .on_hover_text("Lines of equal illuminance divide the scale into this many parts; 0 draws none");
    });
}

fn moving_ui(ui: &mut Ui, facts: &Facts<'_>, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        for (label, is_walking, hint) in
            [("Walk", true, "With gravity and walls (F)"), ("Fly", false, "Without gravity or walls (F)")]
        {
            let is_so = facts.camera.is_walking == is_walking;
            if ui.selectable_label(is_so, label).on_hover_text(hint).clicked() && !is_so {
                actions.push(Action::ToggleWalking);
            }
        }
        if ui.button("Frame all").on_hover_text("Moves back until the whole scene is in view (Home)").clicked() {
            actions.push(Action::FrameAll);
        }
        if let Some(eye) = facts.camera.pose {
            let mut degrees = eye.fov_y.to_degrees();
            let angle =
                ui.add(DragValue::new(&mut degrees).range(10.0..=120.0).speed(0.5).fixed_decimals(0).suffix("°"));
            named(&angle, Role::SpinButton, "Field of view");
            if angle.on_hover_text("Vertical field of view (Ctrl and wheel)").changed() {
                actions.push(Action::SetFieldOfView(degrees));
            }
        }
    });
}
