//! Scene: objects, materials and lights by name. Objects can be selected, hidden and visited.

use egui::{CollapsingHeader, ComboBox, Role, ScrollArea, TextEdit, Ui};

use super::super::chrome::widgets::{grouped, hint, named, row};
use super::super::facts::Facts;
use crate::base::ids::InstanceId;
use crate::scene::{LightKind, Scene};
use crate::viewer::action::Action;
use crate::viewer::settings::view::Selection;

/// Largest height of a list, points.
const LIST_HEIGHT: f32 = 190.0;

/// Entry for the default materials of the file.
const NO_VARIANT: &str = "as it comes";

pub fn objects_ui(ui: &mut Ui, selection: &mut Selection, facts: &Facts<'_>, actions: &mut Vec<Action>) {
    let Some(scene) = facts.scene.open else {
        hint(ui, "Nothing is open.");
        return;
    };
    let size = scene.bounds().size();
    row(ui, "Size", format!("{:.1} x {:.1} x {:.1} m", size.x, size.y, size.z));
    variant_ui(ui, scene, facts.scene.variant, actions);
    let filter =
        ui.add(TextEdit::singleline(&mut selection.filter).hint_text("find a name").desired_width(f32::INFINITY));
    named(&filter, Role::TextInput, "Find a name");
    object_list_ui(ui, scene, selection, actions);
    materials_ui(ui, scene, &selection.filter);
    lights_ui(ui, scene, &selection.filter);
}

/// Lays out the choice of the material variant, if the file has variants.
fn variant_ui(ui: &mut Ui, scene: &Scene, current: Option<&str>, actions: &mut Vec<Action>) {
    if scene.variants.is_empty() {
        return;
    }
    let mut chosen = current;
    ComboBox::from_label("Variant").selected_text(current.unwrap_or(NO_VARIANT)).show_ui(ui, |ui| {
        ui.selectable_value(&mut chosen, None, NO_VARIANT);
        for name in &scene.variants {
            ui.selectable_value(&mut chosen, Some(name), name);
        }
    });
    if chosen != current {
        actions.push(Action::SetVariant(chosen.map(str::to_owned)));
    }
}

fn object_list_ui(ui: &mut Ui, scene: &Scene, selection: &mut Selection, actions: &mut Vec<Action>) {
    let listed: Vec<usize> =
        (0..scene.instances.len()).filter(|&i| matches(&scene.instances[i].name, &selection.filter)).collect();
    let title = format!("Objects: {}", grouped(listed.len()));
    CollapsingHeader::new(title).id_salt("objects").default_open(true).show_unindented(ui, |ui| {
        let height = ui.text_style_height(&egui::TextStyle::Body) + 2.0 * ui.spacing().button_padding.y;
        let list = ScrollArea::vertical().id_salt("objects").max_height(LIST_HEIGHT).auto_shrink([false, true]);
        list.show_rows(ui, height, listed.len(), |ui, rows| {
            for &i in &listed[rows] {
                object_ui(ui, &scene.instances[i].name, InstanceId::new(i), selection, actions);
            }
        });
    });
    if !selection.hidden.is_empty() && ui.button(format!("Show all ({} hidden)", selection.hidden.len())).clicked() {
        selection.hidden.clear();
    }
}

fn object_ui(ui: &mut Ui, name: &str, id: InstanceId, selection: &mut Selection, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let mut is_shown = !selection.hidden.contains(&id);
        let eye = ui.checkbox(&mut is_shown, "");
        named(&eye, Role::CheckBox, format!("Show {name}"));
        if eye.on_hover_text("Hidden objects are not drawn; their light and shadows stay as baked").changed() {
            if is_shown {
                selection.hidden.remove(&id)
            } else {
                selection.hidden.insert(id)
            };
        }
        let is_chosen = selection.chosen == Some(id);
        let label =
            ui.selectable_label(is_chosen, name).on_hover_text("Selects the object; a double click flies there");
        if label.clicked() {
            selection.chosen = (!is_chosen).then_some(id);
        }
        if label.double_clicked() {
            selection.chosen = Some(id);
            actions.push(Action::FrameInstance(id.index()));
        }
    });
}

fn materials_ui(ui: &mut Ui, scene: &Scene, filter: &str) {
    let listed: Vec<_> = scene.materials.iter().filter(|material| matches(&material.name, filter)).collect();
    CollapsingHeader::new(format!("Materials: {}", listed.len())).id_salt("materials").show_unindented(ui, |ui| {
        ScrollArea::vertical().id_salt("materials").max_height(LIST_HEIGHT).auto_shrink([false, true]).show(ui, |ui| {
            for material in listed {
                let nit = material.emission.max_element();
                let glow = if nit > 0.0 { format!("glows, {nit:.0} nit") } else { String::new() };
                row(ui, &material.name, glow);
            }
        });
    });
}

fn lights_ui(ui: &mut Ui, scene: &Scene, filter: &str) {
    let listed: Vec<_> = scene.lights.iter().filter(|light| matches(&light.name, filter)).collect();
    CollapsingHeader::new(format!("Lights: {}", listed.len())).id_salt("lights").show_unindented(ui, |ui| {
        ScrollArea::vertical().id_salt("lights").max_height(LIST_HEIGHT).auto_shrink([false, true]).show(ui, |ui| {
            for light in listed {
                let strength = light.intensity.max_element();
                let kind = match light.kind {
                    LightKind::Point { .. } => format!("point, {strength:.0} cd"),
                    LightKind::Spot { .. } => format!("spot, {strength:.0} cd"),
                    LightKind::Directional { .. } => format!("sun, {strength:.0} lx"),
                };
                row(ui, &light.name, kind);
            }
        });
    });
}

fn matches(name: &str, filter: &str) -> bool {
    name.to_lowercase().contains(&filter.trim().to_lowercase())
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn the_filter_ignores_case() {
        assert!(matches("Table top", " table ") && matches("Table top", ""));
        assert!(!matches("Table top", "chair"));
    }
}
