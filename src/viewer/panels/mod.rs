//! The panels beside the picture: plain functions from what is known ([`Facts`]) and what is set ([`Panels`]) to
//! widgets, and back to [`Command`]s.
//!
//! Nothing here touches the window, the device or the scene; each section is a file with one `*_ui` function.

mod advice;
mod bake;
mod certificate;
mod command;
mod compare;
mod facts;
mod help;
mod legend;
mod light;
mod markers;
mod measure;
mod message;
mod open;
mod output;
mod replay;
mod scene;
mod shadows;
mod sight;
mod statistics;
mod status;
pub mod theme;
mod tour;
mod view;
mod views;
mod widgets;

use std::collections::BTreeSet;

use egui::{Rect, RichText, Ui};

pub use command::{Command, TOOLS, Tool};
pub use facts::{Facts, LightState, MeterFacts};
pub use message::{Notice, Trouble};
pub use open::OpenDialog;
use sight::SightPicture;
use widgets::section;

use super::memory::Memory;
use super::settings::LightSettings;
use crate::bake::Quality;
use crate::base::ids::InstanceId;
use crate::render::Shading;

/// Width of the side panel, points.
const WIDTH: f32 = 312.0;

/// Pages of the side panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub enum Tab {
    /// What is shown, and how.
    #[default]
    Picture,
    /// The bake.
    Solution,
    /// Measuring, and what patches see.
    Meter,
    /// Cameras, objects, files.
    Place,
}

/// Pages with their names and meanings.
const TABS: [(Tab, &str, &str); 4] = [
    (Tab::Picture, "Picture", "View, light and shadows"),
    (Tab::Solution, "Solution", "Bake, time machine, advice"),
    (Tab::Meter, "Meter", "Lux, grids, what a patch sees"),
    (Tab::Place, "Place", "Cameras, objects, output, files"),
];

/// What the user has set, and what lies open.
pub struct Panels {
    /// How the light is shown.
    pub light: LightSettings,
    /// Preset of the next bake.
    pub quality: Quality,
    /// What is remembered between runs.
    pub memory: Memory,
    /// What a click in the picture does.
    pub tool: Tool,
    /// Which instances are seen and chosen.
    pub selection: Selection,
    /// What of the advice is shown.
    pub found: Option<Found>,
    /// How grids are laid out.
    pub grid: GridSettings,
    /// Form factors of the chosen patch are shown as a heat map.
    pub shows_heat: bool,
    /// The time machine.
    pub replay: ReplaySettings,
    /// The key sheet is shown.
    pub shows_help: bool,
    /// The user is choosing a file.
    pub dialog: Option<OpenDialog>,
    /// A line that goes away by itself.
    pub notice: Option<Notice>,
    /// What went wrong, until the user has read it.
    pub trouble: Option<Trouble>,
    sight: SightPicture,
}

/// Which instances are seen and chosen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Not drawn; their light and shadows stay as they were baked.
    pub hidden: BTreeSet<InstanceId>,
    /// Tinted in the picture.
    pub chosen: Option<InstanceId>,
    /// Only names with this in them are listed.
    pub filter: String,
}

/// A place that advice is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Found {
    /// Number of the advice.
    pub advice: usize,
    /// Number of its place.
    pub place: usize,
}

/// How grids are laid out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridSettings {
    /// Distance between points, metres.
    pub spacing: f32,
    /// Height above the surface, metres.
    pub height: f32,
}

/// Which moment of the recorded bake is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ReplaySettings {
    /// It is shown in place of the finished light.
    pub is_on: bool,
    /// Number of the moment.
    pub moment: usize,
    /// What is unshot is added, spread evenly.
    pub with_ambient: bool,
}

impl Panels {
    /// Everything as the user left it.
    #[must_use]
    pub fn new(quality: Quality, memory: Memory) -> Self {
        Self {
            light: LightSettings { lux_scale: memory.lux_scale, ..LightSettings::default() },
            quality,
            memory,
            tool: Tool::Look,
            selection: Selection::default(),
            found: None,
            grid: GridSettings { spacing: 0.5, height: 0.0 },
            shows_heat: true,
            replay: ReplaySettings::default(),
            shows_help: false,
            dialog: None,
            notice: None,
            trouble: None,
            sight: SightPicture::default(),
        }
    }

    /// Instances that are tinted in the picture: the selected one, or those that are chosen to throw shadows.
    #[must_use]
    pub fn chosen_instances(&self) -> BTreeSet<InstanceId> {
        match self.tool {
            Tool::Caster => self.light.shadows.planar.casters.clone(),
            _ => self.selection.chosen.into_iter().collect(),
        }
    }

    /// Times of passes are on show.
    #[must_use]
    pub fn shows_times(&self) -> bool {
        let is_unfolded = self.memory.sections.get("Shadows").copied().unwrap_or(false);
        self.light.is_real_time && self.memory.is_open && self.memory.tab == Tab::Picture && is_unfolded
    }

