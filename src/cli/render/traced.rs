//! Pictures by rays.

use anyhow::{Result, bail};
use glam::Vec3;

use super::options::Lighting;
use super::ray_options::RayOptions;
use super::view_request::ViewRequest;
use crate::baked::BakedScene;
use crate::base::progress::Progress as _;
use crate::cli::terminal::{Terminal, TerminalWatch};
use crate::raytrace::{self, Ambient, Film, PathSettings, TwoPassSettings};
use crate::scene::Scene;
use crate::trace::Tracer;

/// Largest side of a traced picture, pixels.
const MAX_SIDE: u32 = 16384;

/// Traces a picture of a bake by two passes. `ambient` is the radiance of white paint under [`Lighting::Ambient`].
///
/// # Errors
/// Returns an error if the picture is too large or the user stops it.
pub fn two_pass(
    baked: &BakedScene,
    request: &ViewRequest,
    options: &RayOptions,
    ambient: Vec3,
    terminal: Terminal,
) -> Result<Film> {
    let ambient = match request.lighting {
        Lighting::Direct => Ambient::None,
        Lighting::Ambient => Ambient::Constant(ambient),
        Lighting::Radiosity => Ambient::All,
        Lighting::IndirectAndDirect => Ambient::Indirect { final_gather: options.final_gather },
    };
    let default = TwoPassSettings::default();
    let settings = TwoPassSettings { samples: options.spp.unwrap_or(default.samples), ambient, ..default };
    watched(request.size, terminal, |watch| {
        raytrace::two_pass(&Tracer::new(&baked.scene), baked, &request.camera, request.size, &settings, watch)
    })
}

/// Traces a picture of a scene by path tracing.
///
/// # Errors
/// Returns an error if the picture is too large, the lighting is ambient, or the user stops it.
pub fn path_traced(scene: &Scene, request: &ViewRequest, options: &RayOptions, terminal: Terminal) -> Result<Film> {
    let max_bounces = match request.lighting {
        Lighting::Direct => 1,
        Lighting::Ambient => bail!("--renderer path traces all light: there is no ambient light in it"),
        Lighting::Radiosity | Lighting::IndirectAndDirect => u32::MAX,
    };
    let default = PathSettings::default();
    let settings = PathSettings {
        samples: options.spp.unwrap_or(default.samples),
        max_bounces: options.max_bounces.unwrap_or(max_bounces),
        ..default
    };
    watched(request.size, terminal, |watch| {
        raytrace::path_traced(&Tracer::new(scene), &request.camera, request.size, &settings, watch)
    })
}

/// Traces with progress on the terminal, and prints the standard error.
fn watched(size: [u32; 2], terminal: Terminal, trace: impl FnOnce(&TerminalWatch) -> Film) -> Result<Film> {
    if size.iter().any(|&side| side > MAX_SIDE) {
        bail!("a picture of {}x{} pixels is too large: at most {MAX_SIDE} each way", size[0], size[1]);
    }
    let watch = terminal.watch()?;
    let film = trace(&watch);
    watch.finish();
    if watch.is_cancelled() {
        bail!("stopped");
    }
    let noise = film.noise();
    terminal.print(format_args!(
        "standard error: {:.2} % a pixel, {:.3} % of the mean",
        100.0 * noise.pixel,
        100.0 * noise.mean
    ));
    Ok(film)
}
