//! Progress of long work on the terminal.

use std::io::IsTerminal;
use std::sync::{Arc, Mutex, OnceLock};

use anyhow::{Context, Result};
use indicatif::{ProgressBar, ProgressStyle};

use crate::bake::Watch;
use crate::base::progress::{Cancel, Progress, Stage};

/// Draws a bar on stderr and passes on the wish to stop.
pub struct TerminalWatch {
    cancel: Arc<Cancel>,
    bar: ProgressBar,
    stage: Mutex<Option<Stage>>,
}

/// Steps of the bar.
const STEPS: u64 = 1000;

impl TerminalWatch {
    /// A watch that ends the work when `cancel` is set and draws only where `is_visible`.
    #[must_use]
    pub fn new(cancel: Arc<Cancel>, is_visible: bool) -> Self {
        let bar = if is_visible { ProgressBar::new(STEPS) } else { ProgressBar::hidden() };
        let style =
            ProgressStyle::with_template("{msg:>12} {wide_bar:.cyan/dim} {percent:>3} % {elapsed:>4}, {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { cancel, bar, stage: Mutex::new(None) }
    }

    /// A watch that ends the work at Ctrl-C, which is heard by all watches of the process, and draws on a terminal unless
    /// `is_quiet`.
    ///
    /// # Errors
    /// Ctrl-C cannot be caught.
    pub fn interruptible(is_quiet: bool) -> Result<Self> {
        static CANCEL: OnceLock<Arc<Cancel>> = OnceLock::new();
        let is_first = CANCEL.get().is_none();
        let cancel = CANCEL.get_or_init(Arc::default);
        if is_first {
            ctrlc::set_handler(|| cancel.cancel()).context("Ctrl-C cannot be caught")?;
        }
        Ok(Self::new(Arc::clone(cancel), !is_quiet && std::io::stderr().is_terminal()))
    }

    /// Takes the bar away.
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

impl Watch for TerminalWatch {}
