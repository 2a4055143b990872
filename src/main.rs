//! The `hemicube` command: see `hemicube --help`.

use std::process::ExitCode;

use clap::Parser;
use hemicube::cli::{self, Cli};

fn main() -> ExitCode {
    cli::runtime_dir::set_runtime_dir();
    let cli = Cli::parse();
    env_logger::Builder::new().filter_level(cli.verbosity.level()).format_timestamp(None).init();
    match cli::run(&cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("hemicube: {error:#}");
            ExitCode::FAILURE
        }
    }
}
