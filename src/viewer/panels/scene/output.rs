//! Output: pictures, and the camera as an option of the command line.

use egui::{ComboBox, DragValue, Role, Ui};

use super::super::chrome::widgets::{named, wide_button};
use super::super::facts::Facts;
use crate::viewer::action::Action;
use crate::viewer::settings::picture_file::PictureSettings;

/// Sizes to choose from, pixels.
const SIZES: [[u32; 2]; 5] = [[1280, 720], [1920, 1080], [2560, 1440], [3840, 2160], [7680, 4320]];

pub fn output_ui(ui: &mut Ui, picture: &mut PictureSettings, facts: &Facts<'_>, actions: &mut Vec<Action>) {
    if wide_button(
        ui,
        "Picture of this view",
        facts.scene.open.is_some(),
        "Writes hemicube-NNN.png without the panels (F12)",
    ) {
        actions.push(Action::Screenshot);
    }
    let name = |[width, height]: [u32; 2]| format!("{width} x {height}");
    ComboBox::from_label("pixels").selected_text(name(picture.size)).show_ui(ui, |ui| {
        for size in SIZES {
            ui.selectable_value(&mut picture.size, size, name(size));
        }
    });
    ui.horizontal(|ui| {
        ui.selectable_value(&mut picture.is_exr, false, "PNG").on_hover_text("As displayed");
        ui.selectable_value(&mut picture.is_exr, true, "EXR").on_hover_text("Linear radiance, nit");
        let rays = ui.add(DragValue::new(&mut picture.num_rays).range(0..=4096).speed(0.5));
        named(&rays, Role::SpinButton, "Rays a pixel");
        ui.label("rays a pixel")
            .on_hover_text("Ray-traced over the baked light; 0 rasterises the picture like the window");
    });
    let can_write = facts.scene.open.is_some() && (picture.num_rays == 0 || facts.bake.is_solved);
    if facts.picture.is_writing {
        if wide_button(ui, "Stop writing", true, "Cancels the picture") {
            actions.push(Action::CancelPicture);
        }
    } else if wide_button(ui, "Write a large picture", can_write, "Into the folder in which the program was started") {
        actions.push(Action::WritePicture);
    }
    if let Some(eye) = facts.camera.pose
        && wide_button(ui, "Copy the camera", true, "As an option of hemicube render")
    {
        ui.copy_text(eye.render_option());
    }
}
