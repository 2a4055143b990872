//! What is open and what is being done about it: the place, and the worker that loads and bakes it.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use winit::event_loop::EventLoopProxy;

use super::camera::Eye;
use super::file_watch::FileWatch;
use super::panels::LightState;
use super::place::Place;
use super::solved::Solved;
use super::worker::{Event, Job, Loaded, Mesh, News, Source, Worker};
use crate::bake::BakeSettings;
use crate::base::progress::Stage;
use crate::gpu::Gpu;

/// What is open, and what is being done about it.
pub struct Session {
    gpu: Arc<Gpu>,
    window: EventLoopProxy<News>,
    /// None until the first scene is read.
    pub place: Option<Place>,
    /// Where the open scene, or the one that is being read, comes from.
    source: Source,
    /// The material variant of the file that is worn.
    variant: Option<String>,
    /// From where a scene that is read again is seen.
    kept_eye: Option<Eye>,
    watch: Option<FileWatch>,
    worker: Option<Worker>,
    /// Ended or asked to end; dropped when they have.
    retired: Vec<Worker>,
    job: u32,
    began: Instant,
    /// A mesh that waits for its first light before it is shown.
    coming: Option<Mesh>,
    num_elements: Option<usize>,
    outcome: LightState,
    curve: Vec<[f32; 2]>,
}

/// What the user should hear about.
pub enum Outcome {
    /// Nothing to say; the picture has changed.
    Changed,
    /// A scene has been opened.
    Opened,
    /// A line that goes away.
    Note(String),
    /// Something did not work: what, and why.
    Trouble(String, String),
}

impl Session {
    /// Nothing is open; `gpu` is the window's device.
    #[must_use]
    pub fn new(gpu: Arc<Gpu>, window: EventLoopProxy<News>) -> Self {
        Self {
            gpu,
            window,
            place: None,
            source: Source::default(),
            variant: None,
            kept_eye: None,
            watch: None,
            worker: None,
            retired: Vec::new(),
            job: 0,
            began: Instant::now(),
            coming: None,
            num_elements: None,
            outcome: LightState::Nothing,
            curve: Vec::new(),
        }
    }

