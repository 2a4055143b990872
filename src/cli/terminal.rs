//! Messages and progress on the terminal.

use std::fmt::Display;
use std::io::IsTerminal;
use std::sync::{Arc, Mutex, OnceLock};

use anyhow::{Context, Result};
use indicatif::{ProgressBar, ProgressStyle};

use crate::bake::BakeObserver;
use crate::base::progress::{Cancel, Progress, Stage};

/// Output of the messages of a subcommand: stderr, or nothing with `--quiet`.
#[derive(Clone, Copy, Debug)]
pub struct Terminal {
    is_quiet: bool,
}

/// A progress bar on stderr, and the flag that Ctrl-C sets.
pub struct TerminalWatch {
    cancel: Arc<Cancel>,
    bar: ProgressBar,
    stage: Mutex<Option<Stage>>,
}

/// Number of steps of the bar.
const STEPS: u64 = 1000;

impl Terminal {
    /// Creates a terminal that prints nothing if `is_quiet`.
    #[must_use]
    pub fn new(is_quiet: bool) -> Self {
        Self { is_quiet }
    }

    /// Prints a line on stderr.
    pub fn print(self, line: impl Display) {
        if !self.is_quiet {
            eprintln!("{line}");
        }
    }

    /// Creates a watch for work that Ctrl-C ends. It draws a progress bar if stderr is a terminal. All watches of the
    /// process share one handler of Ctrl-C.
    ///
    /// # Errors
    /// Returns an error if the handler cannot be installed.
    pub fn watch(self) -> Result<TerminalWatch> {
        static CANCEL: OnceLock<Arc<Cancel>> = OnceLock::new();
        let is_first = CANCEL.get().is_none();
        let cancel = CANCEL.get_or_init(Arc::default);
        if is_first {
            ctrlc::set_handler(|| cancel.cancel()).context("Ctrl-C cannot be caught")?;
        }
        let is_visible = !self.is_quiet && std::io::stderr().is_terminal();
        Ok(TerminalWatch::new(Arc::clone(cancel), is_visible))
    }
}

impl TerminalWatch {
    fn new(cancel: Arc<Cancel>, is_visible: bool) -> Self {
        let bar = if is_visible { ProgressBar::new(STEPS) } else { ProgressBar::hidden() };
        let style =
            ProgressStyle::with_template("{msg:>12} {wide_bar:.cyan/dim} {percent:>3} % {elapsed:>4}, {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { cancel, bar, stage: Mutex::new(None) }
    }

    /// Removes the bar.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for TerminalWatch {
    fn report(&self, stage: Stage, done: f32) {
        let mut current = self.stage.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if *current != Some(stage) {
            *current = Some(stage);
            self.bar.set_message(stage.label());
            self.bar.reset();
        }
        self.bar.set_position((done * STEPS as f32) as u64);
    }

    fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }
}

impl BakeObserver for TerminalWatch {}