    /// Lays out all panels; what the user asked for, and what is left for the picture.
    pub fn ui(&mut self, ui: &mut Ui, facts: &Facts<'_>) -> (Vec<Command>, Rect) {
        let mut commands = Vec::new();
        egui::Panel::bottom("status").frame(theme::bar()).show(ui, |ui| status::status_ui(ui, facts));
        if self.memory.is_open {
            let side = egui::Panel::right("side").exact_size(WIDTH).resizable(false).frame(theme::side());
            side.show(ui, |ui| self.side_ui(ui, facts, &mut commands));
        }
        let free = ui.available_rect_before_wrap();
        self.picture_ui(ui, free, facts);
        message::notice_ui(ui.ctx(), &mut self.notice);
        message::trouble_ui(ui.ctx(), &mut self.trouble, &mut commands);
        if facts.scene.is_some() {
            tour::tour_ui(ui.ctx(), free, &mut self.memory.has_seen_tour);
        }
        open::open_ui(ui.ctx(), &mut self.dialog, &mut commands);
        help::help_ui(ui.ctx(), &mut self.shows_help);
        self.memory.lux_scale = self.light.lux_scale;
        (commands, free)
    }

    /// What lies over the picture.
    fn picture_ui(&mut self, ui: &mut Ui, free: Rect, facts: &Facts<'_>) {
        if facts.scene.is_none() && self.trouble.is_none() {
            message::empty_ui(ui.ctx(), free, &facts.light);
        }
        markers::markers_ui(ui, free, &self.light.groups, facts);
        compare::compare_ui(ui, free, &mut self.light, facts);
        if self.light.shading == Shading::FalseColour && facts.scene.is_some() {
            legend::legend_ui(ui, free, &self.light.lux_scale.in_order());
        }
    }

    fn side_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, commands: &mut Vec<Command>) {
        self.heading_ui(ui, facts, commands);
        ui.separator();
        egui::ScrollArea::vertical().id_salt(self.memory.tab).auto_shrink(false).show(ui, |ui| match self.memory.tab {
            Tab::Picture => self.picture_tab_ui(ui, facts, commands),
            Tab::Solution => self.solution_tab_ui(ui, facts, commands),
            Tab::Meter => self.meter_tab_ui(ui, facts, commands),
            Tab::Place => self.place_tab_ui(ui, facts, commands),
        });
    }

    fn heading_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, commands: &mut Vec<Command>) {
        ui.horizontal(|ui| {
            let name = facts.scene.map_or("Hemicube", |scene| scene.name.as_str());
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if ui.button("Help").on_hover_text("All keys (H or F1); P hides this panel").clicked() {
                    commands.push(Command::ToggleHelp);
                }
                if ui.button("Open ...").on_hover_text("Choose a file (O)").clicked() {
                    commands.push(Command::ChooseFile);
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
                    commands.push(Command::Take(tool));
                }
            }
        });
        ui.add_space(2.0);
        ui.columns(TABS.len(), |columns| {
            for (column, (tab, label, hint)) in columns.iter_mut().zip(TABS) {
                column.vertical_centered_justified(|ui| {
                    ui.selectable_value(&mut self.memory.tab, tab, label).on_hover_text(hint);
                });
            }
        });
    }

    fn picture_tab_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, commands: &mut Vec<Command>) {
        let Self { light, tool, memory: Memory { sections, wire, traces_stills, .. }, .. } = self;
        section(ui, sections, "View", true, |ui| {
            view::view_ui(ui, light, wire, traces_stills, facts, commands);
        });
        section(ui, sections, "Light", true, |ui| light::light_ui(ui, light, commands));
        section(ui, sections, "Shadows", false, |ui| shadows::shadows_ui(ui, light, *tool, facts, commands));
    }

    fn solution_tab_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, commands: &mut Vec<Command>) {
        let sections = &mut self.memory.sections;
        let is_dimmed = self.light.groups.iter().any(|group| !group.is_as_baked());
        section(ui, sections, "Bake", true, |ui| bake::bake_ui(ui, &mut self.quality, is_dimmed, facts, commands));
        section(ui, sections, "Time machine", true, |ui| replay::replay_ui(ui, &mut self.replay, facts, commands));
        section(ui, sections, "Advice", true, |ui| advice::advice_ui(ui, facts.advice, self.found, commands));
    }

    fn meter_tab_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, commands: &mut Vec<Command>) {
        let sections = &mut self.memory.sections;
        section(ui, sections, "Lux meter", true, |ui| {
            measure::measure_ui(ui, &mut self.grid, &self.light.groups, self.tool, facts, commands);
        });
        section(ui, sections, "View from here", true, |ui| {
            sight::sight_ui(ui, &mut self.sight, &mut self.shows_heat, self.tool, facts, commands);
        });
    }

    fn place_tab_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, commands: &mut Vec<Command>) {
        let Self { selection, memory: Memory { sections, picture, recent, .. }, .. } = self;
        section(ui, sections, "Cameras", true, |ui| views::views_ui(ui, facts, commands));
        section(ui, sections, "Scene", true, |ui| scene::scene_ui(ui, selection, facts, commands));
        section(ui, sections, "Output", false, |ui| output::output_ui(ui, picture, facts, commands));
        section(ui, sections, "Files", false, |ui| open::recent_ui(ui, recent, commands));
        section(ui, sections, "Statistics", false, |ui| statistics::statistics_ui(ui, facts));
    }
}

#[cfg(test)]
mod tests;
