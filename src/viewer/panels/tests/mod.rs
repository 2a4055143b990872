//! The panels as a user of a screen reader meets them: every control by its name.

use std::time::Duration;

use egui::{Rect, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use glam::Vec3;

mod scene;
mod shadows;

use super::layout::WIDTH;
use super::*;
use crate::bake::BakeSettings;
use crate::bake::Quality;
use crate::base::progress::Stage;
use crate::patch::MeshSettings;
use crate::render::Shading;
use crate::scene::doctor::Location;
use crate::scene::{Scene, builtin};
use crate::viewer::action::Action;
use crate::viewer::camera::pose::CameraPose;
use crate::viewer::preferences::Preferences;
use crate::viewer::session::advice::Advice;
use crate::viewer::session::light_state::LightState;
use crate::viewer::settings::tool::Tool;
use crate::viewer::settings::view::AdviceLocation;
use crate::viewer::settings::view::Wire;

const WINDOW: Vec2 = egui::vec2(1280.0, 2400.0);

/// What the panels are shown with, and what they asked for.
struct Desk {
    panels: Panels,
    facts: Facts<'static>,
    asked: Vec<Action>,
    free: Rect,
}

fn facts(scene: Option<&'static Scene>, light: LightState) -> Facts<'static> {
    let sizes = MeshSettings { element_size: 0.1, patch_size: 0.5 };
    Facts {
        scene: SceneFacts { open: scene, ..SceneFacts::default() },
        bake: BakeFacts {
            light,
            next: scene.map(|_| (BakeSettings::preset(Quality::Draft), sizes)),
            ..BakeFacts::default()
        },
        camera: CameraFacts {
            pose: scene.map(|_| CameraPose::looking_along(Vec3::ZERO, Vec3::NEG_Z)),
            is_walking: true,
            speed: 2.0,
            ..CameraFacts::default()
        },
        picture: PictureFacts {
            size: [980, 690],
            frame_rate: 60.0,
            frame_seconds: 0.016,
            adapter: "test",
            ..PictureFacts::default()
        },
        ..Facts::default()
    }
}

fn cornell() -> &'static Scene {
    static SCENE: std::sync::OnceLock<Scene> = std::sync::OnceLock::new();
    SCENE.get_or_init(builtin::cornell)
}

/// A window tall enough for every section, all of them open.
fn desk(facts: Facts<'static>) -> Harness<'static, Desk> {
    let mut preferences = Preferences { has_seen_tour: true, ..Preferences::default() };
    for title in SECTIONS {
        preferences.sections.insert(title.to_owned(), true);
    }
    desk_with(facts, preferences, WINDOW)
}

const SECTIONS: [&str; 13] = [
    "Advice",
    "View",
    "Light",
    "Shadows",
    "Bake",
    "Lux meter",
    "View from here",
    "Time machine",
    "Cameras",
    "Scene",
    "Output",
    "Files",
    "Statistics",
];

fn desk_with(facts: Facts<'static>, preferences: Preferences, size: Vec2) -> Harness<'static, Desk> {
    let mut panels = Panels::new(Quality::Draft, preferences);
    if let Some(scene) = facts.scene.open {
        panels.light.reset_groups(scene);
    }
    let desk = Desk { panels, facts, asked: Vec::new(), free: Rect::ZERO };
    let builder = Harness::builder().with_size(size).with_max_steps(16).with_context_setup(theme::apply);
    let mut harness = builder.build_ui_state(
        |ui, desk: &mut Desk| {
            let (asked, free) = desk.panels.ui(ui, &desk.facts);
            desk.asked.extend(asked);
            desk.free = free;
        },
        desk,
    );
    harness.run_steps(3);
    harness
}

/// Clicks what has this name; what was asked for.
fn click(harness: &mut Harness<'static, Desk>, name: &str) -> Vec<Action> {
    harness.get_by_label(name).click();
    harness.run_steps(3);
    std::mem::take(&mut harness.state_mut().asked)
}

fn baked() -> Facts<'static> {
    let light = LightState::Baked { elapsed: Duration::from_secs(3) };
    let facts = facts(Some(cornell()), light);
    let bake = BakeFacts { is_solved: true, curve: &[[0.1, 1.0], [0.5, 0.1], [1.2, 0.01]], ..facts.bake };
    Facts { bake, ..facts }
}

#[test]
fn buttons_ask_for_what_they_say() {
    let mut desk = desk(baked());
    let first = cornell().cameras[0].name.as_str();
    for (tab, name, action) in [
        ("Picture", "Open ...", Action::ChooseFile),
        ("Picture", "Help", Action::ToggleHelp),
        ("Picture", "Measure", Action::SelectTool(Tool::Meter)),
        ("Place", "Select", Action::SelectTool(Tool::Choose)),
        ("Meter", "View from", Action::SelectTool(Tool::PatchView)),
        ("Meter", "Measure a surface", Action::SelectTool(Tool::Grid)),
        ("Picture", "Frame all", Action::FrameAll),
        ("Picture", "Fly", Action::ToggleWalking),
        ("Picture", "auto", Action::ToggleAutoExposure),
        ("Solution", "Bake", Action::Bake),
        ("Solution", "Save the bake", Action::SaveBake),
        ("Solution", "Record the bake", Action::ToggleRecording),
        ("Place", first, Action::GoToCamera(0)),
        ("Place", "Add", Action::SetBookmark(1)),
        ("Place", "Picture of this view", Action::Screenshot),
        ("Place", "Write a large picture", Action::WritePicture),
        ("Place", "Read the file again", Action::Reload),
    ] {
        desk.get_by_label(tab).click();
        desk.run_steps(3);
        // Some names are those of sections too.
        let nodes: Vec<_> = desk.get_all_by_label(name).collect();
        nodes.last().expect("found").click();
        desk.run_steps(3);
        assert_eq!(std::mem::take(&mut desk.state_mut().asked), [action], "{name}");
    }
}

#[test]
fn controls_set_what_they_name() {
    let mut desk = desk(baked());
    click(&mut desk, "Solution");
    click(&mut desk, "High");
    assert_eq!(desk.state().panels.quality, Quality::High);
    click(&mut desk, "Picture");
    // The lamp itself has the same name in the list of objects.
    desk.get_all_by_label(&cornell().light_groups[0]).next().expect("a dial").click();
    desk.run_steps(3);
    assert!(!desk.state().panels.light.groups[0].is_on);
    click(&mut desk, "Patches");
    assert_eq!(desk.state().panels.preferences.wire, Wire::Patches);
    click(&mut desk, "trace rays while still");
    assert!(desk.state().panels.preferences.traces_stills);
    click(&mut desk, "direct light with live shadows");
    assert!(desk.state().panels.light.render_settings(true).shadows.is_some());
    click(&mut desk, "indirect");
    assert!(!desk.state().panels.light.indirect && desk.state().panels.light.direct);
    click(&mut desk, "Place");
    click(&mut desk, "EXR");
    assert!(desk.state().panels.preferences.picture.is_exr);
}

#[test]
fn every_slider_and_number_has_a_name() {
    let mut desk = desk(baked());
    desk.state_mut().panels.light.shading = Shading::FalseColour;
    desk.run_steps(3);
    let lamp = &cornell().light_groups[0];
    for (tab, name) in [
        ("Picture", "Exposure"),
        ("Picture", &format!("Intensity of {lamp}")),
        ("Picture", &format!("Colour of {lamp}")),
        ("Picture", "Lowest lux"),
        ("Picture", "Highest lux"),
        ("Picture", "Parts between iso-lux lines"),
        ("Picture", "Field of view"),
        ("Meter", "Grid spacing"),
        ("Meter", "Grid height"),
        ("Place", "Rays a pixel"),
        ("Place", "Find a name"),
    ] {
        click(&mut desk, tab);
        assert!(desk.query_all_by_label(name).next().is_some(), "{name}");
    }
    // egui_kittest itself fails where a control has none.
    click(&mut desk, "Picture");
    assert_eq!(click(&mut desk, "Fit"), [Action::FitLuxScale]);
}

#[test]
fn a_dimmed_light_goes_back_to_as_baked() {
    let mut desk = desk(baked());
    let dial = &mut desk.state_mut().panels.light.groups[0];
    (dial.intensity, dial.tint) = (0.25, Vec3::new(1.0, 0.4, 0.1));
    desk.run_steps(3);
    click(&mut desk, "as baked");
    assert!(desk.state().panels.light.groups[0].is_as_baked());
}

#[test]
fn objects_are_found_selected_hidden_and_shown_again() {
    let mut desk = desk(baked());
    click(&mut desk, "Place");
    desk.state_mut().panels.selection.filter = "tall".to_owned();
    desk.run_steps(3);
    let found = |desk: &Harness<'static, Desk>, name: &str| desk.query_all_by_label(name).next().is_some();
    assert!(found(&desk, "tall block") && !found(&desk, "short block"));
    click(&mut desk, "tall block");
    let chosen = desk.state().panels.selection.chosen.expect("one is chosen");
    assert_eq!(cornell().instances[chosen.index()].name, "tall block");
    click(&mut desk, "Show tall block");
    assert!(desk.state().panels.selection.hidden.contains(&chosen));
    click(&mut desk, "Show all (1 hidden)");
    assert!(desk.state().panels.selection.hidden.is_empty());
}

#[test]
fn a_bake_can_be_cancelled_while_it_runs() {
    let working =
        LightState::Working { stage: Stage::Solve, done: 0.4, elapsed: Duration::from_secs(3), is_cancelled: false };
    let mut desk = desk(facts(Some(cornell()), working));
    click(&mut desk, "Solution");
    assert_eq!(click(&mut desk, "Cancel"), [Action::CancelBake]);
}

#[test]
fn what_needs_light_waits_for_it() {
    let mut desk = desk(facts(Some(cornell()), LightState::Dark));
    click(&mut desk, "Meter");
    assert!(desk.query_by_label("Waits for the light: measuring needs a finished bake.").is_some());
    click(&mut desk, "Solution");
    assert!(desk.query_by_label("Record the bake").is_none());
    assert!(desk.get_by_label("Save the bake").accesskit_node().is_disabled());
}

#[test]
fn saving_says_that_dials_are_not_saved() {
    let mut facts = facts(Some(cornell()), LightState::Stored);
    facts.bake.is_solved = true;
    let mut desk = desk(facts);
    click(&mut desk, "Solution");
    let told = "Saves every light group as it was baked, whatever the dials say.";
    assert!(desk.query_by_label(told).is_none());
    desk.state_mut().panels.light.groups[0].intensity = 0.5;
    desk.run();
    assert!(desk.query_by_label(told).is_some());
}

#[test]
fn trouble_is_shown_until_it_is_closed() {
    let mut desk = desk(facts(None, LightState::Nothing));
    let trouble = Trouble::new("This file cannot be opened", "no such file");
    desk.state_mut().panels.trouble = Some(trouble);
    desk.run_steps(3);
    assert!(desk.query_by_label("no such file").is_some());
    assert_eq!(click(&mut desk, "Open the built-in scene"), [Action::OpenBuiltIn]);
    assert_eq!(desk.state().panels.trouble, None);
}

#[test]
fn advice_stands_before_what_to_do() {
    static ADVICE: std::sync::OnceLock<Vec<Advice>> = std::sync::OnceLock::new();
    let advice = ADVICE.get_or_init(|| {
        let place = Location { lines: vec![[Vec3::ZERO, Vec3::X]] };
        vec![Advice { text: "open edges: 3; close gaps between walls".to_owned(), locations: vec![place; 2] }]
    });
    let mut desk = desk(Facts { scene: SceneFacts { advice, ..baked().scene }, ..baked() });
    click(&mut desk, "Solution");
    assert!(
        desk.query_by_label("open edges: 3").is_some() && desk.query_by_label("close gaps between walls").is_some()
    );
    assert_eq!(click(&mut desk, "Show where"), [Action::ShowAdvice(0)]);
    desk.state_mut().panels.shown_advice = Some(AdviceLocation { advice: 0, location: 1 });
    desk.run_steps(3);
    assert!(desk.query_by_label("2 of 2").is_some());
    assert_eq!(click(&mut desk, "Show the next"), [Action::ShowAdvice(0)]);
}

#[test]
fn a_file_is_chosen_in_the_dialog() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("hall.glb"), "").expect("written");
    let mut desk = desk(baked());
    desk.state_mut().panels.dialog = Some(OpenDialog::new(folder.path()));
    desk.run_steps(3);
    let asked = click(&mut desk, "hall.glb");
    assert!(matches!(&asked[..], [Action::Open(path)] if path.ends_with("hall.glb")), "{asked:?}");
    assert!(desk.state().panels.dialog.is_none());
}

