//! Snapshots of the panels, and panels under random input.

use std::time::Duration;

use egui::{Event, PointerButton, Pos2, RawInput, Rect, Vec2};
use glam::Vec3;
use hemicube::bake::{BakeSettings, Quality};
use hemicube::base::sampling::{hash, unit_float};
use hemicube::gpu::Gpu;
use hemicube::gpu::readback::read_texture;
use hemicube::patch::MeshSettings;
use hemicube::render::{Picture, Shading};
use hemicube::scene::{Scene, builtin};
use hemicube::viewer::camera::pose::CameraPose;
use hemicube::viewer::panels::shapes::PanelShapes;
use hemicube::viewer::panels::{BakeFacts, CameraFacts, Facts, Panels, PictureFacts, SceneFacts, theme};
use hemicube::viewer::preferences::Preferences;
use hemicube::viewer::session::light_state::LightState;
use hemicube::viewer::settings::view::Tab;
use hemicube::viewer::software::kept_side::KeptSide;
use wgpu::{CommandEncoderDescriptor, TextureFormat};

use crate::support::device::gpu;
use crate::support::screen::screen;
use crate::support::snapshot::assert_snapshot;

const WINDOW: [u32; 2] = [1280, 720];
/// Width of the side panel, pixels. Only this part of the window is compared.
const SIDE: u32 = 312;

