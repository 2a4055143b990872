//! The layout of all panels.

use std::collections::BTreeSet;

use egui::{Rect, RichText, Ui};

use super::chrome::message::{self, Notice, Trouble};
use super::chrome::widgets::section;
use super::chrome::{help, status, theme, tour};
use super::facts::Facts;
use super::measurement::patch_view::PatchViewPicture;
use super::measurement::{lux_meter, patch_view};
use super::overlay::{comparison, legend, markers};
use super::picture::{light, shadows, view};
use super::scene::open::OpenDialog;
use super::scene::{cameras, objects, open, output, statistics};
use super::solution::{advice, bake, time_machine};
use crate::bake::Quality;
use crate::base::ids::InstanceId;
use crate::render::Shading;
use crate::viewer::action::Action;
use crate::viewer::preferences::Preferences;
use crate::viewer::settings::light::LightSettings;
use crate::viewer::settings::tool::GridSettings;
use crate::viewer::settings::tool::{TOOLS, Tool};
use crate::viewer::settings::view::{AdviceLocation, ReplaySettings, Selection};
use crate::viewer::settings::view::{TABS, Tab};

/// Width of the side panel, points.
pub const WIDTH: f32 = 312.0;

/// State of all panels: the settings of the user and the open dialogs.
pub struct Panels {
    /// Settings of the light in the picture.
    pub light: LightSettings,
    /// Preset of the next bake.
    pub quality: Quality,
    /// Preferences that are stored between runs.
    pub preferences: Preferences,
    /// Tool that a click in the picture applies.
    pub tool: Tool,
    /// Instances that are hidden or selected.
    pub selection: Selection,
    /// The location that is marked in the picture.
    pub shown_advice: Option<AdviceLocation>,
    /// Layout of measured grids.
    pub grid: GridSettings,
    /// True if the form factors of the chosen patch are shown as a heat map.
    pub shows_heat: bool,
    /// Settings of the time machine.
    pub replay: ReplaySettings,
    /// True if the key sheet is shown.
    pub shows_help: bool,
    /// The dialog that opens a file, if it is open.
    pub dialog: Option<OpenDialog>,
    /// A line of text that disappears after some seconds.
    pub notice: Option<Notice>,
    /// An error that is shown until it is closed.
    pub trouble: Option<Trouble>,
    patch_view: PatchViewPicture,
}

impl Panels {
    /// Creates panels with these preferences.
    #[must_use]
    pub fn new(quality: Quality, preferences: Preferences) -> Self {
        Self {
            light: LightSettings { lux_scale: preferences.lux_scale, ..LightSettings::default() },
            quality,
            preferences,
            tool: Tool::Look,
            selection: Selection::default(),
            shown_advice: None,
            grid: GridSettings { spacing: 0.5, height: 0.0 },
            shows_heat: true,
            replay: ReplaySettings::default(),
            shows_help: false,
            dialog: None,
            notice: None,
            trouble: None,
            patch_view: PatchViewPicture::default(),
        }
    }

    /// Returns the instances that are tinted in the picture: the selected one, or those that are chosen to cast planar
    /// shadows.
    #[must_use]
    pub fn chosen_instances(&self) -> BTreeSet<InstanceId> {
        match self.tool {
            Tool::Caster => self.light.shadows.planar.casters.clone(),
            _ => self.selection.chosen.into_iter().collect(),
        }
    }

    /// Returns true if the durations of passes are shown.
    #[must_use]
    pub fn shows_times(&self) -> bool {
        let is_unfolded = self.preferences.sections.get("Shadows").copied().unwrap_or(false);
        self.light.is_real_time && self.preferences.is_open && self.preferences.tab == Tab::Picture && is_unfolded
    }

    /// Lays out all panels. Returns the actions of the user and the area that is left for the picture.
    pub fn ui(&mut self, ui: &mut Ui, facts: &Facts<'_>) -> (Vec<Action>, Rect) {
        let mut actions = Vec::new();
        egui::Panel::bottom("status").frame(theme::bar()).show(ui, |ui| status::status_ui(ui, facts));
        if self.preferences.is_open {
            let side = egui::Panel::right("side").exact_size(WIDTH).resizable(false).frame(theme::side());
            side.show(ui, |ui| self.side_ui(ui, facts, &mut actions));
        }
        let free = ui.available_rect_before_wrap();
        self.picture_ui(ui, free, facts);
        message::notice_ui(ui.ctx(), &mut self.notice);
        message::trouble_ui(ui.ctx(), &mut self.trouble, &mut actions);
        if facts.scene.open.is_some() {
            tour::tour_ui(ui.ctx(), free, &mut self.preferences.has_seen_tour);
        }
        open::open_ui(ui.ctx(), &mut self.dialog, &mut actions);
        help::help_ui(ui.ctx(), &mut self.shows_help);
        self.preferences.lux_scale = self.light.lux_scale;
        (actions, free)
    }

