//! Shadow features of the viewer: light that is added up in parts, known faults, chosen planes and casters, times.

use glam::Vec3;
use hemicube::base::ids::{GroupId, InstanceId, TriangleId};
use hemicube::gpu::{Gpu, Stopwatch};
use hemicube::render::shadow::{KnownFault, SampleBatch, known_fault, num_batches};
use hemicube::render::{Exposure, PictureRequest, RenderSettings, Renderer, ShadowSettings, ShadowTechnique, View};
use hemicube::scene::{Instance, Light, LightKind, Material};

use super::stage::{SIZE, Shot, Stage, at, paint, settings};
use crate::support::device::gpu;
use crate::support::screen::screen;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// A lamp of one square metre over a cube.
fn soft_stage() -> Stage {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.2, 0.0), 0);
    stage.scene.lights.clear();
    let lamp = stage.material(Material { emission: Vec3::splat(4.0), group: Some(GroupId(0)), ..paint() });
    stage.quad_of(Vec3::new(-0.5, 4.0, -0.5), Vec3::X, Vec3::Z, lamp);
    stage
}

/// A renderer and its target.
struct Easel {
    renderer: Renderer,
    target: wgpu::Texture,
}

impl Easel {
    fn new(gpu: &Gpu) -> Self {
        Self { renderer: Renderer::new(gpu, FORMAT, 1), target: screen(gpu, SIZE, FORMAT) }
    }

    fn add(&mut self, gpu: &Gpu, shot: &Shot, shadows: &ShadowSettings, is_partial: bool) {
        let render_settings =
            RenderSettings { shadows: Some(shadows.clone()), exposure: Exposure::Ev(0.0), ..RenderSettings::default() };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        if is_partial {
            self.renderer.add_light(gpu, &mut encoder, &shot.request(&render_settings));
        } else {
            let target = self.target.create_view(&Default::default());
            self.renderer.draw(gpu, &mut encoder, &target, &shot.request(&render_settings));
        }
        gpu.queue.submit([encoder.finish()]);
    }

    fn display(&self, gpu: &Gpu) -> Vec<u8> {
        hemicube::gpu::readback::read_texture(gpu, &self.target, 4).expect("read")
    }
}

#[test]
fn batches_add_up_to_the_light_of_all_points() {
    let Some(gpu) = gpu() else { return };
    let shot = soft_stage().shot(gpu);
    for technique in [ShadowTechnique::VolumeDepthFail, ShadowTechnique::Raytraced] {
        let per_lamp = 64;
        let mut easel = Easel::new(gpu);
        for number in 0..num_batches(per_lamp) {
            for (first, count, is_partial) in [(0, 40, true), (40, 24, false)] {
                let batch = Some(SampleBatch { number, first, count });
                let part = ShadowSettings { light_samples: per_lamp, batch, ..settings(technique) };
                easel.add(gpu, &shot, &part, is_partial);
            }
        }
        let added = easel.display(gpu);
        easel.add(gpu, &shot, &ShadowSettings { light_samples: 256, ..settings(technique) }, false);
        let whole = easel.display(gpu);
        let largest = added.iter().zip(&whole).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(largest <= Some(1), "{technique:?}: {largest:?} steps of 255");
    }
}

#[test]
fn kept_maps_show_the_same_as_new_maps() {
    let Some(gpu) = gpu() else { return };
    // More faces than the cache holds, so that some are replaced.
    let lit_by_three = |height: f32| {
        let mut stage = Stage::new();
        stage.cube(at(0.0, height, 0.0), 0);
        for x in [-2.0, 2.0] {
            let kind = LightKind::Point { position: Vec3::new(x, 3.5, 0.0) };
            let lamp = Light { kind, ..stage.scene.lights[0].clone() };
            stage.scene.lights.push(lamp);
        }
        stage.shot(gpu)
    };
    let map = settings(ShadowTechnique::Map);
    let from_new_maps = |shot: &Shot| {
        let mut easel = Easel::new(gpu);
        easel.add(gpu, shot, &map, false);
        easel.display(gpu)
    };
    let shots = [1.0, 1.8].map(lit_by_three);
    let pictures = shots.each_ref().map(from_new_maps);
    for shot in &shots {
        let share = shot.fault(gpu, &map);
        assert!(share <= 0.005, "{share} of the decisions are wrong");
    }
    let mut easel = Easel::new(gpu);
    for turn in [0, 0, 1, 1, 0] {
        easel.add(gpu, &shots[turn], &map, false);
        assert!(easel.display(gpu) == pictures[turn], "scene {turn}");
    }
}