fn facts(scene: &Scene) -> Facts<'_> {
    Facts {
        scene: SceneFacts { open: Some(scene), num_elements: Some(41_234), ..SceneFacts::default() },
        bake: BakeFacts {
            light: LightState::Baked { elapsed: Duration::from_secs(3) },
            is_solved: true,
            next: Some((BakeSettings::preset(Quality::Medium), MeshSettings { element_size: 0.12, patch_size: 0.5 })),
            curve: &[[0.1, 1.0], [0.5, 0.2], [1.2, 0.01], [1.6, 0.001]],
            ..BakeFacts::default()
        },
        camera: CameraFacts {
            pose: Some(CameraPose::looking_along(Vec3::new(2.8, 1.65, 2.0), Vec3::NEG_Z)),
            is_walking: true,
            speed: 2.0,
            bookmarks: vec![1, 3],
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

fn panels(scene: &Scene, sections: &[(&str, bool)]) -> Panels {
    let mut preferences = Preferences { has_seen_tour: true, ..Preferences::default() };
    preferences.sections = sections.iter().map(|&(title, is_open)| (title.to_owned(), is_open)).collect();
    let mut panels = Panels::new(Quality::Medium, preferences);
    panels.light.reset_groups(scene);
    panels
}

fn input(events: Vec<Event>, size: Vec2) -> RawInput {
    RawInput { screen_rect: Some(Rect::from_min_size(Pos2::ZERO, size)), events, ..RawInput::default() }
}

/// Panels on a texture in place of the screen, repainted in each frame or with a cached side panel.
struct Sheet {
    ctx: egui::Context,
    painter: egui_wgpu::Renderer,
    target: wgpu::Texture,
    kept: Option<KeptSide>,
}

impl Sheet {
    fn new(gpu: &Gpu, kept: Option<KeptSide>) -> Self {
        let ctx = egui::Context::default();
        theme::apply(&ctx);
        let options = egui_wgpu::RendererOptions { dithering: false, ..Default::default() };
        let painter = egui_wgpu::Renderer::new(&gpu.device, TextureFormat::Rgba8Unorm, options);
        Self { ctx, painter, target: screen(gpu, WINDOW, TextureFormat::Rgba8Unorm), kept }
    }

    /// Draws the next frame. Returns its RGBA bytes.
    fn frame(&mut self, gpu: &Gpu, panels: &mut Panels, facts: &Facts<'_>) -> Vec<u8> {
        let size = WINDOW.map(|side| side as f32).into();
        let mut free = Rect::ZERO;
        let output = self.ctx.run_ui(input(Vec::new(), size), |ui| (_, free) = panels.ui(ui, facts));
        for (&id, deltas) in &output.textures_delta.set {
            deltas.iter().for_each(|delta| self.painter.update_texture(&gpu.device, &gpu.queue, id, delta));
        }
        let mut shapes = PanelShapes {
            primitives: self.ctx.tessellate(output.shapes, output.pixels_per_point),
            textures: output.textures_delta,
            pixels_per_point: 1.0,
            side: Rect::from_min_max(Pos2::new(free.right(), 0.0), Pos2::new(size.x, free.bottom())),
            divider: 1.0,
        };
        let screen = egui_wgpu::ScreenDescriptor { size_in_pixels: WINDOW, pixels_per_point: 1.0 };
        let mut encoder = gpu.device.create_command_encoder(&CommandEncoderDescriptor { label: None });
        let primitives = &shapes.primitives;
        let mut uploads = self.painter.update_buffers(&gpu.device, &gpu.queue, &mut encoder, primitives, &screen);
        let view = self.target.create_view(&Default::default());
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("panels"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        if let Some(kept) = &mut self.kept {
            drop(pass);
            kept.paint(gpu, &mut encoder, &self.painter, &self.target, &mut shapes);
        } else {
            self.painter.render(&mut pass.forget_lifetime(), &shapes.primitives, &screen);
        }
        shapes.textures.clear();
        uploads.push(encoder.finish());
        gpu.queue.submit(uploads);
        read_texture(gpu, &self.target, 4).expect("read")
    }
}

/// Draws the side panel.
fn side_picture(gpu: &Gpu, panels: &mut Panels, facts: &Facts<'_>) -> Picture {
    let mut sheet = Sheet::new(gpu, None);
    // egui needs some frames until all sizes are final.
    let [_, _, bytes] = [(); 3].map(|()| sheet.frame(gpu, panels, facts));
    let row = 4 * WINDOW[0] as usize;
    let display = bytes.chunks_exact(row).flat_map(|line| &line[row - 4 * SIDE as usize..]).copied().collect();
    Picture { width: SIDE, height: WINDOW[1], radiance: Vec::new(), display }
}

#[test]
fn a_cached_side_panel_looks_like_a_repainted_one() {
    let Some(gpu) = gpu() else { return };
    let scene = builtin::cornell();
    let mut sheets = [Some(KeptSide::default()), None].map(|kept| Sheet::new(gpu, kept));
    let mut every = sheets.each_ref().map(|_| panels(&scene, &[]));
    for step in 0..12 {
        let pictures = [0, 1].map(|which| {
            let panels = &mut every[which];
            match step {
                3 => panels.preferences.tab = Tab::Place,
                5 => panels.light.shading = Shading::FalseColour,
                7 => panels.preferences.is_open = false,
                8 => panels.preferences.is_open = true,
                10 => panels.shows_help = true,
                _ => {}
            }
            // The status line changes in each step, the side panel does not.
            let mut facts = facts(&scene);
            facts.picture.frame_rate = 30.0 + step as f32;
            sheets[which].frame(gpu, panels, &facts)
        });
        assert!(pictures[0] == pictures[1], "step {step}");
    }
}

#[test]
fn the_pages_match_their_snapshots() {
    let Some(gpu) = gpu() else { return };
    let scene = builtin::cornell();
    for (tab, name) in [
        (Tab::Picture, "panels_picture"),
        (Tab::Solution, "panels_solution"),
        (Tab::Meter, "panels_meter"),
        (Tab::Place, "panels_place"),
    ] {
        let mut panels = panels(&scene, &[]);
        panels.preferences.tab = tab;
        panels.light.shading = Shading::FalseColour;
        assert_snapshot(name, &side_picture(gpu, &mut panels, &facts(&scene)));
    }
}

/// Repeatable random numbers.
struct Dice(u32);

impl Dice {
    fn number(&mut self) -> f32 {
        self.0 += 1;
        unit_float(hash(self.0))
    }

    fn below(&mut self, limit: usize) -> usize {
        ((self.number() * limit as f32) as usize).min(limit - 1)
    }
}

/// Returns a random event of pointer, wheel, keys or text.
fn event(dice: &mut Dice, size: Vec2) -> Event {
    let at = Pos2::new(dice.number() * 1.1 * size.x, dice.number() * 1.1 * size.y);
    let button = [PointerButton::Primary, PointerButton::Secondary][dice.below(2)];
    match dice.below(8) {
        0..=2 => Event::PointerMoved(at),
        3 | 4 => {
            Event::PointerButton { pos: at, button, pressed: dice.below(2) == 0, modifiers: egui::Modifiers::NONE }
        }
        5 => Event::MouseWheel {
            unit: egui::MouseWheelUnit::Line,
            delta: egui::vec2(0.0, 10.0 * dice.number() - 5.0),
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Wheel,
            modifiers: egui::Modifiers::NONE,
        },
        6 => Event::Text(["7", "-", "lamp", "1e9", "é"][dice.below(5)].to_owned()),
        _ => Event::Key {
            key: [egui::Key::Tab, egui::Key::Enter, egui::Key::Escape, egui::Key::ArrowUp, egui::Key::Space]
                [dice.below(5)],
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: egui::Modifiers::NONE,
        },
    }
}

/// The environment variable `HEMICUBE_RANDOM_FRAMES` sets the number of frames.
#[test]
fn random_input_keeps_the_settings_valid() {
    let num_frames = std::env::var("HEMICUBE_RANDOM_FRAMES").ok().and_then(|text| text.parse().ok()).unwrap_or(400);
    let scene = builtin::cornell();
    let sections = ["Shadows", "Lux meter", "Scene", "Output", "Files", "Statistics"].map(|title| (title, true));
    let mut panels = panels(&scene, &sections);
    let ctx = egui::Context::default();
    theme::apply(&ctx);
    let mut dice = Dice(0);
    let mut num_actions = 0;
    for _ in 0..num_frames {
        let size = [egui::vec2(1280.0, 720.0), egui::vec2(480.0, 320.0), egui::vec2(1.0, 1.0)]
            [dice.below(12).saturating_sub(9)];
        let events = (0..dice.below(4)).map(|_| event(&mut dice, size)).collect();
        let mut facts = facts(&scene);
        if dice.below(20) == 0 {
            (facts.scene.open, facts.camera.pose) = (None, None);
        }
        if dice.below(30) == 0 {
            panels.preferences.tab = [Tab::Picture, Tab::Solution, Tab::Meter, Tab::Place][dice.below(4)];
        }
        let mut actions = Vec::new();
        let output = ctx.run_ui(input(events, size), |ui| actions = panels.ui(ui, &facts).0);
        output.drop_without_applying_deltas();
        num_actions += actions.len();
        let settings = panels.light.render_settings(true);
        assert!(settings.lux_scale.high > settings.lux_scale.low && settings.lux_scale.low >= 0.0, "{settings:?}");
        assert!(
            settings.group_weights.iter().all(|weight| weight.is_finite() && weight.min_element() >= 0.0),
            "{settings:?}"
        );
    }
    assert!(num_actions > 0, "no control was hit");
}
