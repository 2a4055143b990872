//! Options of traced pictures.

use clap::{Args, ValueEnum};

/// How the picture is made.
#[derive(Args, Clone, Debug)]
pub struct RayOptions {
    /// How the picture is made. Path needs no GPU, and two-pass needs none if the file stores light.
    #[arg(long, value_enum, value_name = "RENDERER", default_value = "raster")]
    pub renderer: RendererName,
    /// Rays a pixel [default: 32 with two-pass, 256 with path].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    pub spp: Option<u32>,
    /// With path: the largest number of reflections that a path follows [default: unlimited].
    #[arg(long, value_name = "K")]
    pub max_bounces: Option<u32>,
    /// With two-pass: the number of rays per sample that start at the first surface and collect the light stored where
    /// they hit; with 0, the light stored at the first surface is used.
    #[arg(long, value_name = "N", default_value = "0", value_parser = clap::value_parser!(u32).range(0..=1 << 16))]
    pub final_gather: u32,
}

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RendererName {
    /// Rasterisation of the light at the vertices.
    Raster,
    /// Ray-traced direct light and mirrors over the indirect light of the bake.
    TwoPass,
    /// Path tracing of all light: the reference.
    Path,
}
