//! The open scene, and the worker that loads and bakes it.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use winit::event_loop::EventLoopProxy;

use crate::bake::BakeSettings;
use crate::base::progress::Stage;
use crate::gpu::Gpu;
use crate::viewer::camera::pose::CameraPose;
use crate::viewer::picture::uploaded_scene::UploadedScene;
use crate::viewer::session::file_watch::FileWatch;
use crate::viewer::session::light_state::LightState;
use crate::viewer::session::open_scene::OpenScene;
use crate::viewer::session::source::Source;
use crate::viewer::session::user_event::{LoadedScene, UserEvent, WorkerEvent};
use crate::viewer::session::worker::{Task, Worker};
use crate::viewer::solution::solved::SolvedScene;

/// The open scene, and the worker that loads and bakes it.
pub struct Session {
    gpu: Arc<Gpu>,
    window: EventLoopProxy<UserEvent>,
    /// `None` until the first scene is loaded.
    pub open_scene: Option<OpenScene>,
    /// Source of the scene that is open or being loaded.
    source: Source,
    /// Material variant of `source`.
    variant: Option<String>,
    /// Pose of the camera in a scene that is being reloaded.
    kept_pose: Option<CameraPose>,
    watch: Option<FileWatch>,
    worker: Option<Worker>,
    /// Cancelled workers, dropped when they have ended.
    retired: Vec<Worker>,
    /// Number of the last run. It increases by one with each worker.
    run: u32,
    began: Instant,
    /// The elements of the bake until their first light is uploaded.
    dark_mesh: Option<UploadedScene>,
    num_elements: Option<usize>,
    /// State of the light when no worker runs.
    outcome: LightState,
    /// Convergence of the last bake.
    curve: Vec<[f32; 2]>,
}

/// Effect of an event of the worker.
pub enum Outcome {
    /// The picture or the progress has changed.
    Changed,
    /// A scene has been opened.
    Opened,
    /// A notice for the user.
    Note(String),
    /// A failure: its title and its cause.
    Trouble(String, String),
}

impl Session {
    /// Creates a session without a scene. `gpu` is the window's device.
    #[must_use]
    pub fn new(gpu: Arc<Gpu>, window: EventLoopProxy<UserEvent>) -> Self {
        Self {
            gpu,
            window,
            open_scene: None,
            source: Source::default(),
            variant: None,
            kept_pose: None,
            watch: None,
            worker: None,
            retired: Vec::new(),
            run: 0,
            began: Instant::now(),
            dark_mesh: None,
            num_elements: None,
            outcome: LightState::Nothing,
            curve: Vec::new(),
        }
    }

    /// Loads a scene in a material variant and bakes it. The open scene stays until the new one is loaded.
    ///
    /// # Errors
    /// Returns an error if the system cannot start a thread.
    pub fn open(&mut self, source: Source, variant: Option<String>, settings: BakeSettings) -> anyhow::Result<()> {
        self.kept_pose = None;
        (self.source, self.variant) = (source, variant);
        self.load(settings)
    }

    /// Reloads the scene in another material variant; the camera stays where it is.
    ///
    /// # Errors
    /// Returns an error if the system cannot start a thread.
    pub fn choose_variant(&mut self, variant: Option<String>, settings: BakeSettings) -> anyhow::Result<()> {
        self.variant = variant;
        self.reload(settings)
    }

    /// Reloads the scene; the camera stays where it is.
    ///
    /// # Errors
    /// Returns an error if the system cannot start a thread.
    pub fn reload(&mut self, settings: BakeSettings) -> anyhow::Result<()> {
        self.kept_pose = self.open_scene.as_ref().map(|open_scene| open_scene.controller.pose);
        self.load(settings)
    }

    /// Sets the pose from which the scene that is being loaded is shown.
    pub fn keep_pose(&mut self, pose: Option<CameraPose>) {
        self.kept_pose = pose;
    }

    fn load(&mut self, settings: BakeSettings) -> anyhow::Result<()> {
        self.start(Task::Open(self.source.clone(), self.variant.clone(), settings))
    }

