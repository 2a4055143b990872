//! The panels beside the picture: plain functions from what is known ([`Facts`]) and what is set ([`Panels`]) to
//! widgets, and back to [`Command`]s.
//!
//! Nothing here touches the window, the device or the scene; each section is a file with one `*_ui` function.

mod bake;
mod cameras;
mod help;
mod light;
mod message;
mod scene;
mod shadows;
mod status;
pub mod theme;
mod view;

use std::time::Duration;

use egui::{CollapsingHeader, Rect, RichText, Ui};
use glam::Vec3;

pub use message::{Notice, Trouble};

use super::settings::LightSettings;
use crate::bake::Quality;
use crate::base::progress::Stage;
use crate::scene::Scene;

/// Width of the side panel, points.
const WIDTH: f32 = 292.0;

/// What the user has set, and what lies open.
pub struct Panels {
    /// How the light is shown.
    pub light: LightSettings,
    /// Preset of the next bake.
    pub quality: Quality,
    /// The side panel is shown.
    pub is_open: bool,
    /// The key sheet is shown.
    pub shows_help: bool,
    /// A line that goes away by itself.
    pub notice: Option<Notice>,
    /// What went wrong, until the user has read it.
    pub trouble: Option<Trouble>,
}

/// What the panels show.
pub struct Facts<'a> {
    /// The open scene.
    pub scene: Option<&'a Scene>,
    /// State of its light.
    pub light: LightState,
    /// Triangles that carry light; none before they are known.
    pub num_elements: Option<usize>,
    /// Eye point, metres.
    pub position: Vec3,
    /// Feet on the floor.
    pub is_walking: bool,
    /// Speed without running, metres a second.
    pub pace: f32,
    /// The mouse looks around until Escape.
    pub is_captured: bool,
    /// Frames a second while something moves.
    pub frame_rate: f32,
    /// Time that a frame takes, seconds.
    pub frame_seconds: f32,
    /// Name of the graphics device.
    pub adapter: &'a str,
}

/// Where the light of the open scene stands.
#[derive(Clone, Debug, PartialEq)]
pub enum LightState {
    /// Nothing is open.
    Nothing,
    /// A scene is read or baked.
    Working {
        /// What is being done.
        stage: Stage,
        /// Its done share.
        done: f32,
        /// Time since it began.
        elapsed: Duration,
        /// Its end has been asked for.
        is_cancelled: bool,
    },
    /// The file brought its light.
    Stored,
    /// A bake has ended.
    Baked {
        /// What it took.
        elapsed: Duration,
        /// Share of the light that was never shot.
        unshot_share: f64,
        /// Hemicubes that were drawn.
        num_hemicubes: usize,
        /// Patches that shoot.
        num_patches: usize,
    },
    /// The last bake failed or never was.
    Dark,
}

/// What a panel or a key asks the program to do.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Bake the open scene with the preset that is set.
    Bake,
    /// End the bake and keep what is solved.
    CancelBake,
    /// Go to a camera of the file.
    Jump(usize),
    /// Stand back until all is in view.
    FrameAll,
    /// Between walking and flying.
    ToggleWalking,
    /// Write a picture.
    Screenshot,
    /// Open the built-in scene.
    OpenBuiltIn,
    /// Bake, or end the bake that runs.
    ToggleBake,
    /// Another camera of the file, so many further.
    StepCamera(isize),
    /// Brighter by so many thirds of a stop.
    StepExposure(f32),
    /// Metered or fixed exposure.
    ToggleAutoExposure,
    /// The other tone map.
    NextToneMap,
    /// The next way to show surfaces.
    NextShading,
    /// Direct light shown or not.
    ToggleDirect,
    /// Indirect light shown or not.
    ToggleIndirect,
    /// Key sheet shown or not.
    ToggleHelp,
    /// Side panel shown or not.
    TogglePanels,
    /// Full screen or window.
    ToggleFullScreen,
}

impl Panels {
    /// Everything as a new user finds it.
    #[must_use]
    pub fn new(quality: Quality) -> Self {
        Self { light: LightSettings::default(), quality, is_open: true, shows_help: false, notice: None, trouble: None }
    }

