//! `hemicube render`: a picture of a scene, with the light stored in the file or baked now.

mod light;
mod options;
mod patch_view;
mod picture_comparison;
mod ray_options;
mod shadow_comparison;
mod shadow_options;
mod traced;
mod view_request;

use anyhow::{Result, bail};

use super::scene_input::load;
use super::terminal::Terminal;
use crate::gpu::Gpu;
use crate::render::headless::check_size;
use crate::render::{FileKind, Picture, Raster, RenderSettings, picture, tone_map_on_cpu};
use crate::scene::Scene;

use light::{first_pass_light, raster_light, render_settings, stored_light};
pub use options::RenderArgs;
use patch_view::write_patch_view;
use picture_comparison::compare_with_reference;
use ray_options::RendererName;
use shadow_comparison::compare_shadows;
use view_request::ViewRequest;

/// Makes the picture, writes it and compares it with the reference.
///
/// # Errors
/// Returns an error if the scene or the reference cannot be loaded, the scene cannot be baked, the picture cannot be
/// written, or it differs from the reference by more than the threshold.
pub fn run(args: &RenderArgs, terminal: Terminal) -> Result<()> {
    // Errors in the options are reported before the bake.
    FileKind::of(&args.output)?;
    if (args.shadows.shadows.is_some() || args.shadows.shadow_debug.is_some())
        && args.rays.renderer != RendererName::Raster
    {
        bail!("--shadows and --shadow-debug are for the raster renderer; rays find their own shadows");
    }
    let reference = args.reference.as_deref().map(Raster::load).transpose()?;
    let scene = load(&args.scene, &args.variant)?;
    if let Some(at) = &args.hemicube_at {
        return write_patch_view(scene, at, args, terminal);
    }
    let request = ViewRequest::new(&scene, args)?;
    if let Some(techniques) = args.shadows.compared()? {
        let gpu = Gpu::headless()?;
        check_size(&gpu, request.size)?;
        return compare_shadows(&gpu, stored_light(scene), &request, &techniques, &args.output);
    }
    let picture = make_picture(scene, &request, args, terminal)?;
    picture.save(&args.output)?;
    match &reference {
        Some(reference) => compare_with_reference(&picture, reference, args.threshold, &args.output, terminal),
        None => Ok(()),
    }
}

/// Makes the picture with the chosen renderer.
fn make_picture(scene: Scene, request: &ViewRequest, args: &RenderArgs, terminal: Terminal) -> Result<Picture> {
    match args.rays.renderer {
        RendererName::Raster => {
            let gpu = Gpu::headless()?;
            check_size(&gpu, request.size)?;
            let baked = raster_light(&gpu, scene, args, terminal)?;
            Ok(picture(&gpu, &baked, &request.camera, request.size, &render_settings(args, &baked))?)
        }
        RendererName::TwoPass => {
            let baked = first_pass_light(scene, args, terminal)?;
            let settings = render_settings(args, &baked);
            let film = traced::two_pass(&baked, request, &args.rays, settings.ambient, terminal)?;
            Ok(tone_map_on_cpu(film.size(), film.radiance(), &settings))
        }
        RendererName::Path => {
            let film = traced::path_traced(&scene, request, &args.rays, terminal)?;
            Ok(tone_map_on_cpu(
                film.size(),
                film.radiance(),
                &RenderSettings { exposure: args.exposure, ..RenderSettings::default() },
            ))
        }
    }
}