    /// Draws the labels, the marks and the legend over the picture.
    fn picture_ui(&mut self, ui: &mut Ui, free: Rect, facts: &Facts<'_>) {
        if facts.scene.open.is_none() && self.trouble.is_none() {
            message::empty_ui(ui.ctx(), free, &facts.bake.light);
        }
        markers::markers_ui(ui, free, &self.light.groups, facts);
        comparison::comparison_ui(ui, free, &mut self.light, facts);
        if self.light.shading == Shading::FalseColour && facts.scene.open.is_some() {
            legend::legend_ui(ui, free, &self.light.lux_scale.in_order());
        }
    }

    fn side_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, actions: &mut Vec<Action>) {
        self.heading_ui(ui, facts, actions);
        ui.separator();
        egui::ScrollArea::vertical().id_salt(self.preferences.tab).auto_shrink(false).show(ui, |ui| {
            match self.preferences.tab {
                Tab::Picture => self.picture_tab_ui(ui, facts, actions),
                Tab::Solution => self.solution_tab_ui(ui, facts, actions),
                Tab::Meter => self.meter_tab_ui(ui, facts, actions),
                Tab::Place => self.place_tab_ui(ui, facts, actions),
            }
        });
    }

    fn heading_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, actions: &mut Vec<Action>) {
        ui.horizontal(|ui| {
            let name = facts.scene.open.map_or("Hemicube", |scene| scene.name.as_str());
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if ui.button("Help").on_hover_text("All keys (H or F1); P hides this panel").clicked() {
                    actions.push(Action::ToggleHelp);
                }
                if ui.button("Open ...").on_hover_text("Choose a file (O)").clicked() {
                    actions.push(Action::ChooseFile);
                }
                ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                    ui.add(egui::Label::new(RichText::new(name).heading()).truncate());
                });
            });
        });
        ui.add_space(2.0);
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            ui.spacing_mut().button_padding.x = 6.0;
            for (tool, label, hint) in TOOLS {
                if ui.selectable_label(self.tool == tool, label).on_hover_text(hint).clicked() {
                    actions.push(Action::SelectTool(tool));
                }
            }
        });
        ui.add_space(2.0);
        ui.columns(TABS.len(), |columns| {
            for (column, (tab, label, hint)) in columns.iter_mut().zip(TABS) {
                column.vertical_centered_justified(|ui| {
                    ui.selectable_value(&mut self.preferences.tab, tab, label).on_hover_text(hint);
                });
            }
        });
    }

    fn picture_tab_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, actions: &mut Vec<Action>) {
        let Self { light, tool, preferences: Preferences { sections, wire, traces_stills, .. }, .. } = self;
        section(ui, sections, "View", true, |ui| {
            view::view_ui(ui, light, wire, traces_stills, facts, actions);
        });
        section(ui, sections, "Light", true, |ui| light::light_ui(ui, light, actions));
        section(ui, sections, "Shadows", false, |ui| shadows::shadows_ui(ui, light, *tool, facts, actions));
    }

    fn solution_tab_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, actions: &mut Vec<Action>) {
        let sections = &mut self.preferences.sections;
        let is_dimmed = self.light.groups.iter().any(|group| !group.is_as_baked());
        section(ui, sections, "Bake", true, |ui| bake::bake_ui(ui, &mut self.quality, is_dimmed, facts, actions));
        section(ui, sections, "Time machine", true, |ui| {
            time_machine::time_machine_ui(ui, &mut self.replay, facts, actions)
        });
        section(ui, sections, "Advice", true, |ui| {
            advice::advice_ui(ui, facts.scene.advice, self.shown_advice, actions)
        });
    }

    fn meter_tab_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, actions: &mut Vec<Action>) {
        let sections = &mut self.preferences.sections;
        section(ui, sections, "Lux meter", true, |ui| {
            lux_meter::lux_meter_ui(ui, &mut self.grid, &self.light.groups, self.tool, facts, actions);
        });
        section(ui, sections, "View from here", true, |ui| {
            patch_view::patch_view_ui(ui, &mut self.patch_view, &mut self.shows_heat, self.tool, facts, actions);
        });
    }

    fn place_tab_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, actions: &mut Vec<Action>) {
        let Self { selection, preferences: Preferences { sections, picture, recent, .. }, .. } = self;
        section(ui, sections, "Cameras", true, |ui| cameras::cameras_ui(ui, facts, actions));
        section(ui, sections, "Scene", true, |ui| objects::objects_ui(ui, selection, facts, actions));
        section(ui, sections, "Output", false, |ui| output::output_ui(ui, picture, facts, actions));
        section(ui, sections, "Files", false, |ui| open::recent_ui(ui, recent, actions));
        section(ui, sections, "Statistics", false, |ui| statistics::statistics_ui(ui, facts));
    }
}