    /// Lays out all panels; what the user asked for, and what is left for the picture.
    pub fn ui(&mut self, ui: &mut Ui, facts: &Facts<'_>) -> (Vec<Command>, Rect) {
        let mut commands = Vec::new();
        egui::Panel::bottom("status").frame(theme::bar()).show(ui, |ui| status::status_ui(ui, facts));
        if self.is_open {
            let side = egui::Panel::right("side").exact_size(WIDTH).resizable(false).frame(theme::side());
            side.show(ui, |ui| self.side_ui(ui, facts, &mut commands));
        }
        let free = ui.available_rect_before_wrap();
        if facts.scene.is_none() && self.trouble.is_none() {
            message::empty_ui(ui.ctx(), free, &facts.light);
        }
        message::notice_ui(ui.ctx(), &mut self.notice);
        message::trouble_ui(ui.ctx(), &mut self.trouble, &mut commands);
        help::help_ui(ui.ctx(), &mut self.shows_help);
        (commands, free)
    }

    fn side_ui(&mut self, ui: &mut Ui, facts: &Facts<'_>, commands: &mut Vec<Command>) {
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let name = facts.scene.map_or("Hemicube", |scene| scene.name.as_str());
            ui.add(egui::Label::new(RichText::new(name).heading()).truncate());
            ui.label(RichText::new("H: all keys   P: hide panels").weak());
            section(ui, "Light", true, |ui| light::light_ui(ui, &mut self.light, commands));
            section(ui, "Shadows", false, |ui| shadows::shadows_ui(ui, &mut self.light));
            section(ui, "Bake", true, |ui| bake::bake_ui(ui, &mut self.quality, facts, commands));
            section(ui, "View", true, |ui| view::view_ui(ui, &mut self.light, facts, commands));
            section(ui, "Cameras", true, |ui| cameras::cameras_ui(ui, facts.scene, commands));
            section(ui, "Scene", false, |ui| scene::scene_ui(ui, facts));
        });
    }
}

fn section(ui: &mut Ui, title: &str, is_open: bool, contents: impl FnOnce(&mut Ui)) {
    ui.add_space(2.0);
    ui.separator();
    CollapsingHeader::new(theme::title(title)).default_open(is_open).show_unindented(ui, |ui| {
        ui.add_space(2.0);
        contents(ui);
        ui.add_space(4.0);
    });
}

/// A name at the left, a value at the right.
fn row(ui: &mut Ui, name: &str, value: impl Into<egui::WidgetText>) {
    ui.horizontal(|ui| {
        ui.label(name);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.add(egui::Label::new(value).truncate());
        });
    });
}

/// A whole number with thin gaps between thousands.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

