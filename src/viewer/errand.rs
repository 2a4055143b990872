//! Work that a click asks for: it runs in a thread of its own, rests while a frame is drawn, and brings what it finds.

use std::collections::HashMap;
use std::sync::Arc;
use std::thread::JoinHandle;

use anyhow::Context;
use winit::event_loop::EventLoopProxy;

use super::background::give_way;
use super::meter::{Grid, Reading};
use super::output::Written;
use super::patch_sight::PatchSight;
use super::replay::Recording;
use super::still::Exposed;
use super::worker::{Event, News};
use crate::base::progress::{Cancel, Gate, Progress, Stage};

/// What an errand brings.
pub enum Finding {
    /// The lux meter's reading.
    Reading(Box<Reading>),
    /// A measured grid.
    Grid(Box<Grid>),
    /// What a patch sees.
    Sight(Arc<PatchSight>),
    /// A bake to step through.
    Recording(Arc<Recording>),
    /// A traced picture of the view, better than the last.
    Still(Box<Exposed>),
    /// A file, or why there is none.
    Written(Written),
}

/// Errands of one kind follow each other: a new one ends the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A point or a grid is measured.
    Measure,
    /// What a patch sees.
    Sight,
    /// A bake is recorded.
    Record,
    /// The view is traced.
    Still,
    /// A file is written.
    Write,
}

/// All errands that run.
pub struct Errands {
    window: EventLoopProxy<News>,
    last: u32,
    running: HashMap<Kind, Errand>,
    /// Asked to end; dropped when they have.
    retired: Vec<Errand>,
}

struct Errand {
    number: u32,
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct Shared {
    cancel: Cancel,
    gate: Gate,
}

/// The thread's side of an errand.
pub struct Bearer {
    number: u32,
    job: u32,
    shared: Arc<Shared>,
    window: EventLoopProxy<News>,
}

impl Bearer {
    /// Hands something to the window.
    pub fn bring(&self, finding: Finding) {
        // Nobody listens once the window is closed.
        let _ = self.window.send_event(News { job: self.job, event: Event::Found(self.number, finding) });
    }
}

impl Progress for Bearer {
    fn report(&self, _: Stage, _: f32) {}

    fn is_cancelled(&self) -> bool {
        self.shared.cancel.is_cancelled()
    }

    fn rest(&self) {
        self.shared.gate.pass();
    }
}

impl Errands {
    /// No errand runs; findings go to `window`.
    #[must_use]
    pub fn new(window: EventLoopProxy<News>) -> Self {
        Self { window, last: 0, running: HashMap::new(), retired: Vec::new() }
    }

    /// Sends somebody out; `job` is the number of the scene that is open.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn send(&mut self, kind: Kind, job: u32, work: impl FnOnce(&Bearer) + Send + 'static) -> anyhow::Result<()> {
        self.end(kind);
        self.last += 1;
        let shared = Arc::new(Shared::default());
        let bearer = Bearer { number: self.last, job, shared: Arc::clone(&shared), window: self.window.clone() };
        let thread = std::thread::Builder::new().name("errand".to_owned()).spawn(move || {
            give_way();
            work(&bearer);
        });
        let thread = Some(thread.context("cannot start a thread")?);
        self.running.insert(kind, Errand { number: self.last, shared, thread });
        Ok(())
    }

    /// Ends the errand of a kind, if there is one.
    pub fn end(&mut self, kind: Kind) {
        self.retired.retain(|errand| !errand.is_finished());
        if let Some(errand) = self.running.remove(&kind) {
            errand.shared.cancel.cancel();
            errand.shared.gate.open();
            self.retired.push(errand);
        }
    }

    /// Ends all errands: another scene is opened.
    pub fn end_all(&mut self) {
        for kind in [Kind::Measure, Kind::Sight, Kind::Record, Kind::Still, Kind::Write] {
            self.end(kind);
        }
    }

    /// An errand of this kind is under way.
    #[must_use]
    pub fn is_out(&self, kind: Kind) -> bool {
        self.running.get(&kind).is_some_and(|errand| !errand.is_finished())
    }

    /// The kind of the errand with this number; none where it was called back.
    #[must_use]
    pub fn kind_of(&self, number: u32) -> Option<Kind> {
        self.running.iter().find(|(_, errand)| errand.number == number).map(|(&kind, _)| kind)
    }

    /// Everybody rests until [`Errands::go_on`].
    pub fn hold(&self) {
        self.running.values().for_each(|errand| errand.shared.gate.close());
    }

    /// Everybody goes on.
    pub fn go_on(&self) {
        self.running.values().for_each(|errand| errand.shared.gate.open());
    }
}

impl Errand {
    fn is_finished(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }
}

impl Drop for Errand {
    /// Waits for the thread: a device must not be torn down while it works.
    fn drop(&mut self) {
        self.shared.cancel.cancel();
        self.shared.gate.open();
        if let Some(thread) = self.thread.take() {
            // A panic of the thread has been printed already.
            let _ = thread.join();
        }
    }
}
