//! Settings of each shadow technique.

use egui::{ComboBox, Slider, Ui};

use crate::render::shadow::{MapSettings, PlanarSettings, VolumeSettings};
use crate::render::{ShadowSettings, ShadowTechnique};
use crate::viewer::action::Action;
use crate::viewer::settings::tool::Tool;

/// Widths of a shadow map to choose from, texels.
const RESOLUTIONS: [u32; 5] = [256, 512, 1024, 2048, 4096];
/// Initial distance of the far plane, metres.
const FAR_PLANE: f32 = 10.0;

/// Lays out the settings of the chosen technique.
pub fn technique_ui(ui: &mut Ui, shadows: &mut ShadowSettings, in_hand: Tool, actions: &mut Vec<Action>) {
    match shadows.technique {
        ShadowTechnique::Map => map_ui(ui, &mut shadows.maps),
        ShadowTechnique::VolumeDepthPass => depth_pass_ui(ui, &mut shadows.volumes),
        ShadowTechnique::VolumeDepthFail => depth_fail_ui(ui, &mut shadows.volumes),
        ShadowTechnique::Planar => planar_ui(ui, &mut shadows.planar, in_hand, actions),
        ShadowTechnique::None | ShadowTechnique::Raytraced => {}
    }
}

fn map_ui(ui: &mut Ui, maps: &mut MapSettings) {
    ComboBox::from_label("Texels across").selected_text(maps.resolution.to_string()).show_ui(ui, |ui| {
        for resolution in RESOLUTIONS {
            ui.selectable_value(&mut maps.resolution, resolution, resolution.to_string());
        }
    });
    ui.add(Slider::new(&mut maps.pcf_radius, 0..=4).text("softening, texels"));
    ui.add(Slider::new(&mut maps.slope_bias, 0.0..=8.0).text("bias, texels"))
        .on_hover_text("Too little: shadow acne. Too much: shadows detach from their casters");
    ui.add(Slider::new(&mut maps.normal_offset, 0.0..=8.0).text("normal offset, texels"))
        .on_hover_text("Also removes acne. Too much: light leaks through thin walls");
}

fn depth_pass_ui(ui: &mut Ui, volumes: &mut VolumeSettings) {
    ui.checkbox(&mut volumes.near_plane_cure, "cure at the near plane")
        .on_hover_text("Off: wrong where the near plane lies in a shadow, as in the original technique");
}

fn depth_fail_ui(ui: &mut Ui, volumes: &mut VolumeSettings) {
    let mut is_infinite = volumes.far_plane.is_none();
    if ui
        .checkbox(&mut is_infinite, "infinite projection")
        .on_hover_text("Off: a far plane clips the volumes")
        .changed()
    {
        volumes.far_plane = (!is_infinite).then_some(FAR_PLANE);
    }
    if let Some(distance) = &mut volumes.far_plane {
        ui.add(Slider::new(distance, 1.0..=100.0).logarithmic(true).text("far plane").suffix(" m"));
    }
    ui.checkbox(&mut volumes.joined, "volumes joined at edges")
        .on_hover_text("Off: each triangle has a volume of its own, which is slow");
}

fn planar_ui(ui: &mut Ui, planar: &mut PlanarSettings, in_hand: Tool, actions: &mut Vec<Action>) {
    if planar.receivers.is_empty() {
        ui.add(Slider::new(&mut planar.num_receivers, 1..=31).text("planes"))
            .on_hover_text("How many planes receive shadows: the largest");
    }
    for (tool, name, count, hint) in [
        (Tool::Receiver, "Choose planes", planar.receivers.len(), "Click the planes that receive shadows"),
        (Tool::Caster, "Choose casters", planar.casters.len(), "Click the objects that cast shadows"),
    ] {
        ui.horizontal(|ui| {
            if ui.selectable_label(in_hand == tool, name).on_hover_text(hint).clicked() {
                actions.push(Action::SelectTool(if in_hand == tool { Tool::Look } else { tool }));
            }
            ui.weak(if count == 0 { "automatic".to_owned() } else { format!("{count} chosen") });
        });
    }
    let is_chosen = !planar.receivers.is_empty() || !planar.casters.is_empty();
    if is_chosen && ui.button("Choose none").on_hover_text("Back to the largest planes and all objects").clicked() {
        planar.receivers.clear();
        planar.casters.clear();
    }
    ui.checkbox(&mut planar.stays_on_receiver, "shadows stay on their plane")
        .on_hover_text("Off: shadows extend beyond their plane");
    ui.checkbox(&mut planar.is_free_of_depth, "no fight for depth")
        .on_hover_text("Off: shadow and plane fight for the same depth and flicker");
    ui.checkbox(&mut planar.darkens_once, "darken once").on_hover_text("Off: overlapping shadows darken twice");
    ui.checkbox(&mut planar.clips_casters, "cut casters at the plane")
        .on_hover_text("Off: objects below the plane cast shadows upwards");
}