/// A duration as `12.3 s` or `2:05 min`.
fn clock(elapsed: Duration) -> String {
    let seconds = elapsed.as_secs();
    if seconds < 60 {
        format!("{:.1} s", elapsed.as_secs_f32())
    } else {
        format!("{}:{:02} min", seconds / 60, seconds % 60)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Event, PointerButton, Pos2, RawInput};

    const WINDOW: egui::Vec2 = egui::vec2(1280.0, 720.0);

    fn facts(scene: Option<&Scene>, light: LightState) -> Facts<'_> {
        Facts {
            scene,
            light,
            num_elements: None,
            position: Vec3::ZERO,
            is_walking: true,
            pace: 2.0,
            is_captured: false,
            frame_rate: 60.0,
            frame_seconds: 0.016,
            adapter: "test",
        }
    }

    /// Panels in a window of [`WINDOW`], fed with events.
    struct Desk {
        ctx: egui::Context,
        panels: Panels,
    }

    impl Desk {
        fn new() -> Self {
            let ctx = egui::Context::default();
            theme::apply(&ctx);
            let mut desk = Self { ctx, panels: Panels::new(Quality::Draft) };
            // Windows and areas know their size after a frame.
            desk.frame(&facts(None, LightState::Nothing), Vec::new());
            desk
        }

        /// Lays out one frame: commands, room for the picture, and the texts that are drawn with their places.
        fn frame(&mut self, facts: &Facts<'_>, events: Vec<Event>) -> (Vec<Command>, Rect, Vec<(String, Pos2)>) {
            let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, WINDOW));
            let input = RawInput { screen_rect, events, ..RawInput::default() };
            let mut asked = (Vec::new(), Rect::ZERO);
            let output = self.ctx.run_ui(input, |ui| asked = self.panels.ui(ui, facts));
            let texts = output.shapes.iter().flat_map(|clipped| texts(&clipped.shape)).collect();
            output.drop_without_applying_deltas();
            (asked.0, asked.1, texts)
        }

        /// Clicks in the middle of the last text that reads `label`; what was asked for.
        fn click(&mut self, facts: &Facts<'_>, label: &str) -> Vec<Command> {
            let (_, _, texts) = self.frame(facts, Vec::new());
            let (_, at) =
                texts.iter().rfind(|(text, _)| text == label).unwrap_or_else(|| panic!("{label} in {texts:?}"));
            let button = |pressed| Event::PointerButton {
                pos: *at,
                button: PointerButton::Primary,
                pressed,
                modifiers: egui::Modifiers::NONE,
            };
            self.frame(facts, vec![Event::PointerMoved(*at)]);
            self.frame(facts, vec![button(true)]);
            self.frame(facts, vec![button(false)]).0
        }
    }

    fn texts(shape: &egui::Shape) -> Vec<(String, Pos2)> {
        match shape {
            egui::Shape::Text(text) => vec![(text.galley.text().to_owned(), text.visual_bounding_rect().center())],
            egui::Shape::Vec(shapes) => shapes.iter().flat_map(texts).collect(),
            _ => Vec::new(),
        }
    }

    fn scene() -> Scene {
        Scene { name: "hall".into(), light_groups: vec!["lamps".into()], ..Scene::default() }
    }

    #[test]
    fn buttons_ask_for_what_they_say() {
        let (mut desk, scene) = (Desk::new(), scene());
        let dark = facts(Some(&scene), LightState::Dark);
        assert_eq!(desk.click(&dark, "Bake"), [Command::Bake]);
        assert_eq!(desk.click(&dark, "Frame all"), [Command::FrameAll]);
        assert_eq!(desk.click(&dark, "Fly"), [Command::ToggleWalking]);
        let working = LightState::Working {
            stage: Stage::Solve,
            done: 0.4,
            elapsed: Duration::from_secs(3),
            is_cancelled: false,
        };
        let mut desk = Desk::new();
        assert_eq!(desk.click(&facts(Some(&scene), working), "Cancel"), [Command::CancelBake]);
    }

    #[test]
    fn a_preset_is_picked_and_a_group_switched_off() {
        let (mut desk, scene) = (Desk::new(), scene());
        desk.panels.light.reset_groups(&scene);
        let dark = facts(Some(&scene), LightState::Dark);
        desk.click(&dark, "High");
        assert_eq!(desk.panels.quality, Quality::High);
        desk.click(&dark, "lamps");
        assert!(!desk.panels.light.groups[0].is_on);
    }

    #[test]
    fn live_shadows_are_switched_on_in_their_section() {
        let (mut desk, nothing) = (Desk::new(), facts(None, LightState::Nothing));
        assert_eq!(desk.panels.light.look(true).shadows, None);
        desk.click(&nothing, "Shadows");
        // The section takes some frames to unfold.
        for _ in 0..30 {
            desk.frame(&nothing, Vec::new());
        }
        desk.click(&nothing, "direct light with live shadows");
        assert!(desk.panels.light.look(true).shadows.is_some());
    }

    #[test]
    fn trouble_is_shown_until_it_is_closed() {
        let mut desk = Desk::new();
        desk.panels.trouble = Some(Trouble { title: "This file cannot be opened".into(), text: "no such file".into() });
        let nothing = facts(None, LightState::Nothing);
        // A window is measured in its first frame and drawn from the second on.
        desk.frame(&nothing, Vec::new());
        let (_, _, texts) = desk.frame(&nothing, Vec::new());
        assert!(texts.iter().any(|(text, _)| text == "no such file"), "{texts:?}");
        desk.click(&nothing, "Close");
        assert_eq!(desk.panels.trouble, None);
    }

    #[test]
    fn the_picture_gets_what_the_panels_leave() {
        let (mut desk, nothing) = (Desk::new(), facts(None, LightState::Nothing));
        let (_, beside, _) = desk.frame(&nothing, Vec::new());
        assert_eq!((beside.left(), beside.top()), (0.0, 0.0));
        assert!((beside.right() - (WINDOW.x - WIDTH)).abs() < 1.0 && beside.bottom() < WINDOW.y - 15.0, "{beside}");
        desk.panels.is_open = false;
        let (_, alone, _) = desk.frame(&nothing, Vec::new());
        assert_eq!(alone.right(), WINDOW.x);
    }

    #[test]
    fn thousands_are_set_apart() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(999), "999");
        assert_eq!(grouped(1_234_567), "1\u{2009}234\u{2009}567");
    }

    #[test]
    fn durations_read_like_a_clock() {
        assert_eq!(clock(Duration::from_millis(12_340)), "12.3 s");
        assert_eq!(clock(Duration::from_secs(125)), "2:05 min");
    }
}