#[test]
fn the_first_start_explains_itself_once() {
    let mut desk = desk_with(baked(), Preferences::default(), egui::vec2(1280.0, 720.0));
    click(&mut desk, "Let me walk");
    assert!(desk.state().panels.preferences.has_seen_tour && desk.query_by_label("Let me walk").is_none());
}

#[test]
fn sections_fold_and_are_remembered() {
    let mut desk = desk_with(baked(), Preferences { has_seen_tour: true, ..Preferences::default() }, WINDOW);
    click(&mut desk, "Place");
    assert!(desk.query_by_label("Find a name").is_some());
    click(&mut desk, "Scene");
    assert!(desk.query_by_label("Find a name").is_none());
    assert_eq!(desk.state().panels.preferences.sections.get("Scene"), Some(&false));
}

#[test]
fn the_picture_gets_what_the_panels_leave() {
    let size = egui::vec2(1280.0, 720.0);
    let mut desk = desk_with(facts(None, LightState::Nothing), Preferences::default(), size);
    let beside = desk.state().free;
    assert!(beside.bottom() < size.y - 15.0, "{beside}");
    desk.state_mut().panels.preferences.is_open = false;
    desk.run_steps(2);
    let alone = desk.state().free;
    assert!((alone.right() - beside.right() - WIDTH).abs() < 1.0 && alone.min == beside.min, "{alone} {beside}");
}
