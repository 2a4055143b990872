//! Options of pictures made by rays, and the way from them to a traced picture.

use anyhow::{Result, bail};
use clap::{Args, ValueEnum};
use glam::Vec3;

use super::render::Lighting;
use super::terminal::TerminalWatch;
use crate::baked::BakedScene;
use crate::base::progress::Progress as _;
use crate::raytrace::{self, Ambient, Film, PathSettings, TwoPassSettings};
use crate::scene::{Camera, Scene};
use crate::trace::Tracer;

/// Largest side of a traced picture, pixels.
const MAX_SIDE: u32 = 16384;

/// How the picture is made.
#[derive(Args, Clone, Debug)]
pub struct RayOptions {
    /// raster draws the light of the vertices; two-pass traces direct light and mirrors over the bake's indirect light;
    /// path traces all light, for truth (two-pass with stored light and path need no GPU).
    #[arg(long, value_enum, value_name = "RENDERER", default_value = "raster")]
    pub renderer: RendererName,
    /// Rays a pixel [default: 32 with two-pass, 256 with path].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    pub spp: Option<u32>,
    /// With path: light is followed through at most this many reflections [default: to the end].
    #[arg(long, value_name = "K")]
    pub max_bounces: Option<u32>,
    /// With two-pass: so many rays a sample look for indirect light at the first surface and take it from the next;
    /// 0 takes it from the vertices.
    #[arg(long, value_name = "N", default_value = "0", value_parser = clap::value_parser!(u32).range(0..=1 << 16))]
    pub final_gather: u32,
}

/// Renderers as written on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RendererName {
    /// Drawn by the GPU.
    Raster,
    /// Ray tracing over a bake.
    TwoPass,
    /// Path tracing.
    Path,
}

impl RayOptions {
    /// A picture of a bake by two passes; `ambient` is the radiance of white paint under [`Lighting::Ambient`].
    ///
    /// # Errors
    /// The size is too large, or it was stopped.
    pub fn two_pass(
        &self,
        baked: &BakedScene,
        camera: &Camera,
        size: [u32; 2],
        lighting: Lighting,
        ambient: Vec3,
        is_quiet: bool,
    ) -> Result<Film> {
        let ambient = match lighting {
            Lighting::Direct => Ambient::None,
            Lighting::Ambient => Ambient::Constant(ambient),
            Lighting::Radiosity => Ambient::All,
            Lighting::IndirectAndDirect => Ambient::Indirect { final_gather: self.final_gather },
        };
        let default = TwoPassSettings::default();
        let settings = TwoPassSettings { samples: self.spp.unwrap_or(default.samples), ambient, ..default };
        watched(size, is_quiet, |watch| {
            raytrace::two_pass(&Tracer::new(&baked.scene), baked, camera, size, &settings, watch)
        })
    }

    /// A path-traced picture of a scene.
    ///
    /// # Errors
    /// The size is too large, there is no such lighting in truth, or it was stopped.
    pub fn path_traced(
        &self,
        scene: &Scene,
        camera: &Camera,
        size: [u32; 2],
        lighting: Lighting,
        is_quiet: bool,
    ) -> Result<Film> {
        let max_bounces = match lighting {
            Lighting::Direct => 1,
            Lighting::Ambient => bail!("--renderer path traces all light: there is no ambient light in it"),
            Lighting::Radiosity | Lighting::IndirectAndDirect => u32::MAX,
        };
        let default = PathSettings::default();
        let settings = PathSettings {
            samples: self.spp.unwrap_or(default.samples),
            max_bounces: self.max_bounces.unwrap_or(max_bounces),
            ..default
        };
        watched(size, is_quiet, |watch| raytrace::path_traced(&Tracer::new(scene), camera, size, &settings, watch))
    }
}

/// Traces with progress on the terminal, and tells how well the picture is known.
fn watched(size: [u32; 2], is_quiet: bool, trace: impl FnOnce(&TerminalWatch) -> Film) -> Result<Film> {
    if size.iter().any(|&side| side > MAX_SIDE) {
        bail!("a picture of {}x{} pixels is too large: at most {MAX_SIDE} each way", size[0], size[1]);
    }
    let watch = TerminalWatch::interruptible(is_quiet)?;
    let film = trace(&watch);
    watch.finish();
    if watch.is_cancelled() {
        bail!("stopped");
    }
    if !is_quiet {
        let noise = film.noise();
        eprintln!("standard error: {:.2} % a pixel, {:.3} % of the mean", 100.0 * noise.pixel, 100.0 * noise.mean);
    }
    Ok(film)
}
