//! Measures milliseconds a frame for each shadow technique, and the ratio to a frame without shadows, in one run.
//!
//! `cargo bench --bench shadows -- [SCENE.glb ...]`; without a scene it measures the built-in gallery. Pictures have
//! 1280 x 720 pixels, one sample a pixel and one point an emissive surface, from the first camera. The best of a few
//! frames counts, without the first.
//!
//! For a bake, one more line is the time of its elements without the coarse mesh that pictures draw.
//!
//! The last two lines can be compared with other viewers: the stored light alone, and with one spot light under the
//! middle of the ceiling in place of the scene's lights, with a shadow map of 2048 texels that is kept while nothing
//! moves.

use std::f32::consts::FRAC_PI_3;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use glam::Vec3;
use hemicube::baked::{BakedScene, VertexLight};
use hemicube::gpu::Gpu;
use hemicube::render::scene::SceneBuffers;
use hemicube::render::shadow::TechniqueInfo;
use hemicube::render::{
    Exposure, MeteredExposure, PictureRequest, RenderSettings, Renderer, ShadowScene, ShadowSettings, ShadowTechnique,
    View,
};
use hemicube::scene::{Camera, Light, Scene, builtin, gltf};

const SIZE: [u32; 2] = [1280, 720];
/// Number of frames measured, of which the fastest counts.
const FRAMES: usize = 8;

fn main() -> anyhow::Result<()> {
    let paths: Vec<String> = std::env::args().skip(1).filter(|arg| arg != "--bench").collect();
    let gpu = Gpu::headless()?;
    println!("{}, {}x{}", gpu.name(), SIZE[0], SIZE[1]);
    if paths.is_empty() {
        bench(&gpu, builtin::gallery());
    }
    for path in paths {
        bench(&gpu, gltf::load(&PathBuf::from(path))?);
    }
    Ok(())
}

fn bench(gpu: &Gpu, scene: Scene) {
    println!("{}: {} triangles, {} lights", scene.name, scene.triangles.len(), scene.lights.len());
    let light = VertexLight::dark(scene.light_groups.len(), scene.vertices.len());
    let baked = BakedScene::new(scene, light);
    let spot = with_one_spot(baked.scene.clone());
    let light = VertexLight::dark(1, spot.vertices.len());
    let under_spot = Stage::new(gpu, BakedScene::new(spot, light));
    let mut stage = Stage::new(gpu, baked);
    // The shadow map is measured first, before the processor slows down as it heats up.
    let map = ShadowSettings::new(ShadowTechnique::Map);
    let stored = stage.milliseconds(gpu, None);
    let one_map = under_spot.milliseconds(gpu, Some(&map));
    let mut times = Vec::new();
    for TechniqueInfo { technique, name, .. } in ShadowTechnique::ALL {
        let time = stage.milliseconds(gpu, Some(&ShadowSettings::new(technique)));
        times.push(time);
        println!("{name:<18} {time:>8.1} ms  {:>6.2} x none", time / times[0]);
    }
    println!("depth-fail / depth-pass {:.2}", times[3] / times[2]);
    if stage.buffers.tiled.take().is_some() {
        let time = stage.milliseconds(gpu, None);
        println!("{:<18} {time:>8.1} ms  {:>6.2} x stored light", "elements", time / stored);
    }
    println!("{:<18} {stored:>8.1} ms", "stored light");
    println!("{:<18} {one_map:>8.1} ms", "and one map");
}

/// Returns the scene with one spot light under the middle of its ceiling as its only light.
fn with_one_spot(mut scene: Scene) -> Scene {
    let bounds = scene.bounds();
    let position = bounds.centre().with_y(bounds.high.y - 0.02 * bounds.size().y);
    let intensity = Vec3::splat(bounds.size().length_squared());
    scene.lights = vec![Light::spot(position, Vec3::NEG_Y, [0.8 * FRAC_PI_3, FRAC_PI_3], intensity)];
    scene.light_groups = vec!["spot".to_owned()];
    for material in &mut scene.materials {
        (material.emission, material.group) = (Vec3::ZERO, None);
    }
    scene
}

/// A scene on the device, and its first camera.
struct Stage {
    buffers: SceneBuffers,
    shadows: Arc<ShadowScene>,
    view: View,
    target: wgpu::TextureView,
}

impl Stage {
    fn new(gpu: &Gpu, baked: BakedScene) -> Self {
        let target = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("bench"),
            size: wgpu::Extent3d { width: SIZE[0], height: SIZE[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        let camera = baked.scene.cameras.first().cloned().unwrap_or_else(|| Camera::framing(baked.scene.bounds()));
        Self {
            buffers: SceneBuffers::new(gpu, &baked),
            shadows: Arc::new(ShadowScene::new(gpu, Arc::new(baked.scene))),
            view: View::from_camera(&camera, SIZE[0] as f32 / SIZE[1] as f32),
            target: target.create_view(&Default::default()),
        }
    }

    /// Returns the time of the fastest frame.
    fn milliseconds(&self, gpu: &Gpu, settings: Option<&ShadowSettings>) -> f64 {
        let mut renderer = Renderer::new(gpu, wgpu::TextureFormat::Rgba8Unorm, 1);
        let render_settings =
            RenderSettings { shadows: settings.cloned(), exposure: Exposure::Ev(0.0), ..RenderSettings::default() };
        let request = PictureRequest {
            size: SIZE,
            scene: &self.buffers,
            shadows: Some(&self.shadows),
            view: self.view,
            settings: &render_settings,
            exposure: MeteredExposure::OfThis,
            stopwatch: None,
        };
        let mut best = f64::INFINITY;
        for frame in 0..=FRAMES {
            let start = Instant::now();
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            renderer.draw(gpu, &mut encoder, &self.target, &request);
            gpu.queue.submit([encoder.finish()]);
            gpu.wait().expect("the device answers");
            if frame > 0 {
                best = best.min(1e3 * start.elapsed().as_secs_f64());
            }
        }
        best
    }
}
