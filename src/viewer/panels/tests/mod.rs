//! Tests of the panels, which find each control by its accessible name.

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

/// Panels, the facts that they show, and the actions that they have returned.
struct Fixture {
    panels: Panels,
    facts: Facts<'static>,
    actions: Vec<Action>,
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

/// Opens a window that is tall enough for all sections, with every section open.
fn window(facts: Facts<'static>) -> Harness<'static, Fixture> {
    let mut preferences = Preferences { has_seen_tour: true, ..Preferences::default() };
    for title in SECTIONS {
        preferences.sections.insert(title.to_owned(), true);
    }
    window_with(facts, preferences, WINDOW)
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

fn window_with(facts: Facts<'static>, preferences: Preferences, size: Vec2) -> Harness<'static, Fixture> {
    let mut panels = Panels::new(Quality::Draft, preferences);
    if let Some(scene) = facts.scene.open {
        panels.light.reset_groups(scene);
    }
    let window = Fixture { panels, facts, actions: Vec::new(), free: Rect::ZERO };
    let builder = Harness::builder().with_size(size).with_max_steps(16).with_context_setup(theme::apply);
    let mut harness = builder.build_ui_state(
        |ui, window: &mut Fixture| {
            let (actions, free) = window.panels.ui(ui, &window.facts);
            window.actions.extend(actions);
            window.free = free;
        },
        window,
    );
    harness.run_steps(3);
    harness
}

/// Clicks the control with this name. Returns the actions.
fn click(harness: &mut Harness<'static, Fixture>, name: &str) -> Vec<Action> {
    harness.get_by_label(name).click();
    harness.run_steps(3);
    std::mem::take(&mut harness.state_mut().actions)
}

fn baked() -> Facts<'static> {
    let light = LightState::Baked { elapsed: Duration::from_secs(3) };
    let facts = facts(Some(cornell()), light);
    let bake = BakeFacts { is_solved: true, curve: &[[0.1, 1.0], [0.5, 0.1], [1.2, 0.01]], ..facts.bake };
    Facts { bake, ..facts }
}

#[test]
fn buttons_emit_their_actions() {
    let mut window = window(baked());
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
        window.get_by_label(tab).click();
        window.run_steps(3);
        // A section may have the same name.
        let nodes: Vec<_> = window.get_all_by_label(name).collect();
        nodes.last().expect("found").click();
        window.run_steps(3);
        assert_eq!(std::mem::take(&mut window.state_mut().actions), [action], "{name}");
    }
}

#[test]
fn controls_change_their_settings() {
    let mut window = window(baked());
    click(&mut window, "Solution");
    click(&mut window, "High");
    assert_eq!(window.state().panels.quality, Quality::High);
    click(&mut window, "Picture");
    // The list of objects has an entry of the same name.
    window.get_all_by_label(&cornell().light_groups[0]).next().expect("a dial").click();
    window.run_steps(3);
    assert!(!window.state().panels.light.groups[0].is_on);
    click(&mut window, "Patches");
    assert_eq!(window.state().panels.preferences.wire, Wire::Patches);
    click(&mut window, "trace rays while still");
    assert!(window.state().panels.preferences.traces_stills);
    click(&mut window, "direct light with live shadows");
    assert!(window.state().panels.light.render_settings(true).shadows.is_some());
    click(&mut window, "indirect");
    assert!(!window.state().panels.light.indirect && window.state().panels.light.direct);
    click(&mut window, "Place");
    click(&mut window, "EXR");
    assert!(window.state().panels.preferences.picture.is_exr);
}

#[test]
fn every_slider_and_number_has_a_name() {
    let mut window = window(baked());
    window.state_mut().panels.light.shading = Shading::FalseColour;
    window.run_steps(3);
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
        click(&mut window, tab);
        assert!(window.query_all_by_label(name).next().is_some(), "{name}");
    }
    // egui_kittest fails if a control has no name.
    click(&mut window, "Picture");
    assert_eq!(click(&mut window, "Fit"), [Action::FitLuxScale]);
}

#[test]
fn a_dimmed_light_goes_back_to_as_baked() {
    let mut window = window(baked());
    let dial = &mut window.state_mut().panels.light.groups[0];
    (dial.intensity, dial.tint) = (0.25, Vec3::new(1.0, 0.4, 0.1));
    window.run_steps(3);
    click(&mut window, "as baked");
    assert!(window.state().panels.light.groups[0].is_as_baked());
}

#[test]
fn objects_are_found_selected_hidden_and_shown_again() {
    let mut window = window(baked());
    click(&mut window, "Place");
    window.state_mut().panels.selection.filter = "tall".to_owned();
    window.run_steps(3);
    let found = |window: &Harness<'static, Fixture>, name: &str| window.query_all_by_label(name).next().is_some();
    assert!(found(&window, "tall block") && !found(&window, "short block"));
    click(&mut window, "tall block");
    let chosen = window.state().panels.selection.chosen.expect("one is chosen");
    assert_eq!(cornell().instances[chosen.index()].name, "tall block");
    click(&mut window, "Show tall block");
    assert!(window.state().panels.selection.hidden.contains(&chosen));
    click(&mut window, "Show all (1 hidden)");
    assert!(window.state().panels.selection.hidden.is_empty());
}

#[test]
fn a_bake_can_be_cancelled_while_it_runs() {
    let working =
        LightState::Working { stage: Stage::Solve, done: 0.4, elapsed: Duration::from_secs(3), is_cancelled: false };
    let mut window = window(facts(Some(cornell()), working));
    click(&mut window, "Solution");
    assert_eq!(click(&mut window, "Cancel"), [Action::CancelBake]);
}

#[test]
fn measuring_recording_and_saving_wait_for_the_light() {
    let mut window = window(facts(Some(cornell()), LightState::Dark));
    click(&mut window, "Meter");
    assert!(window.query_by_label("Waits for the light: measuring needs a finished bake.").is_some());
    click(&mut window, "Solution");
    assert!(window.query_by_label("Record the bake").is_none());
    assert!(window.get_by_label("Save the bake").accesskit_node().is_disabled());
}

#[test]
fn saving_notes_that_dimmed_groups_are_saved_as_baked() {
    let mut facts = facts(Some(cornell()), LightState::Stored);
    facts.bake.is_solved = true;
    let mut window = window(facts);
    click(&mut window, "Solution");
    let note = "Saves every light group as it was baked, whatever the dials say.";
    assert!(window.query_by_label(note).is_none());
    window.state_mut().panels.light.groups[0].intensity = 0.5;
    window.run();
    assert!(window.query_by_label(note).is_some());
}

#[test]
fn an_error_is_shown_until_it_is_closed() {
    let mut window = window(facts(None, LightState::Nothing));
    let trouble = Trouble::new("This file cannot be opened", "no such file");
    window.state_mut().panels.trouble = Some(trouble);
    window.run_steps(3);
    assert!(window.query_by_label("no such file").is_some());
    assert_eq!(click(&mut window, "Open the built-in scene"), [Action::OpenBuiltIn]);
    assert_eq!(window.state().panels.trouble, None);
}

#[test]
fn advice_shows_finding_remedy_and_location() {
    static ADVICE: std::sync::OnceLock<Vec<Advice>> = std::sync::OnceLock::new();
    let advice = ADVICE.get_or_init(|| {
        let place = Location { lines: vec![[Vec3::ZERO, Vec3::X]] };
        vec![Advice { text: "open edges: 3; close gaps between walls".to_owned(), locations: vec![place; 2] }]
    });
    let mut window = window(Facts { scene: SceneFacts { advice, ..baked().scene }, ..baked() });
    click(&mut window, "Solution");
    assert!(
        window.query_by_label("open edges: 3").is_some() && window.query_by_label("close gaps between walls").is_some()
    );
    assert_eq!(click(&mut window, "Show where"), [Action::ShowAdvice(0)]);
    window.state_mut().panels.shown_advice = Some(AdviceLocation { advice: 0, location: 1 });
    window.run_steps(3);
    assert!(window.query_by_label("2 of 2").is_some());
    assert_eq!(click(&mut window, "Show the next"), [Action::ShowAdvice(0)]);
}

#[test]
fn a_file_is_chosen_in_the_dialog() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("hall.glb"), "").expect("written");
    let mut window = window(baked());
    window.state_mut().panels.dialog = Some(OpenDialog::new(folder.path()));
    window.run_steps(3);
    let actions = click(&mut window, "hall.glb");
    assert!(matches!(&actions[..], [Action::Open(path)] if path.ends_with("hall.glb")), "{actions:?}");
    assert!(window.state().panels.dialog.is_none());
}