    /// Bakes the open scene. Does nothing if the file of the scene stores its light, because it is then a bake already.
    ///
    /// # Errors
    /// Returns an error if the system cannot start a thread.
    pub fn bake(&mut self, settings: BakeSettings) -> anyhow::Result<()> {
        match &self.open_scene {
            Some(open_scene) if self.outcome != LightState::Stored => {
                self.start(Task::Bake(Arc::clone(&open_scene.scene), settings))
            }
            _ => Ok(()),
        }
    }

    fn start(&mut self, task: Task) -> anyhow::Result<()> {
        self.retire();
        self.run += 1;
        self.began = Instant::now();
        self.dark_mesh = None;
        self.curve.clear();
        self.worker = Some(Worker::start(self.run, task, Arc::clone(&self.gpu), self.window.clone())?);
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

    /// Returns the worker while it loads or bakes, otherwise `None`.
    #[must_use]
    pub fn worker(&self) -> Option<&Worker> {
        self.worker.as_ref()
    }

    /// Returns the number of the last run. Events of earlier runs belong to another scene.
    #[must_use]
    pub fn run(&self) -> u32 {
        self.run
    }

    /// Returns the name that opens this scene again.
    #[must_use]
    pub fn name(&self) -> PathBuf {
        self.source.name()
    }

    /// Returns the material variant of the open scene.
    #[must_use]
    pub fn variant(&self) -> Option<&str> {
        self.variant.as_deref()
    }

    /// State of the light.
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

    /// Returns the number of elements; `None` before it is known.
    #[must_use]
    pub fn num_elements(&self) -> Option<usize> {
        self.num_elements
    }

    /// Returns the convergence of the bake: seconds since the beginning, and unshot share of the light.
    #[must_use]
    pub fn curve(&self) -> Vec<[f32; 2]> {
        self.worker.as_ref().map_or_else(|| self.curve.clone(), Worker::curve)
    }

    /// Applies an event of the worker.
    pub fn receive(&mut self, event: WorkerEvent) -> Outcome {
        match event {
            WorkerEvent::Loaded(loaded) => self.enter(*loaded),
            WorkerEvent::MeshUploaded(mesh) => {
                self.num_elements = Some(mesh.scene.triangles.len());
                self.dark_mesh = Some(mesh);
                Outcome::Changed
            }
            WorkerEvent::LightUpdated => {
                self.show_light();
                Outcome::Changed
            }
            WorkerEvent::Finished(solved) => self.finish(solved),
            WorkerEvent::Failed(message) => self.fail(message),
            WorkerEvent::Progress => Outcome::Changed,
        }
    }

    fn enter(&mut self, loaded: LoadedScene) -> Outcome {
        let is_baked = loaded.solved.is_some();
        self.num_elements = is_baked.then_some(loaded.scene.triangles.len());
        self.outcome = if is_baked { LightState::Stored } else { LightState::Dark };
        self.open_scene = Some(OpenScene::new(loaded, self.kept_pose.take()));
        let file = self.source.file();
        self.watch = file.and_then(|file| FileWatch::start(file, self.window.clone(), || UserEvent::FileChanged));
        if is_baked {
            self.retire();
        }
        Outcome::Opened
    }

    /// Shows the light that was uploaded last. The first light of a bake also replaces the mesh.
    fn show_light(&mut self) {
        let mesh = self.dark_mesh.take();
        if let Some(open_scene) = &mut self.open_scene {
            open_scene.show_light(mesh);
        }
    }

    fn finish(&mut self, solved: Arc<SolvedScene>) -> Outcome {
        self.show_light();
        let elapsed = self.began.elapsed();
        let was_cancelled = self.worker.as_ref().is_some_and(Worker::is_cancelled);
        let unshot = solved.report.as_ref().map_or(0.0, |report| 100.0 * report.work.unshot_share);
        self.outcome = LightState::Baked { elapsed };
        self.retire();
        let mut is_lit = true;
        if let Some(open_scene) = &mut self.open_scene {
            open_scene.set_solved(solved);
            is_lit = open_scene.is_lit;
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
        self.dark_mesh = None;
        let title = if was_loading { "This file cannot be opened" } else { "The bake has failed" };
        Outcome::Trouble(title.to_owned(), message)
    }
}
