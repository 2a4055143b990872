//! View from a patch: its unfolded hemicube, and its form factors as a heat map in the picture.

use std::sync::Arc;

use egui::{ColorImage, TextureHandle, TextureOptions, Ui};

use super::super::chrome::widgets::{hint, row};
use super::super::facts::Facts;
use crate::viewer::action::Action;
use crate::viewer::settings::tool::Tool;
use crate::viewer::solution::patch_view::{ChosenPatchView, render_option};

/// The hemicube as a texture of egui.
#[derive(Default)]
pub struct PatchViewPicture {
    shows_items: bool,
    /// The view that the texture shows, whether it shows a colour for each element, and the texture.
    shown: Option<(Arc<ChosenPatchView>, bool, TextureHandle)>,
}

pub fn patch_view_ui(
    ui: &mut Ui,
    picture: &mut PatchViewPicture,
    shows_heat: &mut bool,
    tool: Tool,
    facts: &Facts<'_>,
    actions: &mut Vec<Action>,
) {
    if !facts.bake.is_solved {
        hint(ui, "Waits for the light: it needs a finished bake.");
    } else if tool == Tool::PatchView {
        hint(ui, "Click a surface to show the view from there.");
    } else if ui.button("Choose a patch").on_hover_text("Then click a surface (N)").clicked() {
        actions.push(Action::SelectTool(Tool::PatchView));
    }
    let Some(sight) = facts.measurement.patch_view else { return };
    ui.checkbox(shows_heat, "form factors as a heat map")
        .on_hover_text("Form factor per area of an element: red is the largest, blue a thousandth of it, grey is zero");
    ui.checkbox(&mut picture.shows_items, "a colour for each element");
    let texture = picture.texture(ui.ctx(), sight);
    let width = ui.available_width();
    ui.add(egui::Image::new((texture.id(), egui::vec2(width, width))).alt_text("Unfolded hemicube"));
    row(ui, "Open or backs", format!("{:.1} %", 100.0 * sight.open_share));
    row(ui, "Elements seen", sight.factors.iter().filter(|factor| **factor > 0.0).count().to_string());
    ui.horizontal(|ui| buttons_ui(ui, sight, actions));
}

fn buttons_ui(ui: &mut Ui, sight: &ChosenPatchView, actions: &mut Vec<Action>) {
    if ui
        .button("Copy as an option")
        .on_hover_text("As an option of hemicube render, which writes the same picture to a file")
        .clicked()
    {
        ui.copy_text(render_option(&sight.point));
    }
    if ui.button("Forget it").on_hover_text("Closes the view and its heat map").clicked() {
        actions.push(Action::ClosePatchView);
    }
}

impl PatchViewPicture {
    fn texture(&mut self, ctx: &egui::Context, sight: &Arc<ChosenPatchView>) -> TextureHandle {
        if let Some((shown, items, texture)) = &self.shown
            && Arc::ptr_eq(shown, sight)
            && *items == self.shows_items
        {
            return texture.clone();
        }
        let bytes = if self.shows_items { &sight.items } else { &sight.shaded };
        let image = ColorImage::from_rgba_unmultiplied(sight.size.map(|side| side as usize), bytes);
        let texture = ctx.load_texture("hemicube", image, TextureOptions::NEAREST);
        self.shown = Some((Arc::clone(sight), self.shows_items, texture.clone()));
        texture
    }
}