    /// Reads a scene in a material variant and bakes it; the one that is open stays until the new one is read.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn open(&mut self, source: Source, variant: Option<String>, settings: BakeSettings) -> anyhow::Result<()> {
        self.kept_eye = None;
        (self.source, self.variant) = (source, variant);
        self.read(settings)
    }

    /// Reads the open file in another material variant and stays where one is.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn wear(&mut self, variant: Option<String>, settings: BakeSettings) -> anyhow::Result<()> {
        self.variant = variant;
        self.reload(settings)
    }

    /// Reads the open file again and stays where one is.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn reload(&mut self, settings: BakeSettings) -> anyhow::Result<()> {
        self.kept_eye = self.place.as_ref().map(|place| place.traveller.eye);
        self.read(settings)
    }

    fn read(&mut self, settings: BakeSettings) -> anyhow::Result<()> {
        self.start(Job::Open(self.source.clone(), self.variant.clone(), settings))
    }

    /// Bakes the open scene anew; a file that is a bake stays as it is.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn bake(&mut self, settings: BakeSettings) -> anyhow::Result<()> {
        match &self.place {
            Some(place) if self.outcome != LightState::Stored => {
                self.start(Job::Bake(Arc::clone(&place.scene), settings))
            }
            _ => Ok(()),
        }
    }

    fn start(&mut self, job: Job) -> anyhow::Result<()> {
        self.retire();
        self.job += 1;
        self.began = Instant::now();
        self.coming = None;
        self.curve.clear();
        self.worker = Some(Worker::start(self.job, job, Arc::clone(&self.gpu), self.window.clone())?);
        Ok(())
    }

    fn retire(&mut self) {
        self.retired.retain(|worker| !worker.is_finished());
        if let Some(worker) = self.worker.take() {
            self.curve = worker.curve();
            worker.cancel();
            self.retired.push(worker);
        }
    }

    /// The worker, while it loads or bakes.
    #[must_use]
    pub fn worker(&self) -> Option<&Worker> {
        self.worker.as_ref()
    }

    /// The number of the job that was started last: findings of others are of another scene.
    #[must_use]
    pub fn job(&self) -> u32 {
        self.job
    }

    /// The name by which the open scene is opened again.
    #[must_use]
    pub fn name(&self) -> PathBuf {
        self.source.name()
    }

    /// The material variant of the file that is worn.
    #[must_use]
    pub fn variant(&self) -> Option<&str> {
        self.variant.as_deref()
    }

    /// Where the light stands.
    #[must_use]
    pub fn light_state(&self) -> LightState {
        match &self.worker {
            Some(worker) => {
                let (stage, done) = worker.progress();
                let is_cancelled = worker.is_cancelled();
                LightState::Working { stage, done, elapsed: self.began.elapsed(), is_cancelled }
            }
            None => self.outcome.clone(),
        }
    }

    /// Triangles that carry light; none before they are known.
    #[must_use]
    pub fn num_elements(&self) -> Option<usize> {
        self.num_elements
    }

    /// Seconds since the bake began, and share of the light that was unshot.
    #[must_use]
    pub fn curve(&self) -> Vec<[f32; 2]> {
        self.worker.as_ref().map_or_else(|| self.curve.clone(), Worker::curve)
    }

    /// Takes in what the worker tells; findings of errands are taken elsewhere.
    pub fn hear(&mut self, event: Event) -> Outcome {
        match event {
            Event::Loaded(loaded) => self.enter(*loaded),
            Event::Mesh(mesh) => {
                self.num_elements = Some(mesh.scene.triangles.len());
                self.coming = Some(mesh);
                Outcome::Changed
            }
            Event::Light => {
                self.light_up();
                Outcome::Changed
            }
            Event::Finished(solved) => self.finish(solved),
            Event::Failed(message) => self.fail(message),
            Event::Progress | Event::Found(..) | Event::FileChanged => Outcome::Changed,
        }
    }

    fn enter(&mut self, loaded: Loaded) -> Outcome {
        let is_baked = loaded.solved.is_some();
        self.num_elements = is_baked.then_some(loaded.scene.triangles.len());
        self.outcome = if is_baked { LightState::Stored } else { LightState::Dark };
        self.place = Some(Place::new(loaded, self.kept_eye.take()));
        let file = self.source.file();
        self.watch = file.and_then(|file| FileWatch::start(file, self.job, self.window.clone()));
        if is_baked {
            self.retire();
        }
        Outcome::Opened
    }

    /// Shows the light that has just come, the first time with the mesh that it is on.
    fn light_up(&mut self) {
        let coming = self.coming.take();
        if let Some(place) = &mut self.place {
            place.light_up(coming);
        }
    }

    fn finish(&mut self, solved: Arc<Solved>) -> Outcome {
        self.light_up();
        let elapsed = self.began.elapsed();
        let was_cancelled = self.worker.as_ref().is_some_and(Worker::is_cancelled);
        let unshot = solved.report.as_ref().map_or(0.0, |report| 100.0 * report.unshot_share);
        self.outcome = LightState::Baked { elapsed };
        self.retire();
        let mut is_lit = true;
        if let Some(place) = &mut self.place {
            place.settle(solved);
            is_lit = place.is_lit;
        }
        Outcome::Note(if !is_lit {
            "No light arrives on any surface: shown in an even work light".to_owned()
        } else if was_cancelled {
            format!("Bake ended early: {unshot:.1} % of the light is not shot")
        } else {
            format!("Light solved in {:.1} s", elapsed.as_secs_f32())
        })
    }

    fn fail(&mut self, message: String) -> Outcome {
        let was_loading = matches!(self.light_state(), LightState::Working { stage: Stage::Load, .. });
        self.retire();
        self.coming = None;
        let title = if was_loading { "This file cannot be opened" } else { "The bake has failed" };
        Outcome::Trouble(title.to_owned(), message)
    }
}
