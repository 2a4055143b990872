//! Shadows: where direct light comes from, the technique, its settings, and the faults that its cures hide.

use egui::{ComboBox, Slider, Ui};

use super::super::settings::LightSettings;
use crate::render::shadow::{MapSettings, PlanarSettings, VolumeSettings};
use crate::render::{ShadowSettings, ShadowTechnique};

/// Techniques with their names and meanings.
const TECHNIQUES: [(ShadowTechnique, &str, &str); 6] = [
    (ShadowTechnique::None, "None", "Light passes through everything"),
    (ShadowTechnique::Map, "Map", "Depth seen from the light"),
    (ShadowTechnique::VolumeDepthPass, "Volumes, depth-pass", "Stencil volumes counted in front of what is seen"),
    (ShadowTechnique::VolumeDepthFail, "Volumes, depth-fail", "Stencil volumes counted behind what is seen"),
    (ShadowTechnique::Planar, "Planar", "Casters flattened on to the largest planes"),
    (ShadowTechnique::Raytraced, "Ray-traced", "One ray a pixel on the processor: the truth, and slow"),
];
/// Widths of a shadow map to choose from.
const RESOLUTIONS: [u32; 5] = [256, 512, 1024, 2048, 4096];
/// Distance at which a far plane is first put, metres.
const FAR_PLANE: f32 = 10.0;

pub fn shadows_ui(ui: &mut Ui, light: &mut LightSettings) {
    ui.checkbox(&mut light.is_real_time, "direct light with live shadows")
        .on_hover_text("Direct light comes from the lamps themselves instead of from the bake");
    ui.add_enabled_ui(light.is_real_time, |ui| settings_ui(ui, &mut light.shadows));
}

fn settings_ui(ui: &mut Ui, shadows: &mut ShadowSettings) {
    let name =
        TECHNIQUES.iter().find(|(technique, ..)| *technique == shadows.technique).map_or("", |(_, name, _)| name);
    ComboBox::from_label("Technique").selected_text(name).show_ui(ui, |ui| {
        for (technique, name, hint) in TECHNIQUES {
            ui.selectable_value(&mut shadows.technique, technique, name).on_hover_text(hint);
        }
    });
    ui.add(Slider::new(&mut shadows.light_samples, 1..=256).logarithmic(true).text("points a lamp"))
        .on_hover_text("Many points on each glowing surface make soft shadows");
    match shadows.technique {
        ShadowTechnique::Map => map_ui(ui, &mut shadows.maps),
        ShadowTechnique::VolumeDepthPass => depth_pass_ui(ui, &mut shadows.volumes),
        ShadowTechnique::VolumeDepthFail => depth_fail_ui(ui, &mut shadows.volumes),
        ShadowTechnique::Planar => planar_ui(ui, &mut shadows.planar),
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
        .on_hover_text("Too little: acne. Too much: shadows come off their casters");
    ui.add(Slider::new(&mut maps.normal_offset, 0.0..=8.0).text("normal offset, texels"))
        .on_hover_text("Too little: acne. Too much: light leaks through thin walls");
}

fn depth_pass_ui(ui: &mut Ui, volumes: &mut VolumeSettings) {
    ui.checkbox(&mut volumes.near_plane_cure, "cure at the near plane")
        .on_hover_text("Off: wrong wherever the near plane is in a shadow, as in the text book");
    if !volumes.near_plane_cure {
        ui.weak("Known to be wrong where the eye is in a shadow");
    }
}

fn depth_fail_ui(ui: &mut Ui, volumes: &mut VolumeSettings) {
    let mut is_infinite = volumes.far_plane.is_none();
    if ui.checkbox(&mut is_infinite, "infinite projection").on_hover_text("Off: a far plane cuts volumes off").changed()
    {
        volumes.far_plane = (!is_infinite).then_some(FAR_PLANE);
    }
    if let Some(distance) = &mut volumes.far_plane {
        ui.add(Slider::new(distance, 1.0..=100.0).logarithmic(true).text("far plane").suffix(" m"));
    }
    ui.checkbox(&mut volumes.joined, "volumes joined at edges").on_hover_text("Off: each triangle has its own, slowly");
}

fn planar_ui(ui: &mut Ui, planar: &mut PlanarSettings) {
    ui.add(Slider::new(&mut planar.num_receivers, 1..=31).text("planes")).on_hover_text("The largest receive shadows");
    ui.checkbox(&mut planar.stays_on_receiver, "shadows stay on their plane").on_hover_text("Off: they stick out");
    ui.checkbox(&mut planar.is_free_of_depth, "no fight for depth").on_hover_text("Off: shadow and plane flicker");
    ui.checkbox(&mut planar.darkens_once, "darken once").on_hover_text("Off: overlapping casters darken twice");
    ui.checkbox(&mut planar.clips_casters, "cut casters at the plane")
        .on_hover_text("Off: what is below throws shadows up");
}