#[test]
fn the_introduction_is_shown_once() {
    let mut window = window_with(baked(), Preferences::default(), egui::vec2(1280.0, 720.0));
    click(&mut window, "Let me walk");
    assert!(window.state().panels.preferences.has_seen_tour && window.query_by_label("Let me walk").is_none());
}

#[test]
fn sections_fold_and_are_remembered() {
    let mut window = window_with(baked(), Preferences { has_seen_tour: true, ..Preferences::default() }, WINDOW);
    click(&mut window, "Place");
    assert!(window.query_by_label("Find a name").is_some());
    click(&mut window, "Scene");
    assert!(window.query_by_label("Find a name").is_none());
    assert_eq!(window.state().panels.preferences.sections.get("Scene"), Some(&false));
}

#[test]
fn the_picture_fills_the_area_beside_the_panels() {
    let size = egui::vec2(1280.0, 720.0);
    let mut window = window_with(facts(None, LightState::Nothing), Preferences::default(), size);
    let beside = window.state().free;
    assert!(beside.bottom() < size.y - 15.0, "{beside}");
    window.state_mut().panels.preferences.is_open = false;
    window.run_steps(2);
    let alone = window.state().free;
    assert!((alone.right() - beside.right() - WIDTH).abs() < 1.0 && alone.min == beside.min, "{alone} {beside}");
}