#[test]
fn depth_pass_without_its_cure_is_known_to_be_wrong_if_the_eye_is_in_a_shadow() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.cube(at(0.0, 2.0, 0.0), 0);
    let mut plain = settings(ShadowTechnique::VolumeDepthPass);
    plain.volumes.near_plane_cure = false;
    let fault = |stage: &Stage, settings: &ShadowSettings| {
        let shot = stage.shot(gpu);
        known_fault(&shot.shadows, &View::from_camera(&shot.camera, 1.5), settings)
    };
    assert_eq!(fault(&stage, &plain), None, "the eye is in the light");
    // Under the cube, as seen from the lamp at (0.7, 4, 0.4).
    stage.seen(Vec3::new(-0.3, 0.8, -0.2), Vec3::new(3.0, 0.0, 0.0));
    assert_eq!(fault(&stage, &plain), Some(KnownFault::EyeInVolume { lamp: 0 }));
    assert_eq!(fault(&stage, &settings(ShadowTechnique::VolumeDepthPass)), None, "it is cured");
    assert_eq!(fault(&stage, &settings(ShadowTechnique::VolumeDepthFail)), None);
    let mut cut_off = settings(ShadowTechnique::VolumeDepthFail);
    cut_off.volumes.far_plane = Some(10.0);
    assert_eq!(fault(&stage, &cut_off), Some(KnownFault::FarPlaneCutsVolumes));
    // The shadows are indeed wrong there.
    assert!(stage.shot(gpu).fault(gpu, &plain) > 0.01);
}

#[test]
fn planes_and_casters_can_be_chosen() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.cube(at(-1.0, 1.0, 0.0), 0);
    let first_of_second = stage.scene.triangles.len();
    stage.cube(at(1.2, 1.0, 0.0), 0);
    stage.scene.triangles[first_of_second..].iter_mut().for_each(|triangle| triangle.instance = InstanceId(1));
    stage.scene.instances.push(Instance { name: "second".to_owned(), triangles: 0..0 });
    let shot = stage.shot(gpu);
    let dark = |planar: &ShadowSettings| {
        let found = &shot.decisions(gpu, planar).samples[0];
        let claimed = found.claimed.as_ref().expect("planar shadows decide on their receivers only");
        let dark = (0..claimed.len()).filter(|&pixel| claimed[pixel] && !found.lit[pixel]).count();
        (dark, claimed.iter().filter(|claimed| **claimed).count())
    };
    let mut planar = settings(ShadowTechnique::Planar);
    planar.planar.toggle_receiver(&stage.scene, TriangleId(0));
    assert_eq!(planar.planar.receivers.len(), 1);
    let (both, on_floor) = dark(&planar);
    planar.planar.toggle_caster(InstanceId(1));
    let (second, _) = dark(&planar);
    assert!(second > 100 && second < both - 100, "{second} of {both}");
    planar.planar.toggle_caster(InstanceId(1));
    assert_eq!(dark(&planar).0, both, "if none is chosen, all throw shadows");
    // The other triangle of the floor is in the same plane. Toggling it removes the plane, and the largest planes
    // receive shadows again.
    planar.planar.toggle_receiver(&stage.scene, TriangleId(1));
    assert!(planar.planar.receivers.is_empty() && dark(&planar).1 > on_floor);
}

#[test]
fn every_pass_is_timed() {
    let Some(gpu) = gpu() else { return };
    let shot = soft_stage().shot(gpu);
    let mut easel = Easel::new(gpu);
    let watch = Stopwatch::new(gpu);
    let view = easel.target.create_view(&Default::default());
    // More samples than the surface pass can add itself.
    let map = ShadowSettings { light_samples: 8, ..settings(ShadowTechnique::Map) };
    let render_settings = RenderSettings { shadows: Some(map), ..RenderSettings::default() };
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    watch.begin(&mut encoder);
    let request = PictureRequest { stopwatch: Some(&watch), ..shot.request(&render_settings) };
    easel.renderer.draw(gpu, &mut encoder, &view, &request);
    watch.end(&mut encoder);
    let begun = std::time::Instant::now();
    gpu.queue.submit([encoder.finish()]);
    let laps = watch.read(gpu).expect("read");
    let whole = 1e3 * begun.elapsed().as_secs_f32();
    let time = |name| laps.passes.iter().find(|(known, _)| *known == name).map(|(_, time)| *time);
    if !laps.is_of_device {
        assert!(time("all passes").is_some_and(|time| time > 0.0));
        return;
    }
    for name in ["depth prepass", "shadow maps", "direct light", "surfaces", "light meter", "tone map"] {
        assert!(time(name).is_some_and(|time| time >= 0.0), "{name} in {laps:?}");
    }
    let sum: f32 = laps.passes.iter().filter(|(name, _)| !name.contains("processor")).map(|(_, time)| time).sum();
    assert!(sum > 0.0 && sum <= whole, "{sum} ms of {whole} ms in {laps:?}");
}
