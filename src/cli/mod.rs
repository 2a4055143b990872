//! Floor 7: the command line. One file a subcommand; errors are printed once, by `main`.

pub mod bake;
pub mod bake_options;
pub mod form_factors;
pub mod info;
mod judge;
pub mod lightmap;
pub mod measure;
mod patch_view;
pub mod ray_options;
pub mod render;
pub mod shadow_options;
mod terminal;
pub mod view;

use anyhow::Result;
use clap::{Args, Parser, Subcommand};

/// Radiosity and shadows in real units: bake true, view-independent light for glTF scenes and walk through it.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
pub struct Cli {
    /// What to do; without it the viewer opens.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Options of the viewer.
    #[command(flatten)]
    pub view: view::ViewArgs,
    /// How much is told.
    #[command(flatten)]
    pub verbosity: Verbosity,
}

/// How much is told on stderr.
#[derive(Args, Debug)]
pub struct Verbosity {
    /// Tell more; twice for details.
    #[arg(short, long, action = clap::ArgAction::Count, global = true)]
    verbose: u8,
    /// Tell nothing but errors.
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Solve the light of a scene and write it as a .glb.
    Bake(bake::BakeArgs),
    /// Draw a picture of a scene, with the light stored in the file or baked now.
    Render(render::RenderArgs),
    /// Find the irradiance at given points.
    Measure(measure::MeasureArgs),
    /// Find the form factors (view factors) between pairs of polygons.
    FormFactors(form_factors::FormFactorArgs),
    /// Tell what is in a scene and what the mesh doctor finds.
    Info(info::InfoArgs),
}

impl Verbosity {
    /// Only errors were asked for.
    #[must_use]
    pub fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// The log level that was asked for.
    #[must_use]
    pub fn level(&self) -> log::LevelFilter {
        match (self.quiet, self.verbose) {
            (true, _) => log::LevelFilter::Error,
            (false, 0) => log::LevelFilter::Warn,
            (false, 1) => log::LevelFilter::Info,
            (false, _) => log::LevelFilter::Debug,
        }
    }
}

/// Does what the command line says.
///
/// Errors: the one message that the user shall read.
pub fn run(cli: &Cli) -> Result<()> {
    match &cli.command {
        Some(Command::Bake(args)) => bake::run(args, cli.verbosity.is_quiet()),
        Some(Command::Render(args)) => render::run(args, cli.verbosity.is_quiet()),
        Some(Command::Measure(args)) => measure::run(args, cli.verbosity.is_quiet()),
        Some(Command::FormFactors(args)) => form_factors::run(args),
        Some(Command::Info(args)) => info::run(args),
        None => view::run(&cli.view),
    }
}
