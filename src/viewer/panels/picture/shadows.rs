//! Real-time shadows: the technique, its settings and its classic faults, comparison with another technique, debug views.

use egui::{ComboBox, DragValue, RichText, Role, Slider, Ui};

use super::super::chrome::theme;
use super::super::chrome::widgets::{named, row};
use super::super::facts::Facts;
use crate::render::shadow::{DebugView, MapSettings, PlanarSettings, VolumeSettings};
use crate::render::{ShadowSettings, ShadowTechnique};
use crate::viewer::action::Action;
use crate::viewer::settings::comparison::ComparisonLayout;
use crate::viewer::settings::light::LightSettings;
use crate::viewer::settings::tool::Tool;

/// Techniques with their names and meanings.
const TECHNIQUES: [(ShadowTechnique, &str, &str); 6] = [
    (ShadowTechnique::None, "None", "Light passes through everything"),
    (ShadowTechnique::Map, "Map", "Depth seen from the light"),
    (ShadowTechnique::VolumeDepthPass, "Volumes, depth-pass", "Stencil volumes counted in front of what is seen"),
    (ShadowTechnique::VolumeDepthFail, "Volumes, depth-fail", "Stencil volumes counted behind what is seen"),
    (ShadowTechnique::Planar, "Planar", "Casters flattened on to the largest planes"),
    (ShadowTechnique::Raytraced, "Ray-traced", "One ray a pixel on the processor: the truth, and slow"),
];
/// Widths of a shadow map to choose from, texels.
const RESOLUTIONS: [u32; 5] = [256, 512, 1024, 2048, 4096];
/// Width of a combo box, points.
const COMBO_WIDTH: f32 = 170.0;
/// First distance of the far plane, metres.
const FAR_PLANE: f32 = 10.0;

/// Debug views with their names and meanings.
const VIEWS: [(DebugView, &str, &str); 5] = [
    (DebugView::StencilCounts, "Stencil counts", "In how many volumes each point is"),
    (DebugView::Volumes, "Volumes", "Sides of the shadow volumes"),
    (DebugView::Silhouettes, "Silhouettes", "Edges at which the light sees casters end"),
    (DebugView::Map, "Shadow map", "What the light sees: near is bright"),
    (DebugView::Receivers, "Planes", "Planes that receive planar shadows"),
];
/// Largest radius of a lamp, metres.
const MAX_RADIUS: f32 = 0.5;

/// The name of a technique.
pub fn name_of(technique: ShadowTechnique) -> &'static str {
    TECHNIQUES.iter().find(|(known, ..)| *known == technique).map_or("", |(_, name, _)| name)
}

pub fn shadows_ui(ui: &mut Ui, light: &mut LightSettings, in_hand: Tool, facts: &Facts<'_>, actions: &mut Vec<Action>) {
    ui.checkbox(&mut light.is_real_time, "direct light with live shadows")
        .on_hover_text("Direct light comes from the lamps in real time instead of from the bake");
    ui.add_enabled_ui(light.is_real_time, |ui| {
        settings_ui(ui, &mut light.shadows, in_hand, actions);
        if let Some(fault) = facts.shadows.fault {
            ui.add(egui::Label::new(RichText::new(fault).color(theme::WARNING)).wrap());
        }
        ui.add_space(4.0);
        rival_ui(ui, light);
        debug_ui(ui, light, facts);
        times_ui(ui, facts);
    });
}

fn settings_ui(ui: &mut Ui, shadows: &mut ShadowSettings, in_hand: Tool, actions: &mut Vec<Action>) {
    ComboBox::from_label("Technique").selected_text(name_of(shadows.technique)).width(COMBO_WIDTH).show_ui(ui, |ui| {
        for (technique, name, hint) in TECHNIQUES {
            ui.selectable_value(&mut shadows.technique, technique, name).on_hover_text(hint);
        }
    });
    ui.add(Slider::new(&mut shadows.light_samples, 1..=256).logarithmic(true).text("points a lamp"))
        .on_hover_text("Many points on each lamp make soft shadows; while the camera rests, 256 are accumulated");
    ui.add(
        Slider::new(&mut shadows.light_radius, 0.0..=MAX_RADIUS).fixed_decimals(2).suffix(" m").text("radius of lamps"),
    )
    .on_hover_text("Radius of point and spot lights: their shadows become soft");
    match shadows.technique {
        ShadowTechnique::Map => map_ui(ui, &mut shadows.maps),
        ShadowTechnique::VolumeDepthPass => depth_pass_ui(ui, &mut shadows.volumes),
        ShadowTechnique::VolumeDepthFail => depth_fail_ui(ui, &mut shadows.volumes),
        ShadowTechnique::Planar => planar_ui(ui, &mut shadows.planar, in_hand, actions),
        ShadowTechnique::None | ShadowTechnique::Raytraced => {}
    }
}

/// The technique to compare with.
fn rival_ui(ui: &mut Ui, light: &mut LightSettings) {
    let name = light.compared_technique.map_or("Nothing", name_of);
    ComboBox::from_label("Compare with").selected_text(name).width(COMBO_WIDTH).show_ui(ui, |ui| {
        ui.selectable_value(&mut light.compared_technique, None, "Nothing");
        for (technique, name, _) in TECHNIQUES {
            ui.selectable_value(&mut light.compared_technique, Some(technique), name)
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

/// The debug view.
fn debug_ui(ui: &mut Ui, light: &mut LightSettings, facts: &Facts<'_>) {
    let name = VIEWS.iter().find(|(view, ..)| Some(*view) == light.debug).map_or("Nothing", |(_, name, _)| name);
    ComboBox::from_label("Look into").selected_text(name).width(COMBO_WIDTH).show_ui(ui, |ui| {
        ui.selectable_value(&mut light.debug, None, "Nothing");
        for (view, name, hint) in VIEWS {
            ui.selectable_value(&mut light.debug, Some(view), name).on_hover_text(hint);
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

/// Milliseconds of each pass of the last picture.
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
