//! Floor 7: the command line, one file or room for each subcommand. Errors are printed once, by `main`.

mod bake;
mod bake_options;
mod form_factors;
mod info;
mod lightmap_export;
mod lit_scene;
mod measure;
mod render;
pub mod runtime_dir;
mod scene_input;
mod terminal;
mod value;
mod view;

use anyhow::Result;
use clap::{Args, Parser, Subcommand};

use terminal::Terminal;

/// Radiosity and shadows in real units: bake true, view-independent light for glTF scenes and walk through it.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
pub struct Cli {
    /// The subcommand; without one the viewer opens.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Options of the viewer.
    #[command(flatten)]
    pub view: view::ViewArgs,
    /// How much is printed.
    #[command(flatten)]
    pub verbosity: Verbosity,
}

/// How much is printed on stderr.
#[derive(Args, Debug)]
pub struct Verbosity {
    /// Print more; -vv prints details.
    #[arg(short, long, action = clap::ArgAction::Count, global = true)]
    verbose: u8,
    /// Print errors only.
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
    /// Compute the irradiance at given points.
    Measure(measure::MeasureArgs),
    /// Compute the form factors (view factors) between pairs of polygons.
    FormFactors(form_factors::FormFactorArgs),
    /// Print what is in a scene, what the mesh doctor finds and the predicted cost of a bake.
    Info(info::InfoArgs),
}

impl Verbosity {
    /// Returns the terminal that subcommands print on.
    fn terminal(&self) -> Terminal {
        Terminal::new(self.quiet)
    }

    /// Returns the level of the messages that are logged on stderr.
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

/// Runs the subcommand.
///
/// # Errors
/// Returns the error of the subcommand, which `main` prints.
pub fn run(cli: &Cli) -> Result<()> {
    let terminal = cli.verbosity.terminal();
    match &cli.command {
        Some(Command::Bake(args)) => bake::run(args, terminal),
        Some(Command::Render(args)) => render::run(args, terminal),
        Some(Command::Measure(args)) => measure::run(args, terminal),
        Some(Command::FormFactors(args)) => form_factors::run(args),
        Some(Command::Info(args)) => info::run(args),
        None => view::run(&cli.view),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    #[test]
    fn the_options_are_consistent_and_documented() {
        let mut command = Cli::command();
        command.build();
        command.clone().debug_assert();
        for subcommand in command.get_subcommands().filter(|subcommand| subcommand.get_name() != "help") {
            for argument in subcommand.get_arguments() {
                assert!(argument.get_help().is_some(), "{} {}", subcommand.get_name(), argument.get_id());
            }
        }
    }
}
