//! Renders the Cornell box without a window, once with the shadows of each technique, and writes the pictures as PNG
//! files.
//!
//! `cargo run --example shadow_techniques [FOLDER]`: without a folder the pictures go to a temporary one.

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use hemicube::render::Exposure;
use hemicube::scene::builtin;
use hemicube::{BakedScene, Gpu, RenderSettings, ShadowSettings, ShadowTechnique, picture};

/// Width and height of the pictures, pixels.
const SIZE: [u32; 2] = [320, 240];

fn main() -> Result<(), Box<dyn Error>> {
    // Any Vulkan or Metal device will do, a software driver included.
    let gpu = match Gpu::headless() {
        Ok(gpu) => gpu,
        Err(error) => {
            println!("nothing to render with: {error}");
            return Ok(());
        }
    };
    let folder = std::env::args().nth(1).map_or_else(|| std::env::temp_dir().join("hemicube-shadows"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;

    // Real-time shadows need no bake: direct light comes from the lights themselves.
    let baked = BakedScene::dark(builtin::cornell());
    let camera = baked.scene.cameras.first().ok_or("the scene has a camera")?.clone();

    for info in ShadowTechnique::ALL {
        let shadows = ShadowSettings { light_samples: 4, ..ShadowSettings::new(info.technique) };
        let settings =
            RenderSettings { exposure: Exposure::Ev(1.0), shadows: Some(shadows), ..RenderSettings::default() };
        let start = Instant::now();
        let picture = picture(&gpu, &baked, &camera, SIZE, &settings)?;
        let milliseconds = 1e3 * start.elapsed().as_secs_f32();

        // The mean radiance is reduced by the shadows.
        let mean = picture.radiance.iter().map(|[r, g, b, _]| (r + g + b) / 3.0).sum::<f32>();
        let mean = mean / picture.radiance.len() as f32;
        let path = folder.join(format!("{}.png", info.name));
        picture.save(&path)?;
        println!("{:20} mean radiance {mean:.3} nit, {milliseconds:5.0} ms: {}", info.title, path.display());
    }
    Ok(())
}
